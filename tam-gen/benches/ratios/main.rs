//! The ratios that count: CPU time of whole maps over merely rasterising their accepted strokes once, in one run; spacing
//! and tone beside them. Prints a table and writes `target/tam-gen-ratios.csv`.
//!
//! `cargo bench -p tam-gen --bench ratios` (add `-- --quick` for 256 px only).

#![allow(missing_docs, clippy::print_stdout)]

mod literal;

use std::fmt::Write as _;
use std::time::Duration;

use cpu_time::ProcessTime;
use tam_gen::preset::PlacementMethod;
use tam_gen::sequence::{Draw, Sequence};
use tam_gen::{Generator, Job, Map, Preset, measure};

/// Runs of everything that takes less than this; slower ones run once, which the table says.
const RUNS: usize = 5;
const SLOW: Duration = Duration::from_secs(20);

struct Row {
    size: u32,
    what: String,
    runs: usize,
    cpu_ms: f64,
    raster_ms: f64,
    map: Option<Map>,
}

fn main() {
    // `cargo bench` passes its own flags to every target.
    let quick = std::env::args().any(|argument| argument == "--quick" || argument == "--test");
    let sizes: &[u32] = if quick { &[256] } else { &[256, 512, 1024] };
    let mut rows = Vec::new();
    for &size in sizes {
        for method in PlacementMethod::ALL {
            let mut preset = Preset::named("pencil").expect("ships with the tool").expect("a valid preset");
            preset.map.size = size;
            preset.placement.method = method;
            rows.push(row(&preset, size));
        }
        if size == 256 {
            let incremental = rows.iter().find(|row| row.what == "praun").and_then(|row| row.map.as_ref());
            let literal = literal_row(incremental.expect("praun's placement was just measured"), rows[0].raster_ms);
            rows.push(literal);
        }
    }
    print(&rows);
}

fn row(preset: &Preset, size: u32) -> Row {
    let (mut generator, mut map) = (Generator::new(), Map::default());
    let (mut map_times, mut raster_times) = (Vec::new(), Vec::new());
    let slow_after_one = |times: &Vec<Duration>| times.first().is_some_and(|first| *first > SLOW);
    while map_times.len() < RUNS && !slow_after_one(&map_times) {
        let start = ProcessTime::now();
        generator.generate_into(preset, &Job::default(), &mut map).expect("a valid preset");
        map_times.push(start.elapsed());
        // Interleaved, so that a change of the machine's speed meets both.
        for _ in 0..3 {
            let start = ProcessTime::now();
            measure::rasterise_once(&map).expect("the tips were read before");
            raster_times.push(start.elapsed());
        }
    }
    Row {
        size,
        what: preset.placement.method.name().into(),
        runs: map_times.len(),
        cpu_ms: median_ms(map_times),
        raster_ms: median_ms(raster_times),
        map: Some(map),
    }
}

/// A sample of the literal search, carried over to all candidates of the incremental one.
fn literal_row(incremental: &Map, raster_ms: f64) -> Row {
    const STROKES_PER_CELL: usize = 2;
    const CANDIDATES: usize = 3;
    let sizes: Vec<u32> = incremental.grid.levels.iter().map(|level| level.size).collect();
    let placement = &incremental.preset.placement;
    let sequence = Sequence::new(&incremental.preset, 0, &incremental.strokes.families[0]);
    let mut draw = Draw::new(1, "literal");
    let mut column = literal::Column::white(&sizes);
    let mut total = Duration::ZERO;
    for k in 0..incremental.grid.columns() {
        for l in (0..sizes.len()).rev() {
            let accepted = accepted(incremental, l, k);
            let candidates = placement.candidates(k, incremental.grid.columns()) as usize;
            let mut cell = Duration::ZERO;
            for _ in 0..STROKES_PER_CELL {
                let tried: Vec<_> = (0..CANDIDATES).map(|_| sequence.random_stroke(&mut draw)).collect();
                let start = ProcessTime::now();
                let scores: Vec<f64> = tried.iter().map(|stroke| column.score(l, stroke)).collect();
                cell += start.elapsed();
                let best = (0..CANDIDATES).max_by(|a, b| scores[*a].total_cmp(&scores[*b])).unwrap_or(0);
                column.add(l, &tried[best]);
            }
            std::hint::black_box(column.tone(l));
            total += cell.mul_f64((accepted * candidates) as f64 / (STROKES_PER_CELL * CANDIDATES) as f64);
        }
    }
    Row {
        size: sizes[0],
        what: "praun literal".into(),
        runs: 0,
        cpu_ms: total.as_secs_f64() * 1e3,
        raster_ms,
        map: None,
    }
}

