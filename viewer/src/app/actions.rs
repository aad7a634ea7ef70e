//! Every action with its name and keys, once: for menus, shortcuts, the command search and the help.

use egui::{Key, KeyboardShortcut, Modifiers};

use super::command::Command;
use super::history::History;
use super::layout::Pane;
use super::state::{Dialog, Motion, State, Theme, Tool};
use crate::mesh::deform::Deform;
use crate::params::DebugView;
use crate::{AxisView, Camera, Form, Inspect, Light, LightKind, Mapping, Method, Projection};

/// Something a user can do.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Action {
    /// Where it is among the menus.
    pub group: Group,
    /// What it does.
    pub name: String,
    /// The keys that do it.
    pub shortcut: Option<KeyboardShortcut>,
    /// What is asked for.
    pub command: Command,
    /// Whether it is on, for those that are switched.
    pub on: Option<bool>,
}

/// A menu, or a part of the help.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Group {
    /// Presets and files.
    File,
    /// Changes.
    Edit,
    /// Methods.
    Method,
    /// Mappings.
    Mapping,
    /// The view.
    View,
    /// What is shown for inspection.
    Debug,
    /// The light.
    Light,
    /// Panels and the window.
    Window,
    /// Help.
    Help,
}

impl Group {
    /// All of them, in the order of the menus.
    pub(crate) const ALL: [Self; 9] = [
        Self::File,
        Self::Edit,
        Self::Method,
        Self::Mapping,
        Self::View,
        Self::Debug,
        Self::Light,
        Self::Window,
        Self::Help,
    ];

    /// What the menu says.
    pub(crate) fn title(self) -> &'static str {
        match self {
            Self::File => "File",
            Self::Edit => "Edit",
            Self::Method => "Method",
            Self::Mapping => "Mapping",
            Self::View => "View",
            Self::Debug => "Debug",
            Self::Light => "Light",
            Self::Window => "Window",
            Self::Help => "Help",
        }
    }
}

/// Distance that a light's key moves it, in world units: the step of the student implementation.
const LIGHT_STEP: f64 = 0.1;

const NUMBER_KEYS: [Key; 9] =
    [Key::Num1, Key::Num2, Key::Num3, Key::Num4, Key::Num5, Key::Num6, Key::Num7, Key::Num8, Key::Num9];

/// All actions, as the state has them.
pub(crate) fn actions(state: &State) -> Vec<Action> {
    let mut all = Vec::with_capacity(90);
    files(state, &mut all);
    edits(state, &mut all);
    looks(state, &mut all);
    views(state, &mut all);
    lights(state, &mut all);
    windows(state, &mut all);
    all
}

/// Whether an action can be done now.
pub(crate) fn is_possible(action: &Action, state: &State, history: &History) -> bool {
    match &action.command {
        Command::Undo => history.has_undo(state),
        Command::Redo => history.has_redo(state),
        Command::Revert => state.is_unsaved() && state.saved_preset().is_some(),
        Command::RemoveObject(_) | Command::Choose(_) => state.document.object_count() > 1,
        Command::SaveGuides(_) => !state.document.look.guides.is_empty(),
        _ => true,
    }
}

struct List<'a> {
    all: &'a mut Vec<Action>,
    group: Group,
}

impl List<'_> {
    fn add(&mut self, name: impl Into<String>, shortcut: Option<KeyboardShortcut>, command: Command) -> &mut Action {
        let action = Action { group: self.group, name: name.into(), shortcut, command, on: None };
        self.all.push(action);
        let last = self.all.len() - 1;
        &mut self.all[last]
    }

    fn switch(&mut self, name: impl Into<String>, shortcut: Option<KeyboardShortcut>, on: bool, command: Command) {
        self.add(name, shortcut, command).on = Some(on);
    }
}

fn ctrl(key: Key) -> Option<KeyboardShortcut> {
    Some(KeyboardShortcut::new(Modifiers::COMMAND, key))
}

fn ctrl_shift(key: Key) -> Option<KeyboardShortcut> {
    Some(KeyboardShortcut::new(Modifiers::COMMAND | Modifiers::SHIFT, key))
}

