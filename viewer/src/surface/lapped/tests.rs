//! Lapped patches against exact maps, and what must hold on any mesh.

use std::collections::{BTreeMap, BTreeSet};
use std::f64::consts::{PI, TAU};

use glam::{DVec3, Vec2, Vec3, vec3};

use super::faces::{Face, NONE, faces};
use super::grow::Patch;
use super::*;
use crate::mesh::sample::Sample;
use crate::mesh::{Mesh, RawMesh, prepare};
use crate::surface::FieldOptions;
use crate::surface::patches::{Entry, MAX_ENTRIES};
use crate::surface::tests::{field_of, sheet};

/// Of the patches that tests grow.
const TILES_PER_UNIT: f64 = 1.5;

fn sample(sample: Sample, triangles: usize) -> Mesh {
    prepare(sample.build(triangles)).expect("a sample").mesh
}

fn cylinder() -> Mesh {
    sheet(64, 64, |u, v| {
        let (sin, cos) = (u * TAU).sin_cos();
        DVec3::new(0.5 * cos, 2.0 * v, -0.5 * sin)
    })
}

fn soup() -> Mesh {
    let mut raw = RawMesh::default();
    for i in 0..5 {
        let (first, at) = (raw.positions.len() as u32, vec3(0.0, 0.0, 3.0 * i as f32));
        raw.positions.extend([at, at + Vec3::X, at + Vec3::Y]);
        raw.triangles.push([first, first + 1, first + 2]);
    }
    // Three triangles at one edge, and one that is all but a line.
    let first = raw.positions.len() as u32;
    raw.positions.extend([Vec3::ZERO, Vec3::Z, Vec3::NEG_X, Vec3::NEG_Y, vec3(-1.0, 1.0, 0.0), vec3(0.0, 1e-5, 0.5)]);
    raw.triangles.extend((2..6).map(|k| [first, first + 1, first + k]));
    prepare(raw).expect("a soup").mesh
}

fn one_triangle() -> Mesh {
    let positions = vec![Vec3::ZERO, Vec3::X, Vec3::Y];
    prepare(RawMesh { positions, triangles: vec![[0, 1, 2]], ..RawMesh::default() }).expect("a triangle").mesh
}

fn patches_of(mesh: &Mesh) -> (Graph, Patches) {
    let (graph, field) = field_of(mesh, &FieldOptions::default());
    let patches = lapped(&graph, &field, &LappedOptions::default()).expect("patches");
    (graph, patches)
}

/// Patches grown around seeds spread over a surface, and their outlines.
fn grown(mesh: &Mesh, radius_tiles: f64) -> (Graph, Vec<Face>, Vec<(Patch, Outline)>) {
    let (graph, field) = field_of(mesh, &FieldOptions::default());
    let faces = faces(&graph, &field);
    let mut grower = Grower::new(&graph, &faces, TILES_PER_UNIT);
    let patches = (0..12)
        .map(|i| {
            let outline = Outline::new(radius_tiles, 0.3, &mut Draw::new(i as u64, "test"));
            (grower.grow((i * faces.len() / 12) as u32, &outline).expect("a patch"), outline)
        })
        .collect();
    (graph, faces, patches)
}

#[test]
fn every_triangle_is_covered_and_its_first_patch_is_opaque() {
    let samples = Sample::ALL.map(|kind| sample(kind, 1_500));
    for mesh in samples.iter().chain([&soup(), &one_triangle()]) {
        let (graph, field) = field_of(mesh, &FieldOptions::default());
        let options = LappedOptions::default();
        let (_, cover) = painted(&graph, &field, &options).expect("patches");
        let patches = lapped(&graph, &field, &options).expect("patches");
        assert_eq!(patches.starts.len(), mesh.triangles.len() + 1);
        for face in 0..mesh.triangles.len() {
            // Before the first is made opaque, next to nothing shows through all of them. The middle is none of the
            // places at which the cover is looked at.
            let places = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0], [1.0 / 3.0; 3]];
            for place in places {
                let alpha = |entry: &Entry| (0..3).map(|k| place[k] * f64::from(entry.behind[k])).sum::<f64>();
                let through: f64 = cover.of(face).iter().map(|entry| 1.0 - alpha(entry)).product();
                assert!(through < 0.02, "{} {face}: {through}", mesh.name);
            }
            let entries = patches.of(face);
            assert!((1..=MAX_ENTRIES).contains(&entries.len()), "{} {face}", mesh.name);
            assert_eq!(entries[0].behind, [1.0; 3]);
            let last = &cover.of(face)[cover.of(face).len() - entries.len()..];
            let last: Vec<Entry> = last.iter().map(|entry| entry.in_steps(true)).collect();
            assert!(entries[0].uv == last[0].uv && entries[1..] == last[1..], "the last painted, in their order");
            for entry in entries {
                assert!(entry.uv.iter().all(|uv| uv.abs().max_element() < 4.0), "{} {face}: {entry:?}", mesh.name);
                assert!(entry.behind.iter().all(|alpha| (0.0..=1.0).contains(alpha)));
            }
        }
    }
}

