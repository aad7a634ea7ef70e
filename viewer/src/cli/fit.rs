//! `tam-viewer fit`.

use std::path::{Path, PathBuf};
use std::time::Instant;

use image::{GenericImage, RgbaImage};
use serde_json::{Value, json};
use tam_gen::command::words::{counted, duration, milliseconds, path_text, size};
use tam_gen::command::{Failure, Output, Progress, files, interrupt};
use tam_gen::export::{ExportOptions, export};
use tam_gen::{Job, Preset};
use tam_viewer::chart::Setting;
use tam_viewer::fit::{Bench, Fit, FitError, FitMap, FitOptions, FitRange, Tried, fit};
use tam_viewer::gpu::{Gpu, GpuMesh, PixelFormat, Target};
use tam_viewer::maps::HatchMap;
use tam_viewer::mesh::Mesh;
use tam_viewer::ranges::{self, Range};
use tam_viewer::scene_file::value;
use tam_viewer::{FrameTimer, Mapping, Method, RenderParams, Renderer, Scene};

use super::subject;
use super::surface::{Wanted, needs_of};
use super::view::{ViewArgs, mapping, method};
use super::{report, source};

const EXAMPLES: &str = "\
Examples:
  tam-viewer fit --mesh hand                                       from half the distance to twice it
  tam-viewer fit --mesh head --map fine-pen --camera-range 1:4 --light-range -60:60 --out head-fit
  tam-viewer fit --mesh ./mine.obj --orbit-range 0:360 --error 0.03
  tam-viewer fit --mesh hand --methods stripes,halftone,six-way    lines without a map will do as well

The error is the root mean square of the drawn tone less the wanted one, in linear ink, in the worst view. What is
recommended was drawn into all views and holds; what is cheaper was seen to fail.";

#[derive(Debug, clap::Args)]
#[command(after_help = EXAMPLES)]
pub(super) struct FitArgs {
    #[command(flatten)]
    view: ViewArgs,
    /// The method that the scene is drawn with now
    #[arg(long, value_name = "METHOD", value_parser = method(), default_value = "fine-tone", help_heading = "How it is hatched")]
    method: Method,
    /// Methods that may take its place, between commas [default: six-way, fine-tone, and the present one]
    #[arg(long, value_name = "METHODS", value_parser = method(), value_delimiter = ',', help_heading = "What is tried")]
    methods: Vec<Method>,
    /// Mappings that may take its place, between commas [default: the present one]
    #[arg(long, value_name = "MAPPINGS", value_parser = mapping(), value_delimiter = ',', help_heading = "What is tried")]
    mappings: Vec<Mapping>,
    /// Distances of the camera, as multiples of that which shows the whole mesh
    #[arg(long, value_name = "NEAR:FAR", value_parser = range(ranges::FIT_DISTANCE), default_value = "0.5:2", help_heading = "What is tried")]
    camera_range: [f64; 2],
    /// Turns of the camera about the upright axis, in degrees
    #[arg(long, value_name = "FROM:TO", value_parser = range(ranges::FIT_TURN_DEG), default_value = "0:0", allow_hyphen_values = true, help_heading = "What is tried")]
    orbit_range: [f64; 2],
    /// Turns of the lights about the upright axis, in degrees
    #[arg(long, value_name = "FROM:TO", value_parser = range(ranges::FIT_TURN_DEG), default_value = "-30:30", allow_hyphen_values = true, help_heading = "What is tried")]
    light_range: [f64; 2],
    /// Greatest error of tone in any view, in linear ink
    #[arg(long, value_name = "ERROR", value_parser = value::in_range(ranges::FIT_ERROR), default_value = "0.02")]
    error: f64,
    /// Sides of the pictures
    #[arg(long, value_name = "WxH", value_parser = value::size, default_value = "384x384", allow_hyphen_values = true)]
    size: [u32; 2],
    /// Pairs of frames that are timed, of which the median counts
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(5..=1000), default_value = "7")]
    pairs: u32,
    /// Folder to write the trimmed preset, its map, fit.json and a picture of both to
    #[arg(short, long, value_name = "DIR")]
    out: Option<PathBuf>,
    /// Replace files that are there already
    #[arg(long)]
    force: bool,
}

/// Two numbers in order, with a colon between them.
fn range(allowed: Range) -> impl Fn(&str) -> Result<[f64; 2], String> + Clone + Send + Sync + 'static {
    let number = value::in_range(allowed);
    move |text| {
        let (from, to) = text.split_once(':').ok_or_else(|| format!("{text:?}: two numbers are expected, like 1:2"))?;
        let range = [number(from)?, number(to)?];
        if range[0] <= range[1] { Ok(range) } else { Err(format!("{text:?}: the smaller number comes first")) }
    }
}

/// Methods that may take the place of the present one where none is named: those that draw the map's cells, so that what
/// is seen stays the same. Stroke maps are crisper, and lines have no strokes of the map.
const METHODS: [Method; 2] = [Method::SixWay, Method::FineTone];

