//! The adapter under test, and one way to run a pass with what its source asks for by name.

use naga::valid::{Capabilities as NagaCapabilities, ValidationFlags, Validator};
use tam_shaders::cpu::Options;
use wgpu::util::DeviceExt;

/// Sides of the picture whose pixels are the cases of a run.
pub(crate) const SIDE: u32 = 64;
/// Cases of one run.
pub(crate) const CASES: usize = (SIDE * SIDE) as usize;

/// A device on the pinned adapter.
pub(crate) struct Gpu {
    pub(crate) device: wgpu::Device,
    pub(crate) queue: wgpu::Queue,
}

/// What a variable of a source is bound to.
pub(crate) type Resource<'a> = &'a dyn Fn(&str) -> Option<wgpu::BindingResource<'a>>;

impl Gpu {
    /// Mesa's software driver, so that results do not depend on the machine; or the adapter whose name holds
    /// `WGPU_ADAPTER_NAME`.
    pub(crate) fn new() -> Self {
        let wanted = std::env::var("WGPU_ADAPTER_NAME").unwrap_or_else(|_| "llvmpipe".into()).to_lowercase();
        let mut descriptor = wgpu::InstanceDescriptor::new_without_display_handle();
        descriptor.backends = wgpu::Backends::VULKAN;
        let instance = wgpu::Instance::new(descriptor);
        let adapters = pollster::block_on(instance.enumerate_adapters(wgpu::Backends::VULKAN));
        let named = adapters.iter().find(|adapter| adapter.get_info().name.to_lowercase().contains(&wanted));
        let adapter = named.unwrap_or_else(|| {
            let names: Vec<_> = adapters.iter().map(|adapter| adapter.get_info().name).collect();
            panic!("no Vulkan adapter is named like {wanted} (found: {names:?}); install mesa-vulkan-drivers")
        });
        let limits = wgpu::Limits { max_storage_buffers_per_shader_stage: 12, ..Default::default() };
        let descriptor = wgpu::DeviceDescriptor { required_limits: limits, ..Default::default() };
        let (device, queue) = pollster::block_on(adapter.request_device(&descriptor))
            .unwrap_or_else(|error| panic!("{} gives no device: {error}", adapter.get_info().name));
        Self { device, queue }
    }

