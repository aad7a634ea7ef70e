//! Contours, borders, creases and the wireframe over any method. The edges that are contours, borders or creases are
//! listed first, so that only those are drawn; of the wireframe all are.

use std::collections::HashMap;

use tam_shaders::cpu::line_edges::{BLOCK_EDGES, BLOCK_LANES};
use tam_shaders::{Pass, types};

use super::faces::group_rows;
use super::shading::{depth_state, module};
use crate::gpu::{Gpu, Layouts, Offsets, TargetFormats};
use crate::params::{Inspect, RenderParams, Silhouettes};
use crate::renderer::Draw;

/// Lines over the strokes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum LineKind {
    Silhouettes,
    Wireframe,
}

impl LineKind {
    /// What they look like; all at nothing where they are not drawn.
    pub(crate) fn style(self, params: &RenderParams, inspect: &Inspect, ink: [f32; 3]) -> types::LineStyle {
        match self {
            Self::Silhouettes => {
                params.silhouettes.map_or_else(types::LineStyle::default, |lines| silhouettes_style(&lines, ink))
            }
            Self::Wireframe => types::LineStyle {
                colour: WIREFRAME_COLOUR,
                edges: 1,
                width_px: inspect.wireframe.unwrap_or(0.0) as f32,
                ..types::LineStyle::default()
            },
        }
    }
}

/// Blue, in linear light, that lets paper and ink through and is neither.
const WIREFRAME_COLOUR: [f32; 4] = [0.03, 0.25, 1.0, 0.7];

/// The line pipelines, made when first needed.
#[derive(Default)]
pub(crate) struct Lines {
    made: Option<Made>,
    pipelines: HashMap<TargetFormats, wgpu::RenderPipeline>,
}

/// What does not depend on the target.
struct Made {
    /// Mark the lines in blocks of edges, sum them up, list them.
    listing: [wgpu::ComputePipeline; 3],
    module: wgpu::ShaderModule,
    layout: wgpu::PipelineLayout,
}

impl Made {
    fn new(gpu: &Gpu, layouts: &Layouts) -> Self {
        let storage = layouts.storage();
        Self {
            listing: listing(gpu, layouts),
            module: module(gpu, Pass::Lines),
            layout: gpu.device.create_pipeline_layout(&wgpu::PipelineLayoutDescriptor {
                label: Some("lines"),
                bind_group_layouts: &[Some(&layouts.frame), Some(&storage.line_mesh), Some(&storage.lines)],
                immediate_size: 0,
            }),
        }
    }
}

impl Lines {
    /// The lines that are drawn, the uppermost last.
    pub(crate) fn drawn(params: &RenderParams, inspect: &Inspect) -> impl Iterator<Item = LineKind> {
        let wireframe = inspect.wireframe.map(|_| LineKind::Wireframe);
        wireframe.into_iter().chain(params.silhouettes.map(|_| LineKind::Silhouettes))
    }

    /// Makes the pipelines for a target, if they are not made.
    pub(crate) fn make(&mut self, gpu: &Gpu, layouts: &Layouts, formats: TargetFormats) {
        let Made { module, layout, .. } = self.made.get_or_insert_with(|| Made::new(gpu, layouts));
        self.pipelines.entry(formats).or_insert_with(|| {
            gpu.render_pipeline(&wgpu::RenderPipelineDescriptor {
                label: Some("lines"),
                layout: Some(layout),
                vertex: wgpu::VertexState {
                    module,
                    entry_point: Some("vertex"),
                    compilation_options: wgpu::PipelineCompilationOptions::default(),
                    buffers: &[],
                },
                primitive: wgpu::PrimitiveState {
                    topology: wgpu::PrimitiveTopology::TriangleStrip,
                    ..wgpu::PrimitiveState::default()
                },
                depth_stencil: Some(depth_state(formats.depth, false)),
                multisample: wgpu::MultisampleState { count: formats.samples, ..Default::default() },
                fragment: Some(wgpu::FragmentState {
                    module,
                    entry_point: Some("fragment"),
                    compilation_options: wgpu::PipelineCompilationOptions::default(),
                    targets: &[Some(wgpu::ColorTargetState {
                        format: formats.colour,
                        blend: Some(wgpu::BlendState::ALPHA_BLENDING),
                        write_mask: wgpu::ColorWrites::ALL,
                    })],
                }),
                multiview_mask: None,
                cache: None,
            })
        });
    }

