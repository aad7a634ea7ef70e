//! Pictures of cells for the report, as PNG in `data:` addresses.

use base64::Engine;
use image::{ExtendedColorType, ImageEncoder, codecs::png::PngEncoder};

use crate::srgb;

/// Colour of an offending texel on paper and on ink, sRGB: far from greys, and apart from each other in luminance.
const MARK: ([u8; 3], [u8; 3]) = ([255, 92, 40], [168, 0, 52]);

/// A square window of a toroidal image.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Window {
    pub(super) left: u32,
    pub(super) top: u32,
    pub(super) side: u32,
}

impl Window {
    /// The window of at most `side` texels that shows most of the given texels; windows may wrap.
    pub(super) fn around(texels: &[u32], size: u32, side: u32) -> Self {
        if side >= size {
            return Self { left: 0, top: 0, side: size };
        }
        // Quarters of the window are finer than the eye needs, and every wrap edge falls in the middle of one of them.
        let step = (side / 4).max(1);
        let cells = size.div_ceil(step) as usize;
        let mut marks = vec![0_u32; cells * cells];
        for &texel in texels {
            marks[(texel / size / step) as usize * cells + (texel % size / step) as usize] += 1;
        }
        let inside = |x: usize, y: usize| -> u32 {
            (0..16).map(|i| marks[(y + i / 4) % cells * cells + (x + i % 4) % cells]).sum()
        };
        let mut best = (inside(0, 0), 0, 0);
        for y in 0..cells {
            for x in 0..cells {
                // From the wrap edge on, so that an edge is shown in the middle rather than at the rim.
                let (x, y) = ((x + cells - 2) % cells, (y + cells - 2) % cells);
                if inside(x, y) > best.0 {
                    best = (inside(x, y), x, y);
                }
            }
        }
        Self { left: best.1 as u32 * step, top: best.2 as u32 * step, side }
    }

    /// The same part of the tile in an image of another size.
    pub(super) fn scaled(self, size: u32, other: u32) -> Self {
        let scale = |texels: u32| (u64::from(texels) * u64::from(other) / u64::from(size)) as u32;
        Self { left: scale(self.left), top: scale(self.top), side: scale(self.side).max(1) }
    }

    /// In words, for a caption; empty for a whole image.
    pub(super) fn describe(self, size: u32) -> String {
        if self.side >= size {
            return String::new();
        }
        format!("{0} x {0} texels from ({1}, {2})", self.side, self.left, self.top)
    }
}

/// A window of an image of ink as a PNG, offending texels coloured; paper white, ink black, coverage in linear light.
pub(super) fn png(ink: &[u8], size: u32, window: Window, texels: &[u32]) -> String {
    let side = window.side as usize;
    let mut rgb = Vec::with_capacity(side * side * 3);
    let mut offends = vec![false; ink.len()];
    texels.iter().for_each(|&texel| offends[texel as usize] = true);
    for y in 0..window.side {
        for x in 0..window.side {
            let texel = ((window.top + y) % size * size + (window.left + x) % size) as usize;
            let grey = srgb::byte(1.0 - f32::from(ink[texel]) / 255.0);
            rgb.extend(match (offends[texel], ink[texel]) {
                (false, _) => [grey; 3],
                (true, ..128) => MARK.0,
                (true, _) => MARK.1,
            });
        }
    }
    let mut bytes = Vec::new();
    let encoder = PngEncoder::new(&mut bytes);
    // Writing to memory an image whose buffer has its size cannot fail.
    let written = encoder.write_image(&rgb, window.side, window.side, ExtendedColorType::Rgb8);
    debug_assert!(written.is_ok());
    format!("data:image/png;base64,{}", base64::engine::general_purpose::STANDARD.encode(bytes))
}
