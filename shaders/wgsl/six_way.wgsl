// Six-way blend. Praun and others, "Real-Time Hatching", 2001, section 5, and a student implementation of it: the tone
// is computed at the vertices, where the two columns that bracket it get weights; the weights of all six columns are
// interpolated, the six images, packed in the channels of two, are summed with them, and what is left is white paper.
//!include lib/surface.wgsl
//!include lib/patched.wgsl
//!include lib/light.wgsl
//!include lib/columns.wgsl
//!include lib/blend.wgsl

struct Weights {
    light: vec3f,
    dark: vec3f,
}

struct SixWayOut {
    @builtin(position) clip: vec4f,
    @location(0) p_world: vec3f,
    @location(1) normal: vec3f,
    @location(2) uv: vec2f,
    @location(4) light: vec3f,
    @location(5) dark: vec3f,
    @location(6) places_ab: vec4f,
    @location(7) places_cd: vec4f,
    @location(8) behind: vec4f,
    @location(9) @interpolate(flat, either) seeds: vec4u,
}

struct SixWayIn {
    @location(4) light: vec3f,
    @location(5) dark: vec3f,
}

// Weights of columns 1 to 6 for a place among them; white has what is missing to 1.
fn column_weights(x: f32) -> Weights {
    return Weights(
        max(1.0 - abs(vec3f(1.0, 2.0, 3.0) - x), vec3f(0.0)),
        max(1.0 - abs(vec3f(4.0, 5.0, 6.0) - x), vec3f(0.0)),
    );
}

fn six_ink(uv: vec2f, level: f32, weights: Weights) -> f32 {
    let light = textureSampleLevel(map, map_sampler, uv, 0, level).rgb;
    let dark = textureSampleLevel(map, map_sampler, uv, 1, level).rgb;
    return dot(light, weights.light) + dot(dark, weights.dark);
}

// Weights of the tone at a vertex.
fn vertex_weights(surface: PatchedOut) -> Weights {
    let n = normalize(surface.normal);
    let v = normalize(to_camera(surface.p_world));
    return column_weights(column_coordinate(darkness(reflectance(), surface.p_world, n, v)));
}

// A vertex with the weights of its tone.
fn weighted(surface: PatchedOut) -> SixWayOut {
    let weights = vertex_weights(surface);
    return SixWayOut(
        surface.clip,
        surface.p_world,
        surface.normal,
        surface.uv,
        weights.light,
        weights.dark,
        surface.places_ab,
        surface.places_cd,
        surface.behind,
        surface.seeds,
    );
}

@vertex
fn vertex(in: VertexIn) -> SixWayOut {
    return weighted(patched_vertex(in));
}

@vertex
fn vertex_uv(in: UvIn) -> SixWayOut {
    return weighted(patched_uv(in));
}

@vertex
fn vertex_corner(in: CornerIn) -> SixWayOut {
    return weighted(patched_corner(in));
}

@vertex
fn vertex_turning(in: TurningIn) -> SixWayOut {
    return weighted(patched_turning(in));
}

@vertex
fn vertex_lapped(in: LappedIn) -> LappedOut {
    var out = lapped_vertex(in);
    let surface = VertexOut(out.clip, out.p_world, out.normal, out.uv);
    out.tone = weighted_tone(vertex_weights(patched(surface, no_overlap())));
    return out;
}

@vertex
fn vertex_face(@builtin(vertex_index) index: u32) -> SixWayOut {
    return weighted(patched_face(index));
}

// The tone that interpolated weights stand for.
fn weighted_tone(weights: Weights) -> f32 {
    let light = vec3f(column_tone(1u), column_tone(2u), column_tone(3u));
    let dark = vec3f(column_tone(4u), column_tone(5u), column_tone(6u));
    return dot(weights.light, light) + dot(weights.dark, dark);
}

// Ink at a tone, for patterns that the blend draws at another one than the vertices'.
fn pattern_ink(uv: vec2f, scale: Scale, d: f32) -> f32 {
    return six_ink(uv, scale.level, column_weights(column_coordinate(d)));
}

@fragment
fn fragment(
    in: FragmentIn,
    six: SixWayIn,
    patched: PatchedIn,
    @builtin(front_facing) front: bool,
) -> @location(0) vec4f {
    let point = patched_point(in, patched, front);
    // Interpolation rounds a little below 0.
    let weights = Weights(max(six.light, vec3f(0.0)), max(six.dark, vec3f(0.0)));
    if MAPPING == MAPPING_PATCHES {
        return drawn(surface_ink(point, overlap_of(patched), weighted_tone(weights)));
    }
    let mapped = map_surface(point);
    let level = map_level(mapped.tiles_per_px);
    let patterns = array<Pattern, 3>(mapped.a, mapped.b, mapped.c);
    let count = pattern_count(mapped);
    var ink = 0.0;
    for (var i = 0u; i < count; i++) {
        ink += patterns[i].weight * six_ink(patterns[i].uv, level, weights);
    }
    return drawn(ink);
}

@fragment
fn fragment_lapped(in: FragmentIn, lapped: LappedFragment, @builtin(front_facing) front: bool) -> @location(0) vec4f {
    let point = surface_point(in, front);
    return drawn(lapped_ink(lapped_of(lapped), map_scale(mean_footprint(point)), lapped.tone));
}
