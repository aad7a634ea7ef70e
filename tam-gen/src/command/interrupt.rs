//! Ctrl-C: work stops soon, and leaves nothing half-written.

use std::process::exit;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Mutex, MutexGuard, PoisonError};
use std::time::Duration;

use super::{Failure, Output, progress};

/// Exit status of a command that was interrupted.
pub const STATUS: u8 = 130;

/// Work that ends by itself has so long to do so.
const PATIENCE: Duration = Duration::from_millis(30);

static INTERRUPTED: AtomicBool = AtomicBool::new(false);

/// How the end of work is told that goes on and may end on the spot.
static AT_ONCE: Mutex<Vec<Output>> = Mutex::new(Vec::new());

fn at_once_now() -> MutexGuard<'static, Vec<Output>> {
    AT_ONCE.lock().unwrap_or_else(PoisonError::into_inner)
}

/// From now on, an interruption sets a flag instead of ending the process; it still does in the midst of [`at_once`].
pub fn catch() -> &'static AtomicBool {
    let interrupted = || {
        INTERRUPTED.store(true, Ordering::SeqCst);
        std::thread::sleep(PATIENCE);
        // As long as it is locked no such work ends, and nothing is written by what comes after it.
        if let Some(output) = at_once_now().last() {
            progress::clear();
            output.failure(&Failure::Interrupted);
            exit(STATUS.into());
        }
    };
    // Without a handler an interruption ends the process on the spot, which leaves at worst a temporary file.
    if let Err(error) = ctrlc::set_handler(interrupted) {
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
    INTERRUPTED.load(Ordering::SeqCst)
}

/// Ends the work if there was one.
///
/// # Errors
/// [`Failure::Interrupted`].
pub fn stop_if_happened() -> Result<(), Failure> {
    if happened() { Err(Failure::Interrupted) } else { Ok(()) }
}

/// Does work that writes nothing and looks at no flag, or seldom: an interruption that is caught ends the process in the
/// midst of it, as if it had stopped by itself.
///
/// # Errors
/// [`Failure::Interrupted`] where it happened before, or just as the work was done.
pub fn at_once<T>(output: &Output, work: impl FnOnce() -> T) -> Result<T, Failure> {
    /// Also where the work panics.
    struct Within;
    impl Drop for Within {
        fn drop(&mut self) {
            at_once_now().pop();
        }
    }
    at_once_now().push(*output);
    let within = Within;
    stop_if_happened()?;
    let made = work();
    drop(within);
    stop_if_happened()?;
    Ok(made)
}
