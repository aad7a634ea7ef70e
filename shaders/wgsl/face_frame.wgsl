// Light-aligned frames per face, blended with the neighbours'. Suarez and others, "GPU real time hatching", 2013,
// algorithms 1 to 3. The frames come from face_frames.wgsl; each fragment fetches its face's and the neighbours'. Draws the
// literal form, and is kept to be measured against face_frame_vertex.wgsl.
//!include lib/faced.wgsl
//!include lib/adjacency.wgsl

@vertex
fn vertex_faced(@builtin(vertex_index) index: u32) -> FacedOut {
    return faced_vertex(index);
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
    let frame = face_frames[face];
    let patterns = frame_patterns(p, frame_st(frame, p), face_normals[face].xyz, unpack_shares(frame.shares));
    return contributed_ink(point, lit_normal(face, front), patterns, level);
}

@fragment
fn fragment(in: FragmentIn, faced: FacedIn, @builtin(front_facing) front: bool) -> @location(0) vec4f {
    let point = surface_point(in, front);
    let p = frame_place(point.p_world);
    let face = faced.face;
    let level = map_level(footprint(point));
    let own = face_normals[face];
    let first = dot(face_planes[2u * face].xyz, p) + face_planes[2u * face].w;
    let second = dot(face_planes[2u * face + 1u].xyz, p) + face_planes[2u * face + 1u].w;
    // The corner opposite to the edge from corner k to corner k + 1 is corner k + 2.
    let opposite = vec3f(1.0 - first - second, first, second);
    // The face itself, and the neighbours that contribute here.
    var faces = array<u32, 4>(face, 0u, 0u, 0u);
    var weights = array<f32, 4>(1.0, 0.0, 0.0, 0.0);
    var count = 1u;
    for (var k = 0u; k < 3u; k++) {
        let other = neighbours[3u * face + k];
        var f = 0.0;
        if other != NO_FACE {
            let theirs = face_normals[other];
            f = contribution(dot(own.xyz, theirs.xyz), opposite[k]);
            if FORM == FORM_HARDENED {
                f = select(0.0, f, own.w * theirs.w > 0.0);
            }
        } else if FORM == FORM_LITERAL {
            // The adjacency primitive of a border repeats a corner: a triangle without area or normal.
            f = contribution(dot(own.xyz, normalize(own.xyz * 0.0)), opposite[k]);
        }
        if FORM == FORM_LITERAL || f > 0.0 {
            faces[count] = select(face, other, other != NO_FACE);
            weights[count] = f;
            count++;
        }
    }
    var sum = 0.0;
    var weight = 0.0;
    for (var i = 0u; i < count; i++) {
        sum += weights[i] * face_ink(point, p, faces[i], front, level);
        weight += weights[i];
    }
    return drawn(sum / weight);
}
