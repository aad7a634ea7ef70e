//! Draws what the state asks for, on a device of its own.

use std::sync::Arc;
use std::time::Duration;

use glam::{DMat4, Vec3};
use image::RgbaImage;

use crate::gpu::{Gpu, GpuError, GpuMap, GpuMesh, GpuOptions, PixelFormat, Target};
use crate::maps::HatchMap;
use crate::mesh::Mesh;
use crate::surface::Surface;
use crate::turntable::Path;
use crate::{FrameTimer, Material, Object, RenderError, RenderParams, Renderer, Scene};

/// Bytes of meshes, and as many of maps, that are kept on the device beside what is drawn.
const KEPT_BYTES: u64 = 512 << 20;

/// Targets that are kept.
const TARGETS: usize = 4;

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
#[derive(Clone, Debug)]
pub(super) struct Sitter {
    pub params: RenderParams,
    pub mesh: Arc<Mesh>,
    pub surface: Option<Arc<Surface>>,
    /// Those that its materials name by number.
    pub maps: Vec<Arc<HatchMap>>,
    pub world_from_mesh: DMat4,
    /// Colour of the ink, linear light.
    pub ink: [f32; 3],
    pub materials: Vec<Material>,
}

impl Sitter {
    /// Of a mesh at the origin, in its own colours.
    pub(super) fn plain(params: RenderParams, mesh: Arc<Mesh>, map: Arc<HatchMap>, ink: [f32; 3]) -> Self {
        let materials = Scene::of(&mesh).materials;
        Self { params, mesh, surface: None, maps: vec![map], world_from_mesh: DMat4::IDENTITY, ink, materials }
    }
}

impl PartialEq for Sitter {
    fn eq(&self, other: &Self) -> bool {
        same(self.surface.as_ref(), other.surface.as_ref())
            && Arc::ptr_eq(&self.mesh, &other.mesh)
            && self.maps.len() == other.maps.len()
            && self.maps.iter().zip(&other.maps).all(|(own, other)| Arc::ptr_eq(own, other))
            && self.params == other.params
            && self.world_from_mesh == other.world_from_mesh
            && self.ink == other.ink
            && self.materials == other.materials
    }
}

/// Whether both are the same one, or nothing.
fn same<T>(own: Option<&Arc<T>>, other: Option<&Arc<T>>) -> bool {
    match (own, other) {
        (Some(own), Some(other)) => Arc::ptr_eq(own, other),
        (own, other) => own.is_none() && other.is_none(),
    }
}

impl PartialEq for Shot {
    fn eq(&self, other: &Self) -> bool {
        (self.size_px, self.samples) == (other.size_px, other.samples) && self.shows_same(other)
    }
}

impl Shot {
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
    /// Each with the shot that used it last.
    maps: Vec<(GpuMap, u64)>,
    targets: Vec<Target>,
    positions: Vec<Vec3>,
    normals: Vec<Vec3>,
    /// Counts what was drawn.
    shots: u64,
}

struct UploadedMesh {
    source: Arc<Mesh>,
    surface: Option<Arc<Surface>>,
    mesh: GpuMesh,
    pose: Option<(Path, f64)>,
    /// The shot that used it last.
    used: u64,
}

/// A finished picture.
pub(super) struct Painted {
    /// Straight alpha.
    pub image: RgbaImage,
    /// Time on the device, of the first side.
    pub cost: Duration,
}

impl Painter {
    /// Opens the adapter.
    pub(super) fn open() -> Result<Self, GpuError> {
        let renderer = Renderer::new(Gpu::open(&GpuOptions::default())?);
        Ok(Self {
            timer: FrameTimer::new(&renderer.gpu),
            renderer,
            meshes: Vec::new(),
            maps: Vec::new(),
            targets: Vec::new(),
            positions: Vec::new(),
            normals: Vec::new(),
            shots: 0,
        })
    }

    /// The adapter, in words.
    pub(super) fn adapter(&self) -> String {
        self.renderer.gpu.adapter.to_string()
    }

    /// Takes the device away, as a driver that is reset does.
    #[cfg(test)]
    pub(super) fn lose_device(&self) {
        self.renderer.gpu.device.destroy();
    }

    /// Draws a picture.
    pub(super) fn paint(&mut self, shot: &Shot) -> Result<Painted, RenderError> {
        let mut painted: Option<Painted> = None;
        for side in &shot.sides {
            let (image, cost) = self.paint_side(shot, side)?;
            match &mut painted {
                None => painted = Some(Painted { image, cost }),
                Some(painted) => wipe(&mut painted.image, &image, shot.split),
            }
        }
        painted.ok_or(RenderError::NoMap)
    }

