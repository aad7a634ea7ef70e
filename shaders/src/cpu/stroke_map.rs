//! Twin of `stroke_map.wgsl`: one sample and a threshold, or lines whose width follows the tone. Freudenberg,
//! "Real-Time Stroke Textures", SIGGRAPH 2001 sketch.

use glam::{DVec2, DVec4};

use super::lib::blend::{lapped_ink, surface_ink};
use super::lib::columns::map_level;
use super::lib::halftone::{halftone_ink, halftone_threshold};
use super::lib::light::darkness;
use super::lib::mapping::{Mapped, mean_footprint};
use super::lib::material::reflectance;
use super::lib::patched::{lapped_of, overlap_of, patched_point};
use super::lib::surface::{FragmentIn, drawn, surface_point};
use super::lib::threshold::{equalised, threshold_centred, threshold_one_sided};
use super::{Bindings, Form, Mapping, PatternKind, Quad};

/// Where a fragment samples a pattern.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sampled {
    /// Place on the tile.
    pub uv: DVec2,
    /// Footprint of a pixel.
    pub tiles_per_px: f64,
}

/// Ink of one pattern for one fragment of a quad. The slope follows the change of the threshold from texel to texel.
pub fn pattern_ink(b: &Bindings<'_>, at: &Quad<Sampled>, lane: usize, d: f64) -> f64 {
    let here = at[lane];
    if b.options.pattern == PatternKind::Lines {
        if b.options.form == Form::Literal {
            let lines = (b.material.size_px / b.material.line_period_px).floor();
            return threshold_one_sided(d, halftone_threshold(here.uv.y, lines), b.material.slope);
        }
        let t = at.map(|at| at.uv.y);
        let t_per_px = match b.options.mapping {
            Mapping::Uv | Mapping::Triplanar => t.dpdx(lane).hypot(t.dpdy(lane)),
            Mapping::Frames | Mapping::Patches | Mapping::Lapped => here.tiles_per_px,
        };
        return halftone_ink(here.uv.y, t_per_px, b.material.line_period_px, d);
    }
    let level = map_level(b.material, here.tiles_per_px);
    let sampled = b.map.sample_level(here.uv, 0, level);
    if b.options.form == Form::Literal {
        return threshold_one_sided(d, sampled.x, b.material.slope);
    }
    let theta = equalised(b.material, b.distribution, sampled.x, level);
    let texels_per_px = here.tiles_per_px * b.material.size_px * (-level).exp2();
    threshold_centred(d, theta.share, theta.rate * sampled.y * texels_per_px)
}

/// Colour of one fragment of a quad, linear light.
pub fn fragment(b: &Bindings<'_>, quad: &Quad<FragmentIn>, lane: usize, front: bool) -> DVec4 {
    let points = quad.map(|input| patched_point(b.scene, input, front));
    let point = &points[lane];
    let d = darkness(b.scene, reflectance(b.material), point.p_world, point.normal, point.view);
    let of_pattern = |mapped: &Quad<Mapped>, i: usize, d| {
        let at = mapped.map(|mapped| Sampled { uv: mapped.patterns[i].uv, tiles_per_px: mapped.tiles_per_px });
        pattern_ink(b, &at, lane, d)
    };
    let of_patch = |uv, tiles_per_px, d| pattern_ink(b, &Quad::from_fn(|_| Sampled { uv, tiles_per_px }), lane, d);
    let ink = surface_ink(b, &points, overlap_of(&quad[lane]), lane, d, of_pattern, &of_patch);
    drawn(b.scene, b.material, ink)
}

/// The same in lapped textures.
pub fn fragment_lapped(b: &Bindings<'_>, input: &FragmentIn, front: bool) -> DVec4 {
    let point = surface_point(b.scene, input, front);
    let d = darkness(b.scene, reflectance(b.material), point.p_world, point.normal, point.view);
    let tiles_per_px = mean_footprint(b.options.form, b.scene, b.material, &point);
    let ink = |uv, tiles_per_px, d| pattern_ink(b, &Quad::from_fn(|_| Sampled { uv, tiles_per_px }), 0, d);
    drawn(b.scene, b.material, lapped_ink(b, &lapped_of(input), tiles_per_px, d, &ink))
}
