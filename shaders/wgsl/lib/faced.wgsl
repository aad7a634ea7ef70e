// The vertex stage of passes that know the face of a fragment: three vertices to a face, pulled from the mesh's buffers.
//!include lib/mesh.wgsl
//!include lib/surface.wgsl

struct FacedOut {
    @builtin(position) clip: vec4f,
    @location(0) p_world: vec3f,
    @location(1) normal: vec3f,
    @location(2) uv: vec2f,
    @location(3) @interpolate(flat, either) face: u32,
}

struct FacedIn {
    @location(3) @interpolate(flat, either) face: u32,
}

// Face of a vertex that counts from the first face of the draw.
fn face_of(index: u32) -> u32 {
    return index / 3u + material.first_face;
}

// That vertex.
fn pulled_vertex(index: u32) -> VertexIn {
    let vertex = vertices[indices[index + 3u * material.first_face]];
    return VertexIn(vertex.position, vertex.normal_oct);
}

fn faced_vertex(index: u32) -> FacedOut {
    let surface = surface_vertex(pulled_vertex(index), vec2f(0.0));
    return FacedOut(surface.clip, surface.p_world, surface.normal, surface.uv, face_of(index));
}
