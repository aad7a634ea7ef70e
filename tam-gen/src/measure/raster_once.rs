//! The bound that the cost of a map is compared with.

use crate::map::{Map, StrokeList};
use crate::raster::{Footprint, Grain, Nib, TipError, over};

/// Draws every stroke of every hand-built level of a map once, and nothing else: no counting, no choosing, no columns.
/// Its time is what the cost of a map is a ratio to (METRICS, cost). Returns the ink drawn, summed over all texels, so
/// that the work cannot be left out; all families share the grain of the preset.
///
/// # Errors
/// The tip of a family cannot be read any more.
pub fn rasterise_once(map: &Map) -> Result<u64, TipError> {
    let nibs = map.strokes.families.iter().map(Nib::new).collect::<Result<Vec<_>, _>>()?;
    let mut footprint = Footprint::default();
    let mut drawn = 0;
    for (level, first_column) in map.grid.drawn().iter().zip(&map.strokes.first_column) {
        let grain = Grain::new(map.preset.stroke.grain as f32, level.size, map.preset.seed);
        let mut ink = vec![0_u8; (level.size * level.size) as usize];
        for (stroke, first) in map.strokes.strokes.iter().zip(first_column) {
            if *first == StrokeList::NEVER {
                continue;
            }
            nibs[usize::from(stroke.family)].footprint(stroke, level.size, &grain, &mut footprint);
            for (texel, above) in footprint.iter() {
                ink[texel] = over(ink[texel], above);
            }
        }
        drawn += ink.iter().map(|texel| u64::from(*texel)).sum::<u64>();
    }
    Ok(drawn)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Job, Preset, generate};

    #[test]
    fn all_strokes_drawn_once_are_the_darkest_column() {
        let mut preset = Preset::default();
        preset.map.size = 64;
        let map = generate(&preset, &Job::default()).expect("the default preset");
        let darkest = |level: &crate::Level| {
            level.cells.last().map_or(0, |cell| cell.iter().map(|texel| u64::from(*texel)).sum::<u64>())
        };
        let expected: u64 = map.grid.drawn().iter().map(darkest).sum();
        let drawn = rasterise_once(&map).expect("no tip");
        // The darkest column ends within a stroke of its tone; its last one is drawn whole here.
        assert!((drawn as f64 / expected as f64 - 1.0).abs() < 0.01, "{drawn} for {expected}");
    }
}
