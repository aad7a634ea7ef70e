//! Fields against the directions that formulas give.

use std::f64::consts::{FRAC_PI_2, TAU};

use glam::{DVec3, Vec3, vec3};

use super::*;
use crate::mesh::sample::Sample;
use crate::mesh::{Mesh, RawMesh, prepare};

/// A sheet of `p(u, v)`, u and v in 0..=1, with the ends joined where they meet.
pub(crate) fn sheet(columns: u32, rows: u32, p: impl Fn(f64, f64) -> DVec3) -> Mesh {
    let mut raw = RawMesh::default();
    for row in 0..=rows {
        for column in 0..=columns {
            let place = p(f64::from(column) / f64::from(columns), f64::from(row) / f64::from(rows));
            raw.positions.push(place.as_vec3());
        }
    }
    for row in 0..rows {
        for column in 0..columns {
            let [a, b] = [row, row + 1].map(|row| row * (columns + 1) + column);
            // Diagonals both ways, so that none is preferred.
            if (row + column) % 2 == 0 {
                raw.triangles.extend([[a, a + 1, b + 1], [a, b + 1, b]]);
            } else {
                raw.triangles.extend([[a, a + 1, b], [a + 1, b + 1, b]]);
            }
        }
    }
    prepare(raw).expect("a mesh").mesh
}

pub(crate) fn field_of(mesh: &Mesh, options: &FieldOptions) -> (Graph, Field) {
    let graph = Graph::new(mesh);
    let curvatures = curvatures(&graph);
    let field = field(&graph, mesh, &curvatures, options).expect("a field");
    (graph, field)
}

/// Mean and greatest angle in degrees between field and formula, where the formula says something.
fn error_deg(graph: &Graph, field: &Field, wanted: impl Fn(DVec3) -> Option<DVec3>) -> (f64, f64) {
    let errors: Vec<f64> = (0..graph.len())
        .filter_map(|node| {
            let wanted = wanted(graph.positions[node])?.normalize();
            Some(field.direction(graph, node).dot(wanted).abs().min(1.0).acos().to_degrees())
        })
        .collect();
    assert!(errors.len() > graph.len() / 4);
    (errors.iter().sum::<f64>() / errors.len() as f64, errors.iter().copied().fold(0.0, f64::max))
}

#[test]
fn on_a_cylinder_the_field_runs_round_it() {
    let mesh = sheet(48, 40, |u, v| {
        let (sin, cos) = (u * TAU).sin_cos();
        DVec3::new(0.4 * cos, 2.0 * v, -0.4 * sin)
    });
    let (graph, field) = field_of(&mesh, &FieldOptions::default());
    let (mean, worst) = error_deg(&graph, &field, |p| Some(DVec3::new(-p.z, 0.0, p.x)));
    assert!(mean < 0.5 && worst < 3.0, "{mean:.2} {worst:.2}");
    let lower = FieldOptions { source: FieldSource::LowerCurvature, ..FieldOptions::default() };
    let (graph, field) = field_of(&mesh, &lower);
    let (mean, worst) = error_deg(&graph, &field, |_| Some(DVec3::Y));
    assert!(mean < 0.5 && worst < 3.0, "{mean:.2} {worst:.2}");
}

#[test]
fn on_a_torus_the_field_runs_round_the_tube() {
    for triangles in [1_000, 20_000] {
        let mesh = prepare(Sample::Torus.build(triangles)).expect("a torus").mesh;
        let (graph, field) = field_of(&mesh, &FieldOptions::default());
        // Normal to the plane of the tube's cross-section are the directions round the axis; the axis is the direction
        // in which the torus is thinnest.
        let extent = graph.positions.iter().fold(DVec3::ZERO, |extent, p| extent.max(p.abs()));
        let axis = if extent.y < extent.x.min(extent.z) { DVec3::Y } else { DVec3::Z };
        let ring = extent.max_element() - extent.dot(axis);
        let round = |p: DVec3| {
            let around = axis.cross(p).normalize();
            let centre = around.cross(axis) * ring;
            Some(around.cross(p - centre))
        };
        let (mean, worst) = error_deg(&graph, &field, round);
        assert!(mean < 1.0 && worst < 4.0, "{triangles}: {mean:.2} {worst:.2}");
    }
}

#[test]
fn on_an_ellipsoid_the_field_follows_the_lines_of_curvature() {
    // Of revolution: parallels bend most on a prolate one, away from the poles, which are umbilics.
    let mesh = sheet(64, 48, |u, v| {
        let ((sin, cos), (high, wide)) = ((u * TAU).sin_cos(), ((v - 0.5) * 3.0).sin_cos());
        DVec3::new(0.4 * cos * wide, high, -0.4 * sin * wide)
    });
    let (graph, field) = field_of(&mesh, &FieldOptions::default());
    let round = |p: DVec3| (p.y.abs() < 0.8).then(|| DVec3::new(-p.z, 0.0, p.x));
    let (mean, worst) = error_deg(&graph, &field, round);
    assert!(mean < 0.5 && worst < 3.0, "{mean:.2} {worst:.2}");
}

