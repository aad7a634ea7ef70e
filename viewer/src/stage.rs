//! What the stages of a preparation take, told to whoever asks by `-v`.

use std::time::Instant;

/// What holds memory.
pub(crate) trait Held {
    /// In bytes.
    fn held(&self) -> usize;
}

impl<T: Copy> Held for Vec<T> {
    fn held(&self) -> usize {
        size_of_val(self.as_slice())
    }
}

impl<T: Held, E> Held for Result<T, E> {
    fn held(&self) -> usize {
        self.as_ref().map_or(0, T::held)
    }
}

/// Does the work of a stage; tells its time, and the memory that it leaves taken.
pub(crate) fn stage<T: Held>(name: &str, work: impl FnOnce() -> T) -> T {
    let started = Instant::now();
    let made = work();
    tracing::info!("{name}: {:.3} s, {:.1} MB", started.elapsed().as_secs_f64(), made.held() as f64 / 1e6);
    made
}
