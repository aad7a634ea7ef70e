//! The session: written down from time to time, and looked up at the start.

use std::time::Duration;

use egui::Context;
use egui_tiles::Tree;

use super::super::apply::{Model, tell};
use super::super::layout::Pane;
use super::super::session::{self, Session};
use super::super::state::{MeshSource, PresetSource, Severity, State};
use super::App;

/// Time between writes of the session, in seconds.
const SESSION_S: f64 = 2.0;

/// What the session file holds, and since when.
pub(super) struct Written {
    state: State,
    layout: Tree<Pane>,
    at_s: f64,
}

impl App {
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
        let Some(path) = &self.session else { return };
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
    let source = state.document.source.clone();
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
        PresetSource::New(_) => state.saved.get(&source.key()).cloned(),
    };
    state.saved.clear();
    state.saved.extend(on_disk.map(|preset| (source.key(), preset)));
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
