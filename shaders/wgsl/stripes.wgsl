// Engraving: one line field over the whole surface, as wide as the tone asks, and a second one across it in the dark.
// Knöppel and others, "Stripe patterns on surfaces", 2015.
//!include lib/surface.wgsl
//!include lib/light.wgsl
//!include lib/striped.wgsl
//!include lib/strokes.wgsl

const ALONG: u32 = 0u;
const ACROSS: u32 = 1u;
// Strokes even out where lines get this close, in lines to the pixel.
const EVEN_FROM: f32 = 0.2;

// As doubled_ink, with the strokes of the old line and of the new one that are next to the fragment.
fn varied_ink(
    overlap: Overlap,
    patch_rows: vec4u,
    field: u32,
    phase: f32,
    phase_per_px: f32,
    line_period_px: f32,
    d: f32,
) -> f32 {
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
    // The old line and the new one: mostly one of them is near, or none.
    let is_old = abs(x) - reach < stroke_reach(2.0 - f, d, variety);
    let is_new = 1.0 - abs(x) - reach < stroke_reach(f, d, variety);
    var now_new = !is_old;
    var ink = 0.0;
    loop {
        if is_old || is_new {
            let stroke = patched_stroke(overlap, patch_rows, field, 2 * i32(row) + select(0, i32(side), now_new), rows, variety);
            ink += stroke_ink(stroke, select(x, x - side, now_new), select(2.0 - f, f, now_new), k, d, variety);
        }
        if now_new || !is_new {
            break;
        }
        now_new = true;
    }
    return mix(min(ink, 1.0), d, smoothstep(FADE_FROM, FADE_TO, per_px));
}

// Ink of both fields.
fn plain_ink(along: Phase, across: Phase, d: f32) -> f32 {
    let shares = crossed_darkness(d, material.cross_from);
    let period = material.line_period_px;
    let ink = doubled_ink(along.at, length(along.slope), period, shares.x);
    if shares.y <= 0.0 {
        return ink;
    }
    return 1.0 - (1.0 - ink) * (1.0 - doubled_ink(across.at, length(across.slope), period, shares.y));
}

// The same of lines made of strokes.
fn stroked_ink(overlap: Overlap, rows: vec4u, along: Phase, across: Phase, d: f32) -> f32 {
    let shares = crossed_darkness(d, material.cross_from);
    let period = material.line_period_px;
    let ink = varied_ink(overlap, rows, ALONG, along.at, length(along.slope), period, shares.x);
    if shares.y <= 0.0 {
        return ink;
    }
    let crossing = varied_ink(overlap, rows, ACROSS, across.at, length(across.slope), period, shares.y);
    return 1.0 - (1.0 - ink) * (1.0 - crossing);
}

@vertex
fn vertex_lines(in: LineIn) -> LineOut {
    return line_vertex(in);
}

@vertex
fn vertex_strokes(in: StrokeIn) -> StrokeOut {
    return stroke_vertex(in);
}

@fragment
fn fragment(in: FragmentIn, lines: LineFragment, @builtin(front_facing) front: bool) -> @location(0) vec4f {
    let point = surface_point(in, front);
    let along = phase_of(in.uv.x, lines.ring, lines.ring.z);
    let across = phase_of(in.uv.y, lines.ring, lines.ring.w);
    let d = darkness(reflectance(), point.p_world, point.normal, point.view);
    return drawn(plain_ink(along, across, d));
}

@fragment
fn fragment_strokes(in: FragmentIn, strokes: StrokeFragment, @builtin(front_facing) front: bool) -> @location(0) vec4f {
    let point = surface_point(in, front);
    let along = phase_of(in.uv.x, strokes.ring, strokes.ring.z);
    let across = phase_of(in.uv.y, strokes.ring, strokes.ring.w);
    let overlap = Overlap(strokes.places_ab, strokes.places_cd, strokes.behind, strokes.seeds);
    let d = darkness(reflectance(), point.p_world, point.normal, point.view);
    return drawn(stroked_ink(overlap, strokes.rows, along, across, d));
}
