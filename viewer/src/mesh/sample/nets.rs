//! Closed triangle meshes of signed distance functions: surface nets on a sparse grid, moved onto the surface and
//! relaxed along it.
//!
//! One vertex per cell that the surface crosses, one quad per grid edge that it crosses: triangles near half squares,
//! where marching cubes leaves slivers. Such a mesh is closed and manifold where the surface cuts every cell in one
//! sheet; where it would cut one in two, in gaps narrower than a cell, the gap is filled first.
//!
//! Source: S. Gibson, "Constrained elastic surface nets", MICCAI 1998.

use std::collections::HashSet;

use glam::{IVec3, UVec3, Vec3};
use rayon::prelude::*;

/// Cells along the side of a block: blocks without a surface are never sampled.
const BLOCK: usize = 4;
/// Samples along the side of a block, both ends included.
const SAMPLES: usize = BLOCK + 1;
/// Blocks along the side of the cubes that are judged first.
const CLUSTER: u32 = 4;
/// How much faster than a true distance the functions may change; blends and ellipsoids stay below. Where one does
/// not, the surface is still followed from block to block.
const STEEPNESS: f32 = 1.4;
const NONE: u32 = u32::MAX;
/// A cell has no vertex.
const EMPTY: u8 = u8::MAX;

/// A signed distance function, negative inside, and the box about the origin that holds its surface.
pub(super) struct Solid<'a> {
    pub(super) distance: &'a (dyn Fn(Vec3) -> f32 + Sync),
    pub(super) half_extent: Vec3,
}

/// What a grid finds of a solid.
pub(super) struct Net {
    pub(super) positions: Vec<Vec3>,
    /// Vertices of each quad, counter-clockwise seen from outside.
    pub(super) quads: Vec<[u32; 4]>,
}

struct Block {
    place: UVec3,
    samples: [f32; SAMPLES * SAMPLES * SAMPLES],
}

/// Vertices of one block.
struct Cells {
    local: [u8; BLOCK * BLOCK * BLOCK],
    positions: Vec<Vec3>,
}

/// The samples near the surface.
struct Field<'a> {
    solid: &'a Solid<'a>,
    grid: Grid,
    blocks: Vec<Block>,
    /// Per block of the grid: its index in `blocks`, or [`NONE`].
    slots: Vec<u32>,
    /// Grid points outside that count as inside.
    filled: HashSet<UVec3>,
}

/// Where grid points lie.
struct Grid {
    origin: Vec3,
    cell: f32,
    blocks: UVec3,
}

impl Grid {
    fn around(solid: &Solid, cell: f32) -> Self {
        let blocks = (solid.half_extent * 2.0 / (cell * BLOCK as f32)).ceil().as_uvec3() + 2;
        // Off the planes of symmetry, where samples would be zero.
        let origin = (blocks * BLOCK as u32).as_vec3() * cell * -0.5 + Vec3::new(0.37, 0.41, 0.29) * cell;
        Self { origin, cell, blocks }
    }

    fn point(&self, place: UVec3) -> Vec3 {
        self.origin + place.as_vec3() * self.cell
    }

    fn block_index(&self, block: UVec3) -> usize {
        (block.x + self.blocks.x * (block.y + self.blocks.y * block.z)) as usize
    }
}

fn sample_index(place: UVec3) -> usize {
    place.x as usize + SAMPLES * (place.y as usize + SAMPLES * place.z as usize)
}

fn cell_index(place: UVec3) -> usize {
    place.x as usize + BLOCK * (place.y as usize + BLOCK * place.z as usize)
}

fn places(counts: UVec3) -> impl Iterator<Item = UVec3> {
    (0..counts.z).flat_map(move |z| (0..counts.y).flat_map(move |y| (0..counts.x).map(move |x| UVec3::new(x, y, z))))
}

const CORNERS: [UVec3; 8] = [
    UVec3::new(0, 0, 0),
    UVec3::new(1, 0, 0),
    UVec3::new(0, 1, 0),
    UVec3::new(1, 1, 0),
    UVec3::new(0, 0, 1),
    UVec3::new(1, 0, 1),
    UVec3::new(0, 1, 1),
    UVec3::new(1, 1, 1),
];

