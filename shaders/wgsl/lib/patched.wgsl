// The vertex stages of methods that draw with all mappings, by what their vertices carry: nothing, the mesh's own uv,
// what corners of triangles see of patches, or the frames of faces.
//!include lib/faced.wgsl
//!include lib/mapping.wgsl
//!include lib/patches.wgsl

struct UvIn {
    @location(0) position: vec3f,
    @location(1) normal_oct: u32,
    @location(2) uv: vec2f,
}

// A corner of a triangle. All corners of one have the same patches in the same order.
struct CornerIn {
    @location(0) position: vec3f,
    @location(1) normal_oct: u32,
    // Places on the tile of two patches each, in units of PLACE_RANGE tiles.
    @location(3) places_ab: vec4f,
    @location(4) places_cd: vec4f,
    // Distances behind the nearest patch, in units of BEHIND_RANGE feathers; of lapped textures the alpha.
    @location(5) behind: vec4f,
}

// The same of patches that turn with the light.
struct TurningIn {
    @location(0) position: vec3f,
    @location(1) normal_oct: u32,
    @location(3) places_ab: vec4f,
    @location(4) places_cd: vec4f,
    @location(5) behind: vec4f,
    @location(6) seeds: vec4u,
}

// The same of lapped textures, of which a triangle has up to eight, in the order of painting.
struct LappedIn {
    @location(0) position: vec3f,
    @location(1) normal_oct: u32,
    @location(3) places_ab: vec4f,
    @location(4) places_cd: vec4f,
    @location(5) alphas_abcd: vec4f,
    @location(10) places_ef: vec4f,
    @location(11) places_gh: vec4f,
    @location(12) alphas_efgh: vec4f,
}

// Where strokes lie by frames, the first two seeds are shares and normal of the face's.
struct PatchedOut {
    @builtin(position) clip: vec4f,
    @location(0) p_world: vec3f,
    @location(1) normal: vec3f,
    @location(2) uv: vec2f,
    @location(6) places_ab: vec4f,
    @location(7) places_cd: vec4f,
    @location(8) behind: vec4f,
    @location(9) @interpolate(flat, either) seeds: vec4u,
}

struct PatchedIn {
    @location(6) places_ab: vec4f,
    @location(7) places_cd: vec4f,
    @location(8) behind: vec4f,
    @location(9) @interpolate(flat, either) seeds: vec4u,
}

struct LappedOut {
    @builtin(position) clip: vec4f,
    @location(0) p_world: vec3f,
    @location(1) normal: vec3f,
    @location(2) uv: vec2f,
    // Where the tone is that of the vertices.
    @location(3) tone: f32,
    @location(6) places_ab: vec4f,
    @location(7) places_cd: vec4f,
    @location(8) alphas_abcd: vec4f,
    @location(9) places_ef: vec4f,
    @location(10) places_gh: vec4f,
    @location(11) alphas_efgh: vec4f,
}

struct LappedFragment {
    @location(3) tone: f32,
    @location(6) places_ab: vec4f,
    @location(7) places_cd: vec4f,
    @location(8) alphas_abcd: vec4f,
    @location(9) places_ef: vec4f,
    @location(10) places_gh: vec4f,
    @location(11) alphas_efgh: vec4f,
}

// Lapped textures at a fragment, in the order of painting.
struct Lapped {
    first: Overlap,
    then: Overlap,
}

fn patched(surface: VertexOut, overlap: Overlap) -> PatchedOut {
    return PatchedOut(
        surface.clip,
        surface.p_world,
        surface.normal,
        surface.uv,
        overlap.places_ab,
        overlap.places_cd,
        overlap.behind,
        overlap.seeds,
    );
}

// What a vertex sees that sees no patches.
fn no_overlap() -> Overlap {
    return Overlap(vec4f(0.0), vec4f(0.0), vec4f(0.0), vec4u(NO_SEED));
}

fn patched_vertex(in: VertexIn) -> PatchedOut {
    return patched(surface_vertex(in, vec2f(0.0)), no_overlap());
}

fn patched_uv(in: UvIn) -> PatchedOut {
    return patched(surface_vertex(VertexIn(in.position, in.normal_oct), in.uv), no_overlap());
}

fn patched_corner(in: CornerIn) -> PatchedOut {
    let overlap = carried_overlap(in.places_ab, in.places_cd, in.behind, vec4u(NO_SEED));
    return patched(surface_vertex(VertexIn(in.position, in.normal_oct), vec2f(0.0)), overlap);
}

fn patched_turning(in: TurningIn) -> PatchedOut {
    let overlap = carried_overlap(in.places_ab, in.places_cd, in.behind, in.seeds);
    return patched(surface_vertex(VertexIn(in.position, in.normal_oct), vec2f(0.0)), overlap);
}

fn lapped_vertex(in: LappedIn) -> LappedOut {
    let surface = surface_vertex(VertexIn(in.position, in.normal_oct), vec2f(0.0));
    let first = carried_overlap(in.places_ab, in.places_cd, in.alphas_abcd, vec4u(NO_SEED));
    let then = carried_overlap(in.places_ef, in.places_gh, in.alphas_efgh, vec4u(NO_SEED));
    return LappedOut(
        surface.clip,
        surface.p_world,
        surface.normal,
        surface.uv,
        0.0,
        first.places_ab,
        first.places_cd,
        first.behind,
        then.places_ab,
        then.places_cd,
        then.behind,
    );
}

// Three vertices to a face, counted from the first face of the draw.
fn patched_face(index: u32) -> PatchedOut {
    let frame = face_frames[face_of(index)];
    var surface = surface_vertex(pulled_vertex(index), vec2f(0.0));
    surface.uv = frame_st(frame, frame_place(surface.p_world));
    var overlap = no_overlap();
    overlap.seeds = vec4u(frame.shares, frame.normal_oct, NO_SEED, NO_SEED);
    return patched(surface, overlap);
}

fn patched_point(in: FragmentIn, patched: PatchedIn, front: bool) -> Point {
    var point = surface_point(in, front);
    point.framing = patched.seeds.xy;
    return point;
}

fn lapped_of(in: LappedFragment) -> Lapped {
    return Lapped(
        Overlap(in.places_ab, in.places_cd, in.alphas_abcd, vec4u(NO_SEED)),
        Overlap(in.places_ef, in.places_gh, in.alphas_efgh, vec4u(NO_SEED)),
    );
}

// The same without the one that is painted first.
fn stepped(lapped: Lapped) -> Lapped {
    let a = lapped.first;
    let b = lapped.then;
    return Lapped(
        Overlap(
            vec4f(a.places_ab.zw, a.places_cd.xy),
            vec4f(a.places_cd.zw, b.places_ab.xy),
            vec4f(a.behind.yzw, b.behind.x),
            a.seeds,
        ),
        Overlap(
            vec4f(b.places_ab.zw, b.places_cd.xy),
            vec4f(b.places_cd.zw, 0.0, 0.0),
            vec4f(b.behind.yzw, 0.0),
            b.seeds,
        ),
    );
}

fn overlap_of(in: PatchedIn) -> Overlap {
    return Overlap(in.places_ab, in.places_cd, in.behind, in.seeds);
}
