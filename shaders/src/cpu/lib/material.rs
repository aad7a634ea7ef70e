//! Twin of `lib/material.wgsl`: what differs between the objects of a scene. Suarez and others 2013, section 4.

use glam::{DVec2, DVec4, Vec2, Vec4};

use super::light::Reflectance;
use crate::types;

/// Colour, map, and how it lies on the object; fields as in [`types::Material`].
#[derive(Clone, Debug, PartialEq)]
#[allow(missing_docs)]
pub struct Material {
    pub colour: DVec4,
    pub ambient: f64,
    pub diffuse: f64,
    pub specular: f64,
    pub shininess: f64,
    pub tile_from_surface: DVec4,
    pub shift_uv: DVec2,
    pub tile_scale: f64,
    pub size_px: f64,
    pub level_count: f64,
    pub level_bias: f64,
    pub column_count: u32,
    /// Columns to a darkness of 1 where they are evenly spaced; 0: they are not.
    pub columns_per_tone: f64,
    pub first_face: u32,
    pub slope: f64,
    pub line_period_px: f64,
    pub distribution_entries: f64,
    pub cross_from: f64,
    pub variety: f64,
    pub tones: Vec<f64>,
}

impl From<&types::Material> for Material {
    fn from(material: &types::Material) -> Self {
        Self {
            colour: Vec4::from(material.colour).as_dvec4(),
            ambient: material.ambient.into(),
            diffuse: material.diffuse.into(),
            specular: material.specular.into(),
            shininess: material.shininess.into(),
            tile_from_surface: Vec4::from(material.tile_from_surface).as_dvec4(),
            shift_uv: Vec2::from(material.shift_uv).as_dvec2(),
            tile_scale: material.tile_scale.into(),
            size_px: material.size_px.into(),
            level_count: material.level_count.into(),
            level_bias: material.level_bias.into(),
            column_count: material.column_count,
            columns_per_tone: material.columns_per_tone.into(),
            first_face: material.first_face,
            slope: material.slope.into(),
            line_period_px: material.line_period_px.into(),
            distribution_entries: material.distribution_entries.into(),
            cross_from: material.cross_from.into(),
            variety: material.variety.into(),
            tones: material.tones.as_flattened().iter().map(|tone| f64::from(*tone)).collect(),
        }
    }
}

/// Tone of a column; 0 is the implicit white.
pub fn column_tone(material: &Material, k: u32) -> f64 {
    material.tones[k as usize]
}

/// Tile coordinates of surface coordinates.
pub fn tile_uv(material: &Material, st: DVec2) -> DVec2 {
    let m = material.tile_from_surface;
    DVec2::new(DVec2::new(m.x, m.y).dot(st), DVec2::new(m.z, m.w).dot(st)) + material.shift_uv
}

/// The material's answer to light.
pub fn reflectance(material: &Material) -> Reflectance {
    Reflectance {
        ambient: material.ambient,
        diffuse: material.diffuse,
        specular: material.specular,
        shininess: material.shininess,
    }
}
