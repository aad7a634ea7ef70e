//! What a method works with, in its ink's place.

use tam_shaders::cpu::DebugView as Shown;
use tam_shaders::{Feed, Pass};

use super::Variant;
use super::shading::method_variant;
use crate::gpu::{FaceData, GpuMesh, MapKind};
use crate::params::{DebugView, Follow, Mapping, Method, RenderParams};

/// The variant of a view. What the method or the mesh has nothing of is shown as none; nothing fails.
pub(super) fn variant(view: DebugView, params: &RenderParams, mesh: &GpuMesh) -> Variant {
    // `face-frame` lies by its frames, whatever the mapping of others.
    let mapping = if params.method == Method::FaceFrame { Mapping::Frames } else { params.mapping };
    let follow = if turns(params, mesh) { Follow::Light } else { Follow::Surface };
    let shown = shown(view, params.method, mapping, mesh);
    shown_as(shown, kind(view, params), &RenderParams { mapping, follow, ..*params })
}

/// The variant that shows this.
pub(super) fn shown_as(shown: Shown, kind: MapKind, params: &RenderParams) -> Variant {
    // Only directions are those of the mapping; all else is the same on three planes, whose vertices are the mesh's, but for
    // the footprint of its own uv.
    let mapping = match (shown, params.mapping) {
        (Shown::Frames, mapping) | (Shown::Level, mapping @ Mapping::Uv) => mapping,
        _ => Mapping::Triplanar,
    };
    let variant = Variant::new(Pass::Debug, kind).mapped(&RenderParams { mapping, ..*params });
    let variant = variant.with("DEBUG", shown as u32);
    match shown {
        Shown::Stripes => Variant { feed: Feed::Lines, fragment: "fragment_lines", ..variant },
        Shown::Adjacency | Shown::Triangles => Variant {
            feed: Feed::Faced,
            fragment: "fragment_faces",
            faces: FaceData { planes: true, frames: false },
            ..variant
        },
        _ => Variant { faces: FaceData { planes: false, frames: mapping == Mapping::Frames }, ..variant },
    }
}

/// Whether patches turn with the light.
fn turns(params: &RenderParams, mesh: &GpuMesh) -> bool {
    params.follow == Follow::Light && mesh.surface.follow(params.mapping) == Some(Follow::Light)
}

fn shown(view: DebugView, method: Method, mapping: Mapping, mesh: &GpuMesh) -> Shown {
    let mapped = method.takes_mapping() || method == Method::FaceFrame;
    let has_uv = mapping != Mapping::Uv || mesh.uv_density.is_some();
    let has_surface = !mapping.takes_surface() || mesh.surface.tiles_per_unit(mapping).is_some();
    match view {
        DebugView::Tone => Shown::Tone,
        // Lines of variable width are no samples.
        DebugView::Level if mapped && method != Method::Halftone && has_uv => Shown::Level,
        DebugView::Columns => Shown::Columns,
        DebugView::Frames if method == Method::Stripes && mesh.surface.has_stripes() => Shown::Stripes,
        DebugView::Frames if mapped && has_uv && has_surface => Shown::Frames,
        DebugView::Adjacency => Shown::Adjacency,
        DebugView::Triangles => Shown::Triangles,
        DebugView::Level | DebugView::Frames => Shown::None,
    }
}

/// Of which map tones and levels are shown: those that the method samples, else the map's own.
fn kind(view: DebugView, params: &RenderParams) -> MapKind {
    match (view, method_variant(params).kind) {
        (DebugView::Level, kind) | (DebugView::Columns, kind @ (MapKind::Packed | MapKind::FineColumns)) => kind,
        _ => MapKind::Columns,
    }
}
