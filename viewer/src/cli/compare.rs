//! `tam-viewer compare`.

use std::path::PathBuf;
use std::time::{Duration, Instant};

use serde_json::{Value, json};
use tam_gen::command::words::{duration, milliseconds, path_text};
use tam_gen::command::{Failure, Output, Progress, files, interrupt};
use tam_viewer::scene_file::value;
use tam_viewer::sheet::{Labelled, SheetText, labelled_sheet};
use tam_viewer::{Form, FrameTimer, Mapping, Method, RenderParams};

use super::render::{check_png, samples};
use super::stage::{Stage, Ways, params_json, way_on};
use super::view::{ViewArgs, method};

/// Rounds before those that count: pipelines are made, maps uploaded, clocks raised.
const WARM_UP: u32 = 2;

/// Mappings that are compared where none is asked for: lapped patches are a baseline that takes seconds to make.
const MAPPINGS: [Mapping; 4] = [Mapping::Uv, Mapping::Frames, Mapping::Triplanar, Mapping::Patches];

const EXAMPLES: &str = "\
Examples:
  tam-viewer compare                                        every method and mapping, with what a frame costs
  tam-viewer compare --mesh torus-knot --map engraving -o engraving.png
  tam-viewer compare --methods six-way,fine-tone --forms    as the papers print them, beside the hardened forms
  tam-viewer compare --mapping uv --mesh teapot --rounds 31 --json

Cost is the time of a frame on the device, as a ratio to phong: all are drawn in turn, round by round, and the medians
compared.";

#[derive(Debug, clap::Args)]
#[command(after_help = EXAMPLES)]
pub(super) struct CompareArgs {
    /// Methods to compare, between commas [default: all]
    #[arg(long, value_name = "METHODS", value_parser = method(), value_delimiter = ',', help_heading = "How it is hatched")]
    methods: Vec<Method>,
    /// The papers' literal forms beside the hardened ones
    #[arg(long, help_heading = "How it is hatched", conflicts_with = "form")]
    forms: bool,
    #[command(flatten)]
    view: ViewArgs,
    /// Sides of each picture in pixels
    #[arg(long, value_name = "WxH", value_parser = value::size, default_value = "480x480", allow_hyphen_values = true)]
    size: [u32; 2],
    /// Samples per pixel, 1 or 4
    #[arg(long, value_name = "N", value_parser = samples, default_value = "4", allow_hyphen_values = true)]
    samples: u32,
    /// Rounds that are measured
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(5..=1000), default_value = "7")]
    rounds: u32,
    /// Pictures beside each other, at most
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(1..=20), default_value = "4")]
    columns: u32,
    /// Sheet to write
    #[arg(short, long, value_name = "FILE.png", default_value = "compare.png")]
    out: PathBuf,
    /// Replace a sheet that is there already
    #[arg(long)]
    force: bool,
}

pub(super) fn run(args: &CompareArgs, output: &Output) -> Result<(), Failure> {
    let started = Instant::now();
    check_png(&args.out)?;
    files::check_free(&args.out, args.force)?;
    let mut methods = if args.methods.is_empty() { Method::ALL.to_vec() } else { args.methods.clone() };
    let mappings = (!args.view.mapping_given()).then_some(&MAPPINGS[..]);
    let mut stage = Stage::open(&args.view, Ways::Each(&methods, mappings), args.size, args.samples, true, output)?;
    if args.methods.is_empty() && stage.maps.iter().any(|map| map.source.stroke_map.is_none()) {
        methods.retain(|method| *method != Method::StrokeMap);
        output.remark("note: stroke-map is left out: the map has no stroke map");
    }
    let variants = variants(args, &methods, &stage);
    let times = measure(&mut stage, &variants, args.rounds, output)?;
    let phong = median(&times[0]);

    let mut rows: Vec<(Option<Mapping>, Vec<Labelled>)> = Vec::new();
    let mut figures = Vec::new();
    let timer = FrameTimer::new(&stage.renderer.gpu);
    let scene = stage.scene.clone();
    for (params, times) in variants.iter().zip(&times) {
        // Phong is measured even where it is not shown.
        if !methods.contains(&params.method) {
            continue;
        }
        stage.draw(&scene, |own, mesh| as_in(own, params, mesh), &timer)?;
        let time = median(times);
        let ratio = time.as_secs_f64() / phong.as_secs_f64().max(1e-9);
        let remark = format!("{ratio:.2}x phong, {}", short(time));
        let title = title(params, args.forms);
        let picture = Labelled { picture: stage.picture()?, title, remarks: vec![remark] };
        // A row for each mapping, and for the methods that take none.
        let of = params.method.takes_mapping().then_some(params.mapping);
        match rows.last_mut() {
            Some((mapping, row)) if *mapping == of && row.len() < args.columns as usize => row.push(picture),
            _ => rows.push((of, vec![picture])),
        }
        let mut figure = params_json(params, time);
        figure["ratio_to_phong"] = json!((ratio * 1e3).round() / 1e3);
        figures.push(figure);
    }
    let rows: Vec<Vec<Labelled>> = rows.into_iter().map(|(_, row)| row).collect();
    let sheet = labelled_sheet(&text(args, &stage), &rows);
    interrupt::stop_if_happened()?;
    files::write_picture(&args.out, &sheet, args.force)?;

    let software = stage.renderer.gpu.adapter.is_software();
    if !output.json {
        output.remark(stage.to_text().trim_end());
    }
    let mut report: String =
        rows.iter().flatten().map(|cell| format!("{:<33} {}\n", cell.title, cell.remarks[0])).collect();
    let (width, height) = sheet.dimensions();
    let took = duration(started.elapsed());
    report += &format!("{}: {width} x {height} px; took {took}\n", args.out.display());
    output.say(&report)?;
    let mut object = stage.to_json();
    object["path"] = path_text(&args.out).into();
    object["software_adapter"] = software.into();
    object["rounds"] = args.rounds.into();
    object["phong_ms"] = milliseconds(phong).into();
    object["methods"] = Value::from(figures);
    object["milliseconds"] = json!(milliseconds(started.elapsed()));
    output.object(&object)
}

