// One sample and a threshold. Freudenberg, "Real-Time Stroke Textures", SIGGRAPH 2001 sketch: strokes of all tones
// composited into one channel; or, with PATTERN_LINES, lines whose width follows the tone.
//!include lib/surface.wgsl
//!include lib/stages.wgsl
//!include lib/light.wgsl
//!include lib/columns.wgsl
//!include lib/threshold.wgsl
//!include lib/halftone.wgsl
//!include lib/blend.wgsl

const PATTERN_STROKES: u32 = 0u;
const PATTERN_LINES: u32 = 1u;
override PATTERN: u32 = 0u;

fn pattern_ink(uv: vec2f, scale: Scale, d: f32) -> f32 {
    if PATTERN == PATTERN_LINES {
        if FORM == FORM_LITERAL {
            let lines = floor(material.size_px / material.line_period_px);
            return threshold_one_sided(d, halftone_threshold(uv.y, lines), material.slope);
        }
        var t_per_px = length(vec2f(dpdx(uv.y), dpdy(uv.y)));
        if MAPPING != MAPPING_UV && MAPPING != MAPPING_TRIPLANAR {
            // Fragments of a quad may lie on different faces.
            t_per_px = scale.tiles_per_px;
        }
        return halftone_ink(uv.y, t_per_px, material.line_period_px, d);
    }
    let level = scale.level;
    // The threshold, and how much it changes from texel to texel.
    let sampled = textureSampleLevel(map, map_sampler, uv, 0, level).rg;
    if FORM == FORM_LITERAL {
        return threshold_one_sided(d, sampled.r, material.slope);
    }
    let theta = equalised(sampled.r, level);
    let texels_per_px = scale.tiles_per_px * material.size_px * exp2(-level);
    return threshold_centred(d, theta.share, theta.rate * sampled.g * texels_per_px);
}

@fragment
fn fragment(in: FragmentIn, patched: PatchedIn, @builtin(front_facing) front: bool) -> @location(0) vec4f {
    let point = patched_point(in, patched, front);
    let d = darkness(reflectance(), point.p_world, point.normal, point.view);
    return drawn(surface_ink(point, overlap_of(patched), d));
}

@fragment
fn fragment_lapped(in: FragmentIn, lapped: LappedFragment, @builtin(front_facing) front: bool) -> @location(0) vec4f {
    let point = surface_point(in, front);
    let d = darkness(reflectance(), point.p_world, point.normal, point.view);
    return drawn(lapped_ink(lapped_of(lapped), map_scale(mean_footprint(point)), d));
}
