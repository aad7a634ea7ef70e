//! A small map that holds every constraint, made with the simplest means, for tests to break.

use crate::map::{Closing, Family, Grid, Level, StrokeList, StrokeMap, ThresholdLevel};
use crate::preset::StrokeOptions;
use crate::stroke::{Axis, Stroke, wrap_unit};

/// What a synthetic map looks like.
#[derive(Debug, Clone)]
pub(crate) struct Synthetic {
    pub(crate) sizes: Vec<u32>,
    pub(crate) tones: Vec<f64>,
    pub(crate) width_px: f32,
    /// Largest slope of the strokes, either way.
    pub(crate) slope: f32,
    pub(crate) opacity: f64,
}

impl Default for Synthetic {
    fn default() -> Self {
        Self { sizes: vec![128, 64, 32], tones: vec![0.15, 0.3, 0.5, 0.7], width_px: 1.6, slope: 0.06, opacity: 1.0 }
    }
}

impl Synthetic {
    pub(crate) fn make(&self) -> (Grid, StrokeMap, StrokeList) {
        let strokes: Vec<Stroke> = (0..3000_u16).map(|i| self.stroke(i)).collect();
        let options = StrokeOptions {
            length_min: 0.3,
            length_max: 0.9,
            width_px: f64::from(self.width_px),
            opacity: self.opacity,
            ..StrokeOptions::default()
        };
        let family = Family { name: "h".into(), angle_deg: 0.0, stroke: options };
        let mut list = StrokeList { families: vec![family], strokes, ..StrokeList::default() };
        let (mut levels, mut thresholds) = (Vec::new(), Vec::new());
        for &size in &self.sizes {
            let level = self.level(size, &mut list);
            levels.push(level);
            thresholds.push(threshold_level(size, &list.strokes));
        }
        let grid = Grid { tones: self.tones.clone(), hand_built: levels.len(), levels };
        (grid, StrokeMap { levels: thresholds, distribution: Vec::new() }, list)
    }

    /// Rows by the golden ratio: well spaced at every prefix length.
    fn stroke(&self, i: u16) -> Stroke {
        let turn = |step: f64| wrap_unit((f64::from(i) * step).fract() as f32);
        let slope = self.slope * (2.0 * turn(0.286_194) - 1.0);
        let along_uv = 0.3 + 0.6 * turn(0.569_84);
        Stroke {
            family: 0,
            axis: Axis::X,
            start_uv: turn(0.754_877_666),
            along_uv,
            across_uv: [turn(0.618_033_988_75), slope * along_uv, 0.0, 0.0],
            width_px: self.width_px,
        }
    }

    fn level(&self, size: u32, list: &mut StrokeList) -> Level {
        let mut ink = vec![0_u8; (size * size) as usize];
        let mut first = vec![StrokeList::NEVER; list.strokes.len()];
        let (mut cells, mut closings, mut next) = (Vec::new(), Vec::new(), 0);
        for (column, tone) in self.tones.iter().enumerate() {
            let wanted = (tone * 255.0 * f64::from(size) * f64::from(size)).round() as u64;
            let sum = |ink: &[u8]| ink.iter().map(|&ink| u64::from(ink)).sum::<u64>();
            let closing = loop {
                let mut with_next = ink.clone();
                draw(&mut with_next, size, &list.strokes[next], self.opacity);
                if sum(&with_next) > wanted {
                    break with_next;
                }
                ink = with_next;
                first[next] = column as u8;
                next += 1;
            };
            let (mut cell, mut missing) = (ink.clone(), wanted - sum(&ink));
            let fraction = missing as f32 / (sum(&closing) - sum(&ink)) as f32;
            for (texel, &full) in cell.iter_mut().zip(&closing) {
                let added = u64::from(full - *texel).min(missing);
                *texel += added as u8;
                missing -= added;
            }
            cells.push(cell);
            closings.push(vec![Closing { stroke: next as u32, fraction }]);
        }
        list.first_column.push(first);
        list.closing.push(closings);
        Level { size, cells }
    }
}

/// Composites a stroke over an image: in each image column under it, the part of each texel between its two sides.
pub(crate) fn draw(ink: &mut [u8], size: u32, stroke: &Stroke, opacity: f64) {
    for_each_texel(size, stroke, |texel, coverage| {
        let paper = (255.0 - f64::from(ink[texel])) * (1.0 - coverage * opacity);
        ink[texel] = ink[texel].max((255.0 - paper).round() as u8);
    });
}

fn for_each_texel(size: u32, stroke: &Stroke, mut visit: impl FnMut(usize, f64)) {
    let (side, scale) = (i64::from(size), f64::from(size));
    let (start, end) = (f64::from(stroke.start_uv) * scale, f64::from(stroke.start_uv + stroke.along_uv) * scale);
    for along in start.floor() as i64..=end.floor() as i64 {
        let covered_along = (end.min((along + 1) as f64) - start.max(along as f64)).max(0.0);
        let t = ((along as f64 + 0.5 - start) / (end - start)).clamp(0.0, 1.0) as f32;
        let slope = f64::from(stroke.slope_at(t));
        let half = 0.5 * f64::from(stroke.width_px) * (1.0 + slope * slope).sqrt();
        let across = f64::from(stroke.across_at(t)) * scale;
        for row in (across - half).floor() as i64..=(across + half).floor() as i64 {
            let covered = (across + half).min((row + 1) as f64) - (across - half).max(row as f64);
            let (row, column) = (row.rem_euclid(side), along.rem_euclid(side));
            let texel = match stroke.axis {
                Axis::X => row * side + column,
                Axis::Y => column * side + row,
            };
            visit(texel as usize, covered.clamp(0.0, 1.0) * covered_along);
        }
    }
}

/// Each texel gets the rank, among all texels, at which the first stroke covers half of it; constant within a stroke.
fn threshold_level(size: u32, strokes: &[Stroke]) -> ThresholdLevel {
    let texels = (size * size) as usize;
    let mut threshold = vec![u8::MAX; texels];
    let (mut inked, mut count) = (vec![false; texels], 0_usize);
    for stroke in strokes {
        let mut new = Vec::new();
        for_each_texel(size, stroke, |texel, coverage| {
            if coverage >= 0.5 && !inked[texel] {
                inked[texel] = true;
                new.push(texel);
            }
        });
        let rank = (count as f64 + 0.5 * new.len() as f64) / texels as f64;
        new.iter().for_each(|&texel| threshold[texel] = (255.0 * rank).round() as u8);
        count += new.len();
    }
    ThresholdLevel { size, threshold }
}
