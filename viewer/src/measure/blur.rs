//! Gaussian means inside a mask.

use rayon::prelude::*;

/// Cut of the Gaussian, in standard deviations: what lies beyond is 6e-5 of it.
const REACH_SIGMAS: f64 = 4.0;

/// A Gaussian that counts only what is inside a mask: G * (m x) / G * m. Separable; the sums run in a fixed order.
pub struct MaskedBlur<'a> {
    size: [u32; 2],
    mask: &'a [bool],
    /// Half of the kernel: weight at distance 0, 1, ….
    kernel: Vec<f64>,
    /// G * m; 0 outside of the mask.
    inside: Vec<f64>,
}

impl<'a> MaskedBlur<'a> {
    /// A Gaussian of this standard deviation, > 0, for pictures of a size with as many pixels as the mask.
    pub fn new(size: [u32; 2], mask: &'a [bool], sigma_px: f64) -> Self {
        let reach = (REACH_SIGMAS * sigma_px).ceil() as usize;
        let weight = |i: usize| (-0.5 * (i as f64 / sigma_px).powi(2)).exp();
        let kernel: Vec<f64> = (0..=reach).map(weight).collect();
        let ones: Vec<f64> = mask.iter().map(|inside| f64::from(u8::from(*inside))).collect();
        let inside = convolved(size, &ones, &kernel);
        Self { size, mask, kernel, inside }
    }

    /// The means of a picture's pixels; 0 outside of the mask.
    pub fn apply(&self, pixels: &[f64]) -> Vec<f64> {
        let masked: Vec<f64> = pixels.iter().zip(self.mask).map(|(x, inside)| if *inside { *x } else { 0.0 }).collect();
        let sums = convolved(self.size, &masked, &self.kernel);
        sums.iter()
            .zip(&self.inside)
            .zip(self.mask)
            .map(|((sum, weight), inside)| if *inside { sum / weight } else { 0.0 })
            .collect()
    }
}

fn convolved(size: [u32; 2], pixels: &[f64], kernel: &[f64]) -> Vec<f64> {
    let [width, height] = size.map(|side| side as usize);
    if width == 0 || height == 0 {
        return Vec::new();
    }
    let mut across = vec![0.0; pixels.len()];
    across.par_chunks_mut(width).zip(pixels.par_chunks(width)).for_each(|(out, row)| {
        for (x, out) in out.iter_mut().enumerate() {
            let (left, right) = (x.min(kernel.len() - 1), (width - 1 - x).min(kernel.len() - 1));
            let mut sum = kernel[0] * row[x];
            for d in 1..=left {
                sum += kernel[d] * row[x - d];
            }
            for d in 1..=right {
                sum += kernel[d] * row[x + d];
            }
            *out = sum;
        }
    });
    let mut both = vec![0.0; pixels.len()];
    both.par_chunks_mut(width).enumerate().for_each(|(y, out)| {
        let first = y.saturating_sub(kernel.len() - 1);
        let last = (y + kernel.len() - 1).min(height - 1);
        for other in first..=last {
            let weight = kernel[other.abs_diff(y)];
            for (out, x) in out.iter_mut().zip(&across[other * width..(other + 1) * width]) {
                *out += weight * x;
            }
        }
    });
    both
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_outside_the_mask_does_not_count() {
        let (width, height) = (40, 30);
        let mask: Vec<bool> = (0..width * height).map(|i| i % width < 20).collect();
        let pixels: Vec<f64> = mask.iter().map(|inside| if *inside { 0.25 } else { 1e6 }).collect();
        let blurred = MaskedBlur::new([width, height], &mask, 3.0).apply(&pixels);
        for (blurred, inside) in blurred.iter().zip(&mask) {
            assert!((blurred - if *inside { 0.25 } else { 0.0 }).abs() < 1e-12);
        }
    }

    #[test]
    fn a_point_becomes_a_gaussian_of_the_deviation_asked_for() {
        let side = 61_u32;
        let mask = vec![true; (side * side) as usize];
        let mut pixels = vec![0.0; mask.len()];
        pixels[(30 * side + 30) as usize] = 1.0;
        let blurred = MaskedBlur::new([side; 2], &mask, 4.0).apply(&pixels);
        let variance: f64 = (0..side * side)
            .map(|i| ((f64::from(i % side) - 30.0).powi(2), blurred[i as usize]))
            .map(|(square, weight)| square * weight)
            .sum();
        let sum: f64 = blurred.iter().sum();
        // The cut at four deviations takes 0.1 % of the variance.
        assert!((sum - 1.0).abs() < 1e-3 && ((variance / sum).sqrt() - 4.0).abs() < 0.01, "{sum} {variance}");
    }
}
