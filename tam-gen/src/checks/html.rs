//! The report as a page: verdicts in a table, and pictures of what is wrong.

use maud::{DOCTYPE, Markup, PreEscaped, html};

use super::picture::{Window, png};
use super::report::{number, with_unit};
use super::{CellFinding, Constraint, Finding, Report, Verdict};
use crate::map::{Grid, StrokeMap};
use crate::measure;

/// Texels across an enlarged picture.
const WINDOW: u32 = 64;
/// Texels across a picture of the overview.
const OVERVIEW: u32 = 128;
/// Cells shown for a constraint that fails, worst first.
const SHOWN_CELLS: usize = 3;
/// Columns shown in the overview.
const SHOWN_COLUMNS: usize = 6;

/// The report as one self-contained page: a verdict, a table of all constraints, for each one that fails pictures of the
/// worst cells with offending texels in colour, and an overview of the map.
///
/// `grid` and `stroke_map` must be those the report was made from.
pub fn html(report: &Report, grid: &Grid, stroke_map: Option<&StrokeMap>, title: &str) -> String {
    let failing: Vec<&Finding> = report.findings.iter().filter(|finding| !finding.holds()).collect();
    let page = html! {
        (DOCTYPE)
        html lang="en" {
            head {
                meta charset="utf-8";
                meta name="viewport" content="width=device-width, initial-scale=1";
                title { (title) " – " @if report.holds() { "all constraints hold" } @else { "constraints fail" } }
                style { (PreEscaped(include_str!("html.css"))) }
            }
            body {
                main {
                    (head(report, grid, title))
                    (table(report))
                    @for finding in failing { (failure(finding, grid, stroke_map)) }
                    (overview(grid, stroke_map))
                }
            }
        }
    };
    page.into_string()
}

fn head(report: &Report, grid: &Grid, title: &str) -> Markup {
    let count = |word: &str| report.findings.iter().filter(|finding| finding.verdict.word() == word).count();
    let sizes = grid.levels.first().zip(grid.levels.last());
    html! {
        header {
            h1 { (title) }
            @if let Some((finest, coarsest)) = sizes {
                p.facts {
                    (grid.columns()) " tones, " (grid.levels.len()) " levels, "
                    (finest.size) " to " (coarsest.size) " px"
                }
            }
            p class=(if report.holds() { "banner pass" } else { "banner fail" }) {
                strong { @if report.holds() { "✓ A tonal art map" } @else { "✗ Not a tonal art map" } }
                span {
                    (count("pass")) " constraints hold, " (count("fail")) " fail, " (count("not judged")) " not judged"
                }
            }
        }
    }
}

fn table(report: &Report) -> Markup {
    html! {
        table {
            thead { tr { th { "Constraint" } th.number { "Measured" } th.number { "Limit" } th { "Verdict" } th { "Where" } } }
            tbody {
                @for finding in &report.findings {
                    @let judged = !matches!(finding.verdict, Verdict::NotJudged { .. });
                    tr {
                        td { b { (finding.constraint.title()) } p { (finding.constraint.definition()) } }
                        td.number { @if judged { (number(finding.measured)) span.unit { (finding.unit) } } @else { "–" } }
                        td.number { @if judged { (finding.limit) } @else { "–" } }
                        td { (badge(&finding.verdict)) }
                        td.where { (finding.explanation()) }
                    }
                }
            }
        }
    }
}

fn badge(verdict: &Verdict) -> Markup {
    let (class, mark) = match verdict {
        Verdict::Pass => ("badge pass", "✓"),
        Verdict::Fail => ("badge fail", "✗"),
        Verdict::NotJudged { .. } => ("badge grey", "–"),
    };
    html! { span class=(class) { (mark) " " (verdict.word()) } }
}

fn failure(finding: &Finding, grid: &Grid, stroke_map: Option<&StrokeMap>) -> Markup {
    let mut cells: Vec<&CellFinding> = finding.cells.iter().filter(|cell| cell.verdict == Verdict::Fail).collect();
    let failing = cells.len();
    cells.sort_by(|a, b| b.limit.excess(b.measured).total_cmp(&a.limit.excess(a.measured)));
    cells.truncate(SHOWN_CELLS);
    html! {
        section {
            h2 { (badge(&finding.verdict)) " " (finding.constraint.title()) }
            p { (finding.detail) "." }
            @if cells.iter().any(|cell| !cell.texels.is_empty()) {
                p.key {
                    "Offending texels: " i.swatch.paper {} " where there is little ink, " i.swatch.ink {} " where there is much."
                }
            }
            @for cell in &cells { (pair(finding, cell, grid, stroke_map)) }
            @if failing > cells.len() { p.key { "The worst " (cells.len()) " of " (failing) " failing cells are shown." } }
        }
    }
}

