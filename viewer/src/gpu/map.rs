//! A map on the GPU, laid out for each kind of method.

use std::sync::{Arc, Mutex};

use tam_gen::{GenerateError, Grid, StrokeMap};
use tam_shaders::types::MAX_COLUMNS;

use super::{Gpu, GpuError, Layouts};
use crate::maps::{HatchMap, stroke_texels, tone_table};

/// How a map lies in its texture.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum MapKind {
    /// Layer k holds columns k and k + 1 in two channels, column 0 being white: one sample gives both brackets.
    Columns,
    /// The same, of the array of many columns.
    FineColumns,
    /// Six columns in the colours of two layers (the student implementation of Praun 2001).
    Packed,
    /// Thresholds, and how much they change from texel to texel.
    Strokes,
}

/// Why a map cannot be drawn with.
#[derive(Debug, thiserror::Error)]
pub enum MapError {
    /// It has none of what the method draws with.
    #[error("the map `{map}` has no stroke map")]
    NoStrokeMap {
        /// The map.
        map: String,
    },
    /// Too many columns for an array.
    #[error("the map `{map}` has {columns} columns, and at most {MAX_COLUMNS} can be drawn")]
    TooManyColumns {
        /// The map.
        map: String,
        /// Its columns.
        columns: usize,
    },
    /// Its columns do not darken.
    #[error("the columns of the map `{map}` do not darken: column {column} has tone {tone:.3} after {before:.3}")]
    NotRising {
        /// The map.
        map: String,
        /// The column that is too light, from 1.
        column: usize,
        /// Its tone.
        tone: f64,
        /// The tone before it.
        before: f64,
    },
    /// Finer tones could not be made.
    #[error(transparent)]
    Generate(#[from] GenerateError),
    /// It does not fit the adapter.
    #[error(transparent)]
    Gpu(#[from] GpuError),
}

/// A map, uploaded in the kinds that are asked for.
pub struct GpuMap {
    /// The map itself.
    pub source: Arc<HatchMap>,
    uploaded: Mutex<Vec<(MapKind, Arc<MapTextures>)>>,
}

/// One kind of a map on the GPU.
pub(crate) struct MapTextures {
    pub group: wgpu::BindGroup,
    pub size_px: u32,
    pub level_count: u32,
    /// Tones of the columns behind white.
    pub tones: Vec<f64>,
    pub distribution_entries: usize,
    pub bytes: u64,
}

impl GpuMap {
    pub(crate) fn new(source: Arc<HatchMap>) -> Self {
        Self { source, uploaded: Mutex::default() }
    }

    /// Bytes of its textures on the GPU so far.
    pub fn bytes(&self) -> u64 {
        self.lock().iter().map(|(_, textures)| textures.bytes).sum()
    }

    fn lock(&self) -> std::sync::MutexGuard<'_, Vec<(MapKind, Arc<MapTextures>)>> {
        self.uploaded.lock().unwrap_or_else(std::sync::PoisonError::into_inner)
    }

    /// Its textures of a kind, uploaded at the first call.
    pub(crate) fn textures(&self, gpu: &Gpu, layouts: &Layouts, kind: MapKind) -> Result<Arc<MapTextures>, MapError> {
        let mut uploaded = self.lock();
        if let Some((_, textures)) = uploaded.iter().find(|(other, _)| *other == kind) {
            return Ok(Arc::clone(textures));
        }
        let layers = Layers::of(&self.source, kind)?;
        let textures = Arc::new(layers.upload(gpu, layouts, &self.source.name)?);
        uploaded.push((kind, Arc::clone(&textures)));
        Ok(textures)
    }
}

/// The texels of a map, as they are uploaded.
struct Layers {
    format: wgpu::TextureFormat,
    channels: u32,
    layer_count: u32,
    /// Finest first: side, and all layers one after another.
    levels: Vec<(u32, Vec<u8>)>,
    tones: Vec<f64>,
    distribution: Vec<Vec<[f32; 2]>>,
}

impl Layers {
    fn of(map: &HatchMap, kind: MapKind) -> Result<Self, MapError> {
        match kind {
            MapKind::Columns => Self::pairs(&map.name, &map.grid),
            MapKind::FineColumns => Self::pairs(&map.name, map.fine()?),
            MapKind::Packed => Self::packed(&map.name, &map.grid, &map.six_columns()),
            MapKind::Strokes => {
                let stroke_map =
                    map.stroke_map.as_ref().ok_or_else(|| MapError::NoStrokeMap { map: map.name.clone() })?;
                Ok(Self::strokes(stroke_map))
            }
        }
    }

