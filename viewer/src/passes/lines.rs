//! Contours, borders and creases over any method.

use std::collections::HashMap;

use tam_shaders::{Pass, types};

use super::shading::{depth_state, module};
use crate::gpu::{Gpu, GpuMesh, Layouts, PixelFormat};
use crate::params::Silhouettes;

/// The line pipelines and their style.
pub(crate) struct Lines {
    pub(crate) style: wgpu::Buffer,
    module: wgpu::ShaderModule,
    layout: wgpu::PipelineLayout,
    pipelines: HashMap<(PixelFormat, u32), wgpu::RenderPipeline>,
}

impl Lines {
    pub(crate) fn new(gpu: &Gpu, layouts: &Layouts) -> Self {
        Self {
            style: gpu.device.create_buffer(&wgpu::BufferDescriptor {
                label: Some("line style"),
                size: size_of::<types::LineStyle>() as u64,
                usage: wgpu::BufferUsages::UNIFORM | wgpu::BufferUsages::COPY_DST,
                mapped_at_creation: false,
            }),
            module: module(gpu, Pass::Lines),
            layout: gpu.device.create_pipeline_layout(&wgpu::PipelineLayoutDescriptor {
                label: Some("lines"),
                bind_group_layouts: &[Some(&layouts.scene), Some(&layouts.mesh), Some(&layouts.lines)],
                immediate_size: 0,
            }),
            pipelines: HashMap::new(),
        }
    }

    /// Writes the style.
    pub(crate) fn prepare(&self, gpu: &Gpu, silhouettes: &Silhouettes, ink: [f32; 3]) {
        let style = types::LineStyle {
            colour: [ink[0], ink[1], ink[2], 1.0],
            width_px: silhouettes.width_px as f32,
            crease_cosine: silhouettes.crease_deg.unwrap_or(180.0).to_radians().cos() as f32,
            contours: silhouettes.contours.into(),
            borders: silhouettes.borders.into(),
            creases: silhouettes.crease_deg.is_some().into(),
            ..types::LineStyle::default()
        };
        gpu.queue.write_buffer(&self.style, 0, bytemuck::bytes_of(&style));
    }

    /// The pipeline for a target, made when first needed.
    pub(crate) fn pipeline(&mut self, gpu: &Gpu, format: PixelFormat, samples: u32) -> &wgpu::RenderPipeline {
        self.pipelines.entry((format, samples)).or_insert_with(|| {
            gpu.device.create_render_pipeline(&wgpu::RenderPipelineDescriptor {
                label: Some("lines"),
                layout: Some(&self.layout),
                vertex: wgpu::VertexState {
                    module: &self.module,
                    entry_point: Some("vertex"),
                    compilation_options: wgpu::PipelineCompilationOptions::default(),
                    buffers: &[],
                },
                primitive: wgpu::PrimitiveState {
                    topology: wgpu::PrimitiveTopology::TriangleStrip,
                    ..wgpu::PrimitiveState::default()
                },
                depth_stencil: Some(depth_state(false)),
                multisample: wgpu::MultisampleState { count: samples, ..Default::default() },
                fragment: Some(wgpu::FragmentState {
                    module: &self.module,
                    entry_point: Some("fragment"),
                    compilation_options: wgpu::PipelineCompilationOptions::default(),
                    targets: &[Some(wgpu::ColorTargetState {
                        format: format.texture_format(),
                        blend: Some(wgpu::BlendState::ALPHA_BLENDING),
                        write_mask: wgpu::ColorWrites::ALL,
                    })],
                }),
                multiview_mask: None,
                cache: None,
            })
        })
    }

    /// Draws one quad per edge; those that are no line fall away in the vertex stage.
    pub(crate) fn record(
        pass: &mut wgpu::RenderPass<'_>,
        pipeline: &wgpu::RenderPipeline,
        scene: &wgpu::BindGroup,
        mesh: &GpuMesh,
    ) {
        pass.set_pipeline(pipeline);
        pass.set_bind_group(0, scene, &[]);
        pass.set_bind_group(1, &mesh.groups.drawn, &[]);
        pass.set_bind_group(2, &mesh.groups.lines, &[]);
        pass.draw(0..4, 0..mesh.edge_count);
    }
}
