//! What it costs to know which way strokes run on a hundred thousand triangles, and to lay stripes that way, with
//! criterion.

#![allow(missing_docs)]

use std::hint::black_box;

use criterion::{Criterion, Throughput, criterion_group, criterion_main};
use tam_viewer::mesh::prepare;
use tam_viewer::mesh::sample::Sample;
use tam_viewer::surface::{FieldOptions, Graph, StripeOptions, curvatures, field, stripes};

const TRIANGLES: usize = 100_000;

fn surfaces(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("surface");
    group.sample_size(10);
    for sample in [Sample::Head, Sample::TorusKnot] {
        let mesh = prepare(sample.build(TRIANGLES)).expect("a sample").mesh;
        let graph = Graph::new(&mesh);
        let curvatures = curvatures(&graph);
        let options = FieldOptions::default();
        let directions = field(&graph, &mesh, &curvatures, &options).expect("a field");
        group.throughput(Throughput::Elements(mesh.triangles.len() as u64));
        group.bench_function(format!("field {}", sample.name()), |bencher| {
            bencher.iter(|| field(&graph, black_box(&mesh), &curvatures, &options).expect("a field"));
        });
        for (name, across) in [("stripes", false), ("stripes and those across", true)] {
            let options = StripeOptions { across, ..StripeOptions::default() };
            group.bench_function(format!("{name} {}", sample.name()), |bencher| {
                bencher.iter(|| stripes(&graph, black_box(&directions), &options).expect("stripes"));
            });
        }
    }
    group.finish();
}

criterion_group!(benches, surfaces);
criterion_main!(benches);
