//! `tam-gen schema`.

use std::path::PathBuf;

use serde_json::json;
use tam_gen::command::{Failure, Output, files, print_bytes, words::path_text};
use tam_gen::preset;

use super::Outcome;

const EXAMPLES: &str = "\
Examples:
  tam-gen schema -o preset.schema.json     beside your presets, whose first line then says
                                           #:schema ./preset.schema.json
Editors with TOML support (Even Better TOML, taplo) complete and check presets by it.";

#[derive(Debug, clap::Args)]
#[command(after_help = EXAMPLES)]
pub(super) struct SchemaArgs {
    /// File to write [default: standard output]
    #[arg(short, long = "output", value_name = "FILE")]
    out: Option<PathBuf>,
    /// Replace a file that is there already
    #[arg(long)]
    force: bool,
}

pub(super) fn run(args: &SchemaArgs, output: &Output) -> Result<Outcome, Failure> {
    let text = preset::schema_text();
    match &args.out {
        // The schema is itself the one object of a run with --json.
        None => print_bytes(text.as_bytes())?,
        Some(path) => {
            files::write(path, text.as_bytes(), args.force)?;
            output.say(&format!("{}\n", path.display()))?;
            output.object(&json!({ "path": path_text(path) }))?;
        }
    }
    Ok(Outcome::Holds)
}
