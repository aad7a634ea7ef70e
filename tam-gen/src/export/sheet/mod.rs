//! Pictures of a map for people: the contact sheet and the tiling.

mod gallery;
mod layout;
pub mod lettering;

use image::{Rgb, RgbImage};

use crate::map::{Grid, Level};
use crate::preset::{Preset, ToneMeasure};
use crate::srgb;
pub use gallery::gallery;
use layout::Layout;

/// How a contact sheet looks.
#[derive(Debug, Clone, PartialEq)]
pub struct SheetOptions {
    /// Large, at the top; usually the name of the map.
    pub title: String,
    /// Below the title; as many lines as it needs.
    pub description: String,
    /// Colour of the paper, sRGB.
    pub paper: [u8; 3],
    /// Colour of the ink, sRGB.
    pub ink: [u8; 3],
    /// Widest picture; finer levels are shown reduced to keep within it.
    pub max_width_px: u32,
    /// The measure of tone.
    pub measure: ToneMeasure,
}

impl Default for SheetOptions {
    fn default() -> Self {
        Self {
            title: String::new(),
            description: String::new(),
            paper: [255; 3],
            ink: [0; 3],
            max_width_px: 4000,
            measure: ToneMeasure::default(),
        }
    }
}

impl SheetOptions {
    /// The sheet of a preset's map: its description, colours and measure.
    ///
    /// # Errors
    /// Which of its colours is none.
    pub fn of(title: &str, preset: &Preset) -> Result<Self, String> {
        let (paper, ink) = preset.colours.srgb()?;
        let measure = ToneMeasure::named(preset.map.tone_measure);
        Ok(Self {
            title: title.into(),
            description: preset.description.clone(),
            paper,
            ink,
            measure,
            ..Self::default()
        })
    }
}

/// The ground that sheets stand on.
pub const GROUND: Rgb<u8> = Rgb([231, 230, 227]);
const FRAME: Rgb<u8> = Rgb([190, 188, 183]);

/// All cells of a grid on one picture: columns across, lightest left; levels down, finest first.
///
/// A texel is a pixel. Where that would be wider than [`SheetOptions::max_width_px`], levels are shown reduced, by a
/// power of two and a box filter in linear light, and labelled so. Labels that would touch their neighbours are
/// shortened, then thinned out.
pub fn contact_sheet(grid: &Grid, options: &SheetOptions) -> RgbImage {
    let layout = Layout::new(grid, options);
    let mut picture = RgbImage::from_pixel(layout.width, layout.height, GROUND);
    let colours = colour_of_ink(options.paper, options.ink);
    for (level, row) in grid.levels.iter().zip(&layout.rows) {
        for (ink, &middle) in level.cells.iter().zip(&layout.middles) {
            let (left, shown) = (middle - row.shown / 2, reduced(ink, level.size, row.shown));
            frame(&mut picture, left, row.top, row.shown, row.shown);
            for (i, &ink) in shown.iter().enumerate() {
                let (x, y) = (i as u32 % row.shown, i as u32 / row.shown);
                picture.put_pixel(left + x, row.top + y, colours[usize::from(ink)]);
            }
        }
    }
    for text in &layout.texts {
        if text.centred {
            text.style.draw_centred(&mut picture, text.x as f32, text.top as f32, &text.text);
        } else {
            text.style.draw(&mut picture, text.x as f32, text.top as f32, &text.text);
        }
    }
    picture
}

/// One cell repeated `repeat` times both ways, black on white, for judging seams and repetition by eye.
///
/// # Panics
///
/// Where the level has no such column.
pub fn tiling(level: &Level, column: usize, repeat: u32) -> RgbImage {
    let (ink, size) = (&level.cells[column], level.size);
    let colours = colour_of_ink([255; 3], [0; 3]);
    RgbImage::from_fn(size * repeat, size * repeat, |x, y| {
        colours[usize::from(ink[(y % size * size + x % size) as usize])]
    })
}

/// The colour of each ink: paper and ink mixed in linear light, as light from a surface covered in part does.
fn colour_of_ink(paper: [u8; 3], ink: [u8; 3]) -> [Rgb<u8>; 256] {
    std::array::from_fn(|coverage| {
        let coverage = coverage as f32 / 255.0;
        Rgb(std::array::from_fn(|channel| {
            let (paper, ink) = (srgb::linear(paper[channel]), srgb::linear(ink[channel]));
            srgb::byte(paper + (ink - paper) * coverage)
        }))
    })
}

/// A cell of `size` reduced to `shown` texels, both powers of two: the mean of each block.
fn reduced(ink: &[u8], size: u32, shown: u32) -> Vec<u8> {
    let factor = size / shown;
    if factor == 1 {
        return ink.to_vec();
    }
    let mut sums = vec![0_u64; shown as usize * shown as usize];
    for (y, row) in ink.chunks_exact(size as usize).enumerate() {
        let sums = &mut sums[y / factor as usize * shown as usize..][..shown as usize];
        for (sum, block) in sums.iter_mut().zip(row.chunks_exact(factor as usize)) {
            *sum += block.iter().map(|&ink| u64::from(ink)).sum::<u64>();
        }
    }
    let area = u64::from(factor) * u64::from(factor);
    sums.into_iter().map(|sum| ((sum + area / 2) / area) as u8).collect()
}

/// Draws a line of one pixel around a rectangle, outside it, for which the picture must have room.
///
/// # Panics
/// If the line leaves the picture.
pub fn frame(picture: &mut RgbImage, left: u32, top: u32, width: u32, height: u32) {
    let (right, bottom) = (left + width, top + height);
    for x in left - 1..=right {
        picture.put_pixel(x, top - 1, FRAME);
        picture.put_pixel(x, bottom, FRAME);
    }
    for y in top - 1..=bottom {
        picture.put_pixel(left - 1, y, FRAME);
        picture.put_pixel(right, y, FRAME);
    }
}
