//! Exponential maps against exact ones, and what patches promise.

use std::collections::BTreeMap;
use std::f64::consts::TAU;

use glam::DVec3;

use tam_shaders::cpu::lib::patches::OVERLAPS;

use super::*;
use crate::mesh::sample::Sample;
use crate::mesh::{Mesh, prepare};
use crate::surface::tests::sheet;
use crate::surface::{Surface, SurfaceOptions};

/// The node nearest to a place.
fn nearest(graph: &Graph, place: DVec3) -> u32 {
    let distance = |node: &usize| graph.positions[*node].distance_squared(place);
    (0..graph.len()).min_by(|a, b| distance(a).total_cmp(&distance(b))).expect("nodes") as u32
}

/// The greatest distance between places of the map and exact ones, both turned so that they agree best.
fn error(graph: &Graph, seed: u32, reach: f64, exact: impl Fn(DVec3) -> glam::DVec2) -> f64 {
    let map = exponential_map(graph, seed, reach);
    assert!(map.len() > 100, "{} nodes", map.len());
    let pairs: Vec<_> = map.iter().map(|(node, place)| (*place, exact(graph.positions[*node as usize]))).collect();
    let turn: f64 = {
        let (dot, perp) = pairs
            .iter()
            .fold((0.0, 0.0), |(dot, perp), (found, exact)| (dot + found.dot(*exact), perp + found.perp_dot(*exact)));
        perp.atan2(dot)
    };
    let turned = glam::DVec2::from_angle(turn);
    pairs.iter().map(|(found, exact)| turned.rotate(*found).distance(*exact)).fold(0.0, f64::max)
}

#[test]
fn the_map_of_a_plane_is_the_plane() {
    let mesh = sheet(40, 40, |u, v| DVec3::new(2.0 * u - 1.0, 2.0 * v - 1.0, 0.0));
    let graph = Graph::new(&mesh);
    let seed = nearest(&graph, DVec3::ZERO);
    let origin = graph.positions[seed as usize];
    // Positions are rounded to 24 bits.
    let error = error(&graph, seed, 0.6, |p| (p - origin).truncate());
    assert!(error < 1e-6, "{error:e}");
}

#[test]
fn the_map_of_a_cylinder_unrolls_it() {
    let radius = 0.4;
    let mesh = sheet(96, 60, |u, v| {
        let (sin, cos) = (u * TAU).sin_cos();
        DVec3::new(radius * cos, 2.0 * v - 1.0, -radius * sin)
    });
    let graph = Graph::new(&mesh);
    let seed = nearest(&graph, DVec3::new(radius, 0.0, 0.0));
    let origin = graph.positions[seed as usize];
    let around = |p: DVec3| (-p.z).atan2(p.x);
    let exact = |p: DVec3| glam::DVec2::new(radius * (around(p) - around(origin)), p.y - origin.y);
    let error = error(&graph, seed, 0.7, exact);
    // Faces cut the corners of 96 sides: chords are shorter by 0.02 %.
    assert!(error < 0.004 * 0.7, "{error}");
}

#[test]
fn the_map_of_a_sphere_keeps_distances_to_the_seed() {
    let mesh = prepare(Sample::Sphere.build(20_000)).expect("a sphere").mesh;
    let graph = Graph::new(&mesh);
    let seed = nearest(&graph, DVec3::new(0.6, 0.64, 0.48));
    let pole = graph.positions[seed as usize].normalize();
    let [x, y] = [graph.tangents[seed as usize], graph.bitangent(seed as usize)];
    let exact = |p: DVec3| {
        let p = p.normalize();
        let along = glam::DVec2::new(p.dot(x), p.dot(y)).normalize_or_zero();
        along * p.dot(pole).clamp(-1.0, 1.0).acos()
    };
    let error = error(&graph, seed, 0.7, exact);
    // The exact map stretches circles by r / sin r, 9 % at this radius; steps along them that keep their length pull
    // the map inwards by half as much.
    assert!(error < 0.045 * 0.7, "{error}");
}

fn surface(mesh: &Mesh) -> Surface {
    let options = SurfaceOptions { patches: Some(PatchOptions::default()), ..SurfaceOptions::default() };
    Surface::new(mesh, &options).expect("a field")
}

fn built(mesh: &Mesh) -> (Graph, Patches) {
    let surface = surface(mesh);
    (Graph::clone(&surface.graph), surface.patches.expect("patches were asked for"))
}

