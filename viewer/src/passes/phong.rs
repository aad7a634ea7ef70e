//! The yardstick: continuous grey.

use tam_shaders::Pass;

use super::Variant;
use crate::gpu::MapKind;

pub(super) fn variant() -> Variant {
    Variant::new(Pass::Phong, MapKind::Columns)
}
