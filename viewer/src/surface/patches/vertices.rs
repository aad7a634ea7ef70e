//! Patches as vertex data: what each corner of a triangle sees of them. Corners of neighbouring triangles at one vertex
//! that see the same patches are one.

use glam::DVec2;
use rayon::prelude::*;
use tam_shaders::cpu::builtin::pack2x16unorm;
use tam_shaders::cpu::lib::patches::{BEHIND_RANGE, NO_SEED, OVERLAPS, pack_place};
use tam_shaders::types::PatchCorner;

use super::Patches;
use super::corners::Entry;
use crate::params::Follow;

/// The patches of a mesh, corner by corner.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct PatchVertices {
    /// Each once, by vertex.
    pub corners: Vec<PatchCorner>,
    /// Three per triangle.
    pub indices: Vec<u32>,
    /// The seeds that corners name; those of patches that lie still are not needed and not told.
    pub seeds: Vec<[u32; OVERLAPS]>,
}

impl PatchVertices {
    /// The corners of a mesh with these triangles, whose patches blend.
    pub fn new(triangles: &[[u32; 3]], patches: &Patches) -> Self {
        assert_eq!(triangles.len() + 1, patches.starts.len(), "patches of this mesh");
        let vertices = triangles.as_flattened().iter().max().map_or(0, |last| *last as usize + 1);
        let turning = patches.follow == Follow::Light;
        let seeds: Vec<[u32; OVERLAPS]> =
            (0..triangles.len()).into_par_iter().map(|face| seeds(patches.of(face))).collect();
        let mut named: Vec<[u32; OVERLAPS]> = if turning { seeds.clone() } else { vec![[NO_SEED; OVERLAPS]] };
        named.par_sort_unstable();
        named.dedup();
        let corner = |slot: u32| {
            let (face, k) = (slot as usize / 3, slot as usize % 3);
            let seeds = if turning { named.binary_search(&seeds[face]).unwrap_or_default() as u32 } else { 0 };
            packed(patches.of(face), k, triangles[face][k], seeds)
        };
        let (starts, slots) = by_vertex(triangles.as_flattened(), vertices);
        // At one vertex, equal corners of different triangles are one; patches are equal where their seeds are.
        let at_vertices: Vec<(Vec<PatchCorner>, Vec<u32>)> = (0..vertices)
            .into_par_iter()
            .map(|vertex| {
                let slots = &slots[starts[vertex] as usize..starts[vertex + 1] as usize];
                let mut different: Vec<([u32; OVERLAPS], PatchCorner)> = Vec::with_capacity(2);
                let of_slot = |slot: &u32| {
                    let own = (seeds[*slot as usize / 3], corner(*slot));
                    different.iter().position(|known| *known == own).unwrap_or_else(|| {
                        different.push(own);
                        different.len() - 1
                    }) as u32
                };
                let numbers = slots.iter().map(of_slot).collect();
                (different.into_iter().map(|(_, corner)| corner).collect(), numbers)
            })
            .collect();
        let mut this = Self { corners: Vec::new(), indices: vec![0; 3 * triangles.len()], seeds: named };
        for (vertex, (corners, numbers)) in at_vertices.into_iter().enumerate() {
            let first = this.corners.len() as u32;
            let slots = &slots[starts[vertex] as usize..];
            for (slot, number) in slots.iter().zip(numbers) {
                this.indices[*slot as usize] = first + number;
            }
            this.corners.extend(corners);
        }
        this
    }

    /// As the shaders read it: two records of four words per corner, and then the seeds.
    pub fn packed(&self) -> Vec<[u32; 4]> {
        let after = 2 * self.corners.len() as u32;
        let records = self.corners.iter().flat_map(|corner| {
            let PatchCorner { places, behind: [ab, cd], vertex, seeds } = *corner;
            [places, [ab, cd, vertex, after + seeds]]
        });
        records.chain(self.seeds.iter().copied()).collect()
    }

    /// Bytes on the GPU.
    pub fn bytes(&self) -> u64 {
        (size_of_val(&*self.corners) + size_of_val(&*self.indices) + size_of_val(&*self.seeds)) as u64
    }
}

/// Per vertex the first of its corners in the list that follows, and the corners by vertex.
fn by_vertex(indices: &[u32], vertices: usize) -> (Vec<u32>, Vec<u32>) {
    let mut starts = vec![0_u32; vertices + 1];
    for vertex in indices {
        starts[*vertex as usize + 1] += 1;
    }
    for vertex in 0..vertices {
        starts[vertex + 1] += starts[vertex];
    }
    let (mut next, mut slots) = (starts.clone(), vec![0; indices.len()]);
    for (slot, vertex) in indices.iter().enumerate() {
        let place = &mut next[*vertex as usize];
        slots[*place as usize] = slot as u32;
        *place += 1;
    }
    (starts, slots)
}

/// The entries of a triangle in the order of their seeds.
fn ordered(entries: &[Entry]) -> [Option<&Entry>; OVERLAPS] {
    let mut all = [None; OVERLAPS];
    for (place, entry) in all.iter_mut().zip(entries) {
        *place = Some(entry);
    }
    all.sort_by_key(|entry| entry.map_or((true, 0), |entry| (false, entry.seed)));
    all
}

fn seeds(entries: &[Entry]) -> [u32; OVERLAPS] {
    ordered(entries).map(|entry| entry.map_or(NO_SEED, |entry| entry.seed))
}

/// What corner `k` of a triangle sees.
fn packed(entries: &[Entry], k: usize, vertex: u32, seeds: u32) -> PatchCorner {
    let entries = ordered(entries);
    let behind = entries.map(|entry| entry.map_or(1.0, |entry| entry.behind[k] / BEHIND_RANGE));
    PatchCorner {
        places: entries.map(|entry| pack_place(entry.map_or(DVec2::ZERO, |entry| entry.uv[k]))),
        behind: [[0, 1], [2, 3]].map(|[a, b]| pack2x16unorm(DVec2::new(behind[a], behind[b]))),
        vertex,
        seeds,
    }
}
