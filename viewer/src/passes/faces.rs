//! Normals, planes and frames of the faces: computed when mesh, placement or light change, and only then.

use tam_shaders::{Pass, types};

use super::shading::{form_constant, module};
use crate::gpu::{FramesKey, GeometryKey, Gpu, GpuMesh, Layouts};
use crate::params::Form;

/// Groups of 64 faces in a row of the dispatch.
const GROUPS_PER_ROW: u32 = 32_768;

/// The two compute passes, in both forms.
pub(crate) struct Faces {
    /// By form: hardened, literal.
    geometry: [wgpu::ComputePipeline; 2],
    frames: [wgpu::ComputePipeline; 2],
}

impl Faces {
    pub(crate) fn new(gpu: &Gpu, layouts: &Layouts) -> Self {
        let pipelines = |pass: Pass, group: &wgpu::BindGroupLayout| {
            let module = module(gpu, pass);
            let layout = gpu.device.create_pipeline_layout(&wgpu::PipelineLayoutDescriptor {
                label: Some(pass.name()),
                bind_group_layouts: &[Some(&layouts.scene), Some(group)],
                immediate_size: 0,
            });
            [Form::Hardened, Form::Literal].map(|form| {
                gpu.device.create_compute_pipeline(&wgpu::ComputePipelineDescriptor {
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
            geometry: pipelines(Pass::FaceGeometry, &layouts.face_geometry),
            frames: pipelines(Pass::FaceFrames, &layouts.face_frames),
        }
    }

    /// Records what is out of date; the frames only where a method reads them.
    pub(crate) fn record(
        &self,
        encoder: &mut wgpu::CommandEncoder,
        scene_group: &wgpu::BindGroup,
        scene: &types::Scene,
        mesh: &GpuMesh,
        form: Form,
        frames: bool,
    ) {
        let geometry = GeometryKey {
            version: mesh.version,
            literal: form == Form::Literal,
            world_from_mesh: scene.world_from_mesh,
        };
        let key = FramesKey { geometry, lights: scene.lights, light_count: scene.light_count };
        let mut computed = mesh.computed.lock().unwrap_or_else(std::sync::PoisonError::into_inner);
        let stale_geometry = computed.geometry != Some(geometry);
        let stale_frames = frames && computed.frames != Some(key);
        if !stale_geometry && !stale_frames {
            return;
        }
        let form = form_constant(form) as usize;
        let mut pass = encoder.begin_compute_pass(&wgpu::ComputePassDescriptor::default());
        pass.set_bind_group(0, scene_group, &[]);
        let groups = mesh.triangle_count.div_ceil(64);
        let rows = [groups.min(GROUPS_PER_ROW), groups.div_ceil(GROUPS_PER_ROW)];
        if stale_geometry {
            pass.set_pipeline(&self.geometry[form]);
            pass.set_bind_group(1, &mesh.groups.geometry, &[]);
            pass.dispatch_workgroups(rows[0], rows[1], 1);
            computed.geometry = Some(geometry);
        }
        if stale_frames {
            pass.set_pipeline(&self.frames[form]);
            pass.set_bind_group(1, &mesh.groups.frames, &[]);
            pass.dispatch_workgroups(rows[0], rows[1], 1);
            computed.frames = Some(key);
        }
    }
}
