//! Small pictures: presets on a ball, meshes in grey.

use tam_gen::{Job, Preset};

use super::super::state::{MeshSource, colours_of};
use super::canvases::Canvas;
use super::named::Named;
use super::painter::{Painter, Shot, Side, Sitter};
use crate::maps::HatchMap;
use crate::mesh::sample::Sample;
use crate::mesh::{Mesh, load, prepare};
use crate::params::Silhouettes;
use crate::surface::{PatchOptions, Surface, SurfaceOptions};
use crate::{Light, Mapping, Method, RenderError, RenderParams, Scene};

/// Side of a thumbnail, in pixels.
pub(super) const SIDE_PX: u32 = 192;

/// Triangles of a sample mesh in a thumbnail.
const TRIANGLES: usize = 3000;

/// Side of the map of a preset's thumbnail, in texels.
const MAP_PX: u32 = 128;

/// Size of a file that is drawn as a thumbnail, at most, in bytes: larger ones take too long for what is seen of them.
const FILE_BYTES: u64 = 48 << 20;

#[derive(Clone, Debug)]
pub(super) struct ThumbnailRequest {
    pub key: String,
    pub of: Subject,
}

#[derive(Clone, Debug)]
pub(super) enum Subject {
    Preset(Box<Preset>),
    Mesh(MeshSource),
}

/// What all thumbnails share.
#[derive(Default)]
pub(super) struct Thumbnails {
    ball: Option<(Named<Mesh>, Named<Surface>)>,
    plain: Option<Named<HatchMap>>,
}

impl Thumbnails {
    /// Draws one; `None` where there is nothing to draw, which whoever opens it is told then.
    pub(super) fn paint(
        &mut self,
        painter: &mut Painter,
        request: &ThumbnailRequest,
    ) -> Result<Option<Canvas>, RenderError> {
        let side = match &request.of {
            Subject::Preset(preset) => self.preset(preset),
            Subject::Mesh(source) => self.mesh(source),
        };
        let Some(side) = side else { return Ok(None) };
        let mesh = &side.sitters[0].mesh;
        let mut scene = Scene::default();
        scene.lights.lights = vec![Light::from_angles(-38.0, 42.0)];
        let points: Vec<_> = mesh.positions.iter().map(|position| position.as_dvec3()).collect();
        scene.camera.frame_points(&points, 1.0, 0.08);
        let shot = Shot {
            size_px: [SIDE_PX; 2],
            for_height: SIDE_PX,
            samples: 4,
            scene,
            pose: None,
            sides: vec![side],
            split: 1.0,
            chosen: 0,
        };
        Ok(Some(painter.paint(&shot)?.canvas.copy()))
    }

    fn preset(&mut self, preset: &Preset) -> Option<Side> {
        let mut small = preset.clone();
        small.map.size = small.map.size.min(MAP_PX);
        small.map.coarsest = small.map.coarsest.min(small.map.size);
        let map = HatchMap::from_preset("", &small, &Job::default()).ok()?;
        if self.ball.is_none() {
            let mesh = prepare(Sample::Sphere.build(TRIANGLES)).ok()?.mesh;
            let options = PatchOptions { tiles_per_unit: 1.0, ..PatchOptions::default() };
            let mesh = Named::mesh(mesh.subdivided(options.longest_edge() as f32));
            let options = SurfaceOptions { patches: Some(options), ..SurfaceOptions::default() };
            let surface = Named::surface(&mesh, &options, Surface::new(&mesh, &options).ok()?);
            self.ball = Some((mesh, surface));
        }
        let (mesh, surface) = self.ball.clone()?;
        let params = RenderParams {
            method: Method::SixWay,
            mapping: Mapping::Patches,
            tiles_per_unit: 1.0,
            silhouettes: Some(Silhouettes { width_px: 1.2, ..Silhouettes::default() }),
            ..RenderParams::default()
        };
        let (paper, ink) = colours_of(preset);
        let sitter = Sitter { surface: Some(surface), ..Sitter::plain(params, mesh, Named::map(map), ink) };
        Some(Side { sitters: vec![sitter], paper })
    }

    fn mesh(&mut self, source: &MeshSource) -> Option<Side> {
        let mesh = match source {
            MeshSource::Sample(sample, _) => prepare(sample.build(TRIANGLES)).ok()?.mesh,
            MeshSource::File(path) if std::fs::metadata(path).ok()?.len() > FILE_BYTES => return None,
            MeshSource::File(path) => load(path).ok()?.mesh,
        };
        let map = match &self.plain {
            Some(map) => map.clone(),
            None => {
                let mut preset = Preset::default();
                (preset.map.size, preset.map.coarsest) = (64, 32);
                let map = Named::map(HatchMap::from_preset("", &preset, &Job::default()).ok()?);
                self.plain = Some(map.clone());
                map
            }
        };
        let params = RenderParams {
            method: Method::Phong,
            silhouettes: Some(Silhouettes { width_px: 1.2, ..Silhouettes::default() }),
            ..RenderParams::default()
        };
        let sitter = Sitter::plain(params, Named::mesh(mesh), map, [0.05, 0.05, 0.06]);
        Some(Side { sitters: vec![sitter], paper: [0.9, 0.89, 0.87] })
    }
}
