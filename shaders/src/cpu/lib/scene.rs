//! Twin of `lib/scene.wgsl`: what every pass is told once per frame.

use glam::{DMat4, DVec2, DVec3, DVec4, Mat4, Vec2, Vec3, Vec4};

use crate::types;

/// Kind of a light that shines from one direction.
pub const LIGHT_DIRECTIONAL: u32 = 0;
/// Kind of a light that shines from one place to all sides.
pub const LIGHT_POSITIONAL: u32 = 1;
/// Kind of a light that shines from one place within a cone.
pub const LIGHT_SPOT: u32 = 2;

/// One light; fields as in [`types::Light`].
#[derive(Clone, Copy, Debug, PartialEq)]
#[allow(missing_docs)]
pub struct Light {
    pub position: DVec3,
    pub kind: u32,
    pub direction: DVec3,
    pub cos_cutoff: f64,
    pub intensity: f64,
    pub exponent: f64,
}

/// Camera, lights and colours; fields as in [`types::Scene`]. `lights` holds those that count.
#[derive(Clone, Debug, PartialEq)]
#[allow(missing_docs)]
pub struct Scene {
    pub clip_from_world: DMat4,
    pub world_from_mesh: DMat4,
    pub mesh_from_world: DMat4,
    pub world_from_mesh_normal: DMat4,
    pub camera_world: DVec3,
    pub pixel_world_at_1: f64,
    pub camera_forward: DVec3,
    pub viewport_px: DVec2,
    pub ambient: f64,
    pub parallel_from: f64,
    pub paper: DVec4,
    pub ink: DVec4,
    pub lights: Vec<Light>,
}

impl From<&types::Light> for Light {
    fn from(light: &types::Light) -> Self {
        Self {
            position: Vec3::from(light.position).as_dvec3(),
            kind: light.kind,
            direction: Vec3::from(light.direction).as_dvec3(),
            cos_cutoff: light.cos_cutoff.into(),
            intensity: light.intensity.into(),
            exponent: light.exponent.into(),
        }
    }
}

impl Scene {
    /// From a point towards the camera; its length along the camera's axis is the depth at which pixels have the size that
    /// they have there.
    pub fn to_camera(&self, p_world: DVec3) -> DVec3 {
        if self.parallel_from > 0.0 { -self.parallel_from * self.camera_forward } else { self.camera_world - p_world }
    }
}

impl From<&types::Scene> for Scene {
    fn from(scene: &types::Scene) -> Self {
        let matrix = |columns: &[[f32; 4]; 4]| Mat4::from_cols_array_2d(columns).as_dmat4();
        Self {
            clip_from_world: matrix(&scene.clip_from_world),
            world_from_mesh: matrix(&scene.world_from_mesh),
            mesh_from_world: matrix(&scene.mesh_from_world),
            world_from_mesh_normal: matrix(&scene.world_from_mesh_normal),
            camera_world: Vec3::from(scene.camera_world).as_dvec3(),
            pixel_world_at_1: scene.pixel_world_at_1.into(),
            camera_forward: Vec3::from(scene.camera_forward).as_dvec3(),
            viewport_px: Vec2::from(scene.viewport_px).as_dvec2(),
            ambient: scene.ambient.into(),
            parallel_from: scene.parallel_from.into(),
            paper: Vec4::from(scene.paper).as_dvec4(),
            ink: Vec4::from(scene.ink).as_dvec4(),
            lights: scene.lights.iter().take(scene.light_count as usize).map(Light::from).collect(),
        }
    }
}
