//! Whether an image continues across its edges.

use crate::stroke::Axis;

/// How the wrap edge of an image compares with the lines inside it. All numbers are mean |difference| of ink across a line
/// between texels, over the median of the same of the interior lines.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Seam {
    /// The wrap edge; 1 for an edge like any other line.
    pub ratio: f64,
    /// 2nd percentile of the interior lines, less a quarter of the distance to the 98th.
    pub low: f64,
    /// 98th percentile of the interior lines, and a quarter of the same distance.
    pub high: f64,
}

/// Half a unit of ink: below this mean difference a line counts as having none, so that ratios stay finite.
const FLOOR: f64 = 0.5;

/// Share of the interior lines that counts as unusual on either side.
const TAIL: f64 = 0.02;

/// Mean |difference| of ink, `0.0 ..= 255.0`, across each line between texels.
///
/// `Axis::X` walks along rows: entry `i` lies between image columns `i` and `i + 1`, and the last between the last and the
/// first. `Axis::Y` the same down the columns.
pub fn line_differences(ink: &[u8], size: u32, axis: Axis) -> Vec<f64> {
    let size = size as usize;
    let mut sums = vec![0_u32; size];
    for (y, row) in ink.chunks_exact(size.max(1)).enumerate() {
        match axis {
            Axis::X => {
                for ((sum, ink), next) in sums.iter_mut().zip(row).zip(&row[1..]) {
                    *sum += u32::from(ink.abs_diff(*next));
                }
                sums[size - 1] += u32::from(row[size - 1].abs_diff(row[0]));
            }
            Axis::Y => {
                let next = &ink[(y + 1) % size * size..][..size];
                sums[y] = row.iter().zip(next).map(|(ink, next)| u32::from(ink.abs_diff(*next))).sum();
            }
        }
    }
    sums.into_iter().map(|sum| f64::from(sum) / size as f64).collect()
}

/// Compares the wrap edge with the interior lines, pooled over images of one size.
///
/// A single line is a small sample (a row of a horizontally hatched image is all stroke or all gap), hence the spread of
/// the interior lines beside the ratio: a sound edge stays inside it.
pub fn seam(images: &[&[u8]], size: u32, axis: Axis) -> Seam {
    let mut lines = vec![0.0; size as usize];
    for ink in images {
        for (line, difference) in lines.iter_mut().zip(line_differences(ink, size, axis)) {
            *line += difference / images.len() as f64;
        }
    }
    let wrap = lines.pop().unwrap_or(0.0);
    lines.sort_by(f64::total_cmp);
    let at = |share: f64| lines.get((share * (lines.len().max(1) - 1) as f64).round() as usize).copied().unwrap_or(0.0);
    let median = at(0.5).max(FLOOR);
    let (low, high) = (at(TAIL) / median, at(1.0 - TAIL) / median);
    let margin = 0.25 * (high - low);
    let ratio = if wrap.max(at(0.5)) < FLOOR { 1.0 } else { wrap / median };
    Seam { ratio, low: low - margin, high: high + margin }
}
