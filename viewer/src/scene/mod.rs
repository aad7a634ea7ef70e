//! What is drawn: camera, lights, colours and materials. The same scene serves every method.

mod camera;
mod light;

use glam::{DMat4, DVec2};
use tam_shaders::types;

pub use camera::{AxisView, Camera, Projection};
pub use light::{Light, LightKind, Lights, MAX_LIGHTS};

use crate::mesh::Mesh;
use crate::params::Inspect;

/// What belongs to a picture as a whole, and the mesh of a picture that shows one.
#[derive(Clone, Debug, PartialEq)]
pub struct Scene {
    /// Where it is seen from.
    pub camera: Camera,
    /// What lights it.
    pub lights: Lights,
    /// Placement of the mesh; any invertible matrix.
    pub world_from_mesh: DMat4,
    /// Colour of the paper, linear light.
    pub paper: [f32; 3],
    /// Colour of the ink, linear light.
    pub ink: [f32; 3],
    /// Leave out the paper around the mesh.
    pub transparent: bool,
    /// What of the drawing itself is shown.
    pub inspect: Inspect,
    /// One per part of the mesh; the last serves parts beyond it.
    pub materials: Vec<Material>,
}

impl Default for Scene {
    fn default() -> Self {
        Self {
            camera: Camera::default(),
            lights: Lights::default(),
            world_from_mesh: DMat4::IDENTITY,
            paper: [1.0; 3],
            ink: [0.0; 3],
            transparent: false,
            inspect: Inspect::default(),
            materials: vec![Material::default()],
        }
    }
}

impl Scene {
    /// A scene with a material for each part of a mesh, coloured as the mesh says.
    pub fn of(mesh: &Mesh) -> Self {
        let materials = mesh.parts.iter().map(|part| Material { colour: part.colour, ..Material::default() }).collect();
        Self { materials, ..Self::default() }
    }

    /// The material of a part.
    pub fn material(&self, part: usize) -> Material {
        material_of(&self.materials, part)
    }

    /// Radius about the camera's target that holds the placed mesh, given the mesh's own.
    pub fn world_radius(&self, mesh_radius: f64) -> f64 {
        self.radius_with(self.world_from_mesh, mesh_radius)
    }

    /// The same for a mesh placed elsewhere.
    pub(crate) fn radius_with(&self, world_from_mesh: DMat4, mesh_radius: f64) -> f64 {
        let m = world_from_mesh;
        let stretch = m.x_axis.length().max(m.y_axis.length()).max(m.z_axis.length());
        m.w_axis.truncate().length() + mesh_radius * stretch + self.camera.target.length()
    }

    /// As the shaders read it.
    pub fn shared(&self, size_px: [u32; 2], mesh_radius: f64) -> types::Scene {
        self.shared_for(self.world_from_mesh, self.ink, size_px, self.world_radius(mesh_radius))
    }

    /// The same for a mesh placed elsewhere, in other ink; `radius` about the camera's target holds all that is drawn.
    pub(crate) fn shared_for(
        &self,
        world_from_mesh: DMat4,
        ink: [f32; 3],
        size_px: [u32; 2],
        radius: f64,
    ) -> types::Scene {
        let m = world_from_mesh;
        let inverse = m.inverse();
        // The cofactor matrix, up to a positive factor.
        let normal = DMat4::from_mat3(glam::DMat3::from_mat4(inverse).transpose() * m.determinant().signum());
        let clip = self.camera.clip_from_world(size_px, radius);
        let mut lights = [types::Light::default(); MAX_LIGHTS];
        for (shared, light) in lights.iter_mut().zip(&self.lights.lights) {
            *shared = light.shared();
        }
        types::Scene {
            clip_from_world: clip.as_mat4().to_cols_array_2d(),
            world_from_mesh: m.as_mat4().to_cols_array_2d(),
            mesh_from_world: inverse.as_mat4().to_cols_array_2d(),
            world_from_mesh_normal: normal.as_mat4().to_cols_array_2d(),
            camera_world: self.camera.place().as_vec3().into(),
            pixel_world_at_1: self.camera.pixel_at_1(size_px[1]) as f32,
            camera_forward: self.camera.forward().as_vec3().into(),
            light_count: self.lights.lights.len().min(MAX_LIGHTS) as u32,
            viewport_px: size_px.map(|side| side as f32),
            ambient: self.lights.ambient as f32,
            parallel_from: match self.camera.projection {
                Projection::Perspective => 0.0,
                Projection::Orthographic => self.camera.distance as f32,
            },
            paper: with_alpha(self.paper),
            ink: with_alpha(ink),
            lights,
        }
    }
}

/// The material of a part; the last serves parts beyond, and the default where there is none.
pub(crate) fn material_of(materials: &[Material], part: usize) -> Material {
    materials.get(part).or(materials.last()).cloned().unwrap_or_default()
}

fn with_alpha(colour: [f32; 3]) -> [f32; 4] {
    [colour[0], colour[1], colour[2], 1.0]
}

/// How an object takes light and strokes. What a stored one does not name is as by default.
#[derive(Clone, Debug, PartialEq, serde::Serialize, serde::Deserialize)]
#[serde(default)]
pub struct Material {
    /// Colour under the strokes, linear light; multiplies the paper's.
    pub colour: [f32; 3],
    /// Share of the ambient light that is seen, 0..=1.
    pub ambient: f64,
    /// Diffuse reflectance, 0..=1.
    pub diffuse: f64,
    /// Strength of the highlight, 0..=1.
    pub specular: f64,
    /// Exponent of the highlight, 1..=1000.
    pub shininess: f64,
    /// Turn of the strokes about the surface normal, in degrees (Suarez 2013, section 4).
    pub rotation_deg: f64,
    /// Repeats of the tile, relative to [`RenderParams::tiles_per_unit`](crate::RenderParams), > 0.
    pub scale: f64,
    /// Shift of the tile, in tiles.
    pub shift: DVec2,
    /// Which of the maps given to the renderer it uses.
    pub map: usize,
}

impl Default for Material {
    fn default() -> Self {
        Self {
            colour: [1.0; 3],
            ambient: 1.0,
            diffuse: 1.0,
            specular: 0.0,
            shininess: 24.0,
            rotation_deg: 0.0,
            scale: 1.0,
            shift: DVec2::ZERO,
            map: 0,
        }
    }
}
