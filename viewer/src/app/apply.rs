//! Carries out commands: the one place where state changes.

mod saving;

use std::path::{Path, PathBuf};

use egui_tiles::{Tile, Tree};
use tam_gen::Preset;

use super::command::Command;
use super::history::History;
use super::layout::{Pane, default_layout};
use super::randomise::randomised;
use super::scenes;
use super::state::{Dialog, Document, MeshBefore, MeshSource, Notice, PresetSource, Severity, Standing, State};
use crate::scene_file::SceneFile;
use crate::surface::guides;
pub(crate) use saving::{command_line, save_scene};
use saving::{save, save_guides, with_extension};

/// State with its past and its panels.
pub(crate) struct Model {
    /// All state.
    pub state: State,
    /// What undo knows.
    pub history: History,
    /// Where the panels are.
    pub layout: Tree<Pane>,
}

/// What a command needs of the world outside the state.
#[derive(Clone, Debug, PartialEq)]
pub enum Effect {
    /// Ask for a file or folder; the answer becomes a command.
    Ask(Ask),
    /// Write the map.
    Export,
    /// Write a picture of the view.
    SavePicture(PathBuf),
    /// Write a turntable.
    SaveTurntable(PathBuf),
    /// Stop writing.
    CancelFile,
    /// Find the cheapest way to draw the scene.
    Fit,
    /// Stop that.
    CancelFit,
    /// Show a folder to the user.
    Reveal(PathBuf),
    /// Write the scene, with the parts of its meshes.
    SaveScene(PathBuf),
    /// Copy the command that draws the view.
    CopyCommand,
    /// Load the mesh again though its name is the same.
    ReloadMesh,
    /// Close the window.
    Close,
}

/// What to ask for.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Ask {
    /// A preset to open.
    OpenPreset,
    /// Where to save the preset, which has this name.
    SavePreset(String),
    /// A mesh to open.
    OpenMesh,
    /// A mesh that becomes another object.
    AddObject,
    /// A scene to open.
    OpenScene,
    /// Where to save the scene, which has this name.
    SaveScene(String),
    /// The folder of exports.
    ExportFolder,
    /// Where to save a picture.
    SavePicture(String),
    /// Where to save a turntable.
    SaveTurntable(String),
    /// Guides to open.
    OpenGuides,
    /// Where to save guides.
    SaveGuides(String),
}

/// Kinds of files that are meshes.
pub const MESH_KINDS: [&str; 5] = ["obj", "gltf", "glb", "ply", "stl"];

