//! Everything that a picture needs, loaded, uploaded and set up.

use std::borrow::Cow;
use std::path::{Path, PathBuf};
use std::time::Duration;

use glam::{DMat4, DVec3, Vec3};
use image::RgbaImage;
use serde_json::{Value, json};
use tam_gen::command::words::{counted, milliseconds, size};
use tam_gen::command::{Failure, Output, Progress, interrupt};
use tam_viewer::gpu::{Gpu, GpuMap, GpuMesh, PixelFormat, Target};
use tam_viewer::mesh::Mesh;
use tam_viewer::scene_file::{self, LookEntry};
use tam_viewer::surface::{FieldOptions, SurfaceNeeds};
use tam_viewer::{Camera, FrameTimer, Mapping, Material, Method, Object, RenderError, RenderParams, Renderer, Scene};

use super::objects::Objects;
use super::surface::{Wanted, field, needs_of};
use super::view::ViewArgs;
use super::{report, source};

/// Part of the picture's sides left free around the objects.
const MARGIN: f64 = 0.07;

/// Points up to which the picture is fitted to each of them, else to the boxes around the meshes.
const POINTS_MAX: usize = 4_000_000;

/// The map where none is named.
pub(super) const DEFAULT_MAP: &str = "pencil";

/// How the objects will be drawn; it decides what is made of maps and surfaces.
#[derive(Clone, Copy)]
pub(super) enum Ways<'a> {
    /// Each in its own look, by this method where one is named and the object names none.
    Own(Option<Method>),
    /// All by each of these methods, with each of these mappings, or with its own where none are named.
    Each(&'a [Method], Option<&'a [Mapping]>),
}

/// Everything that a picture needs.
pub(super) struct Stage {
    pub(super) renderer: Renderer,
    pub(super) objects: Objects,
    /// Meshes with their surfaces, each once.
    pub(super) uploads: Vec<Upload>,
    pub(super) drawn: Vec<Drawn>,
    pub(super) maps: Vec<GpuMap>,
    pub(super) scene: Scene,
    pub(super) target: Target,
    output: Output,
}

/// A mesh with a surface, on the device.
pub(super) struct Upload {
    pub(super) mesh: Mesh,
    pub(super) gpu: GpuMesh,
}

/// An object, or a part of one, as it is drawn.
pub(super) struct Drawn {
    pub(super) name: String,
    /// Number of its mesh.
    upload: usize,
    world_from_mesh: DMat4,
    pub(super) params: RenderParams,
    ink: [f32; 3],
    materials: Vec<Material>,
}

/// Pieces of one mesh whose surface is made with the same options.
struct Group<'a> {
    /// The mesh, and which parts of it.
    of: (usize, &'a [usize]),
    look: &'a LookEntry,
    field: FieldOptions,
    params: RenderParams,
    needs: SurfaceNeeds,
}

impl Group<'_> {
    /// Whether one surface serves both.
    fn serves(&self, other: &Self) -> bool {
        let options = |group: &Self| {
            let RenderParams { tiles_per_unit, follow, .. } = group.params;
            (tiles_per_unit, follow, group.look.planar.unwrap_or(false), group.look.stripes)
        };
        let without = |needs: SurfaceNeeds| needs == SurfaceNeeds::default();
        let same = options(self) == options(other) && self.field == other.field;
        self.of == other.of && (same || without(self.needs) || without(other.needs))
    }
}