/// Finds the surface at grid spacing `cell`; vertices lie within a cell of it, not yet on it.
pub(super) fn extract(solid: &Solid, cell: f32) -> Net {
    let mut field = Field::new(solid, Grid::around(solid, cell));
    field.fill_narrow_gaps();
    let Field { grid, blocks, slots, .. } = field;
    let cells: Vec<Cells> = blocks.par_iter().map(|block| cells_of(block, &grid)).collect();

    let mut bases = Vec::with_capacity(cells.len());
    let mut positions = Vec::new();
    for block in &cells {
        bases.push(positions.len() as u32);
        positions.extend_from_slice(&block.positions);
    }
    let vertex = |place: UVec3| {
        let slot = slots[grid.block_index(place / BLOCK as u32)] as usize;
        let local = cells[slot].local[cell_index(place % BLOCK as u32)];
        assert!(local != EMPTY, "a cell beside a crossed edge holds a vertex");
        bases[slot] + u32::from(local)
    };
    let quads = blocks.par_iter().flat_map_iter(|block| quads_of(block, &vertex)).collect();
    Net { positions, quads }
}

impl<'a> Field<'a> {
    /// Samples all blocks that the surface passes: those near by their distance, then the neighbours that it runs into.
    fn new(solid: &'a Solid<'a>, grid: Grid) -> Self {
        let near = |centre: Vec3, side: f32| (solid.distance)(centre).abs() <= STEEPNESS * side * 0.5 * 3f32.sqrt();
        let block_side = grid.cell * BLOCK as f32;
        let clusters: Vec<UVec3> = places((grid.blocks + (CLUSTER - 1)) / CLUSTER).collect();
        let todo: Vec<UVec3> = clusters
            .into_par_iter()
            .filter(|&cluster| {
                let side = block_side * CLUSTER as f32;
                near(grid.point(cluster * CLUSTER * BLOCK as u32) + side * 0.5, side)
            })
            .flat_map_iter(|cluster| places(UVec3::splat(CLUSTER)).map(move |block| cluster * CLUSTER + block))
            .filter(|&block| {
                block.cmplt(grid.blocks).all() && near(grid.point(block * BLOCK as u32) + block_side * 0.5, block_side)
            })
            .collect();
        let slots = vec![NONE; grid.blocks.element_product() as usize];
        let mut field = Self { solid, grid, blocks: Vec::new(), slots, filled: HashSet::new() };
        field.follow(todo);
        field
    }

    /// Samples the blocks `todo` that are not yet, and on from them wherever the surface leaves a block.
    fn follow(&mut self, mut todo: Vec<UVec3>) {
        while !todo.is_empty() {
            todo.retain(|&place| {
                let slot = &mut self.slots[self.grid.block_index(place)];
                let new = *slot == NONE;
                // Any number but NONE: the right one follows when the block is there.
                *slot = 0;
                new
            });
            let new: Vec<Block> = todo.par_iter().map(|&place| self.sample(place)).collect();
            todo.clear();
            for block in new {
                self.slots[self.grid.block_index(block.place)] = self.blocks.len() as u32;
                todo.extend(self.unsampled_neighbours(&block));
                self.blocks.push(block);
            }
        }
    }

    fn unsampled_neighbours(&self, block: &Block) -> impl Iterator<Item = UVec3> {
        (0..6).filter(|&side| crosses_side(block, side)).filter_map(move |side| {
            let next = block.place.as_ivec3() + side_step(side);
            let inside = next.cmpge(IVec3::ZERO).all() && next.cmplt(self.grid.blocks.as_ivec3()).all();
            let next = next.as_uvec3();
            (inside && self.slots[self.grid.block_index(next)] == NONE).then_some(next)
        })
    }

