//! Scenes in words: what a scene file says of objects, looks, camera and light, before any mesh is loaded. The options of
//! the command line are the same words.

mod look;
mod object;
mod pieces;
mod read;
mod schema;
pub mod value;
mod view;
mod word;
mod write;

use std::collections::{HashMap, HashSet};
use std::path::{Path, PathBuf};

pub use look::{FieldEntry, LookEntry, MappingEntry};
pub use object::{MeshEntry, ObjectEntry, PartEntry, Place};
pub use pieces::{Piece, part_name, part_numbers, unknown_part};
pub use schema::{schema, schema_text};
pub use view::{Camera, ViewEntry};
pub use word::{Given, Kind, Word};

/// Largest scene file, in bytes: a line is enough for an object.
pub const SCENE_BYTES_MAX: u64 = 64 << 20;

/// Objects of a scene, at most: each is drawn by itself.
pub const OBJECTS_MAX: usize = 20_000;

/// What a scene file says. What it does not say is as by default.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct SceneFile {
    /// Camera, lights and paper.
    pub view: ViewEntry,
    /// What all objects have in common, where they do not say otherwise.
    pub look: LookEntry,
    /// The objects, in order.
    pub objects: Vec<ObjectEntry>,
}

impl SceneFile {
    /// Gives every object a name that no other has: its own, or that of its mesh, with a number where it is taken.
    pub fn name_objects(&mut self) {
        let mut taken = HashSet::new();
        // The number that was given last after each name.
        let mut numbers: HashMap<String, usize> = HashMap::new();
        for object in &mut self.objects {
            let name = object.given_name();
            object.name.clone_from(&name);
            while !taken.insert(object.name.clone()) {
                let number = numbers.entry(name.clone()).or_insert(1);
                *number += 1;
                object.name = format!("{name}-{number}");
            }
        }
    }

    /// All paths as they are seen from the folder in which `file` lies.
    pub(crate) fn found_from(&mut self, file: &Path) {
        let folder = file.parent().unwrap_or(Path::new(""));
        for path in self.paths_mut() {
            if is_file(path) {
                *path = folder.join(&*path);
            }
        }
    }

    /// All paths as they are written into a file in `folder`: relative where they lie in or under it.
    #[must_use]
    pub fn relative_to(&self, folder: &Path) -> Self {
        let mut file = self.clone();
        for path in file.paths_mut() {
            if let Ok(inside) = path.strip_prefix(folder) {
                *path = inside.to_owned();
                if !is_file(path) {
                    *path = Path::new(".").join(&*path);
                }
            } else if is_file(path)
                && let Ok(absolute) = std::path::absolute(&*path)
            {
                *path = absolute;
            }
        }
        file
    }

    fn paths_mut(&mut self) -> impl Iterator<Item = &mut PathBuf> {
        let objects = self.objects.iter_mut().flat_map(ObjectEntry::paths_mut);
        self.look.paths_mut().chain(objects)
    }
}

/// Whether a file of TOML is a scene: it has objects.
pub fn is_scene(path: &Path) -> bool {
    let text = std::fs::read_to_string(path).unwrap_or_default();
    toml::de::DeTable::parse_recoverable(&text).0.get_ref().contains_key("object")
}

/// Whether what was named is a file: a plain word is the name of a preset or a sample.
fn is_file(named: &Path) -> bool {
    named.components().count() != 1 || named.extension().is_some()
}
