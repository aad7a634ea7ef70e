//! What the user named: a preset that comes with the tool, a preset file, or a map.

use std::path::Path;

use crate::Preset;

use super::Failure;

/// The preset of a name or path, and the name that its files get.
///
/// # Errors
/// There is none of that name, or it cannot be read, or makes no sense.
pub fn preset(named: &Path) -> Result<(String, Preset), Failure> {
    let text = named.to_string_lossy();
    if let Some(preset) = Preset::named(&text) {
        return Ok((text.into_owned(), preset?));
    }
    if !is_preset_path(named) {
        return Err(unknown(&text));
    }
    let preset = Preset::load(named)?;
    Ok((stem(named)?, preset))
}

/// Whether a source is a preset: one that comes with the tool, or a TOML file.
pub fn is_preset(named: &Path) -> bool {
    let known = Preset::embedded().iter().any(|(name, _)| Path::new(name) == named);
    known || named.extension().is_some_and(|extension| extension.eq_ignore_ascii_case("toml"))
}

/// The name that a file's own products get.
///
/// # Errors
/// The path ends in no name.
pub fn stem(path: &Path) -> Result<String, Failure> {
    match path.file_stem().and_then(|stem| stem.to_str()) {
        Some(stem) => Ok(stem.to_owned()),
        None => Err(Failure::usage(
            format!("{} gives no name for the files to write", path.display()),
            "--name chooses one",
        )),
    }
}

fn is_preset_path(named: &Path) -> bool {
    is_preset(named) || named.components().count() != 1 || named.exists()
}

/// No preset has this name.
pub fn unknown(name: &str) -> Failure {
    let names = Preset::embedded().iter().map(|(name, _)| *name).collect::<Vec<_>>().join(", ");
    let meant = Preset::nearest_name(name).map_or(String::new(), |meant| format!("did you mean `{meant}`? "));
    Failure::usage(
        format!("no preset is called `{name}`"),
        format!("{meant}the presets are {names}; a preset of your own is given as a file, such as ./mine.toml"),
    )
}
