//! `tam-viewer meshes`.

use std::path::PathBuf;

use serde_json::{Value, json};
use tam_gen::command::words::path_text;
use tam_gen::command::{Failure, Output, Progress, files, interrupt};
use tam_viewer::gpu::{Gpu, PixelFormat};
use tam_viewer::mesh::prepare;
use tam_viewer::mesh::sample::Sample;
use tam_viewer::scene_file;
use tam_viewer::sheet::{Labelled, SheetText, labelled_sheet};
use tam_viewer::{Mapping, Method, RenderParams, Renderer, Scene, Silhouettes};

use super::render::check_png;
use super::stage::place_camera;
use super::view::{AdapterArgs, line_width_px, method};
use super::{report, source};

/// Pictures beside each other on the sheet.
const ACROSS: usize = 4;

const EXAMPLES: &str = "\
Examples:
  tam-viewer meshes                                       the samples
  tam-viewer meshes --sheet meshes.png                    what they look like
  tam-viewer meshes --sheet meshes.png --map engraving --method stroke-map";

#[derive(Debug, clap::Args)]
#[command(after_help = EXAMPLES)]
pub(super) struct MeshesArgs {
    /// Draw all of them on one sheet
    #[arg(long, value_name = "FILE.png")]
    sheet: Option<PathBuf>,
    /// Preset or map to draw with
    #[arg(long, value_name = "PRESET|FILE", default_value = "pencil", requires = "sheet")]
    map: PathBuf,
    /// Method to draw with
    #[arg(long, value_name = "METHOD", value_parser = method(), default_value = "fine-tone", requires = "sheet")]
    method: Method,
    /// Side of each picture in pixels
    #[arg(long, value_name = "PX", value_parser = clap::value_parser!(u32).range(32..=2048), default_value = "420", requires = "sheet")]
    side: u32,
    /// Replace a sheet that is there already
    #[arg(long)]
    force: bool,
    #[command(flatten)]
    adapter: AdapterArgs,
}

pub(super) fn run(args: &MeshesArgs, output: &Output) -> Result<(), Failure> {
    if let Some(path) = &args.sheet {
        check_png(path)?;
        files::check_free(path, args.force)?;
        let sheet = sheet(args, output)?;
        files::write_picture(path, &sheet, args.force)?;
        let (width, height) = sheet.dimensions();
        output.say(&format!("{}: {width} x {height} px\n", path.display()))?;
        return output.object(&json!({ "path": path_text(path), "width": width, "height": height }));
    }
    let width = Sample::ALL.iter().map(|sample| sample.name().len()).max().unwrap_or(0);
    let text: String = Sample::ALL
        .iter()
        .map(|sample| {
            format!(
                "{:<width$}  {:>6} triangles  {}\n",
                sample.name(),
                sample.default_triangles(),
                sample.description()
            )
        })
        .collect();
    output.result(&text, || {
        let list = Sample::ALL.iter().map(|sample| {
            json!({
                "name": sample.name(),
                "triangles": sample.default_triangles(),
                "least_triangles": sample.least_triangles(),
                "description": sample.description(),
            })
        });
        json!({ "meshes": list.collect::<Vec<Value>>() })
    })
}

fn sheet(args: &MeshesArgs, output: &Output) -> Result<image::RgbImage, Failure> {
    let cancel = interrupt::catch();
    let mut renderer = Renderer::new(Gpu::open(&args.adapter.options()).map_err(report::gpu)?);
    let map = source::map(&args.map, &[args.method], cancel, output)?;
    let colours = source::colours(&map);
    let map = renderer.map(map);
    let size = [args.side; 2];
    let target = renderer.target(size, 4, PixelFormat::Srgb8).map_err(report::gpu)?;
    let progress = Progress::new("drawing", output.quiet || output.json);
    let mut pictures = Vec::new();
    for (sample, k) in Sample::ALL.into_iter().zip(0..) {
        progress.set(k as f32 / Sample::ALL.len() as f32);
        interrupt::stop_if_happened()?;
        let mesh = prepare(sample.build(sample.default_triangles())).map_err(report::mesh)?.mesh;
        let mut scene = Scene::of(&mesh);
        if let Some((paper, ink)) = colours {
            (scene.paper, scene.ink) = (paper, ink);
        }
        let points: Vec<_> = mesh.positions.iter().map(|position| position.as_dvec3()).collect();
        place_camera(&mut scene.camera, &scene_file::Camera::default(), &points, size);
        let params = RenderParams {
            method: args.method,
            mapping: Mapping::of(&mesh),
            silhouettes: Some(Silhouettes { width_px: line_width_px(size), ..Silhouettes::default() }),
            ..RenderParams::default()
        };
        let on_gpu = renderer.mesh(&mesh).map_err(report::gpu)?;
        renderer.render(&scene, &params, &on_gpu, &[&map], &target).map_err(report::render)?;
        let picture = target.read(&renderer.gpu).map_err(report::gpu)?.into_image();
        let remarks = vec![format!("{} triangles", mesh.triangles.len()), sample.description().to_owned()];
        pictures.push(Labelled { picture, title: sample.name().to_owned(), remarks });
    }
    let text = SheetText {
        title: "Sample meshes".into(),
        description: format!("{} with the map {}, {} px each", args.method.name(), map.source.name, args.side),
        foot: String::new(),
    };
    let rows: Vec<Vec<Labelled>> = pictures.chunks(ACROSS).map(<[_]>::to_vec).collect();
    Ok(labelled_sheet(&text, &rows))
}
