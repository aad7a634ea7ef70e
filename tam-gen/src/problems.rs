//! What is wrong with a file that a user wrote, as a reader needs it: place, cause, way out.

use std::fmt;
use std::ops::Range;

use annotate_snippets::renderer::DecorStyle;
use annotate_snippets::{AnnotationKind, Element, Group, Level, Origin, Renderer, Snippet};
use serde::Serialize;

/// Why a file was refused: everything found wrong with it, at once.
#[derive(Debug, Clone, PartialEq)]
pub struct FileError {
    /// Where it came from: a path, or what its reader called it.
    pub origin: String,
    /// All that is wrong, in the order of the file.
    pub problems: Vec<Problem>,
    source_text: String,
}

/// One thing wrong, with its place in the file.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Problem {
    /// Dotted key, or the option of the command line; empty where the file as a whole is meant.
    pub at: String,
    /// Line in the file, from 1; absent where the problem has no place in it.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub line: Option<usize>,
    /// Column in characters, from 1.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub column: Option<usize>,
    /// What is wrong.
    pub message: String,
    /// What is allowed there.
    #[serde(skip_serializing_if = "String::is_empty")]
    pub expected: String,
    /// The way out, where there is more to say.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub help: Option<String>,
    #[serde(skip)]
    span: Option<Range<usize>>,
    #[serde(skip)]
    related: Vec<(Range<usize>, String)>,
}

impl Problem {
    /// A problem without a place in the file.
    pub fn general(at: impl Into<String>, message: impl Into<String>) -> Self {
        Self {
            at: at.into(),
            line: None,
            column: None,
            message: message.into(),
            expected: String::new(),
            help: None,
            span: None,
            related: Vec::new(),
        }
    }

    /// Puts it at bytes of the source, cut to whole characters.
    #[must_use]
    pub fn at_span(mut self, source: &str, span: Range<usize>) -> Self {
        let span = whole_characters(source, span);
        let before = &source[..span.start];
        let line_start = before.rfind('\n').map_or(0, |newline| newline + 1);
        self.line = Some(before.bytes().filter(|byte| *byte == b'\n').count() + 1);
        self.column = Some(before[line_start..].chars().count() + 1);
        self.span = Some(span);
        self
    }

    /// Says what is allowed.
    #[must_use]
    pub fn expected(mut self, expected: impl Into<String>) -> Self {
        self.expected = expected.into();
        self
    }

    /// Says the way out.
    #[must_use]
    pub fn help(mut self, help: impl Into<Option<String>>) -> Self {
        self.help = help.into();
        self
    }

    /// Adds another place of the source that takes part.
    #[must_use]
    pub(crate) fn also(mut self, source: &str, span: Range<usize>, says: String) -> Self {
        self.related.push((whole_characters(source, span), says));
        self
    }
}

/// Problems looked for in one file: a file with more of them is something else, and placing each takes a look at all of it.
pub const PROBLEMS_MAX: usize = 100;

/// Problems printed in full; a reader who has mended these runs the tool again.
const SHOWN: usize = 12;

impl FileError {
    /// Refuses a text of an origin for what is wrong with it.
    pub fn new(origin: &str, source: &str, mut problems: Vec<Problem>) -> Self {
        problems.sort_by_key(|problem| problem.span.as_ref().map(|span| span.start));
        Self { origin: origin.to_owned(), source_text: source.to_owned(), problems }
    }

    /// The report as text, with the lines concerned; in colours of the terminal if wanted.
    pub fn report(&self, coloured: bool) -> String {
        let renderer = if coloured { Renderer::styled().decor_style(DecorStyle::Unicode) } else { Renderer::plain() };
        let mut parts: Vec<String> =
            self.problems.iter().take(SHOWN).map(|problem| renderer.render(&[self.group(problem)])).collect();
        if let Some(rest) = self.problems.len().checked_sub(SHOWN).filter(|rest| *rest > 0) {
            let plural = if rest == 1 { "" } else { "s" };
            parts.push(format!("… and {rest} more problem{plural} in {}", self.origin));
        }
        parts.join("\n\n")
    }

    fn group<'a>(&'a self, problem: &'a Problem) -> Group<'a> {
        let place: Element<'a> = match &problem.span {
            Some(span) => {
                let mut mark = AnnotationKind::Primary.span(span.clone());
                if !problem.expected.is_empty() {
                    mark = mark.label(problem.expected.as_str());
                }
                let related = problem
                    .related
                    .iter()
                    .map(|(span, says)| AnnotationKind::Context.span(span.clone()).label(says.as_str()));
                Snippet::source(self.source_text.as_str())
                    .path(self.origin.as_str())
                    .annotation(mark)
                    .annotations(related)
                    .into()
            }
            None => Origin::path(self.origin.as_str()).into(),
        };
        // Without a line to point at, what is allowed belongs to the sentence.
        let title = match &problem.span {
            None if !problem.expected.is_empty() => format!("{}: {}", problem.message, problem.expected),
            _ => problem.message.clone(),
        };
        let group = Level::ERROR.primary_title(title);
        let help = problem.help.iter().map(|help| Level::HELP.message(help.as_str()));
        if problem.span.is_none() && self.origin.is_empty() {
            Group::with_title(group).elements(help)
        } else {
            group.element(place).elements(help)
        }
    }
}

impl fmt::Display for FileError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.report(false))
    }
}

impl std::error::Error for FileError {}

/// What the reading of TOML found wrong, at its place.
pub fn syntax_problem(source: &str, error: &toml::de::Error) -> Problem {
    let problem = Problem::general("", error.message().replace('\n', ", "));
    match error.span() {
        Some(span) => problem.at_span(source, span),
        None => problem,
    }
}

fn whole_characters(source: &str, span: Range<usize>) -> Range<usize> {
    let start = source.floor_char_boundary(span.start.min(source.len()));
    let end = source.ceil_char_boundary(span.end.clamp(start, source.len()));
    // Marks that run over lines hide what they point at: keep to the first.
    let line_end = source[start..end].find('\n').map_or(end, |newline| start + newline);
    start..line_end.max(start)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn spans_are_cut_to_characters_and_to_one_line() {
        let source = "a = \"ä\"\nb = 1";
        assert_eq!(whole_characters(source, 6..7), 5..7);
        assert_eq!(whole_characters(source, 0..100), 0..8);
        assert_eq!(whole_characters(source, 50..60), source.len()..source.len());
    }

    #[test]
    fn the_place_is_counted_in_lines_and_characters() {
        let problem = Problem::general("b", "wrong").at_span("a = \"ä\"\nä.b = 1", 12..13);
        assert_eq!((problem.line, problem.column), (Some(2), Some(3)));
    }
}
