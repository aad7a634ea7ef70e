//! The options of surfaces that strokes follow.

use std::path::PathBuf;

use clap::{Args, ValueEnum};
use glam::DVec3;
use tam_gen::Job;
use tam_gen::command::{Failure, Output, Progress, interrupt};
use tam_viewer::mesh::Mesh;
use tam_viewer::surface::store::StoreError;
use tam_viewer::surface::{
    FieldOptions, FieldSource, Guide, StripeOptions, Surface, SurfaceNeeds, SurfaceOptions, guides, store,
};
use tam_viewer::{Follow, LightKind, Mapping, Method, RenderParams, Scene, ranges};

use super::{parse, report};

/// Which way strokes run on the surface.
#[derive(Debug, Args)]
pub(super) struct SurfaceArgs {
    /// What strokes follow with patches, lapped and stripes: curvature, lower (the direction in which the surface bends
    /// least), light, uv, a direction X,Y,Z, or guides:FILE
    #[arg(long, value_name = "SOURCE", value_parser = source, default_value = "curvature", allow_hyphen_values = true, help_heading = "How it is hatched")]
    field: Source,
    /// How far directions spread into places without one, as a multiple of the default
    #[arg(long, value_name = "FACTOR", value_parser = parse::in_range(ranges::SMOOTHING), default_value = "1", allow_hyphen_values = true, help_heading = "How it is hatched")]
    smoothing: f64,
    /// Stripes per unit at their coarsest, before any is doubled
    #[arg(long, value_name = "N", value_parser = parse::in_range(ranges::LINES_PER_UNIT), allow_hyphen_values = true, help_heading = "How it is hatched")]
    stripes: Option<f64>,
    /// Whether patches lie still along the field, or turn across the light
    #[arg(long, value_enum, default_value = "surface", help_heading = "How it is hatched")]
    follow: FollowArg,
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

/// What `--field` names.
#[derive(Clone, Debug, PartialEq)]
enum Source {
    Curvature,
    Lower,
    Light,
    Uv,
    Along(DVec3),
    Guides(PathBuf),
}

fn source(text: &str) -> Result<Source, String> {
    match text {
        "curvature" => return Ok(Source::Curvature),
        "lower" => return Ok(Source::Lower),
        "light" => return Ok(Source::Light),
        "uv" => return Ok(Source::Uv),
        _ => {}
    }
    if let Some(file) = text.strip_prefix("guides:") {
        return if file.is_empty() { Err("guides: needs a file".into()) } else { Ok(Source::Guides(file.into())) };
    }
    if text.contains(',') {
        let direction = parse::point(text)?;
        return if direction.length() > 0.0 {
            Ok(Source::Along(direction))
        } else {
            Err("0,0,0 is no direction".into())
        };
    }
    Err("allowed: curvature, lower, light, uv, a direction X,Y,Z, or guides:FILE".into())
}

impl SurfaceArgs {
    /// What patches follow.
    pub(super) fn follow(&self) -> Follow {
        match self.follow {
            FollowArg::Surface => Follow::Surface,
            FollowArg::Light => Follow::Light,
        }
    }

    /// The field asked for.
    pub(super) fn field(&self, mesh: &Mesh, scene: &Scene) -> Result<FieldOptions, Failure> {
        let mut guides: Vec<Guide> = Vec::new();
        let source = match &self.field {
            Source::Curvature => FieldSource::Curvature,
            Source::Lower => FieldSource::LowerCurvature,
            Source::Light => FieldSource::Light(to_light(scene)),
            Source::Uv if mesh.uvs.is_empty() => {
                return Err(Failure::usage(
                    format!("--field uv: the mesh `{}` has no uv", mesh.name),
                    "the other fields need none",
                ));
            }
            Source::Uv => FieldSource::Uv,
            Source::Along(direction) => FieldSource::Constant(*direction),
            Source::Guides(path) => {
                guides = guides::read(path).map_err(|error| report::guides(path, &error))?;
                FieldSource::Curvature
            }
        };
        Ok(FieldOptions { source, smoothing: self.smoothing, guides })
    }

    /// The surface for some methods and mappings, and the mesh that it belongs to, cut where it is too coarse; `None`
    /// where none needs one.
    pub(super) fn build(
        &self,
        mesh: &Mesh,
        scene: &Scene,
        methods: &[Method],
        mappings: &[Mapping],
        params: &RenderParams,
        output: &Output,
    ) -> Result<Option<(Mesh, Surface)>, Failure> {
        let own = [params.mapping];
        let ways = methods.iter().flat_map(|method| {
            let mappings = if method.takes_mapping() { mappings } else { &own };
            mappings.iter().map(|mapping| RenderParams { method: *method, mapping: *mapping, ..*params })
        });
        let needs = ways.map(|way| SurfaceNeeds::of(&way)).fold(SurfaceNeeds::default(), SurfaceNeeds::and);
        if needs.stripes && params.variety > 0.0 && self.follow() == Follow::Light {
            return Err(Failure::usage(
                "--follow light: the strokes of stripes cannot turn",
                "leave it out, or draw plain lines with --variety 0",
            ));
        }
        if needs == SurfaceNeeds::default() {
            return Ok(None);
        }
        let lines_per_unit = self.stripes.unwrap_or(StripeOptions::default().lines_per_unit);
        let params = RenderParams { follow: self.follow(), ..*params };
        let Some(options) = needs.options(self.field(mesh, scene)?, &params, self.planar, lines_per_unit) else {
            return Ok(None);
        };
        let fine = options.cut(mesh).unwrap_or_else(|| mesh.clone());
        if fine.triangles.len() > mesh.triangles.len() && !output.json {
            output.remark(&format!("note: cut into {} triangles, so that patches bend", fine.triangles.len()));
        }
        let surface = self.made(&fine, &options, output)?;
        Ok(Some((fine, surface)))
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
        let surface = Surface::new_with(mesh, options, &job).map_err(report::surface)?;
        if let Some(path) = &self.surface {
            store::write(path, mesh, options, &surface).map_err(|error| report::store(path, &error))?;
        }
        Ok(surface)
    }
}

/// Towards the first light, in mesh space.
fn to_light(scene: &Scene) -> DVec3 {
    let to_light = scene.lights.lights.first().map_or(DVec3::Y, |light| match light.kind {
        LightKind::Directional { direction } => -direction,
        LightKind::Positional { position } | LightKind::Spot { position, .. } => position,
    });
    scene.world_from_mesh.inverse().transform_vector3(to_light)
}
