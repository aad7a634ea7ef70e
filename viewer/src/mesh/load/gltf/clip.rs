//! The first animation.

use gltf::json::Root;
use gltf::json::accessor::Type;
use gltf::json::animation::{Interpolation as JsonInterpolation, Property};
use gltf::json::validation::Checked;

use crate::mesh::MeshError;
use crate::mesh::animation::{Animation, Channel, Interpolation, Rig, Sampler, Target};

use super::accessor::Buffers;
use super::item;

/// The first clip of the file, if it moves a node of the scene.
pub(super) fn animation(
    root: &Root,
    buffers: &Buffers,
    rig: Rig,
    notes: &mut Vec<String>,
) -> Result<Option<Animation>, MeshError> {
    let Some(json) = root.animations.first() else { return Ok(None) };
    if root.animations.len() > 1 {
        notes.push(format!("The first of {} animations is taken.", root.animations.len()));
    }
    let mut drawn = vec![false; rig.nodes.len()];
    rig.order.iter().for_each(|&node| drawn[node] = true);
    let mut channels = Vec::new();
    for channel in &json.channels {
        let node = channel.target.node.value();
        item(&rig.nodes, node, "node")?;
        let sampler = item(&json.samplers, channel.sampler.value(), "sampler")?;
        let Checked::Valid(property) = channel.target.path else {
            return Err(MeshError::damaged("an animation of an unknown property"));
        };
        let (target, width, kind) = match property {
            Property::Translation => (Target::Translation, 3, Type::Vec3),
            Property::Scale => (Target::Scale, 3, Type::Vec3),
            Property::Rotation => (Target::Rotation, 4, Type::Vec4),
            Property::MorphTargetWeights => (Target::Weights, rig.nodes[node].weights.len(), Type::Scalar),
        };
        if !drawn[node] || width == 0 {
            continue;
        }
        let interpolation = match sampler.interpolation {
            Checked::Valid(JsonInterpolation::Linear) => Interpolation::Linear,
            Checked::Valid(JsonInterpolation::Step) => Interpolation::Step,
            Checked::Valid(JsonInterpolation::CubicSpline) => Interpolation::CubicSpline,
            Checked::Invalid => return Err(MeshError::damaged("an animation of an unknown interpolation")),
        };
        let times_s = buffers.floats(sampler.input, Type::Scalar)?;
        let values = buffers.floats(sampler.output, kind)?;
        let (keys, numbers) = (times_s.len(), values.len());
        let sampler = Sampler::new(times_s, values, width, interpolation).ok_or_else(|| {
            MeshError::damaged(format!(
                "keys of an animation of node {node}: {keys} times, which must be finite and rise, and {numbers} numbers"
            ))
        })?;
        channels.push(Channel { node, target, sampler });
    }
    let moves = !channels.is_empty() && !rig.instances.is_empty();
    Ok(moves.then(|| Animation::new(json.name.clone().unwrap_or_default(), rig, channels)))
}
