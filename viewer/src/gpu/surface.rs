//! A surface's patches and stripes on the GPU: bind group 3.

use tam_shaders::types::StripePhases;
use wgpu::util::DeviceExt;

use super::{Gpu, GpuError, Layouts};
use crate::params::Mapping;
use crate::surface::{Patches, Stripes, Surface};

/// What a mesh's surface has on the GPU.
pub(crate) struct SurfaceBuffers {
    empty: wgpu::BindGroup,
    patches: Option<PatchBuffers>,
    lapped: Option<PatchBuffers>,
    stripes: StripeBuffers,
}

struct PatchBuffers {
    group: wgpu::BindGroup,
    tiles_per_unit: f64,
    bytes: u64,
}

/// Of the two fields; a single record stands for none.
struct StripeBuffers {
    along: wgpu::Buffer,
    across: wgpu::Buffer,
    /// Which of the two there are.
    some: [bool; 2],
}

impl SurfaceBuffers {
    /// Uploads what a surface has.
    ///
    /// # Errors
    /// [`GpuError::TooLarge`] if a buffer exceeds what the adapter binds.
    pub(crate) fn new(gpu: &Gpu, layouts: &Layouts, surface: Option<&Surface>) -> Result<Self, GpuError> {
        let stripes = StripeBuffers::new(gpu, surface.and_then(|surface| surface.stripes.as_ref()))?;
        let upload =
            |patches: Option<&Patches>| patches.map(|patches| PatchBuffers::new(gpu, layouts, patches, &stripes));
        Ok(Self {
            empty: group(gpu, layouts, &[0; 4], &[0; 16], &stripes),
            patches: upload(surface.and_then(|surface| surface.patches.as_ref())).transpose()?,
            lapped: upload(surface.and_then(|surface| surface.lapped.as_ref())).transpose()?,
            stripes,
        })
    }

    fn of(&self, mapping: Mapping) -> Option<&PatchBuffers> {
        match mapping {
            Mapping::Patches => self.patches.as_ref(),
            Mapping::Lapped => self.lapped.as_ref(),
            Mapping::Uv | Mapping::Frames | Mapping::Triplanar => None,
        }
    }

    /// The group that a mapping draws with; the stripes are in each.
    pub(crate) fn group(&self, mapping: Mapping) -> &wgpu::BindGroup {
        self.of(mapping).map_or(&self.empty, |patches| &patches.group)
    }

    /// Repeats of the tile per unit for which a mapping's patches were made; `None` where there are none.
    pub(crate) fn tiles_per_unit(&self, mapping: Mapping) -> Option<f64> {
        self.of(mapping).map(|patches| patches.tiles_per_unit)
    }

    /// Whether there are lines along the field.
    pub(crate) fn has_stripes(&self) -> bool {
        self.stripes.some[0]
    }

    /// Whether there are lines across it.
    pub(crate) fn has_crossing_stripes(&self) -> bool {
        self.stripes.some[1]
    }

    /// Bytes of all buffers.
    pub(crate) fn bytes(&self) -> u64 {
        let patches: u64 = [&self.patches, &self.lapped].into_iter().flatten().map(|patches| patches.bytes).sum();
        patches + self.stripes.along.size() + self.stripes.across.size()
    }
}

impl PatchBuffers {
    fn new(gpu: &Gpu, layouts: &Layouts, patches: &Patches, stripes: &StripeBuffers) -> Result<Self, GpuError> {
        gpu.fits("the patches of the mesh's faces", patches.bytes())?;
        let entries = patches.packed();
        Ok(Self {
            group: group(gpu, layouts, bytemuck::cast_slice(&patches.starts), bytemuck::cast_slice(&entries), stripes),
            tiles_per_unit: patches.tiles_per_unit,
            bytes: patches.bytes(),
        })
    }
}

impl StripeBuffers {
    fn new(gpu: &Gpu, stripes: Option<&Stripes>) -> Result<Self, GpuError> {
        let upload = |label, phases: &[StripePhases]| {
            gpu.fits("the stripes of the mesh's faces", size_of_val(phases) as u64)?;
            let none = [StripePhases::default()];
            Ok(storage(gpu, label, bytemuck::cast_slice(if phases.is_empty() { &none } else { phases })))
        };
        let (along, across) = stripes.map_or((&[][..], &[][..]), |stripes| (&stripes.along, &stripes.across));
        let some = [!along.is_empty(), !across.is_empty()];
        Ok(Self { along: upload("stripes along", along)?, across: upload("stripes across", across)?, some })
    }
}

fn storage(gpu: &Gpu, label: &str, contents: &[u8]) -> wgpu::Buffer {
    gpu.device.create_buffer_init(&wgpu::util::BufferInitDescriptor {
        label: Some(label),
        contents,
        usage: wgpu::BufferUsages::STORAGE,
    })
}

fn group(gpu: &Gpu, layouts: &Layouts, starts: &[u8], entries: &[u8], stripes: &StripeBuffers) -> wgpu::BindGroup {
    let patches = [storage(gpu, "patch starts", starts), storage(gpu, "patch entries", entries)];
    let buffers = [(0, &patches[0]), (1, &patches[1]), (4, &stripes.along), (5, &stripes.across)];
    let entries =
        buffers.map(|(binding, buffer)| wgpu::BindGroupEntry { binding, resource: buffer.as_entire_binding() });
    gpu.device.create_bind_group(&wgpu::BindGroupDescriptor {
        label: Some("surface"),
        layout: &layouts.surface,
        entries: &entries,
    })
}
