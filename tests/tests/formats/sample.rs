//! A map made by hand: nested parallel lines whose every texel is known.

use tam_gen::preset::{StrokeOptions, Tones};
use tam_gen::{Axis, Closing, Family, Grid, Level, Map, Preset, Stroke, StrokeList, StrokeMap, ThresholdLevel};

/// Lines along the rows, two texels wide, evenly spread; column `k` has the first `(k + 1) * lines / (columns + 1)`.
///
/// Rows are taken in bit-reversed order, so that every prefix is spread and columns and levels nest.
pub(crate) fn map(columns: usize, size: u32, coarsest: u32, tail: bool) -> Map {
    let mut preset = Preset { description: "Nested parallel lines".into(), ..Preset::default() };
    preset.map.size = size;
    preset.map.coarsest = coarsest;
    preset.map.tail = tail;
    preset.map.tones = Tones::Count(columns as u32);
    let tones = preset.map.tones.list();

    let sizes: Vec<u32> = std::iter::successors(Some(size), |size| (*size > coarsest).then_some(size / 2)).collect();
    let drawn = |size: u32, k: usize| (tones[k] * f64::from(size / 2)).round() as u32;
    let mut levels: Vec<Level> = sizes
        .iter()
        .map(|&size| Level { size, cells: (0..columns).map(|k| lines(size, drawn(size, k))).collect() })
        .collect();
    let hand_built = levels.len();
    while tail && levels.last().is_some_and(|level| level.size > 1) {
        levels.push(halved(&levels[levels.len() - 1]));
    }

    let stroke = |row: u32| Stroke {
        family: 0,
        axis: Axis::X,
        start_uv: 0.75,
        along_uv: 1.0,
        across_uv: [(2.0 * row as f32 + 1.0) / size as f32, 0.0, 0.0, 0.0],
        width_px: 2.0,
    };
    let count = size / 2;
    let strokes: Vec<Stroke> = (0..drawn(size, columns - 1)).map(|i| stroke(spread(i, count))).collect();
    let first_column = |size: u32| {
        (0..strokes.len() as u32)
            .map(|i| (0..columns).find(|&k| i < drawn(size, k)).map_or(StrokeList::NEVER, |k| k as u8))
            .collect()
    };
    let threshold = |size: u32| {
        let cells = (0..columns).map(|k| lines(size, drawn(size, k))).collect::<Vec<_>>();
        let first = |texel: usize| cells.iter().position(|cell| cell[texel] == 255);
        (0..(size * size) as usize).map(|texel| first(texel).map_or(255, |k| (tones[k] * 255.0) as u8)).collect()
    };
    Map {
        grid: Grid { tones: tones.clone(), levels, hand_built },
        stroke_map: StrokeMap {
            levels: sizes.iter().map(|&size| ThresholdLevel { size, threshold: threshold(size) }).collect(),
            distribution: vec![vec![0.0, 0.25, 1.0]; 2 * sizes.len() - 1],
        },
        strokes: StrokeList {
            families: vec![Family { name: "h".into(), angle_deg: 0.0, stroke: StrokeOptions::default() }],
            first_column: sizes.iter().map(|&size| first_column(size)).collect(),
            closing: vec![vec![vec![Closing { stroke: 0, fraction: 0.0 }]; columns]; sizes.len()],
            strokes,
        },
        preset,
        deficits: Vec::new(),
    }
}

fn spread(i: u32, count: u32) -> u32 {
    i.reverse_bits() >> (32 - count.ilog2())
}

fn lines(size: u32, count: u32) -> Vec<u8> {
    let mut ink = vec![0; (size * size) as usize];
    for i in 0..count {
        let row = 2 * spread(i, size / 2) as usize;
        ink[row * size as usize..(row + 2) * size as usize].fill(255);
    }
    ink
}

fn halved(level: &Level) -> Level {
    let size = level.size / 2;
    let halve = |ink: &Vec<u8>| {
        (0..size * size)
            .map(|i| {
                let (x, y) = (2 * (i % size), 2 * (i / size));
                let at = |dx, dy| u32::from(ink[((y + dy) * level.size + x + dx) as usize]);
                ((at(0, 0) + at(1, 0) + at(0, 1) + at(1, 1) + 2) / 4) as u8
            })
            .collect()
    };
    Level { size, cells: level.cells.iter().map(halve).collect() }
}
