// Directions of strokes on the screen. A stroke keeps to a line of equal v on its tile, so it runs across v's gradient on
// the screen. A direction is a complex number of twice the angle, counted from the horizontal counter-clockwise, so that
// both ways along a stroke are the same: unit where one pattern is drawn, shorter the less several agree, 0 where there
// is none. Knöppel and others, "Globally optimal direction fields", 2013, section 2, for n = 2.
//!include lib/mapping.wgsl
//!include lib/patched.wgsl

// Shorter gradients, in tiles or lines per pixel, have none.
const LEAST_GRADIENT: f32 = 1e-9;

// `gradient` is the change to the pixel on the right and to the one below.
fn direction_across(gradient: vec2f) -> vec2f {
    let g = length(gradient);
    if !(g > LEAST_GRADIENT) {
        return vec2f(0.0);
    }
    return -complex_square(vec2f(gradient.x, -gradient.y) / g);
}

// The direction of a pattern's strokes, given the changes of its surface coordinates to the right and below.
fn pattern_direction(st_dx: vec2f, st_dy: vec2f) -> vec2f {
    let v = material.tile_from_surface.zw;
    return direction_across(vec2f(dot(v, st_dx), dot(v, st_dy)));
}

// `framing` is that of the point, `st_dx` and `st_dy` are changes of the place in the frame, `dx` and `dy` in the space of
// the frames. A frame and its half turn have one direction.
fn frame_direction(framing: vec2u, st_dx: vec2f, st_dy: vec2f, dx: vec3f, dy: vec3f) -> vec2f {
    let n = oct_decode(framing.y);
    let e = fixed_tangent(n);
    let f = cross(n, e);
    let fixed = unpack_shares(framing.x).z;
    return mix(pattern_direction(st_dx, st_dy), pattern_direction(vec2f(dot(e, dx), dot(f, dx)), vec2f(dot(e, dy), dot(f, dy))), fixed);
}

fn triplanar_direction(n: vec3f, dx: vec3f, dy: vec3f) -> vec2f {
    let w = triplanar_weights(n);
    let x = pattern_direction(dx.zy, dy.zy);
    let y = pattern_direction(dx.xz, dy.xz);
    let z = pattern_direction(dx.xy, dy.xy);
    return w.x * x + w.y * y + w.z * z;
}

fn rotated(place: vec2f, angle_rad: f32) -> vec2f {
    let c = cos(angle_rad);
    let s = sin(angle_rad);
    return vec2f(c * place.x - s * place.y, s * place.x + c * place.y);
}

// How the places of an overlap change to the next pixel, and to the one below.
struct OverlapSlopes {
    ab_dx: vec4f,
    cd_dx: vec4f,
    ab_dy: vec4f,
    cd_dy: vec4f,
}

// The direction of one patch, by its weight, from the changes of its place.
fn patch_direction(st_dx: vec2f, st_dy: vec2f, seed: u32, weight: f32) -> vec2f {
    var direction = vec2f(0.0);
    if weight <= 0.0 {
        return direction;
    }
    for (var copy = 0u; copy < select(1u, TURNS, FOLLOW == FOLLOW_LIGHT); copy++) {
        let turn = seed_turn(seed, copy);
        direction += weight * turn.w * pattern_direction(rotated(st_dx, turn.z), rotated(st_dy, turn.z));
    }
    return direction;
}

fn patches_direction(overlap: Overlap, slopes: OverlapSlopes) -> vec2f {
    let weights = overlap_weights(overlap.behind);
    let seeds = overlap.seeds;
    return patch_direction(slopes.ab_dx.xy, slopes.ab_dy.xy, seeds.x, weights.x)
        + patch_direction(slopes.ab_dx.zw, slopes.ab_dy.zw, seeds.y, weights.y)
        + patch_direction(slopes.cd_dx.xy, slopes.cd_dy.xy, seeds.z, weights.z)
        + patch_direction(slopes.cd_dx.zw, slopes.cd_dy.zw, seeds.w, weights.w);
}

// Of one lapped texture over the direction of what lies under it.
fn painted_direction(under: vec2f, st_dx: vec2f, st_dy: vec2f, alpha: f32) -> vec2f {
    return mix(under, pattern_direction(st_dx, st_dy), clamp(alpha, 0.0, 1.0));
}

// Of four lapped textures.
fn overlapped_direction(under: vec2f, overlap: Overlap, slopes: OverlapSlopes) -> vec2f {
    var direction = painted_direction(under, slopes.ab_dx.xy, slopes.ab_dy.xy, overlap.behind.x);
    direction = painted_direction(direction, slopes.ab_dx.zw, slopes.ab_dy.zw, overlap.behind.y);
    direction = painted_direction(direction, slopes.cd_dx.xy, slopes.cd_dy.xy, overlap.behind.z);
    return painted_direction(direction, slopes.cd_dx.zw, slopes.cd_dy.zw, overlap.behind.w);
}

fn lapped_direction(lapped: Lapped, first: OverlapSlopes, then: OverlapSlopes) -> vec2f {
    return overlapped_direction(overlapped_direction(vec2f(0.0), lapped.first, first), lapped.then, then);
}

// Of the mapping; `uv_dx` and `uv_dy` are changes of the point's uv.
fn mapped_direction(
    point: Point,
    overlap: Overlap,
    slopes: OverlapSlopes,
    dx: vec3f,
    dy: vec3f,
    uv_dx: vec2f,
    uv_dy: vec2f,
) -> vec2f {
    if MAPPING == MAPPING_FRAMES {
        return frame_direction(point.framing, uv_dx, uv_dy, dx, dy);
    }
    if MAPPING == MAPPING_TRIPLANAR {
        return triplanar_direction(point.normal, dx, dy);
    }
    if MAPPING == MAPPING_PATCHES {
        return patches_direction(overlap, slopes);
    }
    return pattern_direction(uv_dx, uv_dy);
}
