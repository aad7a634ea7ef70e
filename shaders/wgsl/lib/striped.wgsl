// The vertex stage of lines along a field: the corners of triangles carry their phases. A phase counts lines and is whole
// in the middle of each; it is known up to sign and whole numbers, which all corners of a triangle share.
//!include lib/surface.wgsl
//!include lib/patches.wgsl
//!include lib/stripes.wgsl

// A corner with the phases of both fields, along and across, in lines; around the middle of a triangle in which lines end
// the weights of its side's two corners, and how often both phases wind.
struct LineIn {
    @location(0) position: vec3f,
    @location(1) normal_oct: u32,
    @location(7) phases: vec2f,
    @location(8) ring: vec4i,
}

// The same with the patches that strokes are counted on, their seeds, and of each what makes its rows out of both phases.
struct StrokeIn {
    @location(0) position: vec3f,
    @location(1) normal_oct: u32,
    @location(3) places_ab: vec4f,
    @location(4) places_cd: vec4f,
    @location(5) behind: vec4f,
    @location(6) seeds: vec4u,
    @location(7) phases: vec2f,
    @location(8) ring: vec4i,
    @location(9) rows: vec4u,
}

struct LineOut {
    @builtin(position) clip: vec4f,
    @location(0) p_world: vec3f,
    @location(1) normal: vec3f,
    // The phases.
    @location(2) uv: vec2f,
    @location(10) ring: vec4f,
}

struct LineFragment {
    @location(10) ring: vec4f,
}

struct StrokeOut {
    @builtin(position) clip: vec4f,
    @location(0) p_world: vec3f,
    @location(1) normal: vec3f,
    @location(2) uv: vec2f,
    @location(6) places_ab: vec4f,
    @location(7) places_cd: vec4f,
    @location(8) behind: vec4f,
    @location(9) @interpolate(flat, either) seeds: vec4u,
    @location(10) ring: vec4f,
    @location(11) @interpolate(flat, either) rows: vec4u,
}

struct StrokeFragment {
    @location(6) places_ab: vec4f,
    @location(7) places_cd: vec4f,
    @location(8) behind: vec4f,
    @location(9) @interpolate(flat, either) seeds: vec4u,
    @location(10) ring: vec4f,
    @location(11) @interpolate(flat, either) rows: vec4u,
}

// The phase of one field at a fragment, and its change to the next pixel and to the one below.
struct Phase {
    at: f32,
    slope: vec2f,
}

fn line_vertex(in: LineIn) -> LineOut {
    let surface = surface_vertex(VertexIn(in.position, in.normal_oct), in.phases);
    return LineOut(surface.clip, surface.p_world, surface.normal, surface.uv, vec4f(in.ring));
}

fn stroke_vertex(in: StrokeIn) -> StrokeOut {
    let surface = surface_vertex(VertexIn(in.position, in.normal_oct), in.phases);
    let overlap = carried_overlap(in.places_ab, in.places_cd, in.behind, in.seeds);
    return StrokeOut(
        surface.clip,
        surface.p_world,
        surface.normal,
        surface.uv,
        overlap.places_ab,
        overlap.places_cd,
        overlap.behind,
        overlap.seeds,
        vec4f(in.ring),
        in.rows,
    );
}

// The phase of a field, interpolated between the corners, as it is at a fragment.
fn phase_of(phase: f32, ring: vec4f, turns: f32) -> Phase {
    let ends_dx = dpdx(ring.xy);
    let ends_dy = dpdy(ring.xy);
    let dx = wound_slope(dpdx(phase), ring.xy, ends_dx, turns);
    let dy = wound_slope(dpdy(phase), ring.xy, ends_dy, turns);
    return Phase(wound_phase(phase, ring.xy, turns), vec2f(dx, dy));
}
