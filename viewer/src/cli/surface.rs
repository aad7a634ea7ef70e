//! The options of surfaces that strokes follow, and the surfaces made by them.

use std::path::PathBuf;

use clap::{Args, ValueEnum};
use glam::DMat4;
use tam_gen::Job;
use tam_gen::command::{Failure, Output, Progress, interrupt};
use tam_viewer::mesh::Mesh;
use tam_viewer::scene::Lights;
use tam_viewer::scene_file::{FieldEntry, LookEntry, value};
use tam_viewer::surface::store::StoreError;
use tam_viewer::surface::{
    FieldOptions, FieldSource, Guide, StripeOptions, Surface, SurfaceNeeds, SurfaceOptions, guides, store,
};
use tam_viewer::{Follow, RenderParams, ranges};

use super::report;

/// Which way strokes run on the surface.
#[derive(Debug, Args)]
pub(super) struct SurfaceArgs {
    /// What strokes follow with patches, lapped and stripes: curvature, lower (the direction in which the surface bends
    /// least), light, uv, a direction X,Y,Z, or guides:FILE [default: curvature]
    #[arg(long, value_name = "SOURCE", value_parser = value::field, allow_hyphen_values = true, help_heading = "How it is hatched")]
    field: Option<FieldEntry>,
    /// How far directions spread into places without one, as a multiple of the default [default: 1]
    #[arg(long, value_name = "FACTOR", value_parser = value::in_range(ranges::SMOOTHING), allow_hyphen_values = true, help_heading = "How it is hatched")]
    smoothing: Option<f64>,
    /// Stripes per unit at their coarsest, before any is doubled
    #[arg(long, value_name = "N", value_parser = value::in_range(ranges::LINES_PER_UNIT), allow_hyphen_values = true, help_heading = "How it is hatched")]
    stripes: Option<f64>,
    /// Whether patches lie still along the field, or turn across the light [default: surface]
    #[arg(long, value_enum, help_heading = "How it is hatched")]
    follow: Option<FollowArg>,
    /// Lay patches by projection on planes: cheaper to make, true on flat ground only
    #[arg(long, help_heading = "How it is hatched")]
    planar: bool,
    /// Keep field, patches and stripes in this file: it is read if it was made for the same mesh and options, else written
    #[arg(long, value_name = "FILE", help_heading = "How it is hatched")]
    surface: Option<PathBuf>,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
enum FollowArg {
    Surface,
    Light,
}

/// A surface that is wanted: its options are those of a look.
pub(super) struct Wanted<'a> {
    /// The mesh, still uncut.
    pub(super) mesh: &'a Mesh,
    /// What is drawn with it.
    pub(super) needs: SurfaceNeeds,
    /// The field.
    pub(super) field: FieldOptions,
    /// Tiles, and what patches follow.
    pub(super) params: RenderParams,
    /// The look.
    pub(super) look: &'a LookEntry,
}

/// The field that a look asks for, on a mesh that stands here.
pub(super) fn field(
    look: &LookEntry,
    mesh: &Mesh,
    lights: &Lights,
    world_from_mesh: DMat4,
) -> Result<FieldOptions, Failure> {
    let mut guides: Vec<Guide> = Vec::new();
    let source = match look.field.as_ref().unwrap_or(&FieldEntry::Curvature) {
        FieldEntry::Curvature => FieldSource::Curvature,
        FieldEntry::Lower => FieldSource::LowerCurvature,
        FieldEntry::Light => FieldSource::Light(lights.towards_first(world_from_mesh)),
        FieldEntry::Uv if mesh.uvs.is_empty() => {
            return Err(Failure::usage(
                format!("--field uv: the mesh `{}` has no uv", mesh.name),
                "the other fields need none",
            ));
        }
        FieldEntry::Uv => FieldSource::Uv,
        FieldEntry::Along(direction) => FieldSource::Constant(*direction),
        FieldEntry::Guides(path) => {
            guides = guides::read(path).map_err(|error| report::guides(path, &error))?;
            FieldSource::Curvature
        }
    };
    if let Some(path) = &look.guides {
        guides.extend(guides::read(path).map_err(|error| report::guides(path, &error))?);
    }
    Ok(FieldOptions { source, smoothing: look.smoothing.unwrap_or(1.0), guides })
}

