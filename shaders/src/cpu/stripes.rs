//! Twin of `stripes.wgsl`: one line field over the whole surface, as wide as the tone asks, and a second one across it
//! in the dark. Knöppel and others, "Stripe patterns on surfaces", 2015.

use glam::{DVec2, DVec3, DVec4};

use super::lib::barycentric::{corner_slopes, corner_weights};
use super::lib::light::darkness;
use super::lib::mapping::frame_place;
use super::lib::material::{Material, reflectance};
use super::lib::mesh::Mesh;
use super::lib::stripes::{crossed_darkness, doubled_ink, stripe_phase, stripe_slope};
use super::lib::surface::{FragmentIn, drawn, surface_point};
use super::{Bindings, Quad};
use crate::types::StripePhases;

/// Where a fragment is in its face, and how that changes to the next pixel.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Place {
    /// Weights of the corners.
    pub weights: DVec3,
    /// Their change to the pixel on the right.
    pub dx: DVec3,
    /// Their change to the pixel below.
    pub dy: DVec3,
}

/// The place of a point, given its change across a pixel.
pub fn place_in_face(mesh: &Mesh<'_>, face: usize, p: DVec3, dx: DVec3, dy: DVec3) -> Place {
    Place {
        weights: corner_weights(mesh, face, p),
        dx: corner_slopes(mesh, face, dx),
        dy: corner_slopes(mesh, face, dy),
    }
}

/// Ink of one field.
pub fn stripes_ink(material: &Material, s: &StripePhases, place: &Place, d: f64) -> f64 {
    let slope = |dw| stripe_slope(s, place.weights, dw);
    let per_px = DVec2::new(slope(place.dx), slope(place.dy)).length();
    doubled_ink(stripe_phase(s, place.weights), per_px, material.line_period_px, d)
}

/// Ink of both fields.
pub fn crossed_ink(b: &Bindings<'_>, face: usize, place: &Place, d: f64) -> f64 {
    let shares = crossed_darkness(d, b.material.cross_from);
    let ink = stripes_ink(b.material, &b.stripes.along[face], place, shares.x);
    if shares.y <= 0.0 {
        return ink;
    }
    1.0 - (1.0 - ink) * (1.0 - stripes_ink(b.material, &b.stripes.across[face], place, shares.y))
}

/// Colour of one fragment of a quad, linear light.
pub fn fragment(b: &Bindings<'_>, quad: &Quad<FragmentIn>, lane: usize, front: bool) -> DVec4 {
    let point = surface_point(b.scene, b.material, &quad[lane], front);
    let p = quad.map(|input| frame_place(b.options.form, b.scene, input.p_world));
    let place = place_in_face(&b.mesh, point.face, p[lane], p.dpdx(lane), p.dpdy(lane));
    let d = darkness(b.scene, reflectance(b.material), point.p_world, point.normal, point.view);
    drawn(b.scene, b.material, crossed_ink(b, point.face, &place, d))
}
