//! Levels below the coarsest drawn one, for engines that want a full chain.

use crate::map::{Grid, Level};

/// Appends box-filtered levels down to one texel. Averaging keeps the tone within half a step of 255.
pub(crate) fn append(grid: &mut Grid) {
    while let Some(finer) = grid.levels.last()
        && finer.size > 1
    {
        let size = finer.size / 2;
        let cells = finer.cells.iter().map(|cell| halve(cell, size as usize)).collect();
        grid.levels.push(Level { size, cells });
    }
}

/// Half the image: each texel the rounded mean of four. `size` is the side of the result.
pub(crate) fn halve(ink: &[u8], size: usize) -> Vec<u8> {
    (0..size * size)
        .map(|texel| {
            let corner = 2 * (texel / size) * 2 * size + 2 * (texel % size);
            let sum: u32 = [0, 1, 2 * size, 2 * size + 1].iter().map(|i| u32::from(ink[corner + i])).sum();
            ((sum + 2) / 4) as u8
        })
        .collect()
}
