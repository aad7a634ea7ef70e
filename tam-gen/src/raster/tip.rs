//! Stroke tips: a shape, given as SVG path data or as a picture, stamped along the stroke.

use std::io::Cursor;

use base64::Engine as _;
use resvg::tiny_skia::{Pixmap, Transform};
use resvg::usvg;

use super::{Footprint, Nib, Part};
use crate::preset::TipOptions;
use crate::rounding::{ceil, floor};
use crate::stroke::{Axis, Stroke};

/// Texels across the finest version of a tip; widths up to half of it are sampled without loss.
const ACROSS: u32 = 64;
/// Longest tip, as a multiple of its height.
const LONGEST: f32 = 8.0;
/// Shortest stamp in pixels.
const LENGTH_MIN_PX: f32 = 2.0;
/// Largest picture that is read as a tip.
const PICTURE_SIDE_MAX: u32 = 4096;

/// Why a tip cannot be used.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum TipError {
    /// Neither or both of `path` and `image` are given.
    #[error("a tip needs either `path` (SVG path data) or `image` (a PNG or SVG file)")]
    NoShape,
    /// The path or SVG does not parse.
    #[error("the tip's SVG cannot be read: {0}")]
    Svg(String),
    /// The picture does not decode.
    #[error("the tip's picture cannot be read: {0}")]
    Picture(String),
    /// There is nothing to stamp.
    #[error("the tip is empty: nothing in it would leave ink")]
    Empty,
    /// The shape is far longer than it is high.
    #[error("the tip is {aspect:.1} times as long as it is high; at most {LONGEST} times is allowed")]
    TooLong {
        /// Length over height.
        aspect: f32,
    },
}

/// A tip ready to be stamped: coverage at several sizes, lying with its length along the stroke.
#[derive(Debug, Clone, PartialEq)]
pub struct TipMask {
    /// Finest first; each has half the side of the one before.
    mips: Vec<Mip>,
    /// Length over height.
    aspect: f32,
}

#[derive(Debug, Clone, PartialEq)]
struct Mip {
    width: u32,
    height: u32,
    coverage: Vec<f32>,
}

impl TipMask {
    /// Reads the shape of a tip.
    ///
    /// # Errors
    /// When the shape is missing, does not parse, is empty or too long, or when `image` is a file name that nobody has
    /// replaced by its contents (see [`crate::Preset::load`]).
    pub fn new(options: &TipOptions) -> Result<Self, TipError> {
        let finest = match (&options.path, &options.image) {
            (Some(path), None) => Mip::from_path(path)?,
            (None, Some(image)) => Mip::from_picture(&decode_data_address(image)?)?,
            _ => return Err(TipError::NoShape),
        };
        if finest.coverage.iter().all(|&coverage| coverage < 0.01) {
            return Err(TipError::Empty);
        }
        let aspect = finest.width as f32 / finest.height as f32;
        let mut mips = vec![finest];
        while let Some(finer) = mips.last()
            && finer.height > 1
            && finer.width > 1
        {
            let coarser = finer.halved();
            mips.push(coarser);
        }
        Ok(Self { mips, aspect })
    }

    /// Coverage at a point of the tip, both coordinates `-1 ..= 1`, for a stamp of the given height in pixels.
    #[inline]
    fn coverage(&self, along: f32, across: f32, height_px: f32) -> f32 {
        let (u, v) = (0.5 + 0.5 * along, 0.5 + 0.5 * across);
        let rows = 1.5 * height_px;
        let mut level = 0;
        while level + 1 < self.mips.len() && self.mips[level].height as f32 > rows {
            level += 1;
        }
        let here = self.mips[level].sample(u, v);
        // From one version to the next without a step, where a tapering stroke narrows.
        let finer = 2.0 * (1.0 - self.mips[level].height as f32 / rows).clamp(0.0, 0.5);
        if level == 0 || finer == 0.0 { here } else { here + (self.mips[level - 1].sample(u, v) - here) * finer }
    }

    /// Length of a stamp of the given height in pixels. A shorter one would fall between the pixels' middles.
    fn length_px(&self, height_px: f32) -> f32 {
        (height_px * self.aspect).max(LENGTH_MIN_PX)
    }
}

