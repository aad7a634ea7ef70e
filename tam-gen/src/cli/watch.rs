//! `tam-gen watch`.

use std::ffi::OsStr;
use std::path::{Path, PathBuf};
use std::sync::atomic::AtomicBool;
use std::sync::mpsc::{Receiver, RecvTimeoutError, channel};
use std::time::{Duration, Instant};

use notify::{Event, EventKind, RecursiveMode, Watcher};
use serde_json::json;
use tam_gen::command::{Failure, Output, files, interrupt, source};
use tam_gen::export::{ExportOptions, Format, Manifest};
use tam_gen::files::folder_of;

use super::Outcome;
use super::args::OverrideArgs;
use super::generate::make;
use tam_gen::command::words::{duration, path_text};

/// How long a file must be left alone before it is read: editors write in several steps, or replace the file.
const SETTLED: Duration = Duration::from_millis(100);

/// How often an interruption is looked for.
const GLANCE: Duration = Duration::from_millis(50);

const EXAMPLES: &str = "\
Examples:
  tam-gen presets new mine && tam-gen watch mine.toml
  tam-gen watch mine.toml -o ../game/assets --also dds-array

Ctrl-C ends it. With --json, one object per line and save.";

#[derive(Debug, clap::Args)]
#[command(after_help = EXAMPLES)]
pub(super) struct WatchArgs {
    /// The preset file
    #[arg(value_name = "PRESET")]
    preset: PathBuf,
    /// Folder to write into; made where it is missing
    #[arg(short, long = "output", value_name = "DIR", default_value = "out")]
    out: PathBuf,
    /// Formats to write besides ktx2
    #[arg(long, value_name = "FORMAT", value_delimiter = ',')]
    also: Vec<Format>,
    /// Replace files even where they are of another making
    #[arg(long)]
    force: bool,
    #[command(flatten)]
    overrides: OverrideArgs,
}

pub(super) fn run(args: &WatchArgs, output: &Output) -> Result<Outcome, Failure> {
    let preset = args.preset.as_path();
    if !preset.is_file() {
        return Err(Failure::usage(
            format!("{} is no file to watch", preset.display()),
            "`tam-gen presets new` writes a preset to start from",
        ));
    }
    files::check_folder(&args.out, "-o")?;
    let name = source::stem(preset)?;
    let cancel = interrupt::catch();
    // The folder is watched, as the file itself goes away where an editor replaces it.
    let (sender, events) = channel();
    let mut watcher = notify::recommended_watcher(sender).map_err(|error| cannot_watch(preset, &error))?;
    watcher.watch(folder_of(preset), RecursiveMode::NonRecursive).map_err(|error| cannot_watch(preset, &error))?;
    output.remark(&format!("watching {}; Ctrl-C ends it", preset.display()));

    loop {
        regenerate(args, &name, cancel, output)?;
        if !wait_for_save(&events, preset.file_name().unwrap_or_default()) {
            return Ok(Outcome::Holds);
        }
    }
}

fn cannot_watch(preset: &Path, error: &notify::Error) -> Failure {
    Failure::usage(format!("cannot watch {}: {error}", preset.display()), "`tam-gen generate` does it once")
}

/// Makes the map anew. What is wrong with the preset is reported, and the watching goes on; only a folder that cannot
/// be written to ends it.
fn regenerate(args: &WatchArgs, name: &str, cancel: &AtomicBool, output: &Output) -> Result<(), Failure> {
    let started = Instant::now();
    let made = source::preset(&args.preset).and_then(|(_, preset)| {
        let preset = preset.apply(&args.overrides.overrides())?;
        let mut options = ExportOptions::default();
        options.formats.extend(args.also.iter().copied());
        options.overwrite = args.force || is_own(&args.out, name);
        make(&preset, name, &args.out, &options, cancel, output)
    });
    match made {
        Ok(made) => {
            let took = started.elapsed();
            let mut line = format!("{} in {}\n", path_text(&args.out.join(name)), duration(took));
            for failing in made.failing() {
                line += &format!("  {failing}\n");
            }
            output.say(&line)?;
            output.object(&made.to_json(name, took))?;
            tracing::info!(holds = made.holds(), "regenerated");
            Ok(())
        }
        Err(Failure::Interrupted) => Ok(()),
        Err(failure @ Failure::Output { .. }) => Err(failure),
        Err(failure) => {
            if output.json {
                output.object(&json!({ "error": failure.to_json() }))
            } else {
                output.failure(&failure);
                Ok(())
            }
        }
    }
}

/// Whether the files of that name in the folder were written by this tool.
fn is_own(dir: &Path, name: &str) -> bool {
    let manifest = std::fs::read(dir.join(format!("{name}.json"))).ok();
    manifest.is_some_and(|bytes| serde_json::from_slice::<Manifest>(&bytes).is_ok_and(|manifest| manifest.name == name))
}

/// Waits until the file was saved and left alone; false when interrupted.
fn wait_for_save(events: &Receiver<notify::Result<Event>>, file: &OsStr) -> bool {
    let mut saved: Option<Instant> = None;
    loop {
        if interrupt::happened() {
            return false;
        }
        match events.recv_timeout(GLANCE) {
            Ok(Ok(event)) if concerns(&event, file) => saved = Some(Instant::now()),
            Ok(_) | Err(RecvTimeoutError::Timeout) => {}
            Err(RecvTimeoutError::Disconnected) => return false,
        }
        if saved.is_some_and(|saved| saved.elapsed() >= SETTLED) {
            return true;
        }
    }
}

/// Whether an event may have changed the content of the file.
fn concerns(event: &Event, file: &OsStr) -> bool {
    let is_change = !matches!(event.kind, EventKind::Access(_));
    is_change && event.paths.iter().any(|path| path.file_name() == Some(file))
}
