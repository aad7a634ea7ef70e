//! Presets from TOML, and to TOML.

use std::ops::Range;
use std::path::Path;

use serde::Deserialize;
use toml::Spanned;
use toml::de::{DeTable, DeValue, Deserializer};

use super::place::{Place, Step, Violation};
use super::{FamilyOptions, Preset, SEED_MAX, TipOptions, structure, tip_source};
use crate::files::{TextError, read_text};
use crate::problems::{FileError, PROBLEMS_MAX, Problem, syntax_problem};

/// Largest preset file, in bytes. A tip's picture stays a file of its own, so presets are a few kilobytes.
pub const PRESET_BYTES_MAX: u64 = 1 << 20;

/// Largest preset text: one that carries a tip's picture in itself.
const TEXT_BYTES_MAX: usize = 16 << 20;

impl Preset {
    /// Reads a preset from TOML text; `origin` is what errors call the text.
    ///
    /// # Errors
    /// Everything that is wrong with it: syntax, unknown keys, types, and all that [`Preset::validate`] finds.
    pub fn from_toml(source: &str, origin: &str) -> Result<Self, FileError> {
        read(source, origin, None)
    }

    /// Reads a preset file and, into the preset itself, the tip pictures that it names relative to itself.
    ///
    /// # Errors
    /// As [`Preset::from_toml`], and if the file cannot be read or is larger than [`PRESET_BYTES_MAX`], which is found
    /// out before reading it.
    pub fn load(path: impl AsRef<Path>) -> Result<Self, FileError> {
        let path = path.as_ref();
        let origin = path.display().to_string();
        let source =
            read_text(path, PRESET_BYTES_MAX).map_err(|error| FileError::new(&origin, "", vec![unread(error)]))?;
        read(&source, &origin, Some(path.parent().unwrap_or(Path::new(""))))
    }

    /// The preset as TOML, every option written out; reading it back gives the same preset.
    pub fn to_toml(&self) -> String {
        // TOML's integers end before Rust's; a seed beyond them is no valid preset, but must not panic either.
        let within_toml = Self { seed: self.seed.min(SEED_MAX), ..self.clone() };
        toml::to_string(&within_toml).expect("texts, numbers and tables always have a TOML form")
    }

    fn tips_mut(&mut self) -> impl Iterator<Item = (Place, &mut TipOptions)> {
        let common = self.stroke.tip.as_mut().map(|tip| (Place::of(&["stroke", "tip"]), tip));
        let own = self.families.iter_mut().filter_map(|(name, FamilyOptions { tip, .. })| {
            tip.as_mut().map(|tip| (Place::of(&["families", name, "tip"]), tip))
        });
        common.into_iter().chain(own)
    }
}

fn unread(error: TextError) -> Problem {
    let (message, help) = match error {
        TextError::Folder => (
            "cannot read the preset: it is a folder".to_owned(),
            Some("give the preset file itself, or the name of a preset that comes with the tool"),
        ),
        TextError::TooLarge(bytes) => (
            format!("the preset is larger than {} KiB", bytes >> 10),
            Some("a preset is a few kilobytes of text: this is probably another file"),
        ),
        TextError::NotText(_) => (format!("the preset is not text: {error}"), Some("save it as UTF-8")),
        TextError::Io(_) => (format!("cannot read the preset: {error}"), None),
    };
    Problem::general("", message).help(help.map(str::to_owned))
}

