//! Twin of `lib/blend.wgsl`: patterns that overlap, by union or linearly.

use glam::DVec2;

use super::mapping::{Mapped, map_surface, mean_footprint, pattern_count};
use super::material::tile_uv;
use super::patched::Lapped;
use super::patches::{OVERLAPS, Overlap, copies, overlap_weights, seed_turn, turned_uv};
use super::surface::Point;
use crate::cpu::builtin::mix;
use crate::cpu::{Bindings, Blend, Mapping, Options, Quad};

/// What is left of the light at a darkness, as an exponent of 2: what the patterns of a union have in common.
pub fn log2_light(d: f64) -> f64 {
    (1.0 - d).max(1e-6).log2()
}

/// The darkness at which a pattern of this weight takes part, so that the union of all has the darkness of that light.
pub fn union_darkness(light: f64, weight: f64) -> f64 {
    1.0 - (weight * light).exp2()
}

/// Ink of all patterns; `pattern_ink(i, darkness)` is that of pattern `i` at a darkness.
pub fn blended_ink(options: Options, mapped: &Mapped, d: f64, pattern_ink: impl Fn(usize, f64) -> f64) -> f64 {
    let linear = options.blend == Blend::Linear || options.mapping == Mapping::Frames;
    let mut sum = 0.0;
    let mut clear = 1.0;
    let count = pattern_count(options.mapping, mapped);
    for (i, pattern) in mapped.patterns[..count].iter().enumerate() {
        if linear {
            sum += pattern.weight * pattern_ink(i, d);
        } else {
            let reduced = union_darkness(log2_light(d), pattern.weight);
            clear *= 1.0 - pattern_ink(i, reduced);
        }
    }
    if linear { sum } else { 1.0 - clear }
}

/// Ink of a pattern: place on the tile, footprint, darkness.
pub type PatternInk<'a> = &'a dyn Fn(DVec2, f64, f64) -> f64;

/// What the strokes of one patch leave of the paper, 1 where it has no share; of a linear blend the ink that they add.
pub fn patch_ink(
    b: &Bindings<'_>,
    place: DVec2,
    seed: u32,
    share: f64,
    tiles_per_px: f64,
    d: f64,
    pattern_ink: PatternInk<'_>,
) -> f64 {
    let linear = b.options.blend == Blend::Linear;
    let mut ink = if linear { 0.0 } else { 1.0 };
    if share <= 0.0 {
        return ink;
    }
    for copy in 0..copies(b.options.follow) {
        let turn = seed_turn(b.options.follow, b.turns, seed, copy);
        let weight = share * turn.w;
        if weight > 0.0 {
            let uv = turned_uv(b.material, place, turn);
            if linear {
                ink += weight * pattern_ink(uv, tiles_per_px, d);
            } else {
                ink *= 1.0 - pattern_ink(uv, tiles_per_px, union_darkness(log2_light(d), weight));
            }
        }
    }
    ink
}

/// Patches, independent of each other.
pub fn patches_ink(b: &Bindings<'_>, overlap: &Overlap, tiles_per_px: f64, d: f64, pattern_ink: PatternInk<'_>) -> f64 {
    let shares = overlap_weights(overlap.behind).to_array();
    let inks = (0..OVERLAPS)
        .map(|i| patch_ink(b, overlap.places[i], overlap.seeds[i], shares[i], tiles_per_px, d, pattern_ink));
    if b.options.blend == Blend::Linear { inks.sum() } else { 1.0 - inks.product::<f64>() }
}

/// One lapped texture painted over what lies under it.
pub fn painted_ink(under: f64, alpha: f64, ink: impl Fn() -> f64) -> f64 {
    if alpha <= 0.0 { under } else { mix(under, ink(), alpha.min(1.0)) }
}

/// Lapped textures, painted one over the other.
pub fn lapped_ink(b: &Bindings<'_>, lapped: &Lapped, tiles_per_px: f64, d: f64, pattern_ink: PatternInk<'_>) -> f64 {
    [&lapped.first, &lapped.then].into_iter().flat_map(|of| (0..OVERLAPS).map(move |i| (of, i))).fold(
        0.0,
        |under, (overlap, i)| {
            let place = tile_uv(b.material, overlap.places[i]);
            painted_ink(under, overlap.behind[i], || pattern_ink(place, tiles_per_px, d))
        },
    )
}

/// Ink of whatever lies on the surface at one fragment of a quad. `of_pattern` gives the ink of pattern `i` of the
/// mappings whose places the quad shares, `of_patch` that of a patch.
pub fn surface_ink(
    b: &Bindings<'_>,
    points: &Quad<Point>,
    overlap: &Overlap,
    lane: usize,
    d: f64,
    of_pattern: impl Fn(&Quad<Mapped>, usize, f64) -> f64,
    of_patch: PatternInk<'_>,
) -> f64 {
    let point = &points[lane];
    let form = b.options.form;
    if b.options.mapping == Mapping::Patches {
        return patches_ink(b, overlap, mean_footprint(form, b.scene, b.material, point), d, of_patch);
    }
    let mapped = Quad::from_fn(|lane| map_surface(b, points, lane));
    blended_ink(b.options, &mapped[lane], d, |i, d| of_pattern(&mapped, i, d))
}
