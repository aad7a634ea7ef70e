//! What the corners of triangles carry of a surface: the patches they see, and the phases of lines. Corners of neighbouring
//! triangles at one vertex that carry the same are one.
//!
//! # Layout
//!
//! Corners stand in vertex buffers beside each other, one for each of the parts below that a way to draw reads; all little-endian.
//! Indices, three to a triangle, are in the order of the mesh's triangles.
//!
//! **Place**, 16 bytes, as the mesh's own vertices: position (three f32) and normal (octahedral, two 16-bit snorm).
//!
//! **Patches**, 24 bytes, [`PatchCorner`]. A triangle sees one to four patches, in the order of their seeds (lapped textures: of
//! painting); all its corners have the same ones in the same order, so that everything may be interpolated.
//!
//! | bytes | what | code | range |
//! | --- | --- | --- | --- |
//! | 0–15 | place on the tile in each of four patches | two 16-bit snorm, s and then t | -4..=4 tiles, in steps of 1.2e-4 |
//! | 16–23 | how far each patch stands behind the nearest | four 16-bit unorm | 0..=4 feathers, in steps of 6.1e-5 |
//! | | of lapped textures: its alpha | | 0..=1, in steps of 1.5e-5 |
//!
//! Lapped textures, of which a triangle has up to eight, have two of these: those of the second are painted over those of the
//! first.
//!
//! What is not there stands 4 feathers behind and has no weight, or has no alpha. Places say where on the tile a stroke is, in
//! repeats of the tile: the texture is sampled there, repeated.
//!
//! **Seeds**, 16 bytes, four u32: those of the patches, which only patches that turn with the light and rows of strokes need.
//! Not interpolated: all corners of a triangle have the same.
//!
//! **Lines**, 12 bytes, [`LineCorner`]: where lines stand.
//!
//! | bytes | what | code |
//! | --- | --- | --- |
//! | 0–7 | phases of the lines along and across, in lines: whole in the middle of each | two f32 |
//! | 8–9 | in a triangle in which lines end: the weights of the two corners at the side of the mesh's triangle, 0 or 1 | two i8 |
//! | 10–11 | there: how often both phases wind around its middle | two i8 |
//!
//! Phases are known up to sign and whole numbers, the same for all corners of a triangle. Where lines end or the field is
//! singular, the mesh's triangle is drawn in three, between its middle and its sides: in each the phase is linear but for the
//! winding, which adds `turns * b / (3 (a + b))`, a and b the weights of the side's corners.
//!
//! **Rows**, 16 bytes, four u32, one for each patch: what makes the patch's row out of the phases. 16 bits for the lines along
//! (low) and 16 for those across; of each the lowest bit is set where the sign turns over, and the others are a number that is
//! added. Not interpolated.
//!
//! # What a fragment does with patches
//!
//! With all of it interpolated, patch i has the weight `max(0, 1 - (behind[i] - least behind))` over the sum of all four, which
//! is continuous across all edges. Weights made at the corners and then interpolated would be others. The patterns are joined
//! by union: for a darkness D each is drawn at `1 - (1 - D)^weight`, and the paper that is left is the product of what each
//! leaves.
//!
//! ```
//! use tam_viewer::mesh::{prepare, sample::Sample};
//! use tam_viewer::surface::{Corners, PatchOptions, Surface, SurfaceOptions};
//!
//! let mesh = prepare(Sample::Sphere.build(2_000))?.mesh;
//! let options = SurfaceOptions { patches: Some(PatchOptions::default()), ..SurfaceOptions::default() };
//! let patches = Surface::new(&mesh, &options)?.patches.unwrap();
//! let carried = Corners::of_patches(&mesh.triangles, &patches);
//!
//! // In the middle of the first triangle:
//! let corners = [0, 1, 2].map(|k| carried.patches[carried.indices[k] as usize]);
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

use std::ops::Range;

use glam::DVec2;
use rayon::prelude::*;
use tam_shaders::cpu::builtin::pack2x16unorm;
use tam_shaders::cpu::lib::patches::{BEHIND_RANGE, NO_SEED, OVERLAPS, pack_place};
use tam_shaders::types::{LineCorner, PatchCorner};

use super::patches::{Entry, MAX_ENTRIES, Patches};
use super::stripes::{StripePhases, Stripes};
use crate::params::Follow;

/// Vertices that are looked at in one go.
const BLOCK: usize = 1 << 12;

/// Such blocks whose corners are in memory apart from all others.
const BLOCKS_AT_ONCE: usize = 16;