    /// Runs a fragment entry point `harness` for every pixel of a square, by a vertex entry point `harness_vertex` that
    /// covers it, and returns what it wrote, by rows.
    pub(crate) fn draw(&self, source: &str, options: Options, resource: Resource<'_>) -> Vec<[f32; 4]> {
        let bound = bound_variables(source, "harness");
        let module = self.module(source);
        let constants = constants(source, options);
        let compilation =
            wgpu::PipelineCompilationOptions { constants: &constants, zero_initialize_workgroup_memory: true };
        let format = wgpu::TextureFormat::Rgba32Float;
        let pipeline = self.device.create_render_pipeline(&wgpu::RenderPipelineDescriptor {
            label: None,
            layout: None,
            vertex: wgpu::VertexState {
                module: &module,
                entry_point: Some("harness_vertex"),
                compilation_options: compilation.clone(),
                buffers: &[],
            },
            primitive: wgpu::PrimitiveState::default(),
            depth_stencil: None,
            multisample: wgpu::MultisampleState::default(),
            fragment: Some(wgpu::FragmentState {
                module: &module,
                entry_point: Some("harness"),
                compilation_options: compilation,
                targets: &[Some(format.into())],
            }),
            multiview_mask: None,
            cache: None,
        });
        let size = wgpu::Extent3d { width: SIDE, height: SIDE, depth_or_array_layers: 1 };
        let target = self.device.create_texture(&wgpu::TextureDescriptor {
            label: None,
            size,
            mip_level_count: 1,
            sample_count: 1,
            dimension: wgpu::TextureDimension::D2,
            format,
            usage: wgpu::TextureUsages::RENDER_ATTACHMENT | wgpu::TextureUsages::COPY_SRC,
            view_formats: &[],
        });
        let view = target.create_view(&wgpu::TextureViewDescriptor::default());
        let groups = self.bind_groups(&bound, resource, |group| pipeline.get_bind_group_layout(group));
        let mut encoder = self.device.create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
        {
            let mut pass = encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
                color_attachments: &[Some(wgpu::RenderPassColorAttachment {
                    view: &view,
                    depth_slice: None,
                    resolve_target: None,
                    ops: wgpu::Operations::default(),
                })],
                ..Default::default()
            });
            pass.set_pipeline(&pipeline);
            for (group, bindings) in &groups {
                pass.set_bind_group(*group, bindings, &[]);
            }
            // The triangle reaches far beyond the picture, but not beyond the clip volume: a clipped one would be cut
            // in two, and loads by the fragments that help along the cut give nothing on some drivers.
            let side = 4.0 * SIDE as f32;
            pass.set_viewport(0.0, 0.0, side, side, 0.0, 1.0);
            pass.draw(0..3, 0..1);
        }
        let bytes = u64::from(SIDE * SIDE * 16);
        let download = self.download_buffer(bytes);
        let layout = wgpu::TexelCopyBufferLayout { offset: 0, bytes_per_row: Some(SIDE * 16), rows_per_image: None };
        let to = wgpu::TexelCopyBufferInfo { buffer: &download, layout };
        encoder.copy_texture_to_buffer(target.as_image_copy(), to, size);
        self.queue.submit([encoder.finish()]);
        self.read(&download)
    }

    /// Runs an entry point of a compute pass in groups, and returns what it wrote to some of its buffers.
    pub(crate) fn compute<T: bytemuck::Pod, const N: usize>(
        &self,
        (source, entry_point): (&str, &str),
        options: Options,
        groups: u32,
        resource: Resource<'_>,
        written: [&wgpu::Buffer; N],
    ) -> [Vec<T>; N] {
        let bound = bound_variables(source, entry_point);
        let module = self.module(source);
        let constants = constants(source, options);
        let pipeline = self.device.create_compute_pipeline(&wgpu::ComputePipelineDescriptor {
            label: None,
            layout: None,
            module: &module,
            entry_point: Some(entry_point),
            compilation_options: wgpu::PipelineCompilationOptions {
                constants: &constants,
                zero_initialize_workgroup_memory: true,
            },
            cache: None,
        });
        let bindings = self.bind_groups(&bound, resource, |group| pipeline.get_bind_group_layout(group));
        let mut encoder = self.device.create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
        {
            let mut pass = encoder.begin_compute_pass(&wgpu::ComputePassDescriptor::default());
            pass.set_pipeline(&pipeline);
            for (group, bindings) in &bindings {
                pass.set_bind_group(*group, bindings, &[]);
            }
            pass.dispatch_workgroups(groups, 1, 1);
        }
        let downloads = written.map(|buffer| {
            let download = self.download_buffer(buffer.size());
            encoder.copy_buffer_to_buffer(buffer, 0, &download, 0, buffer.size());
            download
        });
        self.queue.submit([encoder.finish()]);
        downloads.map(|download| self.read(&download))
    }

    /// A buffer that passes read and write.
    pub(crate) fn storage(&self, words: &[u32]) -> wgpu::Buffer {
        let usage = wgpu::BufferUsages::STORAGE | wgpu::BufferUsages::COPY_SRC;
        let contents = bytemuck::cast_slice(words);
        self.device.create_buffer_init(&wgpu::util::BufferInitDescriptor { label: None, contents, usage })
    }

    fn module(&self, source: &str) -> wgpu::ShaderModule {
        let source = wgpu::ShaderSource::Wgsl(source.into());
        self.device.create_shader_module(wgpu::ShaderModuleDescriptor { label: None, source })
    }

    fn bind_groups(
        &self,
        bound: &[(u32, u32, String)],
        resource: Resource<'_>,
        layout: impl Fn(u32) -> wgpu::BindGroupLayout,
    ) -> Vec<(u32, wgpu::BindGroup)> {
        let mut groups: Vec<u32> = bound.iter().map(|(group, ..)| *group).collect();
        groups.sort_unstable();
        groups.dedup();
        let bind = |group: u32| {
            let here = bound.iter().filter(|(of, ..)| *of == group);
            let entry = |(_, binding, name): &(u32, u32, String)| wgpu::BindGroupEntry {
                binding: *binding,
                resource: resource(name).unwrap_or_else(|| panic!("nothing to bind to {name}")),
            };
            let entries: Vec<_> = here.map(entry).collect();
            let layout = layout(group);
            let descriptor = wgpu::BindGroupDescriptor { label: None, layout: &layout, entries: &entries };
            (group, self.device.create_bind_group(&descriptor))
        };
        groups.into_iter().map(bind).collect()
    }

    fn download_buffer(&self, size: u64) -> wgpu::Buffer {
        let usage = wgpu::BufferUsages::MAP_READ | wgpu::BufferUsages::COPY_DST;
        self.device.create_buffer(&wgpu::BufferDescriptor { label: None, size, usage, mapped_at_creation: false })
    }

    fn read<T: bytemuck::Pod>(&self, download: &wgpu::Buffer) -> Vec<T> {
        download.map_async(wgpu::MapMode::Read, .., |mapped| mapped.expect("results can be read"));
        self.device.poll(wgpu::PollType::wait_indefinitely()).expect("the device finishes");
        let view = download.get_mapped_range(..).expect("results are mapped");
        bytemuck::pod_collect_to_vec(&view[..])
    }
}

/// Group, binding and name of the variables that an entry point uses: those that its default layout has.
fn bound_variables(source: &str, entry_point: &str) -> Vec<(u32, u32, String)> {
    let module =
        naga::front::wgsl::parse_str(source).unwrap_or_else(|error| panic!("{}", error.emit_to_string(source)));
    let info = Validator::new(ValidationFlags::all(), NagaCapabilities::all())
        .validate(&module)
        .unwrap_or_else(|error| panic!("{}", error.emit_to_string(source)));
    let index = module.entry_points.iter().position(|entry| entry.name == entry_point).expect("it is in the source");
    let uses = info.get_entry_point(index);
    let used = module.global_variables.iter().filter(|(variable, _)| !uses[*variable].is_empty());
    let bound = used.filter_map(|(_, variable)| {
        let at = variable.binding.as_ref()?;
        Some((at.group, at.binding, variable.name.clone()?))
    });
    bound.collect()
}

/// The constants that a source declares.
fn constants(source: &str, options: Options) -> Vec<(&'static str, f64)> {
    let declared = |name: &str| source.contains(&format!("override {name}:"));
    options.constants().into_iter().filter(|(name, _)| declared(name)).collect()
}
