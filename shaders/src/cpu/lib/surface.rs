//! Twin of `lib/surface.wgsl`: the vertex stage of all methods that shade per fragment, and what their fragments know.

use glam::{DVec2, DVec3, DVec4};

use super::material::Material;
use super::mesh_types::Vertex;
use super::octahedral::oct_decode;
use super::patches::Overlap;
use super::scene::Scene;
use crate::cpu::builtin::inverse_sqrt;

/// What the vertex stage hands on.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct VertexOut {
    /// Clip coordinates.
    pub clip: DVec4,
    /// Place in the world.
    pub p_world: DVec3,
    /// Smooth normal in the world, not unit.
    pub normal: DVec3,
    /// The mesh's own coordinates.
    pub uv: DVec2,
}

/// What a fragment gets, interpolated.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct FragmentIn {
    /// Place in the world.
    pub p_world: DVec3,
    /// Smooth normal in the world, not unit.
    pub normal: DVec3,
    /// The mesh's own coordinates, the place in a frame, or phases of lines.
    pub uv: DVec2,
    /// The patches that overlap here, for passes that draw on them.
    pub overlap: Overlap,
    /// Of lapped textures those that are painted over these.
    pub over: Overlap,
    /// Of passes whose tone is that of the vertices.
    pub tone: f64,
    /// Where lines end: weights of a side's corners, and windings of both phases.
    pub ring: DVec4,
    /// Rows of lines on the patches; the same for all corners of a triangle.
    pub rows: [u32; 4],
    /// Triangle of the mesh, for passes that are told.
    pub face: u32,
}

/// A surface point, as a fragment sees it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Point {
    /// Place in the world.
    pub p_world: DVec3,
    /// Unit: the smooth normal, towards the side that is seen.
    pub normal: DVec3,
    /// Unit, towards the camera.
    pub view: DVec3,
    /// Distance along the camera's axis.
    pub depth: f64,
    /// The mesh's own coordinates; in the mapping by frames the place in the frame.
    pub uv: DVec2,
    /// There: shares and normal of the frame, as `FaceFrame` has them.
    pub framing: [u32; 2],
}

/// A vertex on its way to the screen.
pub fn surface_vertex(scene: &Scene, vertex: &Vertex, uv: DVec2) -> VertexOut {
    let p = scene.world_from_mesh * vertex.position.extend(1.0);
    VertexOut {
        clip: scene.clip_from_world * p,
        p_world: p.truncate(),
        normal: (scene.world_from_mesh_normal * oct_decode(vertex.normal_oct).extend(0.0)).truncate(),
        uv,
    }
}

/// A fragment's surface point; `front`: its front is seen.
pub fn surface_point(scene: &Scene, input: &FragmentIn, front: bool) -> Point {
    let n = input.normal * inverse_sqrt(input.normal.dot(input.normal).max(1e-20));
    let to_camera = scene.to_camera(input.p_world);
    Point {
        p_world: input.p_world,
        normal: if front { n } else { -n },
        view: to_camera * inverse_sqrt(to_camera.dot(to_camera).max(1e-20)),
        depth: (-to_camera.dot(scene.camera_forward)).max(1e-6),
        uv: input.uv,
        framing: [0; 2],
    }
}

/// Paper, material and ink, mixed in linear light.
pub fn drawn(scene: &Scene, material: &Material, ink: f64) -> DVec4 {
    let under = scene.paper.truncate() * material.colour.truncate();
    under.lerp(scene.ink.truncate(), ink).extend(1.0)
}
