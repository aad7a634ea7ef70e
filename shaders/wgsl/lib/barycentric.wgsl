// Where in its face a fragment is.
//!include lib/mesh.wgsl

// Weights of the corners at a place, which is in the space of the frames.
fn corner_weights(face: u32, p: vec3f) -> vec3f {
    let first = dot(face_planes[2u * face].xyz, p) + face_planes[2u * face].w;
    let second = dot(face_planes[2u * face + 1u].xyz, p) + face_planes[2u * face + 1u].w;
    return vec3f(first, second, 1.0 - first - second);
}

// Their change along a vector.
fn corner_slopes(face: u32, v: vec3f) -> vec3f {
    let first = dot(face_planes[2u * face].xyz, v);
    let second = dot(face_planes[2u * face + 1u].xyz, v);
    return vec3f(first, second, -first - second);
}

// Where a fragment is in its face, and how that changes to the next pixel.
struct Place {
    weights: vec3f,
    dx: vec3f,
    dy: vec3f,
}

fn place_in_face(face: u32, p: vec3f, dx: vec3f, dy: vec3f) -> Place {
    return Place(corner_weights(face, p), corner_slopes(face, dx), corner_slopes(face, dy));
}
