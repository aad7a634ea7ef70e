//! What all shading passes share: pipelines by variant, and the draw of each part of an object.

use std::collections::HashMap;

use tam_shaders::{Feed, Pass, compose, cpu};

use super::{debug, face_frame, fine_tone, phong, six_way, stripes, stroke_map};
use crate::gpu::{FaceData, Gpu, GpuMesh, Layouts, MapKind, Offsets, TargetFormats, feeds};
use crate::params::{Blend, DebugView, Follow, Form, Mapping, Method, RenderParams};
use crate::renderer::Draw;

/// One way to draw: a shader with its constants.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub(crate) struct Variant {
    pub pass: Pass,
    /// Overrides of the shader.
    pub constants: Vec<(&'static str, u32)>,
    /// What it samples.
    pub kind: MapKind,
    /// What its vertices carry.
    pub feed: Feed,
    /// Entry point of the fragment stage.
    pub fragment: &'static str,
    /// What of the faces it reads.
    pub faces: FaceData,
}

impl Variant {
    pub(crate) fn new(pass: Pass, kind: MapKind) -> Self {
        let (feed, faces) = (Feed::Vertices, FaceData::default());
        Self { pass, constants: Vec::new(), kind, feed, fragment: "fragment", faces }
    }

    pub(crate) fn with(mut self, name: &'static str, constant: u32) -> Self {
        self.constants.push((name, constant));
        self
    }

    /// The overrides that all mapped methods have.
    pub(crate) fn mapped(mut self, params: &RenderParams) -> Self {
        let follows = params.mapping == Mapping::Patches && params.follow == Follow::Light;
        self.feed = match params.mapping {
            Mapping::Uv => Feed::Uvs,
            Mapping::Frames => Feed::Faces,
            Mapping::Triplanar => Feed::Vertices,
            Mapping::Patches if follows => Feed::Turning,
            Mapping::Patches => Feed::Corners,
            Mapping::Lapped => Feed::Lapped,
        };
        if self.feed == Feed::Lapped {
            self.fragment = "fragment_lapped";
        }
        let this = self.with("FOLLOW", u32::from(follows));
        this.with("FORM", form_constant(params.form)).with("MAPPING", cpu::Mapping::from(params.mapping) as u32)
    }
}

pub(crate) fn form_constant(form: Form) -> u32 {
    cpu::Form::from(form) as u32
}

/// The variant that draws a mesh with these parameters, or what a debug view shows in place of its ink.
pub(crate) fn variant(params: &RenderParams, shown: Option<DebugView>, mesh: &GpuMesh) -> Variant {
    shown.map_or_else(|| method_variant(params), |view| debug::variant(view, params, mesh))
}

/// The variant of a method.
pub(super) fn method_variant(params: &RenderParams) -> Variant {
    let variant = match params.method {
        Method::Phong => phong::variant(),
        Method::SixWay => six_way::variant(params),
        Method::FaceFrame => face_frame::variant(params),
        Method::StrokeMap => stroke_map::strokes(params),
        Method::Halftone => stroke_map::lines(params),
        Method::FineTone => fine_tone::variant(params),
        Method::Stripes => stripes::variant(params),
    };
    Variant { faces: FaceData::of(params), ..variant }
}

#[derive(Clone, PartialEq, Eq, Hash)]
struct PipelineKey {
    variant: Variant,
    formats: TargetFormats,
    culled: bool,
}

/// Pipelines, made when first needed.
#[derive(Default)]
pub(crate) struct Shading {
    pipelines: Vec<wgpu::RenderPipeline>,
    numbers: HashMap<PipelineKey, usize>,
    modules: HashMap<Pass, wgpu::ShaderModule>,
}

impl Shading {
    /// Number of the pipeline of a variant; `culled` leaves out back faces.
    pub(crate) fn pipeline(
        &mut self,
        gpu: &Gpu,
        layouts: &Layouts,
        variant: &Variant,
        formats: TargetFormats,
        culled: bool,
    ) -> usize {
        let key = PipelineKey { variant: variant.clone(), formats, culled };
        let Self { pipelines, numbers, modules } = self;
        *numbers.entry(key).or_insert_with(|| {
            let module = modules.entry(variant.pass).or_insert_with(|| module(gpu, variant.pass));
            pipelines.push(shading_pipeline(gpu, layouts, module, variant, formats, culled));
            pipelines.len() - 1
        })
    }

