// What every pass is told once per frame: camera, lights and colours.

const LIGHT_DIRECTIONAL: u32 = 0u;
const LIGHT_POSITIONAL: u32 = 1u;
const LIGHT_SPOT: u32 = 2u;
const MAX_LIGHTS: u32 = 8u;

struct Light {
    position: vec3f,
    kind: u32,
    // Unit, from the light into the scene.
    direction: vec3f,
    cos_cutoff: f32,
    intensity: f32,
    exponent: f32,
    _pad: vec2f,
}

struct Scene {
    clip_from_world: mat4x4f,
    world_from_mesh: mat4x4f,
    mesh_from_world: mat4x4f,
    // The cofactor matrix of world_from_mesh: turns normals rightly under any scale.
    world_from_mesh_normal: mat4x4f,
    camera_world: vec3f,
    // Side of a pixel in world units at distance 1.
    pixel_world_at_1: f32,
    camera_forward: vec3f,
    light_count: u32,
    viewport_px: vec2f,
    ambient: f32,
    // Distance of the camera's target where its lines of sight are parallel; 0 where they meet in its place.
    parallel_from: f32,
    // Linear light, alpha is the background's.
    paper: vec4f,
    ink: vec4f,
    lights: array<Light, 8>,
}

@group(0) @binding(0) var<uniform> scene: Scene;

// From a point towards the camera; its length along the camera's axis is the depth at which pixels have the size that
// they have there.
fn to_camera(p_world: vec3f) -> vec3f {
    return select(scene.camera_world - p_world, -scene.parallel_from * scene.camera_forward, scene.parallel_from > 0.0);
}
