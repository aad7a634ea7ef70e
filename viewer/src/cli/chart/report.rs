//! The figures as charts, a table and a page.

use std::io::Cursor;

use image::imageops::FilterType;
use image::{DynamicImage, ImageFormat};
use tam_gen::chart::{Axis, Chart, ChartPoint, Page, Report, Table, Thumbnail, figure};
use tam_gen::command::Failure;
use tam_viewer::chart::{COST_AXIS, COST_LOG_FROM, Figures, MEASURES, Measure};
use tam_viewer::gpu::Picture;
use tam_viewer::{Form, Method};

use super::scene::Measured;
use super::{ChartArgs, Point};

/// Longer side of the pictures on the page.
const THUMBNAIL_PX: u32 = 192;

pub(super) fn report(args: &ChartArgs, measured: &Measured, points: &[Point]) -> Result<Report, Failure> {
    let mut page = page(args, measured);
    for point in points {
        if let Some(picture) = &point.picture {
            page.thumbnails.push(thumbnail(point, picture)?);
        }
    }
    let charts = MEASURES.iter().filter_map(|measure| chart(measure, measured, points)).collect();
    Ok(Report { table: table(measured, points), charts, page })
}

fn chart(measure: &Measure, measured: &Measured, points: &[Point]) -> Option<Chart> {
    // The yardstick has no strokes: it is 1 on the axis of cost, and no way to hatch.
    let drawn = || points.iter().filter(|point| point.way.params.method != Method::Phong);
    let mut methods: Vec<Method> = drawn().map(|point| point.way.params.method).collect();
    methods.dedup();
    let charted = |point: &Point| {
        Some(ChartPoint {
            label: point.label.clone(),
            group: methods.iter().position(|method| *method == point.way.params.method)?,
            baseline: point.way.params.form == Form::Literal,
            x: point.figures.cost.ratio,
            y: (measure.of)(&point.figures)?,
        })
    };
    let points: Vec<ChartPoint> = drawn().filter_map(charted).collect();
    let mut chart = Chart {
        name: measure.name.to_owned(),
        title: String::new(),
        subtitle: subtitle(measured),
        x: Axis {
            label: COST_AXIS.into(),
            log_from: Some(COST_LOG_FROM),
            mark: Some((1.0, Method::Phong.name().to_owned())),
        },
        y: Axis { label: measure.axis.to_owned(), log_from: measure.log_from, mark: None },
        groups: methods.iter().map(|method| method.name().to_owned()).collect(),
        points,
    };
    let best = chart.best()?;
    chart.title = format!("Least {}: {}, at {:.2}x phong", measure.short, best.label, best.x);
    Some(chart)
}

fn subtitle(measured: &Measured) -> String {
    let adapter = &measured.renderer.gpu.adapter;
    let [width, height] = measured.target.size;
    let software = if adapter.is_software() { "software adapter: " } else { "" };
    format!(
        "{} in {}, {width} x {height} px, {} triangles; {software}{}",
        measured.mesh.name,
        measured.map_name,
        measured.mesh.triangles.len(),
        adapter.name
    )
}

