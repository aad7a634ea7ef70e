//! `tam-gen generate`.

use std::path::{Path, PathBuf};
use std::str::FromStr;
use std::sync::atomic::AtomicBool;
use std::time::Instant;

use tam_gen::checks::{Report, check_map};
use tam_gen::command::{Failure, Output, Progress, files, interrupt, source};
use tam_gen::export::{ExportOptions, Format, WrittenFile, export};
use tam_gen::{Job, Map, Preset};

use super::Outcome;
use super::args::OverrideArgs;
use super::summary::Finished;

const EXAMPLES: &str = "\
Examples:
  tam-gen generate pencil                           out/pencil.ktx2, its stroke map, contact sheet and manifest
  tam-gen generate ./mine.toml -o assets --force    your own preset, in place of what is there
  tam-gen generate brush --size 1024 --tones 12     another size, other tones
  tam-gen generate pencil --format dds-slices       for Unity and Unreal only
  tam-gen generate pencil --format +png             one picture per cell beside the usual files
  tam-gen generate pencil --json                    what was written and measured, for scripts";

#[derive(Debug, clap::Args)]
#[command(after_help = EXAMPLES)]
pub(super) struct GenerateArgs {
    /// A preset that comes with the tool (see `tam-gen presets`), or the path of a preset file
    #[arg(value_name = "NAME_OR_PATH")]
    preset: PathBuf,
    /// Folder to write into; made where it is missing
    #[arg(short, long = "output", value_name = "DIR", default_value = "out")]
    out: PathBuf,
    /// Name that the files begin with [default: the preset's]
    #[arg(long, value_name = "NAME")]
    name: Option<String>,
    /// Formats to write in place of ktx2, several by commas; `+png` adds to it
    #[arg(long, value_name = "FORMAT", value_delimiter = ',', long_help = formats_help())]
    format: Vec<FormatArg>,
    /// Formats to write besides
    #[arg(long, value_name = "FORMAT", value_delimiter = ',')]
    also: Vec<Format>,
    /// Replace files that are there already
    #[arg(long)]
    force: bool,
    /// Leave out the contact sheet
    #[arg(long)]
    no_sheet: bool,
    #[command(flatten)]
    overrides: OverrideArgs,
}

/// A format that is selected (`png`) or added (`+png`).
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
struct FormatArg {
    format: Format,
    added: bool,
}

impl FromStr for FormatArg {
    type Err = <Format as FromStr>::Err;

    fn from_str(text: &str) -> Result<Self, Self::Err> {
        let (added, name) = text.strip_prefix('+').map_or((false, text), |name| (true, name));
        Ok(Self { format: name.parse()?, added })
    }
}

fn formats_help() -> String {
    let mut help = String::from("Formats to write in place of ktx2, several by commas; `+png` adds to it\n");
    for format in Format::ALL {
        help += &format!("\n- {}: {}", format.name(), format.describe());
    }
    help
}

/// What is selected, or what is written when nothing is; and what is added.
fn formats(selected: &[FormatArg], also: &[Format]) -> Vec<Format> {
    let mut formats: Vec<Format> = selected.iter().filter(|arg| !arg.added).map(|arg| arg.format).collect();
    if formats.is_empty() {
        formats = ExportOptions::default().formats;
    }
    let added = selected.iter().filter(|arg| arg.added).map(|arg| arg.format);
    for format in added.chain(also.iter().copied()) {
        if !formats.contains(&format) {
            formats.push(format);
        }
    }
    formats
}

pub(super) fn run(args: &GenerateArgs, output: &Output) -> Result<Outcome, Failure> {
    let started = Instant::now();
    files::check_folder(&args.out, "-o")?;
    let (stem, preset) = source::preset(&args.preset)?;
    let preset = preset.apply(&args.overrides.overrides())?;
    let name = args.name.as_deref().unwrap_or(&stem);
    let options =
        ExportOptions { formats: formats(&args.format, &args.also), overwrite: args.force, sheet: !args.no_sheet };
    let cancel = interrupt::catch();
    let made = make(&preset, name, &args.out, &options, cancel, output)?;
    made.finish(name, started, output)
}

/// A map with its verdict and its files.
pub(super) struct Made {
    map: Map,
    report: Report,
    files: Vec<WrittenFile>,
}

/// Generates, checks and writes a map.
pub(super) fn make(
    preset: &Preset,
    name: &str,
    dir: &Path,
    options: &ExportOptions,
    cancel: &AtomicBool,
    output: &Output,
) -> Result<Made, Failure> {
    let progress = Progress::new("generating", output.quiet);
    let report = |part| progress.set(part);
    let job = Job { progress: Some(&report), cancel: Some(cancel), measure: None };
    let started = Instant::now();
    let map = tam_gen::generate(preset, &job)?;
    tracing::info!("generated in {:?}", started.elapsed());

    let started = Instant::now();
    let (report, files) = rayon::join(|| check_map(&map), || export(&map, name, dir, options, &job));
    let files = files?;
    tracing::info!("checked and written in {:?}", started.elapsed());
    Ok(Made { map, report, files })
}

impl Made {
    /// Says what was made.
    pub(super) fn finish(&self, name: &str, started: Instant, output: &Output) -> Result<Outcome, Failure> {
        let Self { map, report, files } = self;
        let finished = Finished { name, map, report, files, took: started.elapsed() };
        output.say(&finished.to_text())?;
        output.object(&finished.to_json())?;
        Ok(if report.holds() { Outcome::Holds } else { Outcome::ConstraintFails })
    }

    /// Whether every constraint holds.
    pub(super) fn holds(&self) -> bool {
        self.report.holds()
    }

    /// What was made, for machines.
    pub(super) fn to_json(&self, name: &str, took: std::time::Duration) -> serde_json::Value {
        Finished { name, map: &self.map, report: &self.report, files: &self.files, took }.to_json()
    }

    /// The constraints that fail, by name, with where and why; empty if all hold.
    pub(super) fn failing(&self) -> Vec<String> {
        let failing = self.report.findings.iter().filter(|finding| !finding.holds());
        failing.map(|finding| format!("{} fails: {}", finding.constraint.name(), finding.explanation())).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn chosen(text: &[&str], also: &[Format]) -> Vec<Format> {
        let selected: Vec<FormatArg> = text.iter().map(|text| text.parse().expect("a format")).collect();
        formats(&selected, also)
    }

    #[test]
    fn formats_select_or_add() {
        assert_eq!(chosen(&[], &[]), [Format::Ktx2]);
        assert_eq!(chosen(&["png"], &[]), [Format::Png]);
        assert_eq!(chosen(&["+png"], &[]), [Format::Ktx2, Format::Png]);
        assert_eq!(chosen(&["dds-array", "+png"], &[Format::Png]), [Format::DdsArray, Format::Png]);
        assert!("+pgn".parse::<FormatArg>().is_err());
    }
}
