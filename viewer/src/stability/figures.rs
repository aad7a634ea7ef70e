//! Figures of small pictures in linear light, one sample per pixel.

use std::ops::Range;

/// Pixels that hold something that is no number.
pub fn nan_count(pixels: &[[f32; 4]]) -> usize {
    pixels.iter().filter(|pixel| pixel.iter().any(|channel| !channel.is_finite())).count()
}

/// Mean absolute difference of the first channel, over pixels drawn in either picture.
pub fn difference(a: &[[f32; 4]], b: &[[f32; 4]]) -> f64 {
    let differences: Vec<f64> = a
        .iter()
        .zip(b)
        .filter(|(a, b)| a[0] != 1.0 || b[0] != 1.0)
        .map(|(a, b)| f64::from((a[0] - b[0]).abs()))
        .collect();
    differences.iter().sum::<f64>() / differences.len().max(1) as f64
}

/// Pixels whiter than paper or blacker than ink, by more than rounding.
pub(super) fn beyond_count(pixels: &[[f32; 4]]) -> usize {
    pixels.iter().filter(|pixel| !(-0.001..=1.001).contains(&pixel[0])).count()
}

/// Pixels of more ink than paper; NaN if any pixel is no number.
pub(super) fn inked_count(pixels: &[[f32; 4]]) -> f64 {
    if nan_count(pixels) > 0 {
        return f64::NAN;
    }
    pixels.iter().filter(|pixel| pixel[0] < 0.5).count() as f64
}

/// Mean ink of the square in the middle of a square picture, `inside` in both directions.
pub(super) fn mean_ink(pixels: &[[f32; 4]], side: u32, inside: Range<usize>) -> f64 {
    let rows = pixels.chunks(side as usize).skip(inside.start).take(inside.len());
    let inked: Vec<f64> = rows.flat_map(|row| &row[inside.clone()]).map(|pixel| 1.0 - f64::from(pixel[0])).collect();
    inked.iter().sum::<f64>() / inked.len().max(1) as f64
}
