// Light-aligned frames per face with the work in the vertex stage, as the paper's geometry stage does it: three
// vertices per face, each with its own parameters for the four faces. Suarez and others, "GPU real time hatching",
// 2013, algorithms 1 to 3. No fragment reads any buffer.
//!include lib/faced.wgsl
//!include lib/adjacency.wgsl

const FRAMES_HERE: u32 = 0u;
const FRAMES_FETCHED: u32 = 1u;
// Whether the vertex stage makes the frames or fetches those of face_frames.wgsl.
override FRAMES: u32 = 0u;

struct HatchOut {
    @builtin(position) clip: vec4f,
    @location(0) p_world: vec3f,
    @location(1) normal: vec3f,
    // (s, t) in the frame of the face and of its three neighbours.
    @location(2) st_ab: vec4f,
    @location(3) st_cd: vec4f,
    // Contributions of the neighbours, before they are clamped.
    @location(4) contributions: vec3f,
    // Normals of the four faces and shares of their frames, as FaceFrame has them.
    @location(5) @interpolate(flat, either) normals_oct: vec4u,
    @location(6) @interpolate(flat, either) shares: vec4u,
}

// A point in the frame of a face.
struct Hatch {
    st: vec2f,
    normal_oct: u32,
    shares: u32,
}

fn corner_world(index: u32) -> vec3f {
    return (scene.world_from_mesh * vec4f(vertices[index].position, 1.0)).xyz;
}

fn hatch(face: u32, p: vec3f) -> Hatch {
    if FRAMES == FRAMES_FETCHED {
        let frame = face_frames[face];
        return Hatch(frame_st(frame, p), frame.normal_oct, frame.shares);
    }
    let a = corner_world(indices[3u * face]);
    let b = corner_world(indices[3u * face + 1u]);
    let c = corner_world(indices[3u * face + 2u]);
    let area = cross(b - a, c - a);
    let n = area * inverseSqrt(max(dot(area, area), 1e-36));
    let frame = frame_hardened(n, (a + b + c) / 3.0);
    let normal_oct = select(NO_NORMAL, oct_encode(n), dot(area, area) > 1e-36);
    return Hatch(vec2f(dot(p, frame.tangent), dot(p, frame.bitangent)), normal_oct, pack_shares(frame.shares));
}

@vertex
fn vertex_face(@builtin(vertex_index) index: u32) -> HatchOut {
    let face = face_of(index);
    let corner = index % 3u;
    let surface = surface_vertex(pulled_vertex(index), vec2f(0.0));
    let p = surface.p_world;
    var out: HatchOut;
    out.clip = surface.clip;
    out.p_world = p;
    out.normal = surface.normal;
    let own = hatch(face, p);
    let n = oct_decode(own.normal_oct);
    var st: array<vec2f, 3>;
    for (var k = 0u; k < 3u; k++) {
        let other = neighbours[3u * face + k];
        st[k] = vec2f(0.0);
        out.contributions[k] = -1.0;
        if other != NO_FACE {
            let theirs = hatch(other, p);
            st[k] = theirs.st;
            out.normals_oct[k + 1u] = theirs.normal_oct;
            out.shares[k + 1u] = theirs.shares;
            if corner != (k + 2u) % 3u && own.normal_oct != NO_NORMAL && theirs.normal_oct != NO_NORMAL {
                out.contributions[k] = dot(n, oct_decode(theirs.normal_oct));
            }
        }
    }
    out.normals_oct[0] = own.normal_oct;
    out.shares[0] = own.shares;
    out.st_ab = vec4f(own.st, st[0]);
    out.st_cd = vec4f(st[1], st[2]);
    return out;
}

// Ink of one face of the four.
fn hatch_ink(point: Point, hatch: Hatch, level: f32, front: bool) -> f32 {
    let n = oct_decode(hatch.normal_oct);
    let patterns = frame_patterns(point.p_world, hatch.st, n, unpack_shares(hatch.shares));
    return contributed_ink(point, select(-n, n, front), patterns, level);
}

@fragment
fn fragment(in: HatchOut, @builtin(front_facing) front: bool) -> @location(0) vec4f {
    var point: Point;
    point.p_world = in.p_world;
    point.normal = normalize(in.normal);
    let towards = to_camera(in.p_world);
    point.view = normalize(towards);
    point.depth = -dot(towards, scene.camera_forward);
    let level = map_level(footprint(point));
    var sum = hatch_ink(point, Hatch(in.st_ab.xy, in.normals_oct.x, in.shares.x), level, front);
    var weight = 1.0;
    let f = max(in.contributions, vec3f(0.0));
    if f.x > 0.0 {
        sum += f.x * hatch_ink(point, Hatch(in.st_ab.zw, in.normals_oct.y, in.shares.y), level, front);
        weight += f.x;
    }
    if f.y > 0.0 {
        sum += f.y * hatch_ink(point, Hatch(in.st_cd.xy, in.normals_oct.z, in.shares.z), level, front);
        weight += f.y;
    }
    if f.z > 0.0 {
        sum += f.z * hatch_ink(point, Hatch(in.st_cd.zw, in.normals_oct.w, in.shares.w), level, front);
        weight += f.z;
    }
    return drawn(sum / weight);
}
