//! Draws what the state asks for, on any device.

use std::ops::Range;
use std::sync::Arc;
use std::time::Duration;

use glam::{DMat4, Vec3};

use super::canvases::{Canvas, Canvases};
use super::named::Named;
use crate::gpu::{Gpu, GpuError, GpuMap, GpuMesh, GpuOptions, TargetViews};
use crate::maps::HatchMap;
use crate::mesh::Mesh;
use crate::surface::Surface;
use crate::turntable::Path;
use crate::{FrameTimer, Material, Object, RenderError, RenderParams, Renderer, Scene};

/// Bytes of meshes, and as many of maps, that are kept on the device beside what is drawn.
const KEPT_BYTES: u64 = 512 << 20;

/// Side of the squares in which software adapters draw.
const SQUARE_PX: u32 = 64;

/// One picture.
#[derive(Clone, Debug)]
pub(super) struct Shot {
    pub size_px: [u32; 2],
    /// Height of the picture that this one looks like, in more pixels or fewer.
    pub for_height: u32,
    /// 1 or 4.
    pub samples: u32,
    pub scene: Scene,
    /// What moves, and its phase.
    pub pose: Option<(Path, f64)>,
    /// One, or two side by side.
    pub sides: Vec<Side>,
    /// Share of the width that shows the first of two.
    pub split: f64,
    /// Which of the first side's sitters is of the chosen object.
    pub chosen: usize,
}

/// What is drawn on one side.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Side {
    pub sitters: Vec<Sitter>,
    /// Colour of the paper, linear light.
    pub paper: [f32; 3],
}

/// An object, or a part of one, as it is drawn.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Sitter {
    pub params: RenderParams,
    pub mesh: Named<Mesh>,
    pub surface: Option<Named<Surface>>,
    /// Those that its materials name by number.
    pub maps: Vec<Named<HatchMap>>,
    pub world_from_mesh: DMat4,
    /// Colour of the ink, linear light.
    pub ink: [f32; 3],
    pub materials: Vec<Material>,
}

impl Sitter {
    /// Of a mesh at the origin, in its own colours.
    pub(super) fn plain(params: RenderParams, mesh: Named<Mesh>, map: Named<HatchMap>, ink: [f32; 3]) -> Self {
        let materials = Scene::of(&mesh).materials;
        Self { params, mesh, surface: None, maps: vec![map], world_from_mesh: DMat4::IDENTITY, ink, materials }
    }
}

impl PartialEq for Shot {
    fn eq(&self, other: &Self) -> bool {
        (self.size_px, self.samples) == (other.size_px, other.samples) && self.shows_same(other)
    }
}

impl Shot {
    /// The scene at the phase of what moves.
    pub(super) fn posed(&self) -> Scene {
        self.pose.map_or_else(|| self.scene.clone(), |(path, phase)| path.scene(&self.scene, phase))
    }

    /// Whether it shows the same, at whatever size and number of samples.
    pub(super) fn shows_same(&self, other: &Self) -> bool {
        let own = (&self.scene, self.pose, &self.sides, self.split);
        own == (&other.scene, other.pose, &other.sides, other.split)
    }
}

/// A renderer with what it drew last.
pub(super) struct Painter {
    renderer: Renderer,
    timer: FrameTimer,
    meshes: Vec<UploadedMesh>,
    maps: Vec<UploadedMap>,
    canvases: Canvases,
    positions: Vec<Vec3>,
    normals: Vec<Vec3>,
    /// Counts what was drawn.
    shots: u64,
}

struct UploadedMesh {
    source: Named<Mesh>,
    surface: Option<Named<Surface>>,
    mesh: GpuMesh,
    pose: Option<(Path, f64)>,
    /// The shot that used it last.
    used: u64,
}

struct UploadedMap {
    source: Named<HatchMap>,
    map: GpuMap,
    /// The shot that used it last.
    used: u64,
}

/// A finished picture.
pub(super) struct Painted {
    pub canvas: Arc<Canvas>,
    /// Time on the device.
    pub cost: Duration,
}

/// Says while a picture is drawn band by band whether it is still wanted.
pub(super) type IsWanted<'a> = &'a dyn Fn() -> bool;

impl Painter {
    /// On a device of its own.
    pub(super) fn open() -> Result<Self, GpuError> {
        Ok(Self::new(Gpu::open(&GpuOptions::default())?))
    }

    /// On this device.
    pub(super) fn new(gpu: Gpu) -> Self {
        let renderer = Renderer::new(gpu);
        Self {
            timer: FrameTimer::new(&renderer.gpu),
            renderer,
            meshes: Vec::new(),
            maps: Vec::new(),
            canvases: Canvases::default(),
            positions: Vec::new(),
            normals: Vec::new(),
            shots: 0,
        }
    }

