//! Tables that make stroke maps keep the tone when they are drawn: from filtered thresholds to shares.
//!
//! Filtering narrows the distribution of thresholds, which looking them up in it undoes (histogram equalisation). Yet edges are
//! ramps as wide as a pixel, and where thresholds are in the middle of their range they change faster, so ramps lose more
//! ink to one side than they gain at the other: some hundredths of tone. Tables are therefore bent until what is drawn has
//! the mean that was wanted.

use glam::DVec2;
use rayon::prelude::*;
use tam_gen::StrokeMap;
use tam_shaders::cpu::lib::threshold::{ROWS_PER_LEVEL, threshold_centred};

/// Entries of a row.
const ENTRIES: usize = 129;
/// Samples of a row, evenly spread: the mean of as many has an error of some thousandths.
const SAMPLES: usize = 1 << 14;
/// Classes of thresholds, and of how much they change.
const CLASSES: [usize; 2] = [256, 16];
/// Tones at which the mean ink is taken, evenly over 0 ..= 1.
const TONES: usize = 33;
/// Times that a table is bent at most, and the error of tone at which that ends.
const ROUNDS: usize = 6;
const CLOSE: f64 = 5e-4;

/// [`ROWS_PER_LEVEL`] rows from each level, finest first, to the next, and one for the coarsest: entry `i` is the share, 0 ..= 1, for a
/// filtered threshold of `i / (entries - 1)`, and its change with the threshold. Takes the place of
/// [`StrokeMap::distribution`] where edges are a pixel wide.
///
/// Exact within 0.001 where a pixel is as wide as a texel of the sampled level, as it is between the finest level and the
/// coarsest; nearer than that edges are sharper, and tone may be off by some thousandths.
pub fn tone_table(map: &StrokeMap) -> Vec<Vec<[f32; 2]>> {
    rows(&super::stroke_texels(map))
}

fn rows(levels: &[Level]) -> Vec<Vec<[f32; 2]>> {
    let last = levels.len().saturating_sub(1);
    let row = |row: usize| {
        let (finer, share) = (row / ROWS_PER_LEVEL, (row % ROWS_PER_LEVEL) as f64 / ROWS_PER_LEVEL as f64);
        let table = bent(&classes(&levels[finer], &levels[(finer + 1).min(last)], share));
        rated(&table).into_iter().map(|entry| entry.as_vec2().into()).collect()
    };
    (0..=last * ROWS_PER_LEVEL).into_par_iter().map(row).collect()
}

/// Side, and of each texel its threshold and how much it changes, 255 being 1.
type Level = (u32, Vec<u8>);

/// Samples that are much alike: their number, mean threshold, and mean change from texel to texel.
#[derive(Clone, Copy, Default)]
struct Class {
    count: f64,
    theta: f64,
    step: f64,
}

/// Samples of a level, with a share of the next at the same places.
fn classes(finer: &Level, coarser: &Level, share: f64) -> Vec<Class> {
    let mut classes = vec![Class::default(); CLASSES[0] * CLASSES[1]];
    for n in 0..SAMPLES {
        // Additive recurrence of the plastic number (Roberts 2018): evenly spread over the tile.
        let uv = [0.754_877_666_246_692_8, 0.569_840_290_998_053_3].map(|step| (0.5 + n as f64 * step).fract());
        let [a, b] = [finer, coarser].map(|level| bilinear(level, uv));
        let [theta, step] = [0, 1].map(|channel| (a[channel] + (b[channel] - a[channel]) * share) / 255.0);
        let of = |value: f64, classes: usize| ((value * classes as f64) as usize).min(classes - 1);
        // Steep edges differ less than gentle ones.
        let class = &mut classes[of(theta, CLASSES[0]) * CLASSES[1] + of(step.sqrt(), CLASSES[1])];
        *class = Class { count: class.count + 1.0, theta: class.theta + theta, step: class.step + step };
    }
    classes.retain(|class| class.count > 0.0);
    for class in &mut classes {
        (class.theta, class.step) = (class.theta / class.count, class.step / class.count);
    }
    classes
}

/// The table with which the mean ink of the samples is the tone.
fn bent(classes: &[Class]) -> Vec<f64> {
    let total: f64 = classes.iter().map(|class| class.count).sum();
    let mut table: Vec<f64> = (0..ENTRIES)
        .map(|i| {
            let theta = i as f64 / (ENTRIES - 1) as f64;
            classes.iter().filter(|class| class.theta <= theta).map(|class| class.count).sum::<f64>() / total
        })
        .collect();
    for _ in 0..ROUNDS {
        let entries = rated(&table);
        let drawn: Vec<f64> =
            (0..TONES).map(|i| mean_ink(classes, total, &entries, i as f64 / (TONES - 1) as f64)).collect();
        let error = |(i, ink): (usize, &f64)| (ink - i as f64 / (TONES - 1) as f64).abs();
        if drawn.iter().enumerate().map(error).fold(0.0, f64::max) < CLOSE {
            break;
        }
        // What is drawn at a tone becomes the share of the thresholds that were drawn half at it.
        let drawn = rated(&drawn);
        for share in &mut table {
            *share = interpolated(&drawn, *share).x;
        }
    }
    table
}