    fn sample(&self, place: UVec3) -> Block {
        let mut samples = [0.0; SAMPLES * SAMPLES * SAMPLES];
        for (at, sample) in places(UVec3::splat(SAMPLES as u32)).zip(&mut samples) {
            let point = place * BLOCK as u32 + at;
            let filled = !self.filled.is_empty() && self.filled.contains(&point);
            *sample = if filled { self.fill() } else { (self.solid.distance)(self.grid.point(point)) };
        }
        Block { place, samples }
    }

    fn fill(&self) -> f32 {
        -0.05 * self.grid.cell
    }

    /// Turns the outside corner nearest to the surface inside in every cell that is cut in two sheets, until none is.
    fn fill_narrow_gaps(&mut self) {
        let single_sheet = single_sheet_table();
        loop {
            let found: Vec<UVec3> =
                self.blocks.par_iter().flat_map_iter(|block| gaps_of(block, &single_sheet)).collect();
            if found.is_empty() {
                break;
            }
            self.filled.extend(&found);
            let mut changed = Vec::new();
            for point in found {
                // A point on the border of blocks has a sample in each.
                for offset in CORNERS {
                    let at = point % BLOCK as u32 + offset * BLOCK as u32;
                    if at.cmple(UVec3::splat(BLOCK as u32)).all() {
                        let slot = self.slots[self.grid.block_index(point / BLOCK as u32 - offset)];
                        if slot != NONE {
                            self.blocks[slot as usize].samples[sample_index(at)] = self.fill();
                            changed.push(slot);
                        }
                    }
                }
            }
            changed.sort_unstable();
            changed.dedup();
            let todo =
                changed.iter().flat_map(|&slot| self.unsampled_neighbours(&self.blocks[slot as usize])).collect();
            self.follow(todo);
        }
    }
}

/// In each cell of a block that is cut in two sheets: the outside corner nearest to the surface, as a grid point.
fn gaps_of(block: &Block, single_sheet: &[bool; 256]) -> Vec<UVec3> {
    places(UVec3::splat(BLOCK as u32))
        .filter_map(|place| {
            let values = corner_values(block, place);
            if single_sheet[inside_corners(&values)] {
                return None;
            }
            let nearest = (0..8).filter(|&k| values[k] >= 0.0).min_by(|&a, &b| values[a].total_cmp(&values[b]))?;
            Some(block.place * BLOCK as u32 + place + CORNERS[nearest])
        })
        .collect()
}

fn corner_values(block: &Block, cell: UVec3) -> [f32; 8] {
    CORNERS.map(|corner| block.samples[sample_index(cell + corner)])
}

/// One bit per corner.
fn inside_corners(values: &[f32; 8]) -> usize {
    values.iter().enumerate().fold(0, |signs, (k, &d)| signs | usize::from(d < 0.0) << k)
}

fn side_step(side: usize) -> IVec3 {
    IVec3::AXES[side / 2] * if side.is_multiple_of(2) { -1 } else { 1 }
}

fn crosses_side(block: &Block, side: usize) -> bool {
    let axis = side / 2;
    let (u, v) = (UVec3::AXES[(axis + 1) % 3], UVec3::AXES[(axis + 2) % 3]);
    let start = UVec3::AXES[axis] * if side.is_multiple_of(2) { 0 } else { BLOCK as u32 };
    let inside = |i: usize| {
        let at = start + u * (i % SAMPLES) as u32 + v * (i / SAMPLES) as u32;
        block.samples[sample_index(at)] < 0.0
    };
    let first = inside(0);
    (1..SAMPLES * SAMPLES).any(|i| inside(i) != first)
}

fn cells_of(block: &Block, grid: &Grid) -> Cells {
    let mut cells = Cells { local: [EMPTY; BLOCK * BLOCK * BLOCK], positions: Vec::new() };
    for place in places(UVec3::splat(BLOCK as u32)) {
        let values = corner_values(block, place);
        if matches!(inside_corners(&values), 0 | 255) {
            continue;
        }
        let mut sum = Vec3::ZERO;
        let mut crossings = 0.0;
        for a in 0..8 {
            for bit in [1, 2, 4] {
                let b = a | bit;
                if b != a && (values[a] < 0.0) != (values[b] < 0.0) {
                    let t = values[a] / (values[a] - values[b]);
                    sum += CORNERS[a].as_vec3().lerp(CORNERS[b].as_vec3(), t);
                    crossings += 1.0;
                }
            }
        }
        cells.local[cell_index(place)] = cells.positions.len() as u8;
        cells.positions.push(grid.point(block.place * BLOCK as u32 + place) + sum / crossings * grid.cell);
    }
    cells
}

