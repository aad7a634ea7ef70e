//! Patches as vertex data: what each corner of a triangle sees of them. Corners of neighbouring triangles at one vertex
//! that see the same patches are one.
//!
//! # Layout
//!
//! A triangle sees one to four patches, in the order of their seeds; all its corners have the same ones in the same order, so
//! that everything may be interpolated. A corner is 32 bytes, [`PatchCorner`], little-endian:
//!
//! | bytes | what | code | range |
//! | --- | --- | --- | --- |
//! | 0–15 | place on the tile in each of four patches | two 16-bit snorm, s and then t | -4..=4 tiles, in steps of 1.2e-4 |
//! | 16–23 | how far each patch stands behind the nearest | four 16-bit unorm | 0..=4 feathers, in steps of 6.1e-5 |
//! | 24–27 | the vertex of the mesh that stands there | u32 | |
//! | 28–31 | which of the records of seeds is its patches' | u32 | |
//!
//! What is not there stands 4 feathers behind, and has no weight. Places say where on the tile a stroke is, in repeats of the
//! tile: the texture is sampled there, repeated. Only patches that turn with the light name their seeds, about which their
//! places turn. Indices, three to a triangle, are in the order of the mesh's triangles.
//!
//! # What a fragment does with it
//!
//! With all of it interpolated, patch i has the weight `max(0, 1 - (behind[i] - least behind))` over the sum of all four, which
//! is continuous across all edges. Weights made at the corners and then interpolated would be others. The patterns are joined
//! by union: for a darkness D each is drawn at `1 - (1 - D)^weight`, and the paper that is left is the product of what each
//! leaves.
//!
//! ```
//! use tam_viewer::mesh::{prepare, sample::Sample};
//! use tam_viewer::surface::patches::PatchVertices;
//! use tam_viewer::surface::{PatchOptions, Surface, SurfaceOptions};
//!
//! let mesh = prepare(Sample::Sphere.build(2_000))?.mesh;
//! let options = SurfaceOptions { patches: Some(PatchOptions::default()), ..SurfaceOptions::default() };
//! let patches = Surface::new(&mesh, &options)?.patches.unwrap();
//! let vertices = PatchVertices::new(&mesh.triangles, &patches);
//!
//! // In the middle of the first triangle:
//! let corners = [0, 1, 2].map(|k| vertices.corners[vertices.indices[k] as usize]);
//! let snorm = |code: u32| f64::from(code as u16 as i16) / 32767.0;
//! let mean = |of: &dyn Fn(usize) -> f64| (0..3).map(of).sum::<f64>() / 3.0;
//! let place = |i: usize| [0, 16].map(|shift| 4.0 * mean(&|k| snorm(corners[k].places[i] >> shift)));
//! let unorm = |k: usize, i: usize| f64::from(corners[k].behind[i / 2] >> (16 * (i % 2)) & 0xffff) / 65535.0;
//! let behind = [0, 1, 2, 3].map(|i| 4.0 * mean(&|k| unorm(k, i)));
//! let least = behind.into_iter().fold(f64::INFINITY, f64::min);
//! let weights = behind.map(|behind| (1.0 - (behind - least)).max(0.0));
//! let sum: f64 = weights.iter().sum();
//! let strokes_at = |uv: [f64; 2], darkness: f64| if uv[1].rem_euclid(0.1) < 0.1 * darkness { 1.0 } else { 0.0 };
//! let clear: f64 = (0..4)
//!     .map(|i| 1.0 - strokes_at(place(i), 1.0 - (1.0 - 0.5f64).powf(weights[i] / sum)))
//!     .product();
//! let ink = 1.0 - clear;
//! assert!(weights.contains(&1.0) && (0.0..=1.0).contains(&ink));
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

use glam::DVec2;
use rayon::prelude::*;
use tam_shaders::cpu::builtin::pack2x16unorm;
use tam_shaders::cpu::lib::patches::{BEHIND_RANGE, NO_SEED, OVERLAPS, pack_place};
use tam_shaders::types::PatchCorner;

use super::Patches;
use super::corners::Entry;
use crate::params::Follow;

/// Vertices that are looked at in one go.
const BLOCK: usize = 1 << 12;

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
        // At one vertex, equal corners of different triangles are one; patches are equal where their seeds are. In blocks
        // of vertices: the corners of each, and of each slot the number of its corner among them.
        let block = |block: usize| {
            let vertices = block * BLOCK..((block + 1) * BLOCK).min(vertices);
            let count = (starts[vertices.end] - starts[vertices.start]) as usize;
            let (mut corners, mut numbers) = (Vec::with_capacity(2 * BLOCK), Vec::with_capacity(count));
            let mut different: Vec<([u32; OVERLAPS], PatchCorner)> = Vec::new();
            for vertex in vertices {
                for slot in &slots[starts[vertex] as usize..starts[vertex + 1] as usize] {
                    let own = (seeds[*slot as usize / 3], corner(*slot));
                    let number = different.iter().position(|known| *known == own).unwrap_or_else(|| {
                        different.push(own);
                        different.len() - 1
                    });
                    numbers.push((corners.len() + number) as u32);
                }
                corners.extend(different.drain(..).map(|(_, corner)| corner));
            }
            (corners, numbers)
        };
        let blocks: Vec<(Vec<PatchCorner>, Vec<u32>)> =
            (0..vertices.div_ceil(BLOCK)).into_par_iter().map(block).collect();
        let mut this = Self { corners: Vec::new(), indices: vec![0; 3 * triangles.len()], seeds: named };
        this.corners.reserve_exact(blocks.iter().map(|(corners, _)| corners.len()).sum());
        let mut slots = slots.iter();
        for (corners, numbers) in blocks {
            let first = this.corners.len() as u32;
            for (number, slot) in numbers.into_iter().zip(&mut slots) {
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
    let behind = entries.map(|entry| entry.map_or(1.0, |entry| f64::from(entry.behind[k]) / BEHIND_RANGE));
    PatchCorner {
        places: entries.map(|entry| pack_place(entry.map_or(DVec2::ZERO, |entry| entry.uv[k].as_dvec2()))),
        behind: [[0, 1], [2, 3]].map(|[a, b]| pack2x16unorm(DVec2::new(behind[a], behind[b]))),
        vertex,
        seeds,
    }
}
