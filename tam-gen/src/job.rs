//! How an application follows and stops a generation.

use std::sync::atomic::{AtomicBool, Ordering};

use crate::preset::ToneMeasure;

/// What accompanies a generation without deciding its bytes, except a tone measure that no preset can name.
#[derive(Default, Clone, Copy)]
pub struct Job<'a> {
    /// Called from worker threads with the part done so far, `0.0 ..= 1.0`, never falling by more than threads disagree.
    pub progress: Option<&'a (dyn Fn(f32) + Sync)>,
    /// Set from outside to stop; the generation then returns [`crate::GenerateError::Cancelled`] within milliseconds.
    pub cancel: Option<&'a AtomicBool>,
    /// The measure of tone, in place of the preset's.
    pub measure: Option<&'a ToneMeasure>,
}

impl Job<'_> {
    /// Whether the application wants the generation stopped.
    pub fn cancelled(&self) -> bool {
        self.cancel.is_some_and(|cancel| cancel.load(Ordering::Relaxed))
    }

    /// Reports the part done, `0.0 ..= 1.0`.
    pub fn report(&self, part: f32) {
        if let Some(progress) = self.progress {
            progress(part);
        }
    }
}

impl std::fmt::Debug for Job<'_> {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("Job")
            .field("cancelled", &self.cancelled())
            .field("measure", &self.measure)
            .finish_non_exhaustive()
    }
}
