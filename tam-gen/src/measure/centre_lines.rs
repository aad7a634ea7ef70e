//! Whether every stroke of a level is really inked along its centre line, in that level and all finer ones.
//!
//! A level that draws a stroke whole must ink it in its own lightest such column and all darker ones. By nesting of the
//! stroke list a stroke that a coarse level draws is also drawn by every finer level, so it is enough to take each level
//! with the lightest column in which it, or any coarser level, draws a stroke whole.

use rayon::prelude::*;

use crate::map::{Grid, StrokeList};
use crate::preset::StrokeOptions;
use crate::stroke::{Axis, Stroke};

/// Samples along the centre lines of the strokes of a level.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct CentreLines {
    /// Samples taken, over all whole strokes.
    pub samples: usize,
    /// Samples with less ink than the stroke must leave there, in its lightest or any darker column.
    pub missing: usize,
    /// For each column: the samples missing in that column's image.
    pub missing_of_column: Vec<usize>,
    /// Strokes not judged: those drawn with a tip, whose shape is free.
    pub skipped: usize,
}

impl CentreLines {
    /// What was found on some strokes and on others, of the same columns.
    fn and(mut self, other: Self) -> Self {
        self.samples += other.samples;
        self.missing += other.missing;
        self.skipped += other.skipped;
        for (missing, other) in self.missing_of_column.iter_mut().zip(other.missing_of_column) {
            *missing += other;
        }
        self
    }
}

/// Ink lost to rounding where strokes are composited one after another.
const ROUNDING: f64 = 2.0;

/// The least ink, `0.0 ..= 255.0`, that a stroke leaves in the texel that holds a point of its centre line, when the point
/// lies in the middle of a texel as seen along the scan axis, away from ends and tapers. `None` for strokes with a tip.
///
/// *Lines.* With slope `s` (across per along) the stroke covers `h = w/2 √(1 + s²)` across to either side. In the worst case the
/// line passes through the border of the texel, and half of it lies outside: `min(1, h)` is covered in the middle of the
/// texel. Over the texel's width the line moves by `s/2` to either side; what it gains on one is lost on the other except
/// where coverage saturates at 1, which costs the area of a triangle, `(|s|/2 - |1 - h|)² / 2|s|`. A rasteriser that takes
/// the coverage in the middle of each texel loses nothing; the bound holds for both.
///
/// *Dots.* In the worst case the centre lies in the corner of a texel, which then holds a quarter of the disc: `π r²/4`, and
/// no less than `π/4` where the disc reaches beyond the texel's sides. Small discs drawn by chords may lack a tenth of it.
///
/// Opacity multiplies the bound; grain withholds up to its own part of it; rounding takes two units of 255.
pub fn centre_line_floor(stroke: &Stroke, slope: f64, options: &StrokeOptions) -> Option<f64> {
    if options.tip.is_some() {
        return None;
    }
    let radius = 0.5 * f64::from(stroke.width_px);
    let coverage = if stroke.along_uv == 0.0 {
        0.9 * std::f64::consts::FRAC_PI_4 * radius.min(1.0) * radius.min(1.0)
    } else {
        let slope = slope.abs();
        let half_across = radius * (1.0 + slope * slope).sqrt();
        let clipped = (0.5 * slope - (1.0 - half_across).abs()).max(0.0);
        half_across.min(1.0) - clipped * clipped / (2.0 * slope.max(1e-9))
    };
    Some((coverage * options.opacity * (1.0 - options.grain) * 255.0 - ROUNDING).max(0.0))
}

/// Samples every whole stroke of a level once per texel along its scan axis, further than its taper and one texel from its
/// ends, and looks for ink in all columns that must hold it.
pub fn centre_lines(grid: &Grid, strokes: &StrokeList, level: usize) -> CentreLines {
    let cells = &grid.levels[level].cells;
    let size = grid.levels[level].size;
    let first = lightest_whole(strokes, level);
    let none = CentreLines { missing_of_column: vec![0; cells.len()], ..CentreLines::default() };
    let mut found = none.clone();
    // From dark to light, so that one image holds the least ink of a column and all darker ones.
    let mut least_ink = vec![u8::MAX; (size * size) as usize];
    for (column, ink) in cells.iter().enumerate().rev() {
        for (least, &ink) in least_ink.iter_mut().zip(ink) {
            *least = ink.min(*least);
        }
        let own = strokes.strokes.par_iter().zip(&first).filter(|(_, first)| usize::from(**first) == column);
        let of_stroke = |mut found: CentreLines, (stroke, _): (&Stroke, &u8)| {
            let options = &strokes.families[usize::from(stroke.family)].stroke;
            if options.tip.is_some() {
                found.skipped += 1;
                return found;
            }
            // Enough at any slope: hardly a sample has less.
            let enough = (options.opacity * (1.0 - options.grain) * 255.0 - ROUNDING).max(0.0);
            for_each_sample(stroke, size, margin_uv(stroke, options, size), |texel, slope| {
                found.samples += 1;
                if f64::from(least_ink[texel]) >= enough {
                    return;
                }
                let Some(floor) = centre_line_floor(stroke, slope, options) else { return };
                if f64::from(least_ink[texel]) < floor {
                    found.missing += 1;
                    for (ink, missing) in cells.iter().zip(&mut found.missing_of_column).skip(column) {
                        *missing += usize::from(f64::from(ink[texel]) < floor);
                    }
                }
            });
            found
        };
        found = found.and(own.fold(|| none.clone(), of_stroke).reduce(|| none.clone(), CentreLines::and));
    }
    found
}

