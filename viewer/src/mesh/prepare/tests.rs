use std::collections::HashMap;

use glam::{Vec2, Vec3};
use proptest::prelude::*;

use crate::mesh::{Loaded, MeshError, MeshReport, NONE, RawMesh, RawPart, invariants, prepare};

fn raw(positions: &[[f32; 3]], triangles: &[[u32; 3]]) -> RawMesh {
    RawMesh {
        positions: positions.iter().copied().map(Vec3::from).collect(),
        triangles: triangles.to_vec(),
        ..Default::default()
    }
}

fn prepared(raw: RawMesh) -> Loaded {
    let loaded = prepare(raw).expect("a usable mesh");
    invariants::check(&loaded.mesh);
    loaded
}

/// A closed torus of `m` by `n` quads.
fn torus(m: u32, n: u32) -> RawMesh {
    let mut raw = RawMesh::default();
    for i in 0..m {
        for j in 0..n {
            let (u, v) = (i as f32 / m as f32, j as f32 / n as f32);
            let ((su, cu), (sv, cv)) = ((u * std::f32::consts::TAU).sin_cos(), (v * std::f32::consts::TAU).sin_cos());
            raw.positions.push(Vec3::new((3.0 + cv) * cu, (3.0 + cv) * su, sv));
            let at = |i: u32, j: u32| (i % m) * n + j % n;
            let [a, b, c, d] = [at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)];
            raw.triangles.extend([[a, b, c], [a, c, d]]);
        }
    }
    raw
}

/// A unit cube of twelve triangles, outward.
fn cube() -> RawMesh {
    let positions: Vec<[f32; 3]> =
        (0..8).map(|at| [0, 1, 2].map(|axis| f32::from(u8::from(at >> axis & 1 == 1)))).collect();
    let quads = [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]];
    let triangles: Vec<[u32; 3]> = quads.iter().flat_map(|&[a, b, c, d]| [[a, b, c], [a, c, d]]).collect();
    raw(&positions, &triangles)
}

#[test]
fn a_torus_is_closed_and_has_the_euler_characteristic_of_one() {
    let Loaded { mesh, report } = prepared(torus(24, 12));
    let expected = MeshReport {
        vertices: 288,
        points: 288,
        triangles: 576,
        parts: 1,
        components: 1,
        closed: true,
        euler: 0,
        ..Default::default()
    };
    assert_eq!(report, expected);
    assert!(report.notes().is_empty());
    assert_eq!(mesh.edges().len(), 576 * 3 / 2);
    // Outward: away from the tube's centre line.
    let scale = mesh.placement.scale as f32;
    for (position, normal) in mesh.positions.iter().zip(&mesh.normals) {
        let centre = Vec3::new(position.x, position.y, 0.0).normalize() * 3.0 * scale;
        // The mesh's smooth normals against the torus' own: 24 steps around leave a few degrees.
        assert!((*position - centre).normalize().dot(*normal) > 0.99);
    }
}

#[test]
fn randomly_turned_triangles_of_a_closed_mesh_are_turned_outward_again() {
    let whole = prepared(torus(16, 8)).mesh;
    for bits in [0x9e37_79b9_7f4a_7c15_u64, 0xffff_ffff_ffff_ffff, 0x0123_4567_89ab_cdef] {
        let mut turned = torus(16, 8);
        let flips = |face: usize| bits.rotate_left(face as u32 * 7) & 1 == 1;
        let count = (0..turned.triangles.len()).filter(|&face| flips(face)).count();
        for face in (0..turned.triangles.len()).filter(|&face| flips(face)) {
            turned.triangles[face].swap(0, 1);
        }
        let Loaded { mesh, report } = prepared(turned);
        assert_eq!(report.flipped, count);
        for (ours, theirs) in mesh.triangles.iter().zip(&whole.triangles) {
            let start = theirs.iter().position(|vertex| *vertex == ours[0]).expect("the same corners");
            assert_eq!(ours[1], theirs[(start + 1) % 3]);
        }
    }
}

