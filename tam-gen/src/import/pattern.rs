//! Patterns of file names: `tone{tone}_level{level}.png`.

use super::error::ImportError;

/// A pattern with its numbers: the tone, and the level unless every file holds all levels.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) struct Pattern {
    text: String,
    parts: Vec<Part>,
}

#[derive(Debug, Clone, PartialEq, Eq)]
enum Part {
    Literal(String),
    Tone,
    Level,
}

impl Pattern {
    /// Reads a pattern for names in one folder.
    pub(super) fn parse(text: &str) -> Result<Self, ImportError> {
        let wrong = |problem| Err(ImportError::Pattern { pattern: text.into(), problem });
        let mut parts = Vec::new();
        let mut rest = text;
        while let Some(open) = rest.find('{') {
            if open > 0 {
                parts.push(Part::Literal(rest[..open].into()));
            } else if !parts.is_empty() {
                return wrong("has nothing between its numbers");
            }
            let Some(length) = rest[open..].find('}') else { return wrong("has a `{` without a `}`") };
            parts.push(match &rest[open + 1..open + length] {
                "tone" => Part::Tone,
                "level" => Part::Level,
                _ => return wrong("may hold `{tone}` and `{level}` only"),
            });
            rest = &rest[open + length + 1..];
        }
        if !rest.is_empty() {
            parts.push(Part::Literal(rest.into()));
        }
        let count = |part| parts.iter().filter(|&other| *other == part).count();
        if count(Part::Tone) != 1 {
            return wrong("must hold `{tone}` once");
        }
        if count(Part::Level) > 1 {
            return wrong("may hold `{level}` once");
        }
        Ok(Self { text: text.into(), parts })
    }

    /// The tone and the level in a file name; `None` where the name is not of the pattern. Numbers may have leading
    /// zeros. The level is 0 for a pattern without one.
    pub(super) fn numbers(&self, name: &str) -> Option<(u32, u32)> {
        let (mut tone, mut level) = (None, 0);
        let mut rest = name;
        for part in &self.parts {
            if let Part::Literal(literal) = part {
                rest = rest.strip_prefix(literal.as_str())?;
                continue;
            }
            let digits = rest.find(|c: char| !c.is_ascii_digit()).unwrap_or(rest.len());
            // Six digits are more than any map has, and keep numbers from overflowing.
            let number = rest.get(..digits).filter(|digits| digits.len() <= 6)?.parse().ok()?;
            if *part == Part::Tone {
                tone = Some(number);
            } else {
                level = number;
            }
            rest = &rest[digits..];
        }
        if rest.is_empty() { Some((tone?, level)) } else { None }
    }

    /// The name of a cell.
    pub(super) fn name(&self, tone: u32, level: u32) -> String {
        self.parts
            .iter()
            .map(|part| match part {
                Part::Literal(literal) => literal.clone(),
                Part::Tone => tone.to_string(),
                Part::Level => level.to_string(),
            })
            .collect()
    }

    /// The pattern as it was given.
    pub(super) fn text(&self) -> &str {
        &self.text
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_found_with_any_padding() {
        let pattern = Pattern::parse("tone{tone}_level{level}.png").expect("sound");
        assert_eq!(pattern.numbers("tone007_level2.png"), Some((7, 2)));
        for other in
            ["tone_level2.png", "tone7_level2.png.bak", "xtone7_level2.png", "tone9999999_level0.png", "", "töne1"]
        {
            assert_eq!(pattern.numbers(other), None, "{other}");
        }
        assert_eq!(Pattern::parse("{level}-{tone}").expect("sound").numbers("1-12"), Some((12, 1)));
    }

    #[test]
    fn patterns_without_sense_say_what_is_wrong() {
        for (text, problem) in [
            ("level{level}.png", "must hold `{tone}`"),
            ("{tone}{level}.png", "nothing between"),
            ("{tone}_{tone}.png", "must hold `{tone}` once"),
            ("{tone}_{level}_{level}.png", "`{level}` once"),
            ("{tone}_{x}.png", "`{tone}` and `{level}` only"),
            ("{tone}_{level.png", "without a `}`"),
        ] {
            let error = Pattern::parse(text).expect_err("senseless").to_string();
            assert!(error.contains(problem), "{text}: {error}");
        }
    }
}