    /// Draws all parts of all objects.
    pub(crate) fn record(&self, pass: &mut wgpu::RenderPass<'_>, frame: &wgpu::BindGroup, draws: &[Draw<'_>]) {
        let mut set = None;
        for draw in draws {
            if set != Some(draw.pipeline) {
                pass.set_pipeline(&self.pipelines[draw.pipeline]);
                set = Some(draw.pipeline);
            }
            if let Some(placed) = draw.placed.as_ref().filter(|_| draw.variant.feed.is_pulled()) {
                pass.set_bind_group(1, &placed.groups.drawn, &[]);
            }
            pass.set_bind_group(3, &draw.surface, &[]);
            for (slot, buffer) in draw.fed.buffers.iter().enumerate() {
                pass.set_vertex_buffer(slot as u32, buffer.slice(..));
            }
            if let Some(indices) = draw.fed.indices {
                pass.set_index_buffer(indices.slice(..), wgpu::IndexFormat::Uint32);
            }
            for (part, (material, map)) in draw.fed.parts.iter().zip(&draw.parts) {
                let offsets = Offsets { scene: draw.scene.1, material: *material, ..Offsets::default() };
                pass.set_bind_group(0, frame, &offsets.of_group());
                pass.set_bind_group(2, &map.group, &[]);
                if draw.fed.indices.is_some() {
                    pass.draw_indexed(part.clone(), 0, 0..1);
                } else {
                    pass.draw(part.clone(), 0..1);
                }
            }
        }
    }
}

pub(crate) fn module(gpu: &Gpu, pass: Pass) -> wgpu::ShaderModule {
    let source = compose(pass);
    gpu.device.create_shader_module(wgpu::ShaderModuleDescriptor {
        label: Some(pass.name()),
        source: wgpu::ShaderSource::Wgsl(source.into()),
    })
}

pub(super) fn shading_pipeline(
    gpu: &Gpu,
    layouts: &Layouts,
    module: &wgpu::ShaderModule,
    variant: &Variant,
    formats: TargetFormats,
    culled: bool,
) -> wgpu::RenderPipeline {
    let layout = gpu.device.create_pipeline_layout(&wgpu::PipelineLayoutDescriptor {
        label: Some(variant.pass.name()),
        bind_group_layouts: &[
            Some(&layouts.frame),
            variant.feed.is_pulled().then(|| &layouts.storage().mesh),
            Some(&layouts.map),
            Some(&layouts.surface),
        ],
        immediate_size: 0,
    });
    let constants: Vec<(&str, f64)> =
        variant.constants.iter().map(|(name, value)| (*name, f64::from(*value))).collect();
    let options = wgpu::PipelineCompilationOptions { constants: &constants, ..Default::default() };
    gpu.render_pipeline(&wgpu::RenderPipelineDescriptor {
        label: Some(variant.pass.name()),
        layout: Some(&layout),
        vertex: wgpu::VertexState {
            module,
            entry_point: Some(variant.feed.vertex_entry()),
            compilation_options: options.clone(),
            buffers: feeds::layouts(variant.feed),
        },
        primitive: wgpu::PrimitiveState {
            cull_mode: culled.then_some(wgpu::Face::Back),
            ..wgpu::PrimitiveState::default()
        },
        depth_stencil: Some(depth_state(formats.depth, true)),
        multisample: wgpu::MultisampleState { count: formats.samples, ..Default::default() },
        fragment: Some(wgpu::FragmentState {
            module,
            entry_point: Some(variant.fragment),
            compilation_options: options,
            targets: &[Some(formats.colour.into())],
        }),
        multiview_mask: None,
        cache: None,
    })
}

pub(crate) fn depth_state(format: wgpu::TextureFormat, write: bool) -> wgpu::DepthStencilState {
    wgpu::DepthStencilState {
        format,
        depth_write_enabled: Some(write),
        depth_compare: Some(wgpu::CompareFunction::LessEqual),
        stencil: wgpu::StencilState::default(),
        bias: wgpu::DepthBiasState::default(),
    }
}

pub(super) fn blend_constant(blend: Blend) -> u32 {
    cpu::Blend::from(blend) as u32
}
