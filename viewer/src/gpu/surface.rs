//! A surface's patches and stripes on the GPU: bind group 3.

use std::sync::{Mutex, PoisonError};

use glam::DMat4;
use tam_shaders::types::{self, PatchEntry, StripePhases};

use super::{Gpu, GpuError, Layouts};
use crate::params::{Follow, Mapping, Method, RenderParams};
use crate::surface::patches::PatchVertices;
use crate::surface::patches::turns::Turns;
use crate::surface::{Graph, Patches, Stripes, Surface};

/// What a mesh's surface has on the GPU.
pub(crate) struct SurfaceBuffers {
    empty: wgpu::BindGroup,
    patches: Option<PatchBuffers>,
    lapped: Option<PatchBuffers>,
    stripes: StripeBuffers,
}

struct PatchBuffers {
    lists: Lists,
    /// Of the corners; `None` where fragments find them by face.
    indices: Option<wgpu::Buffer>,
    tiles_per_unit: f64,
    /// Whether rows of stripes are known on them.
    has_rows: bool,
    /// Those that turn with the light.
    turning: Option<Turns>,
    /// The first object's; where patches turn, each object has its own.
    tables: Mutex<Vec<TurnTable>>,
    bytes: u64,
}

/// What the shaders read of patches; what is not needed is a record that stands for none.
struct Lists {
    starts: wgpu::Buffer,
    entries: wgpu::Buffer,
    corners: wgpu::Buffer,
}

/// How patches turn where an object stands, and the group that has it.
#[derive(Clone)]
struct TurnTable {
    turns: wgpu::Texture,
    group: wgpu::BindGroup,
}