fn alt(key: Key) -> Option<KeyboardShortcut> {
    Some(KeyboardShortcut::new(Modifiers::ALT, key))
}

fn plain(key: Key) -> Option<KeyboardShortcut> {
    Some(KeyboardShortcut::new(Modifiers::NONE, key))
}

fn files(state: &State, all: &mut Vec<Action>) {
    let mut list = List { all, group: Group::File };
    list.add("New preset", ctrl(Key::N), Command::NewPreset);
    list.add("Open preset…", ctrl(Key::O), Command::OpenPreset(None));
    list.add("Open mesh…", ctrl_shift(Key::O), Command::OpenMesh(None));
    list.add("Save preset", ctrl(Key::S), Command::Save);
    list.add("Save preset as…", ctrl_shift(Key::S), Command::SaveAs(None));
    list.add("Duplicate preset", ctrl(Key::D), Command::Duplicate);
    list.add("Revert preset to the saved one", None, Command::Revert);
    list.add("Open scene…", None, Command::OpenScene(None));
    list.add("Save scene…", None, Command::SaveScene(None));
    list.add("Copy as command line", ctrl_shift(Key::C), Command::CopyCommand);
    list.add("Export map", ctrl(Key::E), Command::Export);
    list.add("Save picture…", ctrl_shift(Key::P), Command::SavePicture(None));
    list.add("Save turntable…", None, Command::SaveTurntable(None));
    list.add("Open guides…", None, Command::OpenGuides(None));
    list.add("Save guides…", None, Command::SaveGuides(None));
    if !state.settings.recent_presets.is_empty() || !state.settings.recent_meshes.is_empty() {
        list.add("Forget recent files", None, Command::ForgetRecent);
    }
    list.add("Quit", ctrl(Key::Q), Command::Quit);
}

fn edits(state: &State, all: &mut Vec<Action>) {
    let mut list = List { all, group: Group::Edit };
    list.add("Undo", ctrl(Key::Z), Command::Undo);
    list.add("Redo", ctrl_shift(Key::Z), Command::Redo);
    list.add("Undo camera move", plain(Key::OpenBracket), Command::UndoView);
    list.add("Redo camera move", plain(Key::CloseBracket), Command::RedoView);
    list.add("Randomise strokes", ctrl(Key::R), Command::Randomise);
    list.add("Add an object from a file…", None, Command::AddObject(None));
    list.add("Duplicate the chosen object", ctrl_shift(Key::D), Command::DuplicateObject);
    let chosen = state.document.chosen();
    list.add("Remove the chosen object", None, Command::RemoveObject(chosen));
    let next = (chosen + 1) % state.document.object_count();
    list.add("Choose the next object", plain(Key::N), Command::Choose(next));
}

fn looks(state: &State, all: &mut Vec<Action>) {
    let look = &state.document.look;
    let with = |change: &dyn Fn(&mut crate::RenderParams)| {
        let mut look = look.clone();
        change(&mut look.params);
        Command::SetLook(Box::new(look))
    };
    let mut list = List { all, group: Group::Method };
    for (method, key) in Method::ALL.into_iter().zip(NUMBER_KEYS) {
        let command = with(&|params| params.method = method);
        list.switch(method_label(method), plain(key), look.params.method == method, command);
    }
    let literal = look.params.form == Form::Literal;
    let form = if literal { Form::Hardened } else { Form::Literal };
    list.switch("As printed in the paper", plain(Key::P), literal, with(&|params| params.form = form));
    list.group = Group::Mapping;
    for (mapping, key) in Mapping::ALL.into_iter().zip(NUMBER_KEYS) {
        let command = with(&|params| params.mapping = mapping);
        list.switch(mapping_label(mapping), alt(key), look.params.mapping == mapping, command);
    }
}

