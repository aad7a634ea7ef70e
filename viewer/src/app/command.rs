//! Everything that a user can ask for.

use std::path::PathBuf;

use tam_gen::Preset;

use super::layout::Pane;
use super::state::{
    CellView, ChartSettings, ChartView, Compare, Dialog, ExportSettings, FitSettings, Look, MeshSource, Motion,
    Navigation, PictureSettings, Standing, Theme, Tool, TurntableSettings,
};
use crate::scene::{Lights, Material};
use crate::{Camera, Inspect};

/// One request. Panels push these; `apply` carries them out.
#[derive(Clone, Debug, PartialEq)]
pub enum Command {
    /// Change the preset.
    SetPreset(Box<Preset>),
    /// Change method, mapping or what they need.
    SetLook(Box<Look>),
    /// Change the preset, and method, mapping and form, in one step.
    SetMaterial(Box<Preset>, Box<Look>),
    /// Choose what of the drawing itself is shown.
    SetInspect(Inspect),
    /// Change the lights.
    SetLights(Lights),
    /// Change the materials of the mesh's objects.
    SetMaterials(Vec<Material>),
    /// Show another mesh.
    SetMesh(MeshSource),
    /// Go back to the mesh before this one, which could not be loaded.
    KeepMesh,
    /// Compare with another look or preset, or no longer.
    SetCompare(Option<Box<Compare>>),
    /// Change every stroke number that is not locked.
    Randomise,
    /// Lock a stroke number, or no longer.
    Lock(String, bool),
    /// Choose an object by its number: panels show and change it.
    Choose(usize),
    /// Add an object of a mesh, or ask which file.
    AddObject(Option<MeshSource>),
    /// Add a copy of the chosen object.
    DuplicateObject,
    /// Take an object away.
    RemoveObject(usize),
    /// Change the colour of the paper, linear light; `None`: that of the first object's preset.
    SetPaper(Option<[f32; 3]>),
    /// Change name, place and parts of an object.
    SetStanding(usize, Box<Standing>),
    /// Move the camera.
    SetCamera(Camera),
    /// Show the whole mesh.
    FrameMesh,

    /// Take back the last change.
    Undo,
    /// Do it again.
    Redo,
    /// Go back to where the camera was.
    UndoView,
    /// And forth again.
    RedoView,

    /// Open a preset that comes with the tool.
    OpenShipped(String),
    /// Open a preset file, or ask which.
    OpenPreset(Option<PathBuf>),
    /// Start from the plainest preset.
    NewPreset,
    /// Save the preset.
    Save,
    /// Save it to this file, or ask where to.
    SaveAs(Option<PathBuf>),
    /// Go on with a copy.
    Duplicate,
    /// Go back to what is on disk.
    Revert,
    /// Read the preset file again, as another program has changed it.
    Reload,
    /// Load a mesh file, or ask which.
    OpenMesh(Option<PathBuf>),
    /// Open a scene file, or ask which.
    OpenScene(Option<PathBuf>),
    /// Save the scene to this file, or ask where to.
    SaveScene(Option<PathBuf>),
    /// Put the command that draws the view on the clipboard.
    CopyCommand,
    /// Open files, whatever they are.
    OpenFiles(Vec<PathBuf>),
    /// Forget the recent files.
    ForgetRecent,

    /// Write the map.
    Export,
    /// Change what is exported.
    SetExport(ExportSettings),
    /// Ask for the folder of exports.
    ChooseExportFolder,
    /// Export into this folder.
    ExportInto(PathBuf),
    /// Show the folder of exports.
    Reveal(PathBuf),
    /// Save a picture to this file, or ask where to.
    SavePicture(Option<PathBuf>),
    /// Change what pictures are like.
    SetPicture(PictureSettings),
    /// Save a turntable to this file, or ask where to.
    SaveTurntable(Option<PathBuf>),
    /// Change what turntables are like.
    SetTurntable(TurntableSettings),
    /// Save the guides to this file, or ask where to.
    SaveGuides(Option<PathBuf>),
    /// Read guides from this file, or ask which.
    OpenGuides(Option<PathBuf>),
    /// Stop what is being written.
    Cancel,

    /// Change what the chart measures.
    SetChart(ChartSettings),
    /// Change what a fit is asked for.
    SetFit(FitSettings),
    /// Find the cheapest way to draw the scene.
    Fit,
    /// Stop that.
    CancelFit,

    /// Choose what the map panel shows.
    ShowCell(CellView),
    /// Choose what the chart panel shows.
    ShowChart(ChartView),
    /// Bring a panel to the front.
    ShowPane(Pane),
    /// Put all panels where they were at first.
    ResetLayout,
    /// Play something, or stop.
    Play(Option<Motion>),
    /// Choose what the mouse does on the mesh.
    SetTool(Tool),
    /// Choose the window's colours.
    SetTheme(Theme),
    /// Choose the size of everything.
    SetZoom(f32),
    /// Choose what the mouse does in the view.
    SetNavigation(Navigation),
    /// Show the sun over the mesh, or not.
    ShowLightHandle(bool),
    /// Open or close what lies over the window.
    ShowDialog(Option<Dialog>),
    /// Close the window, after a question if there are changes.
    Quit,
    /// Do it without asking: changes are lost.
    Discard(Box<Command>),
    /// Do it: the file that it writes to may be replaced.
    Replace(Box<Command>),
}
