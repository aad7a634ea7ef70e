//! Suarez's light-aligned frames, in the three places where they can be made.

use tam_shaders::{Feed, Pass};

use super::Variant;
use super::shading::form_constant;
use crate::gpu::MapKind;
use crate::params::{FaceFrameForm, RenderParams};

pub(super) fn variant(params: &RenderParams) -> Variant {
    let fetched = Variant::new(Pass::FaceFrame, MapKind::Columns).with("FORM", form_constant(params.form));
    let fetched = Variant { feed: Feed::Faced, ..fetched };
    let vertex = Variant { feed: Feed::Faces, ..Variant::new(Pass::FaceFrameVertex, MapKind::Columns) };
    match params.frames_made() {
        FaceFrameForm::Fetched => fetched,
        FaceFrameForm::Vertex => vertex.with("FRAMES", 0),
        FaceFrameForm::VertexFetched => vertex.with("FRAMES", 1),
    }
}
