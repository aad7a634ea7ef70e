//! Phases against the field they follow and against each other across links.

use glam::DVec3;

use super::*;
use crate::mesh::prepare;
use crate::mesh::sample::Sample;
use crate::surface::FieldOptions;
use crate::surface::tests::field_of;

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

#[test]
#[ignore = "prints figures; run it in release"]
fn figures_of_samples() {
    for sample in [Sample::Hand, Sample::Head, Sample::TorusKnot, Sample::Teapot] {
        for triangles in [5_000, 20_000, 100_000] {
            let mesh = prepare(sample.build(triangles)).expect("a sample").mesh;
            let start = std::time::Instant::now();
            let (graph, field) = field_of(&mesh, &FieldOptions::default());
            let field_s = start.elapsed().as_secs_f64();
            for lines_per_unit in [4.0] {
                let start = std::time::Instant::now();
                let options = StripeOptions { lines_per_unit, across: false };
                let stripes = stripes(&graph, &field, &options).expect("stripes");
                let stripes_s = start.elapsed().as_secs_f64();
                let seen = seen(&graph, &field, false, &stripes.along);
                eprintln!(
                    "{:10} {:7} field {field_s:.2} s, stripes {stripes_s:.2} s, {lines_per_unit}: {seen:.3?}",
                    sample.name(),
                    mesh.triangles.len()
                );
            }
        }
    }
}