/// Columns of the table: name with unit, and the figure.
type Column = (&'static str, fn(&Figures) -> Option<f64>);

const COLUMNS: [Column; 18] = [
    ("cost_ratio", |of| Some(of.cost.ratio)),
    ("frame_ms", |of| Some(of.cost.frame_ms)),
    ("phong_ms", |of| Some(of.cost.phong_ms)),
    ("bytes", |of| Some(of.bytes as f64)),
    ("tone_rmse_lightness", |of| of.tone_rmse),
    ("tone_bias_lightness", |of| of.tone_bias),
    ("direction_error_deg", |of| of.direction_deg),
    ("run_length_px", |of| of.run_px),
    ("edge_continuity_ratio", |of| of.edge_continuity),
    ("orbit_change", |of| of.orbit_change),
    ("zoom_change", |of| of.zoom_change),
    ("light_swimming", |of| of.swimming),
    ("light_popping_slope", |of| of.popping_slope),
    ("light_popping_rest", |of| of.popping_rest),
    ("zoom_deaths", |of| of.deaths),
    ("zoom_births", |of| of.births),
    ("zoom_deaths_by_chance", |of| of.deaths_by_chance),
    ("zoom_deaths_over_chance", |of| of.deaths.zip(of.deaths_by_chance).map(|(found, chance)| found / chance)),
];

fn table(measured: &Measured, points: &[Point]) -> Table {
    let words = ["way", "method", "mapping", "form", "map_size_px", "tones"];
    let row = |point: &Point| {
        let params = &point.way.params;
        let choice = measured.maps[point.way.map].choice;
        let mapping = if params.method.takes_mapping() { params.mapping.name() } else { "" };
        let form = match params.form {
            Form::Hardened => "hardened",
            Form::Literal => "literal",
        };
        let words = [&point.label, params.method.name(), mapping, form].map(String::from);
        let maps = [choice.size.to_string(), choice.tones.to_string()];
        let figures = COLUMNS.iter().map(|(name, of)| {
            let value = of(&point.figures);
            if *name == "bytes" { point.figures.bytes.to_string() } else { figure(value) }
        });
        words.into_iter().chain(maps).chain(figures).collect()
    };
    let heading = words.into_iter().chain(COLUMNS.iter().map(|column| column.0)).map(String::from).collect();
    Table { heading, rows: points.iter().map(row).collect() }
}

fn page(args: &ChartArgs, measured: &Measured) -> Page {
    let adapter = &measured.renderer.gpu.adapter;
    let mut lead = vec![
        "Each point is a way to draw this scene. To the right it costs more; up it errs more: ways on the line are worth \
         their cost, others are beaten by one of them. Triangles are methods as their papers print them, dots the \
         hardened forms."
            .to_owned(),
        format!(
            "Cost is the time of a frame over that of phong, frames of both drawn in turn, the median of {} pairs. \
             Direction and length of strokes are those of the map's first family alone, as strokes that cross have two \
             directions.",
            args.pairs()
        ),
        "Errors too small to be told from none stand at one height: breaks at mesh edges at 0.02, swimming at 0.0001."
            .to_owned(),
    ];
    if adapter.is_software() {
        lead.push("The adapter computes on the processor: costs on a graphics card differ.".into());
    }
    Page {
        title: format!("{} in {}: cost against error", measured.mesh.name, measured.map_name),
        lead,
        facts: vec![
            ("adapter".into(), adapter.to_string()),
            ("driver".into(), adapter.driver.clone()),
            (
                "versions".into(),
                format!("tam-viewer {}, tam-gen {}", env!("CARGO_PKG_VERSION"), tam_gen::export::VERSION),
            ),
            ("command".into(), command(args)),
        ],
        thumbnails: Vec::new(),
    }
}

/// The command that makes the same page again, but for options of the view.
fn command(args: &ChartArgs) -> String {
    let [width, height] = args.size;
    let list = |of: &[u32]| of.iter().map(u32::to_string).collect::<Vec<_>>().join(",");
    let mut command = format!("tam-viewer chart {} --size {width}x{height}", args.view.named());
    if !args.methods.is_empty() {
        let names: Vec<&str> = args.methods.iter().map(|method| method.name()).collect();
        command += &format!(" --methods {}", names.join(","));
    }
    if !args.mappings.is_empty() {
        let names: Vec<&str> = args.mappings.iter().map(|mapping| mapping.name()).collect();
        command += &format!(" --mappings {}", names.join(","));
    }
    command += &format!(" --sizes {} --tones {} --pairs {}", list(&args.sizes), list(&args.tones), args.pairs);
    command + if args.quick { " --quick" } else { "" }
}

fn thumbnail(point: &Point, picture: &Picture) -> Result<Thumbnail, Failure> {
    let whole = DynamicImage::from(picture.clone().into_image());
    let small = whole.resize(THUMBNAIL_PX, THUMBNAIL_PX, FilterType::Triangle).into_rgb8();
    let mut png = Cursor::new(Vec::new());
    small.write_to(&mut png, ImageFormat::Png).map_err(|error| Failure::Output {
        message: format!("cannot make a picture: {error}"),
        help: Some("choose another --size".to_owned()),
    })?;
    let figures = &point.figures;
    let mut remark = format!("{:.2} times phong", figures.cost.ratio);
    if let Some(error) = figures.tone_rmse {
        remark += &format!(", tone {error:.2} L*");
    }
    if let Some(error) = figures.direction_deg {
        remark += &format!(", direction {error:.1}°");
    }
    Ok(Thumbnail { title: point.way.name(), remark, png: png.into_inner() })
}