    fn paint_side(&mut self, shot: &Shot, side: &Side) -> Result<(RgbaImage, Duration), RenderError> {
        self.shots += 1;
        let meshes: Vec<usize> =
            side.sitters.iter().map(|sitter| self.mesh(sitter, shot.pose)).collect::<Result<_, _>>()?;
        let mut maps: Vec<Arc<HatchMap>> = Vec::new();
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
        let target = self.target(shot.size_px, shot.samples)?;
        let Self { renderer, timer, meshes: kept, maps, targets, .. } = self;
        let mut scene = shot.scene.clone();
        scene.paper = side.paper;
        if let Some((path, phase)) = shot.pose {
            scene = path.scene(&scene, phase);
        }
        let maps: Vec<&GpuMap> = uploaded.iter().map(|map| &maps[*map].0).collect();
        let times = f64::from(shot.size_px[1]) / f64::from(shot.for_height.max(1));
        let texels = |sitter: &Sitter| sitter.maps.first().map_or(1, |map| map.texels);
        let look = |sitter: &Sitter| sitter.params.times_as_high(times, texels(sitter).into());
        let looks: Vec<RenderParams> = side.sitters.iter().map(look).collect();
        let parts = side.sitters.iter().zip(&looks).zip(&meshes).zip(&materials);
        let mut objects: Vec<Object<'_>> = Vec::with_capacity(looks.len());
        for (((sitter, params), mesh), materials) in parts {
            let (world_from_mesh, ink) = (sitter.world_from_mesh, sitter.ink);
            objects.push(Object { mesh: &kept[*mesh].mesh, world_from_mesh, params, ink, materials });
        }
        let cost = timer.time(renderer, |renderer, timer| {
            renderer.render_objects(&scene, &objects, &maps, &targets[target], Some(timer))
        })?;
        let image = targets[target].read(&renderer.gpu)?.into_image();
        self.make_room();
        Ok((image, cost))
    }

    /// Where the mesh is among those uploaded, in its pose.
    fn mesh(&mut self, sitter: &Sitter, pose: Option<(Path, f64)>) -> Result<usize, RenderError> {
        let is_it = |uploaded: &UploadedMesh| {
            Arc::ptr_eq(&uploaded.source, &sitter.mesh) && same(uploaded.surface.as_ref(), sitter.surface.as_ref())
        };
        let index = match self.meshes.iter().position(is_it) {
            Some(index) => index,
            None => {
                let mut mesh = self.renderer.mesh(&sitter.mesh)?;
                if let Some(surface) = &sitter.surface {
                    self.renderer.attach(&mut mesh, surface)?;
                }
                let (source, surface) = (Arc::clone(&sitter.mesh), sitter.surface.clone());
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

    fn map(&mut self, map: &Arc<HatchMap>) -> usize {
        let index = match self.maps.iter().position(|(uploaded, _)| Arc::ptr_eq(&uploaded.source, map)) {
            Some(index) => index,
            None => {
                self.maps.push((self.renderer.map(Arc::clone(map)), 0));
                self.maps.len() - 1
            }
        };
        self.maps[index].1 = self.shots;
        index
    }

    /// Drops what was used longest ago, until what is kept takes no more than so many bytes; what was just drawn stays.
    fn make_room(&mut self) {
        let now = self.shots;
        make_room(&mut self.meshes, now, |kept| (kept.used, kept.mesh.bytes()));
        make_room(&mut self.maps, now, |(map, used)| (*used, map.bytes()));
    }

    fn target(&mut self, size_px: [u32; 2], samples: u32) -> Result<usize, RenderError> {
        let is_it = |target: &Target| target.size == size_px && target.samples == samples;
        if let Some(index) = self.targets.iter().position(is_it) {
            return Ok(index);
        }
        let target = self.renderer.target(size_px, samples, PixelFormat::Srgb8)?;
        if self.targets.len() >= TARGETS {
            self.targets.remove(0);
        }
        self.targets.push(target);
        Ok(self.targets.len() - 1)
    }
}

/// Number of a map among others, put behind them where it is none of them.
fn number_of(maps: &mut Vec<Arc<HatchMap>>, map: &Arc<HatchMap>) -> usize {
    maps.iter().position(|known| Arc::ptr_eq(known, map)).unwrap_or_else(|| {
        maps.push(Arc::clone(map));
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

/// Replaces what lies right of the cut.
fn wipe(left: &mut RgbaImage, right: &RgbaImage, split: f64) {
    let width = left.width();
    let from = (split.clamp(0.0, 1.0) * f64::from(width)).round() as u32;
    for (x, y, pixel) in right.enumerate_pixels() {
        if x >= from {
            left.put_pixel(x, y, *pixel);
        }
    }
}

#[cfg(test)]
mod tests {
    use image::Rgba;

    use super::*;

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

    #[test]
    fn a_wiped_picture_shows_each_side_on_its_side() {
        let picture = |grey| RgbaImage::from_pixel(10, 2, Rgba([grey, grey, grey, 255]));
        let mut wiped = picture(1);
        wipe(&mut wiped, &picture(2), 0.3);
        let greys: Vec<u8> = wiped.rows().flat_map(|row| row.map(|pixel| pixel.0[0])).collect();
        assert_eq!(greys, [1, 1, 1, 2, 2, 2, 2, 2, 2, 2].repeat(2));
        for (split, all) in [(-1.0, 2), (2.0, 1)] {
            let mut wiped = picture(1);
            wipe(&mut wiped, &picture(2), split);
            assert!(wiped.pixels().all(|pixel| pixel.0[0] == all));
        }
    }
}
