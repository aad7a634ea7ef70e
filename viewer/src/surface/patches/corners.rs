//! What each triangle sees of the patches: per patch the places of its three corners on the tile, and how far each
//! corner stands behind the nearest patch.
//!
//! A patch has the weight `max(0, 1 - (δ - least δ))` at a fragment, δ interpolated between the corners: patches pass
//! into each other over the feather, weights are continuous across all edges, and the nearest patch always has 1.

use glam::{DVec2, Vec2};
use rayon::prelude::*;
use tam_shaders::cpu::lib::patches::{BEHIND_RANGE, OVERLAPS, pack_place};

use super::fallback::planar;
use super::maps::{Map, Reached};
use super::{PatchOptions, Patches, Seed};
use crate::surface::field::Field;
use crate::surface::graph::Graph;

/// Lapped textures of a triangle at most; patches that blend are no more than [`OVERLAPS`].
pub const MAX_ENTRIES: usize = 8;

/// Triangles that are looked at in one go.
const BLOCK: usize = 1 << 12;

/// Patches that may overlap at a node: the feather ends before one more comes in.
const MAX_OVERLAP: usize = 5;

/// A patch's places must keep the lengths of a triangle within this factor: where a patch meets itself round a finger,
/// they do not.
const GREATEST_STRETCH: f32 = 2.5;

/// A patch as one triangle sees it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Entry {
    /// Index of the seed; `u32::MAX` where the triangle has a plane of its own.
    pub seed: u32,
    /// Per corner, place on the tile, in tiles.
    pub uv: [Vec2; 3],
    /// Per corner: distance behind the nearest patch, in feathers, 0..=4; of lapped patches the alpha, 0..=1.
    pub behind: [f32; 3],
}

impl Entry {
    /// The greatest of `behind`.
    fn range(lapped: bool) -> f64 {
        if lapped { 1.0 } else { BEHIND_RANGE }
    }

    /// Its distances or alphas as 16-bit unorm.
    pub(in crate::surface) fn share_codes(&self, lapped: bool) -> [u16; 3] {
        self.behind.map(|share| (f64::from(share) / Self::range(lapped) * 65535.0).round() as u16)
    }

    /// Those of such codes.
    pub(in crate::surface) fn shares_of(codes: [u16; 3], lapped: bool) -> [f32; 3] {
        codes.map(|code| (f64::from(code) / 65535.0 * Self::range(lapped)) as f32)
    }

    /// The same, its distances or alphas rounded to the steps of their codes.
    #[must_use]
    pub(in crate::surface) fn in_steps(self, lapped: bool) -> Self {
        Self { behind: Self::shares_of(self.share_codes(lapped), lapped), ..self }
    }

    /// Its places, in the steps in which they are drawn and kept.
    pub(in crate::surface) fn place_codes(&self) -> [u32; 3] {
        self.uv.map(|uv| pack_place(uv.as_dvec2()))
    }
}

/// A patch at a node.
#[derive(Clone, Copy)]
struct Seen {
    seed: u32,
    place: Vec2,
    distance: f32,
    /// In feathers.
    behind: f32,
}

