//! Vertex buffers: what each feed of a pass is laid out as, and what a way to draw is fed with.

use std::ops::Range;

use tam_shaders::Feed;

const fn attribute(shader_location: u32, format: wgpu::VertexFormat, offset: u64) -> wgpu::VertexAttribute {
    wgpu::VertexAttribute { format, offset, shader_location }
}

const fn carried(array_stride: u64, attributes: &'static [wgpu::VertexAttribute]) -> Layout {
    wgpu::VertexBufferLayout { array_stride, step_mode: wgpu::VertexStepMode::Vertex, attributes }
}

type Layout = wgpu::VertexBufferLayout<'static>;

/// `VertexIn` of `lib/surface.wgsl`.
const PLACE: Layout =
    carried(16, &[attribute(0, wgpu::VertexFormat::Float32x3, 0), attribute(1, wgpu::VertexFormat::Uint32, 12)]);
const UV: Layout = carried(8, &[attribute(2, wgpu::VertexFormat::Float32x2, 0)]);
/// `PatchCorner`.
const PATCHES: Layout = carried(
    24,
    &[
        attribute(3, wgpu::VertexFormat::Snorm16x4, 0),
        attribute(4, wgpu::VertexFormat::Snorm16x4, 8),
        attribute(5, wgpu::VertexFormat::Unorm16x4, 16),
    ],
);
/// The same of lapped textures that are painted over these.
const OVER: Layout = carried(
    24,
    &[
        attribute(10, wgpu::VertexFormat::Snorm16x4, 0),
        attribute(11, wgpu::VertexFormat::Snorm16x4, 8),
        attribute(12, wgpu::VertexFormat::Unorm16x4, 16),
    ],
);
const SEEDS: Layout = carried(16, &[attribute(6, wgpu::VertexFormat::Uint32x4, 0)]);
/// `LineCorner`.
const LINES: Layout =
    carried(12, &[attribute(7, wgpu::VertexFormat::Float32x2, 0), attribute(8, wgpu::VertexFormat::Sint8x4, 8)]);
const ROWS: Layout = carried(16, &[attribute(9, wgpu::VertexFormat::Uint32x4, 0)]);

/// The vertex buffers of a feed, in order; none where vertices are pulled.
pub(crate) fn layouts(feed: Feed) -> &'static [Option<Layout>] {
    match feed {
        Feed::Vertices => const { &[Some(PLACE)] },
        Feed::Uvs => const { &[Some(PLACE), Some(UV)] },
        Feed::Corners => const { &[Some(PLACE), Some(PATCHES)] },
        Feed::Turning => const { &[Some(PLACE), Some(PATCHES), Some(SEEDS)] },
        Feed::Lapped => const { &[Some(PLACE), Some(PATCHES), Some(OVER)] },
        Feed::Lines => const { &[Some(PLACE), Some(LINES)] },
        Feed::Strokes => const { &[Some(PLACE), Some(LINES), Some(PATCHES), Some(SEEDS), Some(ROWS)] },
        Feed::Faces | Feed::Faced => &[],
    }
}

/// What an object is drawn with.
pub(crate) struct Fed<'a> {
    /// As [`layouts`] says.
    pub buffers: Vec<&'a wgpu::Buffer>,
    /// `None` where vertices are pulled, three to a face.
    pub indices: Option<&'a wgpu::Buffer>,
    /// By part of the mesh: indices, or vertices that are pulled.
    pub parts: Vec<Range<u32>>,
}
