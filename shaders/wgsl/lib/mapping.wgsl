// How the tile reaches the surface: the mesh's own uv, the light-aligned frame of the face, or three planes.
// Each gives up to three patterns with weights that sum to 1, and the footprint of a pixel.
//!include lib/form.wgsl
//!include lib/mesh_types.wgsl
//!include lib/surface.wgsl
//!include lib/face_frame.wgsl

const MAPPING_UV: u32 = 0u;
const MAPPING_FRAMES: u32 = 1u;
const MAPPING_TRIPLANAR: u32 = 2u;
override MAPPING: u32 = 0u;

struct Pattern {
    uv: vec2f,
    weight: f32,
}

struct Mapped {
    a: Pattern,
    b: Pattern,
    c: Pattern,
    tiles_per_px: f32,
}

// Tiles across a pixel for surface coordinates that are true to length: from the distance and, in the hardened form,
// the slant of the smooth surface. The paper takes the distance alone (Suarez 2013, end of section 3.4).
fn footprint(point: Point) -> f32 {
    let flat_on = material.tile_scale * scene.pixel_world_at_1 * point.depth;
    if FORM == FORM_LITERAL {
        return flat_on;
    }
    return flat_on / clamp(abs(dot(point.normal, point.view)), 0.1, 1.0);
}

// A pixel on a slanted surface is longer one way than the other, and strokes that follow the form run both ways: by the
// longer side those that run away from the viewer would be smeared, by the shorter those across would flicker.
fn mean_footprint(point: Point) -> f32 {
    return sqrt(footprint(point) * material.tile_scale * scene.pixel_world_at_1 * point.depth);
}

// The place of a point in the space of the frames: the world, or the mesh's own space in the literal form, where the
// paper computes them.
fn frame_place(p_world: vec3f) -> vec3f {
    if FORM == FORM_LITERAL {
        return (scene.mesh_from_world * vec4f(p_world, 1.0)).xyz;
    }
    return p_world;
}

fn map_uv(point: Point) -> Mapped {
    let uv = tile_uv(point.uv);
    let dx = dpdx(uv);
    let dy = dpdy(uv);
    let none = Pattern(vec2f(0.0), 0.0);
    return Mapped(Pattern(uv, 1.0), none, none, sqrt(max(dot(dx, dx), dot(dy, dy))));
}

// Surface coordinates of a place in the space of the frames.
fn frame_st(frame: FaceFrame, p: vec3f) -> vec2f {
    return vec2f(dot(p, frame.tangent), dot(p, vec3f(frame.bitangent_x, frame.bitangent_yz)));
}

// The frame of a face with this normal, its half turn, and the fixed frame, at a place p that has st in the first.
fn frame_patterns(p: vec3f, st: vec2f, n: vec3f, shares: vec3f) -> array<Pattern, 3> {
    let e = fixed_tangent(n);
    let fixed_st = vec2f(dot(p, e), dot(p, cross(n, e)));
    return array<Pattern, 3>(
        Pattern(tile_uv(st), shares.x),
        Pattern(tile_uv(-st), shares.y),
        Pattern(tile_uv(fixed_st), shares.z),
    );
}

// Vertices hand on the place in the frame, in place of the mesh's uv.
fn map_frames(point: Point) -> Mapped {
    let n = oct_decode(point.framing.y);
    let patterns = frame_patterns(frame_place(point.p_world), point.uv, n, unpack_shares(point.framing.x));
    return Mapped(patterns[0], patterns[1], patterns[2], footprint(point));
}

// Weights of the three planes: a plane takes part where the normal leans towards its axis.
fn triplanar_weights(n: vec3f) -> vec3f {
    let w = pow(max(abs(n) - 0.2, vec3f(0.0)), vec3f(3.0));
    return w / (w.x + w.y + w.z);
}

fn map_triplanar(point: Point) -> Mapped {
    let p = frame_place(point.p_world);
    let w = triplanar_weights(point.normal);
    // The offsets keep the three patterns independent of each other.
    return Mapped(
        Pattern(tile_uv(p.zy) + vec2f(0.37, 0.11), w.x),
        Pattern(tile_uv(p.xz) + vec2f(0.71, 0.53), w.y),
        Pattern(tile_uv(p.xy), w.z),
        footprint(point),
    );
}

fn map_surface(point: Point) -> Mapped {
    if MAPPING == MAPPING_FRAMES {
        return map_frames(point);
    }
    if MAPPING == MAPPING_TRIPLANAR {
        return map_triplanar(point);
    }
    return map_uv(point);
}

// How many of the patterns take part; the rest have no weight.
fn pattern_count(mapped: Mapped) -> u32 {
    if MAPPING == MAPPING_UV {
        return 1u;
    }
    if MAPPING == MAPPING_FRAMES {
        return select(3u, 1u, mapped.a.weight > 0.999);
    }
    return 3u;
}