    /// Draws a picture.
    pub(super) fn paint(&mut self, shot: &Shot) -> Result<Painted, RenderError> {
        self.paint_in_bands(shot, 1, &|| true)?.ok_or(RenderError::NoMap)
    }

    /// Draws a picture from the top down in so many bands, between which the device is left to others; `None`: it was not
    /// wanted any more.
    pub(super) fn paint_in_bands(
        &mut self,
        shot: &Shot,
        bands: u32,
        is_wanted: IsWanted<'_>,
    ) -> Result<Option<Painted>, RenderError> {
        self.shots += 1;
        let width = shot.size_px[0];
        let cut = (shot.split.clamp(0.0, 1.0) * f64::from(width)).round() as u32;
        let mut painted: Option<Painted> = None;
        for (index, side) in shot.sides.iter().enumerate() {
            let columns = match (shot.sides.len(), index) {
                (1, _) => 0..width,
                (_, 0) => 0..cut,
                _ => cut..width,
            };
            let canvas = self.canvases.free(&self.renderer, shot.size_px, shot.samples)?;
            let mut cost = Duration::ZERO;
            let bands = bands_of(shot.size_px[1], bands);
            for (number, rows) in bands.iter().enumerate() {
                if !is_wanted() {
                    return Ok(None);
                }
                let mut into = canvas.target().views();
                into.region_px = Some([columns.start, rows.start, columns.end - columns.start, rows.end - rows.start]);
                into.clears = number == 0;
                into.lasts = number + 1 < bands.len();
                into.resolve = into.resolve.filter(|_| !into.lasts);
                cost += self.paint_side(shot, side, &into)?;
            }
            match &mut painted {
                None => painted = Some(Painted { canvas, cost }),
                Some(painted) => {
                    painted.canvas.take_right(&canvas, cut);
                    painted.cost += cost;
                }
            }
        }
        self.make_room();
        if let Some(painted) = &painted {
            painted.canvas.finish();
            self.renderer.gpu.check()?;
        }
        Ok(painted)
    }

    /// Draws one side of a picture; the time on the device.
    fn paint_side(&mut self, shot: &Shot, side: &Side, into: &TargetViews<'_>) -> Result<Duration, RenderError> {
        let meshes: Vec<usize> =
            side.sitters.iter().map(|sitter| self.mesh(sitter, shot.pose)).collect::<Result<_, _>>()?;
        let mut maps: Vec<Named<HatchMap>> = Vec::new();
        let mut materials: Vec<Vec<Material>> = Vec::with_capacity(side.sitters.len());
        for sitter in &side.sitters {
            let numbers: Vec<usize> = sitter.maps.iter().map(|map| number_of(&mut maps, map)).collect();
            let numbered = |material: &Material| {
                let map = numbers.get(material.map).or(numbers.first()).copied().unwrap_or_default();
                Material { map, ..material.clone() }
            };
            materials.push(sitter.materials.iter().map(numbered).collect());
        }
        let uploaded: Vec<usize> = maps.iter().map(|map| self.map(map)).collect();
        let Self { renderer, timer, meshes: kept, maps, .. } = self;
        let maps: Vec<&GpuMap> = uploaded.iter().map(|map| &maps[*map].map).collect();
        let times = f64::from(shot.size_px[1]) / f64::from(shot.for_height.max(1));
        let inspect = shot.scene.inspect.times_as_high(times);
        let scene = Scene { paper: side.paper, inspect, ..shot.posed() };
        let texels = |sitter: &Sitter| sitter.maps.first().map_or(1, |map| map.texels);
        let look = |sitter: &Sitter| sitter.params.times_as_high(times, texels(sitter).into());
        let looks: Vec<RenderParams> = side.sitters.iter().map(look).collect();
        let parts = side.sitters.iter().zip(&looks).zip(&meshes).zip(&materials);
        let mut objects: Vec<Object<'_>> = Vec::with_capacity(looks.len());
        for (((sitter, params), mesh), materials) in parts {
            let (world_from_mesh, ink) = (sitter.world_from_mesh, sitter.ink);
            objects.push(Object { mesh: &kept[*mesh].mesh, world_from_mesh, params, ink, materials });
        }
        timer.time(renderer, |renderer, timer| renderer.render_into(&scene, &objects, &maps, into, Some(timer)))
    }

