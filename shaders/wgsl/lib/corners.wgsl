// The corners of a face, in the space of the frames: the world, or in the literal form the mesh's own.

@group(1) @binding(0) var<storage, read> vertices: array<Vertex>;
@group(1) @binding(2) var<storage, read> indices: array<u32>;

fn face_corners(face: u32) -> array<vec3f, 3> {
    var corners: array<vec3f, 3>;
    for (var k = 0u; k < 3u; k++) {
        let p = vertices[indices[3u * face + k]].position;
        if FORM == FORM_LITERAL {
            corners[k] = p;
        } else {
            corners[k] = (scene.world_from_mesh * vec4f(p, 1.0)).xyz;
        }
    }
    return corners;
}

// Twice the area, along the normal.
fn area_vector(corners: array<vec3f, 3>) -> vec3f {
    return cross(corners[1] - corners[0], corners[2] - corners[0]);
}
