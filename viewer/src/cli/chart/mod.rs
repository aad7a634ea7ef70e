//! `tam-viewer chart`.

mod report;
mod scene;

use std::path::PathBuf;
use std::time::Instant;

use serde_json::json;
use tam_gen::chart::check_folder;
use tam_gen::command::words::{duration, milliseconds, path_text};
use tam_gen::command::{Failure, Output, Progress, interrupt};
use tam_viewer::chart::{Figures, MapChoice, Setting, Way, is_repeated, measure_way};
use tam_viewer::gpu::Picture;
use tam_viewer::scene_file::value;
use tam_viewer::{FrameTimer, Mapping, Method};

use super::report as failure;
use super::view::{ViewArgs, mapping, method};
use scene::Measured;

const EXAMPLES: &str = "\
Examples:
  tam-viewer chart --mesh hand                             every method and mapping, into chart/
  tam-viewer chart --mesh head --map fine-pen -o charts    another scene
  tam-viewer chart --mesh hand --methods stripes,fine-tone --mappings patches,triplanar
  tam-viewer chart --mesh cube --quick                     one map, hardened forms and five frames each

Cost is the time of a frame on the device over that of phong, drawn in turn. Lapped patches take long to make; they are
measured where --mappings names them.";

/// Mappings where none is named.
const MAPPINGS: [Mapping; 4] = [Mapping::Uv, Mapping::Frames, Mapping::Triplanar, Mapping::Patches];

#[derive(Debug, clap::Args)]
#[command(after_help = EXAMPLES)]
pub(super) struct ChartArgs {
    #[command(flatten)]
    view: ViewArgs,
    /// Methods to measure, between commas [default: all]
    #[arg(long, value_name = "METHODS", value_parser = method(), value_delimiter = ',', help_heading = "What is measured")]
    methods: Vec<Method>,
    /// Mappings to measure, between commas [default: uv where the mesh has one, frames, triplanar, patches]
    #[arg(long, value_name = "MAPPINGS", value_parser = mapping(), value_delimiter = ',', help_heading = "What is measured")]
    mappings: Vec<Mapping>,
    /// Sizes of maps, between commas; the first is used where nothing is said of it
    #[arg(
        long,
        value_name = "PX",
        value_delimiter = ',',
        default_value = "256,128",
        help_heading = "What is measured"
    )]
    sizes: Vec<u32>,
    /// Counts of tones beside the preset's own, at the first size, between commas
    #[arg(long, value_name = "N", value_delimiter = ',', default_value = "3,12", help_heading = "What is measured")]
    tones: Vec<u32>,
    /// Sides of the pictures
    #[arg(long, value_name = "WxH", value_parser = value::size, default_value = "384x384", allow_hyphen_values = true)]
    size: [u32; 2],
    /// Pairs of frames that are timed, of which the median counts
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(5..=1000), default_value = "7")]
    pairs: u32,
    /// One map, hardened forms, and five pairs of frames
    #[arg(long)]
    quick: bool,
    /// Folder to write points.csv, index.html and the charts to
    #[arg(short, long = "out", value_name = "DIR", default_value = "chart")]
    out: PathBuf,
    /// Replace a report that is there already
    #[arg(long)]
    force: bool,
}

/// Pairs of a quick chart.
const QUICK_PAIRS: u32 = 5;

impl ChartArgs {
    fn pairs(&self) -> u32 {
        if self.quick { QUICK_PAIRS } else { self.pairs }
    }
}

/// A way with its figures, and its picture where one is shown.
struct Point {
    way: Way,
    label: String,
    figures: Figures,
    picture: Option<Picture>,
}

pub(super) fn run(args: &ChartArgs, output: &Output) -> Result<(), Failure> {
    let started = Instant::now();
    check_folder(&args.out, args.force)?;
    let mut measured = Measured::open(args, output)?;
    let points = measure(args, &mut measured, output)?;
    let report = report::report(args, &measured, &points)?;
    interrupt::stop_if_happened()?;
    let written = report.write(&args.out, args.force)?;

    let text: String = report.charts.iter().map(|chart| format!("{}\n", chart.title)).collect();
    let took = duration(started.elapsed());
    output.say(&format!(
        "{text}{}: {} ways, {} files; took {took}\n",
        args.out.display(),
        points.len(),
        written.len()
    ))?;
    let object = |point: &Point| {
        let mut object = json!(point.figures);
        object["way"] = point.label.as_str().into();
        object
    };
    let fronts = report.charts.iter().map(|chart| {
        let names: Vec<&str> = chart.front().into_iter().map(|i| chart.points[i].label.as_str()).collect();
        (chart.name.clone(), json!(names))
    });
    output.object(&json!({
        "adapter": measured.renderer.gpu.adapter,
        "files": written.iter().map(|path| path_text(path)).collect::<Vec<_>>(),
        "fronts": fronts.collect::<serde_json::Map<_, _>>(),
        "points": points.iter().map(object).collect::<Vec<_>>(),
        "milliseconds": milliseconds(started.elapsed()),
    }))
}

/// Measures all ways, one after another.
fn measure(args: &ChartArgs, measured: &mut Measured, output: &Output) -> Result<Vec<Point>, Failure> {
    let progress = Progress::new("measuring", output.quiet || output.json);
    let timer = FrameTimer::new(&measured.renderer.gpu);
    let Measured { renderer, mesh, gpu_mesh, target, maps, views, ways, .. } = measured;
    let choices: Vec<MapChoice> = maps.iter().map(|map| map.choice).collect();
    let setting = Setting { mesh: gpu_mesh, target, timer: &timer };
    let mut points: Vec<Point> = Vec::new();
    for (done, way) in ways.iter().enumerate() {
        interrupt::stop_if_happened()?;
        progress.set(done as f32 / ways.len() as f32);
        let (figures, picture) =
            measure_way(renderer, &setting, mesh, &maps[way.map], views, way, args.pairs()).map_err(failure::render)?;
        let drawn = points.iter().filter_map(|point| Some((&point.way, point.picture.as_ref()?)));
        if is_repeated(way, &picture, drawn) {
            continue;
        }
        let picture = Some(picture).filter(|_| way.map == 0);
        points.push(Point { way: *way, label: way.label(&choices), figures, picture });
    }
    Ok(points)
}
