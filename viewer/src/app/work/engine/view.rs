//! What the view shows: the open scene, with the maps and surfaces that are there.

use std::sync::Arc;

use tam_gen::Preset;

use super::super::map::MadeMap;
use super::super::mesh::LoadedMesh;
use super::super::painter::{Shot, Side};
use super::super::surface::{MadeSurface, SurfaceRequest};
use super::super::thumbnails::linear_colours;
use super::Engine;
use crate::app::state::{Look, Motion, State};
use crate::turntable::Path;
use crate::{Mapping, Method, Scene};

impl Engine {
    /// What the view shows, at this size and with this movement; `None` while something of it is still to be made.
    pub(super) fn shot(
        &mut self,
        state: &State,
        mesh: &LoadedMesh,
        map: &Arc<MadeMap>,
        size_px: [u32; 2],
        motion: Option<Motion>,
    ) -> Option<Shot> {
        let looks = looks(state, mesh);
        let mut sides = vec![self.side(&looks[0], state, mesh, map, &state.document.preset)];
        let mut split = 1.0;
        if let (Some(look), Some(compare)) = (looks.get(1), &state.document.compare) {
            let (map, preset) = match &compare.preset {
                Some((_, preset)) => (self.other_map.as_ref()?, preset),
                None => (map, &state.document.preset),
            };
            sides.push(self.side(look, state, mesh, map, preset));
            split = compare.split;
        }
        let mut scene = scene(state, mesh);
        if motion == Some(Motion::Orbit) {
            scene.camera.distance = self.round.distance(&scene.camera, &mesh.mesh, self.view_px, size_px);
        }
        let pose = motion.map(|motion| (path_of(motion), state.transient.phase));
        Some(Shot { size_px, samples: 4, scene, pose, sides, split })
    }

    /// One side, with the surface that is there: that of an older choice until the new one is made, and three planes until
    /// there is any.
    fn side(&self, look: &Look, state: &State, mesh: &LoadedMesh, map: &Arc<MadeMap>, preset: &Preset) -> Side {
        let side = |params, mesh: &Arc<_>, surface| Side {
            params,
            mesh: Arc::clone(mesh),
            surface,
            map: Arc::clone(&map.hatch),
            colours: linear_colours(preset),
        };
        let Some(request) = surface_request(look, state, mesh) else {
            return side(look.params, &mesh.mesh, None);
        };
        let exact = self.made.iter().find(|made| made.request == request);
        let serves =
            |made: &&MadeSurface| Arc::ptr_eq(&made.request.mesh, &request.mesh) && serves(&made.request, &request);
        match exact.or_else(|| self.made.iter().rev().find(serves)) {
            Some(made) => side(look.params, &made.mesh, Some(Arc::clone(&made.surface))),
            None => {
                let mut params = look.params;
                params.mapping = Mapping::Triplanar;
                if params.method == Method::Stripes {
                    params.method = Method::Phong;
                }
                side(params, &mesh.mesh, None)
            }
        }
    }
}

/// The open scene.
pub(super) fn scene(state: &State, mesh: &LoadedMesh) -> Scene {
    let mut scene = Scene { camera: state.camera, lights: state.document.lights.clone(), ..Scene::of(&mesh.mesh) };
    for (own, wanted) in scene.materials.iter_mut().zip(&state.document.materials) {
        *own = wanted.clone();
    }
    scene
}

/// The looks of both sides, as far as the mesh allows.
pub(super) fn looks(state: &State, mesh: &LoadedMesh) -> Vec<Look> {
    let document = &state.document;
    let other = document.compare.as_ref().map(|compare| &compare.look);
    std::iter::once(&document.look).chain(other).map(|look| look.fitted(&mesh.mesh)).collect()
}

pub(super) fn surface_request(look: &Look, state: &State, mesh: &LoadedMesh) -> Option<SurfaceRequest> {
    let options = look.surface_options(&state.document.lights)?;
    Some(SurfaceRequest { mesh: Arc::clone(&mesh.mesh), options })
}

/// Whether a surface can stand in for another of the same mesh: it has all that is drawn with.
fn serves(made: &SurfaceRequest, wanted: &SurfaceRequest) -> bool {
    let (made, wanted) = (&made.options, &wanted.options);
    let follow = match (&made.patches, &wanted.patches) {
        (Some(made), Some(wanted)) => made.follow == wanted.follow,
        (None, Some(_)) => false,
        (_, None) => true,
    };
    follow && (wanted.lapped.is_none() || made.lapped.is_some()) && (wanted.stripes.is_none() || made.stripes.is_some())
}

pub(super) fn path_of(motion: Motion) -> Path {
    match motion {
        Motion::Orbit => Path::Orbit,
        Motion::Light => Path::Light,
        Motion::Deform(deform) => Path::Deform(deform),
        Motion::Animation => Path::Animation,
    }
}
