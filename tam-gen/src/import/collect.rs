//! Gathering the cells of a map from files, whatever holds them.

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::{Path, PathBuf};

use super::error::{DecodeError, ImportError};
use super::pattern::Pattern;
use super::texture::{Texture, TextureLevel};
use super::{LevelOrder, dds, image, ktx2};

/// The cells of a map as files held them.
#[derive(Debug, Default)]
pub(super) struct Collected {
    /// Levels, finest first.
    pub(super) levels: Vec<CollectedLevel>,
    /// Metadata of the first file.
    pub(super) key_values: BTreeMap<String, String>,
    /// What the user should know.
    pub(super) notes: Vec<String>,
}

/// One level: its size, and for each column in the order of the files the texels by rows.
#[derive(Debug)]
pub(super) struct CollectedLevel {
    pub(super) width: u32,
    pub(super) height: u32,
    pub(super) cells: Vec<Vec<u8>>,
}

/// Reads a file of any kind; the kind is told by its first bytes.
pub(super) fn texture(path: &Path) -> Result<Texture, ImportError> {
    let bytes = fs::read(path).map_err(|source| ImportError::Read { path: path.into(), source })?;
    let decode = if bytes.starts_with(b"\xABKTX 20\xBB") {
        ktx2::decode
    } else if bytes.starts_with(b"DDS ") {
        dds::decode
    } else {
        image::decode
    };
    decode(&bytes).map_err(|source| ImportError::Decode { path: path.into(), source })
}

/// The cells of one file: layers are columns.
pub(super) fn from_file(path: &Path) -> Result<Collected, ImportError> {
    let texture = texture(path)?;
    if texture.key_values.contains_key("tam.distribution") {
        let source = DecodeError::Unsupported("it is a stroke map; give the map that it belongs to".into());
        return Err(ImportError::Decode { path: path.into(), source });
    }
    let mut collected = Collected { key_values: texture.key_values.clone(), ..Collected::default() };
    note_srgb(&mut collected, &texture);
    for level in &texture.levels {
        let cells = (0..level.layers.len()).map(|layer| level.plane(layer, texture.channels, None)).collect();
        collected.levels.push(CollectedLevel { width: level.width, height: level.height, cells });
    }
    Ok(collected)
}

/// The cells of a set of our packed textures, `STEM.packed0.ktx2` and those after it: three columns in each.
pub(super) fn from_packed(dir: &Path, stem: &str, columns: usize) -> Result<Collected, ImportError> {
    let mut collected = Collected::default();
    for (index, first) in (0..columns).step_by(3).enumerate() {
        let path = dir.join(format!("{stem}.packed{index}.ktx2"));
        let texture = texture(&path)?;
        if texture.channels != 3 || texture.levels.iter().any(|level| level.layers.len() != 1) {
            let source = DecodeError::Unsupported("it does not hold three tones in R, G and B".into());
            return Err(ImportError::Decode { path, source });
        }
        for channel in 0..3.min(columns - first) {
            add_column(&mut collected, &texture.levels, |level| level.plane(0, 3, Some(channel)), &path)?;
        }
        if index == 0 {
            collected.key_values = texture.key_values;
        }
    }
    Ok(collected)
}

