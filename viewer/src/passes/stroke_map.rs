//! Freudenberg's threshold, of strokes or of lines.

use tam_shaders::Pass;

use super::Variant;
use super::shading::blend_constant;
use crate::gpu::MapKind;
use crate::params::RenderParams;

pub(super) fn strokes(params: &RenderParams) -> Variant {
    pattern(params, MapKind::Strokes, 0)
}

/// Lines need no map; the columns are bound in its place.
pub(super) fn lines(params: &RenderParams) -> Variant {
    pattern(params, MapKind::Columns, 1)
}

fn pattern(params: &RenderParams, kind: MapKind, pattern: u32) -> Variant {
    Variant::new(Pass::StrokeMap, kind)
        .mapped(params)
        .with("BLEND", blend_constant(params.blend))
        .with("PATTERN", pattern)
}
