//! Maps as textures, packed as the passes sample them.

use tam_gen::{Grid, StrokeMap};
use tam_shaders::cpu::{MapImage, MapLevel, Sampling};

/// Layer k holds column k and column k + 1 in its first two channels, column 0 being white paper.
pub fn column_pairs(grid: &Grid) -> MapImage {
    let levels = grid.levels.iter().map(|level| {
        let texels = (level.size * level.size) as usize;
        let layer = |k: usize| {
            let lighter = |i: usize| k.checked_sub(1).map_or(0, |before| level.cells[before][i]);
            (0..texels).map(|i| [lighter(i), level.cells[k][i], 0, 255]).collect()
        };
        MapLevel { size: level.size, layers: (0..grid.columns()).map(layer).collect() }
    });
    MapImage { levels: levels.collect(), sampling: Sampling::Exact }
}

/// Six columns, named by index, in the colours of two layers; missing ones are paper.
pub fn six_columns(grid: &Grid, columns: &[usize]) -> MapImage {
    let levels = grid.levels.iter().map(|level| {
        let texels = (level.size * level.size) as usize;
        let ink = |k: usize, i: usize| columns.get(k).map_or(0, |column| level.cells[*column][i]);
        let layer =
            |first: usize| (0..texels).map(|i| [ink(first, i), ink(first + 1, i), ink(first + 2, i), 255]).collect();
        MapLevel { size: level.size, layers: vec![layer(0), layer(3)] }
    });
    MapImage { levels: levels.collect(), sampling: Sampling::Exact }
}

/// One layer: thresholds, and their change from texel to texel.
pub fn thresholds(stroke_map: &StrokeMap) -> MapImage {
    let levels = stroke_map.levels.iter().map(|level| {
        let steps = crate::maps::threshold_steps(level.size, &level.threshold);
        let layer = level.threshold.iter().zip(steps).map(|(threshold, step)| [*threshold, step, 0, 255]).collect();
        MapLevel { size: level.size, layers: vec![layer] }
    });
    MapImage { levels: levels.collect(), sampling: Sampling::Exact }
}
