//! What frames are drawn into: anyone's views, of any format that takes a picture.

use super::Gpu;
use crate::renderer::RenderError;
use crate::scene::Scene;

/// Formats of what is drawn into.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct TargetFormats {
    /// Of the colour, and of what it is resolved into.
    pub colour: wgpu::TextureFormat,
    /// Of the depth.
    pub depth: wgpu::TextureFormat,
    /// Samples per pixel of colour and depth.
    pub samples: u32,
}

/// Views that a frame is drawn into, all of the same size.
#[derive(Clone, Copy, Debug)]
pub struct TargetViews<'a> {
    /// Of the colour.
    pub colour: &'a wgpu::TextureView,
    /// What the samples of a pixel become one in; `None` where pixels have one.
    pub resolve: Option<&'a wgpu::TextureView>,
    /// Of the depth, 0 near to 1 far; it holds nothing afterwards unless it lasts.
    pub depth: &'a wgpu::TextureView,
    /// Width and height.
    pub size_px: [u32; 2],
    /// Of the views.
    pub formats: TargetFormats,
    /// Whether the paper is laid first, else the frame is drawn over what is there, behind what is nearer.
    pub clears: bool,
    /// Whether samples and depths are needed afterwards, as another frame is drawn over this one.
    pub lasts: bool,
    /// What is drawn of the frame: left, top, width and height within the views; `None`: all of it. The paper is laid on
    /// the whole of them.
    pub region_px: Option<[u32; 4]>,
}

impl TargetFormats {
    /// A depth texture for pictures of this size.
    pub fn depth_view(self, gpu: &Gpu, size_px: [u32; 2]) -> wgpu::TextureView {
        let texture = gpu.texture(&wgpu::TextureDescriptor {
            label: Some("depth"),
            size: wgpu::Extent3d { width: size_px[0], height: size_px[1], depth_or_array_layers: 1 },
            mip_level_count: 1,
            sample_count: self.samples,
            dimension: wgpu::TextureDimension::D2,
            format: self.depth,
            usage: wgpu::TextureUsages::RENDER_ATTACHMENT,
            view_formats: &[],
        });
        texture.create_view(&wgpu::TextureViewDescriptor::default())
    }

    /// Whether a device draws into these; `blended` where lines are drawn.
    pub(crate) fn check(self, gpu: &Gpu, blended: bool) -> Result<(), RenderError> {
        let features = gpu.device.features();
        let Self { colour, depth, samples } = self;
        let lacks = |format: wgpu::TextureFormat, lacks| Err(RenderError::Format { format, lacks });
        // Formats that the device was not opened for promise nothing.
        if !features.contains(colour.required_features()) {
            return lacks(colour, "is no format of this device");
        }
        let of_colour = colour.guaranteed_format_features(features);
        let is_colour = !colour.is_depth_stencil_format() && !colour.is_compressed();
        if !is_colour || !of_colour.allowed_usages.contains(wgpu::TextureUsages::RENDER_ATTACHMENT) {
            return lacks(colour, "takes no colours");
        }
        if colour.sample_type(None, Some(features)).is_none_or(is_integer) {
            return lacks(colour, "takes whole numbers instead of colours");
        }
        if blended && !of_colour.flags.contains(wgpu::TextureFormatFeatureFlags::BLENDABLE) {
            return lacks(colour, "blends no lines");
        }
        if !depth.has_depth_aspect() {
            return lacks(depth, "holds no depth");
        }
        for format in [colour, depth] {
            if !format.guaranteed_format_features(features).flags.sample_count_supported(samples) {
                return lacks(format, "has no such number of samples per pixel");
            }
        }
        Ok(())
    }
}

fn is_integer(kind: wgpu::TextureSampleType) -> bool {
    matches!(kind, wgpu::TextureSampleType::Sint | wgpu::TextureSampleType::Uint)
}

impl<'a> TargetViews<'a> {
    /// All of a view of one sample per pixel, cleared before.
    pub fn new(
        colour: &'a wgpu::TextureView,
        depth: &'a wgpu::TextureView,
        size_px: [u32; 2],
        formats: TargetFormats,
    ) -> Self {
        Self { colour, resolve: None, depth, size_px, formats, clears: true, lasts: false, region_px: None }
    }

    pub(crate) fn colour_attachment(&self, scene: &Scene) -> wgpu::RenderPassColorAttachment<'_> {
        let [r, g, b] = scene.paper.map(f64::from);
        let paper = if scene.transparent { wgpu::Color::TRANSPARENT } else { wgpu::Color { r, g, b, a: 1.0 } };
        let load = if self.clears { wgpu::LoadOp::Clear(paper) } else { wgpu::LoadOp::Load };
        // Samples that were made one are needed no more, unless something else is drawn over them.
        let spent = self.resolve.is_some() && !self.lasts;
        wgpu::RenderPassColorAttachment {
            view: self.colour,
            depth_slice: None,
            resolve_target: self.resolve,
            ops: wgpu::Operations { load, store: if spent { wgpu::StoreOp::Discard } else { wgpu::StoreOp::Store } },
        }
    }

    pub(crate) fn depth_attachment(&self) -> wgpu::RenderPassDepthStencilAttachment<'_> {
        let ops = wgpu::Operations {
            load: if self.clears { wgpu::LoadOp::Clear(1.0) } else { wgpu::LoadOp::Load },
            store: if self.lasts { wgpu::StoreOp::Store } else { wgpu::StoreOp::Discard },
        };
        // Frames use no stencil; what a caller keeps there stays.
        let stencil_ops = self
            .formats
            .depth
            .has_stencil_aspect()
            .then_some(wgpu::Operations { load: wgpu::LoadOp::Load, store: wgpu::StoreOp::Store });
        wgpu::RenderPassDepthStencilAttachment { view: self.depth, depth_ops: Some(ops), stencil_ops }
    }
}
