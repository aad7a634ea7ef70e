//! Everything that a picture needs, loaded, uploaded and set up.

use std::time::Duration;

use glam::{DVec3, Vec3};
use image::RgbaImage;
use serde_json::{Value, json};
use tam_gen::command::words::{counted, milliseconds, size};
use tam_gen::command::{Failure, Output, interrupt};
use tam_viewer::gpu::{Gpu, GpuMap, GpuMesh, PixelFormat, Target};
use tam_viewer::mesh::{Loaded, Mesh};
use tam_viewer::{FrameTimer, Mapping, Method, RenderError, RenderParams, Renderer, Scene};

use super::view::ViewArgs;
use super::{report, source};

/// Part of the picture's sides left free around the mesh.
const MARGIN: f64 = 0.07;

/// Everything that a picture needs.
pub(super) struct Stage {
    pub(super) renderer: Renderer,
    pub(super) loaded: Loaded,
    pub(super) mesh: GpuMesh,
    pub(super) maps: Vec<GpuMap>,
    pub(super) scene: Scene,
    pub(super) target: Target,
}

impl Stage {
    /// Loads mesh and maps, opens the adapter, uploads, and places the camera.
    ///
    /// `methods` are those that will draw; they decide what is made of the maps; `mappings` are those that
    /// they will draw with, where it is not the one of the view. `posed` moves the mesh as time and
    /// deformation say, else it is at rest.
    pub(super) fn open(
        view: &ViewArgs,
        methods: &[Method],
        mappings: Option<&[Mapping]>,
        size: [u32; 2],
        samples: u32,
        posed: bool,
        output: &Output,
    ) -> Result<Self, Failure> {
        let cancel = interrupt::catch();
        let mut loaded = source::mesh(&view.mesh, view.triangles)?;
        notes(&loaded, output);
        if posed {
            pose(&mut loaded.mesh, view)?;
        }
        let renderer = Renderer::new(Gpu::open(&view.adapter.options()).map_err(report::gpu)?);
        let target = renderer.target(size, samples, PixelFormat::Srgb8).map_err(report::gpu)?;
        interrupt::stop_if_happened()?;

        let main = source::map(&view.map, methods, cancel, output)?;
        let colours = source::colours(&main);
        let mut maps = vec![renderer.map(main)];
        let mut numbers = Vec::new();
        for object in &view.object {
            numbers.push(match &object.map {
                Some(path) => {
                    maps.push(renderer.map(source::map(path, methods, cancel, output)?));
                    Some(maps.len() - 1)
                }
                None => None,
            });
        }
        let mut scene = view.scene(&loaded.mesh, colours, &numbers)?;
        place_camera(&mut scene, view, &loaded.mesh.positions, size);
        let params = view.params(Method::Phong, &loaded.mesh, size);
        let own = [params.mapping];
        let mapped = methods.iter().any(|method| method.takes_mapping());
        let mappings = if mapped { mappings.unwrap_or(&own) } else { &[] };
        let surface = view.surface.build(&loaded.mesh, &scene, methods, mappings, &params, output)?;
        let surface = surface.map(|(mesh, surface)| {
            loaded.mesh = mesh;
            surface
        });
        let mut mesh = renderer.mesh(&loaded.mesh).map_err(report::gpu)?;
        if let Some(surface) = &surface {
            renderer.attach(&mut mesh, surface).map_err(report::gpu)?;
        }
        interrupt::stop_if_happened()?;
        Ok(Self { renderer, loaded, mesh, maps, scene, target })
    }

    /// Draws a scene; the time it took on the device.
    pub(super) fn draw(
        &mut self,
        scene: &Scene,
        params: &RenderParams,
        timer: &FrameTimer,
    ) -> Result<Duration, Failure> {
        let Self { renderer, mesh, maps, target, .. } = self;
        let maps: Vec<&GpuMap> = maps.iter().collect();
        timer
            .time(renderer, |renderer, timer| -> Result<(), RenderError> {
                renderer.render_timed(scene, params, mesh, &maps, target, Some(timer))
            })
            .map_err(report::render)
    }

    /// The pixels last drawn.
    pub(super) fn picture(&self) -> Result<RgbaImage, Failure> {
        Ok(self.target.read(&self.renderer.gpu).map_err(report::gpu)?.into_image())
    }

    /// What was drawn with what, in a few lines.
    pub(super) fn to_text(&self) -> String {
        let mesh = &self.loaded.mesh;
        let map = &self.maps[0].source;
        let strokes = if map.stroke_map.is_some() { "and a stroke map" } else { "no stroke map" };
        let per_triangle = self.mesh.bytes() as f64 / f64::from(self.mesh.triangle_count());
        format!(
            "adapter: {}\nmesh: {}, {}, {}, {} on the GPU ({per_triangle:.0} B per triangle)\nmap: {}, {}, {} px, {strokes}, {} on the GPU\n",
            self.renderer.gpu.adapter,
            mesh.name,
            counted(mesh.triangles.len(), "triangle"),
            counted(mesh.parts.len(), "object"),
            size(self.mesh.bytes()),
            map.name,
            counted(map.grid.columns(), "tone"),
            map.grid.levels.first().map_or(0, |level| level.size),
            size(self.maps.iter().map(GpuMap::bytes).sum()),
        )
    }

