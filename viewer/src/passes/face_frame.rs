//! Suarez's light-aligned frames, in the three places where they can be made.

use tam_shaders::Pass;

use super::Variant;
use super::shading::form_constant;
use crate::gpu::MapKind;
use crate::params::{FaceFrameForm, RenderParams};

pub(super) fn variant(params: &RenderParams) -> Variant {
    let form = form_constant(params.form);
    let fetched = Variant::new(Pass::FaceFrame, MapKind::Columns);
    let vertex = Variant { unindexed: true, ..Variant::new(Pass::FaceFrameVertex, MapKind::Columns) };
    match params.face_frame {
        FaceFrameForm::Fetched => fetched.with("FORM", form),
        FaceFrameForm::Vertex => vertex.with("FORM", form).with("FRAMES", 0),
        FaceFrameForm::VertexFetched => vertex.with("FORM", form).with("FRAMES", 1),
    }
}