/// What ways to draw need together of a surface.
pub(super) fn needs_of(ways: impl IntoIterator<Item = RenderParams>) -> Result<SurfaceNeeds, Failure> {
    let mut needs = SurfaceNeeds::default();
    for way in ways {
        needs = needs.and(SurfaceNeeds::of(&way));
        if needs.stripes && way.variety > 0.0 && way.follow == Follow::Light {
            return Err(Failure::usage(
                "--follow light: the strokes of stripes cannot turn",
                "leave it out, or draw plain lines with --variety 0",
            ));
        }
    }
    Ok(needs)
}

impl SurfaceArgs {
    /// Says it of a look.
    pub(super) fn say(&self, look: &mut LookEntry) {
        look.field.clone_from(&self.field);
        look.smoothing = self.smoothing;
        look.stripes = self.stripes;
        look.follow = self.follow.map(|follow| match follow {
            FollowArg::Surface => Follow::Surface,
            FollowArg::Light => Follow::Light,
        });
        look.planar = self.planar.then_some(true);
    }

    /// Whether surfaces are kept in a file, which takes one.
    pub(super) fn is_kept(&self) -> bool {
        self.surface.is_some()
    }

    /// A surface, and the mesh that it belongs to where that had to be cut; `None` where none is needed.
    pub(super) fn build(
        &self,
        wanted: Wanted<'_>,
        output: &Output,
    ) -> Result<Option<(Option<Mesh>, Surface)>, Failure> {
        let Wanted { mesh, needs, field, params, look } = wanted;
        let lines_per_unit = look.stripes.unwrap_or(StripeOptions::default().lines_per_unit);
        let planar = look.planar.unwrap_or(false);
        let Some(options) = needs.options(field, &params, planar, lines_per_unit) else { return Ok(None) };
        let cut = interrupt::at_once(output, || options.cut(mesh))?;
        if let Some(cut) = cut.as_ref().filter(|_| !output.json) {
            let triangles = cut.mesh.triangles.len();
            output.remark(&format!("note: cut into {triangles} triangles, so that patches bend"));
            if let Some(note) = cut.note() {
                output.remark(&format!("note: {note}"));
            }
        }
        let surface = self.made(cut.as_ref().map_or(mesh, |cut| &cut.mesh), &options, output)?;
        Ok(Some((cut.map(|cut| cut.mesh), surface)))
    }

    /// The surface of the file, where it is for this mesh and these options, else a new one.
    fn made(&self, mesh: &Mesh, options: &SurfaceOptions, output: &Output) -> Result<Surface, Failure> {
        let remark = |text: &str| {
            if !output.json {
                output.remark(text);
            }
        };
        if let Some(path) = self.surface.as_ref().filter(|path| path.exists()) {
            match store::read(path, mesh, options) {
                Ok(Some(surface)) => return Ok(surface),
                Ok(None) => {
                    remark("note: the surface in the file is of another mesh or other options; it is made anew")
                }
                // What is no surface may be anything that somebody needs.
                Err(error @ StoreError::Format) => return Err(report::store(path, &error)),
                Err(error) => remark(&format!("note: {}: {error}; it is made anew", path.display())),
            }
        }
        let progress = Progress::new("field and patches", output.quiet || output.json);
        let done = |part: f32| progress.set(part);
        let job = Job { progress: Some(&done), cancel: Some(interrupt::flag()), measure: None };
        let surface =
            interrupt::at_once(output, || Surface::new_with(mesh, options, &job))?.map_err(report::surface)?;
        if let Some(path) = &self.surface {
            store::write(path, mesh, options, &surface).map_err(|error| report::store(path, &error))?;
        }
        Ok(surface)
    }
}
