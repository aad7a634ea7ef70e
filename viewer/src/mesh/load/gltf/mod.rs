//! Reading glTF 2.0 and GLB.
//!
//! The `gltf` crate types the JSON; every index, count and range in it is checked here before anything is read.

mod accessor;
mod clip;
mod container;
mod primitive;
mod scene;

use crate::mesh::animation::Rig;
use crate::mesh::{MeshError, RawMesh};

use super::{Kind, Resolve};
use accessor::Buffers;
use gltf::json::Root;

/// Extensions that a file may require, by how their names begin: they are read, or change only how surfaces look.
const TOLERATED: [&str; 7] = [
    "KHR_mesh_quantization",
    "KHR_materials_",
    "KHR_texture_",
    "KHR_lights_",
    "KHR_xmp",
    "EXT_texture_",
    "EXT_lights_",
];

/// Reads the triangles of the default scene, and the first animation.
///
/// Every primitive of every node becomes a part with its material's base colour, placed by the node's transform.
/// Lines and points are passed over, with a note.
pub(super) fn read(bytes: &[u8], resolve: Resolve) -> Result<RawMesh, MeshError> {
    let (json, blob) = container::split(bytes)?;
    let root: Root = gltf::json::deserialize::from_slice(json).map_err(|error| {
        // What is no JSON at all is another kind of file; the rest is a glTF with a fault.
        if error.is_syntax() && !json.trim_ascii_start().starts_with(b"{") {
            let what = format!("it begins with \"{}\"", super::text::shown(json));
            return MeshError::WrongKind { kind: Kind::Gltf, what };
        }
        MeshError::damaged(format!("its JSON: {error}"))
    })?;
    let refused = |name: &&String| !TOLERATED.iter().any(|tolerated| name.starts_with(tolerated));
    if let Some(name) = root.extensions_required.iter().find(refused) {
        return Err(MeshError::Unsupported(format!("the extension {name}, which the file requires,")));
    }
    let buffers = Buffers::new(&root, bytes.len(), blob, resolve)?;

    let (nodes, order) = scene::nodes(&root)?;
    let mut rig = Rig { nodes, order, ..Default::default() };
    let mut raw = RawMesh::default();
    primitive::instances(&root, &buffers, &mut rig, &mut raw)?;
    rig.positions(&rig.rest(), &mut raw.positions);
    raw.animation = clip::animation(&root, &buffers, rig, &mut raw.notes)?;
    Ok(raw)
}

/// The item of an index in the JSON, or what is wrong with it.
fn item<'a, T>(items: &'a [T], index: usize, what: &str) -> Result<&'a T, MeshError> {
    items
        .get(index)
        .ok_or_else(|| MeshError::damaged(format!("it refers to {what} {index}, and there are {}", items.len())))
}