    /// Whether edges of an object are listed: where lines are drawn, but not all of them.
    pub(crate) fn lists(draw: &Draw<'_>) -> bool {
        draw.lines.iter().any(|(kind, _)| *kind == LineKind::Silhouettes)
    }

    /// Lists the edges that are lines, where not all are.
    pub(crate) fn list(&self, pass: &mut wgpu::ComputePass<'_>, frame: &wgpu::BindGroup, draws: &[Draw<'_>]) {
        let Some(Made { listing, .. }) = &self.made else { return };
        for draw in draws {
            let Some(placed) = &draw.placed else { continue };
            for (_, style) in draw.lines.iter().filter(|(kind, _)| *kind == LineKind::Silhouettes) {
                let offsets = Offsets { scene: draw.scene.1, style: *style, ..Offsets::default() };
                pass.set_bind_group(0, frame, &offsets.of_group());
                pass.set_bind_group(1, &placed.groups.line_mesh, &[]);
                pass.set_bind_group(2, &placed.groups.line_edges, &[]);
                let [columns, rows] =
                    group_rows(draw.mesh.buffers.edge_count.div_ceil((BLOCK_EDGES * BLOCK_LANES) as u32));
                let [mark, sum, list] = listing;
                for (pipeline, columns, rows) in [(mark, columns, rows), (sum, 1, 1), (list, columns, rows)] {
                    pass.set_pipeline(pipeline);
                    pass.dispatch_workgroups(columns, rows, 1);
                }
            }
        }
    }

    /// Draws one quad per line of each object.
    pub(crate) fn record(
        &self,
        pass: &mut wgpu::RenderPass<'_>,
        frame: &wgpu::BindGroup,
        formats: TargetFormats,
        draws: &[Draw<'_>],
    ) {
        let Some(pipeline) = self.pipelines.get(&formats).filter(|_| draws.iter().any(|draw| !draw.lines.is_empty()))
        else {
            return;
        };
        pass.set_pipeline(pipeline);
        for draw in draws {
            let Some(placed) = &draw.placed else { continue };
            for (kind, style) in &draw.lines {
                let offsets = Offsets { scene: draw.scene.1, style: *style, ..Offsets::default() };
                pass.set_bind_group(0, frame, &offsets.of_group());
                pass.set_bind_group(1, &placed.groups.line_mesh, &[]);
                pass.set_bind_group(2, &placed.groups.lines, &[]);
                match kind {
                    LineKind::Silhouettes => pass.draw_indirect(&placed.line_arguments, 0),
                    LineKind::Wireframe => pass.draw(0..4, 0..draw.mesh.buffers.edge_count),
                }
            }
        }
    }
}

fn listing(gpu: &Gpu, layouts: &Layouts) -> [wgpu::ComputePipeline; 3] {
    let module = module(gpu, Pass::LineEdges);
    let (label, storage) = (Some(Pass::LineEdges.name()), layouts.storage());
    let layout = gpu.device.create_pipeline_layout(&wgpu::PipelineLayoutDescriptor {
        label,
        bind_group_layouts: &[Some(&layouts.frame), Some(&storage.line_mesh), Some(&storage.line_edges)],
        immediate_size: 0,
    });
    ["mark", "sum", "list"].map(|entry_point| {
        gpu.compute_pipeline(&wgpu::ComputePipelineDescriptor {
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
