//! `tam-gen presets`.

use std::path::{Path, PathBuf};

use clap::Subcommand;
use serde_json::{Value, json};
use tam_gen::command::{Failure, Output, files, interrupt, source, words::path_text};
use tam_gen::export::sheet::{SheetOptions, gallery};
use tam_gen::{Job, Preset};

use super::Outcome;
use super::template::commented;

const EXAMPLES: &str = "\
Examples:
  tam-gen presets                               what comes with the tool
  tam-gen presets show pencil                   how it is made
  tam-gen presets sheet -o all.png              what they look like
  tam-gen presets new mine                      mine.toml, every option explained
  tam-gen presets new mine --from charcoal      starting from another one";

#[derive(Debug, clap::Args)]
#[command(after_help = EXAMPLES)]
pub(super) struct PresetsArgs {
    #[command(subcommand)]
    action: Option<Action>,
}

#[derive(Debug, Subcommand)]
enum Action {
    /// List the presets that come with the tool
    List,
    /// Print a preset
    Show {
        /// A preset that comes with the tool, or the path of a preset file
        #[arg(value_name = "NAME_OR_PATH")]
        preset: PathBuf,
    },
    /// Draw a strip of each preset, light to dark, on one picture
    Sheet {
        /// Picture to write
        #[arg(short, long = "output", value_name = "FILE.png", default_value = "presets.png")]
        out: PathBuf,
        /// Replace a picture that is there already
        #[arg(long)]
        force: bool,
    },
    /// Write a preset to start from, every option explained
    New {
        /// Its name
        #[arg(default_value = "my-preset")]
        name: String,
        /// The preset to start from
        #[arg(long, value_name = "NAME_OR_PATH", default_value = "pencil")]
        from: PathBuf,
        /// File to write [default: NAME.toml here]
        #[arg(short, long = "output", value_name = "FILE")]
        out: Option<PathBuf>,
        /// Replace a file that is there already
        #[arg(long)]
        force: bool,
    },
}

pub(super) fn run(args: &PresetsArgs, output: &Output) -> Result<Outcome, Failure> {
    match args.action.as_ref().unwrap_or(&Action::List) {
        Action::List => list(output)?,
        Action::Show { preset } => {
            let embedded = Preset::embedded().iter().find(|(name, _)| preset.as_os_str() == *name);
            let (name, preset) = source::preset(preset)?;
            let text = embedded.map_or_else(|| preset.to_toml(), |(_, source)| (*source).to_owned());
            output.result(&text, || json!({ "name": name, "preset": preset, "toml": text }))?;
        }
        Action::Sheet { out, force } => sheet(out, *force, output)?,
        Action::New { name, from, out, force } => {
            let path = out.clone().unwrap_or_else(|| PathBuf::from(format!("{name}.toml")));
            if out.is_none() && (name.is_empty() || name.contains(['/', '\\'])) {
                return Err(Failure::usage(format!("{name:?} is no name"), "-o takes the path of the file"));
            }
            let (_, preset) = source::preset(from)?;
            files::write(&path, commented(&preset).as_bytes(), *force)?;
            let shown = path.display();
            output.say(&format!("{shown}\n\nnext: tam-gen watch {shown}\n"))?;
            output.object(&json!({ "path": path_text(&path) }))?;
        }
    }
    Ok(Outcome::Holds)
}

fn sheet(path: &Path, force: bool, output: &Output) -> Result<(), Failure> {
    files::check_free(path, force)?;
    let cancel = interrupt::catch();
    let mut maps = Vec::new();
    for (name, source) in Preset::embedded() {
        let preset = Preset::from_toml(source, name)?;
        let map = tam_gen::generate(&preset, &Job { cancel: Some(cancel), ..Job::default() })?;
        maps.push((map.grid, SheetOptions::of(name, &preset).unwrap_or_default()));
    }
    let picture = gallery(&maps);
    files::write_picture(path, &picture, force)?;
    let (width, height) = picture.dimensions();
    output.say(&format!("{}: {width} x {height} px\n", path.display()))?;
    output.object(&json!({ "path": path_text(path), "width": width, "height": height }))
}

fn list(output: &Output) -> Result<(), Failure> {
    let mut presets = Vec::new();
    for (name, source) in Preset::embedded() {
        presets.push((*name, Preset::from_toml(source, name)?.description));
    }
    let width = presets.iter().map(|(name, _)| name.len()).max().unwrap_or(0);
    let text: String = presets.iter().map(|(name, description)| format!("{name:<width$}  {description}\n")).collect();
    output.result(&text, || {
        let list = presets.iter().map(|(name, description)| json!({ "name": name, "description": description }));
        json!({ "presets": list.collect::<Vec<Value>>() })
    })
}
