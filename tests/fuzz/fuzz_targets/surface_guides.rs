#![no_main]

use std::sync::LazyLock;

use tam_viewer::mesh::sample::Sample;
use tam_viewer::mesh::{Mesh, prepare};
use tam_viewer::surface::{Curvature, FieldOptions, Graph, curvatures, field, guides};

/// What guides are laid on.
static SURFACE: LazyLock<(Mesh, Graph, Vec<Curvature>)> = LazyLock::new(|| {
    let mesh = prepare(Sample::Torus.build(60)).expect("a torus").mesh;
    let graph = Graph::new(&mesh);
    let curvatures = curvatures(&graph);
    (mesh, graph, curvatures)
});

libfuzzer_sys::fuzz_target!(|text: &str| {
    let Ok(guides) = guides::parse(text) else { return };
    assert_eq!(guides::parse(&guides::to_text(&guides)).ok().as_ref(), Some(&guides));
    let (mesh, graph, curvatures) = &*SURFACE;
    let options = FieldOptions { guides, ..FieldOptions::default() };
    let field = field(graph, mesh, curvatures, &options).expect("guides are no reason not to have a field");
    assert!(field.angles_rad.iter().all(|angle| angle.is_finite()));
    assert!(field.strengths.iter().all(|strength| (0.0..=1.0).contains(strength)));
});
