//! Reading maps, ours and anyone's: KTX2, DDS, and pictures in a folder.

mod assemble;
mod collect;
pub mod dds;
mod error;
mod facts;
pub mod image;
pub mod ktx2;
mod pattern;
mod texture;

use std::path::{Path, PathBuf};

pub use error::{DecodeError, ImportError};
pub use texture::{BYTES_MAX, LAYERS_MAX, SIDE_MAX, Texture, TextureLevel};

use crate::map::{Grid, StrokeMap, ThresholdLevel};
use pattern::Pattern;

/// How files of one cell each are named where nothing else is said.
pub const DEFAULT_PATTERN: &str = "tone{tone}_level{level}.png";

/// A map as read from files.
#[derive(Debug, Clone, PartialEq)]
pub struct Imported {
    /// The map. Where nothing says how many levels were drawn, those of at least 8 px are taken to be.
    pub grid: Grid,
    /// The stroke map, where one was given or lies beside the map.
    pub stroke_map: Option<StrokeMap>,
    /// The preset, where the files hold it.
    pub preset_toml: Option<String>,
    /// The version of the generator, where the files are ours.
    pub version: Option<String>,
    /// Whether the columns' tones were given, by the caller or the files; else they are the means of the columns.
    pub tones_given: bool,
    /// What was decided without being said, in whole sentences.
    pub notes: Vec<String>,
}

/// What to know about other people's files.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct ImportOptions {
    /// Names of the files in the folder, with `{tone}` and `{level}` where the numbers are (from 0 or 1, with or without
    /// leading zeros), and a folder before the name if need be; without `{level}` where every file has all levels.
    pub pattern: Option<String>,
    /// The tones of the columns, lightest first, `0.0 < tone <= 1.0`, rising.
    pub tones: Option<Vec<f64>>,
    /// Whether large numbers are light or dark.
    pub polarity: Polarity,
    /// How the levels of pictures are numbered.
    pub level_order: LevelOrder,
    /// A file that holds the stroke map.
    pub stroke_map: Option<PathBuf>,
}

/// Whether large numbers are light or dark.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Hash)]
pub enum Polarity {
    /// As the trend from column to column says, the lightest taken to be first; our own files are luminance.
    #[default]
    Auto,
    /// 255 is paper.
    Luminance,
    /// 255 is ink.
    Ink,
}

/// How the levels of pictures are numbered.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Hash)]
pub enum LevelOrder {
    /// By their sizes, whatever their numbers.
    #[default]
    Auto,
    /// The lowest number is the finest, as in GPU interfaces.
    FinestFirst,
    /// The lowest number is the coarsest, as in Praun and others (2001).
    CoarsestFirst,
}

/// Reads a map from a KTX2 or DDS file, or from a folder or pattern of files.
///
/// A folder without [`ImportOptions::pattern`] is searched for [`DEFAULT_PATTERN`], then its subfolder `cells`. Names
/// of our own exports stand for all files of their set (`NAME.tone0.dds`, `NAME.packed0.ktx2`), and what `NAME.json`
/// and `NAME.strokemap.ktx2` beside them say is taken over.
///
/// # Errors
///
/// See [`ImportError`]. No content of any file makes it panic.
pub fn read(source: &Path, options: &ImportOptions) -> Result<Imported, ImportError> {
    let source = Source::new(source, options)?;
    let collected = match &source.kind {
        Kind::File => collect::from_file(&source.path)?,
        Kind::Pattern(pattern) => collect::from_pattern(&source.dir, pattern, options.level_order)?,
        Kind::Packed => {
            let first = collect::texture(&source.path)?;
            let columns = facts::tones(&first.key_values).map_or(3, |tones| tones.len().max(1));
            collect::from_packed(&source.dir, source.stem.as_deref().unwrap_or_default(), columns)?
        }
    };
    let manifest = facts::manifest_beside(&source.dir, source.stem.as_deref());
    let facts = facts::facts(&collected, manifest.as_ref());
    let ours = facts.version.is_some();
    let mut imported = assemble::assemble(collected, facts, options)?;

    let beside = source.stem.as_ref().map(|stem| source.dir.join(format!("{stem}.strokemap.ktx2")));
    let stroke_map = options.stroke_map.clone().or_else(|| beside.filter(|path| ours && path.is_file()));
    if let Some(path) = stroke_map {
        imported.stroke_map = Some(read_stroke_map(&path)?);
    }
    Ok(imported)
}