/// The texels of a cell that lie on the centre line of a whole stroke and lack its ink.
pub fn missing_centre_lines(grid: &Grid, strokes: &StrokeList, level: usize, column: usize) -> Vec<bool> {
    let ink = &grid.levels[level].cells[column];
    let mut missing = vec![false; ink.len()];
    let first = lightest_whole(strokes, level);
    for (stroke, _) in strokes.strokes.iter().zip(&first).filter(|(_, first)| usize::from(**first) <= column) {
        let options = &strokes.families[usize::from(stroke.family)].stroke;
        let size = grid.levels[level].size;
        for_each_sample(stroke, size, margin_uv(stroke, options, size), |texel, slope| {
            let floor = centre_line_floor(stroke, slope, options);
            missing[texel] |= floor.is_some_and(|floor| f64::from(ink[texel]) < floor);
        });
    }
    missing
}

/// Calls `visit` with each texel, of an image of some size, on the centre line of a stroke, leaving out a part of its length
/// at either end (`0.0 .. 0.5`), and with the slope of the stroke there (across per along).
pub fn visit_centre_line(stroke: &Stroke, size: u32, ends: f64, visit: impl FnMut(usize, f64)) {
    for_each_sample(stroke, size, ends * f64::from(stroke.along_uv), visit);
}

/// How far a stroke is judged from its ends, in tiles: its taper and a texel more, which clears a butt or round end; strokes
/// wider than two texels have ends as long as half their width. Strokes may run against their axis, so either end may hold
/// either taper.
fn margin_uv(stroke: &Stroke, options: &StrokeOptions, size: u32) -> f64 {
    let end_px = (0.5 * f64::from(stroke.width_px)).max(1.0);
    options.taper_in.max(options.taper_out) * f64::from(stroke.along_uv) + end_px / f64::from(size)
}

/// For each stroke the lightest column in which this level or a coarser one draws it whole.
fn lightest_whole(strokes: &StrokeList, level: usize) -> Vec<u8> {
    let mut lightest = vec![StrokeList::NEVER; strokes.strokes.len()];
    for first in strokes.first_column.iter().skip(level) {
        for (lightest, &first) in lightest.iter_mut().zip(first) {
            *lightest = first.min(*lightest);
        }
    }
    lightest
}

/// Calls `visit` with the texel of each sample further than `margin_uv` from the ends, and the slope of the stroke there.
fn for_each_sample(stroke: &Stroke, size: u32, margin_uv: f64, mut visit: impl FnMut(usize, f64)) {
    let side = i64::from(size);
    // Divisions take longer than all the rest, and hardly a coordinate needs one.
    let wrapped = |at: i64| if (0..side).contains(&at) { at } else { at.rem_euclid(side) };
    let texel_of = |along: i64, across_uv: f64| {
        let (along, across) = (wrapped(along), wrapped(floor(across_uv * f64::from(size))));
        let (x, y) = match stroke.axis {
            Axis::X => (along, across),
            Axis::Y => (across, along),
        };
        (y * side + x) as usize
    };
    let (start, length) = (f64::from(stroke.start_uv), f64::from(stroke.along_uv));
    if stroke.along_uv == 0.0 {
        visit(texel_of(floor(start * f64::from(size)), f64::from(stroke.across_at(0.0))), 0.0);
        return;
    }
    let texel_uv = 1.0 / f64::from(size);
    let begin = (start + margin_uv) * f64::from(size);
    let end = (start + length - margin_uv) * f64::from(size);
    for along in (begin - 0.5).ceil() as i64..=(end - 0.5).floor() as i64 {
        let t = ((along as f64 + 0.5) * texel_uv - start) / length;
        let slope = f64::from(stroke.slope_at(t as f32));
        visit(texel_of(along, across_at(stroke, t)), slope);
    }
}

/// The largest whole number not above `x`, for `x` well inside the range of `i64`; without a call.
fn floor(x: f64) -> i64 {
    let towards_zero = x as i64;
    towards_zero - i64::from(towards_zero as f64 > x)
}

/// [`Stroke::across_at`] in double precision, so that a sample near the border of a texel does not change sides.
fn across_at(stroke: &Stroke, t: f64) -> f64 {
    let [c0, c1, c2, c3] = stroke.across_uv.map(f64::from);
    c0 + t * (c1 + t * (c2 + t * c3))
}