/// Carries out a command; what it needs of the world is left to the caller.
pub(crate) fn apply(model: &mut Model, command: Command) -> Vec<Effect> {
    if let Some((path, command)) = with_extension(&command) {
        if path.is_file() {
            model.state.transient.dialog = Some(Dialog::Replace(path, Box::new(command)));
            return Vec::new();
        }
        return apply(model, command);
    }
    let state = &mut model.state;
    match command {
        Command::SetPreset(preset) => state.document.preset = *preset,
        Command::SetLook(look) => state.document.look = *look,
        Command::SetInspect(inspect) => state.document.inspect = inspect,
        Command::SetMaterial(preset, look) => {
            state.document.preset = *preset;
            state.document.look = *look;
        }
        Command::SetLights(lights) => state.document.lights = lights,
        Command::SetMaterials(materials) => state.document.materials = materials,
        Command::SetMesh(mesh) => set_mesh(state, mesh),
        Command::KeepMesh => match state.transient.mesh_before.take() {
            Some(MeshBefore { mesh, materials, guides }) => {
                state.document.mesh = mesh;
                state.document.materials = materials;
                state.document.look.guides = guides;
                state.transient.frame_mesh = false;
            }
            None => set_mesh(state, MeshSource::default()),
        },
        Command::SetCompare(compare) => state.document.compare = compare.map(|compare| *compare),
        Command::Randomise => {
            state.transient.randomised += 1;
            let turn = state.transient.randomised;
            state.document.preset = randomised(&state.document.preset, &state.settings.locked, turn);
        }
        Command::Lock(key, locked) => {
            state.settings.locked.retain(|known| *known != key);
            if locked {
                state.settings.locked.push(key);
            }
        }
        Command::Choose(index) => state.document.choose(index),
        Command::AddObject(Some(mesh)) => add_object(state, mesh),
        Command::AddObject(None) => return vec![Effect::Ask(Ask::AddObject)],
        Command::DuplicateObject => {
            let document = &mut state.document;
            let mut copy = document.object(document.chosen()).to_owned();
            copy.standing.place.translation.x += BESIDE * copy.standing.place.scale;
            if !copy.standing.name.is_empty() {
                copy.standing.name += " copy";
            }
            document.add_object(copy);
        }
        Command::RemoveObject(index) => state.document.remove_object(index),
        Command::SetPaper(paper) => state.document.paper = paper,
        Command::SetStanding(index, standing) => state.document.set_standing(index, *standing),
        Command::SetCamera(camera) => state.camera = camera,
        Command::FrameMesh => state.transient.frame_mesh = true,

        Command::Undo => {
            if let Some(document) = model.history.undo(state) {
                back_to(state, document);
            }
        }
        Command::Redo => {
            if let Some(document) = model.history.redo(state) {
                back_to(state, document);
            }
        }
        Command::UndoView => {
            if let Some(camera) = model.history.undo_view(state) {
                state.camera = camera;
            }
        }
        Command::RedoView => {
            if let Some(camera) = model.history.redo_view(state) {
                state.camera = camera;
            }
        }

        Command::OpenShipped(_) | Command::OpenPreset(Some(_)) | Command::NewPreset if state.is_unsaved() => {
            state.transient.dialog = Some(Dialog::Unsaved(Box::new(command)));
        }
        Command::OpenScene(Some(_)) | Command::Quit if state.has_unsaved() => {
            state.transient.dialog = Some(Dialog::Unsaved(Box::new(command)));
        }
        Command::Discard(command) => {
            state.transient.dialog = None;
            return discard(model, *command);
        }
        Command::Replace(command) => {
            state.transient.dialog = None;
            return apply(model, *command);
        }
        Command::OpenShipped(_)
        | Command::OpenPreset(Some(_))
        | Command::OpenScene(Some(_))
        | Command::NewPreset
        | Command::Quit => {
            return discard(model, command);
        }
        Command::OpenPreset(None) => return vec![Effect::Ask(Ask::OpenPreset)],
        Command::Save => match state.document.source.file().cloned() {
            Some(path) => save(state, &path),
            None => return vec![Effect::Ask(Ask::SavePreset(state.preset_name()))],
        },
        Command::SaveAs(Some(path)) => save(state, &path),
        Command::SaveAs(None) => return vec![Effect::Ask(Ask::SavePreset(state.preset_name()))],
        Command::Duplicate => {
            let name = format!("{} copy", state.preset_name());
            state.document.source = PresetSource::New(name);
        }
        Command::Revert => {
            if let Some(saved) = state.saved_preset().cloned() {
                state.document.preset = saved;
            }
        }
        Command::Reload => {
            state.transient.dialog = None;
            if let Some(path) = state.document.source.file().cloned() {
                open_preset(state, &path);
            }
        }
        Command::OpenMesh(Some(path)) => {
            state.remember_mesh(&path);
            let again = state.document.mesh == MeshSource::File(path.clone());
            set_mesh(state, MeshSource::File(path));
            if again {
                return vec![Effect::ReloadMesh];
            }
        }
        Command::OpenScene(None) => return vec![Effect::Ask(Ask::OpenScene)],
        Command::SaveScene(Some(path)) => return vec![Effect::SaveScene(path)],
        Command::SaveScene(None) => return vec![Effect::Ask(Ask::SaveScene(scene_name(state)))],
        Command::CopyCommand => return vec![Effect::CopyCommand],
        Command::OpenMesh(None) => return vec![Effect::Ask(Ask::OpenMesh)],
        Command::OpenFiles(paths) => {
            return paths.into_iter().flat_map(|path| open_file(model, path)).collect();
        }
        Command::ForgetRecent => {
            state.settings.recent_presets.clear();
            state.settings.recent_meshes.clear();
        }

        Command::Export => return vec![Effect::Export],
        Command::SetExport(export) => state.settings.export = export,
        Command::ChooseExportFolder => return vec![Effect::Ask(Ask::ExportFolder)],
        Command::ExportInto(folder) => state.settings.export.folder = folder,
        Command::Reveal(path) => return vec![Effect::Reveal(path)],
        Command::SavePicture(Some(path)) => return vec![Effect::SavePicture(path)],
        Command::SavePicture(None) => return vec![Effect::Ask(Ask::SavePicture(picture_name(state)))],
        Command::SetPicture(picture) => state.settings.picture = picture,
        Command::SaveTurntable(Some(path)) => return vec![Effect::SaveTurntable(path)],
        Command::SaveTurntable(None) => return vec![Effect::Ask(Ask::SaveTurntable(picture_name(state)))],
        Command::SetTurntable(turntable) => state.settings.turntable = turntable,
        Command::SaveGuides(Some(path)) => save_guides(state, &path),
        Command::SaveGuides(None) => {
            return vec![Effect::Ask(Ask::SaveGuides(state.document.mesh.name()))];
        }
        Command::OpenGuides(Some(path)) => match guides::read(&path) {
            Ok(guides) => state.document.look.guides = guides,
            Err(error) => tell(state, Severity::Error, format!("{}: {error}", path.display())),
        },
        Command::OpenGuides(None) => return vec![Effect::Ask(Ask::OpenGuides)],
        Command::Cancel => return vec![Effect::CancelFile],

        Command::SetChart(chart) => state.settings.chart = chart,
        Command::SetFit(fit) => state.settings.fit = fit,
        Command::Fit => return vec![Effect::Fit],
        Command::CancelFit => return vec![Effect::CancelFit],

        Command::ShowCell(cell) => state.transient.map = cell,
        Command::ShowChart(chart) => state.transient.chart = chart,
        Command::ShowPane(pane) => {
            model.layout.make_active(|_, tile| matches!(tile, Tile::Pane(shown) if *shown == pane));
        }
        Command::ResetLayout => model.layout = default_layout(),
        Command::Play(motion) => {
            state.transient.motion = motion;
            state.transient.phase = 0.0;
        }
        Command::SetTool(tool) => state.transient.tool = tool,
        Command::SetTheme(theme) => state.settings.theme = theme,
        Command::SetZoom(zoom) => state.settings.zoom = zoom.clamp(0.5, 3.0),
        Command::SetNavigation(navigation) => state.settings.navigation = navigation,
        Command::ShowLightHandle(shown) => state.settings.light_handle = shown,
        Command::ShowDialog(dialog) => state.transient.dialog = dialog,
    }
    Vec::new()
}

