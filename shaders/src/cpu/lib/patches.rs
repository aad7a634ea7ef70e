//! Twin of `lib/patches.wgsl`: overlapping parametrisations of a surface, carried by corners or found per face.

use glam::{DVec2, DVec3, DVec4};

use super::material::{Material, tile_uv};
use crate::cpu::Follow;
use crate::cpu::builtin::unpack2x16unorm;
use crate::types::{PatchCorner, PatchEntry};

/// Patches of a face at most.
pub const MAX_PATCHES: usize = 8;
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

/// Group 3: the patches of all corners, and of all faces.
#[derive(Clone, Copy, Debug, Default)]
pub struct PatchTable<'a> {
    /// What triangles' corners see, and the seeds that they name, as [`PatchCorner`] says.
    pub corners: &'a [[u32; 4]],
    /// Three per face: its corners.
    pub corner_indices: &'a [u32],
    /// Per face the first of its entries, and then their number.
    pub starts: &'a [u32],
    /// By face.
    pub entries: &'a [PatchEntry],
    /// Per entry its rows; empty where there are no stripes.
    pub rows: &'a [u32],
    /// Per entry its seed.
    pub seeds: &'a [u32],
    /// [`TURNS`] per seed: place of the seed on the tile, angle, share.
    pub turns: &'a [DVec4],
}

/// The patches that overlap at a fragment, interpolated between the corners; those that are not there stand far behind.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Overlap {
    /// Places on the tile.
    pub places: [DVec2; OVERLAPS],
    /// Distances behind the nearest, in feathers.
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

/// The patches of a face as a fragment sees them.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Patches {
    /// Their first entry.
    pub first: usize,
    /// How many.
    pub count: usize,
    /// Barycentric weights of the corners.
    pub corners: DVec3,
    /// How far the nearest stands behind.
    pub least: f64,
    /// Sum of all weights before they are made to sum to 1.
    pub sum: f64,
}

/// Three 10-bit unorm, low bits first.
pub fn unpack_tens(code: u32) -> DVec3 {
    DVec3::from([0, 10, 20].map(|shift| f64::from((code >> shift) & 1023) / 1023.0))
}

/// The code of [`unpack_tens`] nearest to three shares, each 0..=1.
pub fn pack_tens(shares: [f64; 3]) -> u32 {
    shares.into_iter().rev().fold(0, |code, share| (code << 10) | (share.clamp(0.0, 1.0) * 1023.0).round() as u32)
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

/// Place in the patch at a fragment, in tiles.
pub fn patch_place(places: [u32; 3], corners: DVec3) -> DVec2 {
    let place: DVec2 = places.into_iter().zip(corners.to_array()).map(|(code, share)| unpack_place(code) * share).sum();
    PLACE_RANGE * place
}

/// The seed of an entry; [`NO_SEED`] where none is known.
pub fn entry_seed(table: PatchTable<'_>, entry: usize) -> u32 {
    table.seeds.get(entry).copied().unwrap_or(NO_SEED)
}

/// How a seed's patch lies on the tile, in one of the copies that are drawn of it.
pub fn seed_turn(follow: Follow, table: PatchTable<'_>, seed: u32, copy: usize) -> DVec4 {
    if follow == Follow::Light && seed != NO_SEED {
        return table.turns[seed as usize * TURNS + copy];
    }
    DVec4::new(0.0, 0.0, 0.0, if copy == 0 { 1.0 } else { 0.0 })
}

fn record(table: PatchTable<'_>, corner: u32) -> PatchCorner {
    let [first, second] = [0, 1].map(|half| table.corners[2 * corner as usize + half]);
    let [behind_ab, behind_cd, vertex, seeds] = second;
    PatchCorner { places: first, behind: [behind_ab, behind_cd], vertex, seeds }
}

/// The vertex of a corner.
pub fn corner_vertex(table: PatchTable<'_>, corner: u32) -> u32 {
    record(table, corner).vertex
}

/// What a corner sees; seeds only where patches turn.
pub fn corner_overlap(follow: Follow, table: PatchTable<'_>, corner: u32) -> Overlap {
    let PatchCorner { places, behind: [ab, cd], seeds, .. } = record(table, corner);
    let (ab, cd) = (unpack2x16unorm(ab), unpack2x16unorm(cd));
    Overlap {
        places: places.map(|code| PLACE_RANGE * unpack_place(code)),
        behind: BEHIND_RANGE * DVec4::new(ab.x, ab.y, cd.x, cd.y),
        seeds: if follow == Follow::Light { table.corners[seeds as usize] } else { [NO_SEED; OVERLAPS] },
    }
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

/// How far a fragment stands behind the nearest patch in an entry's.
pub fn patch_behind(entry: &PatchEntry, corners: DVec3) -> f64 {
    BEHIND_RANGE * unpack_tens(entry.shares).dot(corners)
}

/// The patches of a face at a fragment.
pub fn patches_at(table: PatchTable<'_>, face: usize, corners: DVec3) -> Patches {
    let first = table.starts[face] as usize;
    let count = (table.starts[face + 1] as usize - first).min(MAX_PATCHES);
    let behind = || table.entries[first..first + count].iter().map(|entry| patch_behind(entry, corners));
    let least = behind().fold(1e9, f64::min);
    let sum = behind().map(|behind| (1.0 - (behind - least)).max(0.0)).sum();
    Patches { first, count, corners, least, sum }
}

/// The weight of one of the patches; all sum to 1.
pub fn patch_weight(table: PatchTable<'_>, patches: &Patches, i: usize) -> f64 {
    let behind = patch_behind(&table.entries[patches.first + i], patches.corners);
    (1.0 - (behind - patches.least)).max(0.0) / patches.sum
}

/// Copies that are drawn of a patch.
pub fn copies(follow: Follow) -> usize {
    if follow == Follow::Light { TURNS } else { 1 }
}
