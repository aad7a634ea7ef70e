//! Twin of `fine_tone.wgsl`: smooth tone from an array of many columns. Webb and others, "Fine tone control in hardware
//! hatching", NPAR 2002, the volume scheme.

use glam::{DVec2, DVec4};

use super::lib::blend::{lapped_ink, surface_ink};
use super::lib::columns::{column_coordinate, column_ink, map_level};
use super::lib::light::darkness;
use super::lib::mapping::{Mapped, mean_footprint};
use super::lib::material::reflectance;
use super::lib::patched::{lapped_of, overlap_of, patched_point};
use super::lib::surface::{FragmentIn, drawn, surface_point};
use super::{Bindings, Quad};

/// Ink of one pattern.
pub fn pattern_ink(b: &Bindings<'_>, uv: DVec2, tiles_per_px: f64, d: f64) -> f64 {
    let x = column_coordinate(b.options.form, b.material, d);
    column_ink(b.material, b.map, uv, map_level(b.material, tiles_per_px), x)
}

/// Colour of one fragment of a quad, linear light.
pub fn fragment(b: &Bindings<'_>, quad: &Quad<FragmentIn>, lane: usize, front: bool) -> DVec4 {
    let points = quad.map(|input| patched_point(b.scene, input, front));
    let point = &points[lane];
    let d = darkness(b.scene, reflectance(b.material), point.p_world, point.normal, point.view);
    let of_patch = |uv, tiles_per_px, d| pattern_ink(b, uv, tiles_per_px, d);
    let of_pattern = |mapped: &Quad<Mapped>, i: usize, d| {
        let mapped = &mapped[lane];
        pattern_ink(b, mapped.patterns[i].uv, mapped.tiles_per_px, d)
    };
    let ink = surface_ink(b, &points, overlap_of(&quad[lane]), lane, d, of_pattern, &of_patch);
    drawn(b.scene, b.material, ink)
}

/// The same in lapped textures.
pub fn fragment_lapped(b: &Bindings<'_>, input: &FragmentIn, front: bool) -> DVec4 {
    let point = surface_point(b.scene, input, front);
    let d = darkness(b.scene, reflectance(b.material), point.p_world, point.normal, point.view);
    let tiles_per_px = mean_footprint(b.options.form, b.scene, b.material, &point);
    let ink = |uv, tiles_per_px, d| pattern_ink(b, uv, tiles_per_px, d);
    drawn(b.scene, b.material, lapped_ink(b, &lapped_of(input), tiles_per_px, d, &ink))
}
