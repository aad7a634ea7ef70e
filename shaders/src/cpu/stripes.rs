//! Twin of `stripes.wgsl`: one line field over the whole surface, as wide as the tone asks, and a second one across it
//! in the dark. Knöppel and others, "Stripe patterns on surfaces", 2015.

use glam::{DVec2, DVec4};

use super::builtin::{mix, smoothstep};
use super::lib::barycentric::{Place, place_in_face};
use super::lib::light::darkness;
use super::lib::mapping::frame_place;
use super::lib::material::reflectance;
use super::lib::patches::{Patches, patches_at};
use super::lib::stripes::{FADE_FROM, FADE_TO, crossed_darkness, doubled_ink, stripe_phase, stripe_slope};
use super::lib::strokes::{patched_stroke, stroke_ink, stroke_reach};
use super::lib::surface::{FragmentIn, drawn, surface_point};
use super::{Bindings, Quad};
use crate::types::StripePhases;

/// The field of lines along.
pub const ALONG: u32 = 0;
/// The field of lines across.
pub const ACROSS: u32 = 1;
/// Strokes even out where lines get this close, in lines to the pixel.
pub const EVEN_FROM: f64 = 0.2_f32 as f64;

/// As [`doubled_ink`], with the strokes of the old line and of the new one that are next to the fragment.
pub fn varied_ink(b: &Bindings<'_>, patches: &Patches, field: u32, phase: f64, phase_per_px: f64, d: f64) -> f64 {
    let wanted = 1.0 / (phase_per_px * b.material.line_period_px).max(1e-6);
    let octave = wanted.log2().floor().clamp(0.0, 12.0);
    let f = (wanted / octave.exp2() - 1.0).clamp(0.0, 1.0);
    let lines = octave.exp2();
    let per_px = phase_per_px * lines;
    let variety = b.material.variety * (1.0 - smoothstep(EVEN_FROM, FADE_FROM, per_px));
    let k = 0.5 / per_px.max(1e-6);
    let row = (phase * lines).round_ties_even();
    let x = 2.0 * (phase * lines - row);
    let side = if x < 0.0 { -1.0 } else { 1.0 };
    let reach = 0.5 / k;
    let (row, rows) = (2 * row as i32, octave as u32 + 1);
    let mut ink = 0.0;
    if x.abs() - reach < stroke_reach(2.0 - f, d, variety) {
        let stroke = patched_stroke(b, patches, field, row, rows, variety);
        ink += stroke_ink(stroke, x, 2.0 - f, k, d, variety);
    }
    if 1.0 - x.abs() - reach < stroke_reach(f, d, variety) {
        let stroke = patched_stroke(b, patches, field, row + side as i32, rows, variety);
        ink += stroke_ink(stroke, x - side, f, k, d, variety);
    }
    mix(ink.min(1.0), d, smoothstep(FADE_FROM, FADE_TO, per_px))
}

/// Ink of one field; `patches` are those of the fragment where lines are made of strokes.
pub fn stripes_ink(
    b: &Bindings<'_>,
    patches: Option<&Patches>,
    field: u32,
    s: &StripePhases,
    place: &Place,
    d: f64,
) -> f64 {
    let slope = |dw| stripe_slope(s, place.weights, dw);
    let per_px = DVec2::new(slope(place.dx), slope(place.dy)).length();
    let phase = stripe_phase(s, place.weights);
    match patches {
        None => doubled_ink(phase, per_px, b.material.line_period_px, d),
        Some(patches) => varied_ink(b, patches, field, phase, per_px, d),
    }
}

/// Ink of both fields.
pub fn crossed_ink(b: &Bindings<'_>, face: usize, place: &Place, d: f64) -> f64 {
    let shares = crossed_darkness(d, b.material.cross_from);
    let patches = b.options.varied.then(|| patches_at(b.patches, face, place.weights));
    let ink = stripes_ink(b, patches.as_ref(), ALONG, &b.stripes.along[face], place, shares.x);
    if shares.y <= 0.0 {
        return ink;
    }
    1.0 - (1.0 - ink) * (1.0 - stripes_ink(b, patches.as_ref(), ACROSS, &b.stripes.across[face], place, shares.y))
}

/// Colour of one fragment of a quad, linear light.
pub fn fragment(b: &Bindings<'_>, quad: &Quad<FragmentIn>, lane: usize, front: bool) -> DVec4 {
    let point = surface_point(b.scene, b.material, &quad[lane], front);
    let p = quad.map(|input| frame_place(b.options.form, b.scene, input.p_world));
    let place = place_in_face(&b.mesh, point.face, p[lane], p.dpdx(lane), p.dpdy(lane));
    let d = darkness(b.scene, reflectance(b.material), point.p_world, point.normal, point.view);
    drawn(b.scene, b.material, crossed_ink(b, point.face, &place, d))
}
