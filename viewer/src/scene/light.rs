//! Lights, and the rule for several of them.
//!
//! Tone: the luminances of all lights and of the ambient light are added and clamped at 1; darkness is what is missing
//! to 1. Direction: strokes that follow the light run along the dominant direction of the weighted light tensor, the sum
//! of the lights' projections on the surface, each squared and weighted by what arrives of it.

use glam::{DMat4, DVec3};
use tam_shaders::types;

/// Lights of a scene, at most.
pub const MAX_LIGHTS: usize = types::MAX_LIGHTS;

/// What a light is.
#[derive(Clone, Copy, Debug, PartialEq, serde::Serialize, serde::Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum LightKind {
    /// From infinitely far.
    Directional {
        /// From the light into the scene; any length but 0.
        direction: DVec3,
    },
    /// From a point to all sides.
    Positional {
        /// In world units.
        position: DVec3,
    },
    /// From a point into a cone.
    Spot {
        /// In world units.
        position: DVec3,
        /// The axis of the cone; any length but 0.
        direction: DVec3,
        /// Angle from the axis beyond which there is no light, 0..=90 degrees.
        cutoff_deg: f64,
        /// Power of the cosine from the axis, >= 0: 0 is an even disc.
        exponent: f64,
    },
}

/// A light.
#[derive(Clone, Copy, Debug, PartialEq, serde::Serialize, serde::Deserialize)]
pub struct Light {
    /// Where it comes from.
    pub kind: LightKind,
    /// Luminance that it gives a white surface facing it, >= 0.
    pub intensity: f64,
}

impl Light {
    /// A directional light of intensity 1 from an azimuth and an elevation, counted as the camera's.
    pub fn from_angles(azimuth_deg: f64, elevation_deg: f64) -> Self {
        let (azimuth, elevation) = (azimuth_deg.to_radians(), elevation_deg.to_radians());
        let to_light = DVec3::new(azimuth.sin() * elevation.cos(), elevation.sin(), azimuth.cos() * elevation.cos());
        Self { kind: LightKind::Directional { direction: -to_light }, intensity: 1.0 }
    }

    /// A light at a point, of intensity 1.
    pub fn at(position: DVec3) -> Self {
        Self { kind: LightKind::Positional { position }, intensity: 1.0 }
    }

    /// As the shaders read it.
    pub(crate) fn shared(&self) -> types::Light {
        let mut shared = types::Light { intensity: self.intensity as f32, cos_cutoff: -1.0, ..types::Light::default() };
        match self.kind {
            LightKind::Directional { direction } => shared.direction = unit(direction),
            LightKind::Positional { position } => {
                shared.kind = 1;
                shared.position = position.as_vec3().into();
            }
            LightKind::Spot { position, direction, cutoff_deg, exponent } => {
                shared.kind = 2;
                shared.position = position.as_vec3().into();
                shared.direction = unit(direction);
                shared.cos_cutoff = cutoff_deg.to_radians().cos() as f32;
                shared.exponent = exponent as f32;
            }
        }
        shared
    }
}

fn unit(v: DVec3) -> [f32; 3] {
    v.normalize_or(DVec3::NEG_Y).as_vec3().into()
}

/// All light of a scene.
#[derive(Clone, Debug, PartialEq, serde::Serialize, serde::Deserialize)]
pub struct Lights {
    /// Luminance from everywhere, 0..=1.
    pub ambient: f64,
    /// At most [`MAX_LIGHTS`]; the literal `face-frame` knows the first only.
    pub lights: Vec<Light>,
}

impl Lights {
    /// Towards the first light, in the coordinates of a mesh that stands here.
    pub fn towards_first(&self, world_from_mesh: DMat4) -> DVec3 {
        let to_light = self.lights.first().map_or(DVec3::Y, |light| match light.kind {
            LightKind::Directional { direction } => -direction,
            LightKind::Positional { position } | LightKind::Spot { position, .. } => position,
        });
        world_from_mesh.inverse().transform_vector3(to_light)
    }
}

impl Default for Lights {
    fn default() -> Self {
        Self { ambient: 0.12, lights: vec![Light::from_angles(-40.0, 45.0)] }
    }
}
