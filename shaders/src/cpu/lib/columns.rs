//! Twin of `lib/columns.wgsl`: from a wanted darkness to the two columns that bracket it. Praun and others, "Real-Time
//! Hatching", 2001, section 5; Webb and others, "Fine tone control in hardware hatching", 2002, for many columns.

use glam::DVec2;

use super::material::{Material, column_tone};
use crate::cpu::builtin::mix;
use crate::cpu::{Form, MapImage};

/// Place of a darkness among the columns: 0 is white, `column_count` the darkest column, piecewise linear in the
/// columns' own tones; in the literal form as if they were evenly spaced up to black.
pub fn column_coordinate(form: Form, material: &Material, d: f64) -> f64 {
    let n = material.column_count;
    if form == Form::Literal {
        return d.clamp(0.0, 1.0) * f64::from(n);
    }
    if material.columns_per_tone > 0.0 {
        return (d * material.columns_per_tone).clamp(0.0, f64::from(n));
    }
    let guess = ((d.max(0.0) / column_tone(material, n).max(1e-6) * f64::from(n)) as u32).min(n - 1);
    let (mut low, mut high) = if column_tone(material, guess) > d {
        (0, guess)
    } else if column_tone(material, guess + 1) <= d {
        ((guess + 1).min(n - 1), n)
    } else {
        (guess, guess + 1)
    };
    while high - low > 1 {
        let middle = low.midpoint(high);
        if column_tone(material, middle) <= d {
            low = middle;
        } else {
            high = middle;
        }
    }
    let a = column_tone(material, low);
    let b = column_tone(material, high);
    f64::from(low) + ((d - a) / (b - a).max(1e-6)).clamp(0.0, 1.0)
}

/// Level of detail for a footprint in tiles per pixel, as if there were levels without end.
pub fn wanted_level(material: &Material, tiles_per_px: f64) -> f64 {
    (tiles_per_px * material.size_px).max(1e-6).log2() + material.level_bias
}

/// The same among those there are.
pub fn map_level(material: &Material, tiles_per_px: f64) -> f64 {
    wanted_level(material, tiles_per_px).clamp(0.0, material.level_count - 1.0)
}

/// The scale at which a map is sampled.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Scale {
    /// Footprint of a pixel.
    pub tiles_per_px: f64,
    /// The level that fits it.
    pub level: f64,
}

/// The scale for a footprint.
pub fn map_scale(material: &Material, tiles_per_px: f64) -> Scale {
    Scale { tiles_per_px, level: map_level(material, tiles_per_px) }
}

/// Columns to a darkness of 1 where these tones, without white, are evenly spaced; 0: they are not.
pub fn columns_per_tone(tones: &[f64]) -> f64 {
    let (count, darkest) = (tones.len() as f64, tones.last().copied().unwrap_or_default());
    let is_even = |(k, tone): (usize, &f64)| (tone - darkest * (k + 1) as f64 / count).abs() < 1e-7;
    if darkest > 1e-6 && tones.iter().enumerate().all(is_even) { count / darkest } else { 0.0 }
}

/// Ink of an array whose layer k holds column k and column k + 1 in its two channels (column 0 is white).
pub fn column_ink(material: &Material, map: &MapImage, uv: DVec2, level: f64, x: f64) -> f64 {
    let layer = x.floor().min(f64::from(material.column_count) - 1.0);
    let pair = map.sample_level(uv, layer as i32, level);
    mix(pair.x, pair.y, x - layer)
}
