//! How opaque a patch is at its nodes: a ramp along the outline, and one along its rim where it ended before. Ramps that
//! begin close to the seed are narrower, so that its surroundings are covered.

use glam::DVec2;

use super::faces::Face;
use super::flatten::Member;
use super::grow::Patch;
use super::outline::{Outline, nearest};

/// Places in a patch must keep the lengths of a triangle within this factor.
const GREATEST_STRETCH: f64 = 1.7;

/// Whether a patch shows a triangle without a fold, and not much stretched.
pub(super) fn is_sound(faces: &[Face], patch: &Patch, member: &Member, tiles_per_unit: f64) -> bool {
    let face = &faces[member.face as usize];
    let [a, b, c] = member.nodes.map(|node| patch.places[node as usize]);
    let longest = face.longest_edge() * tiles_per_unit;
    let keeps_lengths = (0..3).all(|k| {
        let [from, to] = [k, (k + 1) % 3].map(|k| patch.places[member.nodes[k] as usize]);
        let (found, wanted) = (from.distance(to), face.corners[k].distance(face.corners[(k + 1) % 3]) * tiles_per_unit);
        found <= GREATEST_STRETCH * wanted + 0.05 * longest && wanted <= GREATEST_STRETCH * found + 0.05 * longest
    });
    // A sliver may turn over by a rounding error; it is not seen.
    keeps_lengths && ((b - a).perp_dot(c - a) > 0.0 || face.is_sliver())
}

/// Takes the triangles that a patch does not show soundly out of it, except the seed: it ends before them.
pub(super) fn cut_folds(faces: &[Face], patch: &mut Patch, tiles_per_unit: f64) {
    let seed = patch.members[0].face;
    let stays = |member: &Member| member.face == seed || is_sound(faces, patch, member, tiles_per_unit);
    let (sound, folded): (Vec<Member>, Vec<Member>) = patch.members.iter().partition(|member| stays(member));
    patch.rim.extend(folded.iter().flat_map(|member| (0..3).map(|k| [member.nodes[k], member.nodes[(k + 1) % 3]])));
    patch.members = sound;
}

/// Alpha of each node of a patch, 0..=1. The seed is opaque, so that every patch covers something.
pub(super) fn alphas(patch: &Patch, outline: &Outline, feather_tiles: f64) -> Vec<f64> {
    let depths: Vec<f64> = patch.places.iter().map(|place| outline.depth(*place)).collect();
    let ends: Vec<([DVec2; 2], f64)> = patch
        .rim
        .iter()
        .copied()
        // Rim outside the outline is where patches are meant to end.
        .filter(|edge| edge.iter().any(|node| depths[*node as usize] > 0.0))
        .map(|edge| {
            let [from, to] = edge.map(|node| patch.places[node as usize]);
            ([from, to], feather_tiles.min(0.5 * nearest(DVec2::ZERO, from, to).length()).max(1e-6))
        })
        .collect();
    let mut alphas: Vec<f64> = patch
        .places
        .iter()
        .zip(&depths)
        .map(|(place, depth)| {
            let ramp =
                |([from, to], feather): &([DVec2; 2], f64)| place.distance(nearest(*place, *from, *to)) / feather;
            ends.iter().map(ramp).fold(depth.max(0.0) / feather_tiles, f64::min).min(1.0)
        })
        .collect();
    for node in patch.members[0].nodes {
        alphas[node as usize] = 1.0;
    }
    alphas
}