impl Stage {
    /// Loads meshes and maps, opens the adapter, uploads, and places the camera. `posed` moves the meshes as time and
    /// deformation say, else they are at rest.
    pub(super) fn open(
        view: &ViewArgs,
        ways: Ways<'_>,
        size: [u32; 2],
        samples: u32,
        posed: bool,
        output: &Output,
    ) -> Result<Self, Failure> {
        interrupt::catch();
        let method = if let Ways::Own(method) = ways { method } else { None };
        let objects = Objects::open(view, method, posed, output)?;
        let renderer = Renderer::new(Gpu::open(&view.adapter.options()).map_err(report::gpu)?);
        let target = renderer.target(size, samples, PixelFormat::Srgb8).map_err(report::gpu)?;
        interrupt::stop_if_happened()?;

        let lights = objects.file.view.scene(None).lights;
        let mut all_maps = Maps::default();
        let main = &objects.file.look.map;
        // Paper and ink are those of the map of all, where any part is drawn with it.
        if objects.pieces.iter().flat_map(|piece| &piece.looks).any(|look| look.map == *main) {
            all_maps.number(main.as_deref(), std::iter::empty());
        }
        let mut drawn = Vec::with_capacity(objects.pieces.len());
        let mut groups: Vec<Group<'_>> = Vec::new();
        for piece in &objects.pieces {
            let mesh = &objects.loaded[objects.mesh_number(piece)].mesh;
            let params = view.params(&piece.look, !mesh.uvs.is_empty(), size);
            let drawn_by: Vec<RenderParams> = ways.of(&params, mesh);
            let mut materials = objects.materials(piece);
            for (material, look) in materials.iter_mut().zip(&piece.looks) {
                material.map = all_maps.number(look.map.as_deref(), drawn_by.iter().map(|way| way.method));
            }
            let needs = needs_of(drawn_by)?;
            let field = if needs == SurfaceNeeds::default() {
                FieldOptions::default()
            } else {
                field(&piece.look, mesh, &lights, piece.world_from_mesh)?
            };
            let group =
                Group { of: (objects.mesh_number(piece), &piece.parts), look: &piece.look, field, params, needs };
            let upload = match groups.iter_mut().position(|known| known.serves(&group)) {
                Some(number) => {
                    let known = &mut groups[number];
                    let needs = known.needs.and(group.needs);
                    if known.needs == SurfaceNeeds::default() {
                        *known = group;
                    }
                    known.needs = needs;
                    number
                }
                None => {
                    groups.push(group);
                    groups.len() - 1
                }
            };
            let object = &objects.file.objects[piece.object];
            drawn.push(Drawn {
                name: object.name.clone(),
                upload,
                world_from_mesh: piece.world_from_mesh,
                params,
                ink: [0.0; 3],
                materials,
            });
        }
        let times = view.times_as_high(size);
        let maps = all_maps.load(&renderer, times, output)?;
        let colours = source::colours(&maps[0].source);
        let mut scene = objects.file.view.scene(colours);
        scene.ink = objects.file.look.ink.map_or(scene.ink, |ink| ink.0);
        scene.inspect = view.inspect(size);
        for (drawn, piece) in drawn.iter_mut().zip(&objects.pieces) {
            drawn.ink = piece.look.ink.map_or(scene.ink, |ink| ink.0);
            if times != 1.0 {
                let texels = drawn.materials.first().map_or(1, |material| maps[material.map].source.texels);
                drawn.params = drawn.params.times_as_high(times, texels.into());
            }
        }
        let uploads = upload(view, &renderer, &objects, groups, output)?;
        interrupt::stop_if_happened()?;
        let mut stage = Self { renderer, objects, uploads, drawn, maps, scene, target, output: *output };
        stage.place_camera();
        Ok(stage)
    }

    /// Draws a scene, each object in its look as `change` has it; the time it took on the device. An interruption ends it on
    /// the spot: nothing may be half-written meanwhile.
    pub(super) fn draw(
        &mut self,
        scene: &Scene,
        change: impl Fn(&RenderParams, &Mesh) -> RenderParams,
        timer: &FrameTimer,
    ) -> Result<Duration, Failure> {
        let Self { renderer, uploads, drawn, maps, target, output, .. } = self;
        let maps: Vec<&GpuMap> = maps.iter().collect();
        let looks: Vec<RenderParams> =
            drawn.iter().map(|drawn| change(&drawn.params, &uploads[drawn.upload].mesh)).collect();
        let objects = placed(uploads, drawn, &looks);
        let drawn = interrupt::at_once(output, || {
            timer.time(renderer, |renderer, timer| -> Result<(), RenderError> {
                renderer.render_objects(scene, &objects, &maps, target, Some(timer))
            })
        });
        drawn?.map_err(report::render)
    }

    /// The same in their own looks, untimed, and never left in the middle.
    pub(super) fn draw_plainly(&mut self, scene: &Scene) -> Result<(), Failure> {
        let Self { renderer, uploads, drawn, maps, target, .. } = self;
        let maps: Vec<&GpuMap> = maps.iter().collect();
        let looks: Vec<RenderParams> = drawn.iter().map(|drawn| drawn.params).collect();
        let objects = placed(uploads, drawn, &looks);
        renderer.render_objects(scene, &objects, &maps, target, None).map_err(report::render)
    }

    /// The pixels last drawn.
    pub(super) fn picture(&self) -> Result<RgbaImage, Failure> {
        Ok(self.target.read(&self.renderer.gpu).map_err(report::gpu)?.into_image())
    }

    /// The distance at which all objects are in the picture, their vertices where `moved` puts them.
    pub(super) fn distance_for(&self, scene: &Scene, mut moved: impl FnMut(&Mesh, &mut Vec<Vec3>)) -> f64 {
        scene.camera.fit_points(self.points(&mut moved), aspect(self.target.size), MARGIN)
    }

    /// Puts all objects into the picture, as far as the user leaves the camera free.
    fn place_camera(&mut self) {
        let points = self.points(&mut |mesh: &Mesh, at: &mut Vec<Vec3>| at.clone_from(&mesh.positions));
        place_camera(&mut self.scene.camera, &self.objects.file.view.camera, &points, self.target.size);
    }

