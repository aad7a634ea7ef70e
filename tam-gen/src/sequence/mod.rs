//! Sequences: a family's strokes in the one order in which they are added, ever, well spaced at every length.
//!
//! Every cell of a map draws a prefix of them, which is what makes tones and levels nest.

mod density;
mod direction;
mod dots;
mod random;

pub(crate) use direction::Direction;
pub use random::Draw;

use crate::map::Family;
use crate::preset::{PlacementMethod, Preset, StrokeOptions};
use crate::stroke::{Stroke, Taper};
use density::DensityField;
use dots::DotField;

/// Step of the low-discrepancy sequence of lengths: far from every simple fraction, and from the golden ratio's multiples
/// that the eye knows from spirals.
const LENGTH_STEP: f64 = 0.569_840_290_998;

/// What the very tip of a stroke counts in the search.
const LEAST_PRESSURE: f32 = 0.2;

/// One family's strokes, generated on demand.
#[derive(Debug, Clone)]
pub struct Sequence {
    family: u16,
    direction: Direction,
    taper: Taper,
    options: StrokeOptions,
    effort: u32,
    draw: Draw,
    first_length: f64,
    field: Field,
    /// Texels across a stroke, as a multiple of what the preset says.
    texels: f32,
    strokes: Vec<Stroke>,
}

#[derive(Debug, Clone)]
enum Field {
    /// Strokes avoid each other across their family.
    Lines(DensityField),
    /// Dots avoid each other all around.
    Dots(DotField),
    /// Nobody avoids anybody.
    None,
}

impl Sequence {
    /// An empty sequence of a preset's family. `family` is its index in the map's list.
    pub fn new(preset: &Preset, family: u16, of: &Family) -> Self {
        let (name, angle_deg, options) = (&of.name, of.angle_deg, &of.stroke);
        let mut draw = Draw::new(preset.seed, name);
        draw.seek(u32::MAX);
        let first_length = draw.unit();
        let direction = Direction::new(angle_deg);
        let dots = options.length_max == 0.0;
        let field = match (preset.placement.method, dots) {
            (PlacementMethod::Random, _) => Field::None,
            (_, true) => Field::Dots(DotField::new(preset.map.size, &draw)),
            (_, false) => Field::Lines(DensityField::new(preset.map.size, options.width_px as f32, &draw)),
        };
        Self {
            family,
            direction,
            taper: of.taper(),
            options: options.clone(),
            effort: preset.placement.effort,
            first_length,
            draw,
            field,
            texels: 1.0,
            strokes: Vec::new(),
        }
    }

    /// The same strokes with so many times as many texels across, for a map of so many times as many.
    #[must_use]
    pub fn with_texels(self, texels: f32) -> Self {
        Self { texels, ..self }
    }

    /// The strokes generated so far.
    pub fn strokes(&self) -> &[Stroke] {
        &self.strokes
    }

    /// Generates strokes until there are `count`.
    pub fn extend_to(&mut self, count: usize) {
        while self.strokes.len() < count {
            let stroke = self.next_stroke();
            self.strokes.push(stroke);
        }
    }

    fn next_stroke(&mut self) -> Stroke {
        let index = self.strokes.len() as u32;
        self.draw.seek(index);
        // Length and width are settled before the search: a search that could choose them would prefer short strokes.
        let length = self.length(index);
        let width_scale = (1.0 + self.options.width_jitter * self.draw.signed()) as f32;
        let draw = &mut self.draw;
        let mut stroke = match &mut self.field {
            Field::Dots(field) => {
                let (u, v) = field.place(index, width_scale, self.options.width_px as f32, draw);
                Stroke { start_uv: u, along_uv: 0.0, across_uv: [v, 0.0, 0.0, 0.0], ..self.direction.blank() }
            }
            Field::None => {
                let mut shape = self.direction.shape(&self.options, length, draw);
                shape.across_uv[0] = draw.unit() as f32;
                shape
            }
            Field::Lines(field) => {
                let taper = self.taper;
                let pressure = |t| LEAST_PRESSURE.max(taper.pressure(t));
                let (mut best, mut best_row, mut lowest) = (self.direction.blank(), 0.0, f32::INFINITY);
                for _ in 0..self.effort {
                    let shape = self.direction.shape(&self.options, length, draw);
                    let (density, row) = field.emptiest_row(&shape, pressure);
                    if density < lowest {
                        (best, best_row, lowest) = (shape, row, density);
                    }
                }
                best.across_uv[0] = field.uv_of_row(best_row);
                field.add(&best, width_scale, pressure);
                best
            }
        };
        stroke.family = self.family;
        stroke.width_px = self.options.width_px as f32 * width_scale * self.texels;
        stroke
    }

    /// A stroke of the sequence, generated if need be.
    pub fn stroke(&mut self, index: u32) -> Option<Stroke> {
        self.extend_to(index as usize + 1);
        self.strokes.get(index as usize).copied()
    }

    /// A stroke of this family that chance put anywhere, as a candidate for a search. Takes seven numbers of `draw`.
    pub fn random_stroke(&self, draw: &mut Draw) -> Stroke {
        let length = self.options.length_min + (self.options.length_max - self.options.length_min) * draw.unit();
        let width_scale = (1.0 + self.options.width_jitter * draw.signed()) as f32;
        let mut stroke = self.direction.shape(&self.options, length as f32, draw);
        stroke.across_uv[0] = draw.unit() as f32;
        stroke.family = self.family;
        stroke.width_px = self.options.width_px as f32 * width_scale * self.texels;
        stroke
    }

    fn length(&self, index: u32) -> f32 {
        let spread = (self.first_length + LENGTH_STEP * f64::from(index)).fract();
        (self.options.length_min + (self.options.length_max - self.options.length_min) * spread) as f32
    }
}
