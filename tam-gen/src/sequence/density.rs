//! The density that a family's strokes have laid down so far, seen along the family, and the emptiest place in it.

use super::Draw;
use crate::rounding::ceil;
use crate::stroke::{Stroke, wrap_unit};

/// Columns along the strokes; enough to tell the gaps before and after a stroke from the one beside it.
const COLUMNS: usize = 16;
/// Rows across the strokes; a stroke's place is settled to one of them and jittered within it.
const ROWS: std::ops::RangeInclusive<usize> = 64..=2048;
/// Texels of the finest level in a row; the place within a row comes from its neighbours.
const TEXELS_PER_ROW: usize = 2;
/// Rows summed at once, over all columns, so that their sums never leave the registers. Divides the number of rows.
const BLOCK: usize = 32;
/// Core of the kernel in stroke widths.
const CORE_WIDTHS: f32 = 2.0;
/// Height of the noise an empty field starts with, in kernels: enough to break ties, too little to steer.
const NOISE: f32 = 1e-3;

/// Ink density along a family: `COLUMNS` columns along the strokes, each with `rows` rows across them, on the torus.
///
/// Every stroke adds the kernel `1 / (d + 2 w)` across itself, `d` and `w` in tiles. Its long tail is what spaces strokes at
/// all scales at once: the nearest stroke counts most, but a crowd far away counts too. A sharper core spaces neighbours
/// better and crowds worse: with `w/2` the low-frequency share at mid-tones was a tenth higher, and a faster decay
/// was worse by every measure.
#[derive(Debug, Clone)]
pub(super) struct DensityField {
    rows: usize,
    /// `COLUMNS` runs of `rows` numbers, each with its first `BLOCK` once more at its end: blocks that wrap are read straight.
    density: Vec<f32>,
    /// The kernel around row 0, on the circle of rows.
    kernel: Vec<f32>,
    /// Sum of densities under a candidate, for each row it could be put on.
    under: Vec<f32>,
}

impl DensityField {
    /// An empty field for strokes of the given width on a map of the given finest size.
    pub(super) fn new(size: u32, width_px: f32, draw: &Draw) -> Self {
        let rows = (size as usize / TEXELS_PER_ROW).clamp(*ROWS.start(), *ROWS.end());
        let core = CORE_WIDTHS * width_px / size as f32;
        let kernel: Vec<f32> = (0..rows).map(|row| 1.0 / (row.min(rows - row) as f32 / rows as f32 + core)).collect();
        let mut draw = draw.clone();
        draw.seek(u32::MAX - 1);
        // One number per row and column would cost more than a map's search; a few hundred, laid out twice, tell rows apart.
        let noise: Vec<f32> = (0..rows).map(|_| draw.unit() as f32 * NOISE * kernel[0]).collect();
        let noise_at = |column: usize, row: usize| noise[((column * rows + row) * 7 + column) % rows];
        let density = (0..COLUMNS).flat_map(|column| (0..rows + BLOCK).map(move |row| (column, row % rows)));
        let density = density.map(|(column, row)| noise_at(column, row)).collect();
        Self { rows, density, kernel, under: vec![0.0; rows] }
    }

    /// The row on which a stroke would meet the least density, and the mean density there. Ties go to the lowest row.
    ///
    /// `pressure` tells how much each part of the stroke counts: a pointed end neither needs nor takes as much room.
    pub(super) fn emptiest_row(&mut self, shape: &Stroke, pressure: impl Fn(f32) -> f32) -> (f32, f32) {
        let rows = self.rows;
        let mut columns = [(0, 0, 0.0); COLUMNS];
        let (mut count, mut counted) = (0, 0.0);
        for (column, row, t) in columns_under(shape, rows) {
            columns[count] = (column * (rows + BLOCK), row, pressure(t));
            counted += columns[count].2;
            count += 1;
        }
        // The minimum in lanes that the compiler can keep apart; then where it is.
        let mut lanes = [f32::INFINITY; 4];
        for under in self.under.as_chunks_mut::<BLOCK>().0 {
            let mut sums = [0.0; BLOCK];
            for (begin, row, weight) in &mut columns[..count] {
                for (sum, density) in sums.iter_mut().zip(&self.density[*begin + *row..][..BLOCK]) {
                    *sum += *weight * density;
                }
                *row += BLOCK;
                *row -= if *row >= rows { rows } else { 0 };
            }
            for four in sums.as_chunks::<4>().0 {
                for (lane, sum) in lanes.iter_mut().zip(four) {
                    *lane = if *sum < *lane { *sum } else { *lane };
                }
            }
            *under = sums;
        }
        let lowest = lanes.into_iter().fold(f32::INFINITY, f32::min);
        let row = self.first_row_of(lowest);
        // The lowest point of the parabola through the row and its neighbours.
        let (before, after) = (self.under[(row + self.rows - 1) % self.rows], self.under[(row + 1) % self.rows]);
        let bend = before - 2.0 * lowest + after;
        let within = if bend > 0.0 { 0.5 * (before - after) / bend } else { 0.0 };
        (lowest / counted, row as f32 + within)
    }

