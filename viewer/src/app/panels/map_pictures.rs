//! Pictures of a map, texel for texel.

use egui::{Color32, ColorImage};
use tam_gen::{Grid, Level, Map};

use super::stroke_preview::blended;

/// Colours of paper and ink, sRGB.
pub(super) type Colours = ([u8; 3], [u8; 3]);

/// One cell.
pub(super) fn cell(level: &Level, column: usize, colours: Colours) -> ColorImage {
    let side = level.size as usize;
    let shades = shades(colours);
    ColorImage::new([side, side], level.cells[column].iter().map(|ink| shades[usize::from(*ink)]).collect())
}

/// Three by three tiles of a cell.
pub(super) fn tiling(level: &Level, column: usize, colours: Colours) -> ColorImage {
    let side = level.size as usize;
    let shades = shades(colours);
    let ink = &level.cells[column];
    let row = |y: usize| (0..3 * side).map(move |x| (x, y));
    let pixels = (0..3 * side).flat_map(row).map(|(x, y)| shades[usize::from(ink[y % side * side + x % side])]);
    ColorImage::new([3 * side; 2], pixels.collect())
}

/// One cell with each texel in the colour of what it first belongs to: the lightest column that inks it, so that what each
/// column adds is seen; and the ink that the next coarser level has there drawn darkest.
pub(super) fn nesting(grid: &Grid, level: usize, column: usize) -> ColorImage {
    let own = &grid.levels[level];
    let side = own.size as usize;
    let coarser = grid.levels.get(level + 1).filter(|_| level + 1 < grid.hand_built);
    let pixel = |texel: usize| {
        let first = (0..=column).find(|k| own.cells[*k][texel] >= 96);
        let Some(first) = first else {
            let ink = own.cells[column][texel];
            return Color32::from_gray(255 - ink / 3);
        };
        let in_coarser = coarser.is_some_and(|coarser| {
            let (x, y) = (texel % side / 2, texel / side / 2);
            coarser.cells[column][y * coarser.size as usize + x] >= 96
        });
        let colour = column_colour(first, grid.columns());
        if in_coarser { colour.gamma_multiply_u8(200) } else { lightened(colour) }
    };
    ColorImage::new([side, side], (0..side * side).map(pixel).map(opaque).collect())
}

/// The colour of a column among others.
pub(super) fn column_colour(column: usize, columns: usize) -> Color32 {
    let hue = 0.62 - 0.62 * column as f32 / columns.max(2).saturating_sub(1) as f32;
    Color32::from(egui::epaint::Hsva::new(hue, 0.78, 0.82, 1.0))
}

fn lightened(colour: Color32) -> Color32 {
    let [r, g, b, _] = colour.to_array();
    let lift = |c: u8| c + (255 - c) / 3;
    Color32::from_rgb(lift(r), lift(g), lift(b))
}

fn opaque(colour: Color32) -> Color32 {
    let [r, g, b, _] = colour.to_array();
    Color32::from_rgb(r, g, b)
}

/// The stroke map: what is inked first is darkest.
pub(super) fn stroke_map(map: &Map, level: usize) -> ColorImage {
    let own = &map.stroke_map.levels[level];
    let side = own.size as usize;
    ColorImage::new([side, side], own.threshold.iter().map(|threshold| Color32::from_gray(*threshold)).collect())
}

/// The texels of a cell that offend, in red over a pale picture of it.
pub(super) fn offending(level: &Level, column: usize, texels: &[u32]) -> ColorImage {
    let side = level.size as usize;
    let pale = level.cells[column].iter().map(|ink| Color32::from_gray(255 - ink / 3));
    let mut image = ColorImage::new([side, side], pale.collect());
    for texel in texels {
        image.pixels[*texel as usize] = Color32::from_rgb(225, 30, 30);
    }
    image
}

fn shades((paper, ink): Colours) -> Vec<Color32> {
    (0..=255).map(|share| blended(paper, ink, share)).collect()
}
