//! `tam-viewer turntable`.

use std::path::PathBuf;
use std::time::Instant;

use clap::ValueEnum;
use glam::{DVec3, Vec3};
use serde_json::json;
use tam_gen::command::words::{duration, milliseconds, path_text};
use tam_gen::command::{Failure, Output, Progress, interrupt};
use tam_viewer::gpu::GpuMap;
use tam_viewer::mesh::deform::Deform;
use tam_viewer::turntable::{FrameFile, FrameWriter, Path};
use tam_viewer::{Method, Scene};

use super::render::samples;
use super::stage::{Stage, distance_for};
use super::view::{ViewArgs, method};
use super::{parse, report};

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
    /// The shading method
    #[arg(long, value_name = "METHOD", value_parser = method(), default_value = "fine-tone", help_heading = "How it is hatched")]
    method: Method,
    #[command(flatten)]
    view: ViewArgs,
    /// Number of frames
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(2..=10_000), default_value = "48")]
    frames: u32,
    /// Frames per second
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..=100), default_value = "24")]
    fps: u16,
    /// Sides of the frames in pixels
    #[arg(long, value_name = "WxH", value_parser = parse::size, default_value = "512x512", allow_hyphen_values = true)]
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
    fn path(&self) -> Result<Path, Failure> {
        if self.path == PathArg::Animation && self.view.time.is_some() {
            return Err(Failure::usage("--time stands still, and --path animation moves", "leave one of them out"));
        }
        Ok(match self.path {
            PathArg::Orbit => Path::Orbit,
            PathArg::Light => Path::Light,
            PathArg::Zoom => Path::Zoom,
            PathArg::Animation => Path::Animation,
            PathArg::Deform => Path::Deform(self.view.deform.map_or(Deform::Twist, |deformed| deformed.deform)),
        })
    }
}

pub(super) fn run(args: &TurntableArgs, output: &Output) -> Result<(), Failure> {
    let started = Instant::now();
    let path = args.path()?;
    let file = FrameFile::of(&args.out).ok_or_else(|| {
        Failure::usage(
            format!("{} is of no kind that frames are written to", args.out.display()),
            "name a folder, a .png or a .gif",
        )
    })?;
    file.check(args.size, args.force).map_err(report::write)?;

    let posed = !matches!(path, Path::Deform(_));
    let mut stage = Stage::open(&args.view, &[args.method], None, args.size, args.samples, posed, output)?;
    if path == Path::Animation && stage.loaded.mesh.animation.is_none() {
        return Err(Failure::usage(
            format!("the mesh `{}` has no animation", stage.loaded.mesh.name),
            "glTF files may have one; --path deform moves any mesh",
        ));
    }
    let start_phase = args.view.deform.filter(|_| !posed).map_or(0.0, |deformed| deformed.phase);
    let start = start_scene(args, path, &stage);
    let params = args.view.params(args.method, &stage.loaded.mesh, args.size);
    let mut writer = FrameWriter::new(&file, args.size, args.frames, args.fps, args.force).map_err(report::write)?;
    let progress = Progress::new("drawing", output.quiet || output.json);
    let (mut positions, mut normals) = (Vec::new(), Vec::new());
    for frame in 0..args.frames {
        interrupt::stop_if_happened()?;
        progress.set(frame as f32 / args.frames as f32);
        let phase = f64::from(frame) / f64::from(args.frames);
        let Stage { renderer, loaded, mesh, maps, target, .. } = &mut stage;
        if path.moves_vertices() {
            path.positions(&loaded.mesh, start_phase + phase, &mut positions);
            loaded.mesh.normals_of(&positions, &mut normals);
            mesh.update(&renderer.gpu, &positions, &normals);
        }
        let maps: Vec<&GpuMap> = maps.iter().collect();
        renderer.render(&path.scene(&start, phase), &params, mesh, &maps, target).map_err(report::render)?;
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
fn start_scene(args: &TurntableArgs, path: Path, stage: &Stage) -> Scene {
    let mut start = stage.scene.clone();
    if !args.view.fits_distance() || matches!(path, Path::Light | Path::Zoom) {
        return start;
    }
    // A camera that goes around looks at the axis it goes around.
    if path == Path::Orbit && args.view.target.is_none() {
        start.camera.target = DVec3::ZERO;
    }
    let mesh = &stage.loaded.mesh;
    let mut positions: Vec<Vec3> = Vec::new();
    let needed = (0..GLANCES).map(|glance| {
        let phase = f64::from(glance) / f64::from(GLANCES);
        path.positions(mesh, phase, &mut positions);
        distance_for(&path.scene(&start, phase), &positions, args.size)
    });
    start.camera.distance = needed.fold(0.0, f64::max);
    start
}
