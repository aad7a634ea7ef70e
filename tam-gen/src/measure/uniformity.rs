//! How evenly the strokes of a cell are spread.

use std::f64::consts::TAU;

use crate::stroke::Axis;

/// Standard deviation over mean of the means of all toroidal square windows of side `window` (in texels, `1 ..= size`); 0
/// for an even or empty image. METRICS names it CV(w), with w = S/4, S/8, S/16.
pub fn box_cv(ink: &[u8], size: u32, window: u32) -> f64 {
    let (size, window) = (size as usize, (window as usize).clamp(1, size as usize));
    // Integral image of the tile repeated by one window to the right and below, so that no window wraps.
    let side = size + window;
    let mut integral = vec![0_u64; (side + 1) * (side + 1)];
    for y in 0..side {
        let mut row = 0;
        for x in 0..side {
            row += u64::from(ink[y % size * size + x % size]);
            integral[(y + 1) * (side + 1) + x + 1] = integral[y * (side + 1) + x + 1] + row;
        }
    }
    let (mut sum, mut squares) = (0.0, 0.0);
    for y in 0..size {
        for x in 0..size {
            let at = |x: usize, y: usize| integral[y * (side + 1) + x];
            let total = (at(x + window, y + window) + at(x, y) - at(x + window, y) - at(x, y + window)) as f64;
            sum += total;
            squares += total * total;
        }
    }
    let (mean, count) = (sum, (size * size) as f64);
    if mean == 0.0 { 0.0 } else { (squares * count / (mean * mean) - 1.0).max(0.0).sqrt() }
}

/// Standard deviation over mean of the paper runs between strokes, measured across the family.
///
/// `along` is the axis along which the strokes run: gaps of `Axis::X` strokes are measured down the columns. A texel of at
/// least `half_ink` is stroke. Runs are toroidal; a line without ink is one gap of the tile's size.
pub fn gap_cv(ink: &[u8], size: u32, along: Axis, half_ink: u8) -> f64 {
    let mut gaps = Vec::new();
    for_each_line(ink, size, along, |line| gaps_of(line, half_ink.max(1), &mut gaps));
    let count = gaps.len().max(1) as f64;
    let mean = gaps.iter().sum::<f64>() / count;
    let variance = gaps.iter().map(|gap| (gap - mean) * (gap - mean)).sum::<f64>() / count;
    if mean == 0.0 { 0.0 } else { variance.sqrt() / mean }
}

/// Share of the AC power across the family that lies below half the mean stroke frequency, `0.0 ..= 1.0`.
///
/// The power is that of a one-dimensional Fourier transform of every line across the family, summed over the lines; the
/// stroke frequency is the mean number of ink runs (texels of at least `half_ink`) per line. Even strokes have little
/// power there, clumps and holes much. Only the frequencies needed are transformed; the total is Parseval's.
pub fn low_frequency_share(ink: &[u8], size: u32, along: Axis, half_ink: u8) -> f64 {
    let length = size as usize;
    let mut runs = 0;
    for_each_line(ink, size, along, |line| runs += runs_of(line, half_ink.max(1)));
    let cutoff = 0.5 * runs as f64 / length as f64;
    let waves: Vec<(f64, f64)> = (0..length)
        .map(|i| (libm::cos(TAU * i as f64 / length as f64), libm::sin(TAU * i as f64 / length as f64)))
        .collect();
    let bins = (1..=length / 2).take_while(|&frequency| (frequency as f64) < cutoff).last().unwrap_or(0);
    let (mut low, mut total) = (0.0, 0.0);
    for_each_line(ink, size, along, |line| {
        let sum: u64 = line.iter().map(|&ink| u64::from(ink)).sum();
        let squares: u64 = line.iter().map(|&ink| u64::from(ink) * u64::from(ink)).sum();
        total += length as f64 * squares as f64 - (sum * sum) as f64;
        for frequency in 1..=bins {
            let (mut re, mut im) = (0.0, 0.0);
            for (i, &ink) in line.iter().enumerate() {
                let (cos, sin) = waves[i * frequency % length];
                re += f64::from(ink) * cos;
                im += f64::from(ink) * sin;
            }
            // Every frequency but the highest has a mirror image of the same power.
            let mirrored = if 2 * frequency == length { 1.0 } else { 2.0 };
            low += mirrored * (re * re + im * im);
        }
    });
    if total == 0.0 { 0.0 } else { low / total }
}

/// Calls `visit` with the ink of every line across a family that runs along an axis.
fn for_each_line(ink: &[u8], size: u32, along: Axis, mut visit: impl FnMut(&[u8])) {
    let size = size as usize;
    let mut line = vec![0; size];
    for i in 0..size {
        for (j, texel) in line.iter_mut().enumerate() {
            *texel = match along {
                Axis::X => ink[j * size + i],
                Axis::Y => ink[i * size + j],
            };
        }
        visit(&line);
    }
}

/// Number of toroidal runs of ink.
fn runs_of(line: &[u8], half_ink: u8) -> usize {
    (0..line.len()).filter(|&i| line[i] >= half_ink && line[(i + line.len() - 1) % line.len()] < half_ink).count()
}

fn gaps_of(line: &[u8], half_ink: u8, gaps: &mut Vec<f64>) {
    let Some(first) = line.iter().position(|&ink| ink >= half_ink) else {
        gaps.push(line.len() as f64);
        return;
    };
    let mut gap = 0;
    for i in 1..=line.len() {
        if line[(first + i) % line.len()] < half_ink {
            gap += 1;
        } else if gap > 0 {
            gaps.push(f64::from(gap));
            gap = 0;
        }
    }
}
