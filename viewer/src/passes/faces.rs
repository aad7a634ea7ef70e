//! Normals, planes and frames of the faces: computed when mesh, placement or light change, and only then.

use std::sync::PoisonError;

use tam_shaders::Pass;

use super::shading::{form_constant, module};
use crate::gpu::{FramesKey, GeometryKey, Gpu, Layouts, Offsets};
use crate::params::Form;
use crate::renderer::Draw;

/// Groups of invocations in a row of a dispatch.
const GROUPS_PER_ROW: u32 = 32_768;

/// Columns and rows of a dispatch of so many groups: a row alone takes too few.
pub(crate) fn group_rows(groups: u32) -> [u32; 2] {
    [groups.min(GROUPS_PER_ROW), groups.div_ceil(GROUPS_PER_ROW)]
}

/// The two compute passes, made when first needed.
#[derive(Default)]
pub(crate) struct Faces {
    made: Option<Pipelines>,
}

/// By form: hardened, literal.
struct Pipelines {
    geometry: [wgpu::ComputePipeline; 2],
    frames: [wgpu::ComputePipeline; 2],
}

impl Pipelines {
    fn new(gpu: &Gpu, layouts: &Layouts) -> Self {
        let pipelines = |pass: Pass, group: &wgpu::BindGroupLayout| {
            let module = module(gpu, pass);
            let layout = gpu.device.create_pipeline_layout(&wgpu::PipelineLayoutDescriptor {
                label: Some(pass.name()),
                bind_group_layouts: &[Some(&layouts.frame), Some(group)],
                immediate_size: 0,
            });
            [Form::Hardened, Form::Literal].map(|form| {
                gpu.compute_pipeline(&wgpu::ComputePipelineDescriptor {
                    label: Some(pass.name()),
                    layout: Some(&layout),
                    module: &module,
                    entry_point: Some("main"),
                    compilation_options: wgpu::PipelineCompilationOptions {
                        constants: &[("FORM", f64::from(form_constant(form)))],
                        ..Default::default()
                    },
                    cache: None,
                })
            })
        };
        Self {
            geometry: pipelines(Pass::FaceGeometry, &layouts.storage().face_geometry),
            frames: pipelines(Pass::FaceFrames, &layouts.storage().face_frames),
        }
    }
}

impl Faces {
    /// Makes the pipelines, if they are not made.
    pub(crate) fn make(&mut self, gpu: &Gpu, layouts: &Layouts) {
        self.made.get_or_insert_with(|| Pipelines::new(gpu, layouts));
    }

    /// What is out of date and read by a method; the frames only where they are.
    pub(crate) fn due(draw: &Draw<'_>) -> Due {
        let (scene, _) = &draw.scene;
        let geometry = GeometryKey {
            version: draw.mesh.version,
            literal: draw.form == Form::Literal,
            world_from_mesh: scene.world_from_mesh,
        };
        let key = FramesKey { geometry, lights: scene.lights, light_count: scene.light_count };
        let Some(placed) = &draw.placed else { return Due::default() };
        let computed = placed.computed.lock().unwrap_or_else(PoisonError::into_inner);
        Due {
            geometry: (computed.geometry != Some(geometry)).then_some(geometry),
            frames: (draw.variant.faces.frames && computed.frames != Some(key)).then_some(key),
        }
    }

    /// Records what is due.
    pub(crate) fn record(&self, pass: &mut wgpu::ComputePass<'_>, frame: &wgpu::BindGroup, draws: &[Draw<'_>]) {
        let Some(Pipelines { geometry, frames }) = &self.made else { return };
        for draw in draws {
            let (due, Some(placed)) = (Self::due(draw), &draw.placed) else { continue };
            if due.is_none() {
                continue;
            }
            let form = form_constant(draw.form) as usize;
            let groups = &placed.groups;
            let mut computed = placed.computed.lock().unwrap_or_else(PoisonError::into_inner);
            pass.set_bind_group(0, frame, &Offsets { scene: draw.scene.1, ..Offsets::default() }.of_group());
            let [columns, rows] = group_rows(draw.mesh.triangle_count().div_ceil(64));
            if due.geometry.is_some() {
                pass.set_pipeline(&geometry[form]);
                pass.set_bind_group(1, &groups.geometry, &[]);
                pass.dispatch_workgroups(columns, rows, 1);
                computed.geometry = due.geometry;
            }
            if due.frames.is_some() {
                pass.set_pipeline(&frames[form]);
                pass.set_bind_group(1, &groups.frames, &[]);
                pass.dispatch_workgroups(columns, rows, 1);
                computed.frames = due.frames;
            }
        }
    }
}

/// What of the faces is to be computed anew.
#[derive(Default)]
pub(crate) struct Due {
    geometry: Option<GeometryKey>,
    frames: Option<FramesKey>,
}

impl Due {
    pub(crate) fn is_none(&self) -> bool {
        self.geometry.is_none() && self.frames.is_none()
    }
}
