//! What pictures are drawn into without a window, and reading them back.

use std::sync::OnceLock;

use tam_gen::srgb;

use super::views::{TargetFormats, TargetViews};
use super::{Gpu, GpuError};

/// Pixels of a target.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum PixelFormat {
    /// Eight bits per channel, sRGB-encoded: for pictures.
    Srgb8,
    /// Half floats, linear light: keeps NaN.
    Linear16,
    /// Floats, linear light: keeps NaN; takes neither lines nor more than one sample.
    Linear32,
}

impl PixelFormat {
    pub(crate) fn texture_format(self) -> wgpu::TextureFormat {
        match self {
            Self::Srgb8 => wgpu::TextureFormat::Rgba8UnormSrgb,
            Self::Linear16 => wgpu::TextureFormat::Rgba16Float,
            Self::Linear32 => wgpu::TextureFormat::Rgba32Float,
        }
    }

    fn bytes(self) -> u32 {
        match self {
            Self::Srgb8 => 4,
            Self::Linear16 => 8,
            Self::Linear32 => 16,
        }
    }
}

const DEPTH_FORMAT: wgpu::TextureFormat = wgpu::TextureFormat::Depth32Float;

/// A picture being drawn: colour and depth.
pub struct Target {
    /// Width and height in pixels.
    pub size: [u32; 2],
    /// Samples per pixel: 1 or 4.
    pub samples: u32,
    /// Of the finished pixels.
    pub format: PixelFormat,
    pub(crate) colour: wgpu::TextureView,
    pub(crate) multisampled: Option<wgpu::TextureView>,
    pub(crate) depth: wgpu::TextureView,
    texture: wgpu::Texture,
    /// Through which pixels come back.
    back: OnceLock<wgpu::Buffer>,
    row_bytes: u32,
}

impl Target {
    /// A target of this size.
    ///
    /// # Errors
    /// [`GpuError::TooLarge`] if a side is 0 or larger than the adapter takes, [`GpuError::Unfit`] for a number of samples
    /// other than 1 and 4 or for more than one sample of 32-bit floats.
    pub fn new(gpu: &Gpu, size: [u32; 2], samples: u32, format: PixelFormat) -> Result<Self, GpuError> {
        let limit = gpu.device.limits().max_texture_dimension_2d;
        for side in size {
            if side == 0 || side > limit {
                return Err(GpuError::TooLarge {
                    what: format!("a picture of {}x{}", size[0], size[1]),
                    wanted: u64::from(side),
                    limit: u64::from(limit),
                    adapter: gpu.adapter.to_string(),
                });
            }
        }
        if !matches!(samples, 1 | 4) || (samples > 1 && format == PixelFormat::Linear32) {
            return Err(GpuError::Unfit {
                adapter: gpu.adapter.to_string(),
                cause: format!("{samples} samples per pixel of {format:?}"),
            });
        }
        let row_bytes = (size[0] * format.bytes()).next_multiple_of(wgpu::COPY_BYTES_PER_ROW_ALIGNMENT);
        let bytes = u64::from(row_bytes) * u64::from(size[1]);
        let limit = gpu.device.limits().max_buffer_size;
        if bytes > limit {
            return Err(GpuError::TooLarge {
                what: format!("a picture of {}x{} (bytes)", size[0], size[1]),
                wanted: bytes,
                limit,
                adapter: gpu.adapter.to_string(),
            });
        }
        let pixels = format.texture_format();
        let multisampled = (samples > 1).then(|| {
            let usage = wgpu::TextureUsages::RENDER_ATTACHMENT;
            view(&texture(gpu, "colour samples", size, samples, pixels, usage, &[]))
        });
        let texture = finished(gpu, size, format);
        Ok(Self {
            size,
            samples,
            format,
            colour: view(&texture),
            multisampled,
            depth: formats_of(format, samples).depth_view(gpu, size),
            texture,
            back: OnceLock::new(),
            row_bytes,
        })
    }

    /// A target for another picture of this kind, which shares all but the finished pixels with this one: as long as a
    /// picture is drawn into one of them, none is into the other.
    pub fn beside(&self, gpu: &Gpu) -> Self {
        let texture = finished(gpu, self.size, self.format);
        Self {
            colour: view(&texture),
            multisampled: self.multisampled.clone(),
            depth: self.depth.clone(),
            texture,
            back: OnceLock::new(),
            ..*self
        }
    }

    /// The finished pixels, for a window to show.
    pub fn view(&self) -> &wgpu::TextureView {
        &self.colour
    }

    /// Their texture.
    #[cfg(feature = "app")]
    pub(crate) fn texture(&self) -> &wgpu::Texture {
        &self.texture
    }

