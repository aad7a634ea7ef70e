//! Twin of `lib/adjacency.wgsl`: the blend of a face with its neighbours. Suarez and others, "GPU real time hatching",
//! 2013, algorithms 2 and 3.

use glam::DVec3;

use super::columns::{column_coordinate, column_ink};
use super::light::darkness;
use super::mapping::{LONE_WEIGHT, Pattern};
use super::material::reflectance;
use super::surface::Point;
use crate::cpu::{Bindings, Form};

/// Contribution of a neighbour: the cosine of the normals on the shared edge, -1 at the corner opposite to it;
/// `opposite` is that corner's barycentric weight. A hardened blend ends at 0.
pub fn contribution(form: Form, cosine: f64, opposite: f64) -> f64 {
    let f = cosine * (1.0 - opposite) - opposite;
    match form {
        Form::Literal => f,
        Form::Hardened => f.max(0.0),
    }
}

/// Ink of one face of the four at its own tone: of the nearest column in the literal form, of the two that bracket the
/// tone in the hardened.
pub fn contributed_ink(b: &Bindings<'_>, point: &Point, n: DVec3, patterns: &[Pattern; 3], level: f64) -> f64 {
    let d = darkness(b.scene, reflectance(b.material), point.p_world, n, point.view);
    let x = column_coordinate(b.options.form, b.material, d);
    if b.options.form == Form::Literal {
        return column_ink(b.material, b.map, patterns[0].uv, level, x.round_ties_even());
    }
    let count = if patterns[0].weight > LONE_WEIGHT { 1 } else { 3 };
    patterns[..count].iter().map(|pattern| pattern.weight * column_ink(b.material, b.map, pattern.uv, level, x)).sum()
}
