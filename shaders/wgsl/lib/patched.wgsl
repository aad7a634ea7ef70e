// The vertex stage of methods that draw with all mappings: where they draw on patches, an index names a corner, with what
// it sees of them; where they draw by frames, it counts three vertices to a face; else it names a vertex.
//!include lib/surface.wgsl
//!include lib/mapping.wgsl
//!include lib/patches.wgsl

// Where strokes lie by frames, the first two seeds are shares and normal of the face's.
struct PatchedOut {
    @builtin(position) clip: vec4f,
    @location(0) p_world: vec3f,
    @location(1) normal: vec3f,
    @location(2) uv: vec2f,
//!if flat_face
    @location(3) @interpolate(flat, first) face: u32,
//!end
    @location(6) places_ab: vec4f,
    @location(7) places_cd: vec4f,
    @location(8) behind: vec4f,
    @location(9) @interpolate(flat, first) seeds: vec4u,
}

struct PatchedIn {
    @location(6) places_ab: vec4f,
    @location(7) places_cd: vec4f,
    @location(8) behind: vec4f,
    @location(9) @interpolate(flat, first) seeds: vec4u,
}

fn patched_vertex(index: u32) -> PatchedOut {
    var surface: VertexOut;
    var overlap: Overlap;
    if MAPPING == MAPPING_PATCHES {
        surface = mesh_vertex(corner_vertex(index));
        overlap = corner_overlap(index);
    } else if MAPPING == MAPPING_FRAMES {
        let face = index / 3u + material.first_face;
        let frame = face_frames[face];
        surface = mesh_vertex(indices[index + 3u * material.first_face]);
        surface.uv = frame_st(frame, frame_place(surface.p_world));
//!if flat_face
        surface.face = face;
//!end
        overlap.seeds = vec4u(frame.shares, frame.normal_oct, NO_SEED, NO_SEED);
    } else {
        surface = surface_vertex(index);
    }
    var out: PatchedOut;
    out.clip = surface.clip;
    out.p_world = surface.p_world;
    out.normal = surface.normal;
    out.uv = surface.uv;
//!if flat_face
    out.face = surface.face;
//!end
    out.places_ab = overlap.places_ab;
    out.places_cd = overlap.places_cd;
    out.behind = overlap.behind;
    out.seeds = overlap.seeds;
    return out;
}

fn patched_point(in: FragmentIn, patched: PatchedIn, front: bool) -> Point {
    var point = surface_point(in, front);
    point.framing = patched.seeds.xy;
    return point;
}

fn overlap_of(in: PatchedIn) -> Overlap {
    return Overlap(in.places_ab, in.places_cd, in.behind, in.seeds);
}
