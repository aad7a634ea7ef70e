//! Width of strokes, measured on pixels.
//!
//! The measure of choice, twice the distance transform on the skeleton, is quantised to texels, too coarse for strokes of
//! one or two. Its sub-texel equivalent: the ink along the shortest chord through an inked texel, over the ink of a covered
//! texel. For a straight stroke that is its width, wherever in the stroke the texel lies and however the stroke falls on
//! the raster, since anti-aliasing keeps the ink.

use std::f64::consts::PI;
use std::sync::LazyLock;

/// The width of the strokes of an image.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct StrokeWidth {
    /// Median width in texels; 0 where nothing was measured.
    pub median_px: f64,
    /// Lower quartile of the same: where strokes touch or overlap, chords only ever grow.
    pub lower_px: f64,
    /// Number of texels it was measured at.
    pub samples: usize,
}

/// Directions of the chords, spread over half a turn; the nearest one is at most 5.6° off, which adds 0.5 %.
static DIRECTIONS: LazyLock<[(f64, f64); 16]> =
    LazyLock::new(|| std::array::from_fn(|i| PI * i as f64 / 16.0).map(|angle| (libm::cos(angle), libm::sin(angle))));
/// Step along a chord, in texels.
const STEP_PX: f64 = 0.25;
/// Most texels measured per image; more are thinned evenly.
const SAMPLES: usize = 256;
/// Longest chord looked for at first, in texels.
const FIRST_LIMIT_PX: f64 = 8.0;
/// A chord ends where the ink falls below this part of full ink: paper.
const PAPER: f64 = 0.02;
/// A chord ends in the valley before ink that rises by this part of full ink again: the next stroke.
const RISE: f64 = 0.1;

/// Median over texels of the ink along the chord through them, over `full_ink`, in that of 16 directions in which it is
/// least.
///
/// Only texels of at least half of `full_ink` (see [`super::full_ink`]) for which `select(x, y)` holds. Chords run through
/// the bilinearly filtered image to paper or to the valley before the next stroke, and are cut at the size of the tile.
/// Accuracy: 0.15 texels from 1.5 texels on. Thinner strokes hardly ever cover a texel, so that `full_ink` is too small: they
/// read as up to 0.45 texels too wide, equally at all levels.
pub fn stroke_width(ink: &[u8], size: u32, full_ink: u8, select: impl Fn(u32, u32) -> bool) -> StrokeWidth {
    let full_ink = f64::from(full_ink.max(1));
    // Ink is whole, so that this is half of the full ink and more.
    let half_ink = (0.5 * full_ink).ceil() as u8;
    let texels = || {
        let inked = ink.iter().enumerate().filter(|(_, ink)| **ink >= half_ink);
        inked.map(|(texel, _)| (texel as u32 % size, texel as u32 / size)).filter(|&(x, y)| select(x, y))
    };
    let step = texels().count().div_ceil(SAMPLES).max(1);
    let image = Bilinear { ink, size: size as usize, full_ink };
    let mut widths: Vec<f64> =
        texels().step_by(step).map(|(x, y)| least_chord(&image, (f64::from(x), f64::from(y)), &*DIRECTIONS)).collect();
    widths.sort_by(f64::total_cmp);
    let quantile = |i: usize| widths.get(i).copied().unwrap_or(0.0);
    StrokeWidth { median_px: quantile(widths.len() / 2), lower_px: quantile(widths.len() / 4), samples: widths.len() }
}

/// The same at one point `(u, v)` of the tile, in texels; `None` on less than half of `full_ink`.
pub fn stroke_width_at(ink: &[u8], size: u32, full_ink: u8, (u, v): (f64, f64)) -> Option<f64> {
    let full_ink = f64::from(full_ink.max(1));
    let image = Bilinear { ink, size: size as usize, full_ink };
    let (x, y) = (u * f64::from(size) - 0.5, v * f64::from(size) - 0.5);
    (image.at(x, y) >= 0.5 * full_ink).then(|| least_chord(&image, (x, y), &*DIRECTIONS))
}

fn least_chord(image: &Bilinear, centre: (f64, f64), directions: &[(f64, f64)]) -> f64 {
    // Most strokes are thin: look for a short chord first, so that no ray runs along a whole stroke.
    let mut limit = FIRST_LIMIT_PX.min(image.size as f64);
    loop {
        let mut least = limit;
        for &(dx, dy) in directions {
            let ahead = image.ink_along(centre, (dx, dy), least);
            if ahead < least {
                least = least.min(ahead + image.ink_along(centre, (-dx, -dy), least - ahead));
            }
        }
        if least < limit || limit >= image.size as f64 {
            return least;
        }
        limit = (4.0 * limit).min(image.size as f64);
    }
}

/// An image read between its texels; texel centres lie at whole coordinates.
struct Bilinear<'a> {
    ink: &'a [u8],
    size: usize,
    full_ink: f64,
}

impl Bilinear<'_> {
    fn at(&self, x: f64, y: f64) -> f64 {
        let (x0, y0) = (x.floor(), y.floor());
        let wrap = |i: f64| (i as i64).rem_euclid(self.size as i64) as usize;
        let (left, right) = (wrap(x0), wrap(x0 + 1.0));
        let (top, bottom) = (wrap(y0) * self.size, wrap(y0 + 1.0) * self.size);
        let (fx, fy) = (x - x0, y - y0);
        let ink = |i: usize| f64::from(self.ink[i]);
        let upper = ink(top + left) * (1.0 - fx) + ink(top + right) * fx;
        let lower = ink(bottom + left) * (1.0 - fx) + ink(bottom + right) * fx;
        upper * (1.0 - fy) + lower * fy
    }

    /// Ink along a ray, as a length in texels of full ink, at most `limit`.
    fn ink_along(&self, (x, y): (f64, f64), (dx, dy): (f64, f64), limit: f64) -> f64 {
        let mut before = self.at(x, y) / self.full_ink;
        let (mut sum, mut least, mut sum_at_least) = (0.0, before, 0.0);
        let mut distance = 0.0;
        while sum < limit && distance < self.size as f64 {
            distance += STEP_PX;
            let here = self.at(x + dx * distance, y + dy * distance) / self.full_ink;
            sum += 0.5 * STEP_PX * (before + here);
            if here < PAPER {
                return sum.min(limit);
            }
            if here > least + RISE && least < 0.5 {
                return sum_at_least;
            }
            if here < least {
                (least, sum_at_least) = (here, sum);
            }
            before = here;
        }
        limit
    }
}
