//! `tam-gen chart`.

use std::path::PathBuf;
use std::time::Instant;

use serde_json::{Value, json};
use tam_gen::chart::placement::{Evenness, PlacementFigures, Way, measure_placement};
use tam_gen::chart::{Axis, Chart, ChartPoint, Page, Report, Table, check_folder, figure};
use tam_gen::command::words::{duration, milliseconds, path_text};
use tam_gen::command::{Failure, Output, Progress, interrupt, source};
use tam_gen::export::VERSION;
use tam_gen::{Job, Preset};

use super::Outcome;

const EXAMPLES: &str = "\
Examples:
  tam-gen chart                              pencil's placement, into chart/
  tam-gen chart pencil engraving -o charts   each preset has its charts on one page
  tam-gen chart ./mine.toml --quick          fewer candidates, fewer runs

Cost is the CPU time of the whole map over that of drawing its strokes once, measured in turn in one run.";

/// Candidates of the progressive placement.
const EFFORTS: [u32; 7] = [1, 2, 4, 8, 16, 32, 64];
/// Candidates of the search of Praun and others in the lightest column; the last is theirs.
const CANDIDATES: [u32; 5] = [10, 30, 100, 300, 1000];
/// Runs of a quick chart: the least whose median is one of more than its neighbours.
const QUICK_RUNS: u32 = 5;

#[derive(Debug, clap::Args)]
#[command(after_help = EXAMPLES)]
pub(super) struct ChartArgs {
    /// Presets by name or file [default: pencil]
    #[arg(value_name = "PRESET")]
    presets: Vec<PathBuf>,
    /// Folder to write points.csv, index.html and the charts to
    #[arg(short, long = "output", value_name = "DIR", default_value = "chart")]
    out: PathBuf,
    /// Side of the finest level [default: the preset's]
    #[arg(long, value_name = "PX")]
    size: Option<u32>,
    /// Runs of each way, of which the median counts
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(5..=1000), default_value = "7")]
    runs: u32,
    /// Few candidates and runs
    #[arg(long)]
    quick: bool,
    /// Replace a report that is there already
    #[arg(long)]
    force: bool,
}

/// A preset and what was measured of it.
struct Measured {
    name: String,
    preset: Preset,
    points: Vec<(Way, PlacementFigures)>,
}

pub(super) fn run(args: &ChartArgs, output: &Output) -> Result<Outcome, Failure> {
    let started = Instant::now();
    let named = if args.presets.is_empty() { vec![PathBuf::from("pencil")] } else { args.presets.clone() };
    let presets = named.iter().map(|named| source::preset(named)).collect::<Result<Vec<_>, _>>()?;
    check_folder(&args.out, args.force)?;
    let cancel = interrupt::catch();
    let progress = Progress::new("placing", output.quiet || output.json);
    let ways = ways(args.quick);
    let runs = if args.quick { QUICK_RUNS } else { args.runs };
    let total = (presets.len() * ways.len()) as f32;
    let mut measured = Vec::new();
    for (name, mut preset) in presets {
        preset.map.size = args.size.unwrap_or(preset.map.size);
        let mut points = Vec::new();
        for way in &ways {
            progress.set((measured.len() * ways.len() + points.len()) as f32 / total);
            let job = Job { progress: None, cancel: Some(cancel), measure: None };
            points.push((*way, measure_placement(&preset, *way, runs as usize, &job)?));
        }
        measured.push(Measured { name, preset, points });
    }
    let report = Report {
        table: table(&measured),
        charts: measured.iter().flat_map(|of| charts(of, measured.len() > 1)).collect(),
        page: page(args, &measured, runs),
    };
    interrupt::stop_if_happened()?;
    let written = report.write(&args.out, args.force)?;

    let text: String = report.charts.iter().map(|chart| format!("{}\n", chart.title)).collect();
    let took = duration(started.elapsed());
    output.say(&format!("{text}{}: {} files; took {took}\n", args.out.display(), written.len()))?;
    output.object(&json!({
        "files": written.iter().map(|path| path_text(path)).collect::<Vec<_>>(),
        "points": objects(&report.table),
        "milliseconds": milliseconds(started.elapsed()),
    }))?;
    Ok(Outcome::Holds)
}

/// Every way that is measured; a quick chart leaves out the expensive ones.
fn ways(quick: bool) -> Vec<Way> {
    let (efforts, candidates) = if quick { (&EFFORTS[..4], &CANDIDATES[..2]) } else { (&EFFORTS[..], &CANDIDATES[..]) };
    let progressive = efforts.iter().map(|effort| Way::Progressive(*effort));
    progressive.chain(candidates.iter().map(|candidates| Way::Praun(*candidates))).chain([Way::Random]).collect()
}

fn label(way: Way) -> String {
    match way {
        Way::Progressive(effort) => format!("progressive, effort {effort}"),
        Way::Praun(candidates) => format!("praun, {candidates} candidates"),
        Way::Random => "random".to_owned(),
    }
}

/// A way beside points of its method's colour.
fn short(way: Way) -> String {
    match way {
        Way::Progressive(effort) => format!("effort {effort}"),
        Way::Praun(candidates) => format!("{candidates} candidates"),
        Way::Random => "by chance".to_owned(),
    }
}