/// A message to the user.
pub(crate) fn tell(state: &mut State, severity: Severity, text: String) {
    state.transient.notices.push(Notice { severity, text });
}

/// Does what would lose unsaved changes.
fn discard(model: &mut Model, command: Command) -> Vec<Effect> {
    let state = &mut model.state;
    match command {
        Command::OpenShipped(name) => match Preset::named(&name) {
            Some(Ok(preset)) => open(state, PresetSource::Shipped(name), preset),
            Some(Err(error)) => tell(state, Severity::Error, error.to_string()),
            None => tell(state, Severity::Error, format!("No preset that comes with the tool is called {name}.")),
        },
        Command::OpenPreset(Some(path)) => open_preset(state, &path),
        Command::OpenScene(Some(path)) => open_scene(state, &path),
        Command::NewPreset => {
            let preset = Preset::default();
            open(state, PresetSource::New("untitled".to_owned()), preset);
        }
        Command::Quit => {
            state.transient.may_close = true;
            return vec![Effect::Close];
        }
        other => return apply(model, other),
    }
    Vec::new()
}

/// How far a new object stands beside another: meshes are 2 units long.
const BESIDE: f64 = 2.2;

/// Adds an object of a mesh beside the last one, in the look of the chosen one.
fn add_object(state: &mut State, mesh: MeshSource) {
    if let MeshSource::File(path) = &mesh {
        state.remember_mesh(path);
    }
    let document = &mut state.document;
    let mut object = document.object(document.chosen()).to_owned();
    let right = document.objects().map(|object| object.standing.place.translation.x).fold(f64::MIN, f64::max);
    object.standing = Standing::default();
    object.standing.place.translation.x = right + BESIDE;
    object.mesh = mesh;
    object.materials.clear();
    object.look.guides.clear();
    document.add_object(object);
    state.transient.frame_mesh = true;
}

