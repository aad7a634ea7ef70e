//! The objects of a scene, loaded: from a scene file, from options, or from both.

use std::borrow::Cow;

use glam::{DMat4, Vec3};
use tam_gen::command::{Failure, Output, interrupt};
use tam_viewer::Method;
use tam_viewer::mesh::{Loaded, Mesh};
use tam_viewer::scene::Material;
use tam_viewer::scene_file::value::Deformed;
use tam_viewer::scene_file::{MeshEntry, Piece, SceneFile, ViewEntry};

use super::view::ViewArgs;
use super::{object, source};

/// The objects of a scene on their meshes.
pub(super) struct Objects {
    /// What was asked for.
    pub(super) file: SceneFile,
    /// The meshes, each once.
    pub(super) loaded: Vec<Loaded>,
    /// What is drawn with one look at one place.
    pub(super) pieces: Vec<Piece>,
    /// By object: which of the meshes it is of.
    mesh_of: Vec<usize>,
}

impl Objects {
    /// Loads the meshes of all objects. `posed` moves them as time and deformation say, else they are at rest.
    pub(super) fn open(view: &ViewArgs, method: Option<Method>, posed: bool, output: &Output) -> Result<Self, Failure> {
        let mut file = view.file(method)?;
        object::count(&mut file, view.settings())?;
        let mut entries: Vec<MeshEntry> = Vec::new();
        let mut mesh_of = Vec::with_capacity(file.objects.len());
        for entry in file.objects.iter().map(|object| object.mesh_entry()) {
            let known = entries.iter().position(|known| *known == entry);
            mesh_of.push(known.unwrap_or(entries.len()));
            if known.is_none() {
                entries.push(entry);
            }
        }
        let mut loaded = Vec::with_capacity(entries.len());
        for entry in &entries {
            let mesh = interrupt::at_once(output, || source::mesh(entry))??;
            if !output.json {
                mesh.report.notes().iter().for_each(|note| output.remark(&format!("note: {note}")));
            }
            loaded.push(mesh);
        }
        check_time(&file.view, &loaded)?;
        if posed {
            loaded.iter_mut().for_each(|loaded| pose(&mut loaded.mesh, &file.view));
        }
        let meshes: Vec<&Mesh> = mesh_of.iter().map(|index| &loaded[*index].mesh).collect();
        object::say(&mut file, view.settings(), &meshes)?;
        let pieces = file
            .pieces(|object| meshes[object])
            .map_err(|problem| Failure::usage(problem, "parts are called as the mesh's file calls them"))?;
        if pieces.is_empty() {
            return Err(Failure::usage("no object of the scene is visible", "leave out visible=false for one of them"));
        }
        Ok(Self { file, loaded, pieces, mesh_of })
    }

    /// Number of the mesh of a piece.
    pub(super) fn mesh_number(&self, piece: &Piece) -> usize {
        self.mesh_of[piece.object]
    }

    /// The mesh of a piece, cut out of that of its object where it is a part of it.
    pub(super) fn mesh(&self, piece: &Piece) -> Cow<'_, Mesh> {
        let mesh = &self.loaded[self.mesh_number(piece)].mesh;
        if piece.is_whole(mesh) { Cow::Borrowed(mesh) } else { Cow::Owned(mesh.only(&piece.parts)) }
    }

    /// Materials of a piece, all with the first map.
    pub(super) fn materials(&self, piece: &Piece) -> Vec<Material> {
        let view = &self.file.view;
        piece.materials(&self.loaded[self.mesh_number(piece)].mesh, |colour| view.colour_of(colour))
    }

    /// All that is visible as one mesh at rest, with the materials of its parts.
    pub(super) fn joined(&self) -> (Mesh, Vec<Material>) {
        let meshes: Vec<Cow<'_, Mesh>> = self.pieces.iter().map(|piece| self.mesh(piece)).collect();
        let placed: Vec<(&Mesh, DMat4)> =
            meshes.iter().zip(&self.pieces).map(|(mesh, piece)| (mesh.as_ref(), piece.world_from_mesh)).collect();
        let mesh = Mesh::joined(&self.name(), &placed);
        (mesh, self.pieces.iter().flat_map(|piece| self.materials(piece)).collect())
    }

    /// What is drawn, in a word: the mesh where there is one, else how many objects there are.
    pub(super) fn name(&self) -> String {
        match &self.loaded[..] {
            [only] if self.file.objects.len() == 1 => only.mesh.name.clone(),
            _ => format!("{} objects", self.file.objects.len()),
        }
    }
}

fn check_time(view: &ViewEntry, loaded: &[Loaded]) -> Result<(), Failure> {
    if view.time_s.is_none() || loaded.iter().any(|loaded| loaded.mesh.animation.is_some()) {
        return Ok(());
    }
    let what = match loaded {
        [only] => format!("the mesh `{}` has no animation", only.mesh.name),
        _ => "no mesh has an animation".to_owned(),
    };
    Err(Failure::usage(format!("--time: {what}"), "glTF files may have one; --deform moves any mesh"))
}

/// Moves the vertices to where time and deformation want them.
fn pose(mesh: &mut Mesh, view: &ViewEntry) {
    let mut positions: Vec<Vec3> = Vec::new();
    if let Some(time_s) = view.time_s {
        mesh.pose(time_s, &mut positions);
        std::mem::swap(&mut mesh.positions, &mut positions);
    }
    if let Some(Deformed { deform, phase }) = view.deform {
        deform.apply(phase as f32, &mesh.positions, &mut positions);
        std::mem::swap(&mut mesh.positions, &mut positions);
    }
    if view.time_s.is_some() || view.deform.is_some() {
        let mut normals = Vec::new();
        mesh.normals_of(&mesh.positions, &mut normals);
        mesh.normals = normals;
    }
}
