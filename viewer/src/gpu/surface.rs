//! A surface's patches and lines on the GPU: what corners carry, and how patches turn (bind group 3).

use std::sync::{Mutex, PoisonError};

use glam::DMat4;
use tam_shaders::{Feed, types};

use super::corners::{CornerBuffers, CornersOf};
use super::feeds::Fed;
use super::{Gpu, GpuError, Layouts};
use crate::params::{Follow, Mapping, Method, RenderParams};
use crate::surface::patches::turns::Turns;
use crate::surface::{Corners, Graph, Patches, Surface};

/// What a mesh's surface has on the GPU.
pub(crate) struct SurfaceBuffers {
    /// How what lies still is turned: not at all.
    still: wgpu::BindGroup,
    patches: Option<PatchBuffers>,
    lapped: Option<PatchBuffers>,
    /// Of lines, with patches where strokes are counted on them.
    lines: Option<CornerBuffers>,
    has_crossing_lines: bool,
}

struct PatchBuffers {
    corners: CornerBuffers,
    tiles_per_unit: f64,
    /// Those that turn with the light.
    turning: Option<Turns>,
    /// One for each object, where patches turn.
    tables: Mutex<Vec<TurnTable>>,
}

/// How patches turn where an object stands, and the group that has it.
#[derive(Clone)]
struct TurnTable {
    turns: wgpu::Texture,
    group: wgpu::BindGroup,
}

/// Texels in a row of the table of turns.
const TURNS_PER_ROW: u32 = 1023;

impl SurfaceBuffers {
    /// What a mesh without a surface has.
    pub(crate) fn none(gpu: &Gpu, layouts: &Layouts) -> Self {
        let still = TurnTable::new(gpu, layouts, 1).group;
        Self { still, patches: None, lapped: None, lines: None, has_crossing_lines: false }
    }

    /// Uploads what a surface has.
    ///
    /// # Errors
    /// [`GpuError::TooLarge`] if a buffer exceeds what the adapter has.
    pub(crate) fn new(gpu: &Gpu, layouts: &Layouts, mesh: CornersOf<'_>, surface: &Surface) -> Result<Self, GpuError> {
        let upload = |patches: &Option<Patches>| {
            patches.as_ref().map(|patches| PatchBuffers::new(gpu, mesh, &surface.graph, patches)).transpose()
        };
        let lines = surface.stripes.as_ref().filter(|stripes| !stripes.along.is_empty());
        let corners = lines.map(|stripes| Corners::of_stripes(mesh.triangles, stripes, surface.patches.as_ref()));
        Ok(Self {
            patches: upload(&surface.patches)?,
            lapped: upload(&surface.lapped)?,
            lines: corners.map(|corners| CornerBuffers::new(gpu, mesh, corners)).transpose()?,
            has_crossing_lines: lines.is_some_and(|stripes| !stripes.across.is_empty()),
            ..Self::none(gpu, layouts)
        })
    }

    fn of(&self, mapping: Mapping) -> Option<&PatchBuffers> {
        match mapping {
            Mapping::Patches => self.patches.as_ref(),
            Mapping::Lapped => self.lapped.as_ref(),
            Mapping::Uv | Mapping::Frames | Mapping::Triplanar => None,
        }
    }

    /// Moves all corners with the mesh.
    pub(crate) fn update(&self, gpu: &Gpu, mesh: CornersOf<'_>) {
        let patches = [&self.patches, &self.lapped].into_iter().flatten().map(|patches| &patches.corners);
        for corners in patches.chain(&self.lines) {
            corners.update(gpu, mesh);
        }
    }

    /// What a feed is drawn with in a mapping; none where the surface has nothing of it.
    pub(crate) fn fed(&self, feed: Feed, mapping: Mapping) -> Option<Fed<'_>> {
        match feed {
            Feed::Lines | Feed::Strokes => self.lines.as_ref()?.fed(feed),
            _ => self.of(mapping)?.corners.fed(feed),
        }
    }

    /// The group with which the `nth` object of a mesh is drawn, whose patches turn or lie still.
    pub(crate) fn group(&self, gpu: &Gpu, layouts: &Layouts, turns: bool, nth: usize) -> wgpu::BindGroup {
        let turning = self.patches.as_ref().filter(|patches| turns && patches.turning.is_some());
        turning.map_or_else(|| self.still.clone(), |patches| patches.table(gpu, layouts, nth).group)
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
        let TurnTable { turns: table, .. } = patches.table(gpu, layouts, nth);
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
        self.lines.is_some()
    }

    /// Whether lines can be made of strokes: on patches that lie along them.
    pub(crate) fn has_rows(&self) -> bool {
        self.lines.as_ref().is_some_and(CornerBuffers::has_rows)
    }

    /// Whether there are lines across it.
    pub(crate) fn has_crossing_stripes(&self) -> bool {
        self.has_crossing_lines
    }

    /// Bytes of all buffers.
    pub(crate) fn bytes(&self) -> u64 {
        let patches = [&self.patches, &self.lapped].into_iter().flatten().map(|patches| &patches.corners);
        patches.chain(&self.lines).map(CornerBuffers::bytes).sum()
    }

    /// Bytes of those that a way to draw reads.
    pub(crate) fn bytes_for(&self, params: &RenderParams) -> u64 {
        let corners = match params.method {
            Method::Stripes => self.lines.as_ref(),
            _ => params.needed_mapping().and_then(|mapping| self.of(mapping)).map(|patches| &patches.corners),
        };
        corners.map_or(0, CornerBuffers::bytes)
    }
}

impl PatchBuffers {
    fn new(gpu: &Gpu, mesh: CornersOf<'_>, graph: &Graph, patches: &Patches) -> Result<Self, GpuError> {
        Ok(Self {
            corners: CornerBuffers::new(gpu, mesh, Corners::of_patches(mesh.triangles, patches))?,
            tiles_per_unit: patches.tiles_per_unit,
            turning: (patches.follow == Follow::Light).then(|| Turns::new(graph, patches)),
            tables: Mutex::default(),
        })
    }

    /// The table of the `nth` object.
    fn table(&self, gpu: &Gpu, layouts: &Layouts, nth: usize) -> TurnTable {
        let mut tables = self.tables.lock().unwrap_or_else(PoisonError::into_inner);
        while tables.len() <= nth {
            tables.push(TurnTable::new(gpu, layouts, self.turning.as_ref().map_or(1, Turns::len)));
        }
        tables[nth].clone()
    }
}

impl TurnTable {
    fn new(gpu: &Gpu, layouts: &Layouts, turns: usize) -> Self {
        let rows = (turns as u32).div_ceil(TURNS_PER_ROW).max(1);
        let turns = gpu.texture(&wgpu::TextureDescriptor {
            label: Some("turns"),
            size: wgpu::Extent3d { width: TURNS_PER_ROW, height: rows, depth_or_array_layers: 1 },
            mip_level_count: 1,
            sample_count: 1,
            dimension: wgpu::TextureDimension::D2,
            format: wgpu::TextureFormat::Rgba32Float,
            usage: wgpu::TextureUsages::TEXTURE_BINDING | wgpu::TextureUsages::COPY_DST,
            view_formats: &[],
        });
        let view = turns.create_view(&wgpu::TextureViewDescriptor::default());
        let entry = wgpu::BindGroupEntry { binding: 2, resource: wgpu::BindingResource::TextureView(&view) };
        let group = gpu.bind_group(&wgpu::BindGroupDescriptor {
            label: Some("surface"),
            layout: &layouts.surface,
            entries: &[entry],
        });
        Self { turns, group }
    }
}
