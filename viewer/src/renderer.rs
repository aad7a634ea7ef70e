//! The renderer: owns what all frames share, and finds what each needs before anything of it is recorded.

use std::collections::HashMap;
use std::sync::Arc;

use tam_shaders::types;

use crate::gpu::feeds::Fed;
use crate::gpu::{
    Gpu, GpuError, GpuMap, GpuMesh, Layouts, MapError, MapTextures, PixelFormat, PlacedMesh, Target, TargetViews,
    Uniforms,
};
use crate::maps::HatchMap;
use crate::mesh::Mesh;
use crate::object::Object;
use crate::params::Form;
use crate::passes::{Faces, LineKind, Lines, Shading, Variant, variant};
use crate::scene::{Camera, Scene};
use crate::surface::Surface;

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
    /// The device has no storage buffers.
    #[error("{adapter} has no storage buffers, by which lines and the frames of faces are found")]
    NoStorage {
        /// The adapter.
        adapter: String,
    },
    /// What is drawn into takes no such picture.
    #[error("{format:?} cannot be drawn into: on this device it {lacks}")]
    Format {
        /// Its format.
        format: wgpu::TextureFormat,
        /// What it does not do.
        lacks: &'static str,
    },
}

/// Draws scenes on a device.
pub struct Renderer {
    /// The device.
    pub gpu: Gpu,
    pub(crate) layouts: Layouts,
    pub(crate) uniforms: Uniforms,
    pub(crate) faces: Faces,
    pub(crate) shading: Shading,
    pub(crate) lines: Lines,
    turns: Vec<[f32; 4]>,
}

/// An object of a frame, with all that its passes bind.
pub(crate) struct Draw<'a> {
    pub mesh: &'a GpuMesh,
    /// Where its faces are looked at.
    pub placed: Option<Arc<PlacedMesh>>,
    pub form: Form,
    pub variant: Variant,
    /// Number of the pipeline that shades it.
    pub pipeline: usize,
    /// What its vertices carry, and its parts.
    pub fed: Fed<'a>,
    /// View and placement, and their offset.
    pub scene: (types::Scene, u32),
    pub surface: wgpu::BindGroup,
    /// By part: the offset of its material, and its map.
    pub parts: Vec<(u32, Arc<MapTextures>)>,
    /// The lines over it, the uppermost last, with the offsets of their styles.
    pub lines: Vec<(LineKind, u32)>,
}

impl Renderer {
    /// A renderer on this device.
    pub fn new(gpu: Gpu) -> Self {
        let layouts = Layouts::new(&gpu);
        Self {
            uniforms: Uniforms::new(&gpu, &layouts),
            faces: Faces::default(),
            shading: Shading::default(),
            lines: Lines::default(),
            turns: Vec::new(),
            layouts,
            gpu,
        }
    }

    /// Uploads a mesh.
    ///
    /// # Errors
    /// [`GpuError::TooLarge`] if it exceeds what the adapter binds.
    pub fn mesh(&self, mesh: &Mesh) -> Result<GpuMesh, GpuError> {
        let gpu_mesh = GpuMesh::new(&self.gpu, &self.layouts, mesh)?;
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
        assert_eq!(surface.graph.triangles.len(), mesh.triangle_count() as usize, "a surface of this mesh");
        mesh.attach(&self.gpu, &self.layouts, surface)?;
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

    /// Checks what a frame needs, uploads what is missing, and writes its records: the objects, those that one pipeline
    /// shades behind each other.
    pub(crate) fn prepare<'a>(
        &mut self,
        scene: &Scene,
        objects: &[Object<'a>],
        maps: &[&GpuMap],
        into: &TargetViews<'_>,
    ) -> Result<Vec<Draw<'a>>, RenderError> {
        check_camera(&scene.camera)?;
        objects.iter().try_for_each(|object| object.check(&scene.inspect))?;
        let with_lines = objects.iter().any(|object| Lines::drawn(object.params, &scene.inspect).next().is_some());
        into.formats.check(&self.gpu, with_lines)?;
        let radius = objects.iter().map(|object| scene.radius_with(object.world_from_mesh, object.mesh.radius()));
        let radius = radius.fold(0.0, f64::max);
        // The how manieth of its mesh an object is.
        let mut of_mesh: HashMap<*const GpuMesh, usize> = HashMap::new();
        self.uniforms.clear();
        let mut draws = Vec::with_capacity(objects.len());
        for object in objects {
            let count = of_mesh.entry(std::ptr::from_ref(object.mesh)).or_default();
            let nth = std::mem::replace(count, *count + 1);
            draws.push(self.draw(scene, object, nth, maps, into, radius)?);
        }
        draws.sort_by_key(|draw| draw.pipeline);
        self.uniforms.write(&self.gpu, &self.layouts);
        Ok(draws)
    }