fn views(state: &State, all: &mut Vec<Action>) {
    let mut list = List { all, group: Group::View };
    list.add("Show the whole mesh", plain(Key::F), Command::FrameMesh);
    let axes = [
        (AxisView::Front, Key::Num1),
        (AxisView::Back, Key::Num2),
        (AxisView::Right, Key::Num3),
        (AxisView::Left, Key::Num4),
        (AxisView::Top, Key::Num7),
        (AxisView::Bottom, Key::Num8),
    ];
    for (view, key) in axes {
        let [azimuth_deg, elevation_deg] = view.angles_deg();
        let camera =
            Camera { azimuth_deg: azimuth_deg.rem_euclid(360.0), elevation_deg, roll_deg: 0.0, ..state.camera };
        list.add(format!("View: {}", view.name()), ctrl(key), Command::SetCamera(camera));
    }
    let projection = if state.camera.is_parallel() { Projection::Perspective } else { Projection::Orthographic };
    let other = Command::SetCamera(Camera { projection, ..state.camera });
    list.switch("View: orthographic", ctrl(Key::Num5), state.camera.is_parallel(), other);
    let comparing = state.document.compare.is_some();
    list.switch("Compare two looks", plain(Key::C), comparing, Command::SetCompare(toggled_compare(state)));
    let inspect = state.document.inspect;
    let wired = inspect.wireframe.is_some();
    let other = Inspect { wireframe: (!wired).then_some(1.0), ..inspect };
    list.switch("Wireframe", plain(Key::W), wired, Command::SetInspect(other));
    let tool = state.transient.tool;
    let other = if tool == Tool::Guide { Tool::Navigate } else { Tool::Guide };
    list.switch("Draw guides on the mesh", plain(Key::G), tool == Tool::Guide, Command::SetTool(other));
    let handle = state.settings.light_handle;
    list.switch("Show the light", None, handle, Command::ShowLightHandle(!handle));
    let motions = [
        ("Play: turntable of the camera", Some(Key::Space), Motion::Orbit),
        ("Play: turntable of the light", None, Motion::Light),
        ("Play: twist", None, Motion::Deform(Deform::Twist)),
        ("Play: wave", None, Motion::Deform(Deform::Wave)),
        ("Play: breathe", None, Motion::Deform(Deform::Breathe)),
        ("Play: the file's animation", None, Motion::Animation),
    ];
    for (name, key, motion) in motions {
        let playing = state.transient.motion == Some(motion);
        list.switch(name, key.and_then(plain), playing, Command::Play((!playing).then_some(motion)));
    }
    list.group = Group::Debug;
    for debug in DebugView::ALL {
        let shown = inspect.debug == Some(debug);
        let changed = Inspect { debug: (!shown).then_some(debug), ..inspect };
        let name = format!("Inspect: {}", debug_label(debug).to_lowercase());
        list.switch(name, None, shown, Command::SetInspect(changed));
    }
}

/// Comparing with the same look, or no longer.
fn toggled_compare(state: &State) -> Option<Box<super::state::Compare>> {
    let document = &state.document;
    let started = || {
        let mut look = document.look.clone();
        // What is compared should differ: engraving beside strokes, strokes beside engraving.
        let other = if look.params.method == Method::Stripes { Method::SixWay } else { Method::Stripes };
        look.params.method = other;
        Box::new(super::state::Compare { look, preset: None, split: 0.5 })
    };
    document.compare.is_none().then(started)
}

fn lights(state: &State, all: &mut Vec<Action>) {
    let mut list = List { all, group: Group::Light };
    let keys = [
        ("Light right", Key::O, glam::DVec3::X),
        ("Light left", Key::L, glam::DVec3::NEG_X),
        ("Light up", Key::I, glam::DVec3::Y),
        ("Light down", Key::K, glam::DVec3::NEG_Y),
        ("Light forwards", Key::U, glam::DVec3::Z),
        ("Light backwards", Key::J, glam::DVec3::NEG_Z),
    ];
    for (name, key, direction) in keys {
        let mut lights = state.document.lights.clone();
        if let Some(light) = lights.lights.first_mut() {
            move_light(light, direction * LIGHT_STEP);
        }
        list.add(name, plain(key), Command::SetLights(lights));
    }
}

