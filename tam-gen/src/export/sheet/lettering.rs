//! Text on a picture, in the styles that all sheets share.

use std::sync::LazyLock;

use ab_glyph::{Font, FontRef, GlyphId, PxScale, ScaleFont, point};
use image::{Rgb, RgbImage};

static UBUNTU: LazyLock<FontRef<'static>> = LazyLock::new(|| embedded(epaint_default_fonts::UBUNTU_LIGHT));
static HACK: LazyLock<FontRef<'static>> = LazyLock::new(|| embedded(epaint_default_fonts::HACK_REGULAR));

fn embedded(bytes: &'static [u8]) -> FontRef<'static> {
    FontRef::try_from_slice(bytes).expect("the fonts in the program are sound")
}

/// How a piece of text looks.
#[derive(Clone, Copy, Debug)]
pub struct Style {
    font: &'static LazyLock<FontRef<'static>>,
    height_px: f32,
    colour: [u8; 3],
}

const DARK: [u8; 3] = [34, 34, 36];
const MUTED: [u8; 3] = [104, 103, 100];

/// The name of the map.
pub const TITLE: Style = Style { font: &UBUNTU, height_px: 36.0, colour: DARK };
/// Its description.
pub const BODY: Style = Style { font: &UBUNTU, height_px: 19.0, colour: DARK };
/// Remarks at the foot.
pub const FOOT: Style = Style { font: &UBUNTU, height_px: 16.0, colour: MUTED };
/// Labels of columns and levels.
pub const LABEL: Style = Style { font: &HACK, height_px: 14.0, colour: DARK };
/// Figures.
pub const FIGURE: Style = Style { font: &HACK, height_px: 13.0, colour: MUTED };

impl Style {
    /// Distance of lines in pixels.
    pub fn line_px(self) -> u32 {
        (self.height_px * 1.2).ceil() as u32
    }

    /// Width of a text in pixels.
    pub fn width_px(self, text: &str) -> u32 {
        self.glyphs(text).last().map_or(0, |(_, end)| end.ceil() as u32)
    }

    /// The text in lines of at most `width_px`, broken between words; a longer word stands alone.
    pub fn wrapped(self, text: &str, width_px: u32) -> Vec<String> {
        let mut lines: Vec<String> = Vec::new();
        for word in text.split_whitespace() {
            match lines.last_mut() {
                Some(line) if self.width_px(&format!("{line} {word}")) <= width_px => {
                    line.push(' ');
                    line.push_str(word);
                }
                _ => lines.push(word.into()),
            }
        }
        lines
    }

    /// Draws a text whose line begins at the left and top given; what leaves the picture is cut off.
    pub fn draw(self, picture: &mut RgbImage, left: f32, top: f32, text: &str) {
        let scale = PxScale::from(self.height_px);
        let baseline = (top + self.font.as_scaled(scale).ascent()).round();
        let mut start = 0.0;
        for (glyph, end) in self.glyphs(text) {
            let placed = glyph.with_scale_and_position(scale, point(left + start, baseline));
            start = end;
            let Some(outline) = self.font.outline_glyph(placed) else { continue };
            let bounds = outline.px_bounds();
            outline.draw(|x, y, coverage| {
                let (x, y) = (bounds.min.x as i64 + i64::from(x), bounds.min.y as i64 + i64::from(y));
                let (Ok(x), Ok(y)) = (u32::try_from(x), u32::try_from(y)) else { return };
                if x < picture.width() && y < picture.height() {
                    blend(picture.get_pixel_mut(x, y), self.colour, coverage);
                }
            });
        }
    }

    /// Draws a text centred at `middle`.
    pub fn draw_centred(self, picture: &mut RgbImage, middle: f32, top: f32, text: &str) {
        self.draw(picture, (middle - self.width_px(text) as f32 / 2.0).round(), top, text);
    }

    /// The glyphs of a text, each with the position at which it ends.
    fn glyphs(self, text: &str) -> impl Iterator<Item = (GlyphId, f32)> {
        let font = self.font.as_scaled(PxScale::from(self.height_px));
        let mut end = 0.0;
        let mut before = None;
        text.chars().filter(|c| !c.is_control()).map(move |c| {
            let glyph = font.glyph_id(c);
            end += before.map_or(0.0, |before| font.kern(before, glyph)) + font.h_advance(glyph);
            before = Some(glyph);
            (glyph, end)
        })
    }
}

/// In the picture's own encoding, not in linear light, where dark text on a light ground would look thin.
fn blend(pixel: &mut Rgb<u8>, colour: [u8; 3], coverage: f32) {
    for (channel, ink) in pixel.0.iter_mut().zip(colour) {
        let below = f32::from(*channel);
        *channel = (below + (f32::from(ink) - below) * coverage.clamp(0.0, 1.0)).round() as u8;
    }
}