#[test]
fn an_open_mesh_keeps_the_orientation_of_most_of_its_triangles() {
    let positions = [[0., 0., 0.], [1., 0., 0.], [2., 0., 0.], [0., 1., 0.], [1., 1., 0.]];
    let Loaded { mesh, report } = prepared(raw(&positions, &[[0, 1, 3], [4, 1, 3], [1, 2, 4]]));
    assert_eq!(report.flipped, 1);
    assert!(mesh.normals.iter().all(|normal| normal.z > 0.99));
    assert!(!report.closed);
    assert_eq!(report.boundary_edges, 5);
}

#[test]
fn a_moebius_strip_is_cut_once() {
    let count = 20;
    let mut strip = RawMesh::default();
    for at in 0..count {
        let angle = at as f32 / count as f32 * std::f32::consts::TAU;
        for side in [-1.0, 1.0] {
            let across =
                Vec3::new((angle / 2.0).cos() * angle.cos(), (angle / 2.0).cos() * angle.sin(), (angle / 2.0).sin());
            strip.positions.push(Vec3::new(angle.cos(), angle.sin(), 0.0) * 3.0 + across * side * 0.4);
        }
        let (a, b) = (at * 2, at * 2 + 1);
        // After one turn the sides have changed places.
        let (c, d) = if at + 1 < count { (a + 2, a + 3) } else { (1, 0) };
        strip.triangles.extend([[a, c, b], [b, c, d]]);
    }
    let Loaded { report, .. } = prepared(strip);
    assert_eq!((report.components, report.euler, report.cut_edges), (1, 0, 1));
    assert_eq!(report.boundary_edges, 2 * count as usize);
    assert!(!report.closed);
}

#[test]
fn three_triangles_at_an_edge_are_boundaries_to_each_other() {
    let positions = [[0., 0., 0.], [0., 0., 1.], [1., 0., 0.], [-1., 1., 0.], [-1., -1., 0.]];
    let Loaded { mesh, report } = prepared(raw(&positions, &[[0, 1, 2], [0, 1, 3], [0, 1, 4]]));
    assert_eq!((report.non_manifold_edges, report.boundary_edges, report.components), (1, 6, 3));
    assert!(mesh.neighbours.iter().flatten().all(|&other| other == NONE));
    assert_eq!(mesh.edges().len(), 7);
}

#[test]
fn a_bow_tie_shares_a_point_but_no_normal() {
    let positions = [[0., 0., 0.], [1., 0., 0.], [1., 1., 0.], [-1., 0., 0.], [-1., 0., 1.]];
    let Loaded { mesh, report } = prepared(raw(&positions, &[[0, 1, 2], [0, 3, 4]]));
    assert_eq!((report.components, report.points, report.vertices), (2, 5, 6));
    assert_eq!(mesh.normal_groups.iter().collect::<std::collections::HashSet<_>>().len(), 6);
}

#[test]
fn a_cube_has_creases_and_a_triangle_soup_of_it_welds() {
    let indexed = prepared(cube());
    assert_eq!((indexed.report.points, indexed.report.vertices, indexed.report.flipped), (8, 24, 0));
    let soup = cube();
    let positions: Vec<[f32; 3]> =
        soup.triangles.iter().flatten().map(|&vertex| soup.positions[vertex as usize].to_array()).collect();
    let triangles: Vec<[u32; 3]> = (0..12).map(|face| [face * 3, face * 3 + 1, face * 3 + 2]).collect();
    let soup = prepared(raw(&positions, &triangles));
    assert_eq!((soup.report.points, soup.report.vertices, soup.report.welded), (8, 24, 28));
    assert!(soup.report.closed);
    for mesh in [&indexed.mesh, &soup.mesh] {
        for normal in &mesh.normals {
            assert!(normal.abs().max_element() > 0.999_999, "{normal} is along an axis");
        }
    }
}