    fn pairs(name: &str, grid: &Grid) -> Result<Self, MapError> {
        let columns = grid.columns();
        if columns > MAX_COLUMNS {
            return Err(MapError::TooManyColumns { map: name.to_owned(), columns });
        }
        rising(name, &grid.tones)?;
        let levels = grid.levels.iter().map(|level| {
            let mut texels = Vec::with_capacity(2 * columns * level.cells[0].len());
            for k in 0..columns {
                let lighter = k.checked_sub(1).map(|k| &level.cells[k]);
                texels.extend(
                    level.cells[k].iter().enumerate().flat_map(|(i, ink)| [lighter.map_or(0, |cell| cell[i]), *ink]),
                );
            }
            (level.size, texels)
        });
        Ok(Self {
            format: wgpu::TextureFormat::Rg8Unorm,
            channels: 2,
            layer_count: columns as u32,
            levels: levels.collect(),
            tones: grid.tones.clone(),
            distribution: Vec::new(),
        })
    }

    fn packed(name: &str, grid: &Grid, columns: &[usize]) -> Result<Self, MapError> {
        let tones: Vec<f64> = columns.iter().map(|column| grid.tones[*column]).collect();
        rising(name, &tones)?;
        let levels = grid.levels.iter().map(|level| {
            let texels = level.cells[0].len();
            let layer = |first: usize| {
                (0..texels).flat_map(move |texel| {
                    std::array::from_fn::<u8, 4, _>(|channel| {
                        let column = columns.get(first + channel).filter(|_| channel < 3);
                        column.map_or(0, |column| level.cells[*column][texel])
                    })
                })
            };
            (level.size, layer(0).chain(layer(3)).collect())
        });
        Ok(Self {
            format: wgpu::TextureFormat::Rgba8Unorm,
            channels: 4,
            layer_count: 2,
            levels: levels.collect(),
            tones,
            distribution: Vec::new(),
        })
    }

    fn strokes(map: &StrokeMap) -> Self {
        Self {
            format: wgpu::TextureFormat::Rg8Unorm,
            channels: 2,
            layer_count: 1,
            levels: stroke_texels(map),
            tones: vec![1.0],
            distribution: tone_table(map),
        }
    }