    /// The same for machines.
    pub(super) fn to_json(&self) -> Value {
        let mesh = &self.loaded.mesh;
        let map = &self.maps[0].source;
        json!({
            "adapter": self.renderer.gpu.adapter,
            "mesh": {
                "name": mesh.name,
                "triangles": mesh.triangles.len(),
                "vertices": mesh.positions.len(),
                "objects": mesh.parts.iter().map(|part| part.name.as_str()).collect::<Vec<_>>(),
                "animated": mesh.animation.is_some(),
                "gpu_bytes": self.mesh.bytes(),
                "gpu_bytes_per_triangle": self.mesh.bytes() as f64 / f64::from(self.mesh.triangle_count()),
                "notes": self.loaded.report.notes(),
                "report": self.loaded.report,
            },
            "map": {
                "name": map.name,
                "tones": map.grid.tones,
                "size": map.grid.levels.first().map_or(0, |level| level.size),
                "stroke_map": map.stroke_map.is_some(),
                "gpu_bytes": self.maps.iter().map(GpuMap::bytes).sum::<u64>(),
            },
            "size": self.target.size,
            "camera": self.scene.camera,
        })
    }
}

/// A method and how it lies on the mesh, for machines.
pub(super) fn params_json(params: &RenderParams, frame: Duration) -> Value {
    let mapping = params.method.takes_mapping().then_some(params.mapping);
    json!({
        "method": params.method,
        "mapping": mapping,
        "form": params.form,
        "frame_ms": milliseconds(frame),
    })
}

/// Says what was found and mended in a mesh.
fn notes(loaded: &Loaded, output: &Output) {
    if !output.json {
        loaded.report.notes().iter().for_each(|note| output.remark(&format!("note: {note}")));
    }
}

/// Moves the vertices to where time and deformation want them.
pub(super) fn pose(mesh: &mut Mesh, view: &ViewArgs) -> Result<(), Failure> {
    if view.time.is_some() && mesh.animation.is_none() {
        return Err(Failure::usage(
            format!("--time: the mesh `{}` has no animation", mesh.name),
            "glTF files may have one; --deform moves any mesh",
        ));
    }
    let mut positions: Vec<Vec3> = Vec::new();
    if let Some(time_s) = view.time {
        mesh.pose(time_s, &mut positions);
        std::mem::swap(&mut mesh.positions, &mut positions);
    }
    if let Some(deformed) = view.deform {
        deformed.deform.apply(deformed.phase as f32, &mesh.positions, &mut positions);
        std::mem::swap(&mut mesh.positions, &mut positions);
    }
    if view.time.is_some() || view.deform.is_some() {
        let mut normals = Vec::new();
        mesh.normals_of(&mesh.positions, &mut normals);
        mesh.normals = normals;
    }
    Ok(())
}

/// Puts the whole mesh into the picture, as far as the user leaves the camera free.
pub(super) fn place_camera(scene: &mut Scene, view: &ViewArgs, positions: &[Vec3], size: [u32; 2]) {
    match (view.fits_distance(), view.target) {
        (true, None) => frame_mesh(scene, positions, size),
        (true, Some(_)) => scene.camera.distance = distance_for(scene, positions, size),
        (false, _) => {}
    }
}

/// Turns the camera to the middle of the mesh, at the distance at which it fills the picture.
pub(super) fn frame_mesh(scene: &mut Scene, positions: &[Vec3], size: [u32; 2]) {
    let points = placed(scene, positions);
    scene.camera.frame_points(&points, f64::from(size[0]) / f64::from(size[1]), MARGIN);
}

/// The scene on paper and in ink of these colours, where they are known.
pub(super) fn with_colours(mut scene: Scene, colours: Option<([f32; 3], [f32; 3])>) -> Scene {
    if let Some((paper, ink)) = colours {
        (scene.paper, scene.ink) = (paper, ink);
    }
    scene
}

/// Vertices in the world.
fn placed(scene: &Scene, positions: &[Vec3]) -> Vec<DVec3> {
    positions.iter().map(|position| scene.world_from_mesh.transform_point3(position.as_dvec3())).collect()
}

/// The distance at which the mesh is in the picture.
pub(super) fn distance_for(scene: &Scene, positions: &[Vec3], size: [u32; 2]) -> f64 {
    scene.camera.fit_points(placed(scene, positions), f64::from(size[0]) / f64::from(size[1]), MARGIN)
}