    /// What a frame is drawn into.
    pub fn views(&self) -> TargetViews<'_> {
        let formats = formats_of(self.format, self.samples);
        match &self.multisampled {
            Some(samples) => {
                let resolve = Some(&self.colour);
                TargetViews { resolve, ..TargetViews::new(samples, &self.depth, self.size, formats) }
            }
            None => TargetViews::new(&self.colour, &self.depth, self.size, formats),
        }
    }

    /// Brings the finished pixels back. Waits for the device.
    ///
    /// # Errors
    /// [`GpuError::Lost`] or [`GpuError::Failed`].
    pub fn read(&self, gpu: &Gpu) -> Result<Picture, GpuError> {
        let back = self.back.get_or_init(|| {
            gpu.buffer(&wgpu::BufferDescriptor {
                label: Some("read back"),
                size: u64::from(self.row_bytes) * u64::from(self.size[1]),
                usage: wgpu::BufferUsages::COPY_DST | wgpu::BufferUsages::MAP_READ,
                mapped_at_creation: false,
            })
        });
        let mut encoder = gpu.device.create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
        encoder.copy_texture_to_buffer(
            self.texture.as_image_copy(),
            wgpu::TexelCopyBufferInfo {
                buffer: back,
                layout: wgpu::TexelCopyBufferLayout {
                    offset: 0,
                    bytes_per_row: Some(self.row_bytes),
                    rows_per_image: None,
                },
            },
            self.texture.size(),
        );
        gpu.queue.submit([encoder.finish()]);
        back.map_async(wgpu::MapMode::Read, .., |_| ());
        gpu.wait()?;
        let mapped = back.get_mapped_range(..).map_err(|error| GpuError::Failed(error.to_string()))?;
        let used = (self.size[0] * self.format.bytes()) as usize;
        let bytes: Vec<u8> =
            mapped.chunks_exact(self.row_bytes as usize).flat_map(|row| &row[..used]).copied().collect();
        drop(mapped);
        back.unmap();
        Ok(Picture { size: self.size, format: self.format, bytes })
    }
}

/// What finished pixels are kept in, also seen without the curve of sRGB where the device does that.
fn finished(gpu: &Gpu, size: [u32; 2], format: PixelFormat) -> wgpu::Texture {
    let usage = wgpu::TextureUsages::RENDER_ATTACHMENT
        | wgpu::TextureUsages::COPY_SRC
        | wgpu::TextureUsages::COPY_DST
        | wgpu::TextureUsages::TEXTURE_BINDING;
    let pixels = format.texture_format();
    let bytes = [pixels.remove_srgb_suffix()];
    let also: &[_] = if gpu.has_view_formats && bytes[0] != pixels { &bytes } else { &[] };
    texture(gpu, "colour", size, 1, pixels, usage, also)
}

fn texture(
    gpu: &Gpu,
    label: &str,
    size: [u32; 2],
    samples: u32,
    format: wgpu::TextureFormat,
    usage: wgpu::TextureUsages,
    view_formats: &[wgpu::TextureFormat],
) -> wgpu::Texture {
    gpu.texture(&wgpu::TextureDescriptor {
        label: Some(label),
        size: wgpu::Extent3d { width: size[0], height: size[1], depth_or_array_layers: 1 },
        mip_level_count: 1,
        sample_count: samples,
        dimension: wgpu::TextureDimension::D2,
        format,
        usage,
        view_formats,
    })
}

fn view(texture: &wgpu::Texture) -> wgpu::TextureView {
    texture.create_view(&wgpu::TextureViewDescriptor::default())
}

fn formats_of(format: PixelFormat, samples: u32) -> TargetFormats {
    TargetFormats { colour: format.texture_format(), depth: DEPTH_FORMAT, samples }
}

/// Pixels read back, by rows from the top.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Picture {
    /// Width and height.
    pub size: [u32; 2],
    /// What the bytes are.
    pub format: PixelFormat,
    /// Four channels a pixel; alpha is premultiplied.
    pub bytes: Vec<u8>,
}

impl Picture {
    /// As an image with straight alpha, sRGB-encoded.
    pub fn into_image(self) -> image::RgbaImage {
        let pixels = match self.format {
            PixelFormat::Srgb8 => self.bytes,
            _ => self.linear().iter().flat_map(|pixel| encode(*pixel)).collect(),
        };
        let mut image = image::RgbaImage::from_raw(self.size[0], self.size[1], pixels).unwrap_or_default();
        for pixel in image.pixels_mut().filter(|pixel| !matches!(pixel.0[3], 0 | 255)) {
            let alpha = f32::from(pixel.0[3]) / 255.0;
            for channel in &mut pixel.0[..3] {
                *channel = srgb::byte(srgb::linear(*channel) / alpha);
            }
        }
        image
    }

    /// Linear light, four channels a pixel, alpha premultiplied.
    pub fn linear(&self) -> Vec<[f32; 4]> {
        match self.format {
            PixelFormat::Srgb8 => self
                .bytes
                .chunks_exact(4)
                .map(|p| [srgb::linear(p[0]), srgb::linear(p[1]), srgb::linear(p[2]), f32::from(p[3]) / 255.0])
                .collect(),
            PixelFormat::Linear16 => self
                .bytes
                .chunks_exact(8)
                .map(|p| std::array::from_fn(|i| half::f16::from_le_bytes([p[2 * i], p[2 * i + 1]]).to_f32()))
                .collect(),
            PixelFormat::Linear32 => self
                .bytes
                .chunks_exact(16)
                .map(|p| {
                    std::array::from_fn(|i| f32::from_le_bytes([p[4 * i], p[4 * i + 1], p[4 * i + 2], p[4 * i + 3]]))
                })
                .collect(),
        }
    }
}

fn encode(pixel: [f32; 4]) -> [u8; 4] {
    [srgb::byte(pixel[0]), srgb::byte(pixel[1]), srgb::byte(pixel[2]), (pixel[3].clamp(0.0, 1.0) * 255.0).round() as u8]
}