/// Where a corner stands.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Stand {
    /// At a vertex of the mesh.
    Vertex(u32),
    /// In the middle of a triangle of the mesh.
    Middle(u32),
}

/// What the corners of a mesh's triangles carry.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Corners {
    /// Each once: first those at vertices, by vertex.
    pub stands: Vec<Stand>,
    /// What each sees of the patches; empty where that is not asked for, like all that follows.
    pub patches: Vec<PatchCorner>,
    /// Of lapped textures those that are painted over these.
    pub over: Vec<PatchCorner>,
    /// Of the patches the seeds.
    pub seeds: Vec<[u32; OVERLAPS]>,
    /// Of both fields of lines.
    pub lines: Vec<LineCorner>,
    /// What makes the rows of the patches out of these.
    pub rows: Vec<[u32; OVERLAPS]>,
    /// Three for each triangle that is drawn.
    pub indices: Vec<u32>,
    /// Triangles of the mesh that are drawn in three, in their order.
    pub parted: Vec<u32>,
}

/// All that a corner may carry.
#[derive(Clone, Copy, Default, PartialEq)]
struct Carried {
    patches: PatchCorner,
    over: PatchCorner,
    seeds: [u32; OVERLAPS],
    lines: LineCorner,
    rows: [u32; OVERLAPS],
}

/// What is asked for.
#[derive(Clone, Copy)]
struct Asked<'a> {
    patches: Option<&'a Patches>,
    seeds: bool,
    stripes: Option<&'a Stripes>,
}

impl Corners {
    /// The corners of a mesh with these triangles that see patches.
    ///
    /// # Panics
    /// If the patches are those of another mesh.
    pub fn of_patches(triangles: &[[u32; 3]], patches: &Patches) -> Self {
        assert_eq!(triangles.len() + 1, patches.starts.len(), "patches of this mesh");
        let seeds = patches.follow == Follow::Light;
        Self::new(triangles, Asked { patches: Some(patches), seeds, stripes: None })
    }

    /// Those of lines, and with patches on which rows are known those of lines made of strokes.
    ///
    /// # Panics
    /// If stripes or patches are those of another mesh.
    pub fn of_stripes(triangles: &[[u32; 3]], stripes: &Stripes, patches: Option<&Patches>) -> Self {
        assert_eq!(triangles.len(), stripes.along.len(), "stripes of this mesh");
        let patches = patches.filter(|patches| !patches.rows.is_empty() && patches.follow == Follow::Surface);
        Self::new(triangles, Asked { patches, seeds: patches.is_some(), stripes: Some(stripes) })
    }

    fn new(triangles: &[[u32; 3]], from: Asked<'_>) -> Self {
        let vertices = triangles.as_flattened().iter().max().map_or(0, |last| *last as usize + 1);
        let parted: Vec<u32> = match from.stripes {
            Some(stripes) => {
                (0..triangles.len() as u32).into_par_iter().filter(|face| stripes.parts(*face as usize)).collect()
            }
            None => Vec::new(),
        };
        let is_whole = |slot: &&u32| parted.binary_search(&(**slot / 3)).is_err();
        // Patches are equal where their seeds are.
        let seeds: Vec<[u32; OVERLAPS]> = match from.patches {
            Some(patches) => (0..triangles.len()).into_par_iter().map(|face| patches.seeds_of(face)).collect(),
            None => Vec::new(),
        };
        let seeds_of = |face: usize| seeds.get(face).copied().unwrap_or_default();
        let (starts, slots) = by_vertex(triangles.as_flattened(), vertices);
        // In blocks of vertices: the corners of each, and of each slot the number of its corner among them.
        let block = |block: usize| {
            let vertices = block * BLOCK..((block + 1) * BLOCK).min(vertices);
            let count = (starts[vertices.end] - starts[vertices.start]) as usize;
            let (mut corners, mut numbers) = (Vec::with_capacity(2 * BLOCK), Vec::with_capacity(count));
            let mut different: Vec<([u32; OVERLAPS], Carried)> = Vec::new();
            for vertex in vertices {
                let here = &slots[starts[vertex] as usize..starts[vertex + 1] as usize];
                for slot in here.iter().filter(is_whole) {
                    let (face, k) = (*slot as usize / 3, *slot as usize % 3);
                    let own = (seeds_of(face), from.carried(face, k, seeds_of(face)));
                    let number = different.iter().position(|known| *known == own).unwrap_or_else(|| {
                        different.push(own);
                        different.len() - 1
                    });
                    numbers.push((*slot, (corners.len() + number) as u32));
                }
                corners.extend(different.drain(..).map(|(_, carried)| (Stand::Vertex(vertex as u32), carried)));
            }
            (corners, numbers)
        };
        type Block = (Vec<(Stand, Carried)>, Vec<(u32, u32)>);
        let indices = vec![0; 3 * triangles.len() + 6 * parted.len()];
        let mut this = Self { indices, parted: parted.clone(), ..Self::default() };
        this.reserve(vertices + vertices / 4, &from);
        let blocks: Vec<usize> = (0..vertices.div_ceil(BLOCK)).collect();
        for blocks in blocks.chunks(BLOCKS_AT_ONCE) {
            let blocks: Vec<Block> = blocks.into_par_iter().map(|number| block(*number)).collect();
            for (corners, numbers) in blocks {
                let first = this.stands.len() as u32;
                for (slot, number) in numbers {
                    let at = this.range_of(slot / 3..slot / 3 + 1).start + slot % 3;
                    this.indices[at as usize] = first + number;
                }
                for (stand, carried) in corners {
                    this.push(stand, &carried, &from);
                }
            }
        }
        for part in 0..this.parted.len() {
            let face = this.parted[part];
            let first = this.range_of(face..face + 1).start as usize;
            for (i, (stand, carried)) in from.in_three(face, triangles, seeds_of(face as usize)).into_iter().enumerate()
            {
                this.indices[first + i] = this.stands.len() as u32;
                this.push(stand, &carried, &from);
            }
        }
        this
    }