impl Mip {
    fn from_path(path: &str) -> Result<Self, TipError> {
        // The path goes through XML, so what could end the attribute is refused instead of escaped.
        if let Some(odd) = path.chars().find(|c| matches!(c, '"' | '<' | '&')) {
            return Err(TipError::Svg(format!("`{odd}` does not belong in path data")));
        }
        let document =
            format!(r#"<svg xmlns="http://www.w3.org/2000/svg" width="1" height="1"><path d="{path}"/></svg>"#);
        Self::from_svg(document.as_bytes())
    }

    fn from_svg(document: &[u8]) -> Result<Self, TipError> {
        let tree = usvg::Tree::from_data(document, &crate::preset::tip_source::svg_options())
            .map_err(|error| TipError::Svg(error.to_string()))?;
        let bounds = tree.root().abs_layer_bounding_box();
        let aspect = bounds.width() / bounds.height();
        if !tree.root().has_children() || !aspect.is_finite() || bounds.height() <= 0.0 {
            return Err(TipError::Empty);
        }
        if aspect > LONGEST {
            return Err(TipError::TooLong { aspect });
        }
        let width = ((ACROSS as f32 * aspect).ceil() as u32).max(1);
        let mut pixmap = Pixmap::new(width, ACROSS).ok_or(TipError::Empty)?;
        let scale = ACROSS as f32 / bounds.height();
        let place = Transform::from_scale(scale, scale).pre_translate(-bounds.x(), -bounds.y());
        resvg::render(&tree, place, &mut pixmap.as_mut());
        let coverage = pixmap.pixels().iter().map(|pixel| {
            // Premultiplied: what is neither transparent nor white inks.
            let luminance =
                0.2126 * f32::from(pixel.red()) + 0.7152 * f32::from(pixel.green()) + 0.0722 * f32::from(pixel.blue());
            (f32::from(pixel.alpha()) - luminance) / 255.0
        });
        Ok(Self { width, height: ACROSS, coverage: coverage.collect() })
    }

    fn from_picture(bytes: &[u8]) -> Result<Self, TipError> {
        if bytes.starts_with(b"<") {
            return Self::from_svg(bytes);
        }
        let mut reader = image::ImageReader::with_format(Cursor::new(bytes), image::ImageFormat::Png);
        let mut limits = image::Limits::default();
        limits.max_image_width = Some(PICTURE_SIDE_MAX);
        limits.max_image_height = Some(PICTURE_SIDE_MAX);
        reader.limits(limits);
        let picture = reader.decode().map_err(|error| TipError::Picture(error.to_string()))?;
        let aspect = picture.width() as f32 / picture.height() as f32;
        if aspect > LONGEST {
            return Err(TipError::TooLong { aspect });
        }
        let width = ((ACROSS as f32 * aspect).ceil() as u32).max(1);
        let picture = picture.resize_exact(width, ACROSS, image::imageops::FilterType::Triangle).to_luma_alpha8();
        let coverage = picture.pixels().map(|pixel| {
            let [luminance, alpha] = pixel.0;
            f32::from(255 - luminance) * f32::from(alpha) / (255.0 * 255.0)
        });
        Ok(Self { width, height: ACROSS, coverage: coverage.collect() })
    }

    fn halved(&self) -> Self {
        let (width, height) = (self.width.div_ceil(2), self.height.div_ceil(2));
        let at = |x: u32, y: u32| self.coverage[(y.min(self.height - 1) * self.width + x.min(self.width - 1)) as usize];
        let coverage = (0..width * height)
            .map(|texel| {
                let (x, y) = (2 * (texel % width), 2 * (texel / width));
                0.25 * (at(x, y) + at(x + 1, y) + at(x, y + 1) + at(x + 1, y + 1))
            })
            .collect();
        Self { width, height, coverage }
    }

    /// Bilinear sample at `0 ..= 1`; nothing outside.
    #[inline]
    fn sample(&self, u: f32, v: f32) -> f32 {
        let (x, y) = (u * self.width as f32 - 0.5, v * self.height as f32 - 0.5);
        let (left, top) = (x.floor(), y.floor());
        let (fx, fy) = (x - left, y - top);
        let at = |dx: i32, dy: i32| {
            let (x, y) = (left as i32 + dx, top as i32 + dy);
            let inside = x >= 0 && y >= 0 && (x as u32) < self.width && (y as u32) < self.height;
            if inside { self.coverage[(y as u32 * self.width + x as u32) as usize] } else { 0.0 }
        };
        (1.0 - fy) * ((1.0 - fx) * at(0, 0) + fx * at(1, 0)) + fy * ((1.0 - fx) * at(0, 1) + fx * at(1, 1))
    }
}

fn decode_data_address(address: &str) -> Result<Vec<u8>, TipError> {
    let encoded = address
        .strip_prefix("data:")
        .and_then(|rest| rest.split_once(";base64,"))
        .ok_or_else(|| TipError::Picture(format!("`{}` has not been loaded", shorten(address))))?
        .1;
    base64::engine::general_purpose::STANDARD.decode(encoded).map_err(|error| TipError::Picture(error.to_string()))
}

fn shorten(text: &str) -> String {
    text.chars().take(40).collect()
}

/// Stamps a tip along a stroke; stamps of one stroke unite by their maximum, so that their number does not matter.
pub(super) fn stamp(nib: &Nib, tip: &TipMask, stroke: &Stroke, part: Part, size: u32, out: &mut Footprint) {
    let side = size as f32;
    let mask = size as i32 - 1;
    let (along_stride, across_stride) = match stroke.axis {
        Axis::X => (1, size),
        Axis::Y => (size, 1),
    };
    let (begin, length) = (stroke.start_uv * side, stroke.along_uv * side);
    let tip_length = tip.length_px(stroke.width_px);
    let reach = 0.5 * (stroke.width_px * stroke.width_px + tip_length * tip_length).sqrt() + 1.0;

    // A band that follows the stroke: for each scan column, rows around the middle of the stroke there.
    let first_column = floor(begin - reach);
    let columns = (ceil(begin + length + reach) - first_column).max(1);
    let steepest = [0.0, 0.25, 0.5, 0.75, 1.0].map(|t| stroke.slope_at(t).abs()).into_iter().fold(0.0, f32::max);
    let half_rows = ceil(reach * (1.0 + steepest)) + 1;
    let rows = 2 * half_rows + 1;
    let middle_row = |column: i32| {
        let t = if length > 0.0 { ((column as f32 + 0.5 - begin) / length).clamp(0.0, 1.0) } else { 0.0 };
        floor(stroke.across_at(t) * side)
    };
    let mut band = vec![0.0_f32; (columns * rows) as usize];

    let stamps = (length / (nib.tip_spacing * tip_length).max(0.25)).ceil() as i32 + 1;
    for stamp in 0..stamps {
        let t = if stamps > 1 { stamp as f32 / (stamps - 1) as f32 } else { 0.5 };
        let (narrowed, lightened) = if length > 0.0 { nib.pressed(part, t) } else { (1.0, part.strength) };
        let height = stroke.width_px * narrowed;
        if height < 0.05 {
            continue;
        }
        let slope = stroke.slope_at(t);
        let shorten = 1.0 / (1.0 + slope * slope).sqrt();
        let (ahead, aside) = (shorten, slope * shorten);
        let (along, across) = (begin + t * length, stroke.across_at(t) * side);
        // A stamp thinner than a pixel would fall between the pixels' middles: it is drawn a pixel wide and lighter.
        let (height, lightened) = (height.max(1.0), lightened * height.min(1.0));
        let tip_length = tip.length_px(height);
        let (per_along, per_across) = (2.0 / tip_length, 2.0 / height);
        let reach = 0.5 * (height * height + tip_length * tip_length).sqrt() + 1.0;
        for column in floor(along - reach)..=ceil(along + reach) {
            let base = middle_row(column) - half_rows;
            let slot = (column - first_column) * rows;
            if column < first_column || column >= first_column + columns {
                continue;
            }
            for row in (floor(across - reach)).max(base)..=(ceil(across + reach)).min(base + rows - 1) {
                let (dx, dy) = (column as f32 + 0.5 - along, row as f32 + 0.5 - across);
                let (x, y) = ((dx * ahead + dy * aside) * per_along, (dy * ahead - dx * aside) * per_across);
                let coverage = tip.coverage(x, y, height) * lightened;
                let cell = &mut band[(slot + row - base) as usize];
                *cell = cell.max(coverage);
            }
        }
    }

    for column in first_column..first_column + columns {
        let base = middle_row(column) - half_rows;
        let slot = ((column - first_column) * rows) as usize;
        for (row, coverage) in band[slot..slot + rows as usize].iter().enumerate() {
            let ink = (coverage * 255.0 * nib.opacity + 0.5) as u8;
            if ink > 0 {
                let row = ((base + row as i32) & mask) as u32;
                out.push((column & mask) as u32 * along_stride + row * across_stride, ink);
            }
        }
    }
}