#[test]
fn places_and_alphas_are_continuous_within_a_patch() {
    for kind in [Sample::Hand, Sample::Teapot] {
        let mesh = sample(kind, 3_000);
        let (graph, field) = field_of(&mesh, &FieldOptions::default());
        let (seeds, cover) = painted(&graph, &field, &LappedOptions::default()).expect("patches");
        let mut known: BTreeMap<(u32, u32), (Vec2, f32)> = BTreeMap::new();
        let mut shared = 0;
        for (face, nodes) in graph.triangles.iter().enumerate() {
            for entry in cover.of(face) {
                for (k, node) in nodes.iter().enumerate() {
                    let here = (entry.uv[k], entry.behind[k]);
                    shared += usize::from(known.contains_key(&(entry.seed, *node)));
                    assert_eq!(*known.entry((entry.seed, *node)).or_insert(here), here, "{} {face}", kind.name());
                }
            }
        }
        assert!(shared > mesh.triangles.len() && seeds.len() > 20);
    }
}

/// Mean angle in degrees between the strokes, the lines of constant t, and a direction; and the mean distance of lines
/// one tile apart, in tiles; over all that is painted.
fn along_deg(graph: &Graph, patches: &Patches, wanted: impl Fn(DVec3) -> DVec3) -> (f64, f64) {
    let (mut angle_sum, mut width_sum, mut total) = (0.0, 0.0, 0.0);
    for (face, nodes) in graph.triangles.iter().enumerate() {
        let [a, b, c] = nodes.map(|node| graph.positions[node as usize]);
        let wanted = wanted((a + b + c) / 3.0).normalize();
        let doubled_area = (b - a).cross(c - a).length();
        for entry in patches.of(face) {
            let [_, first, second] = entry.uv.map(|uv| (uv - entry.uv[0]).as_dvec2());
            let along = (b - a) * second.y - (c - a) * first.y;
            angle_sum += doubled_area * along.normalize().dot(wanted).abs().min(1.0).acos().to_degrees();
            // The gradient of t is as long as `along`, over twice the area.
            width_sum += doubled_area * doubled_area / along.length() * patches.tiles_per_unit;
            total += doubled_area;
        }
    }
    (angle_sum / total, width_sum / total)
}

#[test]
fn strokes_follow_the_field() {
    let (graph, patches) = patches_of(&cylinder());
    let (mean, width) = along_deg(&graph, &patches, |p| DVec3::new(-p.z, 0.0, p.x));
    // The field itself is half a degree off.
    assert!(mean < 1.0 && (width - 1.0).abs() < 0.01, "{mean:.2} {width:.3}");

    let (graph, patches) = patches_of(&sample(Sample::Torus, 10_000));
    let extent = graph.positions.iter().fold(DVec3::ZERO, |extent, p| extent.max(p.abs()));
    let axis = if extent.y < extent.z { DVec3::Y } else { DVec3::Z };
    let ring = extent.max_element() - extent.dot(axis);
    let (mean, width) = along_deg(&graph, &patches, |p| {
        let around = axis.cross(p).normalize();
        around.cross(p - around.cross(axis) * ring)
    });
    // A torus bends both ways, so that a patch can follow the field only on the whole.
    assert!(mean < 4.0 && (width - 1.0).abs() < 0.03, "{mean:.2} {width:.3}");
}

#[test]
fn a_patch_of_a_cylinder_keeps_all_lengths() {
    let (_, faces, patches) = grown(&cylinder(), 0.45);
    for (patch, _) in patches {
        assert!(patch.members.len() > 100);
        for member in &patch.members {
            for k in 0..3 {
                let [from, to] = [k, (k + 1) % 3].map(|k| patch.places[member.nodes[k] as usize]);
                let [a, b] = [k, (k + 1) % 3].map(|k| faces[member.face as usize].corners[k]);
                let stretch = from.distance(to) / (TILES_PER_UNIT * a.distance(b));
                // Near the ends of the sheet the field is half a degree off, 0.9 %.
                assert!((stretch - 1.0).abs() < 0.01, "{stretch}");
            }
        }
    }
}

#[test]
fn patches_are_discs() {
    let cases = [(Sample::Hand, 0.45), (Sample::Sphere, 4.0), (Sample::Torus, 2.0), (Sample::Teapot, 1.0)];
    for (kind, radius_tiles) in cases {
        let (_, _, patches) = grown(&sample(kind, 3_000), radius_tiles);
        for (patch, _) in patches {
            let mut edges: BTreeMap<[u32; 2], usize> = BTreeMap::new();
            for member in &patch.members {
                for k in 0..3 {
                    let (a, b) = (member.nodes[k], member.nodes[(k + 1) % 3]);
                    *edges.entry([a.min(b), a.max(b)]).or_default() += 1;
                }
            }
            assert_eq!(patch.nodes.len() + patch.members.len(), edges.len() + 1, "{}", kind.name());
            // One border, which passes through each of its nodes once.
            let border: Vec<[u32; 2]> = edges.iter().filter(|(_, count)| **count == 1).map(|(edge, _)| *edge).collect();
            let nodes: BTreeSet<u32> = border.iter().flatten().copied().collect();
            assert!(border.len() == nodes.len() && !border.is_empty(), "{}", kind.name());
        }
    }
}

