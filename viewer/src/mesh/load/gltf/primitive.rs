//! The triangles of the nodes' meshes.

use glam::{DMat4, Mat4, Vec2, Vec3};
use gltf::json::accessor::Type;
use gltf::json::mesh::{Mode, Primitive, Semantic};
use gltf::json::validation::Checked;
use gltf::json::{Accessor, Index, Root};

use crate::mesh::animation::{Instance, Rig, Skin};
use crate::mesh::{MeshError, RawMesh, RawPart};

use super::accessor::Buffers;
use super::item;

/// Adds every primitive of every drawn node: an instance to the rig; triangles, parts and attributes to `raw`, but not
/// its positions, which the rig gives.
pub(super) fn instances(root: &Root, buffers: &Buffers, rig: &mut Rig, raw: &mut RawMesh) -> Result<(), MeshError> {
    let world = rig.world_from_nodes(&rig.rest());
    let mut reader = Reader { root, buffers, world, items: 0, vertices: 0, passed_over: 0 };
    for node in rig.order.clone() {
        let Some(mesh) = root.nodes[node].mesh else { continue };
        let mesh = item(&root.meshes, mesh.value(), "mesh")?;
        for primitive in &mesh.primitives {
            let name = root.nodes[node].name.as_ref().or(mesh.name.as_ref());
            reader.primitive(primitive, node, name.cloned().unwrap_or_default(), rig, raw)?;
        }
    }
    // Attributes that only some primitives have.
    if !raw.normals.is_empty() {
        raw.normals.resize(reader.vertices, Vec3::ZERO);
    }
    if !raw.uvs.is_empty() {
        raw.uvs.resize(reader.vertices, Vec2::ZERO);
    }
    if reader.passed_over > 0 {
        raw.notes.push(format!("{} primitives of lines or points were passed over.", reader.passed_over));
    }
    Ok(())
}

struct Reader<'a> {
    root: &'a Root,
    buffers: &'a Buffers<'a>,
    /// Where the nodes are at rest.
    world: Vec<DMat4>,
    /// Vertices and triangles so far, morph targets counted.
    items: u64,
    vertices: usize,
    passed_over: usize,
}

