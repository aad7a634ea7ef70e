//! Dots: blue-noise spaced at every prefix, by always filling the largest void (after Ulichney's void-and-cluster, 1993,
//! with a kernel that narrows as the dots come closer).

use super::Draw;
use crate::stroke::wrap_unit;

/// Largest side of the grid of cells; dots are jittered within theirs.
const SIDE_MAX: u32 = 512;
/// Side of the blocks whose minima are kept.
const BLOCK: usize = 16;
/// Reach of a dot's kernel, in mean distances between dots: beyond it voids no longer feel the dot.
const REACH: f32 = 3.0;
/// Smallest reach in cells.
const REACH_MIN: f32 = 2.5;
/// Height of the noise that breaks ties, over the kernel's.
const NOISE: f32 = 1e-3;

/// How crowded each cell of the torus is.
#[derive(Debug, Clone)]
pub(super) struct DotField {
    side: usize,
    crowding: Vec<f32>,
    /// Lowest crowding in each block.
    block_minimum: Vec<f32>,
    kernel: Kernel,
}

/// `1 / (d + w/2)²` less its value at the reach, tabulated by cells.
#[derive(Debug, Clone)]
struct Kernel {
    reach: usize,
    /// `(2 reach + 1)²` numbers.
    table: Vec<f32>,
}

impl DotField {
    pub(super) fn new(size: u32, draw: &Draw) -> Self {
        let side = size.min(SIDE_MAX) as usize;
        let mut draw = draw.clone();
        draw.seek(u32::MAX - 1);
        let noise: Vec<f32> = (0..509).map(|_| draw.unit() as f32 * NOISE).collect();
        let crowding: Vec<f32> = (0..side * side).map(|cell| noise[(cell * 31) % noise.len()]).collect();
        let mut field = Self {
            side,
            crowding,
            block_minimum: vec![0.0; (side / BLOCK) * (side / BLOCK)],
            kernel: Kernel { reach: 0, table: Vec::new() },
        };
        for block in 0..field.block_minimum.len() {
            field.block_minimum[block] = field.minimum_in(block);
        }
        field
    }

    /// Puts the next dot, `index`, into the largest void and returns its place in uv. `weight` is its width over the
    /// family's, `width_px`. Takes two numbers.
    pub(super) fn place(&mut self, index: u32, weight: f32, width_px: f32, draw: &mut Draw) -> (f32, f32) {
        let cell = self.emptiest_cell();
        let (column, row) = (cell % self.side, cell / self.side);
        self.narrow_kernel(index, width_px);
        self.add(column, row, weight);
        let at = |cell: usize, jitter: f64| wrap_unit((cell as f32 + jitter as f32) / self.side as f32);
        (at(column, draw.unit()), at(row, draw.unit()))
    }

    fn emptiest_cell(&self) -> usize {
        let mut best = 0;
        for (block, minimum) in self.block_minimum.iter().enumerate() {
            if *minimum < self.block_minimum[best] {
                best = block;
            }
        }
        let minimum = self.block_minimum[best];
        self.cells_of(best)
            .find_map(|(begin, cells)| cells.iter().position(|crowding| *crowding == minimum).map(|i| begin + i))
            .expect("a block's minimum is one of its cells")
    }

    /// Index and contents of each row of a block.
    fn cells_of(&self, block: usize) -> impl Iterator<Item = (usize, &[f32])> {
        let per_row = self.side / BLOCK;
        let (left, top) = (block % per_row * BLOCK, block / per_row * BLOCK);
        (top..top + BLOCK).map(move |row| {
            let begin = row * self.side + left;
            (begin, &self.crowding[begin..begin + BLOCK])
        })
    }

    fn minimum_in(&self, block: usize) -> f32 {
        let mut lanes = [f32::INFINITY; BLOCK];
        for (_, cells) in self.cells_of(block) {
            for (lane, cell) in lanes.iter_mut().zip(cells) {
                *lane = if *cell < *lane { *cell } else { *lane };
            }
        }
        lanes.into_iter().fold(f32::INFINITY, f32::min)
    }

    /// Tabulates the kernel anew whenever the dots have come closer by a few per cent.
    fn narrow_kernel(&mut self, dots: u32, width_px: f32) {
        let side = self.side as f32;
        let wanted = (REACH * side / ((dots + 1) as f32).sqrt()).clamp(REACH_MIN, 0.5 * side - 1.0);
        let reach = wanted.ceil() as usize;
        if !self.kernel.table.is_empty() && reach as f32 > 0.95 * self.kernel.reach as f32 - 1.0 {
            return;
        }
        // A dot's own size matters once dots nearly touch; one cell is the finest the grid can tell.
        let core = (0.5 * width_px).max(0.5);
        let height = |distance: f32| (core / (distance + core)).powi(2);
        let edge = height(wanted);
        let across = 2 * reach + 1;
        let offset = |i: usize| i as f32 - reach as f32;
        let table = (0..across * across)
            .map(|i| {
                let (dx, dy) = (offset(i % across), offset(i / across));
                (height((dx * dx + dy * dy).sqrt()) - edge).max(0.0)
            })
            .collect();
        self.kernel = Kernel { reach, table };
    }

    fn add(&mut self, column: usize, row: usize, weight: f32) {
        let (side, reach) = (self.side, self.kernel.reach);
        let across = 2 * reach + 1;
        let left = (column + side - reach) % side;
        for (i, kernel) in self.kernel.table.chunks_exact(across).enumerate() {
            let begin = (row + side - reach + i) % side * side;
            let cells = &mut self.crowding[begin..begin + side];
            let straight = across.min(side - left);
            for (cell, more) in cells[left..].iter_mut().zip(&kernel[..straight]) {
                *cell += weight * more;
            }
            for (cell, more) in cells.iter_mut().zip(&kernel[straight..]) {
                *cell += weight * more;
            }
        }
        let per_row = side / BLOCK;
        let blocks = |centre: usize| {
            let first = (centre + side - reach) / BLOCK;
            let last = (centre + side + reach) / BLOCK;
            first..=last.min(first + per_row - 1)
        };
        for block_row in blocks(row) {
            for block_column in blocks(column) {
                let block = block_row % per_row * per_row + block_column % per_row;
                self.block_minimum[block] = self.minimum_in(block);
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Smallest toroidal distance between any two points, in mean spacings.
    fn closest_pair(points: &[(f32, f32)]) -> f32 {
        let wrapped = |d: f32| d.abs().min(1.0 - d.abs());
        let mut closest = f32::INFINITY;
        for (i, a) in points.iter().enumerate() {
            for b in &points[..i] {
                closest = closest.min(wrapped(a.0 - b.0).hypot(wrapped(a.1 - b.1)));
            }
        }
        closest * (points.len() as f32).sqrt()
    }

    #[test]
    fn every_prefix_of_the_dots_is_well_spaced_and_chance_is_not() {
        let mut draw = Draw::new(1, "dots");
        let mut field = DotField::new(256, &draw);
        let mut points = Vec::new();
        let mut random = Vec::new();
        for index in 0..2000 {
            draw.seek(index);
            points.push(field.place(index, 1.0, 2.0, &mut draw));
            random.push((draw.unit() as f32, draw.unit() as f32));
        }
        for count in [8, 30, 100, 333, 1000, 2000] {
            // Best possible (hexagonal) is 1.07; Poisson-disc sets reach about 0.7.
            let spacing = closest_pair(&points[..count]);
            assert!(spacing > 0.4, "{count} dots: {spacing}");
        }
        assert!(closest_pair(&random) < 0.1);
    }
}