#[test]
fn vertices_weld_within_a_millionth_of_the_diagonal_and_not_beyond() {
    // Diagonal √2, tolerance 1.41e-6.
    let corners = |gap: f32| {
        let positions = [[0., 0., 0.], [1., 0., 0.], [0., 1., 0.], [1. - gap, 0., 0.], [1., 1., 0.], [-0.0, 1., -0.0]];
        prepared(raw(&positions, &[[0, 1, 2], [3, 4, 5]])).report
    };
    let near = corners(1.2e-6);
    assert_eq!((near.points, near.welded, near.components), (4, 2, 1));
    let far = corners(1.8e-6);
    assert_eq!((far.points, far.welded, far.components), (5, 1, 2));
}

#[test]
fn what_is_unusable_is_dropped_and_counted() {
    let mut mesh = cube();
    mesh.positions.extend([
        Vec3::new(f32::NAN, 0.0, 0.0),
        Vec3::new(0.0, f32::INFINITY, 0.0),
        Vec3::splat(0.5),
        Vec3::new(9e9, 9e9, 9e9),
    ]);
    mesh.triangles
        .splice(3..3, [[0, 1, 8], [9, 1, 2], [0, 1, 77], [4, 4, 5], [0, 0, 11], [2, 0, 3], [3, 2, 0], [0, 10, 7]]);
    let Loaded { mesh, report } = prepared(mesh);
    assert_eq!(report.dropped_non_finite, 2);
    assert_eq!(report.dropped_out_of_range, 1);
    // The diagonal from 0 to 7 passes through the centre.
    assert_eq!(report.dropped_degenerate, 3);
    assert_eq!(report.dropped_doubled, 2);
    assert_eq!(report.dropped_vertices, 4);
    assert_eq!(mesh.triangles.len(), 12);
    assert!(report.closed);
    assert_eq!(report.notes().len(), 4);
}

#[test]
fn slivers_stay_and_are_counted() {
    let positions = [[0., 0., 0.], [1., 0., 0.], [0.5, 1e-6, 0.], [0.5, 1., 0.]];
    let report = prepared(raw(&positions, &[[0, 1, 2], [0, 2, 3]])).report;
    assert_eq!((report.slivers, report.triangles), (1, 2));
}

#[test]
fn nothing_usable_is_an_error_that_says_why() {
    let error = prepare(raw(&[[0., 0., 0.], [1., 1., 1.]], &[[0, 0, 1], [0, 1, 5]])).expect_err("nothing usable");
    assert!(matches!(error, MeshError::Nothing { triangles: 2, out_of_range: 1, degenerate: 1, .. }), "{error}");
    assert!(matches!(prepare(RawMesh::default()), Err(MeshError::Nothing { triangles: 0, .. })));
}

#[test]
fn a_mesh_that_contradicts_itself_is_an_error() {
    let uvs = RawMesh { uvs: vec![Vec2::ZERO; 3], ..cube() };
    assert!(matches!(prepare(uvs), Err(MeshError::Lengths { given: 3, vertices: 8, .. })));
    let part = |triangles| RawPart { name: String::new(), colour: None, triangles };
    for parts in [vec![part(0..4)], vec![part(0..5), part(4..12)], vec![part(0..13)]] {
        assert!(matches!(prepare(RawMesh { parts, ..cube() }), Err(MeshError::Parts { .. })));
    }
}

#[test]
fn parts_keep_their_triangles_and_empty_ones_go() {
    let mut mesh = cube();
    mesh.triangles[5] = [0, 0, 1];
    let part = |name: &str, triangles| RawPart { name: name.into(), colour: None, triangles };
    mesh.parts = vec![part("a", 0..5), part("b", 5..6), part("c", 6..12)];
    let mesh = prepared(mesh).mesh;
    assert_eq!(mesh.parts.iter().map(|part| part.name.as_str()).collect::<Vec<_>>(), ["a", "c"]);
    assert_eq!((mesh.part_of(4), mesh.part_of(5), mesh.part_of(10)), (0, 1, 1));
}