#[test]
fn on_a_saddle_the_field_takes_the_greater_curvature() {
    // z = 0.8 x² - 0.3 y²: along x near the middle.
    let mesh = sheet(48, 48, |u, v| {
        let (x, y) = (2.0 * u - 1.0, 2.0 * v - 1.0);
        DVec3::new(x, y, 0.8 * x * x - 0.3 * y * y)
    });
    let (graph, field) = field_of(&mesh, &FieldOptions::default());
    let middle = |p: DVec3| (p.truncate().length() < 0.35).then_some(DVec3::X);
    let errors: Vec<f64> = (0..graph.len())
        .filter(|node| middle(graph.positions[*node]).is_some())
        .map(|node| field.direction(&graph, node).normalize().with_z(0.0).normalize().dot(DVec3::X).abs().acos())
        .map(f64::to_degrees)
        .collect();
    let mean = errors.iter().sum::<f64>() / errors.len() as f64;
    assert!(errors.len() > 100 && mean < 3.0, "{mean:.2}");
}

#[test]
fn the_indices_of_a_closed_surface_sum_to_its_euler_characteristic() {
    let bumps = |p: &Vec3| *p * (1.0 + 0.15 * (5.0 * p.x).sin() * (4.0 * p.y).cos() * (6.0 * p.z).sin());
    for (sample, euler) in [(Sample::Sphere, 2), (Sample::Torus, 0), (Sample::TorusKnot, 0)] {
        let mut raw = sample.build(8_000);
        raw.positions = raw.positions.iter().map(bumps).collect();
        raw.normals.clear();
        let mesh = prepare(raw).expect("a sample").mesh;
        let closed = mesh.neighbours.as_flattened().iter().all(|neighbour| *neighbour != crate::mesh::NONE);
        assert!(closed, "{}", sample.name());
        let (graph, field) = field_of(&mesh, &FieldOptions::default());
        assert_eq!(graph.len(), mesh.point_count, "{} has hard edges", sample.name());
        let sum: i32 = field.indices(&graph).iter().sum();
        assert_eq!(sum, 2 * euler, "{}", sample.name());
    }
}

#[test]
fn guides_are_met() {
    let mesh = sheet(40, 40, |u, v| DVec3::new(2.0 * u - 1.0, 2.0 * v - 1.0, 0.0));
    let arc: Vec<DVec3> = (0..=32)
        .map(|i| {
            let angle = FRAC_PI_2 * f64::from(i) / 32.0;
            DVec3::new(0.7 * angle.cos(), 0.7 * angle.sin(), 0.0)
        })
        .collect();
    let options = FieldOptions {
        source: FieldSource::Constant(DVec3::X),
        guides: vec![Guide { points: arc.clone() }],
        ..FieldOptions::default()
    };
    let (graph, field) = field_of(&mesh, &options);
    let near = |p: DVec3| {
        (p.x > 0.0 && p.y > 0.0 && (p.truncate().length() - 0.7).abs() < 0.02).then(|| DVec3::new(-p.y, p.x, 0.0))
    };
    let errors: Vec<f64> = (0..graph.len())
        .filter_map(|node| Some((node, near(graph.positions[node])?)))
        .map(|(node, wanted)| field.direction(&graph, node).dot(wanted.normalize()).abs().min(1.0).acos().to_degrees())
        .collect();
    let mean = errors.iter().sum::<f64>() / errors.len() as f64;
    assert!(errors.len() > 10 && mean < 3.0, "{mean:.2} of {}", errors.len());
    let far = (0..graph.len()).find(|node| graph.positions[*node].distance(DVec3::new(-1.0, -1.0, 0.0)) < 0.01);
    let direction = field.direction(&graph, far.expect("a corner"));
    assert!(direction.dot(DVec3::X).abs() > 0.99, "far from guides the source holds: {direction}");
}

#[test]
fn constant_light_and_uv_fields_follow_their_source() {
    let mesh = prepare(Sample::Sphere.build(2_000)).expect("a sphere").mesh;
    let of = |source| field_of(&mesh, &FieldOptions { source, smoothing: 0.3, ..FieldOptions::default() });
    let flat = |p: DVec3, d: DVec3| {
        let n = p.normalize();
        let flat = d - n * d.dot(n);
        (flat.length() > 0.5).then_some(flat)
    };
    let (graph, field) = of(FieldSource::Constant(DVec3::X));
    assert!(error_deg(&graph, &field, |p| flat(p, DVec3::X)).0 < 1.0);
    let (graph, field) = of(FieldSource::Light(DVec3::X));
    assert!(error_deg(&graph, &field, |p| flat(p, DVec3::X).map(|flat| flat.cross(p))).0 < 1.0);
    let (graph, field) = of(FieldSource::Uv);
    let (mean, _) = error_deg(&graph, &field, |p| flat(p, DVec3::Y).map(|flat| flat.cross(p)));
    assert!(mean < 1.0, "{mean:.2}");
}

#[test]
fn soups_have_fields() {
    let triangle = |at: Vec3| [at, at + Vec3::X, at + Vec3::Y];
    let mut raw = RawMesh::default();
    for i in 0..5 {
        let first = raw.positions.len() as u32;
        raw.positions.extend(triangle(vec3(0.0, 0.0, 3.0 * i as f32)));
        raw.triangles.push([first, first + 1, first + 2]);
    }
    // Three triangles at one edge.
    let first = raw.positions.len() as u32;
    raw.positions.extend([Vec3::ZERO, Vec3::Z, Vec3::NEG_X, Vec3::NEG_Y, vec3(-1.0, 1.0, 0.0)]);
    raw.triangles.extend((2..5).map(|k| [first, first + 1, first + k]));
    let mesh = prepare(raw).expect("a soup").mesh;
    let (graph, field) = field_of(&mesh, &FieldOptions::default());
    assert!((0..graph.len()).all(|node| field.direction(&graph, node).is_finite()));
}