/// What is drawn: phong first, then each method with each mapping it takes, in each form wanted.
fn variants(args: &CompareArgs, methods: &[Method], stage: &Stage) -> Vec<RenderParams> {
    let given = RenderParams { method: Method::Phong, ..stage.drawn[0].params };
    let has_uv = stage.uploads.iter().any(|upload| !upload.mesh.uvs.is_empty());
    let mappings: Vec<Mapping> = if args.view.mapping_given() {
        vec![given.mapping]
    } else {
        MAPPINGS.into_iter().filter(|mapping| *mapping != Mapping::Uv || has_uv).collect()
    };
    let mut variants = vec![given];
    let forms = if args.forms { vec![Form::Hardened, Form::Literal] } else { vec![given.form] };
    let of_mapping = |takes: bool| methods.iter().filter(move |method| method.takes_mapping() == takes);
    for method in of_mapping(false).filter(|method| **method != Method::Phong) {
        variants.extend(forms.iter().map(|form| RenderParams { method: *method, form: *form, ..given }));
    }
    for mapping in mappings {
        for method in of_mapping(true) {
            let of = |form: &Form| RenderParams { method: *method, mapping, form: *form, ..given };
            variants.extend(forms.iter().map(of));
        }
    }
    variants
}

/// An object's look in the method, mapping and form of a variant.
fn as_in(own: &RenderParams, variant: &RenderParams, mesh: &tam_viewer::mesh::Mesh) -> RenderParams {
    let RenderParams { method, mapping, form, .. } = *variant;
    RenderParams { form, ..way_on(own, method, mapping, mesh) }
}

/// Times of each variant: all are drawn in turn, round by round, so that whatever slows the device slows them all.
fn measure(
    stage: &mut Stage,
    variants: &[RenderParams],
    rounds: u32,
    output: &Output,
) -> Result<Vec<Vec<Duration>>, Failure> {
    let timer = FrameTimer::new(&stage.renderer.gpu);
    let scene = stage.scene.clone();
    let progress = Progress::new("measuring", output.quiet || output.json);
    let mut times = vec![Vec::new(); variants.len()];
    for round in 0..WARM_UP + rounds {
        progress.set(round as f32 / (WARM_UP + rounds) as f32);
        for (params, times) in variants.iter().zip(&mut times) {
            let time = stage.draw(&scene, |own, mesh| as_in(own, params, mesh), &timer)?;
            if round >= WARM_UP {
                times.push(time);
            }
        }
    }
    Ok(times)
}

fn median(times: &[Duration]) -> Duration {
    let mut sorted = times.to_vec();
    sorted.sort_unstable();
    sorted.get(sorted.len() / 2).copied().unwrap_or_default()
}

/// A frame's time with three digits: frames of a GPU take fractions of a millisecond.
fn short(time: Duration) -> String {
    let milliseconds = time.as_secs_f64() * 1e3;
    if milliseconds < 10.0 { format!("{milliseconds:.2} ms") } else { format!("{milliseconds:.0} ms") }
}

fn title(params: &RenderParams, with_form: bool) -> String {
    let mut title = params.method.name().to_owned();
    if params.method.takes_mapping() {
        title += &format!(", {}", params.mapping.name());
    }
    if with_form && params.method != Method::Phong {
        title += match params.form {
            Form::Hardened => ", hardened",
            Form::Literal => ", literal",
        };
    }
    title
}

fn text(args: &CompareArgs, stage: &Stage) -> SheetText {
    let gpu = &stage.renderer.gpu;
    let mut foot = format!(
        "Cost of a frame, median of {} rounds in which all are drawn in turn, and its ratio to phong. {} x {} px, {} \
         samples.",
        args.rounds, args.size[0], args.size[1], args.samples
    );
    if gpu.adapter.is_software() {
        foot += " The adapter computes on the processor: ratios on a graphics card differ.";
    }
    SheetText {
        title: format!("{} in {}", stage.objects.name(), stage.maps[0].source.name),
        description: format!("{} triangles on {}", stage.triangles(), gpu.adapter),
        foot,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_median_is_the_middle_one() {
        let times = [5, 1, 9, 3, 7].map(Duration::from_millis);
        assert_eq!(median(&times), Duration::from_millis(5));
        assert_eq!(median(&[]), Duration::ZERO);
    }

    #[test]
    fn titles_say_what_differs() {
        let params = RenderParams { method: Method::SixWay, mapping: Mapping::Uv, ..RenderParams::default() };
        assert_eq!(title(&params, false), "six-way, uv");
        let literal = RenderParams { form: Form::Literal, method: Method::FaceFrame, ..params };
        assert_eq!(title(&literal, true), "face-frame, literal");
    }
}
