//! Twin of `six_way.wgsl`: tone at the vertices, six columns blended per fragment. Praun and others, "Real-Time
//! Hatching", 2001, section 5, and a student implementation of it.

use glam::{DVec2, DVec3, DVec4};

use super::lib::blend::{lapped_ink, surface_ink};
use super::lib::columns::{column_coordinate, map_level};
use super::lib::light::darkness;
use super::lib::mapping::{map_surface, mean_footprint, pattern_count};
use super::lib::material::{Material, column_tone, reflectance};
use super::lib::patched::{lapped_of, overlap_of, patched_point};
use super::lib::patches::Overlap;
use super::lib::surface::{FragmentIn, VertexOut, drawn, surface_point};
use super::{Bindings, MapImage, Mapping, Quad};

/// Weights of the six columns; white has what is missing to 1.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Weights {
    /// Columns 1 to 3.
    pub light: DVec3,
    /// Columns 4 to 6.
    pub dark: DVec3,
}

/// Weights of columns 1 to 6 for a place among them.
pub fn column_weights(x: f64) -> Weights {
    let tent = |columns: DVec3| (1.0 - (columns - x).abs()).max(DVec3::ZERO);
    Weights { light: tent(DVec3::new(1.0, 2.0, 3.0)), dark: tent(DVec3::new(4.0, 5.0, 6.0)) }
}

/// Ink of a map that packs columns 1 to 3 and 4 to 6 in the colours of two layers.
pub fn six_ink(map: &MapImage, uv: DVec2, level: f64, weights: &Weights) -> f64 {
    let light = map.sample_level(uv, 0, level).truncate();
    let dark = map.sample_level(uv, 1, level).truncate();
    light.dot(weights.light) + dark.dot(weights.dark)
}

/// Weights of the tone at a vertex.
pub fn vertex_weights(b: &Bindings<'_>, surface: &VertexOut) -> Weights {
    let n = surface.normal.normalize();
    let v = b.scene.to_camera(surface.p_world).normalize();
    let d = darkness(b.scene, reflectance(b.material), surface.p_world, n, v);
    column_weights(column_coordinate(b.options.form, b.material, d))
}

/// A vertex with the weights of its tone.
pub fn weighted(b: &Bindings<'_>, surface: VertexOut, overlap: Overlap) -> (VertexOut, Overlap, Weights) {
    (surface, overlap, vertex_weights(b, &surface))
}

/// The tone that interpolated weights stand for.
pub fn weighted_tone(material: &Material, weights: &Weights) -> f64 {
    let tones = |first: u32| DVec3::from([0, 1, 2].map(|k| column_tone(material, first + k)));
    weights.light.dot(tones(1)) + weights.dark.dot(tones(4))
}

/// Ink at a tone, for patterns that the blend draws at another one than the vertices'.
pub fn pattern_ink(b: &Bindings<'_>, uv: DVec2, tiles_per_px: f64, d: f64) -> f64 {
    let weights = column_weights(column_coordinate(b.options.form, b.material, d));
    six_ink(b.map, uv, map_level(b.material, tiles_per_px), &weights)
}

/// Colour of one fragment of a quad, linear light; `weights` are interpolated.
pub fn fragment(b: &Bindings<'_>, quad: &Quad<FragmentIn>, weights: &Weights, lane: usize, front: bool) -> DVec4 {
    let points = quad.map(|input| patched_point(b.scene, input, front));
    if b.options.mapping == Mapping::Patches {
        let of_patch = |uv, tiles_per_px, d| pattern_ink(b, uv, tiles_per_px, d);
        let ink = surface_ink(
            b,
            &points,
            overlap_of(&quad[lane]),
            lane,
            weighted_tone(b.material, weights),
            |_, _, _| 0.0,
            &of_patch,
        );
        return drawn(b.scene, b.material, ink);
    }
    let mapped = map_surface(b, &points, lane);
    let level = map_level(b.material, mapped.tiles_per_px);
    let patterns = &mapped.patterns[..pattern_count(b.options.mapping, &mapped)];
    let ink = patterns.iter().map(|pattern| pattern.weight * six_ink(b.map, pattern.uv, level, weights)).sum();
    drawn(b.scene, b.material, ink)
}

/// The same in lapped textures, by the tone of the vertices.
pub fn fragment_lapped(b: &Bindings<'_>, input: &FragmentIn, front: bool) -> DVec4 {
    let point = surface_point(b.scene, input, front);
    let tiles_per_px = mean_footprint(b.options.form, b.scene, b.material, &point);
    let ink = |uv, tiles_per_px, d| pattern_ink(b, uv, tiles_per_px, d);
    drawn(b.scene, b.material, lapped_ink(b, &lapped_of(input), tiles_per_px, input.tone, &ink))
}