/// What the charts show against the cost: a name for files, what is best, the axis, where it is logarithmic from, and
/// the figure.
type Shown = (&'static str, &'static str, &'static str, Option<f64>, fn(&PlacementFigures) -> Option<f64>);

const SHOWN: [Shown; 7] = [
    ("tone", "truest tones", "greatest tone error of a cell (share of ink)", Some(1e-7), |of| Some(of.tone_max)),
    ("box-cv-1", "most even column 1", "CV of means over S/8, column 1", None, |of| {
        of.evenness[0].map(|column| column.box_cv)
    }),
    ("box-cv-3", "most even column 3", "CV of means over S/8, column 3", None, |of| {
        of.evenness[1].map(|column| column.box_cv)
    }),
    ("gap-cv-1", "most even gaps in column 1", "CV of the gaps between strokes, column 1", None, |of| {
        of.evenness[0].map(|column| column.gap_cv)
    }),
    ("gap-cv-3", "most even gaps in column 3", "CV of the gaps between strokes, column 3", None, |of| {
        of.evenness[1].map(|column| column.gap_cv)
    }),
    ("low-frequency-1", "least clumps in column 1", "share of power in clumps, column 1", None, |of| {
        of.evenness[0].map(|column| column.low_frequency)
    }),
    ("low-frequency-3", "least clumps in column 3", "share of power in clumps, column 3", None, |of| {
        of.evenness[1].map(|column| column.low_frequency)
    }),
];

fn charts(measured: &Measured, several: bool) -> Vec<Chart> {
    let Measured { name, preset, points } = measured;
    let of = |(file, best, axis, log_from, figure): &Shown| {
        let point = |(way, figures): &(Way, PlacementFigures)| {
            let y = figure(figures)?;
            let (label, group) = (short(*way), way.group());
            Some(ChartPoint { label, group, baseline: false, x: figures.ratio(), y })
        };
        let points: Vec<ChartPoint> = points.iter().filter_map(point).collect();
        let mut chart = Chart {
            name: if several { format!("{name}-{file}") } else { (*file).to_owned() },
            title: String::new(),
            subtitle: format!("{} px, {} tones", preset.map.size, preset.map.tones.count()),
            x: Axis {
                label: "CPU time over drawing the same strokes once (ratio)".into(),
                log_from: Some(0.1),
                mark: Some((1.0, "drawing alone".into())),
            },
            y: Axis { label: (*axis).to_owned(), log_from: *log_from, mark: None },
            groups: Way::GROUPS.map(String::from).to_vec(),
            points,
        };
        let of = chart.best()?;
        chart.title =
            format!("{name}, {best}: {} {}, at {:.1} times drawing alone", Way::GROUPS[of.group], of.label, of.x);
        Some(chart)
    };
    SHOWN.iter().filter_map(of).collect()
}

fn table(measured: &[Measured]) -> Table {
    let heading = [
        "way",
        "preset",
        "placement",
        "candidates",
        "size_px",
        "tones",
        "cpu_ms",
        "raster_ms",
        "cost_ratio",
        "tone_max",
        "tone_rms",
        "box_cv_1",
        "gap_cv_1",
        "low_frequency_1",
        "box_cv_3",
        "gap_cv_3",
        "low_frequency_3",
    ];
    let row = |of: &Measured, (way, figures): &(Way, PlacementFigures)| {
        let even = |column: &Option<Evenness>| {
            [column.map(|of| of.box_cv), column.map(|of| of.gap_cv), column.map(|of| of.low_frequency)]
        };
        let numbers = [figures.cpu_ms, figures.raster_ms, figures.ratio(), figures.tone_max, figures.tone_rms];
        let numbers = numbers.map(Some).into_iter().chain(figures.evenness.iter().flat_map(even));
        let words = [
            label(*way),
            of.name.clone(),
            Way::GROUPS[way.group()].to_owned(),
            way.candidates().to_string(),
            of.preset.map.size.to_string(),
            of.preset.map.tones.count().to_string(),
        ];
        words.into_iter().chain(numbers.map(figure)).collect()
    };
    Table {
        heading: heading.map(String::from).to_vec(),
        rows: measured.iter().flat_map(|of| of.points.iter().map(move |point| row(of, point))).collect(),
    }
}

/// The rows for machines: figures as numbers.
fn objects(table: &Table) -> Vec<Value> {
    let cell = |text: &String| text.parse::<f64>().map_or_else(|_| json!(text), |number| json!(number));
    let object = |row: &Vec<String>| table.heading.iter().cloned().zip(row.iter().map(cell)).collect();
    table.rows.iter().map(object).collect()
}

fn page(args: &ChartArgs, measured: &[Measured], runs: u32) -> Page {
    let names: Vec<&str> = measured.iter().map(|of| of.name.as_str()).collect();
    let mut command = "tam-gen chart".to_owned();
    names.iter().for_each(|name| command += &format!(" {name}"));
    if let Some(size) = args.size {
        command += &format!(" --size {size}");
    }
    command += &if args.quick { " --quick".to_owned() } else { format!(" --runs {runs}") };
    Page {
        title: format!("Placing the strokes of {}: cost against evenness", names.join(", ")),
        lead: vec![
            "Each point is a way of placing strokes. To the right it costs more; up it is worse: ways on the line are \
             worth their cost, others are beaten by one of them. Cost is the CPU time of the whole map, over that of \
             merely drawing its accepted strokes once."
                .into(),
            "Evenness is measured at the finest level, in column 1 (the lightest) and column 3, where all strokes \
             belong to one family: the spread of the ink over windows of an eighth of the tile, that of the gaps \
             between strokes, and the share of power below half the strokes' own frequency."
                .into(),
        ],
        facts: vec![
            ("version".into(), format!("tam-gen {VERSION}")),
            ("runs".into(), format!("medians of {runs}")),
            ("command".into(), command),
        ],
        thumbnails: Vec::new(),
    }
}