/// Opens a scene file in place of the document.
fn open_scene(state: &mut State, path: &Path) {
    let opened = SceneFile::load(path).map_err(|error| error.to_string()).and_then(|mut file| {
        file.name_objects();
        scenes::from_file(&file, &state.camera).map_err(|problem| format!("{}: {problem}", path.display()))
    });
    match opened {
        Ok(opened) => {
            for object in opened.document.objects() {
                state.saved.insert(object.source.key(), object.preset.clone());
            }
            state.document = opened.document;
            state.camera = opened.camera;
            state.transient.frame_mesh = opened.frames;
            state.transient.motion = None;
            state.transient.mesh_before = None;
            opened.left_out.into_iter().for_each(|text| tell(state, Severity::Warning, text));
        }
        Err(problem) => tell(state, Severity::Error, problem),
    }
}

/// Shows a mesh from where it is seen whole, with its own materials.
fn set_mesh(state: &mut State, mesh: MeshSource) {
    if state.document.mesh != mesh {
        let document = &mut state.document;
        let before = MeshBefore {
            mesh: std::mem::replace(&mut document.mesh, mesh),
            materials: std::mem::take(&mut document.materials),
            guides: std::mem::take(&mut document.look.guides),
        };
        state.transient.mesh_before = Some(before);
        state.transient.frame_mesh = true;
        state.transient.motion = None;
    }
}

/// Brings a document of the history back.
fn back_to(state: &mut State, document: Document) {
    // Choosing another object is a step as well, which moves nothing.
    let shown = |document: &Document| {
        let mut meshes: Vec<String> = document.objects().map(|object| format!("{:?}", object.mesh)).collect();
        meshes.sort_unstable();
        meshes
    };
    state.transient.frame_mesh |= shown(&document) != shown(&state.document);
    state.document = document;
}

fn open(state: &mut State, source: PresetSource, preset: Preset) {
    state.saved.insert(source.key(), preset.clone());
    state.document.source = source;
    state.document.preset = preset;
}

fn open_preset(state: &mut State, path: &Path) {
    match Preset::load(path) {
        Ok(preset) => {
            state.remember_preset(path);
            open(state, PresetSource::File(path.to_owned()), preset);
        }
        Err(error) => tell(state, Severity::Error, error.to_string()),
    }
}

/// Opens a file that was dropped, by its kind.
fn open_file(model: &mut Model, path: PathBuf) -> Vec<Effect> {
    let kind = path.extension().map(|kind| kind.to_string_lossy().to_lowercase()).unwrap_or_default();
    if kind == "toml" && crate::scene_file::is_scene(&path) {
        return apply(model, Command::OpenScene(Some(path)));
    }
    if kind == "toml" {
        return apply(model, Command::OpenPreset(Some(path)));
    }
    if MESH_KINDS.contains(&kind.as_str()) {
        return apply(model, Command::OpenMesh(Some(path)));
    }
    if kind == "json" {
        return apply(model, Command::OpenGuides(Some(path)));
    }
    let text = format!(
        "{} is nothing that can be opened: presets and scenes are .toml, meshes {}, guides .json.",
        path.display(),
        MESH_KINDS.map(|kind| format!(".{kind}")).join(", ")
    );
    tell(&mut model.state, Severity::Error, text);
    Vec::new()
}

fn scene_name(state: &State) -> String {
    let mesh = state.document.mesh.name();
    let stem = Path::new(&mesh).file_stem().map_or(String::new(), |stem| stem.to_string_lossy().into_owned());
    if state.document.object_count() == 1 { format!("{stem}-scene") } else { "scene".to_owned() }
}

fn picture_name(state: &State) -> String {
    let mesh = state.document.mesh.name();
    let stem = Path::new(&mesh).file_stem().map_or(String::new(), |stem| stem.to_string_lossy().into_owned());
    format!("{stem}-{}.png", state.preset_name())
}

#[cfg(test)]
mod tests;
