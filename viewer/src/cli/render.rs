//! `tam-viewer render`.

use std::path::PathBuf;
use std::time::{Duration, Instant};

use serde_json::json;
use tam_gen::command::words::{duration, milliseconds, path_text};
use tam_gen::command::{Failure, Output, files, interrupt};
use tam_viewer::scene_file::value;
use tam_viewer::{FrameTimer, Method};

use super::stage::{Stage, Ways, params_json};
use super::view::{ViewArgs, method};

const EXAMPLES: &str = "\
Examples:
  tam-viewer render                                              torus-knot.png: a knot in pencil
  tam-viewer render --mesh torus-knot --map engraving --method stroke-map
  tam-viewer render --mesh ./statue.glb --camera 40,10 --light -30,60 --light at:2,1,2,0.5
  tam-viewer render --mesh chair --object 'seat:map=woodcut,rotate=30' --size 2000x1500 -o chair.png
  tam-viewer render --mesh chair --mesh teapot --place teapot:0,0.6,0.1,40,0.4 --object 'teapot:method=stripes'
  tam-viewer render --scene room.toml                            many objects, each with a look (tam-viewer schema)
  tam-viewer render --method face-frame --form literal --lines none --json

Exit status:
  0    the picture is written
  1    something it needs is not as it should be: adapter, mesh, map, or the place to write
  2    the arguments make no sense
  130  interrupted: nothing was written";

#[derive(Debug, clap::Args)]
#[command(after_help = EXAMPLES)]
pub(super) struct RenderArgs {
    /// The shading method [default: fine-tone]
    #[arg(long, value_name = "METHOD", value_parser = method(), help_heading = "How it is hatched")]
    method: Option<Method>,
    #[command(flatten)]
    view: ViewArgs,
    /// Sides of the picture in pixels
    #[arg(long, value_name = "WxH", value_parser = value::size, default_value = "1024x1024", allow_hyphen_values = true)]
    size: [u32; 2],
    /// Samples per pixel, 1 or 4
    #[arg(long, value_name = "N", value_parser = samples, default_value = "4", allow_hyphen_values = true)]
    samples: u32,
    /// Picture to write [default: MESH.png or SCENE.png here]
    #[arg(short, long, value_name = "FILE.png")]
    out: Option<PathBuf>,
    /// Replace a picture that is there already
    #[arg(long)]
    force: bool,
}

/// Pictures that take longer are drawn once: beside that, what pipelines and maps cost is little.
const DRAWN_TWICE: Duration = Duration::from_millis(500);

/// Reads a number of samples per pixel.
pub(super) fn samples(text: &str) -> Result<u32, String> {
    match text {
        "1" => Ok(1),
        "4" => Ok(4),
        _ => Err(format!("{text} samples per pixel are not drawn; allowed: 1 or 4")),
    }
}

pub(super) fn run(args: &RenderArgs, output: &Output) -> Result<(), Failure> {
    let started = Instant::now();
    let path = args.out.clone().unwrap_or_else(|| PathBuf::from(format!("{}.png", args.view.stem())));
    check_png(&path)?;
    files::check_free(&path, args.force)?;

    let mut stage = Stage::open(&args.view, Ways::Own(args.method), args.size, args.samples, true, output)?;
    let timer = FrameTimer::new(&stage.renderer.gpu);
    let scene = stage.scene.clone();
    let mut frame = stage.draw(&scene, |own, _| *own, &timer)?;
    // The first frame makes pipelines and uploads the map; the second is what a frame takes. Nobody waits long for that.
    if frame < DRAWN_TWICE {
        frame = stage.draw(&scene, |own, _| *own, &timer)?;
    }
    let picture = stage.picture()?;
    interrupt::stop_if_happened()?;
    files::write_picture(&path, &picture, args.force)?;

    let [width, height] = args.size;
    if !output.json {
        output.remark(&format!("{}frame: {} ({})", stage.to_text(), duration(frame), looks(&stage)));
    }
    output.say(&format!("{}: {width} x {height} px; took {}\n", path.display(), duration(started.elapsed())))?;
    let mut object = stage.to_json();
    object["path"] = path_text(&path).into();
    object["frame"] = params_json(&stage.drawn[0].params, frame);
    object["milliseconds"] = json!(milliseconds(started.elapsed()));
    output.object(&object)
}

/// By what it was drawn: the method where all objects have the same.
fn looks(stage: &Stage) -> String {
    let mut methods: Vec<&str> = Vec::new();
    for name in stage.drawn.iter().map(|drawn| drawn.params.method.name()) {
        if !methods.contains(&name) {
            methods.push(name);
        }
    }
    methods.join(", ")
}

/// Pictures are PNG, and named so.
pub(super) fn check_png(path: &std::path::Path) -> Result<(), Failure> {
    if path.extension().is_some_and(|extension| extension.eq_ignore_ascii_case("png")) {
        return Ok(());
    }
    Err(Failure::usage(
        format!("{} is no name of a PNG picture", path.display()),
        "pictures are written as PNG: name one that ends in .png",
    ))
}
