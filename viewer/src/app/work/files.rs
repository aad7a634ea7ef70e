//! What is written to disk: maps, pictures, turntables.

use std::path::{Path as FilePath, PathBuf};
use std::time::Duration;

use image::RgbaImage;
use tam_gen::export::{ExportError, ExportOptions, Format, export};
use tam_gen::{GenerateError, Job, Preset};

use super::named::Named;
use super::painter::{Painter, Shot};
use super::worker::{Manner, Wake, Worker};
use crate::RenderError;
use crate::maps::HatchMap;
use crate::turntable::{FrameFile, FrameWriter, Path};

/// What is to be written.
pub(super) enum FileRequest {
    /// A map, for engines.
    Export { name: String, preset: Box<Preset>, folder: PathBuf, options: ExportOptions },
    /// A picture.
    Picture { shot: Box<Shot>, path: PathBuf },
    /// A turntable: the shot along a path.
    Turntable { shot: Box<Shot>, along: Path, path: PathBuf, frames: u32, fps: u16 },
}

/// What became of it.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) enum FileReply {
    /// It is there.
    Written {
        /// In a sentence.
        text: String,
        /// The file or folder to show.
        place: PathBuf,
    },
    /// It is not, and nothing of it.
    Failed(String),
    /// The user stopped it.
    Cancelled,
}

pub(super) type FileWorker = Worker<FileRequest, FileReply>;

/// Starts the worker that writes files.
pub(super) fn file_worker(wake: Wake) -> std::io::Result<FileWorker> {
    let work = |painter: &mut Option<Painter>, request: FileRequest, job: &Job<'_>, reply: &dyn Fn(FileReply)| {
        let written = match request {
            FileRequest::Export { name, preset, folder, options } => map(&name, &preset, &folder, &options, job),
            FileRequest::Picture { mut shot, path } => match with_finer_maps(&mut shot, job) {
                Ok(()) => picture(painter, &shot, &path),
                Err(GenerateError::Cancelled) => Ok(FileReply::Cancelled),
                Err(error) => Err(error.to_string()),
            },
            FileRequest::Turntable { shot, along, path, frames, fps } => {
                turntable(painter, &shot, along, &path, frames, fps, job)
            }
        };
        reply(written.unwrap_or_else(FileReply::Failed));
    };
    let failed = |words: String| FileReply::Failed(format!("it could not be written: {words}"));
    Worker::start("files", Manner { patience: Duration::MAX, leaves_behind: false }, wake, || None, work, failed)
}

fn map(
    name: &str,
    preset: &Preset,
    folder: &FilePath,
    options: &ExportOptions,
    job: &Job<'_>,
) -> Result<FileReply, String> {
    // The same preset gives the same bytes, so it is made anew rather than kept from a moment ago.
    let generating = |part: f32| job.report(part * 0.5);
    let map = match tam_gen::generate(preset, &Job { progress: Some(&generating), ..*job }) {
        Ok(map) => map,
        Err(GenerateError::Cancelled) => return Ok(FileReply::Cancelled),
        Err(error) => return Err(error.to_string()),
    };
    let written = match export(&map, name, folder, options, job) {
        Ok(written) => written,
        Err(ExportError::Cancelled) => return Ok(FileReply::Cancelled),
        Err(error) => return Err(error.to_string()),
    };
    job.report(1.0);
    let bytes: u64 = written.iter().map(|file| file.bytes).sum();
    let text = format!("{} files, {} in {}", written.len(), super::super::words::bytes(bytes), folder.display());
    Ok(FileReply::Written { text, place: folder.to_owned() })
}

/// Makes maps finer for a picture that is larger than the one it looks like, where their presets are known.
fn with_finer_maps(shot: &mut Shot, job: &Job<'_>) -> Result<(), GenerateError> {
    let times = f64::from(shot.size_px[1]) / f64::from(shot.for_height.max(1));
    let mut made: Vec<(Named<HatchMap>, Named<HatchMap>)> = Vec::new();
    for map in shot.sides.iter_mut().flat_map(|side| &mut side.sitters).flat_map(|sitter| &mut sitter.maps) {
        if let Some((_, finer)) = made.iter().find(|(own, _)| own == map) {
            *map = finer.clone();
        } else if let Some(preset) = map.preset.as_ref().filter(|preset| preset.texels_for(times) > 1) {
            let job = Job { progress: None, ..*job };
            let finer = Named::map(HatchMap::finer(&map.name, preset, preset.texels_for(times), &job)?);
            made.push((map.clone(), finer.clone()));
            *map = finer;
        }
    }
    Ok(())
}

fn painter(kept: &mut Option<Painter>) -> Result<&mut Painter, String> {
    if kept.is_none() {
        *kept = Some(Painter::open().map_err(|error| error.to_string())?);
    }
    kept.as_mut().ok_or_else(String::new)
}

fn painted(painter: &mut Painter, shot: &Shot) -> Result<RgbaImage, String> {
    let read = |painter: &mut Painter| Ok::<_, RenderError>(painter.paint(shot)?.canvas.read()?);
    read(painter).map_err(|error| error.to_string())
}

fn picture(kept: &mut Option<Painter>, shot: &Shot, path: &FilePath) -> Result<FileReply, String> {
    let drawn = painted(painter(kept)?, shot);
    if drawn.is_err() {
        // Whatever is wrong with the device, the next picture starts with another.
        *kept = None;
    }
    let image = drawn?;
    let failed = |error: &dyn std::fmt::Display| format!("cannot write {}: {error}", path.display());
    let mut png = std::io::Cursor::new(Vec::new());
    image.write_to(&mut png, image::ImageFormat::Png).map_err(|error| failed(&error))?;
    tam_gen::files::replace(path, png.get_ref()).map_err(|error| failed(&error))?;
    let [width, height] = shot.size_px;
    Ok(FileReply::Written { text: format!("{width} x {height} px, {}", path.display()), place: path.to_owned() })
}

fn turntable(
    kept: &mut Option<Painter>,
    shot: &Shot,
    along: Path,
    path: &FilePath,
    frames: u32,
    fps: u16,
    job: &Job<'_>,
) -> Result<FileReply, String> {
    let painter = painter(kept)?;
    // Frames that are put into a folder would take the place of others there, which no dialog has asked about.
    let file = FrameFile::of(path)
        .filter(|file| !matches!(file, FrameFile::Folder(_)))
        .ok_or_else(|| format!("{} is of no kind that frames are written to: .png or .gif", path.display()))?;
    // The dialog has asked whether it may be replaced.
    let mut writer = FrameWriter::new(&file, shot.size_px, frames, fps, true).map_err(|error| error.to_string())?;
    let mut shot = shot.clone();
    for frame in 0..frames {
        if job.cancelled() {
            return Ok(FileReply::Cancelled);
        }
        job.report(frame as f32 / frames as f32);
        shot.pose = Some((along, f64::from(frame) / f64::from(frames)));
        writer.write(painted(painter, &shot)?).map_err(|error| error.to_string())?;
    }
    writer.finish().map_err(|error| error.to_string())?;
    Ok(FileReply::Written { text: format!("{frames} frames, {}", path.display()), place: path.to_owned() })
}

/// Formats by the names that settings hold; unknown ones are left out.
pub(super) fn formats(names: &[String]) -> Vec<Format> {
    Format::ALL.into_iter().filter(|format| names.iter().any(|name| name == format.name())).collect()
}
