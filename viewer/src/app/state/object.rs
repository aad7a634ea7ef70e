//! The objects of a scene.

use std::collections::BTreeMap;

use glam::{DMat4, DVec3};
use serde::{Deserialize, Serialize};
use tam_gen::Preset;

use super::document::{Document, MeshSource, PresetSource};
use super::look::Look;
use crate::mesh::Mesh;
use crate::scene::Material;
use crate::scene_file::{ObjectEntry, PartEntry, Place, part_numbers};

/// What an object is beside its mesh, look and strokes.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct Standing {
    /// What it is called; empty: as its mesh.
    pub name: String,
    /// Where it stands.
    pub place: Place,
    /// Factors along the mesh's own axes.
    pub stretch: DVec3,
    /// Whether it is drawn.
    pub visible: bool,
    /// What is said of all its parts beside the look: materials, and the ink.
    pub words: PartEntry,
    /// Parts of the mesh that differ, by their names.
    pub parts: BTreeMap<String, PartEntry>,
}

impl Default for Standing {
    fn default() -> Self {
        Self {
            name: String::new(),
            place: Place::default(),
            stretch: DVec3::ONE,
            visible: true,
            words: PartEntry::default(),
            parts: BTreeMap::new(),
        }
    }
}

impl Standing {
    /// Into the world, but for parts that stand elsewhere.
    pub fn world_from_mesh(&self) -> DMat4 {
        self.place.world_from_mesh() * DMat4::from_scale(self.stretch)
    }

    /// As a scene file has it, without a mesh and a look, and without parts that the mesh has not.
    pub fn known_parts(&self, mesh: &Mesh) -> ObjectEntry {
        let mut entry = self.entry();
        entry.parts.retain(|name, _| !part_numbers(name, &mesh.parts).is_empty());
        entry
    }

    /// As a scene file has it, without a mesh and a look.
    pub fn entry(&self) -> ObjectEntry {
        ObjectEntry {
            name: self.name.clone(),
            place: (self.place != Place::default()).then_some(self.place),
            stretch: (self.stretch != DVec3::ONE).then_some(self.stretch),
            look: self.words.look.clone(),
            parts: self.parts.clone(),
            ..ObjectEntry::default()
        }
    }
}

/// An object that is not the chosen one.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct SceneObject {
    /// Name, place, parts.
    pub standing: Standing,
    /// What it shows.
    pub mesh: MeshSource,
    /// How strokes are put on it.
    pub look: Look,
    /// By part of the mesh; parts beyond take the mesh's own.
    pub materials: Vec<Material>,
    /// Where its preset came from.
    pub source: PresetSource,
    /// Its strokes, unless the chosen object has a preset of the same source.
    pub preset: Preset,
}

/// An object as it is drawn, chosen or not.
#[derive(Clone, Copy, Debug)]
pub struct ObjectRef<'a> {
    /// Name, place, parts.
    pub standing: &'a Standing,
    /// What it shows.
    pub mesh: &'a MeshSource,
    /// How strokes are put on it.
    pub look: &'a Look,
    /// By part of the mesh.
    pub materials: &'a [Material],
    /// Where its preset came from.
    pub source: &'a PresetSource,
    /// Its strokes.
    pub preset: &'a Preset,
}

impl ObjectRef<'_> {
    /// What it is called.
    pub fn name(&self) -> String {
        if self.standing.name.is_empty() { self.mesh.name() } else { self.standing.name.clone() }
    }

    /// A copy of it.
    pub fn to_owned(self) -> SceneObject {
        SceneObject {
            standing: self.standing.clone(),
            mesh: self.mesh.clone(),
            look: self.look.clone(),
            materials: self.materials.to_vec(),
            source: self.source.clone(),
            preset: self.preset.clone(),
        }
    }
}

/// Paper and ink of a preset, linear light; white and black where they are no colours.
pub fn colours_of(preset: &Preset) -> ([f32; 3], [f32; 3]) {
    preset.colours.linear().unwrap_or(([1.0; 3], [0.0; 3]))
}

impl Document {
    /// Colour of the paper, linear light: that of the first object's preset, unless another was chosen.
    pub fn paper_colour(&self) -> [f32; 3] {
        self.paper.unwrap_or_else(|| colours_of(self.object(0).preset).0)
    }

    /// Number of objects.
    pub fn object_count(&self) -> usize {
        self.others.len() + 1
    }

