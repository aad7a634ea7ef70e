// Light-aligned frames of all faces; runs when light, mesh or placement changes.
// Suarez and others, "GPU real time hatching", 2013, algorithm 1.
//!include lib/scene.wgsl
//!include lib/form.wgsl
//!include lib/mesh_types.wgsl
//!include lib/corners.wgsl
//!include lib/face_frame.wgsl
//!include lib/octahedral.wgsl

@group(1) @binding(3) var<storage, read_write> face_normals: array<vec4f>;
@group(1) @binding(5) var<storage, read_write> face_frames: array<FaceFrame>;

@compute @workgroup_size(64)
fn main(@builtin(global_invocation_id) id: vec3u, @builtin(num_workgroups) groups: vec3u) {
    let face = id.x + id.y * groups.x * 64u;
    if face >= arrayLength(&indices) / 3u {
        return;
    }
    let corners = face_corners(face);
    let normal = face_normals[face];
    let frame = light_frame(normal.xyz, (corners[0] + corners[1] + corners[2]) / 3.0);
    let normal_oct = select(NO_NORMAL, oct_encode(normal.xyz), normal.w > 0.0);
    face_frames[face] =
        FaceFrame(frame.tangent, frame.bitangent.x, frame.bitangent.yz, pack_shares(frame.shares), normal_oct);
}
