// Normals and barycentric planes of all faces; runs when the mesh or its placement changes.
// Suarez and others, "GPU real time hatching", 2013, algorithm 1, first line.
//!include lib/scene.wgsl
//!include lib/form.wgsl
//!include lib/mesh_types.wgsl
//!include lib/corners.wgsl

@group(1) @binding(3) var<storage, read_write> face_normals: array<vec4f>;
@group(1) @binding(4) var<storage, read_write> face_planes: array<vec4f>;

// Twice the area, as a vector, below this times the longest edge squared counts as none.
const LEAST_AREA: f32 = 1e-6;

@compute @workgroup_size(64)
fn main(@builtin(global_invocation_id) id: vec3u, @builtin(num_workgroups) groups: vec3u) {
    let face = id.x + id.y * groups.x * 64u;
    if face >= arrayLength(&indices) / 3u {
        return;
    }
    let corners = face_corners(face);
    let normal = area_vector(corners);
    face_normals[face] = face_normal(corners, normal);
    // They have no room where no pass reads them.
    if 2u * face + 1u >= arrayLength(&face_planes) {
        return;
    }
    let planes = barycentric_planes(corners, normal);
    face_planes[2u * face] = planes[0];
    face_planes[2u * face + 1u] = planes[1];
}

fn face_normal(corners: array<vec3f, 3>, normal: vec3f) -> vec4f {
    if FORM == FORM_LITERAL {
        return vec4f(normalize(normal), 1.0);
    }
    let a = corners[1] - corners[0];
    let b = corners[2] - corners[1];
    let c = corners[0] - corners[2];
    let longest = max(dot(a, a), max(dot(b, b), dot(c, c)));
    let area2 = dot(normal, normal);
    if !(area2 > LEAST_AREA * LEAST_AREA * longest * longest) || !(area2 > 1e-36) {
        return vec4f(0.0, 0.0, 1.0, 0.0);
    }
    return vec4f(normal * inverseSqrt(area2), 1.0);
}

fn barycentric_planes(corners: array<vec3f, 3>, normal: vec3f) -> array<vec4f, 2> {
    let scale = 1.0 / max(dot(normal, normal), 1e-36);
    let first = cross(normal, corners[2] - corners[1]) * scale;
    let second = cross(normal, corners[0] - corners[2]) * scale;
    return array<vec4f, 2>(
        vec4f(first, -dot(first, corners[1])),
        vec4f(second, -dot(second, corners[2])),
    );
}
