//! Drawing in tests: on the software adapter, unless `WGPU_ADAPTER_NAME` asks for another.

use glam::Vec3;
use tam_gen::{Job, Preset};
use tam_viewer::gpu::{Gpu, GpuMap, GpuMesh, GpuOptions, PixelFormat};
use tam_viewer::maps::HatchMap;
use tam_viewer::mesh::Mesh;
use tam_viewer::stability;
pub use tam_viewer::stability::{difference, light_from, nan_count};
use tam_viewer::surface::{FieldOptions, StripeOptions, Surface, SurfaceNeeds, SurfaceOptions};
use tam_viewer::{Camera, Light, Lights, Mapping, RenderParams, Renderer, Scene};

/// The adapter that tests run on where nothing else is asked for.
const SOFTWARE: &str = "llvmpipe";

/// A renderer for tests.
///
/// # Panics
/// If there is no adapter: drawing is never skipped silently.
pub fn renderer() -> Renderer {
    let adapter = std::env::var("WGPU_ADAPTER_NAME").unwrap_or_else(|_| SOFTWARE.to_owned());
    match Gpu::open(&GpuOptions { adapter: Some(adapter) }) {
        Ok(gpu) => Renderer::new(gpu),
        Err(error) => {
            panic!("{error}. Tests draw on a software adapter: `apt-get install mesa-vulkan-drivers` brings it.")
        }
    }
}

/// A device for tests, opened with no features and nothing beyond these limits.
///
/// # Panics
/// If there is no adapter, or it has less.
pub fn device_with(limits: wgpu::Limits) -> Gpu {
    let backends = wgpu::Backends::PRIMARY;
    let descriptor = wgpu::InstanceDescriptor { backends, ..wgpu::InstanceDescriptor::new_without_display_handle() };
    let instance = wgpu::Instance::new(descriptor);
    let wanted = wgpu::RequestAdapterOptions::default();
    let opened = pollster::block_on(async {
        let adapter = instance.request_adapter(&wanted).await.map_err(|error| error.to_string())?;
        let descriptor = wgpu::DeviceDescriptor { required_limits: limits, ..Default::default() };
        let (device, queue) = adapter.request_device(&descriptor).await.map_err(|error| error.to_string())?;
        Ok::<_, String>(Gpu::shared(&device, &queue, &adapter.get_info()))
    });
    opened.unwrap_or_else(|error| panic!("{error}"))
}

/// A renderer with one map, drawing small pictures.
pub struct Stage {
    /// The renderer.
    pub renderer: Renderer,
    /// The map.
    pub map: GpuMap,
    /// Side of its pictures.
    pub size: u32,
}

impl Stage {
    /// A stage with the map of a preset, 128 px.
    ///
    /// # Panics
    /// If there is no adapter or no such preset.
    pub fn new(preset: &str, size: u32) -> Self {
        let mut preset = Preset::named(preset).expect("an embedded preset").expect("a valid preset");
        preset.map.size = 128;
        preset.map.coarsest = 16;
        let renderer = renderer();
        let map = HatchMap::from_preset("test", &preset, &Job::default()).expect("an embedded preset generates");
        Self { map: renderer.map(map), renderer, size }
    }

    /// Draws once: linear light, one sample per pixel, rows from the top.
    ///
    /// # Panics
    /// If it cannot be drawn.
    pub fn draw(&mut self, scene: &Scene, params: &RenderParams, mesh: &Mesh) -> Vec<[f32; 4]> {
        let mesh = self.upload(params, mesh, surface_for(params, mesh).as_ref());
        self.draw_uploaded(scene, params, &mesh)
    }

    /// A mesh on the GPU, with its surface.
    ///
    /// # Panics
    /// If it does not fit.
    pub fn upload(&self, params: &RenderParams, mesh: &Mesh, surface: Option<&Surface>) -> GpuMesh {
        let mut mesh = self.renderer.mesh(mesh).expect("a mesh that fits");
        if let Some(surface) = surface.filter(|_| takes_surface(params)) {
            self.renderer.attach(&mut mesh, surface).expect("a surface that fits");
        }
        mesh
    }

    /// The same as [`Stage::draw`], for many pictures of one mesh.
    ///
    /// # Panics
    /// If it cannot be drawn.
    pub fn draw_uploaded(&mut self, scene: &Scene, params: &RenderParams, mesh: &GpuMesh) -> Vec<[f32; 4]> {
        let target = self.renderer.target([self.size; 2], 1, PixelFormat::Linear32).expect("a picture that fits");
        self.renderer.render(scene, params, mesh, &[&self.map], &target).expect("a frame");
        target.read(&self.renderer.gpu).expect("pixels").linear()
    }
}

/// What a surface needs for a way to draw, else as it is without options.
pub fn surface_options(params: &RenderParams) -> SurfaceOptions {
    let (field, lines_per_unit) = (FieldOptions::default(), StripeOptions::default().lines_per_unit);
    SurfaceNeeds::of(params).options(field, params, false, lines_per_unit).unwrap_or_default()
}

/// The surface for a way to draw; `None` where it needs none. The mesh is not cut.
///
/// # Panics
/// If there is no field.
pub fn surface_for(params: &RenderParams, mesh: &Mesh) -> Option<Surface> {
    takes_surface(params).then(|| Surface::new(mesh, &surface_options(params)).expect("a field"))
}

fn takes_surface(params: &RenderParams) -> bool {
    SurfaceNeeds::of(params) != SurfaceNeeds::default()
}

/// The mappings that a mesh can be drawn with.
pub fn mappings(mesh: &Mesh) -> Vec<Mapping> {
    Mapping::ALL.into_iter().filter(|mapping| *mapping != Mapping::Uv || !mesh.uvs.is_empty()).collect()
}

/// A camera straight in front of the mesh.
pub fn front_camera() -> Camera {
    Camera { azimuth_deg: 0.0, elevation_deg: 0.0, distance: 4.0, ..Camera::default() }
}

/// A scene with one light, seen from the front.
pub fn scene_with(light: Light) -> Scene {
    Scene { camera: front_camera(), lights: Lights { ambient: 0.0, lights: vec![light] }, ..Scene::default() }
}

/// A mesh from corners and triangles, loaded as any file is.
///
/// # Panics
/// If nothing is left of it.
pub fn loaded(positions: &[Vec3], triangles: &[[u32; 3]]) -> Mesh {
    stability::loaded(positions, triangles).expect("a mesh")
}
