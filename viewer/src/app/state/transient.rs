//! What a restart forgets.

use std::path::PathBuf;

use super::chart::ChartView;
use super::document::MeshSource;
use crate::mesh::deform::Deform;
use crate::scene::Material;
use crate::surface::Guide;

/// What is open, chosen and playing.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Transient {
    /// What the map panel shows.
    pub map: CellView,
    /// What the chart panel shows.
    pub chart: ChartView,
    /// What moves in the view.
    pub motion: Option<Motion>,
    /// Phase of that movement, in periods.
    pub phase: f64,
    /// What the mouse does on the mesh.
    pub tool: Tool,
    /// The question or list over the window.
    pub dialog: Option<Dialog>,
    /// Messages that are still to be shown.
    pub notices: Vec<Notice>,
    /// How often strokes were changed at random; each time is another number.
    pub randomised: u64,
    /// Whether the camera is to be set to show the whole mesh once it is there.
    pub frame_mesh: bool,
    /// Mesh, materials and guides before the mesh that is being loaded.
    pub mesh_before: Option<MeshBefore>,
    /// Whether the window may close without a question.
    pub may_close: bool,
}

/// What goes with a mesh.
#[derive(Clone, Debug, PartialEq)]
pub struct MeshBefore {
    /// The mesh.
    pub mesh: MeshSource,
    /// The materials of its objects.
    pub materials: Vec<Material>,
    /// The guides drawn on it.
    pub guides: Vec<Guide>,
}

/// What the map panel shows.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct CellView {
    /// Which of its pictures.
    pub tab: MapTab,
    /// Level of the chosen cell, 0 finest.
    pub level: usize,
    /// Column of the chosen cell, 0 lightest.
    pub column: usize,
    /// A texel to look at, by its index in the cell.
    pub texel: Option<u32>,
}

/// The pictures of a map.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum MapTab {
    /// All cells.
    #[default]
    Grid,
    /// One cell, to its texels.
    Cell,
    /// Three by three tiles.
    Tiling,
    /// What each column and level adds.
    Nesting,
    /// The stroke map.
    StrokeMap,
}

impl MapTab {
    /// All of them.
    pub const ALL: [Self; 5] = [Self::Grid, Self::Cell, Self::Tiling, Self::Nesting, Self::StrokeMap];

    /// What it is called.
    pub fn label(self) -> &'static str {
        match self {
            Self::Grid => "Grid",
            Self::Cell => "Cell",
            Self::Tiling => "Tiling",
            Self::Nesting => "Nesting",
            Self::StrokeMap => "Stroke map",
        }
    }
}

/// What moves in the view.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Motion {
    /// The camera goes round.
    Orbit,
    /// The lights go round.
    Light,
    /// The mesh bends.
    Deform(Deform),
    /// The file's own animation.
    Animation,
}

/// What the mouse does on the mesh.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Tool {
    /// Moves the camera.
    #[default]
    Navigate,
    /// Draws guides.
    Guide,
}

/// What lies over the window.
#[derive(Clone, Debug, PartialEq)]
pub enum Dialog {
    /// All shortcuts.
    Help,
    /// Search for a command; what was typed.
    Palette(String),
    /// There are unsaved changes; what was about to happen.
    Unsaved(Box<super::super::command::Command>),
    /// Versions and licences.
    About,
    /// A preset file was changed by another program while it has changes here.
    ChangedOnDisk(PathBuf),
    /// A file is there already that nobody has named in full; what would replace it.
    Replace(PathBuf, Box<super::super::command::Command>),
}

/// How bad it is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Severity {
    /// Something was done.
    Done,
    /// Something to know.
    Info,
    /// Something was mended or left out.
    Warning,
    /// Something could not be done.
    Error,
}

/// A message to the user.
#[derive(Clone, Debug, PartialEq)]
pub struct Notice {
    /// How bad it is.
    pub severity: Severity,
    /// What it says, in whole sentences.
    pub text: String,
}
