//! From cells of unknown meaning to a grid of ink.

use super::collect::Collected;
use super::error::ImportError;
use super::{ImportOptions, Imported, Polarity};
use crate::map::{Grid, Level};
use crate::preset::{TONE_COUNT, ToneMeasure};

/// Levels below this side are taken for a box-filtered tail where nothing says how many were drawn.
const DRAWN_MIN_PX: u32 = 8;
/// Means of columns closer than this, in 255ths, say nothing.
const FLAT: f64 = 1.0;

/// What accompanied the cells: metadata of the file, or the manifest beside it.
#[derive(Debug, Default)]
pub(super) struct Facts {
    pub(super) tones: Option<Vec<f64>>,
    pub(super) hand_built: Option<usize>,
    pub(super) preset_toml: Option<String>,
    pub(super) version: Option<String>,
}

/// Makes the grid, and decides what was not said.
pub(super) fn assemble(collected: Collected, facts: Facts, options: &ImportOptions) -> Result<Imported, ImportError> {
    let Collected { levels: found, mut notes, .. } = collected;
    check_sizes(&found.iter().map(|level| (level.width, level.height)).collect::<Vec<_>>())?;
    let columns = found.first().map_or(0, |level| level.cells.len());
    if !TONE_COUNT.contains(&columns) {
        let (least, most) = (TONE_COUNT.start(), TONE_COUNT.end());
        return Err(ImportError::Tones(format!("there are {columns} tones; a map has {least} to {most}")));
    }
    let mut levels: Vec<Level> =
        found.into_iter().map(|level| Level { size: level.width, cells: level.cells }).collect();

    if is_luminance(&levels, options.polarity, facts.version.is_some(), &mut notes)? {
        levels.iter_mut().flat_map(|level| &mut level.cells).flatten().for_each(|texel| *texel = 255 - *texel);
    }
    order_columns(&mut levels, options, &facts, &mut notes);
    drop_blank_column(&mut levels, options, &facts, &mut notes);

    let columns = levels[0].cells.len();
    let hand_built = match facts.hand_built.filter(|&count| (1..=levels.len()).contains(&count)) {
        Some(count) => count,
        None => levels.iter().filter(|level| level.size >= DRAWN_MIN_PX).count().max(1),
    };
    let given = match &options.tones {
        Some(tones) => {
            check_tones(tones, columns)?;
            Some(tones.clone())
        }
        None => facts.tones.filter(|tones| check_tones(tones, columns).is_ok()),
    };
    let tones_given = given.is_some();
    let tones = given.unwrap_or_else(|| mean_tones(&levels[..hand_built]));
    if !tones_given {
        notes.push("the tones were not given; each column is taken to mean what its levels are on average".into());
    }
    Ok(Imported {
        grid: Grid { tones, levels, hand_built },
        stroke_map: None,
        preset_toml: facts.preset_toml,
        version: facts.version,
        tones_given,
        notes,
    })
}

/// Whether levels are square, powers of two, and halve.
pub(super) fn check_sizes(sizes: &[(u32, u32)]) -> Result<(), ImportError> {
    let Some(&(finest, _)) = sizes.first() else { return Err(ImportError::Size("there are no levels".into())) };
    for (index, &(width, height)) in sizes.iter().enumerate() {
        let wanted = finest.checked_shr(index as u32).unwrap_or(0);
        if width != height || !width.is_power_of_two() || width != wanted {
            let listed: Vec<_> = sizes.iter().map(|(width, height)| format!("{width} x {height}")).collect();
            return Err(ImportError::Size(format!("the levels are {} px", listed.join(", "))));
        }
    }
    Ok(())
}

/// Whether large numbers are paper.
fn is_luminance(
    levels: &[Level],
    polarity: Polarity,
    ours: bool,
    notes: &mut Vec<String>,
) -> Result<bool, ImportError> {
    match polarity {
        Polarity::Luminance => return Ok(true),
        Polarity::Ink => return Ok(false),
        Polarity::Auto if ours => return Ok(true),
        Polarity::Auto => {}
    }
    let means: Vec<f64> = mean_tones(levels).iter().map(|mean| mean * 255.0).collect();
    let steps: Vec<f64> = means.windows(2).map(|pair| pair[1] - pair[0]).filter(|step| step.abs() > FLAT).collect();
    let rising = steps.iter().filter(|step| **step > 0.0).count();
    let undecided = |why: &str| Err(ImportError::Polarity(why.into()));
    match (means.len(), rising, steps.len()) {
        (1, ..) => undecided("there is one tone, so nothing gets darker"),
        (_, _, 0) => undecided("all tones are equally bright"),
        (_, 0, _) => Ok(true),
        (_, rising, all) if rising == all => {
            notes.push(
                "numbers rise from tone to tone and were read as ink; if paper is white and the darkest tone comes \
                 first, say --polarity luminance"
                    .into(),
            );
            Ok(false)
        }
        _ => undecided("the tones get neither darker nor lighter throughout"),
    }
}

/// Turns the columns round where they come darkest first.
fn order_columns(levels: &mut [Level], options: &ImportOptions, facts: &Facts, notes: &mut Vec<String>) {
    let tones = mean_tones(levels);
    let falls = tones.len() > 1 && tones.windows(2).all(|pair| pair[0] > pair[1]);
    if falls && options.tones.is_none() && facts.tones.is_none() {
        levels.iter_mut().for_each(|level| level.cells.reverse());
        notes.push("the columns came darkest first and were turned round".into());
    }
}

/// Leaves out a lightest column that is all paper: paper is implied, and has no strokes to judge.
fn drop_blank_column(levels: &mut [Level], options: &ImportOptions, facts: &Facts, notes: &mut Vec<String>) {
    let columns = levels[0].cells.len();
    let listed = options.tones.as_ref().or(facts.tones.as_ref()).map(Vec::len);
    let blank = levels.iter().all(|level| level.cells[0].iter().all(|&ink| ink == 0));
    if columns > 1 && blank && listed != Some(columns) {
        levels.iter_mut().for_each(|level| drop(level.cells.remove(0)));
        notes.push("the lightest column is blank paper and was left out".into());
    }
}

fn check_tones(tones: &[f64], columns: usize) -> Result<(), ImportError> {
    if tones.len() != columns {
        return Err(ImportError::Tones(format!("{} tones are given for {columns} columns", tones.len())));
    }
    if !tones.iter().all(|tone| *tone > 0.0 && *tone <= 1.0) || !tones.windows(2).all(|pair| pair[0] < pair[1]) {
        return Err(ImportError::Tones(format!("the tones given, {tones:?}, do not rise within 0 .. 1")));
    }
    Ok(())
}

/// The mean over levels of the mean of each column, `0.0 ..= 1.0`.
fn mean_tones(levels: &[Level]) -> Vec<f64> {
    let measure = ToneMeasure::default();
    let columns = levels.first().map_or(0, |level| level.cells.len());
    let mean = |column: usize| levels.iter().map(|level| measure.tone(&level.cells[column])).sum::<f64>();
    (0..columns).map(|column| mean(column) / levels.len() as f64).collect()
}
