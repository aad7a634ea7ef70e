//! Writing a map for engines, programs and people.
//!
//! Images in memory hold ink; files hold luminance (255 paper, 0 ink), so that a texture shows as it looks. A stroke
//! map's file holds the threshold as it is: 0 is inked first. Texels are linear light in every format.

mod bc4;
mod content;
pub mod dds;
mod error;
mod files;
mod format;
pub mod ktx2;
mod manifest;
mod plan;
pub mod sheet;
mod svg;

use std::path::{Path, PathBuf};

use rayon::prelude::*;

use crate::job::Job;
use crate::map::Map;

pub(crate) use bc4::decode as decode_bc4;
pub use error::ExportError;
pub use format::{Format, UnknownFormat};
pub use manifest::{Manifest, ManifestFile, ManifestLevel};
pub use svg::strokes_svg;

/// The generator's version, as files state it.
pub const VERSION: &str = env!("CARGO_PKG_VERSION");

/// What to write.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct ExportOptions {
    /// The formats; repetitions are written once.
    pub formats: Vec<Format>,
    /// Whether files of the same names may be replaced.
    pub overwrite: bool,
    /// Whether a contact sheet comes too.
    pub sheet: bool,
}

impl Default for ExportOptions {
    /// The master file and the contact sheet; nothing is replaced.
    fn default() -> Self {
        Self { formats: vec![Format::Ktx2], overwrite: false, sheet: true }
    }
}

/// A file that was written.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct WrittenFile {
    /// Where it is.
    pub path: PathBuf,
    /// Its size.
    pub bytes: u64,
    /// What it is, in a few words, with whatever one should know about it.
    pub what: String,
}

/// Writes a map into a folder, in all formats asked for, with its stroke map (`NAME.strokemap.ktx2`), a contact sheet
/// (`NAME.sheet.png`) and a manifest (`NAME.json`).
///
/// All files appear together, by renaming, when all are complete. The folder is made where it is missing.
///
/// # Errors
///
/// See [`ExportError`]; then, and when the job is cancelled, the folder is as it was before.
pub fn export(
    map: &Map,
    name: &str,
    dir: &Path,
    options: &ExportOptions,
    job: &Job<'_>,
) -> Result<Vec<WrittenFile>, ExportError> {
    check_name(name)?;
    plan::check_map(map)?;
    let preset_toml = map.preset.to_toml();
    let planned = plan::plan(map, name, options, &preset_toml)?;
    let manifest_path = format!("{name}.json");

    let targets: Vec<PathBuf> =
        planned.iter().map(|file| dir.join(&file.path)).chain([dir.join(&manifest_path)]).collect();
    check_targets(&targets, options.overwrite)?;
    stop_if_cancelled(job)?;

    let mut staging = files::Staging::new(dir)?;
    for folder in targets.iter().filter_map(|target| target.parent()) {
        staging.folder(folder)?;
    }
    let made: Vec<_> = planned
        .par_iter()
        .zip(&targets)
        .map(|(file, target)| {
            stop_if_cancelled(job)?;
            let content = (file.make)().map_err(|problem| ExportError::Encode { path: target.clone(), problem })?;
            stop_if_cancelled(job)?;
            let what = format!("{}{}", file.what, content.remark);
            let bytes = content.pieces.iter().map(|piece| piece.len() as u64).sum();
            Ok((staging.write(target, &content.pieces)?, bytes, what))
        })
        .collect::<Result<_, ExportError>>()?;

    let mut listed = Vec::with_capacity(made.len());
    let mut staged = Vec::with_capacity(made.len() + 1);
    for (file, (temporary, bytes, what)) in planned.iter().zip(made) {
        listed.push(ManifestFile { path: file.path.clone(), bytes, what });
        staged.push(temporary);
    }
    let manifest = Manifest::new(map, name, preset_toml.clone(), listed.clone(), job);
    let target = dir.join(&manifest_path);
    let json = json(&manifest).map_err(|problem| ExportError::Encode { path: target.clone(), problem })?;
    let bytes = json.len() as u64;
    staged.push(staging.write(&target, &[json])?);
    listed.push(ManifestFile { path: manifest_path, bytes, what: "manifest".into() });

    stop_if_cancelled(job)?;
    staging.commit(staged)?;
    let written = listed.into_iter().zip(targets);
    Ok(written.map(|(file, path)| WrittenFile { path, bytes: file.bytes, what: file.what }).collect())
}

fn json(content: &impl serde::Serialize) -> Result<Vec<u8>, String> {
    let mut bytes = serde_json::to_vec_pretty(content).map_err(|error| error.to_string())?;
    bytes.push(b'\n');
    Ok(bytes)
}

fn stop_if_cancelled(job: &Job<'_>) -> Result<(), ExportError> {
    if job.cancelled() { Err(ExportError::Cancelled) } else { Ok(()) }
}

/// A name is one part of a path on every system, and not hidden.
fn check_name(name: &str) -> Result<(), ExportError> {
    const FORBIDDEN: &str = "/\\:*?\"<>|{}";
    let bad = |c: char| c.is_control() || FORBIDDEN.contains(c);
    if name.is_empty() || name.len() > 128 || name.starts_with('.') || name.trim() != name || name.contains(bad) {
        return Err(ExportError::Name { name: name.into() });
    }
    Ok(())
}

fn check_targets(targets: &[PathBuf], overwrite: bool) -> Result<(), ExportError> {
    if let Some(folder) = targets.iter().find(|target| target.is_dir()) {
        return Err(ExportError::Blocked(folder.clone()));
    }
    // A dangling link counts: renaming would replace it.
    let existing: Vec<_> = targets.iter().filter(|target| target.symlink_metadata().is_ok()).cloned().collect();
    if existing.is_empty() || overwrite { Ok(()) } else { Err(ExportError::Exists(existing)) }
}