    /// Vertices of all objects in the world; of very many the boxes around them.
    fn points(&self, moved: &mut dyn FnMut(&Mesh, &mut Vec<Vec3>)) -> Vec<DVec3> {
        let mut positions: Vec<Vec<Vec3>> = vec![Vec::new(); self.uploads.len()];
        for (upload, positions) in self.uploads.iter().zip(&mut positions) {
            moved(&upload.mesh, positions);
        }
        if self.drawn.iter().map(|drawn| positions[drawn.upload].len()).sum::<usize>() > POINTS_MAX {
            positions.iter_mut().for_each(|positions| *positions = corners(positions));
        }
        let place = |drawn: &Drawn| {
            let world = drawn.world_from_mesh;
            let positions = &positions[drawn.upload];
            positions.iter().map(move |position| world.transform_point3(position.as_dvec3())).collect::<Vec<_>>()
        };
        self.drawn.iter().flat_map(place).collect()
    }

    /// Triangles of all that is drawn.
    pub(super) fn triangles(&self) -> usize {
        self.drawn.iter().map(|drawn| self.uploads[drawn.upload].mesh.triangles.len()).sum()
    }

    fn bytes(&self) -> u64 {
        self.uploads.iter().map(|upload| upload.gpu.bytes()).sum()
    }

    /// What was drawn with what, in a few lines.
    pub(super) fn to_text(&self) -> String {
        let map = &self.maps[0].source;
        let strokes = if map.stroke_map.is_some() { "and a stroke map" } else { "no stroke map" };
        let per_triangle = self.bytes() as f64
            / self.uploads.iter().map(|upload| upload.mesh.triangles.len()).sum::<usize>().max(1) as f64;
        let parts: usize = self.drawn.iter().map(|drawn| self.uploads[drawn.upload].mesh.parts.len()).sum();
        let (what, name) = match self.objects.file.objects.len() {
            1 => ("mesh", self.objects.name()),
            _ => ("scene", self.objects.name()),
        };
        format!(
            "adapter: {}\n{what}: {name}, {}, {}, {} on the GPU ({per_triangle:.0} B per triangle)\nmap: {}, {}, {} px, {strokes}, {} on the GPU\n",
            self.renderer.gpu.adapter,
            counted(self.triangles(), "triangle"),
            counted(parts, if what == "mesh" { "object" } else { "part" }),
            size(self.bytes()),
            map.name,
            counted(map.grid.columns(), "tone"),
            map.grid.levels.first().map_or(0, |level| level.size),
            size(self.maps.iter().map(GpuMap::bytes).sum()),
        )
    }

    /// The same for machines.
    pub(super) fn to_json(&self) -> Value {
        let Upload { mesh, gpu } = &self.uploads[0];
        let loaded = &self.objects.loaded[0];
        let map = &self.maps[0].source;
        let object = |drawn: &Drawn| {
            let params = &drawn.params;
            json!({
                "name": drawn.name,
                "mesh": self.uploads[drawn.upload].mesh.name,
                "parts": self.uploads[drawn.upload].mesh.parts.iter().map(|part| part.name.as_str()).collect::<Vec<_>>(),
                "method": params.method,
                "mapping": params.method.takes_mapping().then_some(params.mapping),
                "form": params.form,
            })
        };
        json!({
            "adapter": self.renderer.gpu.adapter,
            "mesh": {
                "name": mesh.name,
                "triangles": mesh.triangles.len(),
                "vertices": mesh.positions.len(),
                "objects": mesh.parts.iter().map(|part| part.name.as_str()).collect::<Vec<_>>(),
                "animated": mesh.animation.is_some(),
                "gpu_bytes": gpu.bytes(),
                "gpu_bytes_per_triangle": gpu.bytes() as f64 / f64::from(gpu.triangle_count()),
                "notes": loaded.report.notes(),
                "report": loaded.report,
            },
            "objects": self.drawn.iter().map(object).collect::<Vec<_>>(),
            "triangles": self.triangles(),
            "gpu_bytes": self.bytes(),
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

/// Objects as the renderer takes them, in these looks.
fn placed<'a>(uploads: &'a [Upload], drawn: &'a [Drawn], looks: &'a [RenderParams]) -> Vec<Object<'a>> {
    let object = |(drawn, params): (&'a Drawn, &'a RenderParams)| Object {
        mesh: &uploads[drawn.upload].gpu,
        world_from_mesh: drawn.world_from_mesh,
        params,
        ink: drawn.ink,
        materials: &drawn.materials,
    };
    drawn.iter().zip(looks).map(object).collect()
}

impl Ways<'_> {
    /// All ways in which an object of this look is drawn.
    pub(super) fn of(self, params: &RenderParams, mesh: &Mesh) -> Vec<RenderParams> {
        let Self::Each(methods, mappings) = self else { return vec![*params] };
        let own = [params.mapping];
        let mappings = mappings.unwrap_or(&own);
        let way = |method: &Method, mapping: &Mapping| way_on(params, *method, *mapping, mesh);
        let of = |method: &Method| {
            let mappings = if method.takes_mapping() { mappings } else { &own };
            mappings.iter().map(|mapping| way(method, mapping)).collect::<Vec<_>>()
        };
        methods.iter().flat_map(of).collect()
    }
}

/// A look drawn by another method and mapping; where a mesh has no uv, patches stand in for them.
pub(super) fn way_on(params: &RenderParams, method: Method, mapping: Mapping, mesh: &Mesh) -> RenderParams {
    let mapping = if mapping == Mapping::Uv && mesh.uvs.is_empty() { Mapping::Patches } else { mapping };
    RenderParams { method, mapping, ..*params }
}

/// The corners of the box around points.
fn corners(points: &[Vec3]) -> Vec<Vec3> {
    let (low, high) = points.iter().fold((Vec3::MAX, Vec3::MIN), |(low, high), at| (low.min(*at), high.max(*at)));
    (0..8).map(|k| Vec3::select(glam::BVec3::new(k & 1 > 0, k & 2 > 0, k & 4 > 0), low, high)).collect()
}

/// Maps that are named, each once.
#[derive(Default)]
struct Maps(Vec<(PathBuf, Vec<Method>)>);

impl Maps {
    /// Number of a map that is drawn by these methods.
    fn number(&mut self, named: Option<&Path>, methods: impl Iterator<Item = Method>) -> usize {
        let named = named.unwrap_or(Path::new(DEFAULT_MAP));
        let number = self.0.iter().position(|(known, _)| known == named).unwrap_or_else(|| {
            self.0.push((named.to_owned(), Vec::new()));
            self.0.len() - 1
        });
        self.0[number].1.extend(methods);
        number
    }

