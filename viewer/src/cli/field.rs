//! `tam-viewer field`.

use std::path::PathBuf;
use std::time::Instant;

use serde_json::json;
use tam_gen::command::words::{counted, duration, milliseconds, path_text};
use tam_gen::command::{Failure, Output, files, interrupt};
use tam_viewer::inspect::Inspection;
use tam_viewer::sheet::{Labelled, SheetText, labelled_sheet};
use tam_viewer::{Light, Mapping, Method, RenderParams, Scene, ranges};

use super::parse::{self, Orbit};
use super::render::check_png;
use super::stage::frame_mesh;
use super::surface::SurfaceArgs;
use super::{report, source};

const EXAMPLES: &str = "\
Examples:
  tam-viewer field --mesh head --out head-field.png
  tam-viewer field --mesh hand --field guides:strokes.json --out hand.png
  tam-viewer field --mesh ./statue.glb --field light --light -40,50 --out statue.png";

#[derive(Debug, clap::Args)]
#[command(after_help = EXAMPLES)]
pub(super) struct FieldArgs {
    /// A sample (see `tam-viewer meshes`), or an OBJ, glTF, GLB, PLY or STL file
    #[arg(long, value_name = "NAME|FILE", default_value = "head")]
    mesh: PathBuf,
    /// Triangles of a sample, about [default: where it looks right]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(2..=20_000_000))]
    triangles: Option<u32>,
    #[command(flatten)]
    surface: SurfaceArgs,
    /// Repeats of the tile per unit, for which patches are made [default: 1.5]
    #[arg(long, value_name = "N", value_parser = parse::in_range(ranges::TILES_PER_UNIT), allow_hyphen_values = true)]
    tiles: Option<f64>,
    /// Azimuth and elevation in degrees, and the distance [default: 30,18 and all in the picture]
    #[arg(long, value_name = "AZ,EL[,DIST]", value_parser = parse::orbit, allow_hyphen_values = true)]
    camera: Option<Orbit>,
    /// A light, for fields that follow it: AZ,EL from far, or at:X,Y,Z
    #[arg(long, value_name = "LIGHT", value_parser = parse::light, allow_hyphen_values = true)]
    light: Option<Light>,
    /// Side of each of the two pictures in pixels
    #[arg(long, value_name = "PX", value_parser = clap::value_parser!(u32).range(64..=4096), default_value = "900")]
    side: u32,
    /// Picture to write
    #[arg(short, long, value_name = "FILE.png")]
    out: PathBuf,
    /// Replace a picture that is there already
    #[arg(long)]
    force: bool,
}

pub(super) fn run(args: &FieldArgs, output: &Output) -> Result<(), Failure> {
    let started = Instant::now();
    check_png(&args.out)?;
    files::check_free(&args.out, args.force)?;
    interrupt::catch();
    let mesh = source::mesh(&args.mesh, args.triangles)?.mesh;
    let mut scene = Scene::of(&mesh);
    if let Some(light) = &args.light {
        scene.lights.lights = vec![light.clone()];
    }
    let size = [args.side; 2];
    if let Some(Orbit { azimuth_deg, elevation_deg, .. }) = args.camera {
        (scene.camera.azimuth_deg, scene.camera.elevation_deg) = (azimuth_deg, elevation_deg);
    }
    match args.camera.and_then(|orbit| orbit.distance) {
        Some(distance) => scene.camera.distance = distance,
        None => frame_mesh(&mut scene, &mesh.positions, size),
    }
    let tiles = args.tiles.unwrap_or(RenderParams::default().tiles_per_unit);
    let making = Instant::now();
    let built = args.surface.build(&mesh, &scene, &[Method::FineTone], &[Mapping::Patches], tiles, output)?;
    let Some((fine, surface)) = built else { return Ok(()) };
    let made = making.elapsed();
    interrupt::stop_if_happened()?;

    let inspection = Inspection::new(&fine, &surface, &scene, size).map_err(|error| report::reference(&error))?;
    let patches = surface.patches.as_ref();
    let indices = surface.field.indices(&surface.graph);
    let [plus, minus] = [1, -1].map(|sign| indices.iter().filter(|index| **index * sign > 0).count());
    let seeds = patches.map_or(0, |patches| patches.seeds.len());
    let entries = patches.map_or(0.0, |patches| patches.entries.len() as f64 / fine.triangles.len() as f64);
    let labelled = |picture, title: &str, remark| Labelled { picture, title: title.into(), remarks: vec![remark] };
    let mut row = vec![labelled(
        inspection.field(),
        "direction field",
        format!("singularities: {plus} turn with their surroundings (red), {minus} against them (blue)"),
    )];
    if let Some(patches) = patches {
        let remark =
            format!("{seeds} patches, {entries:.1} per triangle in the mean; dots and dashes: seeds and their axes");
        row.push(labelled(inspection.patches(patches), "patches", remark));
    }
    let text = SheetText {
        title: mesh.name.clone(),
        description: format!(
            "{}, field and patches made in {}",
            counted(fine.triangles.len(), "triangle"),
            duration(made)
        ),
        foot: String::new(),
    };
    let sheet = labelled_sheet(&text, &[row]);
    interrupt::stop_if_happened()?;
    files::write_picture(&args.out, &sheet, args.force)?;
    let (width, height) = sheet.dimensions();
    output.say(&format!(
        "{}: {width} x {height} px; {}, {}; took {}\n",
        args.out.display(),
        counted(plus + minus, "singularity").replace("singularitys", "singularities"),
        counted(seeds, "patch").replace("patchs", "patches"),
        duration(started.elapsed())
    ))?;
    output.object(&json!({
        "path": path_text(&args.out),
        "mesh": mesh.name,
        "triangles": fine.triangles.len(),
        "nodes": surface.graph.len(),
        "singularities": { "plus": plus, "minus": minus },
        "patches": seeds,
        "patches_per_triangle": entries,
        "surface_milliseconds": milliseconds(made),
        "milliseconds": milliseconds(started.elapsed()),
    }))
}
