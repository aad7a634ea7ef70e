//! What is being made.

use std::collections::BTreeMap;
use std::path::PathBuf;

use serde::{Deserialize, Serialize};
use tam_gen::Preset;

use super::look::Look;
use super::object::{SceneObject, Standing};
use crate::Inspect;
use crate::mesh::sample::Sample;
use crate::scene::{Lights, Material};

/// Materials on meshes in a light. Everything here is undone and redone. One object is chosen: its preset, mesh and look
/// stand here themselves, those of the others in a list.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct Document {
    /// Where the preset came from.
    pub source: PresetSource,
    /// What the strokes look like, and the colours of paper and ink.
    pub preset: Preset,
    /// What they are shown on.
    pub mesh: MeshSource,
    /// How they are put there.
    pub look: Look,
    /// What lights it.
    pub lights: Lights,
    /// By part of the mesh; parts beyond take the mesh's own.
    pub materials: Vec<Material>,
    /// Name, place and parts of the chosen object.
    pub standing: Standing,
    /// The other objects, in order.
    pub others: Vec<SceneObject>,
    /// How many of them stand before the chosen one.
    pub(super) chosen: usize,
    /// Colour of the paper, linear light; `None`: that of the first object's preset.
    pub paper: Option<[f32; 3]>,
    /// Presets that parts of objects name in place of their object's.
    pub part_presets: BTreeMap<PathBuf, Preset>,
    /// Another look or preset beside it.
    pub compare: Option<Compare>,
    /// What of the drawing itself is shown.
    #[serde(default)]
    pub inspect: Inspect,
}

impl Default for Document {
    /// The first shipped preset on the first picture that anybody sees.
    fn default() -> Self {
        let (name, _) = Preset::embedded()[0];
        let preset = Preset::named(name).and_then(Result::ok).unwrap_or_default();
        Self {
            source: PresetSource::Shipped(name.to_owned()),
            preset,
            mesh: MeshSource::default(),
            look: Look::default(),
            lights: Lights::default(),
            materials: Vec::new(),
            standing: Standing::default(),
            others: Vec::new(),
            chosen: 0,
            paper: None,
            part_presets: BTreeMap::new(),
            compare: None,
            inspect: Inspect::default(),
        }
    }
}

/// Where a preset came from, and where it is saved to.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum PresetSource {
    /// One that comes with the tool; it is saved under another name.
    Shipped(String),
    /// A file.
    File(PathBuf),
    /// Nowhere yet.
    New(String),
}

impl PresetSource {
    /// What it is called.
    pub fn name(&self) -> String {
        match self {
            Self::Shipped(name) | Self::New(name) => name.clone(),
            Self::File(path) => path.file_stem().map_or_else(String::new, |stem| stem.to_string_lossy().into_owned()),
        }
    }

    /// Tells sources apart.
    pub fn key(&self) -> String {
        match self {
            Self::Shipped(name) => format!("shipped:{name}"),
            Self::File(path) => format!("file:{}", path.display()),
            Self::New(name) => format!("new:{name}"),
        }
    }

    /// The file to save to without asking.
    pub fn file(&self) -> Option<&PathBuf> {
        match self {
            Self::File(path) => Some(path),
            _ => None,
        }
    }
}

/// What a picture shows.
#[derive(Clone, Debug, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum MeshSource {
    /// A sample, with about so many triangles.
    Sample(Sample, usize),
    /// A file.
    File(PathBuf),
}

impl MeshSource {
    /// A sample as it looks right.
    pub fn sample(sample: Sample) -> Self {
        Self::Sample(sample, sample.default_triangles())
    }

    /// What it is called.
    pub fn name(&self) -> String {
        match self {
            Self::Sample(sample, _) => sample.name().to_owned(),
            Self::File(path) => path.file_name().map_or_else(String::new, |name| name.to_string_lossy().into_owned()),
        }
    }
}

impl Default for MeshSource {
    fn default() -> Self {
        Self::sample(Sample::Teapot)
    }
}

/// The right side of a wiped picture.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Compare {
    /// How strokes are put there.
    pub look: Look,
    /// Another preset, with its name; else the same.
    pub preset: Option<(String, Preset)>,
    /// Where the picture is cut: share of its width that shows the first side, 0..=1.
    pub split: f64,
}
