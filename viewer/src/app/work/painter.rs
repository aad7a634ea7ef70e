//! Draws what the state asks for, on a device of its own.

use std::sync::Arc;
use std::time::Duration;

use glam::Vec3;
use image::RgbaImage;

use crate::gpu::{Gpu, GpuError, GpuMap, GpuMesh, GpuOptions, PixelFormat, Target};
use crate::maps::HatchMap;
use crate::mesh::Mesh;
use crate::surface::Surface;
use crate::turntable::Path;
use crate::{FrameTimer, RenderError, RenderParams, Renderer, Scene};

/// Meshes, maps and targets that are kept uploaded.
const KEPT: usize = 4;

/// One picture.
#[derive(Clone, Debug)]
pub(super) struct Shot {
    pub size_px: [u32; 2],
    /// 1 or 4.
    pub samples: u32,
    pub scene: Scene,
    /// What moves, and its phase.
    pub pose: Option<(Path, f64)>,
    /// One, or two side by side.
    pub sides: Vec<Side>,
    /// Share of the width that shows the first of two.
    pub split: f64,
}

/// What is drawn on one side.
#[derive(Clone, Debug)]
pub(super) struct Side {
    pub params: RenderParams,
    pub mesh: Arc<Mesh>,
    pub surface: Option<Arc<Surface>>,
    pub map: Arc<HatchMap>,
    /// Colours of paper and ink, linear light.
    pub colours: ([f32; 3], [f32; 3]),
}

impl PartialEq for Side {
    fn eq(&self, other: &Self) -> bool {
        let surfaces = match (&self.surface, &other.surface) {
            (Some(own), Some(other)) => Arc::ptr_eq(own, other),
            (own, other) => own.is_none() && other.is_none(),
        };
        surfaces
            && Arc::ptr_eq(&self.mesh, &other.mesh)
            && Arc::ptr_eq(&self.map, &other.map)
            && self.params == other.params
            && self.colours == other.colours
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
    maps: Vec<GpuMap>,
    targets: Vec<Target>,
    positions: Vec<Vec3>,
    normals: Vec<Vec3>,
}

struct UploadedMesh {
    source: Arc<Mesh>,
    surface: Option<Arc<Surface>>,
    mesh: GpuMesh,
    pose: Option<(Path, f64)>,
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
        let mesh = self.mesh(side, shot.pose)?;
        let map = self.map(&side.map);
        let target = self.target(shot.size_px, shot.samples)?;
        let Self { renderer, timer, meshes, maps, targets, .. } = self;
        let mut scene = shot.scene.clone();
        (scene.paper, scene.ink) = side.colours;
        if let Some((path, phase)) = shot.pose {
            scene = path.scene(&scene, phase);
        }
        let cost = timer.time(renderer, |renderer, timer| {
            let (mesh, map, target) = (&meshes[mesh].mesh, &maps[map], &targets[target]);
            renderer.render_timed(&scene, &side.params, mesh, &[map], target, Some(timer))
        })?;
        Ok((targets[target].read(&renderer.gpu)?.into_image(), cost))
    }

    /// Where the mesh is among those uploaded, in its pose.
    fn mesh(&mut self, side: &Side, pose: Option<(Path, f64)>) -> Result<usize, RenderError> {
        let is_it = |uploaded: &UploadedMesh| {
            Arc::ptr_eq(&uploaded.source, &side.mesh)
                && match (&uploaded.surface, &side.surface) {
                    (Some(own), Some(wanted)) => Arc::ptr_eq(own, wanted),
                    (own, wanted) => own.is_none() && wanted.is_none(),
                }
        };
        let index = match self.meshes.iter().position(is_it) {
            Some(index) => index,
            None => {
                let mut mesh = self.renderer.mesh(&side.mesh)?;
                if let Some(surface) = &side.surface {
                    self.renderer.attach(&mut mesh, surface)?;
                }
                make_room(&mut self.meshes);
                let (source, surface) = (Arc::clone(&side.mesh), side.surface.clone());
                self.meshes.push(UploadedMesh { source, surface, mesh, pose: None });
                self.meshes.len() - 1
            }
        };
        let pose = pose.filter(|(path, _)| path.moves_vertices());
        let uploaded = &mut self.meshes[index];
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
        if let Some(index) = self.maps.iter().position(|uploaded| Arc::ptr_eq(&uploaded.source, map)) {
            return index;
        }
        make_room(&mut self.maps);
        self.maps.push(self.renderer.map(Arc::clone(map)));
        self.maps.len() - 1
    }

    fn target(&mut self, size_px: [u32; 2], samples: u32) -> Result<usize, RenderError> {
        let is_it = |target: &Target| target.size == size_px && target.samples == samples;
        if let Some(index) = self.targets.iter().position(is_it) {
            return Ok(index);
        }
        let target = self.renderer.target(size_px, samples, PixelFormat::Srgb8)?;
        make_room(&mut self.targets);
        self.targets.push(target);
        Ok(self.targets.len() - 1)
    }
}

/// Drops the oldest of what is kept.
fn make_room<T>(kept: &mut Vec<T>) {
    if kept.len() >= KEPT {
        kept.remove(0);
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
