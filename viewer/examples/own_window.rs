//! The renderer in a window and on a device of one's own: `cargo run -p tam-viewer --example own_window [FRAMES]`.

use std::{error::Error, sync::Arc};
use tam_viewer::gpu::{Gpu, GpuMap, GpuMesh, TargetFormats, TargetViews};
use tam_viewer::{Light, Object, RenderParams, Renderer, Scene, maps::HatchMap, mesh::prepare, mesh::sample::Sample};
use winit::event_loop::{ActiveEventLoop, EventLoop};
use winit::{application::ApplicationHandler, event::WindowEvent, window::Window, window::WindowId};

struct Shown {
    window: Arc<Window>,
    surface: wgpu::Surface<'static>,
    config: wgpu::SurfaceConfiguration,
    renderer: Renderer,
    mesh: GpuMesh,
    map: GpuMap,
    frame: u32,
}

impl Shown {
    fn new(events: &ActiveEventLoop) -> Result<Self, Box<dyn Error>> {
        let window = Arc::new(events.create_window(Window::default_attributes().with_title("A torus knot"))?);
        let instance = wgpu::Instance::new(wgpu::InstanceDescriptor::new_without_display_handle_from_env());
        let surface = instance.create_surface(Arc::clone(&window))?;
        let wanted = wgpu::RequestAdapterOptions { compatible_surface: Some(&surface), ..Default::default() };
        let adapter = pollster::block_on(instance.request_adapter(&wanted))?;
        let (device, queue) = pollster::block_on(adapter.request_device(&wgpu::DeviceDescriptor::default()))?;
        let mut config = surface.get_default_config(&adapter, 1, 1).ok_or("the adapter draws in no window")?;
        config.format = config.format.add_srgb_suffix();
        let renderer = Renderer::new(Gpu::shared(&device, &queue, &adapter.get_info()));
        let mesh = renderer.mesh(&prepare(Sample::TorusKnot.build(20_000))?.mesh)?;
        let map = HatchMap::from_preset("plain", &tam_gen::Preset::default(), &tam_gen::Job::default())?;
        Ok(Self { map: renderer.map(map), window, surface, config, renderer, mesh, frame: 0 })
    }

    fn draw(&mut self) -> Result<(), Box<dyn Error>> {
        let device = &self.renderer.gpu.device;
        let size_px = <[u32; 2]>::from(self.window.inner_size()).map(|side| side.max(1));
        if [self.config.width, self.config.height] != size_px {
            [self.config.width, self.config.height] = size_px;
            self.surface.configure(device, &self.config);
        }
        let wgpu::CurrentSurfaceTexture::Success(shown) = self.surface.get_current_texture() else { return Ok(()) };
        let formats =
            TargetFormats { colour: self.config.format, depth: wgpu::TextureFormat::Depth32Float, samples: 1 };
        let depth = &formats.depth_view(&self.renderer.gpu, size_px);
        let colour = &shown.texture.create_view(&wgpu::TextureViewDescriptor::default());
        let into = TargetViews::new(colour, depth, size_px, formats);
        self.frame += 1;
        let (mut scene, params) = (Scene::default(), RenderParams::default());
        scene.lights.lights = vec![Light::from_angles(f64::from(self.frame) * 2.0, 35.0)];
        let mut encoder = device.create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
        self.renderer.record(&mut encoder, &scene, &[Object::of(&scene, &params, &self.mesh)], &[&self.map], &into)?;
        self.renderer.gpu.queue.submit([encoder.finish()]);
        self.renderer.gpu.queue.present(shown);
        Ok(())
    }
}

struct OwnWindow(Option<Shown>);
impl ApplicationHandler for OwnWindow {
    fn resumed(&mut self, events: &ActiveEventLoop) {
        self.0 = Some(Shown::new(events).expect("a window and an adapter"));
    }

    fn window_event(&mut self, events: &ActiveEventLoop, _: WindowId, event: WindowEvent) {
        let Some(shown) = &mut self.0 else { return };
        if event == WindowEvent::RedrawRequested {
            shown.draw().expect("a frame");
            shown.window.request_redraw();
        }
        let last = std::env::args().nth(1).and_then(|frames| frames.parse().ok());
        if event == WindowEvent::CloseRequested || last == Some(shown.frame) {
            events.exit();
        }
    }
}

fn main() -> Result<(), Box<dyn Error>> {
    Ok(EventLoop::new()?.run_app(&mut OwnWindow(None))?)
}
