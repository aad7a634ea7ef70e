//! What is measured: all objects of a scene as one mesh, which every way to draw is tried on.

use std::path::Path;

use glam::{DMat4, DVec3};
use tam_gen::command::{Failure, Output};
use tam_viewer::mesh::Mesh;
use tam_viewer::scene::Material;
use tam_viewer::scene_file::{LookEntry, MappingEntry, ViewEntry};
use tam_viewer::surface::FieldOptions;
use tam_viewer::{Follow, Mapping, Method, RenderParams, Scene};

use super::objects::Objects;
use super::stage::{DEFAULT_MAP, Ways, place_camera};
use super::surface;
use super::view::ViewArgs;

/// A scene as one mesh in one look.
pub(super) struct Subject {
    pub(super) mesh: Mesh,
    /// That of the first object.
    pub(super) look: LookEntry,
    materials: Vec<Material>,
    view: ViewEntry,
    own_maps: bool,
}

impl Subject {
    /// Loads all objects and puts them together.
    pub(super) fn open(view: &ViewArgs, output: &Output) -> Result<Self, Failure> {
        let objects = Objects::open(view, None, true, output)?;
        let (mesh, materials) = objects.joined();
        let mut maps = objects.pieces.iter().flat_map(|piece| &piece.looks).map(|look| &look.map);
        let map = maps.next().cloned().flatten();
        let own_maps = maps.any(|other| *other != map);
        let look = LookEntry { map, ..objects.pieces[0].look.clone() };
        Ok(Self { mesh, look, materials, view: objects.file.view, own_maps })
    }

    /// Refuses what would be measured wrongly; `why` is what is said of it.
    pub(super) fn check_still(&self, why: &str) -> Result<(), Failure> {
        if self.own_maps || self.look.follow == Some(Follow::Light) {
            return Err(Failure::usage(why, "leave out --follow light and maps of single objects"));
        }
        Ok(())
    }

    /// The map's name or file.
    pub(super) fn map(&self) -> &Path {
        self.look.map.as_deref().unwrap_or(Path::new(DEFAULT_MAP))
    }

    /// The mapping of its look.
    pub(super) fn mapping(&self) -> Mapping {
        self.look.mapping.unwrap_or(MappingEntry::Auto).of(!self.mesh.uvs.is_empty())
    }

    /// How it is drawn by a method.
    pub(super) fn params(&self, view: &ViewArgs, method: Method, size: [u32; 2]) -> RenderParams {
        RenderParams { method, ..view.params(&self.look, !self.mesh.uvs.is_empty(), size) }
    }

    /// All methods with all mappings, as far as they take any.
    pub(super) fn ways(&self, params: &RenderParams, methods: &[Method], mappings: &[Mapping]) -> Vec<RenderParams> {
        Ways::Each(methods, Some(mappings)).of(params, &self.mesh)
    }

    /// The field of its look.
    pub(super) fn field(&self) -> Result<FieldOptions, Failure> {
        surface::field(&self.look, &self.mesh, &self.view.scene(None).lights, DMat4::IDENTITY)
    }

    /// The scene; the camera shows all of it, as far as nothing else was asked for.
    pub(super) fn scene(&self, colours: Option<([f32; 3], [f32; 3])>, size: [u32; 2]) -> Scene {
        let mut scene = Scene { materials: self.materials.clone(), ..self.view.scene(colours) };
        scene.ink = self.look.ink.map_or(scene.ink, |ink| ink.0);
        let points: Vec<DVec3> = self.mesh.positions.iter().map(|position| position.as_dvec3()).collect();
        place_camera(&mut scene.camera, &self.view.camera, &points, size);
        scene
    }
}
