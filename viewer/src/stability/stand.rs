//! What cases are drawn with.

use std::collections::BTreeMap;

use image::{Rgb, RgbImage, imageops};
use tam_gen::{Job, Preset, srgb};

use super::case::{Side, StabilityError};
use crate::gpu::{GpuMap, GpuMesh, PixelFormat};
use crate::maps::HatchMap;
use crate::mesh::Mesh;
use crate::params::{Form, Method, RenderParams};
use crate::renderer::Renderer;
use crate::scene::Scene;

/// Side of the pictures that are measured, where a case does not ask for another.
pub(super) const SIDE: u32 = 96;
/// Side of a frame that is shown.
pub(super) const SHOWN: u32 = 150;
/// Between frames that are shown.
const GAP: u32 = 6;
/// What is no number.
const NO_NUMBER: Rgb<u8> = Rgb([214, 0, 147]);
/// What is whiter than paper or blacker than ink.
const BEYOND: Rgb<u8> = Rgb([240, 130, 0]);

/// A renderer with the maps of presets, for all cases.
pub struct Stand {
    renderer: Renderer,
    maps: BTreeMap<String, GpuMap>,
}

/// A renderer with one map, drawing small pictures.
pub(super) struct Stage<'a> {
    renderer: &'a mut Renderer,
    map: &'a GpuMap,
    side: u32,
}

/// What a picture shows.
pub(super) type View<'a> = (&'a Scene, &'a RenderParams, &'a Mesh);

impl Stand {
    /// A stand that draws with this renderer.
    pub fn new(renderer: Renderer) -> Self {
        Self { renderer, maps: BTreeMap::new() }
    }

    /// What it draws with.
    pub fn renderer(&self) -> &Renderer {
        &self.renderer
    }

    /// A stage with a fine pen: crossing strokes of full ink, so that any change shows.
    pub(super) fn stage(&mut self) -> Result<Stage<'_>, StabilityError> {
        self.stage_of("fine-pen", SIDE)
    }

    /// A stage with the map of a preset in 128 px, for pictures of this side.
    pub(super) fn stage_of(&mut self, name: &str, side: u32) -> Result<Stage<'_>, StabilityError> {
        self.stage_with(name, side, || {
            let mut preset = preset(name)?;
            preset.map.size = 128;
            preset.map.coarsest = 16;
            Ok(HatchMap::from_preset(name, &preset, &Job::default())?)
        })
    }

    /// A stage with a map of its own, made where there is none of this name yet.
    pub(super) fn stage_with(
        &mut self,
        name: &str,
        side: u32,
        make: impl FnOnce() -> Result<HatchMap, StabilityError>,
    ) -> Result<Stage<'_>, StabilityError> {
        if !self.maps.contains_key(name) {
            self.maps.insert(name.to_owned(), self.renderer.map(make()?));
        }
        Ok(Stage { renderer: &mut self.renderer, map: &self.maps[name], side })
    }
}

/// A preset that comes with the tool.
pub(super) fn preset(name: &str) -> Result<Preset, StabilityError> {
    Preset::named(name).and_then(Result::ok).ok_or_else(|| StabilityError::Preset(name.to_owned()))
}

impl Stage<'_> {
    /// Side of what it draws.
    pub(super) fn side(&self) -> u32 {
        self.side
    }

    /// Tones of the map.
    pub(super) fn columns(&self) -> usize {
        self.map.source.grid.columns()
    }

    /// Draws once: linear light, one sample per pixel, rows from the top.
    pub(super) fn draw(&mut self, (scene, params, mesh): View<'_>) -> Result<Vec<[f32; 4]>, StabilityError> {
        let mesh = self.renderer.mesh(mesh)?;
        self.draw_uploaded(scene, params, &mesh)
    }

    /// A mesh on the device, for many pictures of it.
    pub(super) fn upload(&self, mesh: &Mesh) -> Result<GpuMesh, StabilityError> {
        Ok(self.renderer.mesh(mesh)?)
    }

    /// The same as [`Stage::draw`], of a mesh on the device.
    pub(super) fn draw_uploaded(
        &mut self,
        scene: &Scene,
        params: &RenderParams,
        mesh: &GpuMesh,
    ) -> Result<Vec<[f32; 4]>, StabilityError> {
        self.draw_in(scene, params, mesh, self.side)
    }

    /// A figure with its frames, drawn larger than they were measured.
    pub(super) fn side_of(&mut self, figure: f64, views: &[View<'_>]) -> Result<Side, StabilityError> {
        let mut frames = Vec::with_capacity(views.len());
        for (scene, params, mesh) in views {
            let mesh = self.renderer.mesh(mesh)?;
            let pixels = self.draw_in(scene, params, &mesh, SHOWN)?;
            frames.push(RgbImage::from_fn(SHOWN, SHOWN, |x, y| shown(pixels[(y * SHOWN + x) as usize])));
        }
        Ok(Side { figure, picture: side_by_side(&frames) })
    }

    fn draw_in(
        &mut self,
        scene: &Scene,
        params: &RenderParams,
        mesh: &GpuMesh,
        side: u32,
    ) -> Result<Vec<[f32; 4]>, StabilityError> {
        let target = self.renderer.target([side; 2], 1, PixelFormat::Linear32)?;
        self.renderer.render(scene, params, mesh, &[self.map], &target)?;
        Ok(target.read(&self.renderer.gpu)?.linear())
    }
}

/// Both forms of something.
pub(super) fn both(mut side: impl FnMut(Form) -> Result<Side, StabilityError>) -> Result<[Side; 2], StabilityError> {
    Ok([side(Form::Literal)?, side(Form::Hardened)?])
}

/// Light-aligned frames, without silhouette lines.
pub(super) fn face_frame(form: Form) -> RenderParams {
    drawn_by(Method::FaceFrame, form)
}

/// A method, without silhouette lines.
pub(super) fn drawn_by(method: Method, form: Form) -> RenderParams {
    RenderParams { method, form, silhouettes: None, ..RenderParams::default() }
}

/// Frames in a row.
pub(super) fn side_by_side(frames: &[RgbImage]) -> RgbImage {
    let width = frames.iter().map(|frame| frame.width() + GAP).sum::<u32>().saturating_sub(GAP);
    let height = frames.iter().map(RgbImage::height).max().unwrap_or(0);
    let mut row = RgbImage::from_pixel(width, height, Rgb([255; 3]));
    let mut left = 0;
    for frame in frames {
        imageops::replace(&mut row, frame, i64::from(left), 0);
        left += frame.width() + GAP;
    }
    row
}

/// A pixel in linear light as it is shown.
fn shown(pixel: [f32; 4]) -> Rgb<u8> {
    if pixel.iter().any(|channel| !channel.is_finite()) {
        return NO_NUMBER;
    }
    if !(-0.01..=1.01).contains(&pixel[0]) {
        return BEYOND;
    }
    Rgb([0, 1, 2].map(|channel| srgb::byte(pixel[channel])))
}