    fn draw<'a>(
        &mut self,
        scene: &Scene,
        object: &Object<'a>,
        nth: usize,
        maps: &[&GpuMap],
        into: &TargetViews<'_>,
        radius: f64,
    ) -> Result<Draw<'a>, RenderError> {
        let Self { gpu, layouts, uniforms, faces, shading, lines, turns } = self;
        let Object { mesh, world_from_mesh, params, ink, .. } = *object;
        let variant = variant(params, scene.inspect.debug, mesh);
        if !gpu.has_storage() && (variant.feed.is_pulled() || Lines::drawn(params, &scene.inspect).next().is_some()) {
            return Err(RenderError::NoStorage { adapter: gpu.adapter.to_string() });
        }
        let shared = scene.shared_for(world_from_mesh, ink, into.size_px, radius);
        if object.turns() {
            mesh.surface.turn(gpu, layouts, &shared, world_from_mesh, nth, turns);
        }
        let mut parts = Vec::with_capacity(mesh.parts.len());
        for part in 0..mesh.parts.len() {
            let map = maps.get(object.material(part).map).or(maps.first()).ok_or(RenderError::NoMap)?;
            let textures = map.textures(gpu, layouts, variant.kind)?;
            let offset = uniforms.material(&object.shared_material(part, &textures, variant.kind));
            parts.push((offset, textures));
        }
        // Back faces of a closed mesh are never seen from outside.
        let culled = mesh.closed && world_from_mesh.determinant() > 0.0;
        let mapping = params.needed_mapping().unwrap_or(params.mapping);
        let inspect = &scene.inspect;
        let styled = |kind: LineKind| (kind, uniforms.style(&kind.style(params, inspect, ink)));
        let styled: Vec<_> = Lines::drawn(params, inspect).map(styled).collect();
        if !styled.is_empty() {
            lines.make(gpu, layouts, into.formats);
        }
        let looks_at_faces = variant.feed.is_pulled() || !styled.is_empty();
        if looks_at_faces {
            faces.make(gpu, layouts);
        }
        let fed = mesh.fed(variant.feed, mapping).ok_or(RenderError::NoSurface(params.method.name()))?;
        Ok(Draw {
            mesh,
            fed,
            placed: looks_at_faces.then(|| mesh.placed(gpu, layouts, nth, variant.faces)),
            form: params.form,
            pipeline: shading.pipeline(gpu, layouts, &variant, into.formats, culled),
            variant,
            scene: (shared, uniforms.scene(&shared)),
            surface: mesh.surface.group(gpu, layouts, object.turns(), nth),
            parts,
            lines: styled,
        })
    }
}

fn check_camera(camera: &Camera) -> Result<(), RenderError> {
    let numbers =
        [camera.azimuth_deg, camera.elevation_deg, camera.distance, camera.field_of_view_deg, camera.roll_deg];
    if !numbers.iter().all(|number| number.is_finite()) || !camera.target.is_finite() || camera.distance <= 0.0 {
        return Err(RenderError::Camera(format!("{camera:?}")));
    }
    if !(1.0..=150.0).contains(&camera.field_of_view_deg) {
        return Err(RenderError::Camera(format!("an opening of {} degrees", camera.field_of_view_deg)));
    }
    Ok(())
}
