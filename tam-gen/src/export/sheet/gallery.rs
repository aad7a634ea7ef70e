//! Many maps on one picture: a strip of each from light to dark.

use image::RgbImage;

use super::lettering::{FOOT, TITLE};
use super::{GROUND, SheetOptions, colour_of_ink, frame};
use crate::map::Grid;

const MARGIN: u32 = 40;
const GAP: u32 = 36;
const STRIP_HEIGHT: u32 = 150;
const STRIP_WIDTH: u32 = 432;
const ACROSS: u32 = 3;
/// Lines kept for a description.
const LINES: u32 = 2;

/// A strip of each map's finest level, texel by pixel, lightest tone left and darkest right, three side by side.
///
/// Tones follow each other on one continuous stretch of the tiled map, so strokes run through from one to the next. A
/// map's title and description stand above its strip.
pub fn gallery(maps: &[(Grid, SheetOptions)]) -> RgbImage {
    let head = TITLE.line_px() + LINES * FOOT.line_px() + 14;
    let rows = (maps.len() as u32).div_ceil(ACROSS);
    let width = 2 * MARGIN + ACROSS * STRIP_WIDTH + (ACROSS - 1) * GAP;
    let height = 2 * MARGIN + rows * (head + STRIP_HEIGHT) + rows.saturating_sub(1) * GAP;
    let mut picture = RgbImage::from_pixel(width, height, GROUND);
    for (i, (grid, options)) in (0..).zip(maps) {
        let left = MARGIN + i % ACROSS * (STRIP_WIDTH + GAP);
        let top = MARGIN + i / ACROSS * (head + STRIP_HEIGHT + GAP);
        TITLE.draw(&mut picture, left as f32, top as f32, &options.title);
        let lines = FOOT.wrapped(&options.description, STRIP_WIDTH);
        for (line, text) in (0..LINES).zip(&lines) {
            let cut = if line + 1 == LINES && lines.len() > LINES as usize { " …" } else { "" };
            let below = TITLE.line_px() + 4 + line * FOOT.line_px();
            FOOT.draw(&mut picture, left as f32, (top + below) as f32, &format!("{text}{cut}"));
        }
        strip(&mut picture, left, top + head, grid, options);
    }
    picture
}

fn strip(picture: &mut RgbImage, left: u32, top: u32, grid: &Grid, options: &SheetOptions) {
    let Some(level) = grid.levels.first() else { return };
    let colours = colour_of_ink(options.paper, options.ink);
    frame(picture, left, top, STRIP_WIDTH, STRIP_HEIGHT);
    let columns = level.cells.len() as u32;
    for y in 0..STRIP_HEIGHT {
        for x in 0..STRIP_WIDTH {
            let cell = &level.cells[(x * columns / STRIP_WIDTH) as usize];
            let ink = cell[(y % level.size * level.size + x % level.size) as usize];
            picture.put_pixel(left + x, top + y, colours[usize::from(ink)]);
        }
    }
}
