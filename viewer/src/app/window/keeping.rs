//! The session: written down from time to time, and looked up at the start.

use std::path::PathBuf;
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};
use std::time::Duration;

use egui::{Context, ViewportCommand};
use egui_tiles::Tree;

use super::super::apply::{Model, tell};
use super::super::layout::{Pane, default_layout};
use super::super::session::{self, Found, Lock, Owner, Session};
use super::super::state::{MeshSource, PresetSource, Severity, State};
use super::App;
use crate::gpu::Gpu;

/// Time between writes of the session, in seconds.
const SESSION_S: f64 = 2.0;

/// What the session file holds, and since when.
pub(super) struct Written {
    state: State,
    layout: Tree<Pane>,
    at_s: f64,
}

/// Where this window keeps its session.
pub(super) struct KeptSession {
    path: PathBuf,
    /// Held as long as the window is there.
    _lock: Lock,
}

/// All of an application that outlives its window.
pub(super) struct Left {
    pub model: Model,
    pub session: Option<KeptSession>,
}

/// Where an application is left by a window whose device was lost, for the next window.
#[derive(Clone, Default)]
pub struct Leaving(Arc<Mutex<Place>>);

#[derive(Default)]
struct Place {
    left: Option<Left>,
    /// Of the window that is open.
    gpu: Option<Gpu>,
}

/// Whatever breaks a window whose device is lost, the application in it is not.
impl Drop for App {
    fn drop(&mut self) {
        if self.gpu.is_lost() {
            self.put_aside();
        }
    }
}

impl std::fmt::Debug for Leaving {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(if self.is_some() { "Leaving(Some)" } else { "Leaving(None)" })
    }
}

impl Leaving {
    /// Whether an application waits for its next window.
    pub fn is_some(&self) -> bool {
        self.place().left.is_some()
    }

    /// Whether the device of the window that is open went away.
    pub(crate) fn is_device_lost(&self) -> bool {
        self.place().gpu.as_ref().is_some_and(Gpu::is_lost)
    }

    /// A window is opened on this device.
    pub(super) fn open_on(&self, gpu: &Gpu) {
        self.place().gpu = Some(gpu.clone());
    }

    /// What was left, once.
    pub(super) fn take(&self) -> Option<Left> {
        self.place().left.take()
    }

    fn put(&self, left: Left) {
        self.place().left = Some(left);
    }

    fn place(&self) -> MutexGuard<'_, Place> {
        self.0.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

/// What a window starts with, and where it keeps its session: nowhere if another window does, or if what is there can
/// neither be read nor put aside.
pub(super) fn restore(path: Option<PathBuf>) -> (State, Tree<Pane>, Option<KeptSession>) {
    let mut state = State::default();
    state.transient.frame_mesh = true;
    let mut layout = default_layout();
    let Some(path) = path else { return (state, layout, None) };
    let owner = Lock::take(&path);
    let (session, problem) = match session::read(&path) {
        Ok(Found::Nothing) => (None, None),
        Ok(Found::Whole(session)) => (Some(session), None),
        Ok(Found::Part(session, problem)) => (Some(session), Some(problem)),
        Err(problem) => (None, Some(problem)),
    };
    let starts_anew = session.is_none();
    let lost = session.as_ref().is_some_and(|session| !session.closed);
    if let Some(session) = session {
        (state, layout) = (session.state, session.layout);
    }
    let Owner::This(lock) = owner else {
        let text = "Another window keeps this session already: what is changed here is gone when this one is closed, \
                    unless it is saved.";
        tell(&mut state, Severity::Info, text.to_owned());
        return (state, layout, None);
    };
    if lost && state.has_unsaved() {
        let text = "The last session did not end properly. What was not saved is still here.";
        tell(&mut state, Severity::Info, text.to_owned());
    }
    let mut kept = Some(KeptSession { path, _lock: lock });
    if let (Some(problem), Some(KeptSession { path, .. })) = (problem, &kept) {
        let anew = if starts_anew { " It starts anew." } else { "" };
        match session::put_aside(path) {
            Ok(aside) => {
                let text = format!("{problem}.{anew} The file is kept as {}.", aside.display());
                tell(&mut state, Severity::Warning, text);
            }
            Err(error) => {
                let text = format!(
                    "{problem}.{anew} It could not be put aside ({error}), so this session is not kept in its place."
                );
                tell(&mut state, Severity::Warning, text);
                kept = None;
            }
        }
    }
    (state, layout, kept)
}

impl App {
    /// Leaves all to the next window, as the device of this one is lost, and closes it.
    pub(super) fn leave(&mut self, ctx: &Context) {
        self.put_aside();
        ctx.send_viewport_cmd(ViewportCommand::Close);
    }

