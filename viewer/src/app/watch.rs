//! Preset files that other programs change.

use std::path::{Path, PathBuf};
use std::sync::mpsc::{Receiver, channel};

use notify::{RecommendedWatcher, RecursiveMode, Watcher};

use super::work::Wake;

/// Watches one file at a time.
pub(crate) struct FileWatch {
    watched: Option<(PathBuf, RecommendedWatcher)>,
    changes: Receiver<()>,
    wake: Wake,
}

impl FileWatch {
    /// Watches nothing yet.
    pub(crate) fn new(wake: Wake) -> Self {
        Self { watched: None, changes: channel().1, wake }
    }

    /// Watches this file from now on. Where the system cannot watch, nothing is noticed.
    pub(crate) fn follow(&mut self, path: Option<&Path>) {
        if self.watched.as_ref().map(|(watched, _)| watched.as_path()) == path {
            return;
        }
        self.watched = None;
        let Some(path) = path else { return };
        let (sender, changes) = channel();
        self.changes = changes;
        let (wake, name) = (std::sync::Arc::clone(&self.wake), path.file_name().map(ToOwned::to_owned));
        let handler = move |event: notify::Result<notify::Event>| {
            let Ok(event) = event else { return };
            let concerns = event.paths.iter().any(|path| path.file_name().map(ToOwned::to_owned) == name);
            if concerns && !event.kind.is_access() && sender.send(()).is_ok() {
                wake();
            }
        };
        // Editors replace files: the folder is what stays.
        if let Ok(mut watcher) = notify::recommended_watcher(handler)
            && watcher.watch(tam_gen::files::folder_of(path), RecursiveMode::NonRecursive).is_ok()
        {
            self.watched = Some((path.to_owned(), watcher));
        }
    }

    /// Whether the file was changed since the last call.
    pub(crate) fn changed(&self) -> bool {
        self.changes.try_iter().count() > 0
    }
}
