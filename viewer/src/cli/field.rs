//! `tam-viewer field`.

use std::path::PathBuf;
use std::time::Instant;

use serde_json::json;
use tam_gen::command::words::{counted, duration, milliseconds, path_text};
use tam_gen::command::{Failure, Output, files, interrupt};
use tam_viewer::inspect::Inspection;
use tam_viewer::sheet::{Labelled, SheetText, labelled_sheet};
use tam_viewer::{Mapping, Method, RenderParams};

use super::render::check_png;
use super::report;
use super::subject::Subject;
use super::surface::{Wanted, needs_of};
use super::view::ViewArgs;

const EXAMPLES: &str = "\
Examples:
  tam-viewer field --mesh head --out head-field.png
  tam-viewer field --scene room.toml --out room.png
  tam-viewer field --mesh hand --field guides:strokes.json --out hand.png
  tam-viewer field --mesh ./statue.glb --field light --light -40,50 --out statue.png";

#[derive(Debug, clap::Args)]
#[command(after_help = EXAMPLES)]
pub(super) struct FieldArgs {
    #[command(flatten)]
    view: ViewArgs,
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
    let subject = Subject::open(&args.view, output)?;
    let size = [args.side; 2];
    let scene = subject.scene(None, size);
    let params = RenderParams { mapping: Mapping::Patches, ..subject.params(&args.view, Method::FineTone, size) };
    let making = Instant::now();
    let (mesh, needs) = (&subject.mesh, needs_of([params])?);
    let wanted = Wanted { mesh, needs, field: subject.field()?, params, look: &subject.look };
    let built = args.view.surface.build(wanted, output)?;
    let Some((cut, surface)) = built else { return Ok(()) };
    let fine = cut.as_ref().unwrap_or(mesh);
    let made = making.elapsed();
    interrupt::stop_if_happened()?;

    let inspection = Inspection::new(fine, &surface, &scene, size).map_err(|error| report::reference(&error))?;
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
        title: subject.mesh.name.clone(),
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
        "mesh": subject.mesh.name,
        "triangles": fine.triangles.len(),
        "nodes": surface.graph.len(),
        "singularities": { "plus": plus, "minus": minus },
        "patches": seeds,
        "patches_per_triangle": entries,
        "surface_milliseconds": milliseconds(made),
        "milliseconds": milliseconds(started.elapsed()),
    }))
}
