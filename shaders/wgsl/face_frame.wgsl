// Light-aligned frames per face, blended with the neighbours'. Suarez and others, "GPU real time hatching", 2013,
// algorithms 1 to 3. The frames come from face_frames.wgsl; each fragment fetches its face's and the neighbours'.
//!include lib/surface.wgsl
//!include lib/adjacency.wgsl

@vertex
fn vertex(@builtin(vertex_index) index: u32) -> VertexOut {
    return surface_vertex(index);
}

// Normals of the frames are in their own space; light needs them in the world, towards the side that is seen.
fn lit_normal(face: u32, front: bool) -> vec3f {
    var n = face_normals[face].xyz;
    if FORM == FORM_LITERAL {
        n = normalize((scene.world_from_mesh_normal * vec4f(n, 0.0)).xyz);
    }
    return select(-n, n, front);
}

fn face_ink(point: Point, p: vec3f, face: u32, front: bool, level: f32) -> f32 {
    let patterns = frame_patterns(p, face_normals[face].xyz, face_frames[face]);
    return contributed_ink(point, lit_normal(face, front), patterns, level);
}

@fragment
fn fragment(in: FragmentIn, @builtin(front_facing) front: bool) -> @location(0) vec4f {
    let point = surface_point(in, front);
    let p = frame_place(point.p_world);
    let face = point.face;
    let level = map_level(footprint(point));
    let own = face_normals[face];
    let first = dot(face_planes[2u * face].xyz, p) + face_planes[2u * face].w;
    let second = dot(face_planes[2u * face + 1u].xyz, p) + face_planes[2u * face + 1u].w;
    // The corner opposite to the edge from corner k to corner k + 1 is corner k + 2.
    let opposite = vec3f(1.0 - first - second, first, second);
    var sum = face_ink(point, p, face, front, level);
    var weight = 1.0;
    for (var k = 0u; k < 3u; k++) {
        let other = neighbours[3u * face + k];
        if other == NO_FACE {
            if FORM == FORM_LITERAL {
                // The adjacency primitive of a border repeats a corner: a triangle without area or normal.
                weight += contribution(dot(own.xyz, normalize(own.xyz * 0.0)), opposite[k]);
            }
            continue;
        }
        let theirs = face_normals[other];
        let f = contribution(dot(own.xyz, theirs.xyz), opposite[k]);
        if FORM == FORM_HARDENED && !(f * own.w * theirs.w > 0.0) {
            continue;
        }
        sum += f * face_ink(point, p, other, front, level);
        weight += f;
    }
    return drawn(sum / weight);
}