    /// The first row under which there is just so much density.
    fn first_row_of(&self, density: f32) -> usize {
        let (blocks, _) = self.under.as_chunks::<BLOCK>();
        // Without branches within a block.
        let holds = |block: &[f32; BLOCK]| block.iter().fold(false, |holds, under| holds | (*under == density));
        let first = blocks.iter().position(holds).unwrap_or(0) * BLOCK;
        first + self.under[first..].iter().position(|under| *under == density).unwrap_or(0)
    }

    /// The offset across, in uv, of a row.
    pub(super) fn uv_of_row(&self, row: f32) -> f32 {
        wrap_unit((row + 0.5) / self.rows as f32)
    }

    /// Adds a placed stroke. `weight` is its width over the family's.
    pub(super) fn add(&mut self, stroke: &Stroke, weight: f32, pressure: impl Fn(f32) -> f32) {
        for (column, row, t) in columns_under(stroke, self.rows) {
            let weight = weight * pressure(t);
            let density = &mut self.density[column * (self.rows + BLOCK)..][..self.rows + BLOCK];
            let (before, after) = density[..self.rows].split_at_mut(row);
            add_scaled(after, &self.kernel[..self.rows - row], weight);
            add_scaled(before, &self.kernel[self.rows - row..], weight);
            density.copy_within(..BLOCK, self.rows);
        }
    }
}

/// The columns under a stroke, with the row it crosses in the middle of each, and its `t` there; at least one.
fn columns_under(stroke: &Stroke, rows: usize) -> impl Iterator<Item = (usize, usize, f32)> + use<> {
    let stroke = *stroke;
    let (begin, end) =
        (stroke.start_uv * COLUMNS as f32 - 0.5, (stroke.start_uv + stroke.along_uv) * COLUMNS as f32 - 0.5);
    let mut first = ceil(begin);
    let mut count = ceil(end) - first;
    if count <= 0 {
        (first, count) = ((0.5 * (begin + end)).round() as i32, 1);
    }
    (first..first + count.min(COLUMNS as i32)).map(move |column| {
        let along_uv = (column as f32 + 0.5) / COLUMNS as f32 - stroke.start_uv;
        let t = if stroke.along_uv > 0.0 { (along_uv / stroke.along_uv).clamp(0.0, 1.0) } else { 0.5 };
        let row = (wrap_unit(stroke.across_at(t)) * rows as f32) as usize;
        (column.rem_euclid(COLUMNS as i32) as usize, row.min(rows - 1), t)
    })
}

#[inline]
fn add_scaled(sum: &mut [f32], more: &[f32], weight: f32) {
    for (sum, more) in sum.iter_mut().zip(more) {
        *sum += weight * more;
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::stroke::Axis;

    fn level_stroke(start_uv: f32, along_uv: f32, across: f32) -> Stroke {
        let across_uv = [across, 0.0, 0.0, 0.0];
        Stroke { family: 0, axis: Axis::X, start_uv, along_uv, across_uv, width_px: 1.6 }
    }

    #[test]
    fn the_emptiest_row_is_half_a_tile_from_a_lone_stroke() {
        let mut field = DensityField::new(256, 1.6, &Draw::new(1, "h"));
        field.add(&level_stroke(0.2, 0.9, 0.25), 1.0, |_| 1.0);
        let (_, row) = field.emptiest_row(&level_stroke(0.5, 0.4, 0.0), |_| 1.0);
        assert!((row - 96.0).abs() <= 2.0, "{row}");
    }

    #[test]
    fn a_stroke_shorter_than_a_column_still_sees_and_is_seen() {
        let mut field = DensityField::new(64, 1.6, &Draw::new(1, "h"));
        let short = level_stroke(0.999, 0.001, 0.0);
        let (before, _) = field.emptiest_row(&short, |_| 1.0);
        field.add(&level_stroke(0.999, 0.001, 0.5), 1.0, |_| 1.0);
        let (after, row) = field.emptiest_row(&short, |_| 1.0);
        assert!(after > before);
        assert!(!(8.0..=56.0).contains(&row), "{row}");
    }
}
