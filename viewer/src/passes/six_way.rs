//! Praun's blend of six columns.

use tam_shaders::Pass;

use super::Variant;
use super::shading::blend_constant;
use crate::gpu::MapKind;
use crate::params::RenderParams;

pub(super) fn variant(params: &RenderParams) -> Variant {
    Variant::new(Pass::SixWay, MapKind::Packed).mapped(params).with("BLEND", blend_constant(params.blend))
}
