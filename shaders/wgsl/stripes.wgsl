// Engraving: one line field over the whole surface, as wide as the tone asks, and a second one across it in the dark.
// Knöppel and others, "Stripe patterns on surfaces", 2015.
//!include lib/surface.wgsl
//!include lib/light.wgsl
//!include lib/mapping.wgsl
//!include lib/barycentric.wgsl
//!include lib/stripes.wgsl
//!include lib/strokes.wgsl

// Whether lines are made of strokes; plain ones know no patches.
override VARIED: u32 = 0u;

const ALONG: u32 = 0u;
const ACROSS: u32 = 1u;
// Strokes even out where lines get this close, in lines to the pixel.
const EVEN_FROM: f32 = 0.2;

// As doubled_ink, with the strokes of the old line and of the new one that are next to the fragment.
fn varied_ink(patches: Patches, field: u32, phase: f32, phase_per_px: f32, line_period_px: f32, d: f32) -> f32 {
    let wanted = 1.0 / max(phase_per_px * line_period_px, 1e-6);
    let octave = clamp(floor(log2(wanted)), 0.0, 12.0);
    let f = clamp(wanted / exp2(octave) - 1.0, 0.0, 1.0);
    let lines = exp2(octave);
    let per_px = phase_per_px * lines;
    let variety = material.variety * (1.0 - smoothstep(EVEN_FROM, FADE_FROM, per_px));
    let k = 0.5 / max(per_px, 1e-6);
    let row = round(phase * lines);
    let x = 2.0 * (phase * lines - row);
    let side = select(1.0, -1.0, x < 0.0);
    // Half a pixel, in units of x. Most of a light tone is paper that no stroke reaches, and knowing so is cheap.
    let reach = 0.5 / k;
    let rows = u32(octave) + 1u;
    var ink = 0.0;
    if abs(x) - reach < stroke_reach(2.0 - f, d, variety) {
        let stroke = patched_stroke(patches, field, 2 * i32(row), rows, variety);
        ink = stroke_ink(stroke, x, 2.0 - f, k, d, variety);
    }
    if 1.0 - abs(x) - reach < stroke_reach(f, d, variety) {
        let stroke = patched_stroke(patches, field, 2 * i32(row) + i32(side), rows, variety);
        ink += stroke_ink(stroke, x - side, f, k, d, variety);
    }
    return mix(min(ink, 1.0), d, smoothstep(FADE_FROM, FADE_TO, per_px));
}

fn stripes_ink(patches: Patches, field: u32, s: StripePhases, place: Place, d: f32) -> f32 {
    let slope = vec2f(stripe_slope(s, place.weights, place.dx), stripe_slope(s, place.weights, place.dy));
    let phase = stripe_phase(s, place.weights);
    if VARIED == 0u {
        return doubled_ink(phase, length(slope), material.line_period_px, d);
    }
    return varied_ink(patches, field, phase, length(slope), material.line_period_px, d);
}

// Ink of both fields.
fn crossed_ink(face: u32, place: Place, d: f32) -> f32 {
    let shares = crossed_darkness(d, material.cross_from);
    var patches: Patches;
    if VARIED != 0u {
        patches = patches_at(face, place.weights);
    }
    let ink = stripes_ink(patches, ALONG, stripes_along[face], place, shares.x);
    if shares.y <= 0.0 {
        return ink;
    }
    return 1.0 - (1.0 - ink) * (1.0 - stripes_ink(patches, ACROSS, stripes_across[face], place, shares.y));
}

@vertex
fn vertex(@builtin(vertex_index) index: u32) -> VertexOut {
    return surface_vertex(index);
}

@fragment
fn fragment(in: FragmentIn, @builtin(front_facing) front: bool) -> @location(0) vec4f {
    let point = surface_point(in, front);
    let p = frame_place(point.p_world);
    let place = place_in_face(point.face, p, dpdx(p), dpdy(p));
    let d = darkness(reflectance(), point.p_world, point.normal, point.view);
    return drawn(crossed_ink(point.face, place, d));
}
