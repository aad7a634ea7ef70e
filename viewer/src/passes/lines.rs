//! Contours, borders, creases and the wireframe over any method. The edges that are contours, borders or creases are
//! listed first, so that only those are drawn; of the wireframe all are.

use std::collections::HashMap;

use tam_shaders::cpu::line_edges::{BLOCK_EDGES, BLOCK_LANES};
use tam_shaders::{Pass, types};

use super::faces::group_rows;
use super::shading::{depth_state, module};
use crate::gpu::{Gpu, GpuMesh, Layouts, PixelFormat};
use crate::params::{RenderParams, Silhouettes};

/// Lines over the strokes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum LineKind {
    Silhouettes = 0,
    Wireframe = 1,
}

/// Blue, in linear light, that lets paper and ink through and is neither.
const WIREFRAME_COLOUR: [f32; 4] = [0.03, 0.25, 1.0, 0.7];

/// The line pipelines and their styles.
pub(crate) struct Lines {
    /// By kind.
    pub(crate) styles: [wgpu::Buffer; 2],
    /// Mark the lines in blocks of edges, sum them up, list them.
    listing: [wgpu::ComputePipeline; 3],
    module: wgpu::ShaderModule,
    layout: wgpu::PipelineLayout,
    pipelines: HashMap<(PixelFormat, u32), wgpu::RenderPipeline>,
}

impl Lines {
    pub(crate) fn new(gpu: &Gpu, layouts: &Layouts) -> Self {
        Self {
            styles: ["silhouettes", "wireframe"].map(|label| {
                gpu.device.create_buffer(&wgpu::BufferDescriptor {
                    label: Some(label),
                    size: size_of::<types::LineStyle>() as u64,
                    usage: wgpu::BufferUsages::UNIFORM | wgpu::BufferUsages::COPY_DST,
                    mapped_at_creation: false,
                })
            }),
            listing: listing(gpu, layouts),
            module: module(gpu, Pass::Lines),
            layout: gpu.device.create_pipeline_layout(&wgpu::PipelineLayoutDescriptor {
                label: Some("lines"),
                bind_group_layouts: &[Some(&layouts.scene), Some(&layouts.line_mesh), Some(&layouts.lines)],
                immediate_size: 0,
            }),
            pipelines: HashMap::new(),
        }
    }

    /// The lines that are drawn, the uppermost last.
    pub(crate) fn drawn(params: &RenderParams) -> impl Iterator<Item = LineKind> {
        let wireframe = params.wireframe.map(|_| LineKind::Wireframe);
        wireframe.into_iter().chain(params.silhouettes.map(|_| LineKind::Silhouettes))
    }

    /// Writes the styles of the lines that are drawn.
    pub(crate) fn prepare(&self, gpu: &Gpu, params: &RenderParams, ink: [f32; 3]) {
        let write = |kind: LineKind, style: types::LineStyle| {
            gpu.queue.write_buffer(&self.styles[kind as usize], 0, bytemuck::bytes_of(&style));
        };
        if let Some(silhouettes) = &params.silhouettes {
            write(LineKind::Silhouettes, silhouettes_style(silhouettes, ink));
        }
        if let Some(width_px) = params.wireframe {
            let style = types::LineStyle { colour: WIREFRAME_COLOUR, edges: 1, ..types::LineStyle::default() };
            write(LineKind::Wireframe, types::LineStyle { width_px: width_px as f32, ..style });
        }
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

    /// Lists the edges that are lines of this kind, where not all are.
    pub(crate) fn list(
        &self,
        pass: &mut wgpu::ComputePass<'_>,
        scene: &wgpu::BindGroup,
        mesh: &GpuMesh,
        params: &RenderParams,
    ) {
        if params.silhouettes.is_none() {
            return;
        }
        pass.set_bind_group(0, scene, &[]);
        pass.set_bind_group(1, &mesh.groups.line_mesh, &[]);
        pass.set_bind_group(2, &mesh.groups.line_edges, &[]);
        let [columns, rows] = group_rows(mesh.edge_count.div_ceil((BLOCK_EDGES * BLOCK_LANES) as u32));
        let [mark, sum, list] = &self.listing;
        for (pipeline, columns, rows) in [(mark, columns, rows), (sum, 1, 1), (list, columns, rows)] {
            pass.set_pipeline(pipeline);
            pass.dispatch_workgroups(columns, rows, 1);
        }
    }

    /// Draws one quad per line.
    pub(crate) fn record(
        pass: &mut wgpu::RenderPass<'_>,
        pipeline: &wgpu::RenderPipeline,
        scene: &wgpu::BindGroup,
        mesh: &GpuMesh,
        kind: LineKind,
    ) {
        pass.set_pipeline(pipeline);
        pass.set_bind_group(0, scene, &[]);
        pass.set_bind_group(1, &mesh.groups.line_mesh, &[]);
        pass.set_bind_group(2, &mesh.groups.lines[kind as usize], &[]);
        match kind {
            LineKind::Silhouettes => pass.draw_indirect(&mesh.line_arguments, 0),
            LineKind::Wireframe => pass.draw(0..4, 0..mesh.edge_count),
        }
    }
}

fn listing(gpu: &Gpu, layouts: &Layouts) -> [wgpu::ComputePipeline; 3] {
    let module = module(gpu, Pass::LineEdges);
    let label = Some(Pass::LineEdges.name());
    let layout = gpu.device.create_pipeline_layout(&wgpu::PipelineLayoutDescriptor {
        label,
        bind_group_layouts: &[Some(&layouts.scene), Some(&layouts.line_mesh), Some(&layouts.line_edges)],
        immediate_size: 0,
    });
    ["mark", "sum", "list"].map(|entry_point| {
        gpu.device.create_compute_pipeline(&wgpu::ComputePipelineDescriptor {
            label,
            layout: Some(&layout),
            module: &module,
            entry_point: Some(entry_point),
            compilation_options: wgpu::PipelineCompilationOptions::default(),
            cache: None,
        })
    })
}

fn silhouettes_style(silhouettes: &Silhouettes, ink: [f32; 3]) -> types::LineStyle {
    types::LineStyle {
        colour: [ink[0], ink[1], ink[2], 1.0],
        width_px: silhouettes.width_px as f32,
        crease_cosine: silhouettes.crease_deg.unwrap_or(180.0).to_radians().cos() as f32,
        contours: silhouettes.contours.into(),
        borders: silhouettes.borders.into(),
        creases: silhouettes.crease_deg.is_some().into(),
        ..types::LineStyle::default()
    }
}