/// Moves a light; one from infinitely far as if it stood two units away.
fn move_light(light: &mut Light, step: glam::DVec3) {
    match &mut light.kind {
        LightKind::Directional { direction } => {
            let place = -direction.normalize_or(glam::DVec3::NEG_Y) * 2.0 + step;
            *direction = -place.normalize_or(glam::DVec3::Y);
        }
        LightKind::Positional { position } | LightKind::Spot { position, .. } => *position += step,
    }
}

fn windows(state: &State, all: &mut Vec<Action>) {
    let mut list = List { all, group: Group::Window };
    for pane in Pane::ALL {
        list.add(format!("Show panel: {}", pane.title()), None, Command::ShowPane(pane));
    }
    list.add("Reset the panels", None, Command::ResetLayout);
    for theme in Theme::ALL {
        let name = format!("Theme: {}", theme.label().to_lowercase());
        list.switch(name, None, state.settings.theme == theme, Command::SetTheme(theme));
    }
    let zoom = state.settings.zoom;
    list.add("Larger interface", ctrl(Key::Plus), Command::SetZoom(zoom + 0.1));
    list.add("Smaller interface", ctrl(Key::Minus), Command::SetZoom(zoom - 0.1));
    list.add("Interface as large as the system says", ctrl(Key::Num0), Command::SetZoom(1.0));
    for navigation in super::state::Navigation::ALL {
        let name = match navigation {
            super::state::Navigation::Simple => "Mouse: simple".to_owned(),
            other => format!("Mouse: as in {}", other.label()),
        };
        list.switch(name, None, state.settings.navigation == navigation, Command::SetNavigation(navigation));
    }
    list.group = Group::Help;
    list.add("Keyboard and mouse", plain(Key::F1), Command::ShowDialog(Some(Dialog::Help)));
    list.add("Search for a command…", ctrl(Key::K), Command::ShowDialog(Some(Dialog::Palette(String::new()))));
    list.add("About", None, Command::ShowDialog(Some(Dialog::About)));
}

/// Keys as they are printed on a keyboard.
pub(crate) fn keys_in_words(ctx: &egui::Context, keys: &KeyboardShortcut) -> String {
    let words = ctx.format_shortcut(keys);
    let signs = [("OpenBracket", "["), ("CloseBracket", "]"), ("Plus", "+"), ("Minus", "-")];
    signs.into_iter().fold(words, |words, (word, sign)| words.replace(word, sign))
}

/// What a method is called.
pub(crate) fn method_label(method: Method) -> &'static str {
    match method {
        Method::Phong => "Phong (no strokes)",
        Method::SixWay => "Six-way blend",
        Method::FaceFrame => "Face frames",
        Method::StrokeMap => "Stroke map",
        Method::Halftone => "Halftone lines",
        Method::FineTone => "Fine tones",
        Method::Stripes => "Engraving stripes",
    }
}

/// What a mapping is called.
pub(crate) fn mapping_label(mapping: Mapping) -> &'static str {
    match mapping {
        Mapping::Uv => "The mesh's uv",
        Mapping::Frames => "Light-aligned frames",
        Mapping::Triplanar => "Three planes",
        Mapping::Patches => "Patches",
        Mapping::Lapped => "Lapped patches",
    }
}

/// What a view for inspection is called.
pub(crate) fn debug_label(view: DebugView) -> &'static str {
    match view {
        DebugView::Tone => "Tone",
        DebugView::Level => "Mip level",
        DebugView::Columns => "Columns",
        DebugView::Frames => "Directions",
        DebugView::Adjacency => "Adjacency weight",
        DebugView::Triangles => "Triangles",
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn no_two_actions_share_their_keys_or_their_name() {
        let all = actions(&State::default());
        for (i, action) in all.iter().enumerate() {
            for other in &all[..i] {
                assert_ne!(action.name, other.name);
                if action.shortcut.is_some() {
                    assert_ne!(action.shortcut, other.shortcut, "{} and {}", action.name, other.name);
                }
            }
        }
        assert!(Group::ALL.iter().all(|group| all.iter().any(|action| action.group == *group)));
    }
}
