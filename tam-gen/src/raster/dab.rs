//! A dot: a disc with exact chords in four sub-columns per texel.

use super::{Footprint, Nib, Part};
use crate::rounding::{ceil, floor};
use crate::stroke::{Axis, Stroke};

const SUB_COLUMNS: i32 = 4;

/// Adds the texels of a dot to the footprint. Its area errs by less than 5 % at a diameter of one texel.
pub(super) fn disc(nib: &Nib, stroke: &Stroke, part: Part, size: u32, out: &mut Footprint) {
    let side = size as f32;
    let mask = size as i32 - 1;
    let (along_stride, across_stride) = match stroke.axis {
        Axis::X => (1, size),
        Axis::Y => (size, 1),
    };
    let (along, across) = (stroke.start_uv * side, stroke.across_uv[0] * side);
    let radius = 0.5 * stroke.width_px;
    let (first_row, last_row) = (floor(across - radius), ceil(across + radius) - 1);
    let (first_column, last_column) = (floor(along - radius), ceil(along + radius) - 1);

    for column in first_column..=last_column {
        // Half chord of the disc in the middle of each sub-column.
        let half_chord: [f32; SUB_COLUMNS as usize] = std::array::from_fn(|sub| {
            let off = column as f32 + (sub as f32 + 0.5) / SUB_COLUMNS as f32 - along;
            (radius * radius - off * off).max(0.0).sqrt()
        });
        for row in first_row..=last_row {
            let below = across - row as f32;
            let area: f32 =
                half_chord.iter().map(|half| (below + half).clamp(0.0, 1.0) - (below - half).clamp(0.0, 1.0)).sum();
            let ink = (area / SUB_COLUMNS as f32 * 255.0 * nib.opacity * part.strength + 0.5) as u8;
            if ink > 0 {
                out.push((column & mask) as u32 * along_stride + (row & mask) as u32 * across_stride, ink);
            }
        }
    }
}