/// Strokes that the search accepted in a cell: there at this level first, and not at coarser ones.
fn accepted(map: &Map, level: usize, column: usize) -> usize {
    let coarser = map.strokes.first_column.get(level + 1);
    let own = map.strokes.first_column[level].iter().enumerate();
    own.filter(|(i, first)| {
        usize::from(**first) == column && coarser.is_none_or(|coarser| coarser[*i] == tam_gen::StrokeList::NEVER)
    })
    .count()
}

fn median_ms(mut times: Vec<Duration>) -> f64 {
    times.sort();
    times[times.len() / 2].as_secs_f64() * 1e3
}

/// What a map's finest level looks like in numbers (METRICS: uniformity).
#[derive(Default)]
struct Figures {
    tone_error: f64,
    cv8: Vec<f64>,
    gap: Vec<f64>,
    low: Vec<f64>,
}

impl Figures {
    fn of(map: &Map) -> Self {
        let level = &map.grid.levels[0];
        // Columns of the first family alone.
        let alone = map.preset.schedule.iter().take_while(|entry| **entry == map.preset.schedule[0]).count();
        let cells = &level.cells[..alone.min(3)];
        let axis = map.strokes.strokes[0].axis;
        let half = measure::full_ink(&cells[0]) / 2;
        Self {
            tone_error: measure::tone_errors(&map.grid, &tam_gen::preset::ToneMeasure::default()).max,
            cv8: cells.iter().map(|cell| measure::box_cv(cell, level.size, level.size / 8)).collect(),
            gap: cells.iter().map(|cell| measure::gap_cv(cell, level.size, axis, half)).collect(),
            low: cells.iter().map(|cell| measure::low_frequency_share(cell, level.size, axis, half)).collect(),
        }
    }

    fn words(&self) -> String {
        let list = |figures: &[f64]| figures.iter().map(|f| format!("{f:.3}")).collect::<Vec<_>>().join(" ");
        format!("{}  {}  {}", list(&self.cv8), list(&self.gap), list(&self.low))
    }
}

fn print(rows: &[Row]) {
    let mut csv = String::from(
        "size_px,placement,runs,cpu_ms,raster_ms,over_raster,over_progressive,tone_error,cv8_c0,cv8_c1,cv8_c2,gap_c0,gap_c1,gap_c2,low_c0,low_c1,low_c2\n",
    );
    println!(
        "{:>5}  {:<14} {:>4} {:>10} {:>8} {:>8} {:>9} {:>9}  CV(S/8) by column, gap CV, low frequency",
        "px", "placement", "runs", "CPU ms", "raster", "ratio", "to ours", "tone err"
    );
    for row in rows {
        let ours = rows.iter().find(|r| r.size == row.size && r.what == "progressive").map_or(f64::NAN, |r| r.cpu_ms);
        let figures = row.map.as_ref().map(Figures::of).unwrap_or_default();
        println!(
            "{:>5}  {:<14} {:>4} {:>10.2} {:>8.2} {:>7.2}x {:>8.1}x {:>9.1e}  {}",
            row.size,
            row.what,
            if row.runs == 0 { "est.".into() } else { row.runs.to_string() },
            row.cpu_ms,
            row.raster_ms,
            row.cpu_ms / row.raster_ms,
            row.cpu_ms / ours,
            figures.tone_error,
            figures.words(),
        );
        let _ = write!(
            csv,
            "{},{},{},{:.3},{:.3},{:.3},{:.2},{:.3e}",
            row.size,
            row.what,
            row.runs,
            row.cpu_ms,
            row.raster_ms,
            row.cpu_ms / row.raster_ms,
            row.cpu_ms / ours,
            figures.tone_error
        );
        for figure in figures.cv8.iter().chain(&figures.gap).chain(&figures.low) {
            let _ = write!(csv, ",{figure:.4}");
        }
        csv.push('\n');
    }
    let folder = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("../target");
    let file = folder.join("tam-gen-ratios.csv");
    match std::fs::write(&file, csv) {
        Ok(()) => println!("written to target/tam-gen-ratios.csv"),
        Err(error) => println!("could not write the CSV: {error}"),
    }
}
