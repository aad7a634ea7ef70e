//! What is measured: the scene, loaded and uploaded, with its views and all ways to draw it.

use tam_gen::Job;
use tam_gen::command::{Failure, Output, Progress, interrupt};
use tam_viewer::chart::{MapChoice, Maps, Views, Way, WaysOptions, ways};
use tam_viewer::gpu::{Gpu, GpuMesh, PixelFormat, Target};
use tam_viewer::measure::Strokes;
use tam_viewer::mesh::Mesh;
use tam_viewer::surface::{Surface, SurfaceOptions};
use tam_viewer::{Form, Mapping, Method, RenderParams, Renderer};

use super::super::subject::Subject;
use super::super::surface::{Wanted, needs_of};
use super::super::{report, source};
use super::{ChartArgs, MAPPINGS};

/// Everything that the figures are measured of.
pub(super) struct Measured {
    pub(super) renderer: Renderer,
    pub(super) mesh: Mesh,
    pub(super) gpu_mesh: GpuMesh,
    pub(super) target: Target,
    pub(super) map_name: String,
    pub(super) maps: Vec<Maps>,
    pub(super) views: Views,
    pub(super) ways: Vec<Way>,
}

impl Measured {
    /// Loads mesh and maps, opens the adapter, makes the surface, and sets up the views.
    pub(super) fn open(args: &ChartArgs, output: &Output) -> Result<Self, Failure> {
        let view = &args.view;
        interrupt::catch();
        let subject = Subject::open(view, output)?;
        subject.check_still("a chart compares ways to draw with one map that lies still on the surface")?;
        let mesh = &subject.mesh;
        let methods = if args.methods.is_empty() { Method::ALL.to_vec() } else { args.methods.clone() };
        let mappings = mappings(args, &subject)?;
        let renderer = Renderer::new(Gpu::open(&view.adapter.options()).map_err(report::gpu)?);
        // Half floats, so that small changes are not lost in steps of the picture's own.
        let target = renderer.target(args.size, 1, PixelFormat::Linear16).map_err(report::gpu)?;
        let (map_name, maps, colours) = maps(args, &subject, output)?;
        let scene = subject.scene(colours, args.size);
        let params = subject.params(view, Method::Phong, args.size);
        let (mesh, surface) = surface(args, &subject, mesh, &params, &methods, &mappings, output)?;
        let mut gpu_mesh = renderer.mesh(&mesh).map_err(report::gpu)?;
        renderer.attach(&mut gpu_mesh, &surface).map_err(report::gpu)?;
        interrupt::stop_if_happened()?;
        let strokes = Strokes { graph: &surface.graph, field: &surface.field };
        let views = Views::new(&mesh, &scene, args.size, Some(strokes)).map_err(|error| report::reference(&error))?;
        let choices: Vec<MapChoice> = maps.iter().map(|map| map.choice).collect();
        let crossing = surface.stripes.as_ref().is_some_and(|stripes| !stripes.across.is_empty());
        let mut ways = ways(&WaysOptions {
            base: params,
            methods: &methods,
            mappings: &mappings,
            maps: &choices,
            stroke_maps: maps.iter().all(|map| map.whole.stroke_map.is_some()),
            stripes: [crossing, surface.patches.is_some()],
        });
        if args.quick {
            ways.retain(|way| way.params.form == Form::Hardened);
        }
        Ok(Self { renderer, mesh, gpu_mesh, target, map_name, maps, views, ways })
    }
}

/// The mappings asked for, or those that the mesh has.
fn mappings(args: &ChartArgs, subject: &Subject) -> Result<Vec<Mapping>, Failure> {
    let mesh = &subject.mesh;
    let given = if args.view.mapping_given() { vec![subject.mapping()] } else { args.mappings.clone() };
    if given.contains(&Mapping::Uv) && mesh.uvs.is_empty() {
        return Err(Failure::usage(format!("the mesh `{}` has no uv", mesh.name), "the other mappings need none"));
    }
    if !given.is_empty() {
        return Ok(given);
    }
    Ok(MAPPINGS.into_iter().filter(|mapping| *mapping != Mapping::Uv || !mesh.uvs.is_empty()).collect())
}

/// The maps in all sizes and tones, the name of what they are of, and the colours of paper and ink.
type NamedMaps = (String, Vec<Maps>, Option<([f32; 3], [f32; 3])>);

fn maps(args: &ChartArgs, subject: &Subject, output: &Output) -> Result<NamedMaps, Failure> {
    let cancel = interrupt::flag();
    let map = source::map(subject.map(), &[], cancel, output)?;
    let (name, colours) = (map.name.clone(), source::colours(&map));
    let Some(preset) = map.preset.clone() else {
        output.remark("note: the map has no preset, so it is measured in its own size and tones only");
        return Ok((name, vec![Maps::of(map)], colours));
    };
    let tones = preset.map.tones.count() as u32;
    let mut choices: Vec<(u32, Option<u32>)> = args.sizes.iter().map(|size| (*size, None)).collect();
    choices.extend(args.tones.iter().filter(|count| **count != tones).map(|count| (args.sizes[0], Some(*count))));
    if args.quick {
        choices.truncate(1);
    }
    let progress = Progress::new("generating", output.quiet || output.json);
    let mut maps: Vec<Maps> = Vec::new();
    for (size, tones) in &choices {
        progress.set(maps.len() as f32 / choices.len() as f32);
        let job = Job { progress: None, cancel: Some(cancel), measure: None };
        maps.push(Maps::generate(&name, &preset, *size, *tones, &job)?);
    }
    Ok((name, maps, colours))
}

/// The surface for all methods and mappings, and the mesh that it belongs to; the field alone where none needs more.
fn surface(
    args: &ChartArgs,
    subject: &Subject,
    mesh: &Mesh,
    params: &RenderParams,
    methods: &[Method],
    mappings: &[Mapping],
    output: &Output,
) -> Result<(Mesh, Surface), Failure> {
    // Varied stripes are charted beside plain ones.
    let params = RenderParams { variety: 1.0, ..*params };
    let needs = needs_of(subject.ways(&params, methods, mappings))?;
    let wanted = Wanted { mesh, needs, field: subject.field()?, params, look: &subject.look };
    if let Some((cut, surface)) = args.view.surface.build(wanted, output)? {
        return Ok((cut.unwrap_or_else(|| mesh.clone()), surface));
    }
    let options = SurfaceOptions { field: subject.field()?, ..SurfaceOptions::default() };
    let job = Job { progress: None, cancel: Some(interrupt::flag()), measure: None };
    let surface = Surface::new_with(mesh, &options, &job).map_err(report::surface)?;
    Ok((mesh.clone(), surface))
}
