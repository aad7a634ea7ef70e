//! Questions for files, which the system's own dialogs ask.

use std::path::PathBuf;
use std::sync::mpsc::{Receiver, Sender, channel};

use rfd::{AsyncFileDialog, FileHandle};

use super::apply::{Ask, MESH_KINDS};
use super::command::Command;
use super::state::MeshSource;
use super::work::Wake;

/// Open dialogs and their answers.
pub(crate) struct Asker {
    answers: Receiver<Command>,
    sender: Sender<Command>,
    wake: Wake,
}

impl Asker {
    /// Without open dialogs.
    pub(crate) fn new(wake: Wake) -> Self {
        let (sender, answers) = channel();
        Self { answers, sender, wake }
    }

    /// Opens a dialog; it does not wait for the answer, which may never come.
    pub(crate) fn ask(&self, ask: Ask) {
        let (sender, wake) = (self.sender.clone(), std::sync::Arc::clone(&self.wake));
        // Dialogs are made here, where some systems want it, and waited for elsewhere.
        let dialog = dialog(&ask);
        let waiting = std::thread::Builder::new().name("dialog".to_owned()).spawn(move || {
            if let Some(path) = pollster::block_on(answer(dialog, &ask)) {
                // Nobody waits for answers after the window is closed.
                let _ = sender.send(command(&ask, path));
                wake();
            }
        });
        // Without a thread there is no dialog; the user sees that none opens.
        drop(waiting);
    }

    /// What was answered since the last call.
    pub(crate) fn answers(&self) -> impl Iterator<Item = Command> + '_ {
        self.answers.try_iter()
    }
}

fn dialog(ask: &Ask) -> AsyncFileDialog {
    let dialog = AsyncFileDialog::new();
    match ask {
        Ask::OpenPreset => dialog.set_title("Open preset").add_filter("Preset", &["toml"]),
        Ask::SavePreset(name) => {
            dialog.set_title("Save preset").add_filter("Preset", &["toml"]).set_file_name(format!("{name}.toml"))
        }
        Ask::OpenMesh => dialog.set_title("Load mesh").add_filter("Mesh", &MESH_KINDS),
        Ask::AddObject => dialog.set_title("Add mesh").add_filter("Mesh", &MESH_KINDS),
        Ask::OpenScene => dialog.set_title("Open scene").add_filter("Scene", &["toml"]),
        Ask::SaveScene(name) => {
            dialog.set_title("Save scene").add_filter("Scene", &["toml"]).set_file_name(format!("{name}.toml"))
        }
        Ask::ExportFolder => dialog.set_title("Folder of exports"),
        Ask::SavePicture(name) => dialog.set_title("Save picture").add_filter("PNG", &["png"]).set_file_name(name),
        Ask::SaveTurntable(name) => {
            dialog.set_title("Save turntable").add_filter("APNG or GIF", &["png", "gif"]).set_file_name(name)
        }
        Ask::OpenGuides => dialog.set_title("Open guides").add_filter("Guides", &["json"]),
        Ask::SaveGuides(name) => {
            dialog.set_title("Save guides").add_filter("Guides", &["json"]).set_file_name(format!("{name}.json"))
        }
    }
}

async fn answer(dialog: AsyncFileDialog, ask: &Ask) -> Option<PathBuf> {
    let chosen: Option<FileHandle> = match ask {
        Ask::OpenPreset | Ask::OpenMesh | Ask::AddObject | Ask::OpenScene | Ask::OpenGuides => dialog.pick_file().await,
        Ask::ExportFolder => dialog.pick_folder().await,
        Ask::SavePreset(_) | Ask::SaveScene(_) | Ask::SavePicture(_) | Ask::SaveTurntable(_) | Ask::SaveGuides(_) => {
            dialog.save_file().await
        }
    };
    chosen.map(|file| file.path().to_owned())
}

fn command(ask: &Ask, path: PathBuf) -> Command {
    match ask {
        Ask::OpenPreset => Command::OpenPreset(Some(path)),
        Ask::SavePreset(_) => Command::SaveAs(Some(path)),
        Ask::OpenMesh => Command::OpenMesh(Some(path)),
        Ask::AddObject => Command::AddObject(Some(MeshSource::File(path))),
        Ask::OpenScene => Command::OpenScene(Some(path)),
        Ask::SaveScene(_) => Command::SaveScene(Some(path)),
        Ask::ExportFolder => Command::ExportInto(path),
        Ask::SavePicture(_) => Command::SavePicture(Some(path)),
        Ask::SaveTurntable(_) => Command::SaveTurntable(Some(path)),
        Ask::OpenGuides => Command::OpenGuides(Some(path)),
        Ask::SaveGuides(_) => Command::SaveGuides(Some(path)),
    }
}
