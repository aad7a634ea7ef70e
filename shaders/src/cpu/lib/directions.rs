//! Twin of `lib/directions.wgsl`: directions of strokes on the screen, as complex numbers of twice the angle, counted
//! from the horizontal counter-clockwise. Unit where one pattern is drawn, shorter the less several agree, 0 where there
//! is none.

use glam::{DVec2, DVec3};

use super::face_frame::{complex_square, fixed_tangent, unpack_shares};
use super::mapping::triplanar_weights;
use super::material::Material;
use super::octahedral::oct_decode;
use super::patched::Lapped;
use super::patches::{OVERLAPS, Overlap, copies, overlap_weights, seed_turn};
use super::surface::Point;
use crate::cpu::{Bindings, Mapping, Quad};

/// Shorter gradients, in tiles or lines per pixel, have no direction.
pub const LEAST_GRADIENT: f64 = 1e-9_f32 as f64;

/// Direction across a gradient: the change to the pixel on the right and to the one below.
pub fn direction_across(gradient: DVec2) -> DVec2 {
    let g = gradient.length();
    if g.is_nan() || g <= LEAST_GRADIENT {
        return DVec2::ZERO;
    }
    -complex_square(DVec2::new(gradient.x, -gradient.y) / g)
}

/// The direction of a pattern's strokes, given the changes of its surface coordinates to the right and below.
pub fn pattern_direction(material: &Material, st_dx: DVec2, st_dy: DVec2) -> DVec2 {
    let v = DVec2::new(material.tile_from_surface.z, material.tile_from_surface.w);
    direction_across(DVec2::new(v.dot(st_dx), v.dot(st_dy)))
}

/// Of the strokes in a frame with these shares and this normal; `st_dx` and `st_dy` are changes of the place in it, `dx` and
/// `dy` in the space of the frames.
pub fn frame_direction(
    material: &Material,
    [shares, normal_oct]: [u32; 2],
    [st_dx, st_dy]: [DVec2; 2],
    [dx, dy]: [DVec3; 2],
) -> DVec2 {
    let n = oct_decode(normal_oct);
    let e = fixed_tangent(n);
    let fixed = |v: DVec3| DVec2::new(e.dot(v), n.cross(e).dot(v));
    let in_fixed = pattern_direction(material, fixed(dx), fixed(dy));
    pattern_direction(material, st_dx, st_dy).lerp(in_fixed, unpack_shares(shares).z)
}

/// Of three planes.
pub fn triplanar_direction(material: &Material, n: DVec3, dx: DVec3, dy: DVec3) -> DVec2 {
    let w = triplanar_weights(n);
    let plane = |st: fn(DVec3) -> DVec2| pattern_direction(material, st(dx), st(dy));
    w.x * plane(|p| DVec2::new(p.z, p.y)) + w.y * plane(|p| DVec2::new(p.x, p.z)) + w.z * plane(DVec3::truncate)
}

/// A place turned about the origin.
pub fn rotated(place: DVec2, angle_rad: f64) -> DVec2 {
    DVec2::from_angle(angle_rad).rotate(place)
}

/// How the places of an overlap change to the next pixel, and to the one below.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct OverlapSlopes {
    /// To the right.
    pub dx: [DVec2; OVERLAPS],
    /// Below.
    pub dy: [DVec2; OVERLAPS],
}

impl OverlapSlopes {
    /// At a fragment of a quad.
    pub fn of(quad: &Quad<Overlap>, lane: usize) -> Self {
        let places = |i: usize| quad.map(|overlap| overlap.places[i]);
        Self { dx: std::array::from_fn(|i| places(i).dpdx(lane)), dy: std::array::from_fn(|i| places(i).dpdy(lane)) }
    }
}

/// Of one patch, by its weight, from the changes of its place.
pub fn patch_direction(b: &Bindings<'_>, st_dx: DVec2, st_dy: DVec2, seed: u32, weight: f64) -> DVec2 {
    if weight <= 0.0 {
        return DVec2::ZERO;
    }
    let of_copy = |copy| {
        let turn = seed_turn(b.options.follow, b.turns, seed, copy);
        weight * turn.w * pattern_direction(b.material, rotated(st_dx, turn.z), rotated(st_dy, turn.z))
    };
    (0..copies(b.options.follow)).map(of_copy).sum()
}

/// Of patches.
pub fn patches_direction(b: &Bindings<'_>, overlap: &Overlap, slopes: &OverlapSlopes) -> DVec2 {
    let weights = overlap_weights(overlap.behind).to_array();
    (0..OVERLAPS).map(|i| patch_direction(b, slopes.dx[i], slopes.dy[i], overlap.seeds[i], weights[i])).sum()
}

/// Of one lapped texture over the direction of what lies under it.
pub fn painted_direction(material: &Material, under: DVec2, st_dx: DVec2, st_dy: DVec2, alpha: f64) -> DVec2 {
    under.lerp(pattern_direction(material, st_dx, st_dy), alpha.clamp(0.0, 1.0))
}

/// Of four lapped textures.
pub fn overlapped_direction(material: &Material, under: DVec2, overlap: &Overlap, slopes: &OverlapSlopes) -> DVec2 {
    (0..OVERLAPS)
        .fold(under, |under, i| painted_direction(material, under, slopes.dx[i], slopes.dy[i], overlap.behind[i]))
}

/// Of lapped textures.
pub fn lapped_direction(material: &Material, lapped: &Lapped, first: &OverlapSlopes, then: &OverlapSlopes) -> DVec2 {
    let under = overlapped_direction(material, DVec2::ZERO, &lapped.first, first);
    overlapped_direction(material, under, &lapped.then, then)
}

/// Of the mapping; `uv_dx` and `uv_dy` are changes of the point's uv.
pub fn mapped_direction(
    b: &Bindings<'_>,
    point: &Point,
    (overlap, slopes): (&Overlap, &OverlapSlopes),
    [dx, dy]: [DVec3; 2],
    [uv_dx, uv_dy]: [DVec2; 2],
) -> DVec2 {
    match b.options.mapping {
        Mapping::Frames => frame_direction(b.material, point.framing, [uv_dx, uv_dy], [dx, dy]),
        Mapping::Triplanar => triplanar_direction(b.material, point.normal, dx, dy),
        Mapping::Patches => patches_direction(b, overlap, slopes),
        // Lapped textures are drawn on their own.
        Mapping::Uv | Mapping::Lapped => pattern_direction(b.material, uv_dx, uv_dy),
    }
}
