//! Ctrl-C: work stops soon, and leaves nothing half-written.

use std::sync::atomic::{AtomicBool, Ordering};

use super::Failure;

static INTERRUPTED: AtomicBool = AtomicBool::new(false);

/// From now on, an interruption sets a flag instead of ending the process.
pub fn catch() -> &'static AtomicBool {
    // Without a handler an interruption ends the process on the spot, which leaves at worst a temporary file.
    if let Err(error) = ctrlc::set_handler(|| INTERRUPTED.store(true, Ordering::Relaxed)) {
        tracing::warn!("interruptions cannot be caught: {error}");
    }
    &INTERRUPTED
}

/// The flag that an interruption sets once it is caught.
pub fn flag() -> &'static AtomicBool {
    &INTERRUPTED
}

/// Whether there was one.
pub fn happened() -> bool {
    INTERRUPTED.load(Ordering::Relaxed)
}

/// Ends the work if there was one.
///
/// # Errors
/// [`Failure::Interrupted`].
pub fn stop_if_happened() -> Result<(), Failure> {
    if happened() { Err(Failure::Interrupted) } else { Ok(()) }
}
