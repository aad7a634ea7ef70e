//! Phases of the triangles' corners: equal along a shared side, up to sign and whole numbers.
//!
//! Knöppel and others 2015, section 4. On each side the phase grows by what the link asks for and what the wave is
//! off it, less than half a line. Where that does not close around a triangle, lines end in it: the phase winds around
//! its middle. Where the field is singular the phase comes back with the other sign; it is then linear between the
//! sides and the middle, which lies on a line or half-way between two, so that it is its own mirror image.

use rayon::prelude::*;

use super::StripePhases;
use super::growth::{Loop, Side, Step};
use crate::surface::graph::Graph;

/// The phases of all triangles.
pub(super) fn phases(graph: &Graph, loops: &[Option<Loop>], steps: &[Step], settled: &[f64]) -> Vec<StripePhases> {
    graph
        .triangles
        .par_iter()
        .zip(loops)
        .map(|(triangle, sides)| match sides {
            Some(sides) => of_triangle(
                triangle.map(|node| settled[node as usize]),
                sides.map(|side| (steps[side.link as usize], side)),
            ),
            None => StripePhases::default(),
        })
        .collect()
}

fn of_triangle(settled: [f64; 3], sides: [(Step, Side); 3]) -> StripePhases {
    let mut sign = 1.0;
    // Corner 0, 1, 2, and corner 0 again after the way round.
    let mut phases = [settled[0]; 4];
    for (k, (step, side)) in sides.into_iter().enumerate() {
        let asked = sign * step.along(side);
        let from = sign * settled[k];
        sign *= step.sign;
        let off = sign * settled[(k + 1) % 3] - from - asked;
        phases[k + 1] = phases[k] + asked + (off - off.round());
    }
    let [a, b, c, again] = phases;
    let whole = ((a + b + c) / 3.0).round();
    let [a, b, c, again] = [a, b, c, again].map(|phase| phase - whole);
    if sign < 0.0 {
        return StripePhases::folded([a, b, c].map(|phase| phase as f32), (again + a).round() as i32);
    }
    let turns = (again - a).round();
    // What the winding adds by itself is taken off the corners.
    let corners = [a, b - turns / 3.0, c - turns * 2.0 / 3.0].map(|phase| phase as f32);
    StripePhases::wound(corners, turns as i32)
}