    /// Where the mesh is among those uploaded, in its pose.
    fn mesh(&mut self, sitter: &Sitter, pose: Option<(Path, f64)>) -> Result<usize, RenderError> {
        let is_it = |uploaded: &UploadedMesh| (&uploaded.source, &uploaded.surface) == (&sitter.mesh, &sitter.surface);
        // One that shows another surface is given this one, unless this very picture shows both.
        let is_like_it = |uploaded: &UploadedMesh| {
            uploaded.source == sitter.mesh && sitter.surface.is_some() && uploaded.used < self.shots
        };
        let index = match self.meshes.iter().position(is_it) {
            Some(index) => index,
            None if let Some(index) = self.meshes.iter().position(is_like_it) => {
                let uploaded = &mut self.meshes[index];
                if let Some(surface) = &sitter.surface {
                    self.renderer.attach(&mut uploaded.mesh, surface)?;
                }
                uploaded.surface.clone_from(&sitter.surface);
                index
            }
            None => {
                let mut mesh = self.renderer.mesh(&sitter.mesh)?;
                if let Some(surface) = &sitter.surface {
                    self.renderer.attach(&mut mesh, surface)?;
                }
                let (source, surface) = (sitter.mesh.clone(), sitter.surface.clone());
                self.meshes.push(UploadedMesh { source, surface, mesh, pose: None, used: self.shots });
                self.meshes.len() - 1
            }
        };
        let pose = pose.filter(|(path, _)| path.moves_vertices());
        let uploaded = &mut self.meshes[index];
        uploaded.used = self.shots;
        if uploaded.pose != pose {
            let source = &uploaded.source;
            match pose {
                Some((path, phase)) => {
                    path.positions(source, phase, &mut self.positions);
                    source.normals_of(&self.positions, &mut self.normals);
                    uploaded.mesh.update(&self.renderer.gpu, &self.positions, &self.normals);
                }
                None => uploaded.mesh.update(&self.renderer.gpu, &source.positions, &source.normals),
            }
            uploaded.pose = pose;
        }
        Ok(index)
    }

    fn map(&mut self, map: &Named<HatchMap>) -> usize {
        let index = self.maps.iter().position(|uploaded| uploaded.source == *map).unwrap_or_else(|| {
            let (source, uploaded) = (map.clone(), self.renderer.map(Arc::clone(map.shared())));
            self.maps.push(UploadedMap { source, map: uploaded, used: 0 });
            self.maps.len() - 1
        });
        self.maps[index].used = self.shots;
        index
    }

    /// Drops what was used longest ago, until what is kept takes no more than so many bytes; what was just drawn stays.
    fn make_room(&mut self) {
        let now = self.shots;
        make_room(&mut self.meshes, now, |kept| (kept.used, kept.mesh.bytes()));
        make_room(&mut self.maps, now, |kept| (kept.used, kept.map.bytes()));
    }
}

/// Rows of a picture in so many bands, or in fewer: software adapters draw in squares of [`SQUARE_PX`], and where a band
/// ends within one some samples of lines count twice.
fn bands_of(height: u32, bands: u32) -> Vec<Range<u32>> {
    let squares = height.div_ceil(SQUARE_PX);
    let row = |band: u32| ((u64::from(squares) * u64::from(band) / u64::from(bands)) as u32 * SQUARE_PX).min(height);
    (0..bands).map(|band| row(band)..row(band + 1)).filter(|rows| !rows.is_empty()).collect()
}

/// Number of a map among others, put behind them where it is none of them.
fn number_of(maps: &mut Vec<Named<HatchMap>>, map: &Named<HatchMap>) -> usize {
    maps.iter().position(|known| known == map).unwrap_or_else(|| {
        maps.push(map.clone());
        maps.len() - 1
    })
}

