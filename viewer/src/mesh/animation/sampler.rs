//! Values between keys.

use glam::Quat;

/// How values come between keys (glTF 2.0, appendix C).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(in crate::mesh) enum Interpolation {
    Step,
    Linear,
    CubicSpline,
}

/// Keys of one property.
#[derive(Clone, Debug)]
pub(in crate::mesh) struct Sampler {
    /// Finite, not falling, at least one.
    times_s: Vec<f32>,
    /// Per key `width` numbers; three times as many for a cubic spline: tangent in, value, tangent out.
    values: Vec<f32>,
    width: usize,
    interpolation: Interpolation,
}

impl Sampler {
    /// `None` if times are missing, not finite or fall, if values are not finite, or are not as many as the keys need.
    pub(in crate::mesh) fn new(
        times_s: Vec<f32>,
        values: Vec<f32>,
        width: usize,
        interpolation: Interpolation,
    ) -> Option<Self> {
        let per_key = if interpolation == Interpolation::CubicSpline { width.checked_mul(3)? } else { width };
        let sound = width > 0
            && !times_s.is_empty()
            && Some(values.len()) == times_s.len().checked_mul(per_key)
            && times_s.iter().chain(&values).all(|number| number.is_finite())
            && times_s.is_sorted();
        sound.then_some(Self { times_s, values, width, interpolation })
    }

    /// Time of the last key.
    pub(super) fn end_s(&self) -> f64 {
        self.times_s.last().map_or(0.0, |&time_s| f64::from(time_s))
    }

    /// The value at a time, into `out`; quaternions turn on the shorter way and stay of unit length.
    pub(super) fn at(&self, time_s: f64, quaternion: bool, out: &mut Vec<f32>) {
        let after = self.times_s.partition_point(|&key_s| f64::from(key_s) <= time_s);
        let last = self.times_s.len() - 1;
        let (from, to) = (after.saturating_sub(1), after.min(last));
        let span_s = f64::from(self.times_s[to]) - f64::from(self.times_s[from]);
        let t = if span_s > 0.0 { ((time_s - f64::from(self.times_s[from])) / span_s) as f32 } else { 0.0 };

        out.clear();
        match self.interpolation {
            _ if from == to || t == 0.0 => out.extend_from_slice(self.value(from)),
            Interpolation::Step => out.extend_from_slice(self.value(from)),
            Interpolation::Linear if quaternion => {
                if let (&[ax, ay, az, aw], &[bx, by, bz, bw]) = (self.value(from), self.value(to)) {
                    let (a, b) = (Quat::from_xyzw(ax, ay, az, aw), Quat::from_xyzw(bx, by, bz, bw));
                    out.extend(unit(a).slerp(unit(b), t).to_array());
                }
            }
            Interpolation::Linear => {
                let pairs = self.value(from).iter().zip(self.value(to));
                out.extend(pairs.map(|(a, b)| a + (b - a) * t));
            }
            Interpolation::CubicSpline => {
                let (t2, t3) = (t * t, t * t * t);
                let (leaving, coming) = (self.triple(from, 2), self.triple(to, 0));
                for at in 0..self.width {
                    out.push(
                        (2.0 * t3 - 3.0 * t2 + 1.0) * self.value(from)[at]
                            + span_s as f32 * (t3 - 2.0 * t2 + t) * leaving[at]
                            + (3.0 * t2 - 2.0 * t3) * self.value(to)[at]
                            + span_s as f32 * (t3 - t2) * coming[at],
                    );
                }
            }
        }
        if quaternion && let &[x, y, z, w] = &out[..] {
            out.copy_from_slice(&unit(Quat::from_xyzw(x, y, z, w)).to_array());
        }
    }

    fn value(&self, key: usize) -> &[f32] {
        match self.interpolation {
            Interpolation::CubicSpline => self.triple(key, 1),
            _ => &self.values[key * self.width..(key + 1) * self.width],
        }
    }

    fn triple(&self, key: usize, which: usize) -> &[f32] {
        let start = (key * 3 + which) * self.width;
        &self.values[start..start + self.width]
    }
}

/// Of unit length; no rotation where there is no length.
pub(super) fn unit(quaternion: Quat) -> Quat {
    let length = quaternion.length();
    if length > 0.0 && length.is_finite() { quaternion / length } else { Quat::IDENTITY }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn at(interpolation: Interpolation, values: Vec<f32>, time_s: f64) -> f32 {
        let sampler = Sampler::new(vec![1.0, 3.0], values, 1, interpolation).expect("sound keys");
        let mut out = Vec::new();
        sampler.at(time_s, false, &mut out);
        out[0]
    }

    #[test]
    fn values_come_between_keys_as_the_standard_says() {
        use Interpolation::{CubicSpline, Linear, Step};
        assert_eq!(at(Linear, vec![0.0, 8.0], 1.5), 2.0);
        assert_eq!(at(Step, vec![0.0, 8.0], 2.9), 0.0);
        assert_eq!(at(Step, vec![0.0, 8.0], 3.0), 8.0);
        // Halfway with tangents 1 and -1 over 2 s: the mean, and 2 s · (1/8 + 1/8).
        assert_eq!(at(CubicSpline, vec![9.0, 0.0, 1.0, -1.0, 8.0, 9.0], 2.0), 4.0 + 0.5);
        for interpolation in [Linear, Step] {
            assert_eq!(at(interpolation, vec![2.0, 8.0], 0.0), 2.0);
            assert_eq!(at(interpolation, vec![2.0, 8.0], 9.0), 8.0);
        }
    }

    #[test]
    fn a_linear_rotation_takes_the_shorter_way() {
        let (a, b) = (Quat::IDENTITY, -Quat::from_rotation_z(1.0));
        let values = [a.to_array(), b.to_array()].concat();
        let sampler = Sampler::new(vec![0.0, 1.0], values, 4, Interpolation::Linear).expect("sound keys");
        let mut out = Vec::new();
        sampler.at(0.5, true, &mut out);
        let half = Quat::from_slice(&out);
        // f32 and a slerp: a few times 1e-7.
        assert!((half * glam::Vec3::X).distance(Quat::from_rotation_z(0.5) * glam::Vec3::X) < 1e-5);
    }

    #[test]
    fn unsound_keys_are_refused() {
        let linear = Interpolation::Linear;
        assert!(Sampler::new(vec![], vec![], 1, linear).is_none());
        assert!(Sampler::new(vec![1.0, 0.0], vec![1.0, 2.0], 1, linear).is_none());
        assert!(Sampler::new(vec![0.0, 1.0], vec![1.0], 1, linear).is_none());
        assert!(Sampler::new(vec![0.0, f32::NAN], vec![1.0, 2.0], 1, linear).is_none());
    }
}