fn quads_of(block: &Block, vertex: &impl Fn(UVec3) -> u32) -> Vec<[u32; 4]> {
    let mut quads = Vec::new();
    for place in places(UVec3::splat(BLOCK as u32)) {
        let start_inside = block.samples[sample_index(place)] < 0.0;
        for axis in 0..3 {
            let (along, u, v) = (UVec3::AXES[axis], UVec3::AXES[(axis + 1) % 3], UVec3::AXES[(axis + 2) % 3]);
            let end_inside = block.samples[sample_index(place + along)] < 0.0;
            if start_inside != end_inside {
                let cell = block.place * BLOCK as u32 + place;
                let mut quad = [vertex(cell - u - v), vertex(cell - v), vertex(cell), vertex(cell - u)];
                if end_inside {
                    quad.reverse();
                }
                quads.push(quad);
            }
        }
    }
    quads
}

/// For each set of inside corners: are the inside corners connected along cell edges, and the outside ones too? Then
/// the surface cuts the cell in one disc and no face in two segments.
fn single_sheet_table() -> [bool; 256] {
    let connected = |set: usize| {
        let mut reached = set & set.wrapping_neg();
        for _ in 0..8 {
            for k in (0..8).filter(|k| reached >> k & 1 == 1).collect::<Vec<_>>() {
                reached |= (1 << (k ^ 1) | 1 << (k ^ 2) | 1 << (k ^ 4)) & set;
            }
        }
        reached == set
    };
    std::array::from_fn(|signs| connected(signs) && connected(!signs & 255))
}

/// Value and gradient from four samples on a tetrahedron of half edge `step`.
fn slope(distance: impl Fn(Vec3) -> f32, p: Vec3, step: f32) -> (f32, Vec3) {
    const TIPS: [Vec3; 4] =
        [Vec3::new(1.0, -1.0, -1.0), Vec3::new(-1.0, -1.0, 1.0), Vec3::new(-1.0, 1.0, -1.0), Vec3::new(1.0, 1.0, 1.0)];
    let values = TIPS.map(|tip| distance(p + tip * step));
    let gradient = TIPS.iter().zip(values).map(|(&tip, d)| tip * d).sum::<Vec3>() / (4.0 * step);
    (values.iter().sum::<f32>() * 0.25, gradient)
}

/// Evens out the mesh along the surface and moves every vertex onto it. `polygons` are closed and oriented.
pub(super) fn relax<const N: usize>(
    solid: &Solid,
    positions: &mut Vec<Vec3>,
    polygons: &[[u32; N]],
    cell: f32,
    rounds: usize,
) {
    let mut sums = vec![(Vec3::ZERO, 0.0f32); positions.len()];
    for _ in 0..rounds {
        sums.fill((Vec3::ZERO, 0.0));
        for polygon in polygons {
            for (k, &from) in polygon.iter().enumerate() {
                let (sum, count) = &mut sums[from as usize];
                *sum += positions[polygon[(k + 1) % N] as usize];
                *count += 1.0;
            }
        }
        positions.par_iter_mut().zip(&sums).for_each(|(p, &(sum, count))| {
            let (value, gradient) = slope(solid.distance, *p, 0.2 * cell);
            let steepness = gradient.length_squared().max(0.05);
            let wish = sum / count - *p;
            let tangential = wish - gradient * (wish.dot(gradient) / steepness);
            let normal = gradient * (-value / steepness);
            *p += tangential * 0.6 + normal.clamp_length_max(0.5 * cell);
        });
    }
}
