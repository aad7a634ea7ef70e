//! What a surface costs at load: `cargo bench -p tam-viewer --bench surface [-- --triangles 20000,100000]`.
//!
//! Medians of seven runs, in seconds. Each step on all nodes, and all of them; lapped patches, which stand for `patches` where
//! the printed method is compared. Then as an application has it made, on clusters where the mesh is finer than strokes: a
//! surface with patches and stripes, one with patches alone, and other tiles where directions are known. Last the bytes
//! per triangle of patches and of two line fields.

use std::time::Instant;

use tam_gen::Job;
use tam_viewer::mesh::sample::Sample;
use tam_viewer::mesh::{Mesh, prepare};
use tam_viewer::surface::{
    Corners, FieldOptions, Graph, LappedOptions, PatchOptions, StripeOptions, Surface, SurfaceBase, SurfaceError,
    SurfaceOptions, curvatures, field, lapped, patches, stripes,
};

type Error = Box<dyn std::error::Error>;

const ROUNDS: usize = 7;

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
        "{:<10} {:>9}  {:>7} {:>9} {:>7} {:>7} {:>7} {:>7}  {:>7}  {:>7} {:>7} {:>11}  {:>11}",
        "mesh",
        "triangles",
        "graph",
        "curvature",
        "field",
        "patches",
        "stripes",
        "all",
        "lapped",
        "whole",
        "hatched",
        "other tiles",
        "B/triangle"
    ));
    for sample in [Sample::Hand, Sample::Head, Sample::TorusKnot] {
        for count in &triangles {
            if let Err(error) = row(sample, *count) {
                say(&format!("{}: {error}", sample.name()));
            }
        }
    }
}

/// Seconds that work takes, and what comes of it.
fn timed<T>(work: impl FnOnce() -> T) -> (f64, T) {
    let started = Instant::now();
    let made = work();
    (started.elapsed().as_secs_f64(), made)
}

fn row(sample: Sample, count: usize) -> Result<(), Error> {
    let mesh = prepare(sample.build(count))?.mesh;
    let mut rounds = Vec::with_capacity(ROUNDS);
    let mut bytes = 0;
    for _ in 0..ROUNDS {
        let (on_graph, graph) = timed(|| Graph::new(&mesh));
        let (on_curvature, curvatures) = timed(|| curvatures(&graph));
        let (on_field, field) = timed(|| field(&graph, &mesh, &curvatures, &FieldOptions::default()));
        let field = field?;
        let (on_patches, patches) = timed(|| patches(&graph, &curvatures, &field, &PatchOptions::default()));
        let (on_stripes, stripes) = timed(|| stripes(&graph, &mesh.neighbours, &field, &StripeOptions::default()));
        let stripes = stripes?;
        let all = on_graph + on_curvature + on_field + on_patches + on_stripes;
        let (on_lapped, lapped) = timed(|| lapped(&graph, &field, &LappedOptions::default()));
        lapped?;
        let corners =
            [Corners::of_patches(&mesh.triangles, &patches), Corners::of_stripes(&mesh.triangles, &stripes, None)];
        bytes = corners.iter().map(Corners::bytes).sum();
        let [whole, hatched, other_tiles] = as_applications_do(&mesh)?;
        let steps = [on_graph, on_curvature, on_field, on_patches, on_stripes, all, on_lapped];
        rounds.push([&steps[..], &[whole, hatched, other_tiles]].concat());
    }
    let column = |index: usize| median(rounds.iter().map(|round| round[index]).collect());
    let seconds: Vec<String> = (0..10).map(|index| format!("{:.3}", column(index))).collect();
    let [graph, curvature, field, patches, stripes, all, lapped, whole, hatched, other_tiles] = &seconds[..] else {
        return Ok(());
    };
    let triangles = mesh.triangles.len();
    say(&format!(
        "{:<10} {triangles:>9}  {graph:>7} {curvature:>9} {field:>7} {patches:>7} {stripes:>7} {all:>7}  {lapped:>7}  {whole:>7} {hatched:>7} {other_tiles:>11}  {:>11.1}",
        sample.name(),
        bytes as f64 / triangles as f64
    ));
    Ok(())
}

/// Seconds that it takes with patches and stripes, with patches alone, and with patches of other tiles after these.
fn as_applications_do(mesh: &Mesh) -> Result<[f64; 3], SurfaceError> {
    let with = |patches: PatchOptions, stripes: Option<StripeOptions>| SurfaceOptions {
        patches: Some(patches),
        stripes,
        ..SurfaceOptions::default()
    };
    let job = Job::default();
    let both = with(PatchOptions::default(), Some(StripeOptions::default()));
    let (whole, made) = timed(|| Surface::new_with(mesh, &both, &job));
    made?;
    let alone = with(PatchOptions::default(), None);
    let (hatched, made) = timed(|| {
        let base = SurfaceBase::new(mesh, &alone.field, &job)?;
        Ok::<_, SurfaceError>((Surface::on(&base, mesh, &alone, &job)?, base))
    });
    let (_, base) = made?;
    let PatchOptions { tiles_per_unit, .. } = PatchOptions::default();
    let others = with(PatchOptions { tiles_per_unit: 1.1 * tiles_per_unit, ..PatchOptions::default() }, None);
    let (other_tiles, made) = timed(|| Surface::on(&base, mesh, &others, &job));
    made.map(|_| [whole, hatched, other_tiles])
}

fn median(mut times: Vec<f64>) -> f64 {
    times.sort_by(f64::total_cmp);
    times.get(times.len() / 2).copied().unwrap_or(0.0)
}

#[expect(clippy::print_stdout, reason = "a bench prints its figures")]
fn say(line: &str) {
    println!("{line}");
}