/// The cells of files named like a pattern, each one cell, or one column with all levels.
pub(super) fn from_pattern(dir: &Path, pattern: &Pattern, order: LevelOrder) -> Result<Collected, ImportError> {
    let mut found: BTreeMap<(u32, u32), PathBuf> = BTreeMap::new();
    for name in names_in(dir)? {
        let Some(numbers) = pattern.numbers(&name) else { continue };
        if let Some(first) = found.insert(numbers, dir.join(&name)) {
            return Err(ImportError::Twice { first, second: dir.join(&name) });
        }
    }
    let (tones, levels): (BTreeSet<u32>, BTreeSet<u32>) = found.keys().copied().unzip();
    let (Some(&last_tone), Some(&last_level)) = (tones.last(), levels.last()) else {
        return Err(ImportError::NothingMatches {
            dir: dir.into(),
            pattern: pattern.text().into(),
            found: listing(dir)?,
        });
    };
    let first_of = |numbers: &BTreeSet<u32>| u32::from(!numbers.contains(&0));
    // Only the names of a few missing files are made, however far the numbers lie apart.
    let wanted = (first_of(&tones)..=last_tone)
        .flat_map(|tone| (first_of(&levels)..=last_level).map(move |level| (tone, level)));
    let count =
        (last_tone + 1 - first_of(&tones)) as usize * (last_level + 1 - first_of(&levels)) as usize - found.len();
    if count > 0 {
        let mut names: Vec<String> = wanted
            .filter(|numbers| !found.contains_key(numbers))
            .take(6)
            .map(|(tone, level)| pattern.name(tone, level))
            .collect();
        if count > names.len() {
            names.push("…".into());
        }
        return Err(ImportError::Missing { dir: dir.into(), count, names });
    }

    let mut collected = Collected::default();
    for tone in tones {
        let mut column = Vec::new();
        let mut path = PathBuf::new();
        for (_, file) in found.range((tone, 0)..=(tone, u32::MAX)) {
            let texture = texture(file)?;
            note_srgb(&mut collected, &texture);
            if texture.levels.iter().any(|level| level.layers.len() != 1) {
                let source =
                    DecodeError::Unsupported("it holds several tones; give it alone, without a pattern".into());
                return Err(ImportError::Decode { path: file.clone(), source });
            }
            column.extend(
                texture
                    .levels
                    .into_iter()
                    .map(|level| TextureLevel { layers: vec![level.plane(0, texture.channels, None)], ..level }),
            );
            path.clone_from(file);
        }
        match order {
            LevelOrder::FinestFirst => {}
            LevelOrder::CoarsestFirst => column.reverse(),
            LevelOrder::Auto => column.sort_by_key(|level| std::cmp::Reverse(level.width)),
        }
        add_column(&mut collected, &column, |level| level.layers[0].clone(), &path)?;
    }
    Ok(collected)
}

/// The names of the files in a folder, sorted.
pub(super) fn names_in(dir: &Path) -> Result<Vec<String>, ImportError> {
    let read = || {
        let mut names = Vec::new();
        for entry in fs::read_dir(dir)? {
            let entry = entry?;
            if !entry.path().is_dir() {
                names.push(entry.file_name().to_string_lossy().into_owned());
            }
        }
        names.sort();
        Ok(names)
    };
    read().map_err(|source| ImportError::Read { path: dir.into(), source })
}

fn listing(dir: &Path) -> Result<String, ImportError> {
    const SHOWN: usize = 8;
    let names = names_in(dir)?;
    Ok(match names.len() {
        0 => "are no files".into(),
        count if count <= SHOWN => format!("are {}", names.join(", ")),
        count => format!("are {count} files, {}, …", names[..SHOWN].join(", ")),
    })
}

fn add_column(
    collected: &mut Collected,
    column: &[TextureLevel],
    cell: impl Fn(&TextureLevel) -> Vec<u8>,
    path: &Path,
) -> Result<(), ImportError> {
    if collected.levels.is_empty() {
        collected.levels.extend(column.iter().map(|&TextureLevel { width, height, .. }| CollectedLevel {
            width,
            height,
            cells: Vec::new(),
        }));
    }
    let sizes = |levels: &mut dyn Iterator<Item = (u32, u32)>| {
        levels.map(|(width, height)| format!("{width} x {height}")).collect::<Vec<_>>().join(", ")
    };
    let wanted = sizes(&mut collected.levels.iter().map(|level| (level.width, level.height)));
    let given = sizes(&mut column.iter().map(|level| (level.width, level.height)));
    if wanted != given {
        let place = path.display();
        return Err(ImportError::Size(format!(
            "the tone of {place} has levels of {given} px, the first tone {wanted} px"
        )));
    }
    for (level, from) in collected.levels.iter_mut().zip(column) {
        level.cells.push(cell(from));
    }
    Ok(())
}

fn note_srgb(collected: &mut Collected, texture: &Texture) {
    let note = "the file says that its texels are sRGB; they were converted to linear light";
    if texture.was_srgb && !collected.notes.iter().any(|other| other == note) {
        collected.notes.push(note.into());
    }
}