/// Gathers the patches of all triangles.
pub(super) fn gather(graph: &Graph, field: &Field, maps: Vec<Map>, options: &PatchOptions) -> Patches {
    let seeds: Vec<Seed> = maps.iter().map(|map| map.seed).collect();
    let (starts, mut seen) = by_node(graph, maps);
    let feather = (options.feather_tiles / options.tiles_per_unit) as f32;
    let mut rest = seen.as_mut_slice();
    let mut slices = Vec::with_capacity(graph.len());
    for node in 0..graph.len() {
        let (head, tail) = rest.split_at_mut(starts[node + 1] - starts[node]);
        slices.push(head);
        rest = tail;
    }
    slices.into_par_iter().for_each(|seen| {
        seen.sort_by(|a, b| a.distance.total_cmp(&b.distance).then(a.seed.cmp(&b.seed)));
        let Some(nearest) = seen.first().map(|seen| seen.distance) else { return };
        let gap = seen.get(MAX_OVERLAP).map_or(f32::INFINITY, |next| next.distance - nearest);
        let feather = feather.min(gap).max(1e-3 * feather);
        for seen in seen {
            seen.behind = ((seen.distance - nearest) / feather).min(BEHIND_RANGE as f32);
        }
    });
    leave_out(graph, &starts, &mut seen);
    let of = |node: u32| &seen[starts[node as usize]..starts[node as usize + 1]];
    // In blocks, so that lists of a few entries need no memory of their own.
    let block = |triangles: &[[u32; 3]]| {
        let mut block = (Vec::with_capacity(triangles.len()), Vec::with_capacity(3 * triangles.len()));
        let mut found = Vec::new();
        for triangle in triangles {
            entries(graph, *triangle, triangle.map(of), &mut found);
            if found.is_empty() {
                found.push(Entry {
                    seed: u32::MAX,
                    uv: planar(graph, field, *triangle).map(DVec2::as_vec2),
                    behind: [0.0; 3],
                });
            }
            block.1.extend(found.drain(..).map(|entry| finish(entry, &seeds, options)));
            block.0.push(block.1.len() as u32);
        }
        block
    };
    let blocks: Vec<(Vec<u32>, Vec<Entry>)> = graph.triangles.par_chunks(BLOCK).map(block).collect();
    drop(seen);
    let mut starts = Vec::with_capacity(graph.triangles.len() + 1);
    let mut entries = Vec::with_capacity(blocks.iter().map(|(_, entries)| entries.len()).sum());
    starts.push(0);
    for (ends, of_block) in blocks {
        let before = entries.len() as u32;
        starts.extend(ends.into_iter().map(|end| before + end));
        entries.extend(of_block);
    }
    Patches {
        seeds,
        starts,
        entries,
        rows: Vec::new(),
        tiles_per_unit: options.tiles_per_unit,
        follow: options.follow,
        lapped: false,
    }
}

/// An entry whose places are in mesh units, in tiles.
fn finish(entry: Entry, seeds: &[Seed], options: &PatchOptions) -> Entry {
    let uv = entry.uv.map(|place| place.as_dvec2() * options.tiles_per_unit);
    let uv = match seeds.get(entry.seed as usize) {
        Some(seed) => uv.map(|corner| corner + DVec2::from(seed.offset_uv)),
        // Whole tiles are taken off, so that the numbers stay small.
        None => uv.map(|corner| corner - uv[0].floor()),
    };
    Entry { uv: uv.map(DVec2::as_vec2), ..entry }
}

/// The patches at each node, node by node.
fn by_node(graph: &Graph, maps: Vec<Map>) -> (Vec<usize>, Vec<Seen>) {
    let mut starts = vec![0usize; graph.len() + 1];
    for reached in maps.iter().flat_map(|map| &map.reached) {
        starts[reached.node as usize + 1] += 1;
    }
    for node in 0..graph.len() {
        starts[node + 1] += starts[node];
    }
    let none = Seen { seed: 0, place: Vec2::ZERO, distance: 0.0, behind: 0.0 };
    let mut seen = vec![none; starts[graph.len()]];
    let mut next = starts.clone();
    for (index, map) in maps.into_iter().enumerate() {
        for Reached { node, place, distance } in map.reached {
            let at = &mut next[node as usize];
            seen[*at] = Seen { seed: index as u32, place, distance, behind: 0.0 };
            *at += 1;
        }
    }
    (starts, seen)
}

/// The patches of a triangle that weigh anything somewhere in it, into `entries`; places in mesh units.
fn entries(graph: &Graph, triangle: [u32; 3], seen: [&[Seen]; 3], entries: &mut Vec<Entry>) {
    let lengths = |places: [Vec2; 3]| [0, 1, 2].map(|k| places[(k + 1) % 3].distance(places[k]));
    let corners = triangle.map(|node| graph.positions[node as usize]);
    let true_lengths = [0, 1, 2].map(|k| corners[(k + 1) % 3].distance(corners[k]) as f32);
    let longest = true_lengths.iter().copied().fold(0.0, f32::max);
    let greatest = |entry: &Entry| entry.behind.into_iter().fold(0.0, f32::max);
    let least = |entry: &Entry| entry.behind.into_iter().fold(f32::INFINITY, f32::min);
    let of_patch = |first: &Seen| {
        // A patch that does not reach all three corners ends before this triangle.
        let at = [1, 2].map(|k| seen[k].iter().find(|other| other.seed == first.seed));
        let [Some(second), Some(third)] = at else { return None };
        let three = [first, second, third];
        let (uv, behind) = (three.map(|seen| seen.place), three.map(|seen| seen.behind));
        Some(Entry { seed: first.seed, uv, behind })
    };
    let is_whole = |entry: &Entry| {
        lengths(entry.uv).into_iter().zip(true_lengths).all(|(found, wanted)| {
            let more = 0.05 * longest;
            found <= GREATEST_STRETCH * wanted + more && wanted <= GREATEST_STRETCH * found + more
        })
    };
    let all = || seen[0].iter().filter_map(of_patch);
    entries.clear();
    entries.extend(all().filter(|entry| least(entry) < BEHIND_RANGE as f32 && is_whole(entry)));
    // Those that stand as far behind as any have been left out, unless there are no others.
    let all_far = entries.is_empty();
    if all_far {
        entries.extend(all().filter(is_whole));
    }
    // Somewhere in the triangle the least δ may be this great, so more patches than those at the corners can weigh.
    let slack = entries.iter().map(greatest).fold(f32::INFINITY, f32::min);
    entries.retain(|entry| least(entry) < 1.0 + slack);
    entries.sort_by(|a, b| least(a).total_cmp(&least(b)).then(a.seed.cmp(&b.seed)));
    if all_far {
        entries.truncate(OVERLAPS);
    }
}

