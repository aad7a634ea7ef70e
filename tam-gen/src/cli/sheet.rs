//! `tam-gen sheet`.

use std::path::PathBuf;

use image::RgbImage;
use serde_json::json;
use tam_gen::command::{Failure, Output, files, interrupt, source, words::path_text};
use tam_gen::export::sheet::{SheetOptions, contact_sheet, tiling};
use tam_gen::import::{self, ImportOptions};
use tam_gen::{Grid, Job, Preset};

use super::Outcome;
use super::args::OverrideArgs;

const EXAMPLES: &str = "\
Examples:
  tam-gen sheet pencil                     pencil.sheet.png, from the preset
  tam-gen sheet out/mine.ktx2 -o all.png   of a finished map
  tam-gen sheet engraving --tile           pencil.tile.png: is the tile's period visible?";

#[derive(Debug, clap::Args)]
#[command(after_help = EXAMPLES)]
pub(super) struct SheetArgs {
    /// A preset (name or file), a KTX2 or DDS array, or a folder of pictures
    source: PathBuf,
    /// Picture to write [default: NAME.sheet.png here]
    #[arg(short, long = "output", value_name = "FILE.png")]
    out: Option<PathBuf>,
    /// Instead of all cells, one cell of the finest level, three by three tiles
    #[arg(long)]
    tile: bool,
    /// Column to tile, 0 lightest [default: the middle one]
    #[arg(long, value_name = "K", requires = "tile")]
    column: Option<usize>,
    /// Names of the pictures in the folder, with {tone} and {level} for the numbers
    #[arg(long, value_name = "PATTERN")]
    pattern: Option<String>,
    /// Replace a picture that is there already
    #[arg(long)]
    force: bool,
    #[command(flatten)]
    overrides: OverrideArgs,
}

/// A map, whatever it came from.
struct Shown {
    name: String,
    grid: Grid,
    preset: Option<Preset>,
}

pub(super) fn run(args: &SheetArgs, output: &Output) -> Result<Outcome, Failure> {
    let kind = if args.tile { "tile" } else { "sheet" };
    let stem = if source::is_preset(&args.source) { source::stem(&args.source)? } else { map_name(args)? };
    let path = args.out.clone().unwrap_or_else(|| PathBuf::from(format!("{stem}.{kind}.png")));
    files::check_free(&path, args.force)?;

    let shown = load(args, stem)?;
    let picture =
        if args.tile { tile(&shown.grid, args.column)? } else { contact_sheet(&shown.grid, &options(&shown)) };
    interrupt::stop_if_happened()?;
    files::write_picture(&path, &picture, args.force)?;
    let (width, height) = picture.dimensions();
    output.say(&format!("{}: {width} x {height} px\n", path.display()))?;
    output.object(&json!({ "path": path_text(&path), "width": width, "height": height }))?;
    Ok(Outcome::Holds)
}

fn map_name(args: &SheetArgs) -> Result<String, Failure> {
    if args.source.components().count() == 1 && !args.source.exists() && args.source.extension().is_none() {
        return Err(source::unknown(&args.source.to_string_lossy()));
    }
    source::stem(&args.source)
}

fn load(args: &SheetArgs, name: String) -> Result<Shown, Failure> {
    if source::is_preset(&args.source) {
        let (name, preset) = source::preset(&args.source)?;
        let preset = preset.apply(&args.overrides.overrides())?;
        let cancel = interrupt::catch();
        let map = tam_gen::generate(&preset, &Job { cancel: Some(cancel), ..Job::default() })?;
        return Ok(Shown { name, grid: map.grid, preset: Some(preset) });
    }
    if args.overrides.any() {
        return Err(Failure::usage("a finished map cannot be changed", "give the preset to change it"));
    }
    let options = ImportOptions { pattern: args.pattern.clone(), ..ImportOptions::default() };
    let imported = import::read(&args.source, &options)?;
    let preset = imported.preset_toml.and_then(|source| Preset::from_toml(&source, "the preset in the map").ok());
    Ok(Shown { name, grid: imported.grid, preset })
}

fn options(shown: &Shown) -> SheetOptions {
    let plain = || SheetOptions { title: shown.name.clone(), ..SheetOptions::default() };
    // A foreign file may name colours that are none; its cells can be shown all the same.
    shown.preset.as_ref().and_then(|preset| SheetOptions::of(&shown.name, preset).ok()).unwrap_or_else(plain)
}

fn tile(grid: &Grid, column: Option<usize>) -> Result<RgbImage, Failure> {
    let columns = grid.columns();
    let column = column.unwrap_or(columns / 2);
    match grid.levels.first() {
        Some(finest) if column < columns => Ok(tiling(finest, column, 3)),
        _ => Err(Failure::usage(
            format!("--column {column}: the map has {columns}"),
            format!("0 to {}", columns.max(1) - 1),
        )),
    }
}