#[test]
fn placement_loses_nothing_far_away_or_at_extreme_sizes() {
    let near = prepared(torus(12, 8)).mesh;
    let moved = |scale: f32, offset: f32| {
        let mut raw = torus(12, 8);
        raw.positions.iter_mut().for_each(|position| *position = *position * scale + Vec3::splat(offset));
        prepared(raw)
    };
    // Half a step of f32 at 1e6 is 0.03, on a side of 8e4.
    for (scale, offset, tolerance) in [(1e4, 1e6, 2e-6), (1e-30, 0.0, 1e-6), (1e30, 0.0, 1e-6)] {
        let Loaded { mesh, report } = moved(scale, offset);
        assert!(report.closed, "{scale}");
        for (ours, theirs) in mesh.positions.iter().zip(&near.positions) {
            assert!(ours.distance(*theirs) < tolerance, "{ours} {theirs} at {scale}");
        }
        let back = mesh.placement.file_from_mesh(mesh.positions[5]);
        let there = torus(12, 8).positions[mesh.sources[5] as usize] * scale + Vec3::splat(offset);
        // Half a step of f32 near 1, on each axis, of half a side of 4 units.
        let error = back.distance(there.as_dvec3()) / f64::from(scale);
        assert!(error < 4.0 * 6e-8 * 3.0, "{error}");
    }
}

#[test]
fn vertices_split_at_uv_seams_only() {
    let positions = [[0., 0., 0.], [1., 0., 0.], [0., 1., 0.], [1., 0., 0.], [1., 1., 0.], [0., 1., 0.]];
    let mut mesh = raw(&positions, &[[0, 1, 2], [3, 4, 5]]);
    mesh.uvs = [[0., 0.], [1., 0.], [0., 1.], [1., 0.], [1., 1.], [0.5, 1.]].map(Vec2::from).to_vec();
    let Loaded { mesh, report } = prepared(mesh);
    assert_eq!((report.points, report.vertices), (4, 5));
    assert_eq!(mesh.sources, [0, 1, 2, 4, 5]);
    assert!(report.has_uv);
    assert_eq!(mesh.neighbours, [[NONE, 1, NONE], [NONE, NONE, 0]]);
}

#[test]
fn uv_density_is_repeats_per_mesh_unit() {
    // One repeat on a side of 1, which becomes a side of 2.
    let mut mesh = raw(&[[0., 0., 0.], [1., 0., 0.], [1., 1., 0.], [0., 1., 0.]], &[[0, 1, 2], [0, 2, 3]]);
    assert_eq!(prepared(mesh.clone()).mesh.uv_density(), None);
    mesh.uvs = [[0., 0.], [1., 0.], [1., 1.], [0., 1.]].map(Vec2::from).to_vec();
    assert_eq!(prepared(mesh).mesh.uv_density(), Some(0.5));
}

#[test]
fn normals_of_the_file_hold_unless_they_are_unusable_or_opposed() {
    let mut mesh = raw(&[[0., 0., 0.], [1., 0., 0.], [0., 1., 0.], [1., 1., 0.]], &[[0, 1, 2], [2, 1, 3]]);
    let tilted = Vec3::new(0.6, 0.0, 0.8);
    mesh.normals = vec![tilted * 5.0, Vec3::ZERO, -Vec3::Z, Vec3::splat(f32::NAN)];
    let Loaded { mesh, report } = prepared(mesh);
    assert!(mesh.normals[0].distance(tilted) < 1e-6);
    assert!(mesh.normals[1..].iter().all(|normal| normal.distance(Vec3::Z) < 1e-6));
    assert_eq!((report.normals_from_file, report.normals_refused), (1, 5));
}

#[test]
fn turned_triangles_turn_the_normals_that_went_with_them() {
    // A closed cube inside out, with normals that agree with its faces.
    let mut mesh = cube();
    mesh.triangles.iter_mut().for_each(|triangle| triangle.swap(0, 1));
    mesh.normals = mesh.positions.iter().map(|position| Vec3::splat(0.5) - position).collect();
    let Loaded { mesh, report } = prepared(mesh);
    assert_eq!((report.flipped, report.normals_refused, report.vertices), (12, 0, 8));
    assert!(mesh.positions.iter().zip(&mesh.normals).all(|(position, normal)| position.dot(*normal) > 0.99));
}

