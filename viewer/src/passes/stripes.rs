//! Lines along a field over the whole surface.

use tam_shaders::Pass;

use super::Variant;
use super::shading::form_constant;
use crate::gpu::MapKind;
use crate::params::RenderParams;

/// Stripes need no map; the columns are bound in its place.
pub(super) fn variant(params: &RenderParams) -> Variant {
    let plain = Variant::new(Pass::Stripes, MapKind::Columns).with("FORM", form_constant(params.form));
    plain.with("VARIED", u32::from(params.variety > 0.0))
}
