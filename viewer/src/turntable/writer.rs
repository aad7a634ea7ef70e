//! Frames into a folder of PNG, an APNG or a GIF: complete, or not at all.

use std::fs::{self, File};
use std::io::{self, BufWriter, Read, Seek, SeekFrom, Write};
use std::path::{Path, PathBuf};

use image::codecs::gif::{GifEncoder, Repeat};
use image::{Delay, Frame, RgbaImage};
use tempfile::{NamedTempFile, TempDir};

/// How much GIF's choice of colours may cost, 1 (best) ..= 30; above 10 gains little time.
const GIF_SPEED: i32 = 10;

/// Last byte of a complete GIF.
const GIF_TRAILER: u8 = 0x3b;

/// What frames are written to.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum FrameFile {
    /// A folder with `frame_0000.png` and so on.
    Folder(PathBuf),
    /// An animated PNG.
    Apng(PathBuf),
    /// A GIF, of 256 colours a frame.
    Gif(PathBuf),
}

impl FrameFile {
    /// By the path: `.png` or `.apng`, `.gif`, or a folder (without extension, or with a slash at its end); `None` for
    /// other extensions.
    pub fn of(path: &Path) -> Option<Self> {
        let ends_as_folder = path.as_os_str().to_string_lossy().ends_with(['/', std::path::MAIN_SEPARATOR]);
        if ends_as_folder || path.is_dir() {
            return Some(Self::Folder(path.into()));
        }
        let Some(extension) = path.extension() else { return Some(Self::Folder(path.into())) };
        match extension.to_string_lossy().to_ascii_lowercase().as_str() {
            "png" | "apng" => Some(Self::Apng(path.into())),
            "gif" => Some(Self::Gif(path.into())),
            _ => None,
        }
    }

    /// Refuses a place that is taken or frames that are too large, before work is put into them.
    ///
    /// # Errors
    /// [`WriteError::Exists`], [`WriteError::TooLarge`].
    pub fn check(&self, size: [u32; 2], force: bool) -> Result<(), WriteError> {
        let path = self.path();
        let taken = match self {
            Self::Folder(_) => fs::read_dir(path).is_ok_and(|mut entries| entries.next().is_some()),
            _ => path.symlink_metadata().is_ok(),
        };
        if taken && !force {
            return Err(WriteError::Exists(path.into()));
        }
        if matches!(self, Self::Gif(_)) && size.iter().any(|side| *side > u32::from(u16::MAX)) {
            return Err(WriteError::TooLarge(size));
        }
        Ok(())
    }

    /// Its path.
    pub fn path(&self) -> &Path {
        match self {
            Self::Folder(path) | Self::Apng(path) | Self::Gif(path) => path,
        }
    }
}

/// Why frames are not written.
#[derive(Debug, thiserror::Error)]
pub enum WriteError {
    /// Something is there that may not be replaced.
    #[error("{} is already there", .0.display())]
    Exists(PathBuf),
    /// A GIF's sides have 16 bits.
    #[error("a GIF has at most 65535 x 65535 pixels, and {}x{} are wanted", .0[0], .0[1])]
    TooLarge([u32; 2]),
    /// A frame is of another size than the first.
    #[error("a frame of {}x{} follows frames of {}x{}", .found[0], .found[1], .expected[0], .expected[1])]
    Size {
        /// Sides of the frame.
        found: [u32; 2],
        /// Sides it should have.
        expected: [u32; 2],
    },
    /// There are fewer or more frames than announced.
    #[error("{found} frames were written, and {expected} announced")]
    Count {
        /// Frames written.
        found: u32,
        /// Frames announced.
        expected: u32,
    },
    /// The system refuses.
    #[error("cannot write {}: {source}", .path.display())]
    Write {
        /// The file or folder.
        path: PathBuf,
        /// What the system says.
        source: io::Error,
    },
}

/// Takes frames one by one. Dropped before [`FrameWriter::finish`], it leaves nothing behind.
pub struct FrameWriter {
    path: PathBuf,
    size: [u32; 2],
    expected: u32,
    written: u32,
    fps: u16,
    force: bool,
    sink: Sink,
}

enum Sink {
    Folder(TempDir),
    Apng { file: NamedTempFile, png: Box<png::Writer<BufWriter<File>>> },
    Gif { file: NamedTempFile, gif: Box<GifEncoder<BufWriter<File>>> },
}

impl FrameWriter {
    /// Opens a file or folder for `frames` (1 or more) frames of this size, shown at `fps` (1 or more) frames per second.
    ///
    /// # Errors
    /// [`WriteError`]: the place is taken and `force` is not given, or cannot be written.
    pub fn new(file: &FrameFile, size: [u32; 2], frames: u32, fps: u16, force: bool) -> Result<Self, WriteError> {
        file.check(size, force)?;
        let path = file.path().to_path_buf();
        let sink =
            open(file, &path, size, frames, fps).map_err(|source| WriteError::Write { path: path.clone(), source })?;
        Ok(Self { path, size, expected: frames, written: 0, fps: fps.max(1), force, sink })
    }