/// What is measured on.
struct Subject {
    renderer: Renderer,
    mesh: Mesh,
    gpu_mesh: GpuMesh,
    target: Target,
    name: String,
    preset: Preset,
    scene: Scene,
    full: RenderParams,
    ways: Vec<RenderParams>,
}

pub(super) fn run(args: &FitArgs, output: &Output) -> Result<(), Failure> {
    let started = Instant::now();
    interrupt::catch();
    let mut subject = Subject::open(args, output)?;
    let out = args.out.as_deref().map(|dir| Files::new(dir, &subject.name, args.force)).transpose()?;
    let timer = FrameTimer::new(&subject.renderer.gpu);
    let range = FitRange { distance: args.camera_range, orbit_deg: args.orbit_range, light_deg: args.light_range };
    let found = {
        let progress = Progress::new("fitting", output.quiet || output.json);
        let report = |part| progress.set(part);
        let job = Job { progress: Some(&report), cancel: Some(interrupt::flag()), measure: None };
        let Subject { renderer, mesh, gpu_mesh, target, name, preset, scene, full, ways } = &mut subject;
        let setting = Setting { mesh: gpu_mesh, target, timer: &timer };
        let options = FitOptions { range, error: args.error, full: *full, ways, pairs: args.pairs };
        fit(&mut Bench { renderer, setting, mesh, name, preset }, scene, &options, &job).map_err(failure)?
    };
    let mut text = to_text(args, &subject, &found);
    let mut written = Vec::new();
    if let Some(out) = out {
        written = out.write(&mut subject, args, &found)?;
        text += &format!("{}: {}\n", out.dir.display(), counted(written.len(), "file"));
    }
    text += &format!("took {}\n", duration(started.elapsed()));
    output.say(&text)?;
    let mut object = to_json(args, &found);
    object["files"] = written.iter().map(|path| path_text(path)).collect();
    object["adapter"] = json!(subject.renderer.gpu.adapter);
    object["milliseconds"] = milliseconds(started.elapsed()).into();
    output.object(&object)
}

impl Subject {
    fn open(args: &FitArgs, output: &Output) -> Result<Self, Failure> {
        let view = &args.view;
        let given = subject::Subject::open(view, output)?;
        given.check_still("one map that lies still on the surface is fitted")?;
        let mut mesh = given.mesh.clone();
        let mappings = if args.mappings.is_empty() { vec![given.mapping()] } else { args.mappings.clone() };
        if mappings.contains(&Mapping::Uv) && mesh.uvs.is_empty() {
            return Err(Failure::usage(format!("the mesh `{}` has no uv", mesh.name), "the other mappings need none"));
        }
        let mut methods = if args.methods.is_empty() { METHODS.to_vec() } else { args.methods.clone() };
        if args.methods.is_empty() && !methods.contains(&args.method) && args.method != Method::Phong {
            methods.push(args.method);
        }
        if methods.contains(&Method::Phong) {
            return Err(Failure::usage("phong draws no strokes", "name methods that hatch"));
        }
        let renderer = Renderer::new(Gpu::open(&view.adapter.options()).map_err(report::gpu)?);
        let target = renderer.target(args.size, 1, PixelFormat::Linear16).map_err(report::gpu)?;
        let map = source::map(given.map(), &[], interrupt::flag(), output)?;
        let (name, colours) = (map.name.clone(), source::colours(&map));
        let preset = map.preset.ok_or_else(|| {
            Failure::usage("the map has no preset, so that no smaller one can be made", "give --map a preset")
        })?;
        let scene = given.scene(colours, args.size);
        let plain =
            |method, mapping| RenderParams { mapping, silhouettes: None, ..given.params(view, method, args.size) };
        let full = plain(args.method, given.mapping());
        let mut ways: Vec<RenderParams> = Vec::new();
        for method in &methods {
            let count = if method.takes_mapping() { mappings.len() } else { 1 };
            ways.extend(mappings[..count].iter().map(|mapping| plain(*method, *mapping)));
        }
        let mut needed = methods;
        needed.push(args.method);
        let mut laid = mappings;
        laid.push(full.mapping);
        let needs = needs_of(given.ways(&full, &needed, &laid))?;
        let wanted = Wanted { mesh: &mesh, needs, field: given.field()?, params: full, look: &given.look };
        let built = view.surface.build(wanted, output)?;
        let (cut, surface) = built.unzip();
        mesh = cut.flatten().unwrap_or(mesh);
        let mut gpu_mesh = renderer.mesh(&mesh).map_err(report::gpu)?;
        if let Some(surface) = surface {
            renderer.attach(&mut gpu_mesh, &surface).map_err(report::gpu)?;
        }
        Ok(Self { renderer, mesh, gpu_mesh, target, name, preset, scene, full, ways })
    }

