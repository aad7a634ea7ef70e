//! Deformations that keep the triangles: movement for tests and pictures of animated meshes.

use std::f32::consts::TAU;

use glam::{Quat, Vec3, vec3};
use rayon::prelude::*;

/// A periodic movement of a mesh whose box is about the origin with a longest side of 2.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, serde::Serialize, serde::Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Deform {
    /// Wrings the mesh about y, there and back, up to 69° at the ends.
    Twist,
    /// Sends a swell of length 2 and height 0.12 up through the mesh.
    Wave,
    /// Widens and narrows the mesh by a tenth, its middle most and the height against it.
    Breathe,
}

impl Deform {
    /// Every deformation.
    pub const ALL: [Self; 3] = [Self::Twist, Self::Wave, Self::Breathe];

    /// Its name in commands and files.
    pub fn name(self) -> &'static str {
        match self {
            Self::Twist => "twist",
            Self::Wave => "wave",
            Self::Breathe => "breathe",
        }
    }

    /// What it does, in one line.
    pub fn description(self) -> &'static str {
        match self {
            Self::Twist => "wrings the mesh about its vertical axis, there and back",
            Self::Wave => "sends a swell up through the mesh",
            Self::Breathe => "widens and narrows the mesh",
        }
    }

    /// The deformation of that name.
    pub fn named(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|deform| deform.name() == name)
    }

    /// Moves the vertices `rest` to where they are at `phase`, in periods: any finite number, of which the fraction
    /// counts. Phase 0 is the mesh at rest. `out` is overwritten; its capacity is kept.
    pub fn apply(self, phase: f32, rest: &[Vec3], out: &mut Vec<Vec3>) {
        // Whole periods are taken off first, so that phase 1 is phase 0 to the bit.
        let phase = phase.rem_euclid(1.0) % 1.0;
        let swing = (TAU * phase).sin();
        let place = |&p: &Vec3| match self {
            Self::Twist => Quat::from_rotation_y(1.2 * swing * p.y) * p,
            Self::Wave => {
                // Fades in and out with the phase, so that it starts from rest.
                let strength = 0.12 * (1.0 - (TAU * phase).cos()) * 0.5;
                let angle = TAU * (0.5 * p.y - 2.0 * phase);
                p + vec3(strength * angle.sin(), 0.0, strength * angle.cos())
            }
            Self::Breathe => {
                let width = 1.0 + 0.1 * swing * (1.0 + (0.5 * TAU * p.y.clamp(-1.0, 1.0)).cos());
                vec3(p.x * width, p.y * (1.0 - 0.06 * swing), p.z * width)
            }
        };
        rest.par_iter().with_min_len(1 << 12).map(place).collect_into_vec(out);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::sample::Sample;

    fn deformed(deform: Deform, phase: f32, rest: &[Vec3]) -> Vec<Vec3> {
        let mut out = Vec::new();
        deform.apply(phase, rest, &mut out);
        out
    }

    fn largest_move(a: &[Vec3], b: &[Vec3]) -> f32 {
        a.iter().zip(b).map(|(a, b)| a.distance(*b)).fold(0.0, f32::max)
    }

    #[test]
    fn phase_zero_is_the_mesh_at_rest() {
        let rest = Sample::TorusKnot.build(2_000).positions;
        for deform in Deform::ALL {
            assert_eq!(deformed(deform, 0.0, &rest), rest, "{}", deform.name());
        }
    }

    #[test]
    fn movement_is_periodic_and_smooth_over_the_seam() {
        let rest = Sample::TorusKnot.build(2_000).positions;
        for deform in Deform::ALL {
            for phase in [0.0, 0.3, 0.75] {
                let (once, again) = (deformed(deform, phase, &rest), deformed(deform, phase - 1.0, &rest));
                // A phase less one differs from the phase by rounding, times speeds of a few units per period.
                assert!(largest_move(&once, &again) < 1e-5, "{} at {phase}", deform.name());
            }
            assert_eq!(deformed(deform, 1.0, &rest), rest, "{}", deform.name());
            // Speed just before the period's end is the speed just after its start: no kink.
            let step = 1e-2;
            let (before, after) = (deformed(deform, 1.0 - step, &rest), deformed(deform, step, &rest));
            let kink = rest.iter().zip(before.iter().zip(&after)).map(|(&r, (&b, &a))| (a + b - r * 2.0).length());
            // A smooth path of speed v and acceleration below 4π²·1.5 leaves that times step².
            let kink = kink.fold(0.0, f32::max);
            assert!(kink < 60.0 * step * step, "{}: {kink}", deform.name());
        }
    }

    #[test]
    fn vertices_move_stay_finite_and_near_the_box() {
        let rest = Sample::TorusKnot.build(2_000).positions;
        for deform in Deform::ALL {
            let mut farthest = 0.0f32;
            for k in 0..32 {
                let moved = deformed(deform, k as f32 / 32.0, &rest);
                assert_eq!(moved.len(), rest.len());
                assert!(moved.iter().all(|p| p.is_finite() && p.abs().max_element() < 1.35));
                farthest = farthest.max(largest_move(&moved, &rest));
            }
            assert!(farthest > 0.05, "{} moves by {farthest}", deform.name());
        }
    }

    #[test]
    fn points_in_one_place_stay_in_one_place() {
        let rest = vec![vec3(0.3, -0.7, 0.2); 2];
        for deform in Deform::ALL {
            let moved = deformed(deform, 0.37, &rest);
            assert_eq!(moved[0], moved[1]);
        }
    }

    #[test]
    fn names_find_their_deformation() {
        for deform in Deform::ALL {
            assert_eq!(Deform::named(deform.name()), Some(deform));
        }
        assert_eq!(Deform::named("melt"), None);
    }
}
