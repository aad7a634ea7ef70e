//! Corners carry what their triangles have, and share it.

use glam::DVec3;
use tam_shaders::cpu::Mapping;
use tam_shaders::cpu::lib::patches::{PLACE_RANGE, carried_overlap, fetched};
use tam_shaders::cpu::lib::stripes::wound_phase;

use super::*;
use crate::mesh::sample::Sample;
use crate::mesh::{Mesh, prepare};
use crate::surface::stripes::phase::stripe_phase;
use crate::surface::{LappedOptions, PatchOptions, StripeOptions, Surface, SurfaceOptions};

fn mesh(sample: Sample, triangles: usize) -> Mesh {
    prepare(sample.build(triangles)).expect("a sample").mesh
}

#[test]
fn corners_carry_the_patches_of_their_triangles_and_triangles_share_them() {
    for (sample, most) in [(Sample::Hand, 1.3), (Sample::TorusKnot, 1.3), (Sample::Cube, 3.0)] {
        for follow in [Follow::Surface, Follow::Light] {
            let mesh = mesh(sample, 20_000);
            let options = PatchOptions { follow, ..PatchOptions::default() };
            let surface = SurfaceOptions { patches: Some(options), ..SurfaceOptions::default() };
            let patches = Surface::new(&mesh, &surface).expect("a field").patches.expect("patches were asked for");
            let corners = Corners::of_patches(&mesh.triangles, &patches);
            for (face, triangle) in mesh.triangles.iter().enumerate() {
                for (k, vertex) in triangle.iter().enumerate() {
                    let corner = corners.indices[3 * face + k] as usize;
                    assert_eq!(corners.stands[corner], Stand::Vertex(*vertex));
                    let (places, behind) = fetched(&corners.patches[corner]);
                    let seeds = corners.seeds.get(corner).copied().unwrap_or_default();
                    let overlap = carried_overlap(Mapping::Patches, places, behind, seeds);
                    // Of each patch its place and distance, in any order; those that are not there are as far as can be.
                    for entry in patches.of(face) {
                        let is_it = |i: &usize| {
                            let (place, behind) = (overlap.places[*i], overlap.behind[*i]);
                            // Half a step of the codes; lone triangles may lie beyond their range.
                            let far = f64::from(entry.uv[k].abs().max_element()) > PLACE_RANGE;
                            (far || (place - entry.uv[k].as_dvec2()).abs().max_element() < 7e-5)
                                && (behind - f64::from(entry.behind[k])).abs() < 1e-6
                                && (follow == Follow::Surface || overlap.seeds[*i] == entry.seed)
                        };
                        assert!((0..OVERLAPS).any(|i| is_it(&i)), "{} {face} {k}: {overlap:?}", sample.name());
                    }
                    let near = overlap.behind.to_array().iter().filter(|behind| **behind < BEHIND_RANGE).count();
                    assert!(near <= patches.of(face).len());
                }
            }
            let per_triangle = corners.stands.len() as f64 / mesh.triangles.len() as f64;
            assert!(per_triangle < most, "{}: {per_triangle} corners a triangle", sample.name());
        }
    }
}

#[test]
fn lapped_textures_are_carried_in_the_order_of_painting() {
    let mesh = mesh(Sample::Hand, 8_000);
    let options = SurfaceOptions { lapped: Some(LappedOptions::default()), ..SurfaceOptions::default() };
    let lapped = Surface::new(&mesh, &options).expect("a field").lapped.expect("they were asked for");
    let corners = Corners::of_patches(&mesh.triangles, &lapped);
    let mut most = 0;
    for face in 0..mesh.triangles.len() {
        for k in 0..3 {
            let at = corners.indices[3 * face + k] as usize;
            let carried = [&corners.patches[at], &corners.over[at]].map(fetched);
            for i in 0..MAX_ENTRIES {
                let (places, alphas) = carried[i / OVERLAPS];
                let (place, alpha) = (PLACE_RANGE * places[i % OVERLAPS], alphas[i % OVERLAPS]);
                let Some(entry) = lapped.of(face).get(i) else {
                    assert_eq!(alpha, 0.0);
                    continue;
                };
                assert!((alpha - f64::from(entry.behind[k])).abs() < 1e-5, "{face} {k} {i}");
                assert!((place - entry.uv[k].as_dvec2()).abs().max_element() < 7e-5, "{face} {k} {i}");
                most = most.max(i + 1);
            }
        }
    }
    assert!(most > OVERLAPS, "{most} at most");
}

/// The phase of a field at a place of a triangle that is drawn, from what its corners carry.
fn phase_at(corners: &Corners, indices: [u32; 3], weights: DVec3, field: usize) -> f64 {
    let lines = indices.map(|index| corners.lines[index as usize]);
    let mean = |of: &dyn Fn(&LineCorner) -> f64| (0..3).map(|k| weights[k] * of(&lines[k])).sum::<f64>();
    let ends = DVec2::new(mean(&|line| f64::from(line.ring[0])), mean(&|line| f64::from(line.ring[1])));
    wound_phase(mean(&|line| f64::from(line.phases[field])), ends, f64::from(lines[0].ring[2 + field]))
}

#[test]
fn corners_carry_the_phases_of_their_triangles_wherever_lines_end() {
    for (sample, most) in [(Sample::Torus, 0.7), (Sample::Hand, 0.8), (Sample::Teapot, 1.2)] {
        let mesh = mesh(sample, 8_000);
        let options = SurfaceOptions { stripes: Some(StripeOptions::default()), ..SurfaceOptions::default() };
        let stripes = Surface::new(&mesh, &options).expect("a field").stripes.expect("they were asked for");
        let corners = Corners::of_stripes(&mesh.triangles, &stripes, None);
        for face in 0..mesh.triangles.len() as u32 {
            let range = corners.range_of(face..face + 1);
            let drawn = corners.indices[range.start as usize..range.end as usize].as_chunks::<3>().0;
            for (part, indices) in drawn.iter().enumerate() {
                // Of the part that is drawn, and of the mesh's triangle.
                let within = DVec3::new(0.5, 0.2, 0.3);
                let weights = match drawn.len() {
                    1 => within,
                    _ => {
                        let mut weights = DVec3::splat(within.z / 3.0);
                        weights[part] += within.x;
                        weights[(part + 1) % 3] += within.y;
                        weights
                    }
                };
                for (field, phases) in [&stripes.along, &stripes.across].into_iter().enumerate() {
                    let found = phase_at(&corners, *indices, within, field);
                    let expected = stripe_phase(&phases[face as usize], weights);
                    assert!((found - expected).abs() < 1e-5, "{} {face} {part}: {found}", sample.name());
                }
            }
        }
        assert!(!corners.parted.is_empty() || sample == Sample::Torus, "lines end somewhere");
        let per_triangle = corners.stands.len() as f64 / mesh.triangles.len() as f64;
        assert!(per_triangle < most, "{}: {per_triangle} corners a triangle", sample.name());
    }
}

#[test]
fn parts_of_a_mesh_are_found_among_triangles_drawn_in_three() {
    let corners = Corners { parted: vec![1, 4], ..Corners::default() };
    let found = [0..1, 1..2, 2..5, 5..6].map(|range| corners.range_of(range));
    assert_eq!(found, [0..3, 3..12, 12..27, 27..30]);
}
