//! Lines along a field over the whole surface.

use tam_shaders::{Feed, Pass};

use super::Variant;
use crate::gpu::MapKind;
use crate::params::RenderParams;

/// Stripes need no map; the columns are bound in its place.
pub(super) fn variant(params: &RenderParams) -> Variant {
    let lines = Variant { feed: Feed::Lines, ..Variant::new(Pass::Stripes, MapKind::Columns) };
    if params.variety > 0.0 {
        return Variant { feed: Feed::Strokes, fragment: "fragment_strokes", ..lines };
    }
    lines
}
