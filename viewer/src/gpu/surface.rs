//! A surface's patches on the GPU: bind group 3.

use wgpu::util::DeviceExt;

use super::{Gpu, GpuError, Layouts};
use crate::params::Mapping;
use crate::surface::{Patches, Surface};

/// What a mesh's surface has on the GPU.
pub(crate) struct SurfaceBuffers {
    empty: wgpu::BindGroup,
    patches: Option<PatchBuffers>,
    lapped: Option<PatchBuffers>,
}

struct PatchBuffers {
    group: wgpu::BindGroup,
    tiles_per_unit: f64,
    bytes: u64,
}

impl SurfaceBuffers {
    /// Uploads what a surface has.
    ///
    /// # Errors
    /// [`GpuError::TooLarge`] if a buffer exceeds what the adapter binds.
    pub(crate) fn new(gpu: &Gpu, layouts: &Layouts, surface: Option<&Surface>) -> Result<Self, GpuError> {
        let upload = |patches: Option<&Patches>| patches.map(|patches| PatchBuffers::new(gpu, layouts, patches));
        Ok(Self {
            empty: group(gpu, layouts, &[0; 4], &[0; 16]),
            patches: upload(surface.and_then(|surface| surface.patches.as_ref())).transpose()?,
            lapped: upload(surface.and_then(|surface| surface.lapped.as_ref())).transpose()?,
        })
    }

    fn of(&self, mapping: Mapping) -> Option<&PatchBuffers> {
        match mapping {
            Mapping::Patches => self.patches.as_ref(),
            Mapping::Lapped => self.lapped.as_ref(),
            Mapping::Uv | Mapping::Frames | Mapping::Triplanar => None,
        }
    }

    /// The group that a mapping draws with.
    pub(crate) fn group(&self, mapping: Mapping) -> &wgpu::BindGroup {
        self.of(mapping).map_or(&self.empty, |patches| &patches.group)
    }

    /// Repeats of the tile per unit for which a mapping's patches were made; `None` where there are none.
    pub(crate) fn tiles_per_unit(&self, mapping: Mapping) -> Option<f64> {
        self.of(mapping).map(|patches| patches.tiles_per_unit)
    }

    /// Bytes of all buffers.
    pub(crate) fn bytes(&self) -> u64 {
        [&self.patches, &self.lapped].into_iter().flatten().map(|patches| patches.bytes).sum()
    }
}

impl PatchBuffers {
    fn new(gpu: &Gpu, layouts: &Layouts, patches: &Patches) -> Result<Self, GpuError> {
        gpu.fits("the patches of the mesh's faces", patches.bytes())?;
        let entries = patches.packed();
        Ok(Self {
            group: group(gpu, layouts, bytemuck::cast_slice(&patches.starts), bytemuck::cast_slice(&entries)),
            tiles_per_unit: patches.tiles_per_unit,
            bytes: patches.bytes(),
        })
    }
}

fn group(gpu: &Gpu, layouts: &Layouts, starts: &[u8], entries: &[u8]) -> wgpu::BindGroup {
    let buffer = |label: &str, contents: &[u8]| {
        gpu.device.create_buffer_init(&wgpu::util::BufferInitDescriptor {
            label: Some(label),
            contents,
            usage: wgpu::BufferUsages::STORAGE,
        })
    };
    let buffers = [buffer("patch starts", starts), buffer("patch entries", entries)];
    let entries: Vec<wgpu::BindGroupEntry<'_>> = buffers
        .iter()
        .enumerate()
        .map(|(binding, buffer)| wgpu::BindGroupEntry { binding: binding as u32, resource: buffer.as_entire_binding() })
        .collect();
    gpu.device.create_bind_group(&wgpu::BindGroupDescriptor {
        label: Some("surface"),
        layout: &layouts.surface,
        entries: &entries,
    })
}
