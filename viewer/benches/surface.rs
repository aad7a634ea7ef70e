//! What a surface costs at load: `cargo bench -p tam-viewer --bench surface [-- --triangles 20000,100000]`.
//!
//! Medians of five runs, in seconds, for field, patches, and their parts; and bytes per triangle.

use std::time::Instant;

use tam_viewer::mesh::prepare;
use tam_viewer::mesh::sample::Sample;
use tam_viewer::surface::{FieldOptions, Graph, PatchOptions, curvatures, field, patches};

const ROUNDS: usize = 5;

fn main() {
    let mut triangles = vec![20_000, 100_000];
    let mut arguments = std::env::args().skip(1);
    while let Some(argument) = arguments.next() {
        if argument == "--triangles" {
            let list = arguments.next().unwrap_or_default();
            triangles = list.split(',').filter_map(|count| count.parse().ok()).collect();
        }
    }
    say(&format!(
        "{:<8} {:>9}  {:>7} {:>9} {:>7} {:>7}  {:>7} {:>12}",
        "mesh", "triangles", "graph", "curvature", "field", "patches", "all", "B/triangle"
    ));
    for sample in [Sample::Hand, Sample::Head, Sample::TorusKnot] {
        for count in &triangles {
            row(sample, *count);
        }
    }
}

fn row(sample: Sample, count: usize) {
    let mesh = match prepare(sample.build(count)) {
        Ok(loaded) => loaded.mesh,
        Err(error) => return say(&format!("{}: {error}", sample.name())),
    };
    let mut times = vec![Vec::new(); 5];
    let mut bytes = 0;
    for _ in 0..ROUNDS {
        let started = Instant::now();
        let mut last = started;
        let mut lap = |times: &mut Vec<f64>| {
            times.push(last.elapsed().as_secs_f64());
            last = Instant::now();
        };
        let graph = Graph::new(&mesh);
        lap(&mut times[0]);
        let curvatures = curvatures(&graph);
        lap(&mut times[1]);
        let field = match field(&graph, &mesh, &curvatures, &FieldOptions::default()) {
            Ok(field) => field,
            Err(error) => return say(&format!("{}: {error}", sample.name())),
        };
        lap(&mut times[2]);
        let patches = patches(&graph, &curvatures, &field, &PatchOptions::default());
        lap(&mut times[3]);
        times[4].push(started.elapsed().as_secs_f64());
        bytes = patches.bytes();
    }
    let seconds: Vec<String> = times.into_iter().map(|times| format!("{:.3}", median(times))).collect();
    let [graph, curvature, field, patches, all] = &seconds[..] else { return };
    let triangles = mesh.triangles.len();
    say(&format!(
        "{:<8} {triangles:>9}  {graph:>7} {curvature:>9} {field:>7} {patches:>7}  {all:>7} {:>12.1}",
        sample.name(),
        bytes as f64 / triangles as f64
    ));
}

fn median(mut times: Vec<f64>) -> f64 {
    times.sort_by(f64::total_cmp);
    times.get(times.len() / 2).copied().unwrap_or(0.0)
}

#[expect(clippy::print_stdout, reason = "a bench prints its figures")]
fn say(line: &str) {
    println!("{line}");
}