/// Texels in a row of the table of turns.
const TURNS_PER_ROW: u32 = 1023;

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
    pub(crate) fn new(
        gpu: &Gpu,
        layouts: &Layouts,
        triangles: &[[u32; 3]],
        surface: Option<&Surface>,
    ) -> Result<Self, GpuError> {
        let stripes = StripeBuffers::new(gpu, surface.and_then(|surface| surface.stripes.as_ref()))?;
        let upload = |patches: Option<&Patches>| {
            let graph = surface.map(|surface| &surface.graph);
            graph
                .zip(patches)
                .map(|(graph, patches)| PatchBuffers::new(gpu, layouts, triangles, (graph, patches), &stripes))
        };
        Ok(Self {
            empty: group(gpu, layouts, &Lists::new(gpu, None, None), &turn_table(gpu, 1), &stripes),
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

    /// The group with which a mapping draws the `nth` object of a mesh; the stripes are in each.
    pub(crate) fn group(&self, gpu: &Gpu, layouts: &Layouts, mapping: Mapping, nth: usize) -> wgpu::BindGroup {
        let patches = self.of(mapping);
        patches.map_or_else(|| self.empty.clone(), |patches| patches.table(gpu, layouts, &self.stripes, nth).group)
    }

    /// The index buffer of what corners see of the patches that blend; `None` where there are none.
    pub(crate) fn corner_indices(&self) -> Option<&wgpu::Buffer> {
        self.patches.as_ref()?.indices.as_ref()
    }

    /// Repeats of the tile per unit for which a mapping's patches were made; `None` where there are none.
    pub(crate) fn tiles_per_unit(&self, mapping: Mapping) -> Option<f64> {
        self.of(mapping).map(|patches| patches.tiles_per_unit)
    }

    /// What a mapping's patches follow.
    pub(crate) fn follow(&self, mapping: Mapping) -> Option<Follow> {
        self.of(mapping).map(|patches| if patches.turning.is_some() { Follow::Light } else { Follow::Surface })
    }

    /// Turns the patches that follow the light where the `nth` object stands; `staging` is only memory.
    pub(crate) fn turn(
        &self,
        gpu: &Gpu,
        layouts: &Layouts,
        scene: &types::Scene,
        world_from_mesh: DMat4,
        nth: usize,
        staging: &mut Vec<[f32; 4]>,
    ) {
        let Some(patches) = &self.patches else { return };
        let Some(turns) = &patches.turning else { return };
        turns.under(&scene.into(), world_from_mesh, staging);
        let TurnTable { turns: table, .. } = patches.table(gpu, layouts, &self.stripes, nth);
        let size = table.size();
        staging.resize((size.width * size.height) as usize, [0.0; 4]);
        let rows = wgpu::TexelCopyBufferLayout {
            offset: 0,
            bytes_per_row: Some(size.width * 16),
            rows_per_image: Some(size.height),
        };
        gpu.queue.write_texture(table.as_image_copy(), bytemuck::cast_slice(staging), rows, size);
    }

    /// Whether there are lines along the field.
    pub(crate) fn has_stripes(&self) -> bool {
        self.stripes.some[0]
    }

    /// Whether lines can be made of strokes: on patches that lie along them.
    pub(crate) fn has_rows(&self) -> bool {
        self.patches.as_ref().is_some_and(|patches| patches.has_rows && patches.turning.is_none())
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

    /// Bytes of those that a way to draw reads.
    pub(crate) fn bytes_for(&self, params: &RenderParams) -> u64 {
        let patches = params.needed_mapping().and_then(|mapping| self.of(mapping)).map_or(0, |patches| patches.bytes);
        let [along, across] = [&self.stripes.along, &self.stripes.across].map(wgpu::Buffer::size);
        let stripes = if params.method == Method::Stripes { along } else { 0 };
        patches + stripes + if stripes > 0 && params.cross_from.is_some() { across } else { 0 }
    }
}

impl PatchBuffers {
    fn new(
        gpu: &Gpu,
        layouts: &Layouts,
        triangles: &[[u32; 3]],
        (graph, patches): (&Graph, &Patches),
        stripes: &StripeBuffers,
    ) -> Result<Self, GpuError> {
        let vertices = (!patches.lapped).then(|| PatchVertices::new(triangles, patches));
        // Rows of stripes are found by face.
        let by_face = (patches.lapped || !patches.rows.is_empty()).then_some(patches);
        let bytes = vertices.as_ref().map_or(0, PatchVertices::bytes) + by_face.map_or(0, Patches::bytes);
        gpu.fits("the patches of the mesh's faces", bytes)?;
        let lists = Lists::new(gpu, by_face, vertices.as_ref());
        let indices = vertices.map(|vertices| {
            gpu.buffer_of(&wgpu::util::BufferInitDescriptor {
                label: Some("patch indices"),
                contents: bytemuck::cast_slice(&vertices.indices),
                usage: wgpu::BufferUsages::INDEX,
            })
        });
        let turning = (patches.follow == Follow::Light).then(|| Turns::new(graph, patches));
        let this = Self {
            lists,
            indices,
            turning,
            tables: Mutex::default(),
            tiles_per_unit: patches.tiles_per_unit,
            has_rows: !patches.rows.is_empty(),
            bytes,
        };
        this.table(gpu, layouts, stripes, 0);
        Ok(this)
    }

    /// The table of the `nth` object; patches that lie still have one for all.
    fn table(&self, gpu: &Gpu, layouts: &Layouts, stripes: &StripeBuffers, nth: usize) -> TurnTable {
        let nth = if self.turning.is_some() { nth } else { 0 };
        let mut tables = self.tables.lock().unwrap_or_else(PoisonError::into_inner);
        while tables.len() <= nth {
            let turns = turn_table(gpu, self.turning.as_ref().map_or(1, Turns::len));
            let group = group(gpu, layouts, &self.lists, &turns, stripes);
            tables.push(TurnTable { turns, group });
        }
        tables[nth].clone()
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
    gpu.buffer_of(&wgpu::util::BufferInitDescriptor {
        label: Some(label),
        contents,
        usage: wgpu::BufferUsages::STORAGE,
    })
}

fn turn_table(gpu: &Gpu, turns: usize) -> wgpu::Texture {
    let rows = (turns as u32).div_ceil(TURNS_PER_ROW).max(1);
    gpu.texture(&wgpu::TextureDescriptor {
        label: Some("turns"),
        size: wgpu::Extent3d { width: TURNS_PER_ROW, height: rows, depth_or_array_layers: 1 },
        mip_level_count: 1,
        sample_count: 1,
        dimension: wgpu::TextureDimension::D2,
        format: wgpu::TextureFormat::Rgba32Float,
        usage: wgpu::TextureUsages::TEXTURE_BINDING | wgpu::TextureUsages::COPY_DST,
        view_formats: &[],
    })
}

impl Lists {
    fn new(gpu: &Gpu, by_face: Option<&Patches>, vertices: Option<&PatchVertices>) -> Self {
        let none = [PatchEntry::default()];
        let starts = by_face.map_or_else(|| vec![0; 4], Patches::packed_starts);
        let entries = by_face.map_or_else(|| none.to_vec(), Patches::packed);
        let corners = vertices.map_or_else(|| vec![[0; 4]; 2], PatchVertices::packed);
        Self {
            starts: storage(gpu, "patch starts", bytemuck::cast_slice(&starts)),
            entries: storage(gpu, "patch entries", bytemuck::cast_slice(&entries)),
            corners: storage(gpu, "patch corners", bytemuck::cast_slice(&corners)),
        }
    }
}

fn group(
    gpu: &Gpu,
    layouts: &Layouts,
    lists: &Lists,
    turns: &wgpu::Texture,
    stripes: &StripeBuffers,
) -> wgpu::BindGroup {
    let buffers =
        [(0, &lists.starts), (1, &lists.entries), (4, &stripes.along), (5, &stripes.across), (6, &lists.corners)];
    let turns = turns.create_view(&wgpu::TextureViewDescriptor::default());
    let mut entries: Vec<wgpu::BindGroupEntry<'_>> = buffers
        .iter()
        .map(|(binding, buffer)| wgpu::BindGroupEntry { binding: *binding, resource: buffer.as_entire_binding() })
        .collect();
    entries.push(wgpu::BindGroupEntry { binding: 2, resource: wgpu::BindingResource::TextureView(&turns) });
    gpu.bind_group(&wgpu::BindGroupDescriptor { label: Some("surface"), layout: &layouts.surface, entries: &entries })
}
