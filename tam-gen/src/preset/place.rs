//! Places in a preset, and what can be wrong there.

use std::fmt;

/// A place in a preset: `map.size`, `families.h.width_px`, `schedule[2]`.
#[derive(Debug, Clone, PartialEq, Eq, Default, Hash)]
pub struct Place(Vec<Step>);

/// One step down into a preset.
#[derive(Debug, Clone, PartialEq, Eq, Hash)]
pub enum Step {
    /// To the value of a key.
    Key(String),
    /// To an item of a list, from 0.
    Item(usize),
}

impl Place {
    /// The preset itself.
    pub const ROOT: Place = Place(Vec::new());

    /// The place of a chain of keys.
    pub fn of(keys: &[&str]) -> Self {
        Self(keys.iter().map(|key| Step::Key((*key).to_owned())).collect())
    }

    /// The place of a key in the table here.
    #[must_use]
    pub fn key(&self, key: &str) -> Self {
        self.then(Step::Key(key.to_owned()))
    }

    /// The place of an item in the list here.
    #[must_use]
    pub fn item(&self, index: usize) -> Self {
        self.then(Step::Item(index))
    }

    /// The steps from the preset down to this place.
    pub fn steps(&self) -> &[Step] {
        &self.0
    }

    /// Whether this place is the other one or lies in it.
    pub fn within(&self, other: &Place) -> bool {
        self.0.starts_with(&other.0)
    }

    fn then(&self, step: Step) -> Self {
        let mut steps = self.0.clone();
        steps.push(step);
        Self(steps)
    }
}

impl fmt::Display for Place {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if self.0.is_empty() {
            return f.write_str("the preset");
        }
        for (depth, step) in self.0.iter().enumerate() {
            match step {
                Step::Key(key) if is_bare(key) => write!(f, "{}{key}", if depth > 0 { "." } else { "" })?,
                Step::Key(key) => write!(f, "{}{key:?}", if depth > 0 { "." } else { "" })?,
                Step::Item(index) => write!(f, "[{index}]")?,
            }
        }
        Ok(())
    }
}

/// Whether a word needs no quotes as a key: letters, digits, `_` and `-`.
pub(super) fn is_bare(word: &str) -> bool {
    !word.is_empty() && word.bytes().all(|byte| byte.is_ascii_alphanumeric() || matches!(byte, b'_' | b'-'))
}

/// One thing wrong with a preset.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Violation {
    /// Where.
    pub at: Place,
    /// What is wrong, as a sentence without its full stop.
    pub problem: String,
    /// What is allowed there, with its unit.
    pub expected: String,
    /// The way out, where there is more to say.
    pub help: Option<String>,
    /// Other places that take part, and what each of them says.
    pub related: Vec<(Place, String)>,
}

impl Violation {
    /// Something wrong at a place, and what is allowed there.
    pub(super) fn new(at: Place, problem: impl Into<String>, expected: impl Into<String>) -> Self {
        Self { at, problem: problem.into(), expected: expected.into(), help: None, related: Vec::new() }
    }

    /// Adds the way out.
    #[must_use]
    pub(super) fn help(mut self, help: impl Into<String>) -> Self {
        self.help = Some(help.into());
        self
    }

    /// Adds another place that takes part.
    #[must_use]
    pub(super) fn related(mut self, at: Place, says: impl Into<String>) -> Self {
        self.related.push((at, says.into()));
        self
    }
}

/// The known word nearest to an unknown one, if it is near enough to be meant.
pub fn nearest<'a>(word: &str, known: impl IntoIterator<Item = &'a str>) -> Option<&'a str> {
    // Words are compared in full; a megabyte of one would take an hour and is near to none.
    if word.len() > 64 {
        return None;
    }
    let word = word.to_lowercase();
    known
        .into_iter()
        .map(|candidate| (strsim::damerau_levenshtein(&word, candidate), candidate))
        .filter(|(distance, candidate)| {
            *distance <= (candidate.len() / 3).max(1) || (word.len() > 2 && candidate.starts_with(&word))
        })
        .min_by_key(|(distance, _)| *distance)
        .map(|(_, candidate)| candidate)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn places_read_as_dotted_keys() {
        assert_eq!(Place::of(&["families", "h"]).key("width_px").to_string(), "families.h.width_px");
        assert_eq!(Place::of(&["schedule"]).item(2).to_string(), "schedule[2]");
        assert_eq!(Place::of(&["families", "two words"]).to_string(), "families.\"two words\"");
        assert_eq!(Place::ROOT.to_string(), "the preset");
    }

    #[test]
    fn the_nearest_word_is_found_and_a_far_one_is_not() {
        let known = ["pencil", "stipple", "width_px"];
        assert_eq!(nearest("pensil", known), Some("pencil"));
        assert_eq!(nearest("WIDTH", known), Some("width_px"));
        assert_eq!(nearest("zebra", known), None);
        assert_eq!(nearest(&"p".repeat(1 << 20), known), None);
    }
}