/// Drops what was used longest ago, until all takes no more than [`KEPT_BYTES`]; what was used `now` stays.
fn make_room<T>(kept: &mut Vec<T>, now: u64, of: impl Fn(&T) -> (u64, u64)) {
    let mut bytes: u64 = kept.iter().map(|one| of(one).1).sum();
    while bytes > KEPT_BYTES {
        let oldest = (0..kept.len()).filter(|index| of(&kept[*index]).0 < now).min_by_key(|index| of(&kept[*index]).0);
        let Some(oldest) = oldest else { return };
        bytes -= of(&kept.remove(oldest)).1;
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::prepare;
    use crate::mesh::sample::Sample;
    use crate::params::Silhouettes;
    use crate::{Mapping, Method};

    #[test]
    fn room_is_made_by_dropping_what_was_used_longest_ago_and_never_what_is_drawn() {
        let half = KEPT_BYTES / 2;
        let mut kept = vec![(3, half), (1, half), (2, half), (9, 2 * half)];
        make_room(&mut kept, 9, |one| *one);
        assert_eq!(kept, [(9, 2 * half)]);
        let mut kept = vec![(2, half), (1, half / 2), (9, half / 2)];
        make_room(&mut kept, 9, |one| *one);
        assert_eq!(kept.len(), 3, "as long as there is room all of it stays");
        let mut kept = vec![(9, 2 * half), (9, half)];
        make_room(&mut kept, 9, |one| *one);
        assert_eq!(kept.len(), 2);
    }

    fn shot(samples: u32) -> Shot {
        let mesh = Named::mesh(prepare(Sample::Teapot.build(3000)).expect("a mesh").mesh);
        let mut preset = tam_gen::Preset::default();
        (preset.map.size, preset.map.coarsest) = (64, 32);
        let map = HatchMap::from_preset("", &preset, &tam_gen::Job::default()).expect("a map");
        let params = RenderParams {
            mapping: Mapping::Triplanar,
            silhouettes: Some(Silhouettes { width_px: 3.0, ..Silhouettes::default() }),
            ..RenderParams::default()
        };
        let mut scene = Scene::default();
        let points: Vec<_> = mesh.positions.iter().map(|position| position.as_dvec3()).collect();
        scene.camera.frame_points(&points, 1.0, 0.08);
        let sitter = Sitter::plain(params, mesh, Named::map(map), [0.1; 3]);
        let side = Side { sitters: vec![sitter], paper: [0.9; 3] };
        let (size_px, sides) = ([211, 315], vec![side]);
        Shot { size_px, for_height: 315, samples, scene, pose: None, sides, split: 1.0, chosen: 0 }
    }

    #[test]
    fn bands_are_all_rows_in_order() {
        for (height, bands, ends) in
            [(200, 1, vec![200]), (200, 3, vec![64, 128, 200]), (129, 9, vec![64, 128, 129]), (40, 4, vec![40])]
        {
            let rows = bands_of(height, bands);
            assert_eq!(rows.iter().map(|rows| rows.end).collect::<Vec<_>>(), ends);
            assert!(rows[0].start == 0 && rows.windows(2).all(|pair| pair[0].end == pair[1].start));
        }
    }

    #[test]
    fn a_picture_is_the_same_in_any_number_of_bands_and_on_devices_that_see_no_other_format() {
        let mut gpu = Gpu::open(&GpuOptions::default()).expect("an adapter");
        for samples in [1, 4] {
            let shot = shot(samples);
            let mut painter = Painter::new(gpu.clone());
            let whole = painter.paint(&shot).expect("a picture").canvas.read().expect("a device");
            gpu.has_view_formats = false;
            let mut painter = Painter::new(gpu.clone());
            for bands in [2, 3, 12, 400] {
                let painted = painter.paint_in_bands(&shot, bands, &|| true).expect("a picture").expect("it is wanted");
                assert!(painted.canvas.read().expect("a device") == whole, "{samples} samples in {bands} bands");
                assert!(painted.canvas.read_shown().expect("a device") == whole, "{samples} samples in {bands} bands");
            }
            gpu.has_view_formats = true;
        }
    }

    #[test]
    fn a_picture_that_is_not_wanted_any_more_is_left_after_a_band() {
        let mut painter = Painter::open().expect("an adapter");
        let bands = std::cell::Cell::new(0);
        let is_wanted = || bands.replace(bands.get() + 1) < 3;
        assert!(painter.paint_in_bands(&shot(4), 8, &is_wanted).expect("no error").is_none());
        assert_eq!(bands.get(), 4, "of five");
    }

    #[test]
    fn two_sides_are_one_picture_each_on_its_side() {
        let mut painter = Painter::open().expect("an adapter");
        let mut image = |shot: &Shot| painter.paint(shot).expect("a picture").canvas.read().expect("a device");
        let left = shot(4);
        let mut right = left.clone();
        right.sides[0].sitters[0].params.method = Method::Phong;
        let (own, other) = (image(&left), image(&right));
        let mut both = left.clone();
        both.sides.push(right.sides[0].clone());
        for (split, cut) in [(-1.0, 0), (0.3, 63), (1.0, 211), (2.0, 211)] {
            both.split = split;
            let joined = image(&both);
            let right_one = |(x, y, pixel): (u32, u32, &image::Rgba<u8>)| {
                *pixel == *(if x < cut { &own } else { &other }).get_pixel(x, y)
            };
            assert!(joined.enumerate_pixels().all(right_one), "cut at {split}");
        }
        assert!(own != other);
    }
}
