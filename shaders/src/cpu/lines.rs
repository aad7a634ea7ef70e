//! Twin of `lines.wgsl`: contour, border and crease lines, one quad per line. Praun and others, "Real-Time
//! Hatching", 2001, section 2.

use glam::{DVec2, DVec3, DVec4};

use super::lib::edges::{LineKind, LineStyle, end_world, line_kind};
use super::lib::mesh::Mesh;
use super::lib::scene::Scene;
use crate::types::Edge;

/// What the vertex stage hands on.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LineOut {
    /// Clip coordinates.
    pub clip: DVec4,
    /// Place on the screen.
    pub place_px: DVec2,
    /// One end of the line; the same at all four corners.
    pub from_px: DVec2,
    /// The other.
    pub to_px: DVec2,
    /// How wide it is drawn.
    pub width_px: f64,
}

/// Lines are drawn this many of their widths nearer to the camera, so that the surface beside them does not cut them.
pub const PULL_WIDTHS: f64 = 1.0;
/// How far contours stand clear of the surface, as a share of their soft edge: at 1 it hides nothing of them, and a thread
/// of paper parts them from dark surfaces; at -1 it hides all of that edge, here more, there less, as its own border has
/// steps. As little of it as leaves no thread.
pub const CONTOUR_CLEAR: f64 = -0.3;
/// What it hides of them in the mean, in pixels.
pub const CONTOUR_HIDDEN_PX: f64 = 0.245;
/// How much thinner lines are in the round ends by which neighbours join, in pixels: soft edges that lie over each other
/// would make joints thicker.
pub const END_INSET_PX: f64 = 0.5;

/// Clip place of a point pulled towards the camera: the depth of the nearer point at the screen place of the point
/// itself.
pub fn pulled_clip(scene: &Scene, style: &LineStyle, p_world: DVec3) -> DVec4 {
    let clip = scene.clip_from_world * p_world.extend(1.0);
    let towards = scene.to_camera(p_world);
    let depth = -towards.dot(scene.camera_forward);
    let pull = PULL_WIDTHS * style.width_px * scene.pixel_world_at_1 * depth;
    let nearer = scene.clip_from_world * (p_world + pull * towards.normalize()).extend(1.0);
    DVec4::new(clip.x, clip.y, nearer.z / nearer.w.max(1e-6) * clip.w, clip.w)
}

/// Place on the screen, y down.
pub fn px_from_clip(scene: &Scene, clip: DVec4) -> DVec2 {
    (0.5 + 0.5 * clip.truncate().truncate() / clip.w * DVec2::new(1.0, -1.0)) * scene.viewport_px
}

/// A corner, 0 ..= 3, of an edge's quad; outside of the clip volume where the edge is not drawn.
pub fn vertex(scene: &Scene, mesh: &Mesh<'_>, style: &LineStyle, edge: &Edge, corner: u32) -> LineOut {
    let hidden = DVec4::new(2.0, 2.0, 2.0, 1.0);
    let mut out =
        LineOut { clip: hidden, place_px: DVec2::ZERO, from_px: DVec2::ZERO, to_px: DVec2::ZERO, width_px: 0.0 };
    let a_world = end_world(scene, mesh, edge.a);
    let b_world = end_world(scene, mesh, edge.b);
    let a = pulled_clip(scene, style, a_world);
    let b = pulled_clip(scene, style, b_world);
    let kind = line_kind(scene, mesh, style, edge, 0.5 * (a_world + b_world));
    if a.w <= 1e-4 || b.w <= 1e-4 || kind == LineKind::None {
        return out;
    }
    let a_px = px_from_clip(scene, a);
    let b_px = px_from_clip(scene, b);
    let length_px = a_px.distance(b_px);
    let along = if length_px > 1e-6 { (b_px - a_px) / length_px } else { DVec2::X };
    let across = DVec2::new(-along.y, along.x);
    let side = match kind {
        LineKind::Right => 1.0,
        LineKind::Left => -1.0,
        LineKind::None | LineKind::Centred => 0.0,
    };
    out.width_px = style.width_px + if kind == LineKind::Centred { 0.0 } else { CONTOUR_HIDDEN_PX };
    let aside = (0.5 * out.width_px + CONTOUR_CLEAR * 0.5 * (across.x.abs() + across.y.abs())) * side;
    out.from_px = a_px + aside * across;
    out.to_px = b_px + aside * across;
    let reach = 0.5 * out.width_px + 1.0;
    let at_b = corner >= 2;
    let side = if corner % 2 == 1 { 1.0 } else { -1.0 };
    let middle = if at_b { out.to_px + along * reach } else { out.from_px - along * reach };
    out.place_px = middle + across * side * reach;
    let end = if at_b { b } else { a };
    let ndc = (out.place_px / scene.viewport_px * 2.0 - 1.0) * DVec2::new(1.0, -1.0);
    out.clip = DVec4::new(ndc.x * end.w, ndc.y * end.w, end.z, end.w);
    out
}

/// Integral of max(x, 0).
pub fn ramp(x: f64) -> f64 {
    let above = x.max(0.0);
    0.5 * above * above
}

/// Share of a pixel on the lower side of a straight edge `x` px above its middle: its square as seen along the edge is a
/// trapezoid, two boxes folded with each other.
pub fn share_below(x: f64, normal: DVec2) -> f64 {
    let a = normal.x.abs().max(normal.y.abs());
    let b = normal.x.abs().min(normal.y.abs()).max(0.01);
    let (outer, inner) = (0.5 * (a + b), 0.5 * (a - b));
    let sum = ramp(x + outer) - ramp(x + inner) - ramp(x - inner) + ramp(x - outer);
    (sum / (a * b)).clamp(0.0, 1.0)
}

/// Share of a pixel covered by a line with round ends; thinner than a pixel it fades instead of breaking up.
pub fn line_coverage(place: DVec2, from_px: DVec2, to_px: DVec2, width_px: f64) -> f64 {
    let v = to_px - from_px;
    let length_px = v.length();
    let along = if length_px > 1e-6 { v / length_px } else { DVec2::X };
    let at = (place - from_px).dot(along);
    let beyond = (-at).max(at - length_px);
    let normal = along.perp();
    let beside = (place - from_px).dot(normal);
    if beyond <= 0.0 {
        return share_below(0.5 * width_px - beside, normal) - share_below(-0.5 * width_px - beside, normal);
    }
    let distance_px = DVec2::new(beyond, beside).length();
    (0.5 * width_px + 0.5 - END_INSET_PX - distance_px).max(0.0).min(width_px.min(1.0))
}

/// Colour of a fragment, linear light, alpha not multiplied in.
pub fn fragment(style: &LineStyle, input: &LineOut) -> DVec4 {
    let coverage = line_coverage(input.place_px, input.from_px, input.to_px, input.width_px);
    style.colour.truncate().extend(style.colour.w * coverage)
}
