// The vertex stage of all methods that shade per fragment, and what their fragments know.
//!include lib/scene.wgsl
//!include lib/octahedral.wgsl
//!include lib/material.wgsl

// A vertex as it stands in its buffer.
struct VertexIn {
    @location(0) position: vec3f,
    // Octahedral, two 16-bit snorm.
    @location(1) normal_oct: u32,
}

struct VertexOut {
    @builtin(position) clip: vec4f,
    @location(0) p_world: vec3f,
    @location(1) normal: vec3f,
    @location(2) uv: vec2f,
}

struct FragmentIn {
    @location(0) p_world: vec3f,
    @location(1) normal: vec3f,
    @location(2) uv: vec2f,
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
    // There: shares and normal of the frame, as FaceFrame has them.
    framing: vec2u,
}

fn surface_vertex(in: VertexIn, uv: vec2f) -> VertexOut {
    let p = scene.world_from_mesh * vec4f(in.position, 1.0);
    let normal = (scene.world_from_mesh_normal * vec4f(oct_decode(in.normal_oct), 0.0)).xyz;
    return VertexOut(scene.clip_from_world * p, p.xyz, normal, uv);
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
    return point;
}

// Paper, material and ink, mixed in linear light.
fn drawn(ink: f32) -> vec4f {
    let under = scene.paper.rgb * material.colour.rgb;
    return vec4f(mix(under, scene.ink.rgb, ink), 1.0);
}