    /// All objects, in order.
    pub fn objects(&self) -> impl Iterator<Item = ObjectRef<'_>> {
        (0..self.object_count()).map(|index| self.object(index))
    }

    /// Where the chosen object stands among all.
    pub fn chosen(&self) -> usize {
        self.chosen.min(self.others.len())
    }

    /// An object; beyond the last one, that.
    pub fn object(&self, index: usize) -> ObjectRef<'_> {
        let chosen = self.chosen();
        let other = if index < chosen { self.others.get(index) } else { self.others.get(index.saturating_sub(1)) };
        match other {
            Some(SceneObject { standing, mesh, look, materials, source, preset }) if index != chosen => {
                // A preset that several objects have is changed for all of them.
                let preset = if *source == self.source { &self.preset } else { preset };
                ObjectRef { standing, mesh, look, materials, source, preset }
            }
            _ => ObjectRef {
                standing: &self.standing,
                mesh: &self.mesh,
                look: &self.look,
                materials: &self.materials,
                source: &self.source,
                preset: &self.preset,
            },
        }
    }

    /// Puts all objects in the place of those that are there, and chooses one of them; without any nothing changes.
    pub fn set_objects(&mut self, mut objects: Vec<SceneObject>, chosen: usize) {
        if objects.is_empty() {
            return;
        }
        self.chosen = chosen.min(objects.len() - 1);
        let SceneObject { standing, mesh, look, materials, source, preset } = objects.remove(self.chosen);
        (self.standing, self.mesh, self.look, self.materials) = (standing, mesh, look, materials);
        (self.source, self.preset) = (source, preset);
        self.others = objects;
    }

    /// Chooses an object: panels show and change it.
    pub fn choose(&mut self, index: usize) {
        if index != self.chosen() && index < self.object_count() {
            self.set_objects(self.objects().map(ObjectRef::to_owned).collect(), index);
        }
    }

    /// Adds an object behind the last one, and chooses it.
    pub fn add_object(&mut self, object: SceneObject) {
        let mut objects: Vec<SceneObject> = self.objects().map(ObjectRef::to_owned).collect();
        objects.push(object);
        let last = objects.len() - 1;
        self.set_objects(objects, last);
    }

    /// Takes an object away, unless it is the only one.
    pub fn remove_object(&mut self, index: usize) {
        if self.others.is_empty() || index >= self.object_count() {
            return;
        }
        let mut objects: Vec<SceneObject> = self.objects().map(ObjectRef::to_owned).collect();
        objects.remove(index);
        let chosen = self.chosen();
        self.set_objects(objects, if chosen > index { chosen - 1 } else { chosen });
    }

    /// Changes name, place and parts of an object.
    pub fn set_standing(&mut self, index: usize, standing: Standing) {
        let chosen = self.chosen();
        if index == chosen {
            self.standing = standing;
        } else if let Some(other) = self.others.get_mut(if index < chosen { index } else { index - 1 }) {
            other.standing = standing;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::sample::Sample;

    fn named(document: &Document) -> Vec<String> {
        document.objects().map(|object| object.name()).collect()
    }

    #[test]
    fn choosing_changes_what_panels_show_and_nothing_else() {
        let mut document = Document::default();
        for sample in [Sample::Cube, Sample::Chair] {
            let mut other = document.object(0).to_owned();
            other.mesh = MeshSource::sample(sample);
            document.add_object(other);
        }
        assert_eq!((named(&document), document.chosen()), (["teapot", "cube", "chair"].map(String::from).to_vec(), 2));
        let before: Vec<SceneObject> = document.objects().map(ObjectRef::to_owned).collect();
        for index in [0, 1, 2, 1, 0] {
            document.choose(index);
            assert_eq!(document.objects().map(ObjectRef::to_owned).collect::<Vec<_>>(), before);
            assert_eq!(document.object(index).mesh, &document.mesh);
        }
        document.choose(7);
        assert_eq!(document.chosen(), 0);
        document.remove_object(1);
        document.remove_object(0);
        assert_eq!((named(&document), document.chosen()), (vec!["chair".to_owned()], 0));
        document.remove_object(0);
        assert_eq!(document.object_count(), 1, "one always stays");
    }

    #[test]
    fn objects_of_one_preset_share_it() {
        let mut document = Document::default();
        document.add_object(document.object(0).to_owned());
        document.preset.seed = 77;
        assert_eq!(document.object(0).preset.seed, 77);
        document.choose(0);
        assert_eq!(document.preset.seed, 77);
    }

    #[test]
    fn a_document_of_one_object_without_a_word_of_others_is_read() {
        let mut text = serde_json::to_value(Document::default()).expect("it has a JSON form");
        let fields = text.as_object_mut().expect("a table");
        for key in ["standing", "others", "chosen", "paper", "part_presets"] {
            fields.remove(key).expect("it is written");
        }
        assert_eq!(serde_json::from_value::<Document>(text).expect("it is whole"), Document::default());
    }
}