    fn reserve(&mut self, corners: usize, from: &Asked<'_>) {
        let asked = |is_asked: bool| if is_asked { corners } else { 0 };
        self.stands.reserve(corners);
        self.patches.reserve(asked(from.patches.is_some()));
        self.over.reserve(asked(from.is_lapped()));
        self.seeds.reserve(asked(from.seeds));
        self.lines.reserve(asked(from.stripes.is_some()));
        self.rows.reserve(asked(from.has_rows()));
    }

    fn push(&mut self, stand: Stand, carried: &Carried, from: &Asked<'_>) {
        self.stands.push(stand);
        if from.patches.is_some() {
            self.patches.push(carried.patches);
        }
        if from.is_lapped() {
            self.over.push(carried.over);
        }
        if from.seeds {
            self.seeds.push(carried.seeds);
        }
        if from.stripes.is_some() {
            self.lines.push(carried.lines);
        }
        if from.has_rows() {
            self.rows.push(carried.rows);
        }
    }

    /// Where in the indices some triangles of the mesh stand.
    pub fn range_of(&self, triangles: Range<u32>) -> Range<u32> {
        let at = |face: u32| 3 * face + 6 * self.parted.partition_point(|parted| *parted < face) as u32;
        at(triangles.start)..at(triangles.end)
    }

    /// Bytes on the GPU, with a place of 16 for each.
    pub fn bytes(&self) -> u64 {
        let Self { stands, patches, over, seeds, lines, rows, indices, .. } = self;
        let patches = size_of_val(&**patches) + size_of_val(&**over);
        let carried = patches + size_of_val(&**seeds) + size_of_val(&**lines) + size_of_val(&**rows);
        (16 * stands.len() + carried + size_of_val(&**indices)) as u64
    }
}

