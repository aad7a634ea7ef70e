// Lines along a field over the whole surface. Knöppel and others, "Stripe patterns on surfaces", 2015, section 4: the
// phase inside a triangle. It counts lines and is whole in the middle of each.
//!include lib/halftone.wgsl

// Lines closer than this many to the pixel turn grey, from the first to the second.
const FADE_FROM: f32 = 0.35;
const FADE_TO: f32 = 0.5;

// Where lines end in a triangle, the phase winds around its middle, and the triangle is drawn in three, between the middle
// and its sides. `ends` are the weights of a side's two corners: the share of the way round from the first to the second,
// linear along the side.
fn round_share(ends: vec2f) -> f32 {
    return ends.y / (3.0 * max(ends.x + ends.y, 1e-6));
}

// Its change with the weights.
fn round_slope(ends: vec2f, change: vec2f) -> f32 {
    let sum = max(ends.x + ends.y, 1e-3);
    return (ends.x * change.y - ends.y * change.x) / (3.0 * sum * sum);
}

// The phase that is `phase` but for its winding, which goes round so many times.
fn wound_phase(phase: f32, ends: vec2f, turns: f32) -> f32 {
    if turns == 0.0 {
        return phase;
    }
    return phase + turns * round_share(ends);
}

// Its change, likewise.
fn wound_slope(slope: f32, ends: vec2f, change: vec2f, turns: f32) -> f32 {
    if turns == 0.0 {
        return slope;
    }
    return slope + turns * round_slope(ends, change);
}

// Lines at the phase, doubled until they stand between line_period_px and twice that on the screen, but never halved:
// where they are too close for pixels they turn grey.
fn doubled_ink(phase: f32, phase_per_px: f32, line_period_px: f32, d: f32) -> f32 {
    let wanted = 1.0 / max(phase_per_px * line_period_px, 1e-6);
    let octave = max(floor(log2(wanted)), 0.0);
    let f = clamp(wanted / exp2(octave) - 1.0, 0.0, 1.0);
    let lines = exp2(octave);
    let ink = line_ink(phase * lines, phase_per_px * lines, d, f);
    return mix(ink, d, smoothstep(FADE_FROM, FADE_TO, phase_per_px * lines));
}

// Darkness of the lines and of those that cross them, so that both together have d where they are independent: lines
// alone up to `cross_from`, from there on both.
fn crossed_darkness(d: f32, cross_from: f32) -> vec2f {
    if d <= cross_from {
        return vec2f(d, 0.0);
    }
    let rest = sqrt(max(1.0 - d, 0.0) / max(1.0 - cross_from, 1e-6));
    return vec2f(1.0 - (1.0 - cross_from) * rest, 1.0 - rest);
}
