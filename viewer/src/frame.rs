//! A frame: the ordered list of its passes.

use crate::gpu::{GpuMap, GpuMesh, Target};
use crate::params::RenderParams;
use crate::passes::{Faces, Lines, Shading};
use crate::renderer::{RenderError, Renderer};
use crate::scene::Scene;
use crate::timer::FrameTimer;

impl Renderer {
    /// Draws a scene into a target; [`Target::read`] brings the pixels back.
    ///
    /// `maps` are those that materials name by number.
    ///
    /// # Errors
    /// [`RenderError`]: what the scene lacks, a map that the method cannot draw with, or a failed device.
    pub fn render(
        &mut self,
        scene: &Scene,
        params: &RenderParams,
        mesh: &GpuMesh,
        maps: &[&GpuMap],
        target: &Target,
    ) -> Result<(), RenderError> {
        self.render_timed(scene, params, mesh, maps, target, None)
    }

    /// The same, with a timer around all passes.
    ///
    /// # Errors
    /// As [`Renderer::render`].
    pub fn render_timed(
        &mut self,
        scene: &Scene,
        params: &RenderParams,
        mesh: &GpuMesh,
        maps: &[&GpuMap],
        target: &Target,
        timer: Option<&FrameTimer>,
    ) -> Result<(), RenderError> {
        let prepared = self.prepare(scene, params, mesh, maps, target.size)?;
        let Self { gpu, layouts, shading, lines, faces, scene_group, .. } = self;
        // Back faces of a closed mesh are never seen from outside.
        let culled = mesh.closed && scene.world_from_mesh.determinant() > 0.0;
        let pipeline = shading.pipeline(gpu, layouts, &prepared.variant, target.format, target.samples, culled);
        let has_lines = Lines::drawn(params).next().is_some();
        let line_pipeline = has_lines.then(|| lines.pipeline(gpu, target.format, target.samples).clone());

        let mut encoder = gpu.device.create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
        let with_frames = prepared.variant.frames;
        let due = Faces::due(&prepared.scene, mesh, params.form, with_frames);
        let computes = !due.is_none() || params.silhouettes.is_some();
        if computes {
            let mut pass = encoder.begin_compute_pass(&wgpu::ComputePassDescriptor {
                label: Some("before the frame"),
                timestamp_writes: timer.and_then(FrameTimer::begins),
            });
            faces.record(&mut pass, scene_group, mesh, &due);
            lines.list(&mut pass, scene_group, mesh, params);
        }
        {
            let colour = [Some(colour_attachment(scene, target))];
            let mut pass = encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
                label: Some("frame"),
                color_attachments: &colour,
                depth_stencil_attachment: Some(depth_attachment(target)),
                timestamp_writes: timer.and_then(|timer| timer.ends(computes)),
                occlusion_query_set: None,
                multiview_mask: None,
            });
            let materials =
                prepared.maps.iter().enumerate().map(|(part, map)| (Self::material_offset(part), &map.group));
            let mapping = params.needed_mapping().unwrap_or(params.mapping);
            Shading::record(&mut pass, pipeline, scene_group, mesh, mapping, &prepared.variant, materials);
            if let Some(line_pipeline) = line_pipeline {
                for kind in Lines::drawn(params) {
                    Lines::record(&mut pass, &line_pipeline, scene_group, mesh, kind);
                }
            }
        }
        if let Some(timer) = timer {
            timer.resolve(&mut encoder);
        }
        gpu.queue.submit([encoder.finish()]);
        gpu.check()?;
        Ok(())
    }
}

fn colour_attachment<'a>(scene: &Scene, target: &'a Target) -> wgpu::RenderPassColorAttachment<'a> {
    let [r, g, b] = scene.paper.map(f64::from);
    let clear = if scene.transparent { wgpu::Color::TRANSPARENT } else { wgpu::Color { r, g, b, a: 1.0 } };
    let (view, resolve_target, store) = match &target.multisampled {
        Some(samples) => (samples, Some(&target.colour), wgpu::StoreOp::Discard),
        None => (&target.colour, None, wgpu::StoreOp::Store),
    };
    wgpu::RenderPassColorAttachment {
        view,
        depth_slice: None,
        resolve_target,
        ops: wgpu::Operations { load: wgpu::LoadOp::Clear(clear), store },
    }
}

fn depth_attachment(target: &Target) -> wgpu::RenderPassDepthStencilAttachment<'_> {
    wgpu::RenderPassDepthStencilAttachment {
        view: &target.depth,
        depth_ops: Some(wgpu::Operations { load: wgpu::LoadOp::Clear(1.0), store: wgpu::StoreOp::Discard }),
        stencil_ops: None,
    }
}
