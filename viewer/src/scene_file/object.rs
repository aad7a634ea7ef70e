//! What a scene file says of an object.

use std::collections::BTreeMap;
use std::path::PathBuf;

use glam::{DMat4, DVec3};
use serde::{Deserialize, Deserializer, Serialize, Serializer};

use super::look::LookEntry;
use super::value;
use super::word::{Given, Kind, Word};
use crate::ranges;

/// Where an object stands: scaled, then turned, then moved.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Place {
    /// In world units.
    pub translation: DVec3,
    /// About the upright axis, as the camera's azimuth is counted.
    pub turn_deg: f64,
    /// Of all three axes, > 0.
    pub scale: f64,
}

impl Default for Place {
    fn default() -> Self {
        Self { translation: DVec3::ZERO, turn_deg: 0.0, scale: 1.0 }
    }
}

impl Place {
    /// Into the world.
    pub fn world_from_mesh(&self) -> DMat4 {
        DMat4::from_translation(self.translation)
            * DMat4::from_rotation_y(self.turn_deg.to_radians())
            * DMat4::from_scale(DVec3::splat(self.scale))
    }

    fn written(&self) -> Given {
        let Self { translation, turn_deg, scale } = *self;
        let mut numbers = translation.to_array().to_vec();
        if turn_deg != 0.0 || scale != 1.0 {
            numbers.push(turn_deg);
        }
        if scale != 1.0 {
            numbers.push(scale);
        }
        Given::Numbers(numbers)
    }
}

/// A mesh in words; objects of the same one share its upload.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub struct MeshEntry {
    /// A sample's name, or a file.
    pub named: PathBuf,
    /// Triangles of a sample, about; `None`: where it looks right.
    pub triangles: Option<u32>,
}

/// An object in words.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct ObjectEntry {
    /// What it is called; empty: as its mesh.
    pub name: String,
    /// A sample's name, or a file.
    pub mesh: PathBuf,
    /// Triangles of a sample, about.
    pub triangles: Option<u32>,
    /// Where it stands.
    pub place: Option<Place>,
    /// Factors along the mesh's own axes.
    pub stretch: Option<DVec3>,
    /// How it is drawn.
    pub look: LookEntry,
    /// Parts of the mesh that differ from it, by their names in the file.
    pub parts: BTreeMap<String, PartEntry>,
}

/// What differs for a part of an object.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct PartEntry {
    /// Where it stands, as seen from the object.
    pub place: Option<Place>,
    /// How it is drawn.
    pub look: LookEntry,
}

const PLACE: Kind = Kind::Numbers("X,Y,Z[,TURN[,SCALE]]");

impl ObjectEntry {
    /// Its words beside those of its look.
    pub const WORDS: &[Word<Self>] = &[
        Word {
            name: "name",
            kind: Kind::Text("a name that no other object has"),
            about: "What it is called; as its mesh where nothing is said",
            set: |object, text| {
                object.name = text.to_owned();
                Ok(())
            },
            get: |object| (!object.name.is_empty()).then(|| Given::Text(object.name.clone())),
        },
        Word {
            name: "mesh",
            kind: Kind::Text("a sample, or an OBJ, glTF, GLB, PLY or STL file"),
            about: "A sample, or a file as seen from here",
            set: |object, text| {
                object.mesh = text.into();
                if text.is_empty() { Err("a name or a file is expected".into()) } else { Ok(()) }
            },
            get: |object| Some(Given::Text(object.mesh.display().to_string())),
        },
        Word {
            name: "triangles",
            kind: Kind::Number(ranges::SAMPLE_TRIANGLES),
            about: "Triangles of a sample, about",
            set: |object, text| {
                let count = value::number(text, ranges::SAMPLE_TRIANGLES)?;
                object.triangles = Some(count.round() as u32);
                Ok(())
            },
            get: |object| object.triangles.map(|count| Given::Number(count.into())),
        },
        Word {
            name: "place",
            kind: PLACE,
            about: "Where it stands: moved, turned about the upright axis in degrees, scaled",
            set: |object, text| {
                object.place = Some(value::place(text)?);
                Ok(())
            },
            get: |object| object.place.map(|place| place.written()),
        },
        Word {
            name: "stretch",
            kind: Kind::Numbers("X,Y,Z"),
            about: "Factors along the axes of the mesh",
            set: |object, text| {
                object.stretch = Some(value::stretch(text)?);
                Ok(())
            },
            get: |object| object.stretch.map(|by| Given::Numbers(by.to_array().to_vec())),
        },
    ];

    /// Sets a word that is none of its look.
    ///
    /// # Errors
    /// No word is called so, or the value makes no sense.
    pub fn set(&mut self, name: &str, text: &str) -> Result<(), String> {
        Word::set(Self::WORDS, self, name, text)
    }

    /// What was said of it beside its look, word by word.
    pub fn given(&self) -> impl Iterator<Item = (&'static str, Given)> {
        Self::WORDS.iter().filter_map(|word| Some((word.name, (word.get)(self)?)))
    }

    /// An object of a mesh, at the origin.
    pub fn of(mesh: impl Into<PathBuf>, triangles: Option<u32>) -> Self {
        Self { mesh: mesh.into(), triangles, ..Self::default() }
    }

    /// Its mesh, for what is made once for all objects of one mesh.
    pub fn mesh_entry(&self) -> MeshEntry {
        MeshEntry { named: self.mesh.clone(), triangles: self.triangles }
    }

    /// Stretched along the axes of the mesh, as it was asked for.
    pub(super) fn stretched(&self) -> DMat4 {
        DMat4::from_scale(self.stretch.unwrap_or(DVec3::ONE))
    }

    /// Its own name, or that of its mesh.
    pub(super) fn given_name(&self) -> String {
        let stem = || self.mesh.file_stem().map_or("mesh".into(), |stem| stem.to_string_lossy().into_owned());
        if self.name.is_empty() { stem() } else { self.name.clone() }
    }

    pub(super) fn paths_mut(&mut self) -> impl Iterator<Item = &mut PathBuf> {
        let parts = self.parts.values_mut().flat_map(|part| part.look.paths_mut());
        std::iter::once(&mut self.mesh).chain(self.look.paths_mut()).chain(parts)
    }
}

impl PartEntry {
    /// Its word beside those of its look.
    pub(super) const WORDS: &[Word<Self>] = &[Word {
        name: "place",
        kind: PLACE,
        about: "Where it stands, as seen from the object",
        set: |part, text| {
            part.place = Some(value::place(text)?);
            Ok(())
        },
        get: |part| part.place.map(|place| place.written()),
    }];

    /// What was said of it beside its look, word by word.
    pub(super) fn given(&self) -> impl Iterator<Item = (&'static str, Given)> {
        Self::WORDS.iter().filter_map(|word| Some((word.name, (word.get)(self)?)))
    }
}

/// As words and their texts.
impl Serialize for PartEntry {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let words = self.given().chain(self.look.given());
        serializer.collect_map(words.map(|(name, given)| (name, given.to_string())))
    }
}

impl<'de> Deserialize<'de> for PartEntry {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        let mut part = Self::default();
        for (name, text) in BTreeMap::<String, String>::deserialize(deserializer)? {
            let own = Self::WORDS.iter().any(|word| word.name == name);
            let set = if own { Word::set(Self::WORDS, &mut part, &name, &text) } else { part.look.set(&name, &text) };
            set.map_err(serde::de::Error::custom)?;
        }
        Ok(part)
    }
}
