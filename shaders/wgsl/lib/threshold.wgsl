// Thresholds of a stroke map. Freudenberg, "Real-Time Stroke Textures", SIGGRAPH 2001 sketch: the composited map plus
// the wanted intensity, scaled by a slope and clamped.
//!include lib/form.wgsl
//!include lib/material.wgsl

// Steepest slope: where the map is level, strokes that share a threshold still come over a range of tones.
const MAX_SLOPE: f32 = 24.0;
// Rows of the distribution table from one level of detail to the next.
const ROWS_PER_LEVEL: f32 = 8.0;

fn distribution_entry(row: i32, i: i32) -> f32 {
    return textureLoad(distribution, vec2i(i, row), 0).r;
}

struct Equalised {
    share: f32,
    // Change of the share with theta.
    rate: f32,
}

// Share of the tile that is inked before a filtered threshold at this level is: filtering narrows the distribution of
// thresholds, and looking the result up in a table made for it keeps the tone.
fn equalised(theta: f32, level: f32) -> Equalised {
    if material.distribution_entries < 2.0 {
        return Equalised(theta, 1.0);
    }
    let steps = material.distribution_entries - 1.0;
    let x = clamp(theta, 0.0, 1.0) * steps;
    let i = min(i32(x), i32(material.distribution_entries) - 2);
    let row = ROWS_PER_LEVEL * level;
    let r = i32(row);
    let last = i32(textureDimensions(distribution).y) - 1;
    let here = vec2f(distribution_entry(min(r, last), i), distribution_entry(min(r, last), i + 1));
    let next = vec2f(distribution_entry(min(r + 1, last), i), distribution_entry(min(r + 1, last), i + 1));
    let ends = mix(here, next, row - f32(r));
    return Equalised(mix(ends.x, ends.y, fract_of(x, i)), (ends.y - ends.x) * steps);
}

fn fract_of(x: f32, i: i32) -> f32 {
    return x - f32(i);
}

// Centred: half ink where darkness and threshold meet, so that soft edges keep the tone. `per_px` is how much the
// threshold changes across a pixel: edges stay a pixel wide.
fn threshold_centred(d: f32, theta: f32, per_px: f32) -> f32 {
    let slope = min(1.0 / max(per_px, 1e-4), MAX_SLOPE);
    // Towards both ends of the range the ramp is squeezed: no ink is left at 0 and no paper at 1.
    let ramp = min(0.5 / slope, min(d, 1.0 - d));
    if ramp < 1e-4 {
        return step(0.5, d);
    }
    return clamp(0.5 + 0.5 * (d - theta) / ramp, 0.0, 1.0);
}

// As the sketch prints it: too light by half a ramp in mid-tones.
fn threshold_one_sided(d: f32, theta: f32, slope: f32) -> f32 {
    return clamp(slope * (d - theta), 0.0, 1.0);
}
