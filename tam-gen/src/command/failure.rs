//! Why a command could not do its work.

use std::path::Path;

use crate::GenerateError;
use crate::export::ExportError;
use crate::import::ImportError;
use crate::problems::FileError;
use clap::builder::styling::{AnsiColor, Effects, Style};
use serde_json::{Value, json};

/// Why a command could not do its work; nothing was written.
#[derive(Debug)]
pub enum Failure {
    /// A file that the user wrote, or an option in place of what it says, makes no sense.
    File {
        /// What it should be, in one word for machines.
        kind: &'static str,
        /// All that is wrong.
        error: FileError,
    },
    /// No map can be made from the preset.
    Generate {
        /// Place in the preset.
        at: String,
        /// What is wrong there.
        problem: String,
    },
    /// The map cannot be read.
    Source(ImportError),
    /// The arguments make no sense.
    Usage {
        /// What is wrong.
        message: String,
        /// The way out.
        help: Option<String>,
    },
    /// Something else that the work needs is not as it should be.
    Work {
        /// What it is about, in one word for machines.
        kind: &'static str,
        /// What is wrong.
        message: String,
        /// The way out.
        help: Option<String>,
    },
    /// There is nowhere to write.
    Output {
        /// What is wrong.
        message: String,
        /// The way out.
        help: Option<String>,
    },
    /// The user stopped it.
    Interrupted,
}

impl Failure {
    /// Arguments that make no sense, with the way out.
    pub fn usage(message: impl Into<String>, help: impl Into<String>) -> Self {
        Self::Usage { message: message.into(), help: Some(help.into()) }
    }

    /// A file that cannot be written.
    pub fn write(path: &Path, error: &std::io::Error) -> Self {
        Self::Output {
            message: format!("cannot write {}: {error}", path.display()),
            help: Some("check the space left and the permissions, or choose another place with -o".to_owned()),
        }
    }

    fn kind(&self) -> &'static str {
        match self {
            Self::File { kind, .. } => kind,
            Self::Generate { .. } => "preset",
            Self::Source(_) => "source",
            Self::Usage { .. } => "usage",
            Self::Work { kind, .. } => kind,
            Self::Output { .. } => "output",
            Self::Interrupted => "interrupted",
        }
    }

    fn message(&self) -> String {
        match self {
            Self::File { error, .. } => in_a_line(error),
            Self::Generate { at, problem } => format!("{at}: {problem}"),
            Self::Source(error) => error.to_string(),
            Self::Usage { message, .. } | Self::Work { message, .. } | Self::Output { message, .. } => message.clone(),
            Self::Interrupted => "interrupted; nothing was written".to_owned(),
        }
    }

    fn help(&self) -> Option<&str> {
        match self {
            Self::Usage { help, .. } | Self::Work { help, .. } | Self::Output { help, .. } => help.as_deref(),
            _ => None,
        }
    }

    /// For people: one report with place, cause and way out.
    pub fn report(&self, coloured: bool) -> String {
        if let Self::File { error, .. } = self {
            return error.report(coloured);
        }
        let paint = |word: &str, colour: AnsiColor| {
            let style = if coloured { colour.on_default().effects(Effects::BOLD) } else { Style::new() };
            format!("{style}{word}{style:#}")
        };
        let mut report = format!("{}: {}", paint("error", AnsiColor::Red), self.message());
        if let Some(help) = self.help() {
            report += &format!("\n{}: {help}", paint("help", AnsiColor::Cyan));
        }
        report
    }

    /// For machines.
    pub fn to_json(&self) -> Value {
        let mut error = json!({ "kind": self.kind(), "message": self.message() });
        if let Some(help) = self.help() {
            error["help"] = help.into();
        }
        match self {
            Self::File { error: found, .. } => {
                if !found.origin.is_empty() {
                    error["file"] = found.origin.as_str().into();
                }
                error["problems"] = json!(found.problems);
            }
            Self::Generate { at, .. } => error["at"] = at.as_str().into(),
            _ => {}
        }
        error
    }
}

/// The first problem, and how many more there are.
fn in_a_line(error: &FileError) -> String {
    let Some(first) = error.problems.first() else { return "the file is not valid".to_owned() };
    let mut line = first.message.clone();
    if !first.expected.is_empty() {
        line += &format!(": {}", first.expected);
    }
    match error.problems.len() - 1 {
        0 => line,
        1 => line + "; and 1 more problem",
        more => line + &format!("; and {more} more problems"),
    }
}

impl From<FileError> for Failure {
    /// Most files that a user writes are presets.
    fn from(error: FileError) -> Self {
        Self::File { kind: "preset", error }
    }
}

impl From<GenerateError> for Failure {
    fn from(error: GenerateError) -> Self {
        match error {
            GenerateError::Cancelled => Self::Interrupted,
            GenerateError::Preset { at, problem } => Self::Generate { at, problem },
        }
    }
}

impl From<ImportError> for Failure {
    fn from(error: ImportError) -> Self {
        Self::Source(error)
    }
}

impl From<ExportError> for Failure {
    fn from(error: ExportError) -> Self {
        let help = match &error {
            ExportError::Cancelled => return Self::Interrupted,
            ExportError::Exists(_) => Some("--force replaces them, -o and --name choose another place".to_owned()),
            ExportError::Name { .. } => Some("--name chooses another".to_owned()),
            _ => None,
        };
        Self::Output { message: error.to_string(), help }
    }
}