/// Reads a stroke map: a texture of one layer whose numbers are thresholds as they are.
///
/// # Errors
///
/// See [`ImportError`].
pub fn read_stroke_map(path: &Path) -> Result<StrokeMap, ImportError> {
    let texture = collect::texture(path)?;
    assemble::check_sizes(&texture.levels.iter().map(|level| (level.width, level.height)).collect::<Vec<_>>())?;
    if texture.levels.iter().any(|level| level.layers.len() != 1) {
        let source = DecodeError::Unsupported("a stroke map has one layer, and it has more".into());
        return Err(ImportError::Decode { path: path.into(), source });
    }
    let levels = texture
        .levels
        .iter()
        .map(|level| ThresholdLevel { size: level.width, threshold: level.plane(0, texture.channels, None) });
    Ok(StrokeMap { levels: levels.collect(), distribution: facts::distribution(&texture.key_values) })
}

/// Where the cells are.
struct Source {
    /// What was given.
    path: PathBuf,
    /// The folder of the files.
    dir: PathBuf,
    /// The name that our own files begin with; unknown for a folder.
    stem: Option<String>,
    kind: Kind,
}

enum Kind {
    File,
    Packed,
    Pattern(Pattern),
}

impl Source {
    fn new(path: &Path, options: &ImportOptions) -> Result<Self, ImportError> {
        let new = |dir: PathBuf, stem, kind| Self { path: path.into(), dir, stem, kind };
        if let Some(pattern) = &options.pattern {
            let (folder, name) = pattern.rsplit_once('/').unwrap_or(("", pattern));
            return Ok(new(path.join(folder), own_stem(name), Kind::Pattern(Pattern::parse(name)?)));
        }
        let dir = path.parent().map(Path::to_path_buf).unwrap_or_default();
        let dir = if dir.as_os_str().is_empty() { PathBuf::from(".") } else { dir };
        let name = path.file_name().map(|name| name.to_string_lossy().into_owned()).unwrap_or_default();
        if path.is_dir() {
            let pattern = Pattern::parse(DEFAULT_PATTERN)?;
            let cells = path.join("cells");
            let matches = |dir: &Path| Ok(collect::names_in(dir)?.iter().any(|name| pattern.numbers(name).is_some()));
            let dir = if !matches(path)? && cells.is_dir() && matches(&cells)? { cells } else { path.into() };
            return Ok(new(dir, None, Kind::Pattern(pattern)));
        }
        if name.contains("{tone}") && !path.exists() {
            return Ok(new(dir, own_stem(&name), Kind::Pattern(Pattern::parse(&name)?)));
        }
        let stem = own_stem(&name);
        let kind = match &stem {
            Some(stem) if name.starts_with(&format!("{stem}.packed")) => Kind::Packed,
            Some(stem) if name.starts_with(&format!("{stem}.tone")) && !stem.contains(['{', '}']) => {
                Kind::Pattern(Pattern::parse(&format!("{stem}.tone{{tone}}.dds"))?)
            }
            _ => Kind::File,
        };
        Ok(new(dir, stem, kind))
    }
}

/// The name that one of our own files begins with.
fn own_stem(file_name: &str) -> Option<String> {
    let numbered = |text: &str, word: &str| {
        let (stem, number) = text.rsplit_once('.')?;
        let number = number.strip_prefix(word)?;
        let is_number = number == "{tone}" || (!number.is_empty() && number.chars().all(|c| c.is_ascii_digit()));
        is_number.then(|| stem.to_owned())
    };
    if let Some(rest) = file_name.strip_suffix(".dds") {
        return Some(numbered(rest, "tone").unwrap_or_else(|| rest.into()));
    }
    let rest = file_name.strip_suffix(".ktx2")?;
    Some(numbered(rest, "packed").unwrap_or_else(|| rest.strip_suffix(".bc4").unwrap_or(rest).into()))
}
