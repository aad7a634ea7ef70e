//! Why nothing was imported.

use std::io;
use std::path::PathBuf;

/// Why a file's bytes hold no texture that can be read.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
pub enum DecodeError {
    /// It is another kind of file, or damaged at its beginning.
    #[error("it is no {0} file, or its beginning is damaged")]
    Kind(&'static str),
    /// It ends before its content does.
    #[error("{what} should end at byte {needed}, but the file has {given} bytes; it may be cut off")]
    Truncated {
        /// What is incomplete.
        what: String,
        /// Bytes needed.
        needed: u64,
        /// Bytes there are.
        given: u64,
    },
    /// It is sound, and of a kind that is not read.
    #[error("{0}")]
    Unsupported(String),
    /// It claims to be larger than anything that is read.
    #[error("{what} is {given}; at most {limit} is read")]
    TooLarge {
        /// What is too large.
        what: &'static str,
        /// How large it is.
        given: u64,
        /// The most that is read.
        limit: u64,
    },
    /// It contradicts itself.
    #[error("it is damaged: {0}")]
    Damaged(String),
}

/// Why an import failed.
#[derive(Debug, thiserror::Error)]
pub enum ImportError {
    /// A file or folder cannot be read.
    #[error("cannot read {}: {source}", path.display())]
    Read {
        /// The file or folder.
        path: PathBuf,
        /// What the system says.
        source: io::Error,
    },
    /// A file holds no texture that can be read.
    #[error("cannot read {}: {source}", path.display())]
    Decode {
        /// The file.
        path: PathBuf,
        /// What is wrong with it.
        source: DecodeError,
    },
    /// A pattern of file names makes no sense.
    #[error("the pattern `{pattern}` {problem}; an example is `tone{{tone}}_level{{level}}.png`")]
    Pattern {
        /// The pattern.
        pattern: String,
        /// What is wrong with it.
        problem: &'static str,
    },
    /// No file has a name of the pattern.
    #[error("no file in {} is named like `{pattern}`; there {found}; say how the files are named with --pattern", dir.display())]
    NothingMatches {
        /// The folder.
        dir: PathBuf,
        /// The pattern.
        pattern: String,
        /// What is there instead.
        found: String,
    },
    /// Cells are missing.
    #[error("{} missing in {}: {}", counted(*count, "file is", "files are"), dir.display(), names.join(", "))]
    Missing {
        /// The folder.
        dir: PathBuf,
        /// How many.
        count: usize,
        /// Their names, or the first of them.
        names: Vec<String>,
    },
    /// Two files are the same cell.
    #[error("{} and {} are the same tone and level", first.display(), second.display())]
    Twice {
        /// One of them.
        first: PathBuf,
        /// The other.
        second: PathBuf,
    },
    /// Sizes do not make a map.
    #[error("{0}; levels of a map are square, powers of two, and each half as large as the one before")]
    Size(String),
    /// Nothing tells whether large numbers are light or dark.
    #[error(
        "cannot tell ink from paper: {0}; say --polarity luminance where paper is white, --polarity ink where ink is"
    )]
    Polarity(String),
    /// The tones given do not fit.
    #[error("{0}")]
    Tones(String),
}

fn counted(count: usize, one: &str, many: &str) -> String {
    format!("{count} {}", if count == 1 { one } else { many })
}
