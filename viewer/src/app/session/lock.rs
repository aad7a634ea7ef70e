//! One window keeps a session: a second one would write over what the first has kept.

use std::fs::{File, TryLockError};
use std::path::Path;

/// Who keeps a session.
#[derive(Debug)]
pub(crate) enum Owner {
    /// This window, for as long as it has the lock.
    This(Lock),
    /// Another one that is open.
    Another,
}

/// Keeps others from writing a session until it is dropped, also where the program is lost.
#[derive(Debug)]
pub(crate) struct Lock {
    /// `None` where the system has no locks; two windows then write over each other, as without this.
    _file: Option<File>,
}

impl Lock {
    /// Takes the lock of the session at a path. It is a file beside it, which stays empty and is never removed: another
    /// window may be about to take it.
    pub(crate) fn take(session: &Path) -> Owner {
        let mut name = session.file_name().unwrap_or_default().to_owned();
        name.push(".lock");
        // A folder that cannot be written to is told of when the session is to be.
        let opened = std::fs::create_dir_all(tam_gen::files::folder_of(session))
            .and_then(|()| File::options().create(true).truncate(false).write(true).open(session.with_file_name(name)));
        let Ok(file) = opened else { return Owner::This(Self { _file: None }) };
        match file.try_lock() {
            Ok(()) => Owner::This(Self { _file: Some(file) }),
            Err(TryLockError::WouldBlock) => Owner::Another,
            Err(TryLockError::Error(_)) => Owner::This(Self { _file: None }),
        }
    }
}
