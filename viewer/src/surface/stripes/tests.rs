//! Phases against the field they follow and against each other across links.

use std::collections::HashMap;
use std::f64::consts::TAU;

use glam::{DVec3, Vec3, vec3};

use super::phase::stripe_phase;
use super::*;
use crate::mesh::sample::Sample;
use crate::mesh::{Mesh, RawMesh, prepare};
use crate::surface::tests::{field_of, sheet};
use crate::surface::{FieldOptions, FieldSource};

/// Gradient of the phase in a triangle where it is linear.
fn gradient(graph: &Graph, triangle: usize, phases: &StripePhases) -> Option<DVec3> {
    let p = graph.triangles[triangle].map(|node| graph.positions[node as usize]);
    let cross = (p[1] - p[0]).cross(p[2] - p[0]);
    let longest = (0..3).map(|k| p[k].distance_squared(p[(k + 1) % 3])).fold(0.0, f64::max);
    if phases.code != 0 || cross.length() < 1e-3 * longest {
        return None;
    }
    let [a, b, c] = phases.corners.map(f64::from);
    Some((cross.cross(p[0] - p[2]) * (b - a) + cross.cross(p[1] - p[0]) * (c - a)) / cross.length_squared())
}

/// What is seen of the lines of a surface.
#[derive(Debug, Default)]
struct Seen {
    /// Mean angle between lines and field over the area, in degrees.
    error_deg: f64,
    /// Mean and standard deviation over the area of ln(lines per unit).
    log_mean: f64,
    log_deviation: f64,
    /// Triangles in which lines end, and in which the field is singular.
    ends: usize,
    folds: usize,
}

fn seen(graph: &Graph, field: &Field, across: bool, stripes: &[StripePhases]) -> Seen {
    let mut seen = Seen::default();
    let (mut total, mut square) = (0.0, 0.0);
    for (triangle, phases) in stripes.iter().enumerate() {
        seen.folds += usize::from(phases.code & 1 == 1);
        seen.ends += usize::from(phases.code & 1 == 0 && phases.code != 0);
        let Some(gradient) = gradient(graph, triangle, phases) else { continue };
        let nodes = graph.triangles[triangle].map(|node| node as usize);
        let p = nodes.map(|node| graph.positions[node]);
        let cross = (p[1] - p[0]).cross(p[2] - p[0]);
        let first = field.direction(graph, nodes[0]);
        let line: DVec3 = nodes
            .map(|node| field.direction(graph, node))
            .into_iter()
            .map(|line| if line.dot(first) < 0.0 { -line } else { line })
            .sum();
        let normal = cross.normalize();
        let line = (line - normal * line.dot(normal)).normalize();
        let line = if across { normal.cross(line) } else { line };
        let area = cross.length();
        total += area;
        seen.error_deg += area * gradient.normalize().dot(line).abs().min(1.0).asin().to_degrees();
        let log = gradient.length().ln();
        seen.log_mean += area * log;
        square += area * log * log;
    }
    seen.error_deg /= total;
    seen.log_mean /= total;
    seen.log_deviation = (square / total - seen.log_mean * seen.log_mean).max(0.0).sqrt();
    seen
}

const FOUR: StripeOptions = StripeOptions { lines_per_unit: 4.0, across: true };

fn striped(mesh: &Mesh, options: &FieldOptions) -> (Graph, Field, Stripes) {
    let (graph, field) = field_of(mesh, options);
    let stripes = stripes(&graph, &mesh.neighbours, &field, &FOUR).expect("stripes");
    (graph, field, stripes)
}

#[test]
fn on_a_plane_lines_stand_evenly_and_as_close_as_asked() {
    let mesh = sheet(40, 40, |u, v| DVec3::new(2.0 * u - 1.0, 2.0 * v - 1.0, 0.0));
    let slanted = FieldOptions { source: FieldSource::Constant(DVec3::new(0.8, 0.6, 0.0)), ..FieldOptions::default() };
    let (graph, field, stripes) = striped(&mesh, &slanted);
    for (across, lines) in [(false, &stripes.along), (true, &stripes.across)] {
        let seen = seen(&graph, &field, across, lines);
        // The field itself is bent a little by what stands in where nothing is asked for.
        assert!(seen.error_deg < 0.1 && seen.ends + seen.folds == 0, "{seen:?}");
        assert!((seen.log_mean - 4.0_f64.ln()).abs() < 0.005 && seen.log_deviation < 0.005, "{seen:?}");
    }
}

