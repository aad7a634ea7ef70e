//! A frame: the ordered list of its passes.

use crate::gpu::{GpuMap, GpuMesh, Target, TargetViews};
use crate::object::Object;
use crate::params::RenderParams;
use crate::passes::{Faces, Lines};
use crate::renderer::{RenderError, Renderer};
use crate::scene::Scene;
use crate::timer::FrameTimer;

impl Renderer {
    /// Records a frame into a caller's encoder and views: objects in a scene, whose own mesh, ink and materials are not
    /// looked at. It neither submits nor waits, and touches no error callback.
    ///
    /// `maps` are those that materials name by number. Records of the frame are written through the queue: submit the
    /// encoder before the next frame is recorded, or that one's views and materials count for both.
    ///
    /// # Errors
    /// [`RenderError`]: what an object lacks, a map that its method cannot draw with, or a format that takes no such
    /// picture; then nothing was recorded.
    pub fn record(
        &mut self,
        encoder: &mut wgpu::CommandEncoder,
        scene: &Scene,
        objects: &[Object<'_>],
        maps: &[&GpuMap],
        into: &TargetViews<'_>,
    ) -> Result<(), RenderError> {
        self.record_timed(encoder, scene, objects, maps, into, None)
    }

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
        self.render_objects(scene, &[Object::of(scene, params, mesh)], maps, target, timer)
    }

    /// Draws many objects into a target.
    ///
    /// # Errors
    /// As [`Renderer::render`].
    pub fn render_objects(
        &mut self,
        scene: &Scene,
        objects: &[Object<'_>],
        maps: &[&GpuMap],
        target: &Target,
        timer: Option<&FrameTimer>,
    ) -> Result<(), RenderError> {
        self.render_into(scene, objects, maps, &target.views(), timer)
    }

    /// Draws many objects into any views.
    ///
    /// # Errors
    /// As [`Renderer::render`].
    pub fn render_into(
        &mut self,
        scene: &Scene,
        objects: &[Object<'_>],
        maps: &[&GpuMap],
        into: &TargetViews<'_>,
        timer: Option<&FrameTimer>,
    ) -> Result<(), RenderError> {
        let mut encoder = self.gpu.device.create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
        self.record_timed(&mut encoder, scene, objects, maps, into, timer)?;
        self.gpu.queue.submit([encoder.finish()]);
        self.gpu.check()?;
        Ok(())
    }

    fn record_timed(
        &mut self,
        encoder: &mut wgpu::CommandEncoder,
        scene: &Scene,
        objects: &[Object<'_>],
        maps: &[&GpuMap],
        into: &TargetViews<'_>,
        timer: Option<&FrameTimer>,
    ) -> Result<(), RenderError> {
        let draws = self.prepare(scene, objects, maps, into)?;
        let group = self.uniforms.group();
        let computes = draws.iter().any(|draw| !Faces::due(draw).is_none() || Lines::lists(draw));
        if computes {
            let mut pass = encoder.begin_compute_pass(&wgpu::ComputePassDescriptor {
                label: Some("before the frame"),
                timestamp_writes: timer.and_then(FrameTimer::begins),
            });
            self.faces.record(&mut pass, group, &draws);
            self.lines.list(&mut pass, group, &draws);
        }
        {
            let colour = [Some(into.colour_attachment(scene))];
            let mut pass = encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
                label: Some("frame"),
                color_attachments: &colour,
                depth_stencil_attachment: Some(into.depth_attachment()),
                timestamp_writes: timer.and_then(|timer| timer.ends(computes)),
                occlusion_query_set: None,
                multiview_mask: None,
            });
            if let Some([left, top, width, height]) = into.region_px {
                pass.set_scissor_rect(left, top, width, height);
            }
            self.shading.record(&mut pass, group, &draws);
            self.lines.record(&mut pass, group, into.formats, &draws);
        }
        if let Some(timer) = timer {
            timer.resolve(encoder);
        }
        Ok(())
    }
}
