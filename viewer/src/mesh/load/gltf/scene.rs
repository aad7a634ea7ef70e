//! The nodes of a scene.

use glam::{DMat4, Mat4, Quat, Vec3};
use gltf::json::Root;
use gltf::json::scene::Node as JsonNode;

use crate::mesh::MeshError;
use crate::mesh::animation::{Node, Transform};

use super::item;

/// All nodes, and the indices of those in the default scene, parents before children.
///
/// Without a scene, every node that is no one's child begins one.
pub(super) fn nodes(root: &Root) -> Result<(Vec<Node>, Vec<usize>), MeshError> {
    let mut nodes: Vec<Node> = root.nodes.iter().map(|node| own(root, node)).collect();
    for (parent, node) in root.nodes.iter().enumerate() {
        for child in node.children.iter().flatten() {
            item(&root.nodes, child.value(), "node")?;
            let known = nodes[child.value()].parent.replace(parent);
            if let Some(other) = known {
                let child = child.value();
                return Err(MeshError::damaged(format!(
                    "node {child} is a child of both node {other} and node {parent}"
                )));
            }
        }
    }
    let scene = match root.scene {
        Some(scene) => Some(item(&root.scenes, scene.value(), "scene")?),
        None => root.scenes.first(),
    };
    let mut drawn = vec![false; nodes.len()];
    let mut order: Vec<usize> = match scene {
        Some(scene) => scene.nodes.iter().map(|node| node.value()).collect(),
        None => (0..nodes.len()).filter(|&node| nodes[node].parent.is_none()).collect(),
    };
    for &node in &order {
        item(&root.nodes, node, "node")?;
        if std::mem::replace(&mut drawn[node], true) {
            return Err(MeshError::damaged(format!("node {node} is in its scene twice")));
        }
        if let Some(parent) = nodes[node].parent {
            return Err(MeshError::damaged(format!("node {node} is in a scene and a child of node {parent}")));
        }
    }
    // Every node has one parent at most, and those that begin a scene have none: no circle can be entered.
    let mut next = 0;
    while let Some(&node) = order.get(next) {
        next += 1;
        order.extend(root.nodes[node].children.iter().flatten().map(|child| child.value()));
    }
    Ok((nodes, order))
}

fn own(root: &Root, node: &JsonNode) -> Node {
    let default = Transform::default();
    let transform = Transform {
        translation: node.translation.map_or(default.translation, Vec3::from),
        rotation: node.rotation.map_or(default.rotation, |rotation| Quat::from_array(rotation.0)),
        scale: node.scale.map_or(default.scale, Vec3::from),
    };
    let mesh = node.mesh.and_then(|mesh| root.meshes.get(mesh.value()));
    let weights = node.weights.clone().or_else(|| mesh.and_then(|mesh| mesh.weights.clone()));
    let matrix: Option<DMat4> = node.matrix.map(|matrix| Mat4::from_cols_array(&matrix).as_dmat4());
    Node { parent: None, transform, matrix, weights: weights.unwrap_or_default() }
}
