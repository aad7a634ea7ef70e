//! Praun's search taken literally, for the record of what it costs: every candidate is drawn by tiny-skia onto copies of
//! this level's image and of all finer ones, each copy is blurred into its image pyramid, and means are taken over all of
//! it.

use tam_gen::Stroke;
use tam_gen::preset::ToneMeasure;
use tiny_skia::{LineCap, Paint, PathBuilder, Pixmap, Transform};

/// The images of one column.
pub(crate) struct Column {
    /// Finest first.
    levels: Vec<Pixmap>,
}

impl Column {
    pub(crate) fn white(sizes: &[u32]) -> Self {
        let white = |size: &u32| {
            let mut pixmap = Pixmap::new(*size, *size).expect("a valid size");
            pixmap.fill(tiny_skia::Color::WHITE);
            pixmap
        };
        Self { levels: sizes.iter().map(white).collect() }
    }

    /// The candidate's score at a level: darkness it adds to this level, all finer ones and their pyramids, over its length.
    pub(crate) fn score(&self, level: usize, stroke: &Stroke) -> f64 {
        let coarsest = self.levels.len() - 1;
        let mut gained = 0.0;
        for (l, image) in self.levels.iter().enumerate().take(level + 1) {
            let mut drawn = image.clone();
            draw(&mut drawn, stroke);
            let (mut with, mut without) = (Grey::of(&drawn), Grey::of(image));
            gained += with.darkness() - without.darkness();
            for _ in 0..coarsest - l {
                (with, without) = (with.coarser(), without.coarser());
                gained += with.darkness() - without.darkness();
            }
        }
        gained / f64::from(stroke.length_uv())
    }

    /// Adds the stroke to a level and all finer ones.
    pub(crate) fn add(&mut self, level: usize, stroke: &Stroke) {
        for image in &mut self.levels[..=level] {
            draw(image, stroke);
        }
    }

    pub(crate) fn tone(&self, level: usize) -> f64 {
        let ink: Vec<u8> = self.levels[level].pixels().iter().map(|pixel| 255 - pixel.red()).collect();
        ToneMeasure::default().tone(&ink)
    }
}

/// The stroke and its eight copies around the tile.
fn draw(image: &mut Pixmap, stroke: &Stroke) {
    let side = image.width() as f32;
    let mut path = PathBuilder::new();
    for part in 0..=16_u8 {
        let t = f32::from(part) / 16.0;
        let (along, across) = (stroke.start_uv + t * stroke.along_uv, stroke.across_at(t));
        let (x, y) = if stroke.axis == tam_gen::Axis::X { (along, across) } else { (across, along) };
        if part == 0 { path.move_to(x * side, y * side) } else { path.line_to(x * side, y * side) }
    }
    let path = path.finish().expect("a path");
    let pen = tiny_skia::Stroke { width: stroke.width_px, line_cap: LineCap::Butt, ..Default::default() };
    for dy in [-1.0, 0.0, 1.0] {
        for dx in [-1.0, 0.0, 1.0] {
            let shift = Transform::from_translate(dx * side, dy * side);
            image.stroke_path(&path, &Paint::default(), &pen, shift, None);
        }
    }
}

/// One level of an image pyramid.
struct Grey {
    side: usize,
    darkness: Vec<f32>,
}

impl Grey {
    fn of(image: &Pixmap) -> Self {
        let darkness = image.pixels().iter().map(|pixel| 1.0 - f32::from(pixel.red()) / 255.0).collect();
        Self { side: image.width() as usize, darkness }
    }

    /// The next level: a 5 x 5 binomial blur, then every second texel.
    fn coarser(&self) -> Self {
        const TAPS: [f32; 5] = [1.0 / 16.0, 4.0 / 16.0, 6.0 / 16.0, 4.0 / 16.0, 1.0 / 16.0];
        let (side, mask) = (self.side, self.side - 1);
        let blur = |from: &[f32], step_x: usize, step_y: usize| -> Vec<f32> {
            (0..side * side)
                .map(|texel| {
                    let (x, y) = (texel % side, texel / side);
                    let tap = |k: usize| {
                        let (x, y) = (x + side + (k * step_x) - 2 * step_x, y + side + (k * step_y) - 2 * step_y);
                        from[(y & mask) * side + (x & mask)]
                    };
                    (0..5).map(|k| TAPS[k] * tap(k)).sum()
                })
                .collect()
        };
        let blurred = blur(&blur(&self.darkness, 1, 0), 0, 1);
        let half = side / 2;
        let darkness = (0..half * half).map(|texel| blurred[texel / half * 2 * side + texel % half * 2]).collect();
        Self { side: half, darkness }
    }

    fn darkness(&self) -> f64 {
        self.darkness.iter().map(|d| f64::from(*d)).sum::<f64>() / self.darkness.len() as f64
    }
}
