//! What the view shows: the open scene, with the meshes, maps and surfaces that are there.

use std::sync::Arc;

use glam::DMat4;
use tam_gen::Preset;

use super::super::map::MadeMap;
use super::super::mesh::LoadedMesh;
use super::super::named::Named;
use super::super::painter::{Shot, Side, Sitter};
use super::super::results::Results;
use super::super::surface::{MadeSurface, SurfaceRequest};
use super::Engine;
use crate::app::state::{Compare, Look, Motion, ObjectRef, State, colours_of};
use crate::mesh::Mesh;
use crate::scene::{Lights, Material};
use crate::scene_file::LookEntry;
use crate::turntable::Path;
use crate::{Mapping, Method, Scene};

/// An object, or a part of one, as the state wants it drawn.
pub(super) struct Wanted<'s> {
    /// Number of the object.
    pub object: usize,
    pub mesh: Named<Mesh>,
    /// As far as the mesh allows.
    pub look: Look,
    pub world_from_mesh: DMat4,
    /// Where it is not that of the preset.
    ink: Option<[f32; 3]>,
    materials: Vec<Material>,
    /// Those that its materials name by number.
    pub presets: Vec<&'s Preset>,
}

impl Wanted<'_> {
    /// What has to be made of the surface before it can be drawn; `None`: nothing.
    pub(super) fn surface(&self, lights: &Lights) -> Option<SurfaceRequest> {
        let options = self.look.surface_options(lights, self.world_from_mesh)?;
        Some(SurfaceRequest { mesh: self.mesh.clone(), options })
    }
}

/// Parts that are drawn apart from the rest of their mesh.
pub(super) struct Cut {
    whole: Named<Mesh>,
    parts: Vec<usize>,
    mesh: Named<Mesh>,
}

impl Engine {
    /// What the view shows, at this size and with this movement; `None` while nothing of it is there yet.
    pub(super) fn shot(
        &mut self,
        state: &State,
        results: &Results,
        size_px: [u32; 2],
        motion: Option<Motion>,
    ) -> Option<Shot> {
        let document = &state.document;
        let paper = document.paper_colour();
        let wanted = self.wanted(state, &results.meshes, None);
        let (sitters, objects): (Vec<Sitter>, Vec<usize>) =
            wanted.iter().filter_map(|wanted| Some((self.sitter(wanted, state, results)?, wanted.object))).unzip();
        // An object that is chosen anew is not waited for where others can be seen.
        if sitters.is_empty() && document.standing.visible {
            return None;
        }
        let chosen = objects.iter().position(|object| *object == document.chosen()).unwrap_or(usize::MAX);
        let mut sides = vec![Side { sitters, paper }];
        let mut split = 1.0;
        if let Some(compare) = &document.compare {
            let wanted = self.wanted(state, &results.meshes, Some(compare));
            let sitters: Option<Vec<Sitter>> =
                wanted.iter().map(|wanted| self.sitter(wanted, state, results)).collect();
            let chosen = compare.preset.as_ref().filter(|_| document.object_count() == 1);
            let paper = chosen.map_or(paper, |(_, preset)| colours_of(preset).0);
            sides.push(Side { sitters: sitters?, paper });
            split = compare.split;
        }
        let (camera, lights) = (state.camera, document.lights.clone());
        let mut scene = Scene { camera, lights, inspect: document.inspect, ..Scene::default() };
        if motion == Some(Motion::Orbit) {
            let placed: Vec<(Named<Mesh>, DMat4)> =
                wanted.iter().map(|wanted| (wanted.mesh.clone(), wanted.world_from_mesh)).collect();
            scene.camera.distance = self.round.distance(&scene.camera, &placed, self.view_px, size_px);
        }
        let pose = motion.map(|motion| (path_of(motion), state.transient.phase));
        let for_height = if self.view_px[1] == 0 { size_px[1] } else { self.view_px[1] };
        Some(Shot { size_px, for_height, samples: 4, scene, pose, sides, split, chosen })
    }

