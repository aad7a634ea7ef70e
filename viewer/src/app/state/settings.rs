//! What stays from document to document.

use std::path::PathBuf;

use serde::{Deserialize, Serialize};

use super::chart::{ChartSettings, FitSettings};

/// Habits and places.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct Settings {
    /// Light or dark.
    pub theme: Theme,
    /// Size of everything, as a multiple of the system's, 0.5..=3.
    pub zoom: f32,
    /// What the mouse does in the view.
    pub navigation: Navigation,
    /// Newest first.
    pub recent_presets: Vec<PathBuf>,
    /// Newest first.
    pub recent_meshes: Vec<PathBuf>,
    /// What is exported, and where to.
    pub export: ExportSettings,
    /// Pictures that are saved.
    pub picture: PictureSettings,
    /// Turntables that are saved.
    pub turntable: TurntableSettings,
    /// What the chart shows.
    pub chart: ChartSettings,
    /// What a fit is asked for.
    pub fit: FitSettings,
    /// Keys of strokes that a random change leaves alone.
    pub locked: Vec<String>,
    /// Whether the sun over the mesh is shown.
    pub light_handle: bool,
}

impl Default for Settings {
    fn default() -> Self {
        Self {
            theme: Theme::default(),
            zoom: 1.0,
            navigation: Navigation::default(),
            recent_presets: Vec::new(),
            recent_meshes: Vec::new(),
            export: ExportSettings::default(),
            picture: PictureSettings::default(),
            turntable: TurntableSettings::default(),
            chart: ChartSettings::default(),
            fit: FitSettings::default(),
            locked: Vec::new(),
            light_handle: true,
        }
    }
}

/// Colours of the window.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Theme {
    /// Dark, as most tools for pictures.
    #[default]
    Dark,
    /// Light.
    Light,
    /// As the system says.
    System,
}

impl Theme {
    /// All of them.
    pub const ALL: [Self; 3] = [Self::Dark, Self::Light, Self::System];

    /// What it is called.
    pub fn label(self) -> &'static str {
        match self {
            Self::Dark => "Dark",
            Self::Light => "Light",
            Self::System => "As the system",
        }
    }
}

/// Which drags move the camera.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Navigation {
    /// Left turns, middle or Shift with left shifts, the wheel zooms.
    #[default]
    Simple,
    /// Middle turns, Shift with middle shifts, Ctrl with middle zooms.
    Blender,
    /// Alt with left turns, Alt with middle shifts, Alt with right zooms.
    Maya,
}

impl Navigation {
    /// All of them.
    pub const ALL: [Self; 3] = [Self::Simple, Self::Blender, Self::Maya];

    /// What it is called.
    pub fn label(self) -> &'static str {
        match self {
            Self::Simple => "Simple",
            Self::Blender => "Blender",
            Self::Maya => "Maya",
        }
    }

    /// What it does, in one line.
    pub fn describe(self) -> &'static str {
        match self {
            Self::Simple => "drag turns, middle or Shift + drag moves, wheel zooms",
            Self::Blender => "middle turns, Shift + middle moves, Ctrl + middle or wheel zooms",
            Self::Maya => "Alt + left turns, Alt + middle moves, Alt + right or wheel zooms",
        }
    }
}

/// What an export consists of.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct ExportSettings {
    /// Names of formats, as the command line has them.
    pub formats: Vec<String>,
    /// The folder.
    pub folder: PathBuf,
    /// Whether files of the same names are replaced.
    pub overwrite: bool,
    /// Whether a contact sheet comes too.
    pub sheet: bool,
}

impl Default for ExportSettings {
    fn default() -> Self {
        Self { formats: vec!["ktx2".to_owned()], folder: PathBuf::from("."), overwrite: false, sheet: true }
    }
}

/// A picture that is saved.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct PictureSettings {
    /// Width and height, 16..=8192.
    pub size_px: [u32; 2],
    /// Leave out the paper around the mesh.
    pub transparent: bool,
}

impl Default for PictureSettings {
    fn default() -> Self {
        Self { size_px: [1920, 1080], transparent: false }
    }
}

/// A turntable that is saved.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct TurntableSettings {
    /// Side of its frames, 16..=2048.
    pub side_px: u32,
    /// Frames of one round, 2..=360.
    pub frames: u32,
    /// Frames per second, 1..=60.
    pub fps: u16,
}

impl Default for TurntableSettings {
    fn default() -> Self {
        Self { side_px: 512, frames: 48, fps: 24 }
    }
}
