// Where in its face a fragment is.
//!include lib/mesh.wgsl

// Weights of the corners at a place, which is in the space of the frames.
fn corner_weights(face: u32, p: vec3f) -> vec3f {
    let first = dot(face_planes[2u * face].xyz, p) + face_planes[2u * face].w;
    let second = dot(face_planes[2u * face + 1u].xyz, p) + face_planes[2u * face + 1u].w;
    return vec3f(first, second, 1.0 - first - second);
}