    /// Adds a frame.
    ///
    /// # Errors
    /// [`WriteError`]: it is of another size, or cannot be written.
    pub fn write(&mut self, frame: RgbaImage) -> Result<(), WriteError> {
        let found = frame.dimensions().into();
        if found != self.size {
            return Err(WriteError::Size { found, expected: self.size });
        }
        let written = match &mut self.sink {
            Sink::Folder(dir) => frame.save(dir.path().join(frame_name(self.written))).map_err(io::Error::other),
            Sink::Apng { png, .. } => png.write_image_data(&frame).map_err(io::Error::other),
            Sink::Gif { gif, .. } => {
                // GIF counts hundredths of a second: frames differ by one so that the mean is right.
                let until = |frame: u32| (u64::from(frame) * 100 + u64::from(self.fps) / 2) / u64::from(self.fps);
                let hundredths = (until(self.written + 1) - until(self.written)).max(2) as u32;
                let delay = Delay::from_numer_denom_ms(hundredths * 10, 1);
                gif.encode_frame(Frame::from_parts(frame, 0, 0, delay)).map_err(io::Error::other)
            }
        };
        self.written += 1;
        written.map_err(|source| WriteError::Write { path: self.path.clone(), source })
    }

    /// Puts the finished file or folder in its place.
    ///
    /// # Errors
    /// [`WriteError`]: frames are missing, or it cannot be written.
    pub fn finish(self) -> Result<(), WriteError> {
        let Self { path, expected, written: found, force, sink, .. } = self;
        if found != expected {
            return Err(WriteError::Count { found, expected });
        }
        let finished = match sink {
            Sink::Folder(dir) => place_folder(dir, &path, found),
            Sink::Apng { file, png } => png.finish().map_err(io::Error::other).and_then(|()| place(file, &path, force)),
            Sink::Gif { file, gif } => {
                drop(gif);
                ends_with_trailer(file.as_file()).and_then(|()| place(file, &path, force))
            }
        };
        finished.map_err(|source| WriteError::Write { path, source })
    }
}

fn open(file: &FrameFile, path: &Path, size: [u32; 2], frames: u32, fps: u16) -> io::Result<Sink> {
    let parent = match path.parent() {
        Some(parent) if !parent.as_os_str().is_empty() => parent,
        _ => Path::new("."),
    };
    fs::create_dir_all(parent)?;
    let mut builder = tempfile::Builder::new();
    builder.prefix(".tam-");
    #[cfg(unix)]
    {
        use std::os::unix::fs::PermissionsExt;
        let folder = matches!(file, FrameFile::Folder(_));
        builder.permissions(fs::Permissions::from_mode(if folder { 0o777 } else { 0o666 }));
    }
    match file {
        FrameFile::Folder(_) => {
            if path.symlink_metadata().is_ok() && !path.is_dir() {
                return Err(io::ErrorKind::NotADirectory.into());
            }
            Ok(Sink::Folder(builder.tempdir_in(parent)?))
        }
        FrameFile::Apng(_) => {
            let file = builder.tempfile_in(parent)?;
            let mut encoder = png::Encoder::new(BufWriter::new(file.as_file().try_clone()?), size[0], size[1]);
            encoder.set_color(png::ColorType::Rgba);
            encoder.set_depth(png::BitDepth::Eight);
            encoder.set_animated(frames, 0).map_err(io::Error::other)?;
            encoder.set_frame_delay(1, fps).map_err(io::Error::other)?;
            Ok(Sink::Apng { png: Box::new(encoder.write_header().map_err(io::Error::other)?), file })
        }
        FrameFile::Gif(_) => {
            let file = builder.tempfile_in(parent)?;
            let mut gif = GifEncoder::new_with_speed(BufWriter::new(file.as_file().try_clone()?), GIF_SPEED);
            gif.set_repeat(Repeat::Infinite).map_err(io::Error::other)?;
            Ok(Sink::Gif { gif: Box::new(gif), file })
        }
    }
}

fn frame_name(index: u32) -> String {
    format!("frame_{index:04}.png")
}

fn place(mut file: NamedTempFile, path: &Path, force: bool) -> io::Result<()> {
    file.flush()?;
    if force { file.persist(path) } else { file.persist_noclobber(path) }.map_err(|error| error.error)?;
    Ok(())
}

/// Makes the folder the target; where that is there already, the frames go into it, and older ones go.
fn place_folder(dir: TempDir, path: &Path, frames: u32) -> io::Result<()> {
    // An empty folder may be replaced; one that is not stays, and so does everything in it that is no frame.
    if !path.exists() || fs::remove_dir(path).is_ok() {
        fs::rename(dir.path(), path)?;
        // It is gone from where it was.
        let _ = dir.keep();
        return Ok(());
    }
    for index in 0..frames {
        fs::rename(dir.path().join(frame_name(index)), path.join(frame_name(index)))?;
    }
    for older in (frames..).map(|index| path.join(frame_name(index))).take_while(|older| older.exists()) {
        fs::remove_file(older)?;
    }
    Ok(())
}