    fn upload(mut self, gpu: &Gpu, layouts: &Layouts, name: &str) -> Result<MapTextures, MapError> {
        let limits = gpu.device.limits();
        // OpenGL takes an array of six layers, or a multiple, for cube maps.
        let padding = u32::from(gpu.adapter.backend == "gl" && self.layer_count.is_multiple_of(6));
        let size_px = self.levels[0].0;
        for (what, wanted, limit) in [
            ("side in texels", size_px, limits.max_texture_dimension_2d),
            ("layers", self.layer_count + padding, limits.max_texture_array_layers),
        ] {
            if wanted > limit {
                return Err(MapError::Gpu(GpuError::TooLarge {
                    what: format!("the map `{name}` ({what})"),
                    wanted: u64::from(wanted),
                    limit: u64::from(limit),
                    adapter: gpu.adapter.to_string(),
                }));
            }
        }
        let extent = |side, layers| wgpu::Extent3d { width: side, height: side, depth_or_array_layers: layers };
        let usage = wgpu::TextureUsages::TEXTURE_BINDING | wgpu::TextureUsages::COPY_DST;
        let texture = gpu.texture(&wgpu::TextureDescriptor {
            label: Some(name),
            size: extent(size_px, self.layer_count + padding),
            mip_level_count: self.levels.len() as u32,
            sample_count: 1,
            dimension: wgpu::TextureDimension::D2,
            format: self.format,
            usage,
            view_formats: &[],
        });
        let mut bytes = 0;
        for (level, (side, texels)) in self.levels.iter().enumerate() {
            bytes += texels.len() as u64;
            gpu.queue.write_texture(
                wgpu::TexelCopyTextureInfo { mip_level: level as u32, ..texture.as_image_copy() },
                texels,
                wgpu::TexelCopyBufferLayout {
                    offset: 0,
                    bytes_per_row: Some(side * self.channels),
                    rows_per_image: Some(*side),
                },
                extent(*side, self.layer_count),
            );
        }
        let distribution_entries = self.distribution.first().map_or(0, Vec::len);
        if self.distribution.is_empty() {
            self.distribution.push(vec![[0.0; 2]]);
        }
        let table: Vec<[f32; 2]> = self.distribution.concat();
        let size = wgpu::Extent3d {
            width: self.distribution[0].len() as u32,
            height: self.distribution.len() as u32,
            depth_or_array_layers: 1,
        };
        let distribution = gpu.texture(&wgpu::TextureDescriptor {
            label: Some("distribution"),
            size,
            mip_level_count: 1,
            sample_count: 1,
            dimension: wgpu::TextureDimension::D2,
            format: wgpu::TextureFormat::Rg32Float,
            usage,
            view_formats: &[],
        });
        let rows = wgpu::TexelCopyBufferLayout {
            offset: 0,
            bytes_per_row: Some(size.width * 8),
            rows_per_image: Some(size.height),
        };
        gpu.queue.write_texture(distribution.as_image_copy(), bytemuck::cast_slice(&table), rows, size);
        bytes += table.len() as u64 * 8;

        let view = texture.create_view(&wgpu::TextureViewDescriptor {
            dimension: Some(wgpu::TextureViewDimension::D2Array),
            ..wgpu::TextureViewDescriptor::default()
        });
        let group = map_group(gpu, layouts, &view, &distribution);
        Ok(MapTextures {
            group,
            size_px,
            level_count: self.levels.len() as u32,
            tones: self.tones,
            distribution_entries,
            bytes,
        })
    }
}

fn map_group(gpu: &Gpu, layouts: &Layouts, map: &wgpu::TextureView, distribution: &wgpu::Texture) -> wgpu::BindGroup {
    let linear = wgpu::FilterMode::Linear;
    let repeat = wgpu::AddressMode::Repeat;
    let sampler = gpu.device.create_sampler(&wgpu::SamplerDescriptor {
        label: Some("map"),
        address_mode_u: repeat,
        address_mode_v: repeat,
        mag_filter: linear,
        min_filter: linear,
        mipmap_filter: wgpu::MipmapFilterMode::Linear,
        ..wgpu::SamplerDescriptor::default()
    });
    let table = distribution.create_view(&wgpu::TextureViewDescriptor::default());
    gpu.bind_group(&wgpu::BindGroupDescriptor {
        label: Some("map"),
        layout: &layouts.map,
        entries: &[
            wgpu::BindGroupEntry { binding: 0, resource: wgpu::BindingResource::TextureView(map) },
            wgpu::BindGroupEntry { binding: 1, resource: wgpu::BindingResource::Sampler(&sampler) },
            wgpu::BindGroupEntry { binding: 2, resource: wgpu::BindingResource::TextureView(&table) },
        ],
    })
}

/// Tones must rise, or no two columns bracket a tone.
fn rising(name: &str, tones: &[f64]) -> Result<(), MapError> {
    let mut before = 0.0;
    for (k, tone) in tones.iter().enumerate() {
        if tone.partial_cmp(&before) != Some(std::cmp::Ordering::Greater) {
            return Err(MapError::NotRising { map: name.to_owned(), column: k + 1, tone: *tone, before });
        }
        before = *tone;
    }
    Ok(())
}
