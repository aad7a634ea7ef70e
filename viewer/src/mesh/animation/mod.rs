//! Movement of a mesh whose triangles stay: glTF nodes, morph targets and skins.

mod rig;
mod sampler;

#[cfg(test)]
mod tests;

pub(super) use rig::{Instance, Node, Rig, Skin, Transform};
pub(super) use sampler::{Interpolation, Sampler};

use glam::{Quat, Vec3};

/// One clip: vertex positions over time.
#[derive(Clone, Debug)]
pub struct Animation {
    name: String,
    duration_s: f64,
    rig: Rig,
    channels: Vec<Channel>,
}

/// What one sampler moves.
#[derive(Clone, Debug)]
pub(super) struct Channel {
    /// Index of the node.
    pub(super) node: usize,
    pub(super) target: Target,
    pub(super) sampler: Sampler,
}

/// A property of a node.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Target {
    Translation,
    Rotation,
    Scale,
    Weights,
}

impl Animation {
    pub(super) fn new(name: String, rig: Rig, channels: Vec<Channel>) -> Self {
        let duration_s = channels.iter().map(|channel| channel.sampler.end_s()).fold(0.0, f64::max);
        Self { name, duration_s, rig, channels }
    }

    /// The clip's name in the file; may be empty.
    pub fn name(&self) -> &str {
        &self.name
    }

    /// Seconds from time 0 to the last key; 0 for a clip that stands still.
    pub fn duration_s(&self) -> f64 {
        self.duration_s
    }

    /// Positions at a time, into `out`: in the file's coordinates, one per vertex of the [`RawMesh`](super::RawMesh).
    ///
    /// The clip repeats: a time outside `0..duration_s` is taken modulo the duration, one that is not finite as 0.
    /// Before the first and after the last key of a channel its value stays. glTF 2.0, section 3.11 and appendix C.
    pub fn positions_at(&self, time_s: f64, out: &mut Vec<Vec3>) {
        let time_s = if time_s.is_finite() && self.duration_s > 0.0 { time_s.rem_euclid(self.duration_s) } else { 0.0 };
        let mut pose = self.rig.rest();
        let mut values = Vec::new();
        for channel in &self.channels {
            channel.sampler.at(time_s, channel.target == Target::Rotation, &mut values);
            let transform = &mut pose.transforms[channel.node];
            match (channel.target, &values[..]) {
                (Target::Translation, &[x, y, z]) => transform.translation = Vec3::new(x, y, z),
                (Target::Scale, &[x, y, z]) => transform.scale = Vec3::new(x, y, z),
                (Target::Rotation, &[x, y, z, w]) => transform.rotation = Quat::from_xyzw(x, y, z, w),
                (Target::Weights, weights) => pose.weights[channel.node] = weights.to_vec(),
                _ => {}
            }
            if channel.target != Target::Weights {
                pose.matrices[channel.node] = None;
            }
        }
        self.rig.positions(&pose, out);
    }
}
