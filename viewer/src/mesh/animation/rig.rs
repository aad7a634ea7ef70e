//! Nodes that carry meshes, and what becomes of their vertices.

use glam::{DMat3, DMat4, DVec3, Quat, Vec3};
use rayon::prelude::*;

use super::sampler::unit;

/// Vertices per task, below which threads cost more than they save.
const GRAIN: usize = 4096;

/// A hierarchy of nodes, and the vertices that they carry.
#[derive(Clone, Debug, Default)]
pub(in crate::mesh) struct Rig {
    pub(in crate::mesh) nodes: Vec<Node>,
    /// Indices of the nodes that are drawn, parents before children.
    pub(in crate::mesh) order: Vec<usize>,
    pub(in crate::mesh) instances: Vec<Instance>,
}

/// A node: where it is with regard to its parent.
#[derive(Clone, Debug, Default)]
pub(in crate::mesh) struct Node {
    pub(in crate::mesh) parent: Option<usize>,
    pub(in crate::mesh) transform: Transform,
    /// Instead of the transform, unless the node is animated.
    pub(in crate::mesh) matrix: Option<DMat4>,
    /// Weights of the morph targets of its mesh.
    pub(in crate::mesh) weights: Vec<f32>,
}

/// Scaling, then rotation, then translation.
#[derive(Clone, Copy, Debug)]
pub(in crate::mesh) struct Transform {
    pub(in crate::mesh) translation: Vec3,
    pub(in crate::mesh) rotation: Quat,
    pub(in crate::mesh) scale: Vec3,
}

impl Default for Transform {
    fn default() -> Self {
        Self { translation: Vec3::ZERO, rotation: Quat::IDENTITY, scale: Vec3::ONE }
    }
}

/// One primitive of one node; instances follow each other in the order of the mesh's vertices.
#[derive(Clone, Debug, Default)]
pub(in crate::mesh) struct Instance {
    pub(in crate::mesh) node: usize,
    pub(in crate::mesh) positions: Vec<Vec3>,
    /// Per morph target an offset per vertex.
    pub(in crate::mesh) targets: Vec<Vec<Vec3>>,
    pub(in crate::mesh) skin: Option<Skin>,
}

/// How joints move the vertices of an instance.
#[derive(Clone, Debug)]
pub(in crate::mesh) struct Skin {
    /// Nodes, with the inverse of where each was when the mesh was bound.
    pub(in crate::mesh) joints: Vec<(usize, DMat4)>,
    /// Per set, per vertex four joints and what each counts for.
    pub(in crate::mesh) influences: Vec<Vec<([u16; 4], [f32; 4])>>,
}

/// Where every node is at one time.
pub(in crate::mesh) struct Pose {
    pub(super) transforms: Vec<Transform>,
    pub(super) matrices: Vec<Option<DMat4>>,
    pub(super) weights: Vec<Vec<f32>>,
}

impl Rig {
    /// The pose that the nodes themselves describe.
    pub(in crate::mesh) fn rest(&self) -> Pose {
        Pose {
            transforms: self.nodes.iter().map(|node| node.transform).collect(),
            matrices: self.nodes.iter().map(|node| node.matrix).collect(),
            weights: self.nodes.iter().map(|node| node.weights.clone()).collect(),
        }
    }

    /// Positions of all instances' vertices, one instance after the other, into `out`.
    pub(in crate::mesh) fn positions(&self, pose: &Pose, out: &mut Vec<Vec3>) {
        let world = self.world_from_nodes(pose);
        out.clear();
        for instance in &self.instances {
            let place = instance.place(&world);
            let weights = &pose.weights[instance.node];
            let position = |vertex: usize| {
                let mut position = instance.positions[vertex].as_dvec3();
                for (target, &weight) in instance.targets.iter().zip(weights) {
                    position += target[vertex].as_dvec3() * f64::from(weight);
                }
                place.at(vertex).transform_point3(position).as_vec3()
            };
            out.par_extend((0..instance.positions.len()).into_par_iter().with_min_len(GRAIN).map(position));
        }
    }

    /// Where every node is.
    pub(in crate::mesh) fn world_from_nodes(&self, pose: &Pose) -> Vec<DMat4> {
        let mut world = vec![DMat4::IDENTITY; self.nodes.len()];
        for &node in &self.order {
            let Transform { translation, rotation, scale } = pose.transforms[node];
            let local = pose.matrices[node].unwrap_or_else(|| {
                let rotation = unit(rotation).as_dquat();
                DMat4::from_scale_rotation_translation(scale.as_dvec3(), rotation, translation.as_dvec3())
            });
            world[node] = self.nodes[node].parent.map_or(local, |parent| world[parent] * local);
        }
        world
    }
}

impl Instance {
    /// Turns normals at the vertices as the nodes' places turn the faces.
    pub(in crate::mesh) fn turn_normals(&self, world: &[DMat4], normals: &mut [Vec3]) {
        let place = self.place(world);
        // With the triangles' order, the side that their normals are on is turned around.
        let side = if self.is_mirrored(world) { -1.0 } else { 1.0 };
        for (vertex, normal) in normals.iter_mut().enumerate() {
            // The cofactors turn normals as the matrix turns areas, and exist where its inverse does not.
            *normal = (cofactors(place.at(vertex)) * normal.as_dvec3() * side).normalize_or_zero().as_vec3();
        }
    }

    /// Whether the node mirrors the instance, so that its triangles run the other way round (glTF 2.0, section 3.7.4).
    pub(in crate::mesh) fn is_mirrored(&self, world: &[DMat4]) -> bool {
        self.skin.is_none() && world[self.node].determinant() < 0.0
    }

    fn place(&self, world: &[DMat4]) -> Place<'_> {
        match &self.skin {
            // A skin replaces the place of the node that carries the mesh (glTF 2.0, section 3.7.3.3).
            Some(skin) => Place::Skin(skin, skin.joints.iter().map(|&(node, inverse)| world[node] * inverse).collect()),
            None => Place::Node(world[self.node]),
        }
    }
}

/// What takes an instance's vertices to the world.
enum Place<'a> {
    Node(DMat4),
    Skin(&'a Skin, Vec<DMat4>),
}

impl Place<'_> {
    fn at(&self, vertex: usize) -> DMat4 {
        let (skin, matrices) = match self {
            Self::Node(matrix) => return *matrix,
            Self::Skin(skin, matrices) => (skin, matrices),
        };
        let (mut sum, mut total) = (DMat4::ZERO, 0.0);
        for influences in &skin.influences {
            let (joints, weights) = influences[vertex];
            for (joint, weight) in joints.into_iter().zip(weights).filter(|(_, weight)| *weight != 0.0) {
                sum += matrices[joint as usize] * f64::from(weight);
                total += f64::from(weight);
            }
        }
        // A vertex that no joint holds stays where the mesh was bound.
        if total > 0.0 { sum * (1.0 / total) } else { DMat4::IDENTITY }
    }
}

/// The determinant times the transposed inverse.
fn cofactors(matrix: DMat4) -> DMat3 {
    let [x, y, z]: [DVec3; 3] = [matrix.x_axis, matrix.y_axis, matrix.z_axis].map(|axis| axis.truncate());
    DMat3::from_cols(y.cross(z), z.cross(x), x.cross(y))
}