#[test]
fn on_a_cylinder_and_a_torus_lines_close() {
    let cylinder = sheet(48, 40, |u, v| {
        let (sin, cos) = (u * TAU).sin_cos();
        DVec3::new(0.4 * cos, 2.0 * v, -0.4 * sin)
    });
    let torus = prepare(Sample::Torus.build(20_000)).expect("a torus").mesh;
    // The torus' inner side is shorter than its outer: its lines across draw together by half or more.
    for (mesh, degrees, deviation) in [(&cylinder, 0.2, 0.02), (&torus, 1.0, 0.6)] {
        let (graph, field, stripes) = striped(mesh, &FieldOptions::default());
        for (across, lines) in [(false, &stripes.along), (true, &stripes.across)] {
            let seen = seen(&graph, &field, across, lines);
            assert!(seen.error_deg < degrees && seen.ends + seen.folds == 0, "{across}: {seen:?}");
            assert!(seen.log_deviation < deviation, "{across}: {seen:?}");
        }
    }
}

/// A sector of a ring about the origin, and the field of its radii.
fn fan() -> (Mesh, Graph, Field) {
    let mesh = sheet(60, 40, |u, v| {
        let (sin, cos) = (2.0 * u).sin_cos();
        DVec3::new(cos, sin, 0.0) * (0.25 + 0.75 * v)
    });
    let graph = Graph::new(&mesh);
    // Meshes are moved and scaled to their box; the radii meet where the two straight sides do.
    let place = |x: f64, y: f64| (DVec3::new(x, y, 0.0) - mesh.placement.centre) * mesh.placement.scale;
    let middle = place(0.0, 0.0);
    let angles_rad = (0..graph.len()).map(|node| graph.angle(node, graph.positions[node] - middle)).collect();
    let strengths = vec![1.0; graph.len()];
    (mesh, graph, Field { angles_rad, strengths })
}

#[test]
fn lines_that_draw_together_need_not_end() {
    let (mesh, graph, field) = fan();
    let stripes = stripes(&graph, &mesh.neighbours, &field, &FOUR).expect("stripes");
    let seen = seen(&graph, &field, false, &stripes.along);
    // Evenly spaced ones must, and swerve for it: 5 end, and the error is 5 degrees.
    assert!(seen.ends == 0 && seen.error_deg < 1.0, "{seen:?}");
}

#[test]
fn lines_follow_the_field_on_hand_and_head() {
    for (sample, degrees) in [(Sample::Hand, 3.0), (Sample::Head, 5.0)] {
        for triangles in [5_000, 20_000] {
            let mesh = prepare(sample.build(triangles)).expect("a sample").mesh;
            let (graph, field, stripes) = striped(&mesh, &FieldOptions::default());
            let seen = seen(&graph, &field, false, &stripes.along);
            assert!(seen.error_deg < degrees && seen.ends < 5, "{} {triangles}: {seen:?}", sample.name());
        }
    }
}

/// Greatest difference of the phases on the two sides of shared edges, up to sign and whole numbers, in lines.
fn worst_seam(graph: &Graph, stripes: &[StripePhases]) -> (usize, f64) {
    let mut seen: HashMap<(u32, u32), Vec<f64>> = HashMap::new();
    let (mut compared, mut worst) = (0, 0.0_f64);
    for (triangle, phases) in graph.triangles.iter().zip(stripes) {
        for k in 0..3 {
            let (a, b) = (triangle[k], triangle[(k + 1) % 3]);
            // The same places on both sides, counted from the lesser node.
            let at = |share: f64| {
                let share = if a < b { share } else { 1.0 - share };
                let mut weights = [0.0; 3];
                (weights[k], weights[(k + 1) % 3]) = (1.0 - share, share);
                // To the nearest line or gap, without its sign.
                let phase = stripe_phase(phases, weights.into());
                (phase - phase.round()).abs()
            };
            let here: Vec<f64> = [0.0, 0.3, 0.5, 0.8, 1.0].map(at).to_vec();
            match seen.get(&(a.min(b), a.max(b))) {
                Some(there) => {
                    compared += 1;
                    worst = here.iter().zip(there).map(|(here, there)| (here - there).abs()).fold(worst, f64::max);
                }
                None => {
                    seen.insert((a.min(b), a.max(b)), here);
                }
            }
        }
    }
    (compared, worst)
}

