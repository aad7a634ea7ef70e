//! Twin of `stroke_map.wgsl`: one sample and a threshold, or lines whose width follows the tone. Freudenberg, "Real-Time
//! Stroke Textures", SIGGRAPH 2001 sketch.

use glam::{DVec2, DVec4};

use super::lib::blend::blended_ink;
use super::lib::columns::map_level;
use super::lib::halftone::{halftone_ink, halftone_threshold};
use super::lib::light::darkness;
use super::lib::mapping::map_surface;
use super::lib::material::reflectance;
use super::lib::surface::{FragmentIn, drawn, surface_point};
use super::lib::threshold::{equalised, threshold_centred, threshold_one_sided};
use super::{Bindings, Form, PatternKind, Quad};

/// Where a fragment samples a pattern.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sampled {
    /// Place on the tile.
    pub uv: DVec2,
    /// Footprint of a pixel.
    pub tiles_per_px: f64,
}

/// Ink of one pattern for one fragment of a quad. The slope follows the difference of the threshold between fragments.
pub fn pattern_ink(b: &Bindings<'_>, at: &Quad<Sampled>, lane: usize, d: f64) -> f64 {
    let here = at[lane];
    if b.options.pattern == PatternKind::Lines {
        if b.options.form == Form::Literal {
            let lines = (b.material.size_px / b.material.line_period_px).floor();
            return threshold_one_sided(d, halftone_threshold(here.uv.y, lines), b.material.slope);
        }
        let t = at.map(|at| at.uv.y);
        return halftone_ink(here.uv.y, t.dpdx(lane).hypot(t.dpdy(lane)), b.material.line_period_px, d);
    }
    let sample = |at: Sampled| {
        let level = map_level(b.material, at.tiles_per_px);
        (b.map.sample_level(at.uv, 0, level).x, level)
    };
    if b.options.form == Form::Literal {
        return threshold_one_sided(d, sample(here).0, b.material.slope);
    }
    let thetas = at.map(|at| {
        let (sampled, level) = sample(*at);
        equalised(b.material, b.distribution, sampled, level)
    });
    let per_px = thetas.dpdx(lane).hypot(thetas.dpdy(lane));
    threshold_centred(d, thetas[lane], per_px)
}

/// Colour of one fragment of a quad, linear light.
pub fn fragment(b: &Bindings<'_>, quad: &Quad<FragmentIn>, lane: usize, front: bool) -> DVec4 {
    let points = quad.map(|input| surface_point(b.scene, b.material, input, front));
    let point = &points[lane];
    let d = darkness(b.scene, reflectance(b.material), point.p_world, point.normal, point.view);
    let mapped = Quad::from_fn(|lane| map_surface(b, &points, lane));
    let ink = blended_ink(b.options, &mapped[lane], d, |i, d| {
        let at = mapped.map(|mapped| Sampled { uv: mapped.patterns[i].uv, tiles_per_px: mapped.tiles_per_px });
        pattern_ink(b, &at, lane, d)
    });
    drawn(b.scene, b.material, ink)
}