/// Reads a preset; pictures of tips are looked for in `folder`, if there is one.
fn read(source: &str, origin: &str, folder: Option<&Path>) -> Result<Preset, FileError> {
    let refuse = |problems: Vec<Problem>| Err(FileError::new(origin, source, problems));
    if source.len() > TEXT_BYTES_MAX {
        return refuse(vec![Problem::general("", "the preset is too large to be one")]);
    }
    let (mut table, errors) = DeTable::parse_recoverable(source);
    if !errors.is_empty() {
        return refuse(errors.iter().take(PROBLEMS_MAX).map(|error| syntax_problem(source, error)).collect());
    }
    if table.get_ref().is_empty() {
        let empty = Problem::general("", "the preset is empty");
        return refuse(vec![empty.help("`tam-gen presets new` writes one to start from".to_owned())]);
    }

    let mut problems = Vec::new();
    let mut preset = match Preset::deserialize(Deserializer::from(table.clone())) {
        Ok(preset) => preset,
        Err(first) => {
            problems = structure::check(source, table.get_mut());
            match Preset::deserialize(Deserializer::from(table.clone())) {
                Ok(rest) if !problems.is_empty() => rest,
                // What the schema does not know of, the reading does.
                _ => {
                    if problems.is_empty() {
                        problems.push(syntax_problem(source, &first));
                    }
                    return refuse(problems);
                }
            }
        }
    };

    let mut violations = Vec::new();
    if let Some(folder) = folder {
        embed_pictures(&mut preset, folder, &mut violations);
    }
    let unread: Vec<Place> = violations.iter().map(|violation| violation.at.clone()).collect();
    let found = preset.validate();
    violations.extend(found.into_iter().filter(|violation| !unread.contains(&violation.at)));
    // Where keys were taken out, defaults stand in for them: only what is certainly in the file counts.
    let partial = !problems.is_empty();
    problems.extend(
        violations
            .iter()
            .filter(|violation| !partial || locate(table.get_ref(), &violation.at).1)
            .take(PROBLEMS_MAX)
            .map(|violation| located(source, table.get_ref(), violation)),
    );
    if problems.is_empty() { Ok(preset) } else { refuse(problems) }
}

fn embed_pictures(preset: &mut Preset, folder: &Path, violations: &mut Vec<Violation>) {
    for (place, tip) in preset.tips_mut() {
        let Some(image) = tip.image.as_mut().filter(|image| !image.starts_with("data:")) else { continue };
        match tip_source::embed(&folder.join(&*image)) {
            Ok(address) => *image = address,
            Err(problem) => violations.push(Violation::new(
                place.key("image"),
                problem,
                format!(
                    "a PNG or SVG file of up to {} MiB, its path relative to the preset",
                    tip_source::TIP_BYTES_MAX >> 20
                ),
            )),
        }
    }
}

/// A violation with its places looked up in the file.
fn located(source: &str, table: &DeTable<'_>, violation: &Violation) -> Problem {
    let mut problem = Problem::general(violation.at.to_string(), &violation.problem)
        .expected(&violation.expected)
        .help(violation.help.clone());
    if let (Some(span), _) = locate(table, &violation.at) {
        problem = problem.at_span(source, span);
    }
    for (place, says) in &violation.related {
        if let (Some(span), true) = locate(table, place) {
            problem = problem.also(source, span, says.clone());
        }
    }
    problem
}

/// The bytes of a place, or of the nearest table or list around it, and whether it was the place itself.
fn locate(table: &DeTable<'_>, place: &Place) -> (Option<Range<usize>>, bool) {
    let mut found = None;
    let mut value: Option<&Spanned<DeValue<'_>>> = None;
    for (depth, step) in place.steps().iter().enumerate() {
        let next = match step {
            Step::Key(key) => {
                let holder = if depth == 0 { Some(table) } else { value.and_then(|value| value.get_ref().as_table()) };
                holder.and_then(|table| table.get_key_value(key.as_str())).map(|(key, value)| {
                    // A table has no text of its own: its name stands for it.
                    let span = if value.get_ref().is_table() { key.span() } else { value.span() };
                    (span, value)
                })
            }
            Step::Item(index) => {
                value.and_then(|value| value.get_ref().as_array()?.get(*index)).map(|value| (value.span(), value))
            }
        };
        let Some((span, next)) = next else { return (found, false) };
        found = Some(span);
        value = Some(next);
    }
    (found, true)
}
