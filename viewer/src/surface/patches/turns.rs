//! How patches turn with the light: about their own seeds, in quantised angles, so that strokes do not sweep over the
//! surface. Of each patch the copies at the two angles on both sides of the wanted one are drawn, each with other
//! strokes; they pass into each other as the light moves. Where the light stands on the surface and gives no direction,
//! a copy along the seed's fixed direction fades in.

use std::f64::consts::PI;

use glam::{DMat3, DMat4, DVec3};
use tam_shaders::cpu::lib::face_frame::frame_hardened;
use tam_shaders::cpu::lib::patches::TURNS;
use tam_shaders::cpu::lib::scene;

use super::{Patches, seeds};
use crate::surface::graph::Graph;

/// Angles at which a patch is drawn, in half a turn: strokes have no sign.
const ANGLES: usize = 8;

/// A seed that turns.
struct Turning {
    p_mesh: DVec3,
    normal: DVec3,
    tangent: DVec3,
    /// Place on the tile at each angle, and of the fixed copy.
    offsets_uv: [[f64; 2]; ANGLES + 1],
}

/// All seeds of a surface.
pub(crate) struct Turns {
    seeds: Vec<Turning>,
}

impl Turns {
    pub(crate) fn new(graph: &Graph, patches: &Patches) -> Self {
        let turning = |(index, seed): (usize, &super::Seed)| {
            let node = seed.node as usize;
            Turning {
                p_mesh: graph.positions[node],
                normal: graph.normals[node],
                tangent: graph.tangents[node],
                offsets_uv: std::array::from_fn(|angle| seeds::offset(index, angle + 1)),
            }
        };
        Self { seeds: patches.seeds.iter().enumerate().map(turning).collect() }
    }

    /// Texels that hold the turns of all seeds.
    pub(crate) fn len(&self) -> usize {
        TURNS * self.seeds.len()
    }

    /// The turns of all seeds under the lights of a scene, into `out`: place on the tile, angle, share.
    pub(crate) fn under(&self, scene: &scene::Scene, world_from_mesh: DMat4, out: &mut Vec<[f32; 4]>) {
        out.clear();
        let normals = DMat3::from_mat4(world_from_mesh).inverse().transpose();
        for seed in &self.seeds {
            let normal = (normals * seed.normal).normalize_or(DVec3::Y);
            let tangent = world_from_mesh.transform_vector3(seed.tangent);
            let frame = frame_hardened(scene, normal, world_from_mesh.transform_point3(seed.p_mesh));
            let along = frame.tangent;
            let angle = along.dot(normal.cross(tangent)).atan2(along.dot(tangent));
            out.extend(seed.copies(angle, frame.shares.z).map(|copy| copy.map(|number| number as f32)));
        }
    }
}

impl Turning {
    /// Strokes along an angle of the seed's frame; `fixed` is the share of the fixed direction.
    fn copies(&self, angle_rad: f64, fixed: f64) -> [[f64; 4]; TURNS] {
        let steps = angle_rad.rem_euclid(PI) / PI * ANGLES as f64;
        let low = steps.floor();
        let high_share = steps - low;
        let copy = |step: usize, share: f64| {
            let [u, v] = self.offsets_uv[step];
            // The patch is turned back, so that its strokes lie along the angle.
            [u, v, -(step as f64) / ANGLES as f64 * PI, share]
        };
        let [fixed_u, fixed_v] = self.offsets_uv[ANGLES];
        [
            copy(low as usize % ANGLES, (1.0 - high_share) * (1.0 - fixed)),
            copy((low as usize + 1) % ANGLES, high_share * (1.0 - fixed)),
            [fixed_u, fixed_v, 0.0, fixed],
        ]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn copies_pass_into_each_other_at_any_angle() {
        let seed = Turning {
            p_mesh: DVec3::ZERO,
            normal: DVec3::Z,
            tangent: DVec3::X,
            offsets_uv: std::array::from_fn(|angle| seeds::offset(3, angle)),
        };
        // What is drawn is the sum of shares by copy, a copy being known by its place on the tile.
        let drawn = |angle: f64| -> Vec<(u64, f64)> {
            let by_place = |copy: [f64; 4]| (copy[0].to_bits(), copy[3]);
            seed.copies(angle, 0.25).map(by_place).into_iter().collect()
        };
        for i in 0..720 {
            let (a, b) = (drawn(f64::from(i) * 0.01), drawn(f64::from(i) * 0.01 + 1e-6));
            assert!((a.iter().map(|(_, share)| share).sum::<f64>() - 1.0).abs() < 1e-12);
            for (place, share) in &a {
                let there = b.iter().find(|(other, _)| other == place).map_or(0.0, |(_, share)| *share);
                assert!((there - share).abs() < 1e-4, "a copy pops at {}", f64::from(i) * 0.01);
            }
        }
    }
}
