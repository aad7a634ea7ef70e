// Thresholds of a stroke map. Freudenberg, "Real-Time Stroke Textures", SIGGRAPH 2001 sketch: the composited map plus
// the wanted intensity, scaled by a slope and clamped.
//!include lib/form.wgsl
//!include lib/material.wgsl

// Steepest slope: where the map is level, strokes that share a threshold still come over a range of tones.
const MAX_SLOPE: f32 = 24.0;
// Rows of the distribution table from one level of detail to the next.
const ROWS_PER_LEVEL: f32 = 8.0;

// Share and rate of a table entry.
fn distribution_entry(row: i32, i: i32) -> vec2f {
    return textureLoad(distribution, vec2i(i, row), 0).rg;
}

struct Equalised {
    share: f32,
    // Change of the share with theta. Without jumps, else edges would have them where a pattern moves.
    rate: f32,
}

// Share of the tile that is inked before a filtered threshold at this level is: filtering narrows the distribution of
// thresholds, and looking the result up in a table made for it keeps the tone.
fn equalised(theta: f32, level: f32) -> Equalised {
    if material.distribution_entries < 2.0 {
        return Equalised(theta, 1.0);
    }
    let x = clamp(theta, 0.0, 1.0) * (material.distribution_entries - 1.0);
    let i = min(i32(x), i32(material.distribution_entries) - 2);
    let row = ROWS_PER_LEVEL * level;
    let r = i32(row);
    let last = i32(textureDimensions(distribution).y) - 1;
    let here = mix(distribution_entry(min(r, last), i), distribution_entry(min(r, last), i + 1), fract_of(x, i));
    let next = mix(distribution_entry(min(r + 1, last), i), distribution_entry(min(r + 1, last), i + 1), fract_of(x, i));
    let found = mix(here, next, row - f32(r));
    return Equalised(found.x, found.y);
}

fn fract_of(x: f32, i: i32) -> f32 {
    return x - f32(i);
}

// Share of a pixel above 0, where `x` changes from middle to edge by `half`.
fn share_above(x: f32, half: f32) -> f32 {
    return clamp(0.5 + 0.5 * x / half, 0.0, 1.0);
}

// Share of a pixel whose thresholds are below d, so that soft edges keep the tone. `per_px` is how much the threshold
// changes across the pixel. No threshold leaves 0..1: there it turns back, so that no ink is left at 0 and no paper at
// 1, and the first stroke comes by degrees.
fn threshold_centred(d: f32, theta: f32, per_px: f32) -> f32 {
    let half = 0.5 * clamp(per_px, 1.0 / MAX_SLOPE, 1.0);
    let below = share_above(d - theta, half);
    let turned_at_0 = share_above(-d - theta, half);
    let turned_at_1 = share_above(theta + d - 2.0, half);
    return below - turned_at_0 + turned_at_1;
}

// As the sketch prints it: too light by half a ramp in mid-tones.
fn threshold_one_sided(d: f32, theta: f32, slope: f32) -> f32 {
    return clamp(slope * (d - theta), 0.0, 1.0);
}
