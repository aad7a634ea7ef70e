//! Views and pictures made by formulas.

use glam::{DVec2, DVec3};
use tam_gen::sequence::Draw;

use super::aov::{Aov, Surface};
use super::blur::MaskedBlur;
use super::plane::Plane;

/// Samples of a pixel, on a lattice in which no two share a row or column: lines near the axes are as smooth as others.
const SAMPLES: u32 = 144;
/// Step of the lattice down for one across; both are Fibonacci numbers.
const LATTICE_STEP: u32 = 89;

/// A flat surface seen straight on, one unit a pixel: one darkness, one direction.
pub(super) fn flat_aov(size: [u32; 2], stroke_rad: f64, darkness: f64) -> Aov {
    let surface = |i: u32| Surface {
        face: 0,
        weights: DVec3::new(1.0, 0.0, 0.0),
        p_world: DVec3::new(f64::from(i % size[0]), -f64::from(i / size[0]), 0.0),
        normal: DVec3::Z,
        facing: 1.0,
        px_world: 1.0,
        darkness,
        stroke_rad: Some(stroke_rad.rem_euclid(std::f64::consts::PI)),
    };
    Aov { size, pixels: (0..size[0] * size[1]).map(|i| Some(surface(i))).collect() }
}

/// The same with a darkness that grows from left to right.
pub(super) fn ramp_aov(size: [u32; 2], from: f64, to: f64) -> Aov {
    let mut aov = flat_aov(size, 0.0, from);
    for (i, surface) in aov.pixels.iter_mut().flatten().enumerate() {
        surface.darkness = from + (to - from) * (f64::from(i as u32 % size[0]) + 0.5) / f64::from(size[0]);
    }
    aov
}

/// A picture from a function of the place in pixels, averaged over each pixel.
pub(super) fn averaged(size: [u32; 2], ink: impl Fn(DVec2) -> f64) -> Plane {
    Plane::from_fn(size, |x, y| {
        let sample = |i: u32| {
            let inside = DVec2::new(f64::from(i), f64::from(i * LATTICE_STEP % SAMPLES)) + 0.5;
            ink(DVec2::new(f64::from(x), f64::from(y)) + inside / f64::from(SAMPLES))
        };
        (0..SAMPLES).map(sample).sum::<f64>() / f64::from(SAMPLES)
    })
}

/// Endless lines, as wide as the darkness asks for.
#[derive(Clone, Copy, Default)]
pub(super) struct Grating {
    pub(super) angle_rad: f64,
    pub(super) period_px: f64,
    /// Of the lines, across, in periods.
    pub(super) shift: f64,
}

impl Grating {
    pub(super) fn drawn_on(&self, aov: &Aov) -> Plane {
        let across = DVec2::from_angle(self.angle_rad).perp();
        averaged(aov.size, |place| {
            let phase = (place.dot(across) / self.period_px + self.shift).rem_euclid(1.0);
            let darkness = aov.at(place).map_or(0.0, |surface| surface.darkness);
            f64::from(u8::from((phase - 0.5).abs() < 0.5 * darkness))
        })
    }
}

/// Rows of strokes with square ends, each row shifted against the one before.
#[derive(Clone, Copy)]
pub(super) struct Dashes {
    pub(super) angle_rad: f64,
    pub(super) length_px: f64,
    pub(super) gap_px: f64,
    pub(super) period_px: f64,
    pub(super) width_px: f64,
}

impl Dashes {
    pub(super) fn drawn(&self, size: [u32; 2]) -> Plane {
        let along = DVec2::from_angle(self.angle_rad);
        averaged(size, |place| {
            let row = place.dot(along.perp()) / self.period_px;
            let repeat = self.length_px + self.gap_px;
            let way = (place.dot(along) + 0.618 * repeat * row.floor()).rem_euclid(repeat);
            let off_px = (row - row.floor() - 0.5).abs() * self.period_px;
            f64::from(u8::from(way < self.length_px && off_px < 0.5 * self.width_px))
        })
    }
}

/// Blots of ink about so many pixels wide, half of the area, in no direction.
pub(super) fn noise(size: [u32; 2], sigma_px: f64) -> Plane {
    let mut draw = Draw::new(5, "noise");
    let white: Vec<f64> = (0..size[0] * size[1]).map(|_| draw.signed()).collect();
    let mask = vec![true; white.len()];
    let smooth = MaskedBlur::new(size, &mask, sigma_px).apply(&white);
    Plane { size, pixels: smooth.iter().map(|x| f64::from(u8::from(*x > 0.0))).collect() }
}