#[test]
fn every_triangle_has_patches_and_all_numbers_are_in_range() {
    for sample in Sample::ALL {
        for triangles in [1_000, 20_000] {
            let mesh = prepare(sample.build(triangles)).expect("a sample").mesh;
            let (_, patches) = built(&mesh);
            for face in 0..mesh.triangles.len() {
                let entries = patches.of(face);
                assert!((1..=OVERLAPS).contains(&entries.len()), "{} {face}", sample.name());
                for entry in entries {
                    assert!(entry.uv.iter().all(|uv| uv.is_finite()), "{} {face}", sample.name());
                    assert!(entry.behind.iter().all(|behind| (0.0..=4.0).contains(behind)));
                    // Planes of single triangles may be large; a patch never is.
                    let most = entry.uv.iter().map(|uv| uv.abs().max_element()).fold(0.0, f32::max);
                    assert!(entry.seed == u32::MAX || most < 4.0, "{} {face}: {most}", sample.name());
                }
            }
        }
    }
}

#[test]
fn weights_are_continuous_across_edges() {
    let mesh = prepare(Sample::Hand.build(20_000)).expect("a hand").mesh;
    let (graph, patches) = built(&mesh);
    // Weights of the seeds at the middle of the edge from corner k to k + 1.
    let weights = |face: usize, k: usize| -> BTreeMap<u32, f64> {
        let behind = |entry: &Entry| 0.5 * f64::from(entry.behind[k] + entry.behind[(k + 1) % 3]);
        let least = patches.of(face).iter().map(behind).fold(f64::INFINITY, f64::min);
        let raw: Vec<(u32, f64)> =
            patches.of(face).iter().map(|entry| (entry.seed, (1.0 - (behind(entry) - least)).max(0.0))).collect();
        let sum: f64 = raw.iter().map(|(_, weight)| weight).sum();
        raw.into_iter().map(|(seed, weight)| (seed, weight / sum)).collect()
    };
    let (mut edges, mut jumps) = (0, 0);
    for (face, neighbours) in mesh.neighbours.iter().enumerate() {
        for (k, other) in neighbours.iter().enumerate() {
            let Some(back) = mesh.neighbours.get(*other as usize) else { continue };
            let there = (0..3).find(|j| back[*j] == face as u32).expect("mutual");
            let ends = |face: usize, k: usize| [graph.triangles[face][k], graph.triangles[face][(k + 1) % 3]];
            let [a, b] = ends(face, k);
            if ends(*other as usize, there) != [b, a] {
                // A hard edge.
                continue;
            }
            edges += 1;
            let (here, beyond) = (weights(face, k), weights(*other as usize, there));
            let seeds = here.keys().chain(beyond.keys());
            let weight = |of: &BTreeMap<u32, f64>, seed: &u32| of.get(seed).copied().unwrap_or(0.0);
            let jump = seeds.map(|seed| (weight(&here, seed) - weight(&beyond, seed)).abs()).fold(0.0, f64::max);
            jumps += usize::from(jump > 0.02);
        }
    }
    // Where a patch meets itself round a fingertip it ends within an edge.
    assert!(edges > 20_000 && jumps * 100 < edges, "{jumps} of {edges}");
}

#[test]
fn surfaces_are_the_same_for_any_number_of_threads() {
    let mesh = prepare(Sample::Head.build(8_000)).expect("a head").mesh;
    let with = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("threads");
        let surface = pool.install(|| surface(&mesh));
        (surface.field, surface.patches)
    };
    assert_eq!(with(1), with(3));
}

#[test]
fn hard_edges_keep_patches_apart() {
    let mesh = prepare(Sample::Cube.build(12)).expect("a cube").mesh.subdivided(0.08);
    let (graph, patches) = built(&mesh);
    for face in 0..mesh.triangles.len() {
        let normal = |node: u32| graph.normals[node as usize];
        let own = normal(graph.triangles[face][0]);
        for entry in patches.of(face) {
            let seed = patches.seeds[entry.seed as usize].node;
            assert!(normal(seed).dot(own) > 0.99, "a patch of another side");
        }
    }
}

#[test]
fn meshes_of_any_kind_have_patches() {
    use crate::mesh::RawMesh;
    use glam::{Vec3, vec3};
    let single =
        RawMesh { positions: vec![Vec3::ZERO, Vec3::X, Vec3::Y], triangles: vec![[0, 1, 2]], ..RawMesh::default() };
    let mut fan = single.clone();
    fan.positions.extend([vec3(0.0, 0.0, 1.0), vec3(0.0, 0.0, -1.0), vec3(0.0, 5.0, 5.0)]);
    fan.triangles.extend([[0, 1, 3], [0, 1, 4], [3, 4, 5]]);
    for raw in [single, fan] {
        let mesh = prepare(raw).expect("a mesh").mesh;
        let fine = mesh.subdivided(PatchOptions::default().longest_edge() as f32);
        let (_, patches) = built(&fine);
        assert!((0..fine.triangles.len()).all(|face| !patches.of(face).is_empty()));
    }
}
