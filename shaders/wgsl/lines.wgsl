// Contour, border and crease lines, or all edges: one quad per line, as wide as asked on the screen, with round ends.
// Praun and others, "Real-Time Hatching", 2001, section 2.
//!include lib/scene.wgsl
//!include lib/mesh_types.wgsl
//!include lib/edges.wgsl

// The edges that are lines: see line_edges.wgsl. Not read where every edge is one.
@group(2) @binding(1) var<storage, read> listed: array<u32>;

struct LineOut {
    @builtin(position) clip: vec4f,
    // Screen place and the two ends, in pixels; constant over the quad where flat.
    @location(0) @interpolate(linear) place_px: vec2f,
    @location(1) @interpolate(flat, either) from_px: vec2f,
    @location(2) @interpolate(flat, either) to_px: vec2f,
    @location(3) @interpolate(flat, either) width_px: f32,
}

// Lines are drawn this many of their widths nearer to the camera, so that the surface beside them does not cut them.
const PULL_WIDTHS: f32 = 1.0;
// How far contours stand clear of the surface, as a share of their soft edge: at 1 it hides nothing of them, and a thread
// of paper parts them from dark surfaces; at -1 it hides all of that edge, here more, there less, as its own border has
// steps. As little of it as leaves no thread.
const CONTOUR_CLEAR: f32 = -0.3;
// What it hides of them in the mean, in pixels.
const CONTOUR_HIDDEN_PX: f32 = 0.245;
// How much thinner lines are in the round ends by which neighbours join, in pixels: soft edges that lie over each other
// would make joints thicker.
const END_INSET_PX: f32 = 0.5;

// Clip place of a point pulled towards the camera: the depth of the nearer point at the screen place of the point itself.
fn pulled_clip(p_world: vec3f) -> vec4f {
    let clip = scene.clip_from_world * vec4f(p_world, 1.0);
    let towards = to_camera(p_world);
    let depth = -dot(towards, scene.camera_forward);
    let pull = PULL_WIDTHS * style.width_px * scene.pixel_world_at_1 * depth;
    let nearer = scene.clip_from_world * vec4f(p_world + pull * normalize(towards), 1.0);
    return vec4f(clip.xy, nearer.z / max(nearer.w, 1e-6) * clip.w, clip.w);
}

fn px_from_clip(clip: vec4f) -> vec2f {
    return (0.5 + 0.5 * clip.xy / clip.w * vec2f(1.0, -1.0)) * scene.viewport_px;
}

@vertex
fn vertex(@builtin(vertex_index) corner: u32, @builtin(instance_index) index: u32) -> LineOut {
    let edge = edges[select(listed[index], index, style.edges != 0u)];
    var out: LineOut;
    // Outside the clip volume: nothing is drawn.
    out.clip = vec4f(2.0, 2.0, 2.0, 1.0);
    let a_world = end_world(edge.a);
    let b_world = end_world(edge.b);
    let a = pulled_clip(a_world);
    let b = pulled_clip(b_world);
    let kind = line_kind(edge, 0.5 * (a_world + b_world));
    if a.w <= 1e-4 || b.w <= 1e-4 || kind == LINE_NONE {
        return out;
    }
    let a_px = px_from_clip(a);
    let b_px = px_from_clip(b);
    let length_px = distance(a_px, b_px);
    let along = select(vec2f(1.0, 0.0), (b_px - a_px) / max(length_px, 1e-6), length_px > 1e-6);
    // To the right of a to b on the screen, whose y points down.
    let across = vec2f(-along.y, along.x);
    let is_contour = kind != LINE_CENTRED;
    out.width_px = style.width_px + select(0.0, CONTOUR_HIDDEN_PX, is_contour);
    let beside = 0.5 * out.width_px + CONTOUR_CLEAR * 0.5 * (abs(across.x) + abs(across.y));
    let aside = beside * (f32(kind == LINE_RIGHT) - f32(kind == LINE_LEFT));
    out.from_px = a_px + aside * across;
    out.to_px = b_px + aside * across;
    // Half a width and a pixel for the soft edge, on all sides.
    let reach = 0.5 * out.width_px + 1.0;
    let at_b = corner >= 2u;
    let side = select(-1.0, 1.0, corner % 2u == 1u);
    let place = select(out.from_px - along * reach, out.to_px + along * reach, at_b) + across * side * reach;
    let end = select(a, b, at_b);
    let ndc = (place / scene.viewport_px * 2.0 - 1.0) * vec2f(1.0, -1.0);
    out.clip = vec4f(ndc * end.w, end.z, end.w);
    out.place_px = place;
    return out;
}

// Integral of max(x, 0).
fn ramp(x: f32) -> f32 {
    let above = max(x, 0.0);
    return 0.5 * above * above;
}

// Share of a pixel on the lower side of a straight edge `x` px above its middle: its square as seen along the edge is a
// trapezoid, two boxes folded with each other.
fn share_below(x: f32, normal: vec2f) -> f32 {
    let a = max(abs(normal.x), abs(normal.y));
    let b = max(min(abs(normal.x), abs(normal.y)), 0.01);
    let outer = 0.5 * (a + b);
    let inner = 0.5 * (a - b);
    let sum = ramp(x + outer) - ramp(x + inner) - ramp(x - inner) + ramp(x - outer);
    return clamp(sum / (a * b), 0.0, 1.0);
}

// Share of a pixel covered by a line with round ends; thinner than a pixel it fades instead of breaking up.
fn line_coverage(place: vec2f, from_px: vec2f, to_px: vec2f, width_px: f32) -> f32 {
    let v = to_px - from_px;
    let length_px = length(v);
    let along = select(vec2f(1.0, 0.0), v / max(length_px, 1e-6), length_px > 1e-6);
    let at = dot(place - from_px, along);
    let beyond = max(-at, at - length_px);
    let normal = vec2f(-along.y, along.x);
    let beside = dot(place - from_px, normal);
    if beyond <= 0.0 {
        return share_below(0.5 * width_px - beside, normal) - share_below(-0.5 * width_px - beside, normal);
    }
    let distance_px = length(vec2f(beyond, beside));
    return clamp(0.5 * width_px + 0.5 - END_INSET_PX - distance_px, 0.0, min(width_px, 1.0));
}

@fragment
fn fragment(in: LineOut) -> @location(0) vec4f {
    let coverage = line_coverage(in.place_px, in.from_px, in.to_px, in.width_px);
    return vec4f(style.colour.rgb, style.colour.a * coverage);
}