impl Reader<'_> {
    fn primitive(
        &mut self,
        primitive: &Primitive,
        node: usize,
        name: String,
        rig: &mut Rig,
        raw: &mut RawMesh,
    ) -> Result<(), MeshError> {
        let attribute = |semantic: Semantic| primitive.attributes.get(&Checked::Valid(semantic)).copied();
        let mode = match primitive.mode {
            Checked::Valid(mode) => mode,
            Checked::Invalid => return Err(MeshError::damaged("a primitive of an unknown mode")),
        };
        let positions = attribute(Semantic::Positions);
        let (true, Some(positions)) =
            (matches!(mode, Mode::Triangles | Mode::TriangleStrip | Mode::TriangleFan), positions)
        else {
            self.passed_over += 1;
            return Ok(());
        };
        let targets = primitive.targets.as_deref().unwrap_or_default();
        let count = self.buffers.count(positions)?;
        self.spend(count.saturating_mul(1 + targets.len() as u64))?;
        let count = count as usize;
        let vectors = |index: Index<Accessor>| -> Result<Vec<Vec3>, MeshError> {
            let vectors = self.buffers.vectors::<3>(index, Type::Vec3)?;
            same_length(vectors.len(), count, "vectors")?;
            Ok(vectors.into_iter().map(Vec3::from).collect())
        };
        let morph = |target: &gltf::json::mesh::MorphTarget| match target.positions {
            Some(offsets) => vectors(offsets),
            // A target may move normals alone.
            None => Ok(vec![Vec3::ZERO; count]),
        };
        let mut instance = Instance {
            node,
            positions: vectors(positions)?,
            targets: targets.iter().map(morph).collect::<Result<_, _>>()?,
            skin: None,
        };
        let weights = &mut rig.nodes[node].weights;
        weights.resize(weights.len().max(targets.len()), 0.0);
        let morphed = !targets.is_empty() && weights.iter().any(|weight| *weight != 0.0);
        if let Some(skin) = self.root.nodes[node].skin {
            instance.skin = self.skin(primitive, skin.value(), count, rig)?;
        }

        if let Some(normals) = attribute(Semantic::Normals).filter(|_| !morphed) {
            let mut normals = vectors(normals)?;
            instance.turn_normals(&self.world, &mut normals);
            raw.normals.resize(self.vertices, Vec3::ZERO);
            raw.normals.append(&mut normals);
        }
        if let Some(uvs) = attribute(Semantic::TexCoords(0)) {
            let uvs = self.buffers.vectors::<2>(uvs, Type::Vec2)?;
            same_length(uvs.len(), count, "texture coordinates")?;
            raw.uvs.resize(self.vertices, Vec2::ZERO);
            raw.uvs.extend(uvs.into_iter().map(Vec2::from));
        }

        let start = raw.triangles.len();
        let indices = match primitive.indices {
            Some(indices) => {
                self.spend(self.buffers.count(indices)?)?;
                self.buffers.integers(indices, Type::Scalar)?
            }
            None => (0..count as u32).collect(),
        };
        let first = self.vertices as u32;
        // An index beyond this primitive must not fall into the next.
        let place = |index: u32| if (index as usize) < count { first + index } else { u32::MAX };
        let mirrored = instance.is_mirrored(&self.world);
        raw.triangles.extend(triangles(&indices, mode).map(|[a, b, c]| {
            let [b, c] = if mirrored { [c, b] } else { [b, c] };
            [a, b, c].map(place)
        }));
        let (material, colour) = self.material(primitive)?;
        let name = if name.is_empty() { material } else { name };
        raw.parts.push(RawPart { name, colour, triangles: start..raw.triangles.len() });
        self.vertices += count;
        rig.instances.push(instance);
        Ok(())
    }

    /// Counts what is about to be unfolded.
    fn spend(&mut self, items: u64) -> Result<(), MeshError> {
        self.items = self.items.saturating_add(items);
        let most = self.buffers.most_items;
        if self.items > most {
            return Err(MeshError::TooMany { what: "vertices and triangles", given: self.items, most });
        }
        Ok(())
    }

    fn skin(&self, primitive: &Primitive, skin: usize, count: usize, rig: &Rig) -> Result<Option<Skin>, MeshError> {
        let json = item(&self.root.skins, skin, "skin")?;
        let nodes = json.joints.iter().map(|joint| {
            item(&rig.nodes, joint.value(), "node")?;
            Ok(joint.value())
        });
        let nodes = nodes.collect::<Result<Vec<_>, MeshError>>()?;
        let inverses: Vec<DMat4> = match json.inverse_bind_matrices {
            Some(matrices) => {
                let matrices = self.buffers.vectors::<16>(matrices, Type::Mat4)?;
                if matrices.len() < nodes.len() {
                    let what = format!("skin {skin} has {} matrices for {} joints", matrices.len(), nodes.len());
                    return Err(MeshError::damaged(what));
                }
                matrices.iter().map(|matrix| Mat4::from_cols_array(matrix).as_dmat4()).collect()
            }
            None => vec![DMat4::IDENTITY; nodes.len()],
        };
        let mut influences = Vec::new();
        loop {
            let set = influences.len() as u32;
            let attribute = |semantic| primitive.attributes.get(&Checked::Valid(semantic)).copied();
            let (Some(joints), Some(weights)) = (attribute(Semantic::Joints(set)), attribute(Semantic::Weights(set)))
            else {
                break;
            };
            let joints = self.buffers.integers(joints, Type::Vec4)?;
            let weights = self.buffers.vectors::<4>(weights, Type::Vec4)?;
            same_length(joints.len(), count * 4, "joints")?;
            same_length(weights.len(), count, "weights of joints")?;
            if let Some(joint) = joints.iter().find(|joint| **joint as usize >= nodes.len().min(1 << 16)) {
                let what = format!("a vertex hangs on joint {joint} of the {} of skin {skin}", nodes.len());
                return Err(MeshError::damaged(what));
            }
            let joints = joints.as_chunks::<4>().0.iter().map(|joints| joints.map(|joint| joint as u16));
            influences.push(joints.zip(weights).collect());
        }
        // Without influences the mesh is placed by its node, as a mesh without a skin.
        let joints = nodes.into_iter().zip(inverses).collect();
        Ok((!influences.is_empty()).then_some(Skin { joints, influences }))
    }

    /// Name and base colour.
    fn material(&self, primitive: &Primitive) -> Result<(String, Option<[f32; 3]>), MeshError> {
        let Some(material) = primitive.material else { return Ok(Default::default()) };
        let material = item(&self.root.materials, material.value(), "material")?;
        let [r, g, b, _] = material.pbr_metallic_roughness.base_color_factor.0;
        let colour = [r, g, b].map(|channel| channel.clamp(0.0, 1.0));
        let finite = colour.iter().all(|channel| channel.is_finite());
        Ok((material.name.clone().unwrap_or_default(), finite.then_some(colour)))
    }
}

fn same_length(given: usize, vertices: usize, what: &'static str) -> Result<(), MeshError> {
    if given == vertices { Ok(()) } else { Err(MeshError::Lengths { what, given, vertices }) }
}

/// Lists, strips and fans as triangles (glTF 2.0, section 3.7.2.1).
fn triangles(indices: &[u32], mode: Mode) -> impl Iterator<Item = [u32; 3]> + '_ {
    let count = match mode {
        Mode::Triangles => indices.len() / 3,
        _ => indices.len().saturating_sub(2),
    };
    (0..count).map(move |at| match mode {
        Mode::TriangleStrip => [indices[at], indices[at + 1 + at % 2], indices[at + 2 - at % 2]],
        Mode::TriangleFan => [indices[at + 1], indices[at + 2], indices[0]],
        _ => [indices[at * 3], indices[at * 3 + 1], indices[at * 3 + 2]],
    })
}
