//! What pictures are drawn into and shown from: textures on the window's device, none of which is drawn into as long as
//! anybody looks at it.

use std::sync::Arc;
use std::sync::atomic::{AtomicU64, Ordering};

use image::RgbaImage;

use crate::gpu::{Gpu, GpuError, PixelFormat, Target};
use crate::{RenderError, Renderer};

/// Canvases that are kept to be drawn into again.
const KEPT: usize = 6;

/// A picture on the device.
pub struct Canvas {
    id: u64,
    gpu: Gpu,
    target: Target,
    /// What is shown where the device cannot see the picture itself without the curve of sRGB.
    copied: Option<wgpu::Texture>,
    shown: wgpu::TextureView,
}

/// The format in which a window shows pictures: their bytes, whose curve it knows.
const SHOWN: wgpu::TextureFormat = wgpu::TextureFormat::Rgba8Unorm;

impl Canvas {
    fn new(gpu: &Gpu, target: Target) -> Self {
        static MADE: AtomicU64 = AtomicU64::new(0);
        let copied = (!gpu.has_view_formats).then(|| {
            gpu.texture(&wgpu::TextureDescriptor {
                label: Some("shown"),
                size: target.texture().size(),
                mip_level_count: 1,
                sample_count: 1,
                dimension: wgpu::TextureDimension::D2,
                format: SHOWN,
                usage: wgpu::TextureUsages::COPY_DST
                    | wgpu::TextureUsages::COPY_SRC
                    | wgpu::TextureUsages::TEXTURE_BINDING,
                view_formats: &[],
            })
        });
        let seen = wgpu::TextureViewDescriptor {
            format: Some(SHOWN),
            // A view for sampling alone.
            usage: Some(wgpu::TextureUsages::TEXTURE_BINDING),
            ..wgpu::TextureViewDescriptor::default()
        };
        let shown = copied.as_ref().unwrap_or(target.texture()).create_view(&seen);
        Self { id: MADE.fetch_add(1, Ordering::Relaxed), gpu: gpu.clone(), target, copied, shown }
    }

    /// Tells canvases apart: no two have the same.
    pub(crate) fn id(&self) -> u64 {
        self.id
    }

    /// Width and height.
    pub fn size_px(&self) -> [u32; 2] {
        self.target.size
    }

    /// For the window.
    pub(crate) fn shown(&self) -> &wgpu::TextureView {
        &self.shown
    }

    /// What is drawn into.
    pub(super) fn target(&self) -> &Target {
        &self.target
    }

    /// Takes what lies right of a place from a picture of the same size.
    pub(super) fn take_right(&self, other: &Self, from_px: u32) {
        let [width, height] = self.target.size;
        let origin = wgpu::Origin3d { x: from_px.min(width), y: 0, z: 0 };
        let place =
            |texture| wgpu::TexelCopyTextureInfo { texture, mip_level: 0, origin, aspect: wgpu::TextureAspect::All };
        let extent = wgpu::Extent3d { width: width - origin.x, height, depth_or_array_layers: 1 };
        self.gpu.copy(place(other.target.texture()), place(self.target.texture()), extent);
    }

    /// The same picture, which nothing is drawn into any more.
    pub(super) fn copy(&self) -> Self {
        let copy = Self::new(&self.gpu, self.target.beside(&self.gpu));
        copy.take_right(self, 0);
        copy.finish();
        copy
    }

    /// Makes what was drawn what is shown.
    pub(super) fn finish(&self) {
        if let Some(copied) = &self.copied {
            let drawn = self.target.texture();
            self.gpu.copy(drawn.as_image_copy(), copied.as_image_copy(), drawn.size());
        }
    }

    /// Brings the picture back: straight alpha. Waits for the device.
    ///
    /// # Errors
    /// [`GpuError::Lost`] or [`GpuError::Failed`].
    pub fn read(&self) -> Result<RgbaImage, GpuError> {
        Ok(self.target.read(&self.gpu)?.into_image())
    }

    /// The same of what is shown.
    #[cfg(test)]
    pub(super) fn read_shown(&self) -> Result<RgbaImage, GpuError> {
        let shown = self.copied.as_ref().unwrap_or(self.target.texture());
        let back = self.target.beside(&self.gpu);
        self.gpu.copy(shown.as_image_copy(), back.texture().as_image_copy(), shown.size());
        Ok(back.read(&self.gpu)?.into_image())
    }
}

/// Canvases of some sizes.
#[derive(Default)]
pub(super) struct Canvases {
    /// The last one was made last.
    kept: Vec<Arc<Canvas>>,
}

impl Canvases {
    /// One of this size that nobody looks at.
    pub(super) fn free(
        &mut self,
        renderer: &Renderer,
        size_px: [u32; 2],
        samples: u32,
    ) -> Result<Arc<Canvas>, RenderError> {
        let fits = |canvas: &&Arc<Canvas>| (canvas.target.size, canvas.target.samples) == (size_px, samples);
        if let Some(free) = self.kept.iter().filter(fits).find(|canvas| Arc::strong_count(canvas) == 1) {
            return Ok(Arc::clone(free));
        }
        let target = match self.kept.iter().find(fits) {
            Some(canvas) => {
                let target = canvas.target.beside(&renderer.gpu);
                renderer.gpu.check()?;
                target
            }
            None => renderer.target(size_px, samples, PixelFormat::Srgb8)?,
        };
        if self.kept.len() >= KEPT {
            self.kept.remove(0);
        }
        let canvas = Arc::new(Canvas::new(&renderer.gpu, target));
        self.kept.push(Arc::clone(&canvas));
        Ok(canvas)
    }
}
