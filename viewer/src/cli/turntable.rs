//! `tam-viewer turntable`.

use std::path::PathBuf;
use std::time::Instant;

use clap::ValueEnum;
use glam::DVec3;
use serde_json::json;
use tam_gen::command::words::{duration, milliseconds, path_text};
use tam_gen::command::{Failure, Output, Progress, interrupt};
use tam_viewer::mesh::deform::Deform;
use tam_viewer::scene_file::value;
use tam_viewer::turntable::{FrameFile, FrameWriter, Path};
use tam_viewer::{Method, Scene};

use super::render::samples;
use super::report;
use super::stage::{Stage, Upload, Ways};
use super::view::{ViewArgs, method};

/// Phases at which the mesh is looked at to place the camera.
const GLANCES: u32 = 24;

const EXAMPLES: &str = "\
Examples:
  tam-viewer turntable                                          turntable.png, an animated PNG: once around a knot
  tam-viewer turntable --path light --mesh hand -o hand.gif
  tam-viewer turntable --path deform --deform wave --mesh torus-knot -o frames/
  tam-viewer turntable --path animation --mesh ./walk.glb --frames 120 --fps 30 -o walk.png

Frame 0 follows the last one without a jump. Ctrl-C leaves nothing half-written.";

#[derive(Debug, clap::Args)]
#[command(after_help = EXAMPLES)]
pub(super) struct TurntableArgs {
    /// What moves
    #[arg(long, value_enum, default_value = "orbit", help_heading = "What is drawn")]
    path: PathArg,
    /// The shading method [default: fine-tone]
    #[arg(long, value_name = "METHOD", value_parser = method(), help_heading = "How it is hatched")]
    method: Option<Method>,
    #[command(flatten)]
    view: ViewArgs,
    /// Number of frames
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(2..=10_000), default_value = "48")]
    frames: u32,
    /// Frames per second
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..=100), default_value = "24")]
    fps: u16,
    /// Sides of the frames in pixels
    #[arg(long, value_name = "WxH", value_parser = value::size, default_value = "512x512", allow_hyphen_values = true)]
    size: [u32; 2],
    /// Samples per pixel, 1 or 4
    #[arg(long, value_name = "N", value_parser = samples, default_value = "4", allow_hyphen_values = true)]
    samples: u32,
    /// A folder for PNG frames, or a file: .png (animated) or .gif
    #[arg(short, long, value_name = "DIR/|FILE", default_value = "turntable.png")]
    out: PathBuf,
    /// Replace what is there already
    #[arg(long)]
    force: bool,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
enum PathArg {
    /// The camera goes around the mesh
    Orbit,
    /// The lights go around the mesh
    Light,
    /// The camera comes near, and goes back
    Zoom,
    /// The animation of the file
    Animation,
    /// A deformation: that of --deform, or twist
    Deform,
}

impl TurntableArgs {
    /// What moves; the mesh bends as the scene says, or else it twists.
    fn path(&self, deform: Option<Deform>) -> Path {
        match self.path {
            PathArg::Orbit => Path::Orbit,
            PathArg::Light => Path::Light,
            PathArg::Zoom => Path::Zoom,
            PathArg::Animation => Path::Animation,
            PathArg::Deform => Path::Deform(deform.unwrap_or(Deform::Twist)),
        }
    }
}

pub(super) fn run(args: &TurntableArgs, output: &Output) -> Result<(), Failure> {
    let started = Instant::now();
    let file = FrameFile::of(&args.out).ok_or_else(|| {
        Failure::usage(
            format!("{} is of no kind that frames are written to", args.out.display()),
            "name a folder, a .png or a .gif",
        )
    })?;
    file.check(args.size, args.force).map_err(report::write)?;

    let posed = args.path != PathArg::Deform;
    let mut stage = Stage::open(&args.view, Ways::Own(args.method), args.size, args.samples, posed, output)?;
    let view = &stage.objects.file.view;
    if args.path == PathArg::Animation && view.time_s.is_some() {
        return Err(Failure::usage("--time stands still, and --path animation moves", "leave one of them out"));
    }
    let path = args.path(view.deform.map(|deformed| deformed.deform));
    let start_phase = view.deform.filter(|_| !posed).map_or(0.0, |deformed| deformed.phase);
    if path == Path::Animation && stage.uploads.iter().all(|upload| upload.mesh.animation.is_none()) {
        return Err(Failure::usage(
            format!("the mesh `{}` has no animation", stage.objects.name()),
            "glTF files may have one; --path deform moves any mesh",
        ));
    }
    let start = start_scene(path, &stage);
    let mut writer = FrameWriter::new(&file, args.size, args.frames, args.fps, args.force).map_err(report::write)?;
    let progress = Progress::new("drawing", output.quiet || output.json);
    let (mut positions, mut normals) = (Vec::new(), Vec::new());
    for frame in 0..args.frames {
        interrupt::stop_if_happened()?;
        progress.set(frame as f32 / args.frames as f32);
        let phase = f64::from(frame) / f64::from(args.frames);
        if path.moves_vertices() {
            for Upload { mesh, gpu } in &mut stage.uploads {
                path.positions(mesh, start_phase + phase, &mut positions);
                mesh.normals_of(&positions, &mut normals);
                gpu.update(&stage.renderer.gpu, &positions, &normals);
            }
        }
        stage.draw_plainly(&path.scene(&start, phase))?;
        writer.write(stage.picture()?).map_err(report::write)?;
    }
    drop(progress);
    interrupt::stop_if_happened()?;
    writer.finish().map_err(report::write)?;

    if !output.json {
        output.remark(stage.to_text().trim_end());
    }
    let [width, height] = args.size;
    let took = duration(started.elapsed());
    output.say(&format!(
        "{}: {} frames of {width} x {height} px at {} per second; took {took}\n",
        args.out.display(),
        args.frames,
        args.fps
    ))?;
    let mut object = stage.to_json();
    object["path"] = path_text(&args.out).into();
    object["moves"] = path.name().into();
    object["frames"] = args.frames.into();
    object["fps"] = args.fps.into();
    object["milliseconds"] = json!(milliseconds(started.elapsed()));
    output.object(&object)
}

/// The scene of phase 0, with the camera where the mesh stays in the picture all the way.
fn start_scene(path: Path, stage: &Stage) -> Scene {
    let mut start = stage.scene.clone();
    let camera = &stage.objects.file.view.camera;
    if !camera.fits_distance() || matches!(path, Path::Light | Path::Zoom) {
        return start;
    }
    // A camera that goes around looks at the axis it goes around.
    if path == Path::Orbit && camera.target.is_none() {
        start.camera.target = DVec3::ZERO;
    }
    let needed = (0..GLANCES).map(|glance| {
        let phase = f64::from(glance) / f64::from(GLANCES);
        stage.distance_for(&path.scene(&start, phase), |mesh, at| path.positions(mesh, phase, at))
    });
    start.camera.distance = needed.fold(0.0, f64::max);
    start
}
