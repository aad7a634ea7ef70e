//! Twin of `phong.wgsl`: the wanted tone itself, as continuous grey. Suarez and others, "GPU real time hatching", 2013,
//! section 4; Phong 1975.

use glam::DVec4;

use super::Bindings;
use super::lib::light::darkness;
use super::lib::material::reflectance;
use super::lib::surface::{FragmentIn, drawn, surface_point};

/// Colour of a fragment, linear light.
pub fn fragment(b: &Bindings<'_>, input: &FragmentIn, front: bool) -> DVec4 {
    let point = surface_point(b.scene, input, front);
    let d = darkness(b.scene, reflectance(b.material), point.p_world, point.normal, point.view);
    drawn(b.scene, b.material, d)
}
