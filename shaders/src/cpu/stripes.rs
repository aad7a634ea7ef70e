//! Twin of `stripes.wgsl`: one line field over the whole surface, as wide as the tone asks, and a second one across it
//! in the dark. Knöppel and others, "Stripe patterns on surfaces", 2015.

use glam::DVec4;

use super::builtin::{mix, smoothstep};
use super::lib::light::darkness;
use super::lib::material::{Material, reflectance};
use super::lib::patches::{OVERLAPS, Overlap};
use super::lib::striped::{Phase, phase_of};
use super::lib::stripes::{FADE_FROM, FADE_TO, crossed_darkness, doubled_ink};
use super::lib::strokes::{Line, patched_stroke, stroke_ink, stroke_reach};
use super::lib::surface::{FragmentIn, drawn, surface_point};
use super::{Bindings, Quad};

/// The field of lines along.
pub const ALONG: u32 = 0;
/// The field of lines across.
pub const ACROSS: u32 = 1;
/// Strokes even out where lines get this close, in lines to the pixel.
pub const EVEN_FROM: f64 = 0.2_f32 as f64;

/// The patches of a fragment, and what makes their rows out of phases.
pub type Counted<'a> = (&'a Overlap, [u32; OVERLAPS]);

/// As [`doubled_ink`], with the strokes of the old line and of the new one that are next to the fragment.
pub fn varied_ink(
    material: &Material,
    (overlap, patch_rows): Counted<'_>,
    field: u32,
    phase: f64,
    phase_per_px: f64,
    d: f64,
) -> f64 {
    let wanted = 1.0 / (phase_per_px * material.line_period_px).max(1e-6);
    let octave = wanted.log2().floor().clamp(0.0, 12.0);
    let f = (wanted / octave.exp2() - 1.0).clamp(0.0, 1.0);
    let lines = octave.exp2();
    let per_px = phase_per_px * lines;
    let variety = material.variety * (1.0 - smoothstep(EVEN_FROM, FADE_FROM, per_px));
    let k = 0.5 / per_px.max(1e-6);
    let row = (phase * lines).round_ties_even();
    let x = 2.0 * (phase * lines - row);
    let side = if x < 0.0 { -1.0 } else { 1.0 };
    let reach = 0.5 / k;
    let line = |row| Line { field, row, octave: octave as u32 + 1 };
    let row = 2 * row as i32;
    let mut ink = 0.0;
    if x.abs() - reach < stroke_reach(2.0 - f, d, variety) {
        let stroke = patched_stroke(material, overlap, patch_rows, line(row), variety);
        ink += stroke_ink(stroke, x, 2.0 - f, k, d, variety);
    }
    if 1.0 - x.abs() - reach < stroke_reach(f, d, variety) {
        let stroke = patched_stroke(material, overlap, patch_rows, line(row + side as i32), variety);
        ink += stroke_ink(stroke, x - side, f, k, d, variety);
    }
    mix(ink.min(1.0), d, smoothstep(FADE_FROM, FADE_TO, per_px))
}

/// Ink of both fields.
pub fn plain_ink(material: &Material, along: &Phase, across: &Phase, d: f64) -> f64 {
    let shares = crossed_darkness(d, material.cross_from);
    let of = |phase: &Phase, d| doubled_ink(phase.at, phase.slope.length(), material.line_period_px, d);
    let ink = of(along, shares.x);
    if shares.y <= 0.0 { ink } else { 1.0 - (1.0 - ink) * (1.0 - of(across, shares.y)) }
}

/// The same of lines made of strokes.
pub fn stroked_ink(material: &Material, counted: Counted<'_>, along: &Phase, across: &Phase, d: f64) -> f64 {
    let shares = crossed_darkness(d, material.cross_from);
    let of = |field, phase: &Phase, d| varied_ink(material, counted, field, phase.at, phase.slope.length(), d);
    let ink = of(ALONG, along, shares.x);
    if shares.y <= 0.0 { ink } else { 1.0 - (1.0 - ink) * (1.0 - of(ACROSS, across, shares.y)) }
}

/// The phases of both fields at one fragment of a quad.
pub fn phases(quad: &Quad<FragmentIn>, lane: usize) -> [Phase; 2] {
    let (uvs, rings) = (quad.map(|input| input.uv), quad.map(|input| input.ring));
    [
        phase_of(&uvs.map(|uv| uv.x), &rings, rings[lane].z, lane),
        phase_of(&uvs.map(|uv| uv.y), &rings, rings[lane].w, lane),
    ]
}

/// Colour of one fragment of a quad, linear light.
pub fn fragment(b: &Bindings<'_>, quad: &Quad<FragmentIn>, lane: usize, front: bool) -> DVec4 {
    let point = surface_point(b.scene, &quad[lane], front);
    let [along, across] = phases(quad, lane);
    let d = darkness(b.scene, reflectance(b.material), point.p_world, point.normal, point.view);
    drawn(b.scene, b.material, plain_ink(b.material, &along, &across, d))
}

/// The same of lines made of strokes.
pub fn fragment_strokes(b: &Bindings<'_>, quad: &Quad<FragmentIn>, lane: usize, front: bool) -> DVec4 {
    let point = surface_point(b.scene, &quad[lane], front);
    let [along, across] = phases(quad, lane);
    let d = darkness(b.scene, reflectance(b.material), point.p_world, point.normal, point.view);
    let counted = (&quad[lane].overlap, quad[lane].rows);
    drawn(b.scene, b.material, stroked_ink(b.material, counted, &along, &across, d))
}
