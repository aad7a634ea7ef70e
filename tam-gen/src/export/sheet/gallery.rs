//! Many maps on one picture: a strip of each from light to dark.

use image::RgbImage;

use super::lettering::{BODY, TITLE};
use super::{GROUND, SheetOptions, colour_of_ink, frame};
use crate::map::Grid;

const MARGIN: u32 = 40;
const GAP: u32 = 36;
const STRIP_HEIGHT: u32 = 128;
const STRIP_WIDTH: u32 = 576;
const ACROSS: u32 = 2;

/// A strip of each map's finest level, texel by pixel, lightest tone left and darkest right, two maps side by side.
///
/// Tones follow each other on one continuous stretch of the tiled map, so strokes run through from one to the next. A
/// map's title stands above its strip, its description beside the title as far as there is room.
pub fn gallery(maps: &[(Grid, SheetOptions)]) -> RgbImage {
    let head = TITLE.line_px() + 12;
    let rows = (maps.len() as u32).div_ceil(ACROSS);
    let width = 2 * MARGIN + ACROSS * STRIP_WIDTH + (ACROSS - 1) * GAP;
    let height = 2 * MARGIN + rows * (head + STRIP_HEIGHT) + rows.saturating_sub(1) * GAP;
    let mut picture = RgbImage::from_pixel(width, height, GROUND);
    for (i, (grid, options)) in (0..).zip(maps) {
        let left = MARGIN + i % ACROSS * (STRIP_WIDTH + GAP);
        let top = MARGIN + i / ACROSS * (head + STRIP_HEIGHT + GAP);
        TITLE.draw(&mut picture, left as f32, top as f32, &options.title);
        let beside = left + TITLE.width_px(&options.title) + 18;
        let room = (left + STRIP_WIDTH).saturating_sub(beside);
        if let Some(line) = BODY.wrapped(&options.description, room).first()
            && BODY.width_px(line) <= room
        {
            let cut = if line.len() < options.description.trim().len() { " …" } else { "" };
            let line = format!("{}{cut}", line.trim_end_matches([',', ':', ';']));
            let drop = (TITLE.line_px() - BODY.line_px()) as f32 - 4.0;
            BODY.draw(&mut picture, beside as f32, top as f32 + drop, &line);
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