/// Leaves out the lightest patches of triangles that see more than [`OVERLAPS`]: at their corners these patches are put so
/// far behind that they have no weight, so that they fade out in the triangles around and no edge shows.
fn leave_out(graph: &Graph, starts: &[usize], seen: &mut [Seen]) {
    let range = |node: u32| starts[node as usize]..starts[node as usize + 1];
    let lightest = |found: &mut Vec<Entry>, triangle: &[u32; 3], seen: &[Seen]| {
        entries(graph, *triangle, triangle.map(|node| &seen[range(node)]), found);
        if found.len() <= OVERLAPS {
            return None;
        }
        let weights = mean_weights(found);
        let mut order: Vec<usize> = (0..found.len()).collect();
        order.sort_by(|a, b| weights[*b].total_cmp(&weights[*a]));
        Some((*triangle, order.split_off(OVERLAPS).into_iter().map(|i| found[i].seed).collect::<Vec<u32>>()))
    };
    let mut changed = vec![true; graph.len()];
    loop {
        let at_changed = |triangle: &&[u32; 3]| triangle.iter().any(|node| changed[*node as usize]);
        let out: Vec<([u32; 3], Vec<u32>)> = {
            let seen = &*seen;
            let in_block = |triangles: &[[u32; 3]]| -> Vec<([u32; 3], Vec<u32>)> {
                let mut found = Vec::new();
                let at_changed = triangles.iter().filter(at_changed);
                at_changed.filter_map(|triangle| lightest(&mut found, triangle, seen)).collect()
            };
            graph.triangles.par_chunks(BLOCK).map(in_block).flatten_iter().collect()
        };
        if out.is_empty() {
            return;
        }
        changed.fill(false);
        for (triangle, seeds) in out {
            for node in triangle {
                changed[node as usize] = true;
                let at_node = seen[range(node)].iter_mut().filter(|seen| seeds.contains(&seen.seed));
                at_node.for_each(|seen| seen.behind = BEHIND_RANGE as f32);
            }
        }
    }
}

/// The mean weight of each entry, over the corners, the middles of the sides and the middle.
fn mean_weights(entries: &[Entry]) -> Vec<f64> {
    const PLACES: [[f64; 3]; 7] = [
        [1.0, 0.0, 0.0],
        [0.0, 1.0, 0.0],
        [0.0, 0.0, 1.0],
        [0.5, 0.5, 0.0],
        [0.0, 0.5, 0.5],
        [0.5, 0.0, 0.5],
        [1.0 / 3.0; 3],
    ];
    let mut sums = vec![0.0; entries.len()];
    for place in PLACES {
        let behind = |entry: &Entry| {
            entry.behind.iter().zip(place).map(|(behind, share)| f64::from(*behind) * share).sum::<f64>()
        };
        let least = entries.iter().map(behind).fold(f64::INFINITY, f64::min);
        let weight = |entry: &Entry| (1.0 - (behind(entry) - least)).max(0.0);
        let total: f64 = entries.iter().map(weight).sum();
        for (sum, entry) in sums.iter_mut().zip(entries) {
            *sum += weight(entry) / total / PLACES.len() as f64;
        }
    }
    sums
}