    fn put_aside(&mut self) {
        if !std::mem::replace(&mut self.is_left, true) {
            let cause = self.results.device_lost.as_ref().map_or_else(String::new, |cause| format!(" ({cause})"));
            let text = format!("The graphics device went away{cause}. It was opened again; nothing is lost.");
            tell(&mut self.model.state, Severity::Warning, text);
            let model = Model {
                state: self.model.state.clone(),
                history: std::mem::take(&mut self.model.history),
                layout: self.model.layout.clone(),
            };
            self.left.put(Left { model, session: self.session.take() });
        }
    }

    /// Writes the session down from time to time.
    pub(super) fn keep(&mut self, ctx: &Context, time_s: f64, held: bool) {
        if self.session.is_none() || held {
            return;
        }
        let Model { state, layout, .. } = &self.model;
        let written = self.written.as_ref();
        if written.is_some_and(|written| written.layout == *layout && same_on_disk(&written.state, state)) {
            return;
        }
        if written.is_none_or(|written| time_s - written.at_s > SESSION_S) {
            self.write_session(false);
            let (state, layout) = (self.model.state.clone(), self.model.layout.clone());
            self.written = Some(Written { state, layout, at_s: time_s });
        } else {
            ctx.request_repaint_after(Duration::from_secs_f64(SESSION_S));
        }
    }

    pub(super) fn write_session(&mut self, closed: bool) {
        let Some(KeptSession { path, .. }) = &self.session else { return };
        let session = Session { state: self.model.state.clone(), layout: self.model.layout.clone(), closed };
        if let Err(error) = session::write(path, &session) {
            // Once is enough: a full disk stays full for a while.
            let text = format!("The session cannot be kept: {error}");
            if !self.messages.iter().any(|message| message.text == text) {
                tell(&mut self.model.state, Severity::Warning, text);
            }
        }
    }
}

/// Finds out what is on disk, so that it is known what is unsaved.
pub(super) fn look_up_saved(state: &mut State) {
    let mut sources: Vec<PresetSource> = Vec::new();
    for source in state.document.objects().map(|object| object.source) {
        if !sources.contains(source) {
            sources.push(source.clone());
        }
    }
    let before = std::mem::take(&mut state.saved);
    for source in sources {
        let on_disk = match &source {
            PresetSource::Shipped(name) => tam_gen::Preset::named(name).and_then(Result::ok),
            PresetSource::File(path) => match tam_gen::Preset::load(path) {
                Ok(preset) => Some(preset),
                Err(_) => {
                    let text = format!("{} can no longer be read; what was open is still here.", path.display());
                    tell(state, Severity::Warning, text);
                    None
                }
            },
            PresetSource::New(_) => before.get(&source.key()).cloned(),
        };
        state.saved.extend(on_disk.map(|preset| (source.key(), preset)));
    }
    if let MeshSource::File(path) = &state.document.mesh
        && !path.exists()
    {
        let text = format!("{} is gone; another mesh is shown.", path.display());
        tell(state, Severity::Warning, text);
        state.document.mesh = MeshSource::default();
        state.transient.frame_mesh = true;
    }
}

/// Whether a session file would hold the same.
fn same_on_disk(written: &State, state: &State) -> bool {
    (&written.document, &written.camera, &written.settings, &written.saved)
        == (&state.document, &state.camera, &state.settings, &state.saved)
}