    /// All that is visible of the meshes that are there, the chosen object as another side of a comparison has it.
    pub(super) fn wanted<'s>(
        &mut self,
        state: &'s State,
        meshes: &[Arc<LoadedMesh>],
        compare: Option<&'s Compare>,
    ) -> Vec<Wanted<'s>> {
        let document = &state.document;
        let mut all = Vec::with_capacity(document.object_count());
        for (index, object) in document.objects().enumerate() {
            let Some(loaded) = meshes.iter().find(|loaded| loaded.source == *object.mesh) else { continue };
            if !object.standing.visible {
                continue;
            }
            let other = compare.filter(|_| index == document.chosen());
            let look = other.map_or(object.look, |compare| &compare.look);
            let preset = other.and_then(|compare| compare.preset.as_ref()).map_or(object.preset, |(_, preset)| preset);
            self.wanted_of(index, &object, look, preset, state, &loaded.mesh, &mut all);
        }
        all
    }

    /// What is visible of one object.
    #[expect(clippy::too_many_arguments, reason = "an object, its look and its strokes, and where they go")]
    fn wanted_of<'s>(
        &mut self,
        index: usize,
        object: &ObjectRef<'s>,
        look: &Look,
        preset: &'s Preset,
        state: &'s State,
        mesh: &Named<Mesh>,
        all: &mut Vec<Wanted<'s>>,
    ) {
        // Parts that the mesh has not are told of where it is loaded.
        let entry = object.standing.known_parts(mesh);
        let Ok(pieces) = entry.pieces(&LookEntry::default(), mesh) else { return };
        for piece in pieces {
            let whole = piece.is_whole(mesh);
            let mut presets = vec![preset];
            let material = |(part, words): (&usize, &LookEntry)| {
                let own = || Material { colour: mesh.parts[*part].colour, ..Material::default() };
                let mut material = words.material(&object.materials.get(*part).cloned().unwrap_or_else(own));
                let named = words.map.as_ref().and_then(|map| state.document.part_presets.get(map));
                material.map = named.map_or(0, |preset| {
                    presets.push(preset);
                    presets.len() - 1
                });
                material
            };
            let materials = piece.parts.iter().zip(&piece.looks).map(material).collect();
            let mesh = if whole { mesh.clone() } else { self.cut(mesh, &piece.parts) };
            all.push(Wanted {
                object: index,
                look: look.with(&piece.look, !mesh.uvs.is_empty()).fitted(&mesh),
                mesh,
                world_from_mesh: piece.world_from_mesh,
                ink: piece.look.ink.map(|ink| ink.0),
                materials,
                presets,
            });
        }
    }

    /// Some parts of a mesh, cut out of it once.
    fn cut(&mut self, whole: &Named<Mesh>, parts: &[usize]) -> Named<Mesh> {
        let known = self.cuts.iter().find(|cut| cut.whole == *whole && cut.parts == parts);
        if let Some(known) = known {
            return known.mesh.clone();
        }
        let mesh = whole.only(parts);
        self.cuts.push(Cut { whole: whole.clone(), parts: parts.to_vec(), mesh: mesh.clone() });
        mesh
    }

    /// Forgets what was cut out of meshes that are gone.
    pub(super) fn forget_cuts(&mut self, meshes: &[Arc<LoadedMesh>]) {
        self.cuts.retain(|cut| meshes.iter().any(|loaded| loaded.mesh == cut.whole));
        let Self { made, cuts, .. } = self;
        let is_there = |mesh: &Named<Mesh>| {
            let loaded = meshes.iter().any(|loaded| loaded.mesh == *mesh);
            loaded || cuts.iter().any(|cut| cut.mesh == *mesh)
        };
        made.retain(|made| is_there(&made.request.mesh));
    }

    /// The map of a preset, or of what it was before; `None` while there is none.
    fn map_of<'a>(&'a self, preset: &Preset, state: &State, results: &'a Results) -> Option<&'a Arc<MadeMap>> {
        let made = self.other_maps_made.iter().find(|made| made.preset == *preset);
        if *preset == state.document.preset { results.map.as_ref().or(made) } else { made }
    }

    /// How it is drawn with the surface that is there: that of an older choice until the new one is made, and three planes
    /// until there is any. `None` while its map is still to be made.
    fn sitter(&self, wanted: &Wanted<'_>, state: &State, results: &Results) -> Option<Sitter> {
        let maps = wanted.presets.iter().map(|preset| Some(self.map_of(preset, state, results)?.hatch.clone()));
        let maps = maps.collect::<Option<Vec<_>>>()?;
        let ink = wanted.ink.unwrap_or_else(|| colours_of(wanted.presets[0]).1);
        let sitter = |params, mesh: &Named<Mesh>, surface| Sitter {
            params,
            mesh: mesh.clone(),
            surface,
            maps,
            world_from_mesh: wanted.world_from_mesh,
            ink,
            materials: wanted.materials.clone(),
        };
        let mut params = wanted.look.params;
        let Some(request) = wanted.surface(&state.document.lights) else {
            return Some(sitter(params, &wanted.mesh, None));
        };
        let exact = self.made.iter().find(|made| made.request == request);
        let serves = |made: &&MadeSurface| made.request.mesh == request.mesh && serves(&made.request, &request);
        Some(match exact.or_else(|| self.made.iter().rev().find(serves)) {
            Some(made) => sitter(params, &made.mesh, Some(made.surface.clone())),
            None => {
                params.mapping = Mapping::Triplanar;
                if params.method == Method::Stripes {
                    params.method = Method::Phong;
                }
                sitter(params, &wanted.mesh, None)
            }
        })
    }
}

/// The open scene, with the chosen object as its mesh.
pub(super) fn scene(state: &State, mesh: &LoadedMesh) -> Scene {
    let document = &state.document;
    let mut scene = Scene { camera: state.camera, lights: document.lights.clone(), ..Scene::of(&mesh.mesh) };
    for (own, wanted) in scene.materials.iter_mut().zip(&document.materials) {
        *own = wanted.clone();
    }
    scene.world_from_mesh = document.standing.world_from_mesh();
    scene
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
