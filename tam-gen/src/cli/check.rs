//! `tam-gen check`.

use std::path::{Path, PathBuf};

use clap::ValueEnum;
use serde_json::json;
use tam_gen::checks::{self, CheckOptions, Report};
use tam_gen::command::{Failure, Output, files, words::path_text};
use tam_gen::export::VERSION;
use tam_gen::import::{self, ImportOptions, Imported, LevelOrder, Polarity};
use tam_gen::preset::{ToneMeasure, Tones};
use tam_gen::{Grid, Job, Preset, StrokeList};

use super::Outcome;

const EXAMPLES: &str = "\
Examples:
  tam-gen check out/pencil.ktx2
  tam-gen check out/pencil.ktx2 --report pencil.html     with pictures of the texels that offend
  tam-gen check hatching.dds --tones 0.15,0.3,0.5,0.8    somebody else's map
  tam-gen check maps --pattern 'tam_{level}_{tone}.png' --level-order coarsest-first --polarity ink

Exit status: 0 if every constraint holds, 1 if one does not, 2 if the map cannot be read.";

#[derive(Debug, clap::Args)]
#[command(after_help = EXAMPLES)]
pub(super) struct CheckArgs {
    /// A KTX2 or DDS array, or a folder of pictures
    source: PathBuf,
    /// Names of the pictures in the folder, with {tone} and {level} for the numbers
    #[arg(long, value_name = "PATTERN")]
    pattern: Option<String>,
    /// The wanted tones, lightest first, or how many evenly spaced ones; without them only their agreement is judged
    #[arg(long, value_name = "N|LIST", value_parser = super::args::tones, allow_negative_numbers = true)]
    tones: Option<Tones>,
    /// Whether large numbers in the files are light or dark
    #[arg(long, value_enum, default_value = "auto")]
    polarity: PolarityArg,
    /// How the levels of pictures are numbered
    #[arg(long, value_enum, default_value = "auto")]
    level_order: LevelOrderArg,
    /// The stroke map that belongs to it
    #[arg(long, value_name = "FILE")]
    stroke_map: Option<PathBuf>,
    /// Write a page that shows the offending texels as pictures
    #[arg(long, value_name = "FILE.html")]
    report: Option<PathBuf>,
    /// Replace a report that is there already
    #[arg(long)]
    force: bool,
}

#[derive(Debug, Clone, Copy, ValueEnum)]
enum PolarityArg {
    /// As the columns get darker
    Auto,
    /// Large numbers are paper
    Luminance,
    /// Large numbers are ink
    Ink,
}

#[derive(Debug, Clone, Copy, ValueEnum)]
enum LevelOrderArg {
    /// By the sizes of the pictures
    Auto,
    /// Number 0 is the finest
    FinestFirst,
    /// Number 0 is the coarsest
    CoarsestFirst,
}

impl CheckArgs {
    fn import_options(&self) -> ImportOptions {
        ImportOptions {
            pattern: self.pattern.clone(),
            tones: self.tones.as_ref().map(Tones::list),
            polarity: match self.polarity {
                PolarityArg::Auto => Polarity::Auto,
                PolarityArg::Luminance => Polarity::Luminance,
                PolarityArg::Ink => Polarity::Ink,
            },
            level_order: match self.level_order {
                LevelOrderArg::Auto => LevelOrder::Auto,
                LevelOrderArg::FinestFirst => LevelOrder::FinestFirst,
                LevelOrderArg::CoarsestFirst => LevelOrder::CoarsestFirst,
            },
            stroke_map: self.stroke_map.clone(),
        }
    }
}

pub(super) fn run(args: &CheckArgs, output: &Output) -> Result<Outcome, Failure> {
    if let Some(path) = &args.report {
        files::check_free(path, args.force)?;
    }
    let mut imported = import::read(&args.source, &args.import_options())?;
    let (options, strokes) = own_facts(&mut imported)?;
    let Imported { grid, stroke_map, notes, .. } = &imported;
    let report = checks::check_grid(grid, stroke_map.as_ref(), strokes.as_ref(), &options);
    if let Some(path) = &args.report {
        let page = checks::html(&report, grid, stroke_map.as_ref(), &title(&args.source));
        files::write(path, page.as_bytes(), args.force)?;
    }
    output.say(&to_text(&args.source, grid, notes, &report, args.report.as_deref()))?;
    let [source, page] = [Some(&args.source), args.report.as_ref()].map(|path| path.map(|path| path_text(path)));
    output.object(&json!({
        "source": source,
        "holds": report.holds(),
        "tones": grid.tones,
        "sizes": grid.levels.iter().map(|level| level.size).collect::<Vec<_>>(),
        "hand_built": grid.hand_built,
        "notes": notes,
        "report": report,
        "report_page": page,
    }))?;
    Ok(if report.holds() { Outcome::Holds } else { Outcome::ConstraintFails })
}

/// What a map of our own says about itself: how its tone is measured, and, by generating it anew, its strokes.
fn own_facts(imported: &mut Imported) -> Result<(CheckOptions, Option<StrokeList>), Failure> {
    let mut options = CheckOptions { tone_spread_only: !imported.tones_given, ..CheckOptions::default() };
    let (Some(source), Some(version)) = (&imported.preset_toml, &imported.version) else { return Ok((options, None)) };
    let preset = match Preset::from_toml(source, "the preset in the map") {
        Ok(preset) => preset,
        Err(error) => {
            tracing::debug!("{error}");
            imported.notes.push("The preset in the map is not valid here, so its strokes were not checked.".to_owned());
            return Ok((options, None));
        }
    };
    options.own = true;
    options.measure = ToneMeasure::named(preset.map.tone_measure);
    if version != VERSION {
        imported.notes.push(format!(
            "The map was made by version {version}, this is {VERSION}: its strokes cannot be made anew to check them."
        ));
        return Ok((options, None));
    }
    let map = tam_gen::generate(&preset, &Job::default())?;
    if !same_shape(&map.grid, &imported.grid) {
        imported
            .notes
            .push("The map has other tones or levels than its preset, so its strokes were not checked.".to_owned());
        return Ok((options, None));
    }
    Ok((options, Some(map.strokes)))
}

fn same_shape(made: &Grid, read: &Grid) -> bool {
    let sizes = |grid: &Grid| grid.drawn().iter().map(|level| level.size).collect::<Vec<_>>();
    made.columns() == read.columns() && sizes(made) == sizes(read)
}

fn title(source: &Path) -> String {
    source.file_name().unwrap_or(source.as_os_str()).to_string_lossy().into_owned()
}

fn to_text(source: &Path, grid: &Grid, notes: &[String], report: &Report, page: Option<&Path>) -> String {
    let sizes: Vec<String> = grid.levels.iter().map(|level| level.size.to_string()).collect();
    let mut text = format!("{}: {} tones, levels of {} px\n", source.display(), grid.columns(), sizes.join(", "));
    for note in notes {
        text += &format!("note: {note}\n");
    }
    text += &format!("\n{}\n", report.table());
    text += &match report.failing().len() {
        0 => "every constraint that could be judged holds\n".to_owned(),
        1 => "1 constraint does not hold\n".to_owned(),
        failing => format!("{failing} constraints do not hold\n"),
    };
    if let Some(page) = page {
        text += &format!("written: {}\n", page.display());
    }
    text
}