/// An offending cell, and beside it what it should agree with.
fn pair(finding: &Finding, cell: &CellFinding, grid: &Grid, stroke_map: Option<&StrokeMap>) -> Markup {
    let Some(level) = grid.levels.get(cell.level) else { return html! {} };
    let Some(ink) = level.cells.get(cell.column) else { return html! {} };
    let window = Window::around(&cell.texels, level.size, WINDOW);
    let measured = with_unit(number(cell.measured), finding.unit);
    let caption =
        format!("level {} ({} px), column {}: {measured}, limit {}", cell.level, level.size, cell.column, cell.limit);
    html! {
        div.pair {
            (figure(ink, level.size, window, &cell.texels, &caption))
            @if let Some(other) = companion(finding.constraint, cell, grid, stroke_map) {
                @let window = other.window(window, level.size);
                (figure(&other.ink, other.size, window, &[], &other.caption))
            }
        }
    }
}

/// The image that a cell is judged against.
struct Companion {
    ink: Vec<u8>,
    size: u32,
    caption: String,
    /// Show as many texels, rather than the same part of the tile.
    same_texels: bool,
}

impl Companion {
    fn window(&self, window: Window, size: u32) -> Window {
        if self.same_texels {
            Window { left: 0, top: 0, side: window.side.min(self.size) }
        } else {
            window.scaled(size, self.size)
        }
    }
}

fn companion(
    constraint: Constraint,
    cell: &CellFinding,
    grid: &Grid,
    stroke_map: Option<&StrokeMap>,
) -> Option<Companion> {
    let of = |level: usize, column: usize, what: &str, same_texels: bool| {
        let image = grid.levels.get(level)?;
        let caption = format!("{what}: level {level} ({} px), column {column}", image.size);
        Some(Companion { ink: image.cells.get(column)?.clone(), size: image.size, caption, same_texels })
    };
    let (level, column) = (cell.level, cell.column);
    match constraint {
        Constraint::ToneNesting => of(level, column.checked_sub(1)?, "the lighter column", false),
        Constraint::LevelNestingPixels => {
            of(level.checked_sub(1)?, column, "the finer level, same part of the tile", false)
        }
        Constraint::StrokeWidth => of(0, column, "the finest level, as many texels", true),
        Constraint::ToneAverage | Constraint::ToneSpread | Constraint::LevelNestingList => {
            let other = if level == 0 { 1 } else { 0 };
            of(other, column, "another level, for comparison", false)
        }
        Constraint::LevelNestingCentreLines | Constraint::Seams => of(level, column, "without marks", false),
        Constraint::StrokeMapTone => thresholded(stroke_map?, level, (255.0 * grid.tones.get(column)?).round() as u8),
        Constraint::StrokeMapPattern => {
            let ink = grid.levels.get(level)?.cells.get(column)?;
            let half_ink = measure::full_ink(&grid.levels[level].cells[0]).div_ceil(2);
            let thresholds = stroke_map?.levels.get(level)?;
            let found = measure::pattern_match(&thresholds.threshold, ink, thresholds.size, half_ink);
            thresholded(stroke_map?, level, found.threshold)
        }
    }
}

fn thresholded(map: &StrokeMap, level: usize, threshold: u8) -> Option<Companion> {
    let level = map.levels.get(level)?;
    let ink = level.threshold.iter().map(|&at| if at <= threshold { 255 } else { 0 }).collect();
    let caption = format!("the stroke map, cut at {threshold}/255");
    Some(Companion { ink, size: level.size, caption, same_texels: false })
}

fn figure(ink: &[u8], size: u32, window: Window, texels: &[u32], caption: &str) -> Markup {
    let place = window.describe(size);
    html! {
        figure {
            img.enlarged src=(png(ink, size, window, texels)) alt=(caption);
            figcaption { (caption) @if !place.is_empty() { br; span.unit { (place) } } }
        }
    }
}

/// The hand-built levels of some columns, and the stroke map, texel for texel.
fn overview(grid: &Grid, stroke_map: Option<&StrokeMap>) -> Markup {
    let last = grid.columns().saturating_sub(1);
    let shown = SHOWN_COLUMNS.min(grid.columns());
    let columns: Vec<usize> = (0..shown).map(|i| if shown > 1 { i * last / (shown - 1) } else { 0 }).collect();
    let window = |size: u32| Window { left: 0, top: 0, side: size.min(OVERVIEW) };
    html! {
        section {
            h2 { "The map" }
            p.key { "Texel for texel; levels of more than " (OVERVIEW) " px are cut to their first corner." }
            div.scroll { table.overview {
                thead { tr {
                    th { "Level" }
                    @for &column in &columns { th { "column " (column) ", tone " (number(grid.tones[column])) } }
                    @if stroke_map.is_some() { th { "stroke map" } }
                } }
                tbody {
                    @for (i, level) in grid.levels.iter().take(grid.hand_built).enumerate() {
                        tr {
                            th { (i) br; span.unit { (level.size) " px" } }
                            @for &column in &columns {
                                @if let Some(ink) = level.cells.get(column) {
                                    td { img src=(png(ink, level.size, window(level.size), &[])) alt={ "level " (i) ", column " (column) }; }
                                }
                            }
                            @if let Some(thresholds) = stroke_map.and_then(|map| map.levels.get(i)) {
                                @let ink: Vec<u8> = thresholds.threshold.iter().map(|at| 255 - at).collect();
                                td { img src=(png(&ink, thresholds.size, window(thresholds.size), &[])) alt={ "stroke map, level " (i) }; }
                            }
                        }
                    }
                }
            } }
        }
    }
}