    /// All of them, with all that the methods draw with, for pictures so many times as high as what they look like.
    fn load(&self, renderer: &Renderer, times: f64, output: &Output) -> Result<Vec<GpuMap>, Failure> {
        let load = |(named, methods): &(PathBuf, Vec<Method>)| {
            Ok(renderer.map(source::map_times(named, times, methods, interrupt::flag(), output)?))
        };
        self.0.iter().map(load).collect()
    }
}

/// Makes the surfaces, and brings the meshes to the device.
fn upload(
    view: &ViewArgs,
    renderer: &Renderer,
    objects: &Objects,
    groups: Vec<Group<'_>>,
    output: &Output,
) -> Result<Vec<Upload>, Failure> {
    let surfaces = groups.iter().filter(|group| group.needs != SurfaceNeeds::default()).count();
    if surfaces > 1 && view.surface.is_kept() {
        return Err(Failure::usage(
            format!("--surface keeps one surface, and these objects need {surfaces}"),
            "leave it out, or draw a single object",
        ));
    }
    let progress = Progress::new("objects", output.quiet || output.json || groups.len() < 3);
    let mut uploads = Vec::with_capacity(groups.len());
    let count = groups.len();
    for group in groups {
        interrupt::stop_if_happened()?;
        progress.set(uploads.len() as f32 / count as f32);
        let (number, parts) = group.of;
        let whole = &objects.loaded[number].mesh;
        let mesh = if parts.len() == whole.parts.len() { Cow::Borrowed(whole) } else { Cow::Owned(whole.only(parts)) };
        let Group { look, field, params, needs, .. } = group;
        let built = view.surface.build(Wanted { mesh: &mesh, needs, field, params, look }, output)?;
        let (cut, surface) = built.unzip();
        let mesh = cut.flatten().unwrap_or_else(|| mesh.into_owned());
        let gpu = interrupt::at_once(output, || {
            let mut gpu = renderer.mesh(&mesh)?;
            surface.as_ref().map_or(Ok(()), |surface| renderer.attach(&mut gpu, surface))?;
            Ok(gpu)
        })?;
        uploads.push(Upload { mesh, gpu: gpu.map_err(report::gpu)? });
    }
    Ok(uploads)
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

/// Puts points of the world into the picture, as far as the user leaves the camera free.
pub(super) fn place_camera(camera: &mut Camera, asked: &scene_file::Camera, points: &[DVec3], size: [u32; 2]) {
    match (asked.fits_distance(), asked.target) {
        (true, None) => camera.frame_points(points, aspect(size), MARGIN),
        (true, Some(_)) => camera.distance = camera.fit_points(points.iter().copied(), aspect(size), MARGIN),
        (false, _) => {}
    }
}

fn aspect([width, height]: [u32; 2]) -> f64 {
    f64::from(width) / f64::from(height)
}
