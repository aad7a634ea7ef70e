//! The JSON schema of a kind of file, printed or written.

use std::path::PathBuf;

use serde_json::json;

use super::words::path_text;
use super::{Failure, Output, files, print_bytes};

/// Where a schema goes.
#[derive(Debug, clap::Args)]
pub struct SchemaArgs {
    /// File to write [default: standard output]
    #[arg(short, long = "output", value_name = "FILE")]
    out: Option<PathBuf>,
    /// Replace a file that is there already
    #[arg(long)]
    force: bool,
}

/// Prints or writes a schema.
///
/// # Errors
/// It cannot be written, or is there already.
pub fn schema(text: &str, args: &SchemaArgs, output: &Output) -> Result<(), Failure> {
    match &args.out {
        // The schema is itself the one object of a run with --json.
        None => print_bytes(text.as_bytes()),
        Some(path) => {
            files::write(path, text.as_bytes(), args.force)?;
            output.say(&format!("{}\n", path.display()))?;
            output.object(&json!({ "path": path_text(path) }))
        }
    }
}
