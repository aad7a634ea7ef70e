//! What a surface costs at load: `cargo bench -p tam-viewer --bench surface [-- --triangles 20000,100000]`.
//!
//! Medians of five runs, in seconds, for each step and all of them; for lapped patches, which stand for `patches` where
//! the printed method is compared; and bytes per triangle of patches and of two line fields.

use std::time::Instant;

use tam_viewer::mesh::prepare;
use tam_viewer::mesh::sample::Sample;
use tam_viewer::surface::{
    Corners, FieldOptions, Graph, LappedOptions, PatchOptions, StripeOptions, curvatures, field, lapped, patches,
    stripes,
};

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
        "{:<10} {:>9}  {:>7} {:>9} {:>7} {:>7} {:>7}  {:>7}  {:>7} {:>12}",
        "mesh", "triangles", "graph", "curvature", "field", "patches", "stripes", "all", "lapped", "B/triangle"
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
    let mut times = vec![Vec::new(); 7];
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
        let stripes = match stripes(&graph, &mesh.neighbours, &field, &StripeOptions::default()) {
            Ok(stripes) => stripes,
            Err(error) => return say(&format!("{}: {error}", sample.name())),
        };
        lap(&mut times[4]);
        times[5].push(started.elapsed().as_secs_f64());
        let started = Instant::now();
        if let Err(error) = lapped(&graph, &field, &LappedOptions::default()) {
            return say(&format!("{}: {error}", sample.name()));
        }
        times[6].push(started.elapsed().as_secs_f64());
        let corners =
            [Corners::of_patches(&mesh.triangles, &patches), Corners::of_stripes(&mesh.triangles, &stripes, None)];
        bytes = corners.iter().map(Corners::bytes).sum();
    }
    let seconds: Vec<String> = times.into_iter().map(|times| format!("{:.3}", median(times))).collect();
    let [graph, curvature, field, patches, stripes, all, lapped] = &seconds[..] else { return };
    let triangles = mesh.triangles.len();
    say(&format!(
        "{:<10} {triangles:>9}  {graph:>7} {curvature:>9} {field:>7} {patches:>7} {stripes:>7}  {all:>7}  {lapped:>7} {:>12.1}",
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
