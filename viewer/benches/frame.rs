//! What a frame costs: every method as a ratio to `phong`, interleaved, over triangles and picture sizes; the forms of
//! `face-frame` against each other; strokes that follow the form; and what loading and uploading take.
//!
//! `cargo bench -p tam-viewer --bench frame -- [--quick] [--triangles N] [--only NAME;NAME] [--csv FILE]`. Rows are appended
//! to the file as they are measured, with the adapter's name, median and quartiles. Times are of the device where it has timestamps.
#![allow(missing_docs, clippy::print_stdout)]

use std::fmt::Write as _;
use std::io::Write as _;
use std::time::Instant;

use tam_gen::{Job, Preset};
use tam_viewer::gpu::{Gpu, GpuMap, GpuMesh, GpuOptions, PixelFormat, Target};
use tam_viewer::maps::HatchMap;
use tam_viewer::mesh::sample::Sample;
use tam_viewer::mesh::{Mesh, prepare};
use tam_viewer::surface::{LappedOptions, PatchOptions, StripeOptions, Surface, SurfaceOptions};
use tam_viewer::{
    FaceFrameForm, FrameTimer, Light, Mapping, Method, RenderError, RenderParams, Renderer, Scene, Silhouettes,
};

type Error = Box<dyn std::error::Error>;

/// A way to draw, with its name in the table.
struct Way {
    name: &'static str,
    params: RenderParams,
    /// The light turns from frame to frame, so that the frames of the faces are made anew.
    light_turns: bool,
    /// It draws with the mesh's surface.
    on_surface: bool,
}

/// Triangles up to which meshes are given a surface, which takes seconds to make.
const SURFACE_MOST: usize = 600_000;

fn ways() -> Vec<Way> {
    let base = RenderParams { mapping: Mapping::Uv, silhouettes: None, ..RenderParams::default() };
    let way =
        |name, method| Way { name, params: RenderParams { method, ..base }, light_turns: false, on_surface: false };
    let frames = |name, face_frame, light_turns| Way {
        name,
        params: RenderParams { method: Method::FaceFrame, face_frame, ..base },
        light_turns,
        on_surface: false,
    };
    let on = |name, mapping, method| Way {
        params: RenderParams { method, mapping, cross_from: None, ..base },
        on_surface: true,
        ..way(name, method)
    };
    let stripes = |name, cross_from, variety| {
        let stripes = on(name, Mapping::Uv, Method::Stripes);
        Way { params: RenderParams { cross_from, variety, ..stripes.params }, ..stripes }
    };
    let lined = RenderParams { method: Method::Phong, silhouettes: Some(Silhouettes::default()), ..base };
    vec![
        way("phong", Method::Phong),
        way("six-way", Method::SixWay),
        way("stroke-map", Method::StrokeMap),
        way("halftone", Method::Halftone),
        way("fine-tone", Method::FineTone),
        frames("face-frame", FaceFrameForm::VertexFetched, false),
        frames("face-frame, light turning", FaceFrameForm::VertexFetched, true),
        frames("face-frame in the vertex stage", FaceFrameForm::Vertex, false),
        frames("face-frame fetched by fragments", FaceFrameForm::Fetched, false),
        Way { name: "phong with lines", params: lined, light_turns: false, on_surface: false },
        on("six-way, patches", Mapping::Patches, Method::SixWay),
        on("stroke-map, patches", Mapping::Patches, Method::StrokeMap),
        on("fine-tone, patches", Mapping::Patches, Method::FineTone),
        on("six-way, lapped", Mapping::Lapped, Method::SixWay),
        on("stroke-map, lapped", Mapping::Lapped, Method::StrokeMap),
        stripes("stripes", None, 0.0),
        stripes("stripes, crossed", base.cross_from, 0.0),
        stripes("stripes, varied", None, 0.6),
    ]
}

struct Setting<'a> {
    scene: Scene,
    mesh: &'a GpuMesh,
    map: &'a GpuMap,
    target: &'a Target,
    timer: &'a FrameTimer,
}

/// Time of one frame, in milliseconds.
fn frame(renderer: &mut Renderer, setting: &mut Setting<'_>, way: &Way, number: usize) -> Result<f64, Error> {
    if way.light_turns {
        setting.scene.lights.lights[0] = Light::from_angles(number as f64, 40.0);
    }
    let Setting { scene, mesh, map, target, timer } = setting;
    let time = timer.time::<RenderError>(renderer, |renderer, timer| {
        renderer.render_timed(scene, &way.params, mesh, &[map], target, Some(timer))
    })?;
    Ok(time.as_secs_f64() * 1e3)
}

/// Median and quartiles, in milliseconds.
struct Times {
    median: f64,
    quartiles: [f64; 2],
}

impl Times {
    fn of(mut times: Vec<f64>) -> Self {
        times.sort_by(f64::total_cmp);
        let at = |quarter: usize| times[(times.len() - 1) * quarter / 4];
        Self { median: at(2), quartiles: [at(1), at(3)] }
    }
}