#[test]
fn phases_agree_across_all_links_also_where_lines_end_and_the_field_is_singular() {
    let mut kinds = [0, 0];
    for sample in [Sample::Teapot, Sample::Head, Sample::Chair] {
        let mesh = prepare(sample.build(4_000)).expect("a sample").mesh;
        let (graph, field, stripes) = striped(&mesh, &FieldOptions::default());
        for lines in [&stripes.along, &stripes.across] {
            let (compared, worst) = worst_seam(&graph, lines);
            // Phases are 32-bit numbers of a few lines.
            assert!(compared > 3_000 && worst < 1e-5, "{}: {worst} at {compared}", sample.name());
            let seen = seen(&graph, &field, false, lines);
            kinds = [kinds[0] + seen.ends, kinds[1] + seen.folds];
        }
    }
    assert!(kinds[0] > 3 && kinds[1] > 20, "{kinds:?}");
}

#[test]
fn stripes_are_the_same_for_any_number_of_threads() {
    let mesh = prepare(Sample::Head.build(20_000)).expect("a head").mesh;
    let of = |threads| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("threads");
        pool.install(|| striped(&mesh, &FieldOptions::default()).2)
    };
    assert!(of(1) == of(4));
}

#[test]
fn soups_needles_and_single_triangles_have_stripes() {
    let mut soup = RawMesh::default();
    // Triangles apart, a needle, and three triangles at one edge.
    for (i, top) in [Vec3::Y, Vec3::Y, vec3(0.5, 1e-6, 0.0)].into_iter().enumerate() {
        let at = vec3(0.0, 0.0, 3.0 * i as f32);
        soup.positions.extend([at, at + Vec3::X, at + top]);
        soup.triangles.push([3 * i as u32, 3 * i as u32 + 1, 3 * i as u32 + 2]);
    }
    soup.positions.extend([Vec3::ZERO, Vec3::Z, Vec3::NEG_X, Vec3::NEG_Y, vec3(-1.0, 1.0, 0.0)]);
    soup.triangles.extend((11..14).map(|k| [9, 10, k]));
    let mut single = RawMesh::default();
    single.positions.extend([Vec3::ZERO, Vec3::X, Vec3::Y]);
    single.triangles.push([0, 1, 2]);
    for raw in [soup, single] {
        let mesh = prepare(raw).expect("a mesh").mesh;
        let (graph, _, stripes) = striped(&mesh, &FieldOptions::default());
        for lines in [&stripes.along, &stripes.across] {
            assert_eq!(lines.len(), graph.triangles.len());
            assert!(lines.iter().all(|phases| phases.corners.iter().all(|phase| phase.abs() < 1e3)));
        }
    }
    let nothing = Graph::new(&Mesh {
        triangles: Vec::new(),
        normal_groups: Vec::new(),
        ..sheet(1, 1, |u, v| DVec3::new(u, v, 0.0))
    });
    let field = Field { angles_rad: Vec::new(), strengths: Vec::new() };
    assert_eq!(stripes(&nothing, &[], &field, &FOUR), Ok(Stripes::default()));
}

#[test]
fn lines_too_many_or_too_few_are_refused() {
    let (mesh, graph, field) = fan();
    for lines_per_unit in [0.2, 64.1, -4.0, f64::NAN, f64::INFINITY] {
        let options = StripeOptions { lines_per_unit, across: false };
        let error = stripes(&graph, &mesh.neighbours, &field, &options).expect_err("refused");
        assert!(matches!(error, StripeError::LinesPerUnit(_)), "{error}");
    }
    let one = StripeOptions { across: false, ..FOUR };
    assert!(stripes(&graph, &mesh.neighbours, &field, &one).expect("stripes").across.is_empty());
}
