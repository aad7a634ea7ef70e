// Lines along a field over the whole surface. Knöppel and others, "Stripe patterns on surfaces", 2015, section 4: the
// phase inside a triangle. It counts lines and is whole in the middle of each.
//!include lib/halftone.wgsl

struct StripePhases {
    corners: vec3f,
    // Low bit: 0 where the phase winds around the middle, 1 where it folds. Above: how often, or around what.
    code: i32,
}

@group(3) @binding(4) var<storage, read> stripes_along: array<StripePhases>;
@group(3) @binding(5) var<storage, read> stripes_across: array<StripePhases>;

// Lines closer than this many to the pixel turn grey, from the first to the second.
const FADE_FROM: f32 = 0.35;
const FADE_TO: f32 = 0.5;

// A triangle falls into three between its middle and its sides; this is the side of the fragment's, from corner k to
// the next.
fn nearest_side(w: vec3f) -> u32 {
    if w.z <= w.x && w.z <= w.y {
        return 0u;
    }
    return select(2u, 1u, w.x <= w.y);
}

// Corners between which the phase is linear where the fragment is. Beyond the fold they count the other way.
fn unfolded_corners(s: StripePhases, w: vec3f) -> vec3f {
    if (s.code & 1) == 0 {
        return s.corners;
    }
    let sum = f32(s.code >> 1u);
    // Three times the phase of the middle.
    let middle = 1.5 * sum;
    let side = nearest_side(w);
    if side == 0u {
        return vec3f(s.corners.xy, middle - s.corners.x - s.corners.y);
    }
    if side == 1u {
        return vec3f(middle - s.corners.y - s.corners.z, s.corners.yz);
    }
    let first = sum - s.corners.x;
    return vec3f(first, middle - first - s.corners.z, s.corners.z);
}

// How often the phase winds around the middle.
fn windings(s: StripePhases) -> f32 {
    return select(0.0, f32(s.code >> 1u), (s.code & 1) == 0);
}

// Weights of the side's two corners, without what the middle has of them.
fn side_weights(w: vec3f) -> vec2f {
    let side = nearest_side(w);
    if side == 0u {
        return vec2f(w.x - w.z, w.y - w.z);
    }
    if side == 1u {
        return vec2f(w.y - w.x, w.z - w.x);
    }
    return vec2f(w.z - w.y, w.x - w.y);
}

// The share of the way round from corner 0, linear along the sides.
fn round_share(w: vec3f) -> f32 {
    let ends = side_weights(w);
    return (f32(nearest_side(w)) + ends.y / max(ends.x + ends.y, 1e-6)) / 3.0;
}

// Its change with the weights.
fn round_slope(w: vec3f, dw: vec3f) -> f32 {
    let side = nearest_side(w);
    let ends = side_weights(w);
    var d = vec2f(dw.x - dw.z, dw.y - dw.z);
    if side == 1u {
        d = vec2f(dw.y - dw.x, dw.z - dw.x);
    }
    if side == 2u {
        d = vec2f(dw.z - dw.y, dw.x - dw.y);
    }
    let sum = max(ends.x + ends.y, 1e-3);
    return (ends.x * d.y - ends.y * d.x) / (3.0 * sum * sum);
}

fn stripe_phase(s: StripePhases, w: vec3f) -> f32 {
    let turns = windings(s);
    let linear = dot(unfolded_corners(s, w), w);
    if turns == 0.0 {
        return linear;
    }
    return linear + turns * round_share(w);
}

// Change of the phase where the weights change by dw.
fn stripe_slope(s: StripePhases, w: vec3f, dw: vec3f) -> f32 {
    let turns = windings(s);
    let linear = dot(unfolded_corners(s, w), dw);
    if turns == 0.0 {
        return linear;
    }
    return linear + turns * round_slope(w, dw);
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