/// Mean ink at a tone, with one texel per pixel, as everywhere between the finest and the coarsest level.
fn mean_ink(classes: &[Class], total: f64, entries: &[DVec2], tone: f64) -> f64 {
    let ink = |class: &Class| {
        let entry = interpolated(entries, class.theta);
        class.count * threshold_centred(tone, entry.x, entry.y * class.step)
    };
    classes.iter().map(ink).sum::<f64>() / total
}

/// The entries of a table over 0 ..= 1 with their slopes, each taken from one neighbour to the other: between entries
/// slopes can then pass into each other.
fn rated(table: &[f64]) -> Vec<DVec2> {
    let last = table.len() - 1;
    let entry = |i: usize| {
        let [before, after] = [i.saturating_sub(1), (i + 1).min(last)];
        DVec2::new(table[i], (table[after] - table[before]) * last as f64 / (after - before) as f64)
    };
    (0..=last).map(entry).collect()
}

/// Value and slope at a place in 0 ..= 1.
fn interpolated(entries: &[DVec2], at: f64) -> DVec2 {
    let x = at.clamp(0.0, 1.0) * (entries.len() - 1) as f64;
    let i = (x as usize).min(entries.len() - 2);
    entries[i].lerp(entries[i + 1], x - i as f64)
}

/// Both channels of a level at a place on the tile.
fn bilinear((size, texels): &Level, uv: [f64; 2]) -> [f64; 2] {
    let [x, y] = uv.map(|place| place * f64::from(*size) - 0.5);
    let [left, top] = [x, y].map(|place| place.floor() as i64);
    let [fx, fy] = [x - left as f64, y - top as f64];
    let wrapped = |place: i64| place.rem_euclid(i64::from(*size)) as usize;
    let at = |dx: i64, dy: i64, channel: usize| {
        f64::from(texels[2 * (wrapped(top + dy) * *size as usize + wrapped(left + dx)) + channel])
    };
    [0, 1].map(|channel| {
        (1.0 - fy) * ((1.0 - fx) * at(0, 0, channel) + fx * at(1, 0, channel))
            + fy * ((1.0 - fx) * at(0, 1, channel) + fx * at(1, 1, channel))
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::maps::threshold_steps;

    /// Half of the tile is one stroke, the other a slope of thresholds.
    fn level(size: u32) -> Level {
        let thresholds: Vec<u8> = (0..size * size)
            .map(|texel| if texel / size < size / 2 { 40 } else { (90 + texel % size * 160 / size) as u8 })
            .collect();
        let steps = threshold_steps(size, &thresholds);
        (size, thresholds.iter().zip(steps).flat_map(|(threshold, step)| [*threshold, step]).collect())
    }

    fn worst(classes: &[Class], table: &[f64]) -> f64 {
        let entries = rated(table);
        let total = classes.iter().map(|class| class.count).sum();
        // Among the texels of one stroke nothing tells which to ink first.
        (20..32)
            .map(|i| f64::from(i) / 32.0)
            .map(|d| (mean_ink(classes, total, &entries, d) - d).abs())
            .fold(0.0, f64::max)
    }

    #[test]
    fn tables_rise_from_nothing_to_all() {
        let table = rows(&[level(32), level(16), level(8)]);
        assert_eq!(table.len(), 2 * ROWS_PER_LEVEL + 1);
        for row in table {
            let shares: Vec<f32> = row.iter().map(|entry| entry[0]).collect();
            assert!(shares.is_sorted() && shares[0] >= 0.0 && (shares[ENTRIES - 1] - 1.0).abs() < 0.01, "{shares:?}");
        }
    }

    #[test]
    fn bent_tables_keep_the_tone_better_than_equalised_ones() {
        let classes = classes(&level(64), &level(32), 0.5);
        let total: f64 = classes.iter().map(|class| class.count).sum();
        let equalised: Vec<f64> = (0..ENTRIES)
            .map(|i| {
                let theta = i as f64 / (ENTRIES - 1) as f64;
                let at_most = classes.iter().filter(|class| class.theta <= theta).map(|class| class.count).sum::<f64>();
                at_most / total
            })
            .collect();
        let [before, after] = [equalised, bent(&classes)].map(|table| worst(&classes, &table));
        assert!(after < 0.003 && after < 0.5 * before, "{before} {after}");
    }
}
