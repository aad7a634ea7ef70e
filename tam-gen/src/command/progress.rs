//! A bar for work that takes longer than a second, on a terminal.

use std::io::IsTerminal;
use std::sync::{Mutex, Once, PoisonError};
use std::time::{Duration, Instant};

use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle, WeakProgressBar};

/// How long work may take without a bar.
const PATIENCE: Duration = Duration::from_secs(1);

/// Steps of the bar.
const STEPS: u64 = 1000;

/// Bars that were shown, for an end at which nothing is dropped.
static SHOWN: Mutex<Vec<WeakProgressBar>> = Mutex::new(Vec::new());

/// A bar that stays hidden until the work turns out to be long.
pub struct Progress {
    bar: ProgressBar,
    started: Instant,
    label: &'static str,
    wanted: bool,
    shown: Once,
}

impl Progress {
    /// A bar for work of this name, on a terminal that wants to hear of it.
    pub fn new(label: &'static str, quiet: bool) -> Self {
        let wanted = !quiet && std::io::stderr().is_terminal();
        let bar = ProgressBar::with_draw_target(Some(STEPS), ProgressDrawTarget::hidden());
        Self { bar, started: Instant::now(), label, wanted, shown: Once::new() }
    }

    /// Moves the bar to the part done, `0.0 ..= 1.0`; never back.
    pub fn set(&self, part: f32) {
        if !self.wanted || self.started.elapsed() < PATIENCE {
            return;
        }
        self.shown.call_once(|| {
            if let Ok(style) = ProgressStyle::with_template("{msg} {wide_bar} {percent:>3} % {eta:>4}") {
                self.bar.set_style(style);
                self.bar.set_message(self.label);
            }
            self.bar.set_draw_target(ProgressDrawTarget::stderr());
            SHOWN.lock().unwrap_or_else(PoisonError::into_inner).push(self.bar.downgrade());
        });
        let step = (part.clamp(0.0, 1.0) * STEPS as f32) as u64;
        if step > self.bar.position() {
            self.bar.set_position(step);
        }
    }
}

impl Drop for Progress {
    fn drop(&mut self) {
        self.bar.finish_and_clear();
    }
}

/// Takes all bars off the terminal.
pub(super) fn clear() {
    for bar in SHOWN.lock().unwrap_or_else(PoisonError::into_inner).iter().filter_map(WeakProgressBar::upgrade) {
        bar.finish_and_clear();
    }
}
