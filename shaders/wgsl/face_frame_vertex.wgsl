// Light-aligned frames per face with the work in the vertex stage, as the paper's geometry stage does it: three
// vertices per face, each with its own parameters for the four faces. Suarez and others, "GPU real time hatching",
// 2013, algorithms 1 to 3. Kept to be measured against face_frame.wgsl.
//!include lib/surface.wgsl
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
    @location(5) @interpolate(flat, either) normals_oct: vec4u,
}

struct Hatch {
    st: vec2f,
    normal: vec4f,
}

fn corner_world(index: u32) -> vec3f {
    return (scene.world_from_mesh * vec4f(vertices[index].position, 1.0)).xyz;
}

fn hatch(face: u32, p: vec3f) -> Hatch {
    if FRAMES == FRAMES_FETCHED {
        let frame = face_frames[face];
        let bitangent = vec3f(frame.bitangent_x, frame.bitangent_yz);
        return Hatch(vec2f(dot(p, frame.tangent), dot(p, bitangent)), face_normals[face]);
    }
    let a = corner_world(indices[3u * face]);
    let b = corner_world(indices[3u * face + 1u]);
    let c = corner_world(indices[3u * face + 2u]);
    let area = cross(b - a, c - a);
    let n = area * inverseSqrt(max(dot(area, area), 1e-36));
    let frame = frame_hardened(n, (a + b + c) / 3.0);
    let valid = select(0.0, 1.0, dot(area, area) > 1e-36);
    return Hatch(vec2f(dot(p, frame.tangent), dot(p, frame.bitangent)), vec4f(n, valid));
}

@vertex
fn vertex(@builtin(vertex_index) index: u32) -> HatchOut {
    let face = index / 3u + material.first_face;
    let corner = index % 3u;
    let vertex = vertices[indices[3u * face + corner]];
    let p = scene.world_from_mesh * vec4f(vertex.position, 1.0);
    var out: HatchOut;
    out.clip = scene.clip_from_world * p;
    out.p_world = p.xyz;
    out.normal = (scene.world_from_mesh_normal * vec4f(oct_decode(vertex.normal_oct), 0.0)).xyz;
    let own = hatch(face, p.xyz);
    var st: array<vec2f, 3>;
    for (var k = 0u; k < 3u; k++) {
        let other = neighbours[3u * face + k];
        st[k] = vec2f(0.0);
        out.contributions[k] = -1.0;
        if other != NO_FACE {
            let theirs = hatch(other, p.xyz);
            st[k] = theirs.st;
            out.normals_oct[k + 1u] = oct_encode(theirs.normal.xyz);
            if corner != (k + 2u) % 3u {
                out.contributions[k] = select(-1.0, dot(own.normal.xyz, theirs.normal.xyz), theirs.normal.w > 0.0);
            }
        }
    }
    out.normals_oct[0] = oct_encode(own.normal.xyz);
    out.st_ab = vec4f(own.st, st[0]);
    out.st_cd = vec4f(st[1], st[2]);
    return out;
}

fn hatch_ink(point: Point, normal_oct: u32, st: vec2f, level: f32, front: bool) -> f32 {
    let n = oct_decode(normal_oct);
    let d = darkness(reflectance(), point.p_world, select(-n, n, front), point.view);
    return column_ink(tile_uv(st), level, column_coordinate(d));
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
    var sum = hatch_ink(point, in.normals_oct.x, in.st_ab.xy, level, front);
    var weight = 1.0;
    let f = max(in.contributions, vec3f(0.0));
    if f.x > 0.0 {
        sum += f.x * hatch_ink(point, in.normals_oct.y, in.st_ab.zw, level, front);
        weight += f.x;
    }
    if f.y > 0.0 {
        sum += f.y * hatch_ink(point, in.normals_oct.z, in.st_cd.xy, level, front);
        weight += f.y;
    }
    if f.z > 0.0 {
        sum += f.z * hatch_ink(point, in.normals_oct.w, in.st_cd.zw, level, front);
        weight += f.z;
    }
    return drawn(sum / weight);
}