/// A square whose diagonals all run the same way.
fn grid(steps: u32) -> Mesh {
    let mut raw = RawMesh::default();
    for row in 0..=steps {
        raw.positions.extend((0..=steps).map(|column| vec3(column as f32, row as f32, 0.0)));
    }
    for (row, column) in (0..steps).flat_map(|row| (0..steps).map(move |column| (row, column))) {
        let [a, b] = [row, row + 1].map(|row| row * (steps + 1) + column);
        raw.triangles.extend([[a, a + 1, b + 1], [a, b + 1, b]]);
    }
    prepare(raw).expect("a grid").mesh
}

#[test]
fn patches_fill_their_outline() {
    for mesh in [cylinder(), grid(100)] {
        let (_, _, patches) = grown(&mesh, 0.45);
        for (patch, outline) in patches {
            let inside = |node: &u32| outline.depth(patch.places[*node as usize]) > 0.0;
            // The last two in a hundred triangles may be missing.
            let early = patch.rim.iter().filter(|edge| edge.iter().all(inside)).count();
            assert!(20 * early <= patch.rim.len(), "{early} of {}", patch.rim.len());
        }
    }
}

#[test]
fn patches_do_not_reach_round_what_they_cannot_follow() {
    for kind in [Sample::Hand, Sample::Head] {
        let (_, faces, patches) = grown(&sample(kind, 8_000), 0.45);
        for (patch, _) in patches {
            let area: f64 = patch.members.iter().map(|member| faces[member.face as usize].doubled_area() / 2.0).sum();
            // Without a bound on detours one patch takes half of the hand.
            let circle = PI * (0.45 * 1.3 / TILES_PER_UNIT).powi(2);
            assert!(area < 1.5 * circle, "{}: {:.2} of the circle", kind.name(), area / circle);
        }
    }
}

#[test]
fn no_triangle_is_seen_turned_over() {
    for kind in Sample::ALL {
        let (graph, field) = field_of(&sample(kind, 3_000), &FieldOptions::default());
        let (_, cover) = painted(&graph, &field, &LappedOptions::default()).expect("patches");
        let turned = faces(&graph, &field)
            .iter()
            .enumerate()
            .filter(|(_, face)| !face.is_sliver())
            .flat_map(|(face, _)| cover.of(face))
            .filter(|entry| (entry.uv[1] - entry.uv[0]).perp_dot(entry.uv[2] - entry.uv[0]) <= 0.0)
            .count();
        assert_eq!(turned, 0, "{}", kind.name());
    }
}

#[test]
fn patches_do_not_depend_on_the_number_of_threads() {
    let mesh = sample(Sample::Hand, 3_000);
    let of = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("a pool");
        pool.install(|| patches_of(&mesh).1)
    };
    let one = of(1);
    assert!(one == of(2) && one == of(5));
}

#[test]
fn patches_end_at_hard_edges() {
    let (graph, faces, patches) = grown(&sample(Sample::Cube, 600), 1.0);
    for (patch, _) in patches {
        let normal = |face: u32| graph.normals[graph.triangles[face as usize][0] as usize];
        let first = normal(patch.members[0].face);
        assert!(patch.members.iter().all(|member| normal(member.face).dot(first) > 0.99));
    }
    assert!(faces.iter().any(|face| face.neighbours.contains(&NONE)));
}

#[test]
fn outlines_are_irregular_and_no_edge_steps_over_them() {
    let outlines: Vec<Outline> = (0..20).map(|i| Outline::new(0.5, 0.3, &mut Draw::new(i, "test"))).collect();
    for outline in &outlines {
        let ray = |degree: i32| DVec2::from_angle(f64::from(degree).to_radians());
        let radii: Vec<f64> = (0..360).map(|degree| outline.depth(ray(degree)) + 1.0).collect();
        let (least, most) = radii.iter().fold((f64::MAX, 0.0_f64), |(least, most), r| (least.min(*r), most.max(*r)));
        assert!(least >= 0.35 - 1e-9 && most <= 0.65 + 1e-9 && most - least > 0.08, "{least} {most}");
        let mean = radii.iter().sum::<f64>() / 360.0;
        assert!((mean - 0.5).abs() < 1e-9);
        assert!(outline.meets(DVec2::new(-9.0, 0.1), DVec2::new(50.0, 0.1)));
        assert!(!outline.meets(DVec2::new(-9.0, 0.7), DVec2::new(50.0, 0.7)));
    }
    assert!(outlines[0] != outlines[1]);
}

#[test]
fn alphas_reach_the_shaders_whole() {
    let entry = Entry { seed: 0, uv: [Vec2::ZERO; 3], behind: [1.0, 0.5, 0.0] };
    assert_eq!(entry.share_codes(true), [65_535, 32_768, 0]);
    // As distances they are quarters of the range.
    assert_eq!(entry.share_codes(false), [16_384, 8_192, 0]);
    let (_, patches) = patches_of(&one_triangle());
    assert_eq!(patches.entries[0].share_codes(true), [65_535; 3]);
}
