//! The outline of a patch in texture space: an irregular blob, as Praun and others 2000 use for textures without features
//! of their own, so that borders do not show as lines.

use std::f64::consts::TAU;

use glam::DVec2;
use tam_gen::sequence::Draw;

/// Swings of the radius in one turn, from the first of these to the last.
const WAVES: std::ops::RangeInclusive<u32> = 2..=6;

/// A closed curve around the origin, in tiles.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Outline {
    radius_tiles: f64,
    /// Per wave: swings per turn, height as a share of the radius, phase in radians.
    waves: Vec<(f64, f64, f64)>,
}

impl Outline {
    /// A blob by chance; `irregularity` is by how much of the radius it may leave the circle.
    pub(super) fn new(radius_tiles: f64, irregularity: f64, draw: &mut Draw) -> Self {
        let heights: Vec<f64> = WAVES.map(|wave| (0.3 + 0.7 * draw.unit()) / f64::from(wave)).collect();
        let whole: f64 = heights.iter().sum();
        let waves = WAVES
            .zip(heights)
            .map(|(wave, height)| (f64::from(wave), irregularity * height / whole, TAU * draw.unit()))
            .collect();
        Self { radius_tiles, waves }
    }

    /// How far inside a place is, along the ray from the centre, in tiles; negative outside.
    pub(super) fn depth(&self, place: DVec2) -> f64 {
        let angle_rad = place.y.atan2(place.x);
        let swing: f64 = self.waves.iter().map(|(wave, height, phase)| height * (wave * angle_rad + phase).cos()).sum();
        self.radius_tiles * (1.0 + swing) - place.length()
    }

    /// Whether a line segment meets the inside.
    pub(super) fn meets(&self, from: DVec2, to: DVec2) -> bool {
        // Edges far longer than the outline is wide must not step over it.
        let nearest = nearest(DVec2::ZERO, from, to);
        [from, to, nearest, from.midpoint(to)].into_iter().any(|place| self.depth(place) > 0.0)
    }
}

/// The place of a line segment that is nearest to a place.
pub(super) fn nearest(place: DVec2, from: DVec2, to: DVec2) -> DVec2 {
    let along = to - from;
    let share = (place - from).dot(along) / along.length_squared().max(1e-300);
    from + along * share.clamp(0.0, 1.0)
}