/// The encoder ends a GIF when it is dropped, and cannot say if that went wrong.
fn ends_with_trailer(mut file: &File) -> io::Result<()> {
    let mut last = [0];
    file.seek(SeekFrom::End(-1))?;
    file.read_exact(&mut last)?;
    if last[0] == GIF_TRAILER { Ok(()) } else { Err(io::Error::other("the end of the file could not be written")) }
}

#[cfg(test)]
mod tests {
    use image::AnimationDecoder;
    use image::codecs::gif::GifDecoder;
    use image::codecs::png::PngDecoder;

    use super::*;

    fn frame(index: u32) -> RgbaImage {
        RgbaImage::from_pixel(8, 6, image::Rgba([(index * 40) as u8, 0, 90, 255]))
    }

    fn written(name: &str, force: bool, dir: &Path) -> Result<PathBuf, WriteError> {
        let path = dir.join(name);
        let file = FrameFile::of(&path).expect("a known kind");
        let mut writer = FrameWriter::new(&file, [8, 6], 5, 30, force)?;
        for index in 0..5 {
            writer.write(frame(index))?;
        }
        writer.finish()?;
        Ok(path)
    }

    fn open(path: &Path) -> io::BufReader<File> {
        io::BufReader::new(File::open(path).expect("the file"))
    }

    #[test]
    fn every_kind_holds_all_frames() {
        let dir = tempfile::tempdir().expect("a folder");
        let apng = written("a.png", false, dir.path()).expect("an APNG");
        let frames = PngDecoder::new(open(&apng)).expect("PNG").apng().expect("animated").into_frames();
        let frames = frames.collect_frames().expect("frames");
        assert_eq!(frames.len(), 5);
        assert!((0..5).zip(&frames).all(|(index, found)| *found.buffer() == frame(index)));
        let gif = written("b.gif", false, dir.path()).expect("a GIF");
        let frames = GifDecoder::new(open(&gif)).expect("GIF").into_frames().collect_frames().expect("frames");
        let hundredths: u32 = frames.iter().map(|frame| frame.delay().numer_denom_ms().0 / 10).sum();
        // 5 frames at 30 per second are 16.7 hundredths.
        assert_eq!((frames.len(), hundredths), (5, 17));
        let folder = written("c", false, dir.path()).expect("a folder");
        let third = image::open(folder.join("frame_0003.png")).expect("a picture").into_rgba8();
        assert_eq!(third, frame(3));
    }

    #[test]
    fn nothing_is_left_of_what_is_not_finished() {
        let dir = tempfile::tempdir().expect("a folder");
        for name in ["a.png", "b.gif", "c"] {
            let file = FrameFile::of(&dir.path().join(name)).expect("a known kind");
            let mut writer = FrameWriter::new(&file, [8, 6], 5, 30, false).expect("a writer");
            writer.write(frame(0)).expect("a frame");
            let short = writer.finish();
            assert!(matches!(short, Err(WriteError::Count { found: 1, expected: 5 })), "{short:?}");
        }
        assert_eq!(fs::read_dir(dir.path()).expect("the folder").count(), 0);
    }

    #[test]
    fn only_force_replaces() {
        let dir = tempfile::tempdir().expect("a folder");
        for name in ["a.png", "b.gif", "c"] {
            written(name, false, dir.path()).expect("the first");
            let again = written(name, false, dir.path());
            assert!(matches!(again, Err(WriteError::Exists(_))), "{again:?}");
        }
        fs::write(dir.path().join("c/frame_0005.png"), "older").expect("a file");
        fs::write(dir.path().join("c/mine.txt"), "mine").expect("a file");
        for name in ["a.png", "b.gif", "c"] {
            written(name, true, dir.path()).expect("replaced");
        }
        assert!(!dir.path().join("c/frame_0005.png").exists() && dir.path().join("c/mine.txt").exists());
        assert_eq!(fs::read_dir(dir.path()).expect("the folder").count(), 3);
    }

    #[test]
    fn paths_tell_the_kind() {
        let kind = |path: &str| FrameFile::of(Path::new(path));
        assert_eq!(kind("x.PNG"), Some(FrameFile::Apng("x.PNG".into())));
        assert_eq!(kind("x.gif"), Some(FrameFile::Gif("x.gif".into())));
        assert_eq!(kind("out/"), Some(FrameFile::Folder("out/".into())));
        assert_eq!(kind("v1.2/"), Some(FrameFile::Folder("v1.2/".into())));
        assert_eq!(kind("x.mp4"), None);
    }

    #[test]
    fn a_frame_of_another_size_is_refused() {
        let dir = tempfile::tempdir().expect("a folder");
        let file = FrameFile::Apng(dir.path().join("a.png"));
        let mut writer = FrameWriter::new(&file, [8, 7], 1, 30, false).expect("a writer");
        assert!(matches!(writer.write(frame(0)), Err(WriteError::Size { .. })));
    }
}