impl Asked<'_> {
    fn is_lapped(&self) -> bool {
        self.patches.is_some_and(|patches| patches.lapped)
    }

    fn has_rows(&self) -> bool {
        self.stripes.is_some() && self.patches.is_some()
    }

    /// What corner `k` of a triangle carries; of one that is drawn in three all but its lines.
    fn carried(&self, face: usize, k: usize, seeds: [u32; OVERLAPS]) -> Carried {
        let mut carried = Carried::default();
        if let Some(patches) = self.patches {
            let corner = |first| patches.corner(face, first, k);
            carried.patches = corner(0);
            if self.is_lapped() {
                carried.over = corner(OVERLAPS);
            }
            if self.seeds {
                carried.seeds = seeds;
            }
            if self.has_rows() {
                carried.rows = patches.rows_of(face);
            }
        }
        if let Some(stripes) = self.stripes {
            let phase = |phases: &[StripePhases]| phases.get(face).map_or(0.0, |phases| phases.corners[k]);
            carried.lines.phases = [phase(&stripes.along), phase(&stripes.across)];
        }
        carried
    }

    /// The corners of a triangle that is drawn in three: of each side its two, and the middle.
    fn in_three(&self, face: u32, triangles: &[[u32; 3]], seeds: [u32; OVERLAPS]) -> [(Stand, Carried); 9] {
        let at = face as usize;
        let of_side = |side: usize| {
            let parts = self.stripes.map(|stripes| stripes.parted(at, side)).unwrap_or_default();
            [Some(side), Some((side + 1) % 3), None].map(|k| {
                let (stand, carried) = match k {
                    Some(k) => (Stand::Vertex(triangles[at][k]), self.carried(at, k, seeds)),
                    None => (Stand::Middle(face), self.middle(at, seeds)),
                };
                let corner = k.map_or(2, |k| (k + 3 - side) % 3);
                (stand, Carried { lines: parts[corner], ..carried })
            })
        };
        let [a, b, c] = [0, 1, 2].map(of_side);
        [a[0], a[1], a[2], b[0], b[1], b[2], c[0], c[1], c[2]]
    }

    /// What the middle of a triangle carries beside lines.
    fn middle(&self, face: usize, seeds: [u32; OVERLAPS]) -> Carried {
        let patches = self.patches.map(|patches| patches.middle(face)).unwrap_or_default();
        Carried { patches, ..self.carried(face, 0, seeds) }
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

impl Patches {
    /// The entries that corners of a triangle carry from the `first` on, numbered as [`Patches::of`] has them: in the order of
    /// their seeds, or of painting.
    fn carried(&self, face: usize, first: usize) -> [Option<usize>; OVERLAPS] {
        let entries = self.of(face);
        let mut all: [usize; MAX_ENTRIES] = std::array::from_fn(|i| i);
        let all = &mut all[..entries.len().min(MAX_ENTRIES)];
        if !self.lapped {
            all.sort_by_key(|i| entries[*i].seed);
        }
        std::array::from_fn(|i| all.get(first + i).copied())
    }

    fn seeds_of(&self, face: usize) -> [u32; OVERLAPS] {
        self.carried(face, 0).map(|i| i.map_or(NO_SEED, |i| self.of(face)[i].seed))
    }

    fn rows_of(&self, face: usize) -> [u32; OVERLAPS] {
        let first = self.starts[face] as usize;
        self.carried(face, 0).map(|i| i.and_then(|i| self.rows.get(first + i).copied()).unwrap_or(0))
    }

    /// What corner `k` of a triangle sees of its entries from the `first` on.
    fn corner(&self, face: usize, first: usize, k: usize) -> PatchCorner {
        self.seen_at(face, first, |entry| (entry.uv[k].as_dvec2(), f64::from(entry.behind[k])))
    }

    /// What its middle sees.
    fn middle(&self, face: usize) -> PatchCorner {
        self.seen_at(face, 0, |entry| {
            let uv: DVec2 = entry.uv.iter().map(|uv| uv.as_dvec2()).sum();
            (uv / 3.0, entry.behind.iter().map(|behind| f64::from(*behind)).sum::<f64>() / 3.0)
        })
    }

    fn seen_at(&self, face: usize, first: usize, at: impl Fn(&Entry) -> (DVec2, f64)) -> PatchCorner {
        let (range, none) = if self.lapped { (1.0, 0.0) } else { (BEHIND_RANGE, 1.0) };
        let seen = self.carried(face, first).map(|i| i.map(|i| at(&self.of(face)[i])));
        let behind = seen.map(|seen| seen.map_or(none, |(_, behind)| behind / range));
        PatchCorner {
            places: seen.map(|seen| pack_place(seen.map_or(DVec2::ZERO, |(place, _)| place))),
            behind: [[0, 1], [2, 3]].map(|[a, b]| pack2x16unorm(DVec2::new(behind[a], behind[b]))),
        }
    }
}

impl Stripes {
    /// Whether a triangle is drawn in three.
    fn parts(&self, face: usize) -> bool {
        [&self.along, &self.across].into_iter().any(|phases| phases.get(face).is_some_and(|own| !own.is_linear()))
    }

    /// What the corners of one of the three carry, the one at `side`: the side's first, its second, and the middle.
    fn parted(&self, face: usize, side: usize) -> [LineCorner; 3] {
        let of = |phases: &[StripePhases]| phases.get(face).map(|own| own.at_side(side)).unwrap_or_default();
        let [(along, turns_along), (across, turns_across)] = [of(&self.along), of(&self.across)];
        [0, 1, 2].map(|k| LineCorner {
            phases: [along[k], across[k]],
            ring: [i8::from(k == 0), i8::from(k == 1), turns_along, turns_across],
        })
    }
}

#[cfg(test)]
mod tests;