fn load(renderer: &Renderer, triangles: usize) -> Result<(Mesh, GpuMesh), Error> {
    let raw = Sample::TorusKnot.build(triangles);
    let start = Instant::now();
    let mesh = prepare(raw)?.mesh;
    let prepared = start.elapsed().as_secs_f64();
    let start = Instant::now();
    let mut gpu_mesh = renderer.mesh(&mesh)?;
    renderer.gpu.wait()?;
    let uploaded = start.elapsed().as_secs_f64();
    println!(
        "\n{} triangles: prepared in {:.0} ms, uploaded in {:.0} ms, {:.0} bytes per triangle on the device",
        mesh.triangles.len(),
        prepared * 1e3,
        uploaded * 1e3,
        gpu_mesh.bytes() as f64 / mesh.triangles.len() as f64
    );
    if mesh.triangles.len() <= SURFACE_MOST {
        let options = SurfaceOptions {
            patches: Some(PatchOptions::default()),
            lapped: Some(LappedOptions::default()),
            stripes: Some(StripeOptions::default()),
            ..SurfaceOptions::default()
        };
        let start = Instant::now();
        renderer.attach(&mut gpu_mesh, &Surface::new(&mesh, &options)?)?;
        renderer.gpu.wait()?;
        println!("  surface in {:.0} ms", start.elapsed().as_secs_f64() * 1e3);
    }
    Ok((mesh, gpu_mesh))
}

fn main() -> Result<(), Error> {
    let args: Vec<String> = std::env::args().skip(1).collect();
    // `cargo test --benches` only asks whether it builds.
    if args.iter().any(|arg| arg == "--test") {
        return Ok(());
    }
    let quick = args.iter().any(|arg| arg == "--quick");
    let value = |option: &str| args.iter().position(|arg| arg == option).and_then(|i| args.get(i + 1));
    let (csv, named) = (value("--csv"), value("--only"));
    let (counts, sizes, rounds): (&[usize], &[u32], usize) = if quick {
        (&[1_000, 50_000], &[512], 5)
    } else {
        (&[1_000, 20_000, 100_000, 500_000, 2_000_000], &[512, 1024], 31)
    };

    let only: Option<usize> = value("--triangles").map(|n| n.parse()).transpose()?;
    // A file of other columns is told before anything is measured.
    if let Some(path) = csv {
        append(path, "")?;
    }
    let mut renderer = Renderer::new(Gpu::open(&GpuOptions::default())?);
    let adapter = renderer.gpu.adapter.clone();
    let timer = FrameTimer::new(&renderer.gpu);
    println!("{adapter}");
    let preset = Preset::named("pencil").ok_or("an embedded preset")??;
    let map = renderer.map(HatchMap::from_preset("pencil", &preset, &Job::default())?);
    for triangles in counts.iter().filter(|count| only.is_none_or(|only| only == **count)) {
        let (mesh, gpu_mesh) = load(&renderer, *triangles)?;
        // Millions of triangles take long on a software adapter.
        let rounds = if *triangles > 1_000_000 { rounds.min(9) } else { rounds };
        for size in sizes {
            let target = renderer.target([*size, *size], 1, PixelFormat::Srgb8)?;
            let mut scene = Scene::of(&mesh);
            scene.camera.distance = scene.camera.fit_distance(gpu_mesh.radius(), 1.0);
            let mut setting = Setting { scene, mesh: &gpu_mesh, map: &map, target: &target, timer: &timer };
            let mut ways = ways();
            let is_wanted = |way: &Way| named.is_none_or(|named| named.split(';').any(|name| name == way.name));
            ways.retain(|way| way.name == "phong" || is_wanted(way));
            ways.retain(|way| !way.on_surface || mesh.triangles.len() <= SURFACE_MOST);
            let mut times = vec![Vec::new(); ways.len()];
            for round in 0..rounds + 2 {
                for (way, times) in ways.iter().zip(&mut times) {
                    let time = frame(&mut renderer, &mut setting, way, round)?;
                    // The first two frames make pipelines and faces.
                    if round >= 2 {
                        times.push(time);
                    }
                }
            }
            let mut table = String::new();
            let times: Vec<Times> = times.into_iter().map(Times::of).collect();
            println!("  {size}x{size}, {rounds} frames each");
            for (way, Times { median, quartiles: [low, high] }) in ways.iter().zip(&times) {
                let ratio = median / times[0].median;
                println!("    {:32} {median:8.2} ms  {ratio:5.2} x phong", way.name);
                writeln!(
                    table,
                    "\"{}\",{},{},{size},\"{}\",{median:.4},{ratio:.3},{rounds},{low:.4},{high:.4}",
                    adapter.name,
                    adapter.kind,
                    mesh.triangles.len(),
                    way.name
                )?;
            }
            if let Some(path) = csv {
                append(path, &table)?;
            }
        }
    }
    Ok(())
}

const HEADING: &str =
    "adapter,kind,triangles,side_px,method,median_ms,ratio_to_phong,frames,quartile_1_ms,quartile_3_ms";

/// Appends rows, below a heading where the file is new, to a file of the same columns.
fn append(path: &str, table: &str) -> Result<(), Error> {
    let text = if std::path::Path::new(path).exists() { std::fs::read_to_string(path)? } else { String::new() };
    if text.lines().next().is_some_and(|heading| heading != HEADING) {
        return Err(format!("{path} has other columns: name a new file").into());
    }
    let mut file = std::fs::OpenOptions::new().create(true).append(true).open(path)?;
    if text.is_empty() {
        writeln!(file, "{HEADING}")?;
    }
    Ok(file.write_all(table.as_bytes())?)
}
