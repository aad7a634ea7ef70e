//! What stands in a scene: meshes at their places, each in a look of its own.

use glam::DMat4;
use tam_shaders::cpu::lib::columns::columns_per_tone;
use tam_shaders::types;

use crate::gpu::{GpuMesh, MapKind, MapTextures};
use crate::params::{Follow, Inspect, Mapping, Method, RenderParams};
use crate::renderer::RenderError;
use crate::scene::{Material, Scene, material_of};

/// A mesh at a place, in a look. Objects of one mesh share its upload.
#[derive(Clone, Copy)]
pub struct Object<'a> {
    /// The mesh, with the surface that its look needs.
    pub mesh: &'a GpuMesh,
    /// Placement; any invertible matrix.
    pub world_from_mesh: DMat4,
    /// How strokes and lines are drawn.
    pub params: &'a RenderParams,
    /// Colour of the ink, linear light.
    pub ink: [f32; 3],
    /// One per part of the mesh; the last serves parts beyond it, and the default where there is none.
    pub materials: &'a [Material],
}

impl<'a> Object<'a> {
    /// The mesh of a scene that has one.
    pub fn of(scene: &'a Scene, params: &'a RenderParams, mesh: &'a GpuMesh) -> Self {
        let Scene { world_from_mesh, ink, materials, .. } = scene;
        Self { mesh, world_from_mesh: *world_from_mesh, params, ink: *ink, materials }
    }

    /// The material of a part.
    pub(crate) fn material(&self, part: usize) -> Material {
        material_of(self.materials, part)
    }

    /// Whether patches are to turn with the light.
    pub(crate) fn follows_light(&self) -> bool {
        let params = self.params;
        params.method.takes_mapping() && params.mapping == Mapping::Patches && params.follow == Follow::Light
    }

    /// Whether patches of the mesh do.
    pub(crate) fn turns(&self) -> bool {
        self.follows_light() && self.mesh.surface.follow(self.params.mapping) == Some(Follow::Light)
    }

    /// Whether it has a place, and its mesh what strokes are drawn by. Debug views show what is lacking instead.
    pub(crate) fn check(&self, inspect: &Inspect) -> Result<(), RenderError> {
        let volume = self.world_from_mesh.determinant();
        if !self.world_from_mesh.is_finite() || !volume.is_finite() || volume == 0.0 {
            return Err(RenderError::Placement);
        }
        if inspect.debug.is_none() { self.check_surface() } else { Ok(()) }
    }

    fn check_surface(&self) -> Result<(), RenderError> {
        let Self { params, mesh, .. } = self;
        let mapped = params.method.takes_mapping();
        if mapped && params.mapping == Mapping::Uv && mesh.uv_density.is_none() {
            return Err(RenderError::NoUv);
        }
        if mapped && params.mapping.takes_surface() && mesh.surface.tiles_per_unit(params.mapping).is_none() {
            return Err(RenderError::NoSurface(params.mapping.name()));
        }
        if self.follows_light() && !self.turns() {
            return Err(RenderError::NoSurface("light-following"));
        }
        if params.method == Method::Stripes && !mesh.surface.has_stripes() {
            return Err(RenderError::NoSurface(params.method.name()));
        }
        if params.method == Method::Stripes && params.variety > 0.0 && !mesh.surface.has_rows() {
            return Err(RenderError::NoSurface("stripes and patches"));
        }
        Ok(())
    }

    /// A part's material as the shaders read it.
    pub(crate) fn shared_material(&self, part: usize, map: &MapTextures, kind: MapKind) -> types::Material {
        let Self { params, mesh, .. } = self;
        let material = self.material(part);
        let tile_scale = material.scale * self.tiles_per_surface_unit();
        // Patches are stored in tiles already, those for which they were made.
        let made_for = params.needed_mapping().and_then(|mapping| mesh.surface.tiles_per_unit(mapping));
        let scale = tile_scale / made_for.unwrap_or(1.0);
        let (sin, cos) = material.rotation_deg.to_radians().sin_cos();
        let mut tones = [[0.0; 4]; 17];
        for (k, tone) in map.tones.iter().enumerate() {
            tones[(k + 1) / 4][(k + 1) % 4] = *tone as f32;
        }
        types::Material {
            colour: [material.colour[0], material.colour[1], material.colour[2], 1.0],
            ambient: material.ambient as f32,
            diffuse: material.diffuse as f32,
            specular: material.specular as f32,
            shininess: material.shininess as f32,
            tile_from_surface: [cos * scale, -sin * scale, sin * scale, cos * scale].map(|entry| entry as f32),
            shift_uv: material.shift.as_vec2().into(),
            tile_scale: tile_scale as f32,
            size_px: map.size_px as f32,
            level_count: map.level_count as f32,
            level_bias: params.level_bias as f32,
            column_count: map.tones.len() as u32,
            first_face: mesh.parts[part].start,
            slope: params.slope as f32,
            line_period_px: params.line_period_px as f32,
            distribution_entries: if kind == MapKind::Strokes { map.distribution_entries as f32 } else { 0.0 },
            cross_from: params.cross_from.filter(|_| mesh.surface.has_crossing_stripes()).unwrap_or(1.0) as f32,
            variety: params.variety as f32,
            columns_per_tone: columns_per_tone(&map.tones) as f32,
            _pad_a: 0.0,
            _pad_b: 0.0,
            tones,
        }
    }

    /// Tiles per unit of what the mapping measures in: world units, or the mesh's uv, which are repeated a whole number
    /// of times, so that closed uv stay closed.
    fn tiles_per_surface_unit(&self) -> f64 {
        let params = self.params;
        let by_uv = params.mapping == Mapping::Uv && params.method != Method::FaceFrame;
        match self.mesh.uv_density {
            Some(density) if by_uv => (params.tiles_per_unit / density).round().max(1.0),
            _ => params.tiles_per_unit,
        }
    }
}
