// The vertex stage of all methods that shade per fragment, and what their fragments know.
//!include lib/scene.wgsl
//!include lib/mesh.wgsl
//!include lib/octahedral.wgsl
//!include lib/material.wgsl

struct VertexOut {
    @builtin(position) clip: vec4f,
    @location(0) p_world: vec3f,
    @location(1) normal: vec3f,
    @location(2) uv: vec2f,
//!if flat_face
    @location(3) @interpolate(flat, first) face: u32,
//!end
}

struct FragmentIn {
    @location(0) p_world: vec3f,
    @location(1) normal: vec3f,
    @location(2) uv: vec2f,
//!if flat_face
    @location(3) @interpolate(flat, first) face: u32,
//!else
    @builtin(primitive_index) primitive: u32,
//!end
}

fn face_of(in: FragmentIn) -> u32 {
//!if flat_face
    return in.face;
//!else
    return in.primitive + material.first_face;
//!end
}

// A surface point, as a fragment sees it.
struct Point {
    p_world: vec3f,
    // Unit: the smooth normal, towards the side that is seen.
    normal: vec3f,
    // Unit, towards the camera.
    view: vec3f,
    // Distance along the camera's axis.
    depth: f32,
    // The mesh's own; in the mapping by frames the place in the frame.
    uv: vec2f,
    face: u32,
    // There: shares and normal of the frame, as FaceFrame has them.
    framing: vec2u,
}

// A vertex of the mesh, by its own number.
fn mesh_vertex(v: u32) -> VertexOut {
    var out: VertexOut;
    let vertex = vertices[v];
    let p = scene.world_from_mesh * vec4f(vertex.position, 1.0);
    out.clip = scene.clip_from_world * p;
    out.p_world = p.xyz;
    out.normal = (scene.world_from_mesh_normal * vec4f(oct_decode(vertex.normal_oct), 0.0)).xyz;
    out.uv = uvs[min(v, arrayLength(&uvs) - 1u)];
    return out;
}

fn surface_vertex(index: u32) -> VertexOut {
//!if flat_face
    var out = mesh_vertex(provoking[index]);
    out.face = index;
    return out;
//!else
    return mesh_vertex(index);
//!end
}

fn surface_point(in: FragmentIn, front: bool) -> Point {
    var point: Point;
    point.p_world = in.p_world;
    let n = in.normal * inverseSqrt(max(dot(in.normal, in.normal), 1e-20));
    point.normal = select(-n, n, front);
    let towards = to_camera(in.p_world);
    point.view = towards * inverseSqrt(max(dot(towards, towards), 1e-20));
    point.depth = max(-dot(towards, scene.camera_forward), 1e-6);
    point.uv = in.uv;
    point.face = face_of(in);
    return point;
}

// Paper, material and ink, mixed in linear light.
fn drawn(ink: f32) -> vec4f {
    let under = scene.paper.rgb * material.colour.rgb;
    return vec4f(mix(under, scene.ink.rgb, ink), 1.0);
}