    /// What a way draws of a scene.
    fn picture(&mut self, tried: &Tried, scene: &Scene) -> Result<RgbaImage, Failure> {
        let preset = tried.map.unwrap_or(FitMap::of(&self.preset)).preset(&self.preset);
        let map = self.renderer.map(HatchMap::from_preset(&self.name, &preset, &Job::default())?);
        let target = self.renderer.target(self.target.size, 4, PixelFormat::Srgb8).map_err(report::gpu)?;
        self.renderer.render(scene, &tried.params, &self.gpu_mesh, &[&map], &target).map_err(report::render)?;
        Ok(target.read(&self.renderer.gpu).map_err(report::gpu)?.into_image())
    }
}

fn failure(error: FitError) -> Failure {
    match error {
        FitError::Render(error) => report::render(error),
        FitError::Reference(error) => report::reference(&error),
        FitError::Generate(error) => error.into(),
        FitError::OutOfReach { .. } => Failure::Work {
            kind: "fit",
            message: error.to_string(),
            help: Some("allow a greater --error, a narrower range, or other --methods".into()),
        },
        FitError::Unseen(_) => Failure::Work {
            kind: "fit",
            message: error.to_string(),
            help: Some("choose another --camera-range".into()),
        },
    }
}

/// The files of a fit.
struct Files<'a> {
    dir: &'a Path,
    name: String,
    force: bool,
}

impl<'a> Files<'a> {
    /// Refuses a folder that cannot take them, before work is put into them.
    fn new(dir: &'a Path, map: &str, force: bool) -> Result<Self, Failure> {
        files::check_folder(dir, "--out")?;
        let files = Self { dir, name: format!("{map}-fitted"), force };
        for path in [files.report(), files.preset(), files.picture()] {
            files::check_free(&path, force)?;
        }
        Ok(files)
    }

    fn report(&self) -> PathBuf {
        self.dir.join("fit.json")
    }

    fn preset(&self) -> PathBuf {
        self.dir.join(format!("{}.toml", self.name))
    }

    fn picture(&self) -> PathBuf {
        self.dir.join("fit.png")
    }

    fn write(&self, subject: &mut Subject, args: &FitArgs, found: &Fit) -> Result<Vec<PathBuf>, Failure> {
        let mut written = vec![self.report(), self.picture()];
        let report = serde_json::to_string_pretty(&to_json(args, found)).unwrap_or_default();
        files::write(&self.report(), report.as_bytes(), self.force)?;
        let sides = [&found.full, &found.best].map(|tried| subject.picture(tried, &found.scene));
        let [left, right] = sides;
        let (left, right) = (left?, right?);
        let mut both = RgbaImage::new(left.width() + right.width(), left.height());
        for (x, side) in [(0, &left), (left.width(), &right)] {
            // They are as large as the room made for them.
            let _ = both.copy_from(side, x, 0);
        }
        files::write_picture(&self.picture(), &both, self.force)?;
        if let Some(map) = found.best.map {
            let preset = map.preset(&subject.preset);
            files::write(&self.preset(), preset.to_toml().as_bytes(), self.force)?;
            written.push(self.preset());
            let made = tam_gen::generate(&preset, &Job::default())?;
            let options = ExportOptions { overwrite: self.force, ..ExportOptions::default() };
            let exported = export(&made, &self.name, self.dir, &options, &Job::default())?;
            written.extend(exported.into_iter().map(|file| file.path));
        }
        Ok(written)
    }
}

fn to_text(args: &FitArgs, subject: &Subject, found: &Fit) -> String {
    let row = |title: &str, tried: &Tried| {
        let (what, worst) = match &tried.missed {
            Some(missed) => ("levels are missed: ink changes by", missed),
            None => ("error", &tried.worst),
        };
        format!(
            "{title:<7} {:<48} {:>10} {:>6.2}x phong   {what} {:.4} at {}\n",
            tried.label(),
            size(tried.bytes),
            tried.cost_ratio,
            worst.error,
            worst.view
        )
    };
    let mut text = format!(
        "{} in {}: error of tone at most {} in {}\n",
        subject.mesh.name,
        subject.name,
        args.error,
        counted(found.views, "view")
    );
    text += &row("now", &found.full);
    text += &row("fitted", &found.best);
    let [memory, frame] = found.saved_percent();
    text += &format!("saves {memory:.0} % of the memory and {frame:.0} % of the frame\n");
    for tried in &found.failing {
        text += &row("fails", tried);
    }
    if found.failing.is_empty() {
        text += "nothing cheaper was left to try\n";
    }
    text
}

fn to_json(args: &FitArgs, found: &Fit) -> Value {
    let entry = |tried: &Tried| {
        json!({
            "way": tried.way(),
            "params": tried.params,
            "map": tried.map,
            "bytes": tried.bytes,
            "cost_ratio": tried.cost_ratio,
            "error": tried.worst.error,
            "view": tried.worst.view,
            "missed_levels": tried.missed,
        })
    };
    json!({
        "error": args.error,
        "camera_range": args.camera_range,
        "orbit_range_deg": args.orbit_range,
        "light_range_deg": args.light_range,
        "views": found.views,
        "now": entry(&found.full),
        "fitted": entry(&found.best),
        "failing": found.failing.iter().map(entry).collect::<Vec<_>>(),
    })
}
