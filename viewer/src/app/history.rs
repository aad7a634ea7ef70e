//! Undo and redo: one list of documents, one of cameras.
//!
//! A gesture is one step, however many changes it makes: nothing is recorded while a button is held.

use egui::util::undoer::{Settings, Undoer};

use super::state::{Document, State};
use crate::Camera;

/// Changes by keyboard and by repeated clicks that follow each other within this time are one step, in seconds.
const TOGETHER_S: f32 = 0.4;

/// Steps that are kept.
const STEPS: usize = 200;

/// What was, and what was undone.
#[derive(Clone, Debug)]
pub(crate) struct History {
    documents: Undoer<Document>,
    cameras: Undoer<Camera>,
}

impl Default for History {
    fn default() -> Self {
        let settings = Settings { max_undos: STEPS, stable_time: TOGETHER_S, auto_save_interval: f32::INFINITY };
        Self { documents: Undoer::with_settings(settings.clone()), cameras: Undoer::with_settings(settings) }
    }
}

impl History {
    /// Looks at the state at a time in seconds; `held`: a gesture is going on.
    ///
    /// Returns whether it wants to look again soon.
    pub(crate) fn watch(&mut self, time_s: f64, held: bool, state: &State) -> bool {
        if !held {
            self.documents.feed_state(time_s, &state.document);
            self.cameras.feed_state(time_s, &state.camera);
        }
        self.documents.is_in_flux() || self.cameras.is_in_flux()
    }

    /// Whether there is anything to take back.
    pub(crate) fn has_undo(&self, state: &State) -> bool {
        self.documents.has_undo(&state.document)
    }

    /// Whether there is anything to do again.
    pub(crate) fn has_redo(&self, state: &State) -> bool {
        self.documents.has_redo(&state.document)
    }

    /// The document before the last change.
    pub(crate) fn undo(&mut self, state: &State) -> Option<Document> {
        self.documents.undo(&state.document).cloned()
    }

    /// The document before the last undo.
    pub(crate) fn redo(&mut self, state: &State) -> Option<Document> {
        self.documents.redo(&state.document).cloned()
    }

    /// The camera before the last movement.
    pub(crate) fn undo_view(&mut self, state: &State) -> Option<Camera> {
        self.cameras.undo(&state.camera).copied()
    }

    /// The camera before the last step back.
    pub(crate) fn redo_view(&mut self, state: &State) -> Option<Camera> {
        self.cameras.redo(&state.camera).copied()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Lets time pass, so that what was changed becomes a step of its own.
    fn rest(history: &mut History, time_s: &mut f64, state: &State) {
        for _ in 0..3 {
            *time_s += 1.0;
            history.watch(*time_s, false, state);
        }
    }

    #[test]
    fn a_gesture_is_one_step_and_undo_restores_it_whole() {
        let (mut history, mut time_s, mut state) = (History::default(), 0.0, State::default());
        rest(&mut history, &mut time_s, &state);
        let before = serde_json::to_string(&state.document).expect("a document has a JSON form");
        for step in 0..20 {
            state.document.preset.stroke.width_px = 2.0 + f64::from(step) * 0.1;
            time_s += 0.016;
            history.watch(time_s, true, &state);
        }
        rest(&mut history, &mut time_s, &state);
        let after = state.document.clone();
        state.document = history.undo(&state).expect("one step");
        assert_eq!(serde_json::to_string(&state.document).expect("JSON"), before);
        assert!(history.undo(&state).is_none(), "a gesture is a single step");
        state.document = history.redo(&state).expect("what was undone");
        assert_eq!(state.document, after);
        assert!(history.redo(&state).is_none());
    }

    #[test]
    fn undo_works_before_the_change_has_come_to_rest() {
        let (mut history, mut time_s, mut state) = (History::default(), 0.0, State::default());
        rest(&mut history, &mut time_s, &state);
        let before = state.document.clone();
        state.document.preset.seed = 99;
        history.watch(time_s + 0.01, false, &state);
        assert_eq!(history.undo(&state), Some(before));
    }

    #[test]
    fn cameras_are_undone_apart_from_documents() {
        let (mut history, mut time_s, mut state) = (History::default(), 0.0, State::default());
        rest(&mut history, &mut time_s, &state);
        let camera = state.camera;
        state.camera.azimuth_deg += 40.0;
        rest(&mut history, &mut time_s, &state);
        assert!(history.undo(&state).is_none());
        assert_eq!(history.undo_view(&state), Some(camera));
    }
}
