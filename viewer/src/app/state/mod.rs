//! What the application knows, apart from windows, devices and threads: plain data that can be written to a file.

mod chart;
mod document;
mod look;
mod object;
mod settings;
mod transient;

use std::collections::BTreeMap;
use std::path::PathBuf;

use serde::{Deserialize, Serialize};
use tam_gen::Preset;

pub use chart::{ChartSettings, ChartSort, ChartTab, ChartView, FitSettings};
pub use document::{Compare, Document, MeshSource, PresetSource};
pub use look::{FieldChoice, Look};
pub use object::{ObjectRef, SceneObject, Standing, colours_of};
pub use settings::{ExportSettings, Navigation, PictureSettings, Settings, Theme, TurntableSettings};
pub use transient::{CellView, Dialog, MapTab, MeshBefore, Motion, Notice, Severity, Tool, Transient};

use crate::Camera;

/// All state. Panels read it; `apply` alone changes it.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct State {
    /// What undo brings back.
    pub document: Document,
    /// Where the mesh is seen from; has a history of its own.
    pub camera: Camera,
    /// What stays from document to document.
    pub settings: Settings,
    /// The presets as they were last read or saved; what differs is unsaved.
    pub saved: BTreeMap<String, Preset>,
    /// What a restart forgets.
    #[serde(skip)]
    pub transient: Transient,
}

impl State {
    /// Whether the preset of the chosen object differs from what is on disk.
    pub fn is_unsaved(&self) -> bool {
        self.saved.get(&self.document.source.key()) != Some(&self.document.preset)
    }

    /// Whether that of any object does.
    pub fn has_unsaved(&self) -> bool {
        self.document.objects().any(|object| self.saved.get(&object.source.key()) != Some(object.preset))
    }

    /// What the preset is called.
    pub fn preset_name(&self) -> String {
        self.document.source.name()
    }

    /// The preset before it was changed, where it was ever read or saved.
    pub fn saved_preset(&self) -> Option<&Preset> {
        self.saved.get(&self.document.source.key())
    }

    /// Puts a preset file on top of the recent ones.
    pub(super) fn remember_preset(&mut self, path: &std::path::Path) {
        remember(&mut self.settings.recent_presets, path);
    }

    /// Puts a mesh file on top of the recent ones.
    pub(super) fn remember_mesh(&mut self, path: &std::path::Path) {
        remember(&mut self.settings.recent_meshes, path);
    }
}

/// Files that are remembered.
const RECENT: usize = 12;

fn remember(recent: &mut Vec<PathBuf>, path: &std::path::Path) {
    recent.retain(|known| known != path);
    recent.insert(0, path.to_owned());
    recent.truncate(RECENT);
}