#[test]
fn normals_follow_a_deformation_and_do_not_depend_on_threads() {
    let mesh = prepared(torus(40, 20)).mesh;
    let squashed: Vec<Vec3> = mesh.positions.iter().map(|position| *position * Vec3::new(1.0, 1.0, 0.01)).collect();
    let normals_with = |threads| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("threads");
        let mut normals = Vec::new();
        pool.install(|| mesh.normals_of(&squashed, &mut normals));
        normals
    };
    let one = normals_with(1);
    assert_eq!(one, normals_with(3));
    let upright = one.iter().filter(|normal| normal.z.abs() > 0.99).count();
    assert!(upright > one.len() * 8 / 10, "{upright} of {}", one.len());

    let mut collapsed = Vec::new();
    mesh.normals_of(&vec![Vec3::ONE; squashed.len()], &mut collapsed);
    assert_eq!(collapsed, mesh.normals);
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 300, failure_persistence: None, ..Default::default() })]

    #[test]
    fn neighbours_are_those_of_a_search_through_all_pairs(
        places in prop::collection::vec((0_u8..4, 0_u8..4, 0_u8..3), 4..14),
        picks in prop::collection::vec((0_usize..14, 0_usize..14, 0_usize..14), 1..40),
    ) {
        let positions: Vec<[f32; 3]> = places.iter().map(|&(x, y, z)| [x, y, z].map(f32::from)).collect();
        let pick = |at: usize| (at % positions.len()) as u32;
        let triangles: Vec<[u32; 3]> = picks.iter().map(|&(a, b, c)| [pick(a), pick(b), pick(c)]).collect();
        let source = raw(&positions, &triangles);
        let Ok(Loaded { mesh, report }) = prepare(source.clone()) else { return Ok(()) };
        invariants::check(&mesh);

        // Points are equal positions: all are more than the tolerance apart, or equal.
        let corner_points = |face: usize| mesh.triangles[face].map(|vertex| mesh.points[vertex as usize]);
        let edge = |face: usize, k: usize| {
            let points = corner_points(face);
            let mut edge = [points[k], points[(k + 1) % 3]];
            edge.sort_unstable();
            edge
        };
        let faces = mesh.triangles.len();
        let mut cut = 0;
        let mut counts: HashMap<[u32; 2], usize> = HashMap::new();
        for face in 0..faces {
            for k in 0..3 {
                *counts.entry(edge(face, k)).or_default() += 1;
                let others: Vec<usize> = (0..faces)
                    .filter(|&other| other != face && (0..3).any(|j| edge(other, j) == edge(face, k)))
                    .collect();
                match (mesh.neighbours[face][k], &others[..]) {
                    (NONE, [_]) => cut += 1,
                    (NONE, _) => {}
                    (neighbour, &[other]) => prop_assert_eq!(neighbour as usize, other),
                    (neighbour, _) => prop_assert!(false, "{} beside {:?}", neighbour, others),
                }
            }
        }
        prop_assert_eq!(cut, report.cut_edges * 2);
        prop_assert_eq!(counts.values().filter(|&&count| count == 1).count(), report.boundary_edges);
        prop_assert_eq!(counts.values().filter(|&&count| count > 2).count(), report.non_manifold_edges);
        prop_assert_eq!(report.euler, mesh.point_count as i64 - counts.len() as i64 + faces as i64);
        let distinct = |face: usize| { let mut points = corner_points(face); points.sort_unstable(); points };
        let sets: std::collections::HashSet<[u32; 3]> = (0..faces).map(distinct).collect();
        prop_assert_eq!(sets.len(), faces);
        prop_assert_eq!(faces + report.dropped_degenerate + report.dropped_doubled, source.triangles.len());
    }
}
