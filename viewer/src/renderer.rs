//! The renderer: owns the device and what all frames share.

use std::sync::Arc;

use tam_shaders::types;

use crate::gpu::{
    Gpu, GpuError, GpuMap, GpuMesh, Layouts, MapError, MapKind, MapTextures, PixelFormat, SurfaceBuffers, Target,
};
use crate::maps::HatchMap;
use crate::mesh::Mesh;
use crate::params::{Follow, Mapping, Method, RenderParams};
use crate::passes::{Faces, Lines, Shading, Variant, variant};
use crate::scene::{Material, Scene};
use crate::surface::Surface;

/// Parts of a mesh that have materials of their own; parts beyond share the last.
pub const MAX_PARTS: usize = 256;

/// Distance of materials in their buffer, which dynamic offsets ask for.
const MATERIAL_STRIDE: u64 = 512;

/// Why a frame cannot be drawn.
#[derive(Debug, thiserror::Error)]
pub enum RenderError {
    /// The device.
    #[error(transparent)]
    Gpu(#[from] GpuError),
    /// The map.
    #[error(transparent)]
    Map(#[from] MapError),
    /// There is no map.
    #[error("no map was given")]
    NoMap,
    /// The mapping needs what the mesh has not.
    #[error("the mesh has no uv; triplanar and frames need none")]
    NoUv,
    /// The mapping needs a surface that was not attached.
    #[error("the mesh has no {0} surface; attach one first")]
    NoSurface(&'static str),
    /// The placement of the mesh cannot be inverted, or holds no numbers.
    #[error("the placement of the mesh cannot be inverted")]
    Placement,
    /// The camera stands nowhere.
    #[error("the camera is no camera: {0}")]
    Camera(String),
}

/// Draws scenes on a device.
pub struct Renderer {
    /// The device.
    pub gpu: Gpu,
    pub(crate) layouts: Layouts,
    pub(crate) scene_buffer: wgpu::Buffer,
    pub(crate) scene_group: wgpu::BindGroup,
    pub(crate) materials: wgpu::Buffer,
    pub(crate) faces: Faces,
    pub(crate) shading: Shading,
    pub(crate) lines: Lines,
    staging: Vec<u8>,
    turns: Vec<[f32; 4]>,
}

/// What a frame needs beside its scene, found before anything is recorded.
pub(crate) struct Prepared {
    pub scene: types::Scene,
    pub variant: Variant,
    /// By part.
    pub maps: Vec<Arc<MapTextures>>,
}

impl Renderer {
    /// A renderer on this device.
    pub fn new(gpu: Gpu) -> Self {
        let layouts = Layouts::new(&gpu);
        let uniform = |label, size| {
            gpu.device.create_buffer(&wgpu::BufferDescriptor {
                label: Some(label),
                size,
                usage: wgpu::BufferUsages::UNIFORM | wgpu::BufferUsages::COPY_DST,
                mapped_at_creation: false,
            })
        };
        let scene_buffer = uniform("scene", size_of::<types::Scene>() as u64);
        let scene_group = gpu.device.create_bind_group(&wgpu::BindGroupDescriptor {
            label: Some("scene"),
            layout: &layouts.scene,
            entries: &[wgpu::BindGroupEntry { binding: 0, resource: scene_buffer.as_entire_binding() }],
        });
        Self {
            materials: uniform("materials", MATERIAL_STRIDE * MAX_PARTS as u64),
            faces: Faces::new(&gpu, &layouts),
            shading: Shading::default(),
            lines: Lines::new(&gpu, &layouts),
            staging: Vec::new(),
            turns: Vec::new(),
            layouts,
            scene_buffer,
            scene_group,
            gpu,
        }
    }

    /// Uploads a mesh.
    ///
    /// # Errors
    /// [`GpuError::TooLarge`] if it exceeds what the adapter binds.
    pub fn mesh(&self, mesh: &Mesh) -> Result<GpuMesh, GpuError> {
        let gpu_mesh = GpuMesh::new(&self.gpu, &self.layouts, &self.lines.styles, mesh)?;
        self.gpu.check()?;
        Ok(gpu_mesh)
    }

    /// Gives a mesh its surface, which mappings by patches and stripes draw with. It replaces the one before.
    ///
    /// # Errors
    /// [`GpuError::TooLarge`] if it exceeds what the adapter binds.
    ///
    /// # Panics
    /// If the surface is that of another mesh.
    pub fn attach(&self, mesh: &mut GpuMesh, surface: &Surface) -> Result<(), GpuError> {
        assert_eq!(surface.graph.triangles.len(), mesh.triangle_count as usize, "a surface of this mesh");
        mesh.surface = SurfaceBuffers::new(&self.gpu, &self.layouts, Some(surface))?;
        self.gpu.check()
    }

    /// Takes a map; it is uploaded when a method first draws with it.
    pub fn map(&self, map: impl Into<Arc<HatchMap>>) -> GpuMap {
        GpuMap::new(map.into())
    }

    /// A target to draw into.
    ///
    /// # Errors
    /// See [`Target::new`].
    pub fn target(&self, size: [u32; 2], samples: u32, format: PixelFormat) -> Result<Target, GpuError> {
        let target = Target::new(&self.gpu, size, samples, format)?;
        self.gpu.check()?;
        Ok(target)
    }

    /// Checks what a frame needs, uploads what is missing, and writes its uniforms.
    pub(crate) fn prepare(
        &mut self,
        scene: &Scene,
        params: &RenderParams,
        mesh: &GpuMesh,
        maps: &[&GpuMap],
        size_px: [u32; 2],
    ) -> Result<Prepared, RenderError> {
        check_scene(scene)?;
        // Debug views show what is lacking instead.
        if params.debug.is_none() {
            check_surface(params, mesh)?;
        }
        let variant = variant(params, mesh);
        let shared = scene.shared(size_px, mesh.radius());
        self.gpu.queue.write_buffer(&self.scene_buffer, 0, bytemuck::bytes_of(&shared));
        if follows_light(params) && mesh.surface.follow(params.mapping) == Some(Follow::Light) {
            mesh.surface.turn(&self.gpu, &shared, scene.world_from_mesh, &mut self.turns);
        }
        let mut of_parts = Vec::with_capacity(mesh.parts.len());
        self.staging.clear();
        for (part, triangles) in mesh.parts.iter().enumerate() {
            let material = scene.material(part);
            let map = maps.get(material.map).or(maps.first()).ok_or(RenderError::NoMap)?;
            let textures = map.textures(&self.gpu, &self.layouts, &self.materials, variant.kind)?;
            let offset = part.min(MAX_PARTS - 1) * MATERIAL_STRIDE as usize;
            self.staging.resize(offset, 0);
            let shared = material_of(&material, params, mesh, &textures, variant.kind, triangles.start);
            self.staging.extend_from_slice(bytemuck::bytes_of(&shared));
            of_parts.push(textures);
        }
        self.gpu.queue.write_buffer(&self.materials, 0, &self.staging);
        self.lines.prepare(&self.gpu, params, scene.ink);
        Ok(Prepared { scene: shared, variant, maps: of_parts })
    }

    /// Offset of a part's material.
    pub(crate) fn material_offset(part: usize) -> u32 {
        (part.min(MAX_PARTS - 1) * MATERIAL_STRIDE as usize) as u32
    }
}

fn check_scene(scene: &Scene) -> Result<(), RenderError> {
    let m = scene.world_from_mesh;
    let volume = m.determinant();
    if !m.is_finite() || !volume.is_finite() || volume == 0.0 {
        return Err(RenderError::Placement);
    }
    let camera = &scene.camera;
    let numbers = [camera.azimuth_deg, camera.elevation_deg, camera.distance, camera.field_of_view_deg];
    if !numbers.iter().all(|number| number.is_finite()) || !camera.target.is_finite() || camera.distance <= 0.0 {
        return Err(RenderError::Camera(format!("{camera:?}")));
    }
    if !(1.0..=150.0).contains(&camera.field_of_view_deg) {
        return Err(RenderError::Camera(format!("an opening of {} degrees", camera.field_of_view_deg)));
    }
    Ok(())
}

fn follows_light(params: &RenderParams) -> bool {
    params.method.takes_mapping() && params.mapping == Mapping::Patches && params.follow == Follow::Light
}

/// Whether the mesh has what the method draws its strokes by.
fn check_surface(params: &RenderParams, mesh: &GpuMesh) -> Result<(), RenderError> {
    let mapped = params.method.takes_mapping();
    if mapped && params.mapping == Mapping::Uv && mesh.uv_density.is_none() {
        return Err(RenderError::NoUv);
    }
    if mapped && params.mapping.takes_surface() && mesh.surface.tiles_per_unit(params.mapping).is_none() {
        return Err(RenderError::NoSurface(params.mapping.name()));
    }
    if follows_light(params) && mesh.surface.follow(params.mapping) != Some(Follow::Light) {
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

fn material_of(
    material: &Material,
    params: &RenderParams,
    mesh: &GpuMesh,
    map: &MapTextures,
    kind: MapKind,
    first_face: u32,
) -> types::Material {
    let tile_scale = material.scale * tiles_per_surface_unit(params, mesh);
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
        first_face,
        slope: params.slope as f32,
        line_period_px: params.line_period_px as f32,
        distribution_entries: if kind == MapKind::Strokes { map.distribution_entries as f32 } else { 0.0 },
        cross_from: params.cross_from.filter(|_| mesh.surface.has_crossing_stripes()).unwrap_or(1.0) as f32,
        variety: params.variety as f32,
        _pad_a: 0.0,
        _pad_b: 0.0,
        _pad_c: 0.0,
        tones,
    }
}

/// Tiles per unit of what the mapping measures in: world units, or the mesh's uv, which are repeated a whole number of
/// times, so that closed uv stay closed.
fn tiles_per_surface_unit(params: &RenderParams, mesh: &GpuMesh) -> f64 {
    let by_uv = params.mapping == Mapping::Uv && params.method != Method::FaceFrame;
    match mesh.uv_density {
        Some(density) if by_uv => (params.tiles_per_unit / density).round().max(1.0),
        _ => params.tiles_per_unit,
    }
}
