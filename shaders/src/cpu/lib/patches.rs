//! Twin of `lib/patches.wgsl`: overlapping parametrisations of a surface, carried by the corners of triangles.

use glam::{DVec2, DVec3, DVec4};

use super::material::{Material, tile_uv};
use crate::cpu::builtin::unpack2x16unorm;
use crate::cpu::{Follow, Mapping};
use crate::types::PatchCorner;

/// Patches that a fragment blends at most.
pub const OVERLAPS: usize = 4;
/// Copies of a patch that follows the light.
pub const TURNS: usize = 3;
/// Where an entry has no seed.
pub const NO_SEED: u32 = u32::MAX;
/// Greatest place on the tile that a record holds, in tiles.
pub const PLACE_RANGE: f64 = 4.0;
/// Greatest distance behind the nearest patch that a record holds, in feathers.
pub const BEHIND_RANGE: f64 = 4.0;

/// The patches that overlap at a fragment, interpolated between the corners; those that are not there stand far behind,
/// or have no alpha.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Overlap {
    /// Places on the tile.
    pub places: [DVec2; OVERLAPS],
    /// Distances behind the nearest, in feathers; of lapped textures the alphas.
    pub behind: DVec4,
    /// The same for all corners of a triangle; [`NO_SEED`] where none is known.
    pub seeds: [u32; OVERLAPS],
}

impl Overlap {
    /// Between the corners of a triangle.
    pub fn mixed(weights: DVec3, corners: [Self; 3]) -> Self {
        let weights = weights.to_array();
        let places = |i: usize| (0..3).map(|k| corners[k].places[i] * weights[k]).sum();
        Self {
            places: std::array::from_fn(places),
            behind: (0..3).map(|k| corners[k].behind * weights[k]).sum(),
            seeds: corners[0].seeds,
        }
    }
}

/// The code of a place on the tile; places beyond [`PLACE_RANGE`] are clamped.
pub fn pack_place(place: DVec2) -> u32 {
    let [x, y] = (place / PLACE_RANGE).clamp(DVec2::NEG_ONE, DVec2::ONE).to_array();
    let half = |x: f64| u32::from((x * 32767.0).round() as i16 as u16);
    half(x) | (half(y) << 16)
}

fn unpack_place(code: u32) -> DVec2 {
    let half = |bits: u32| (f64::from(bits as u16 as i16) / 32767.0).max(-1.0);
    DVec2::new(half(code & 0xffff), half(code >> 16))
}

/// What the attributes of a corner are when a vertex gets them: places, and distances or alphas, in units of their ranges.
pub fn fetched(corner: &PatchCorner) -> ([DVec2; OVERLAPS], DVec4) {
    let [ab, cd] = corner.behind.map(unpack2x16unorm);
    (corner.places.map(unpack_place), DVec4::new(ab.x, ab.y, cd.x, cd.y))
}

/// What a corner sees, from what it carries.
pub fn carried_overlap(mapping: Mapping, places: [DVec2; OVERLAPS], behind: DVec4, seeds: [u32; OVERLAPS]) -> Overlap {
    let range = if mapping == Mapping::Lapped { 1.0 } else { BEHIND_RANGE };
    Overlap { places: places.map(|place| PLACE_RANGE * place), behind: range * behind, seeds }
}

/// How a seed's patch lies on the tile, in one of the copies that are drawn of it.
pub fn seed_turn(follow: Follow, turns: &[DVec4], seed: u32, copy: usize) -> DVec4 {
    if follow == Follow::Light && seed != NO_SEED {
        return turns[seed as usize * TURNS + copy];
    }
    DVec4::new(0.0, 0.0, 0.0, if copy == 0 { 1.0 } else { 0.0 })
}

/// The weights of the patches that overlap; all sum to 1.
pub fn overlap_weights(behind: DVec4) -> DVec4 {
    let weights = (1.0 - (behind - behind.min_element())).max(DVec4::ZERO);
    weights / weights.element_sum()
}

/// Place on the tile of a place in a patch.
pub fn turned_uv(material: &Material, place: DVec2, turn: DVec4) -> DVec2 {
    tile_uv(material, turn.truncate().truncate() + DVec2::from_angle(turn.z).rotate(place))
}

/// Which of four weights is the greatest, the first of equals.
pub fn heaviest(weights: DVec4) -> usize {
    (1..OVERLAPS).fold(0, |best, i| if weights[i] > weights[best] { i } else { best })
}

/// Four weights but for one, which becomes 0.
pub fn without(mut weights: DVec4, i: usize) -> DVec4 {
    weights[i] = 0.0;
    weights
}

/// The place of one of the patches.
pub fn place_of(overlap: &Overlap, i: usize) -> DVec2 {
    overlap.places[i]
}

/// Copies that are drawn of a patch.
pub fn copies(follow: Follow) -> usize {
    if follow == Follow::Light { TURNS } else { 1 }
}
