//! The options of surfaces that strokes follow.

use std::path::PathBuf;

use clap::{Args, ValueEnum};
use glam::DVec3;
use tam_gen::command::{Failure, Output};
use tam_viewer::mesh::Mesh;
use tam_viewer::surface::{
    FieldOptions, FieldSource, Guide, LappedOptions, PatchOptions, StripeOptions, Surface, SurfaceOptions, guides,
};
use tam_viewer::{Follow, LightKind, Mapping, Method, Scene, ranges};

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
        tiles_per_unit: f64,
        output: &Output,
    ) -> Result<Option<(Mesh, Surface)>, Failure> {
        let patches = mappings.contains(&Mapping::Patches).then(|| PatchOptions {
            tiles_per_unit,
            follow: self.follow(),
            ..PatchOptions::default()
        });
        let lapped =
            mappings.contains(&Mapping::Lapped).then(|| LappedOptions { tiles_per_unit, ..LappedOptions::default() });
        let default = StripeOptions::default();
        let stripes = methods
            .contains(&Method::Stripes)
            .then(|| StripeOptions { lines_per_unit: self.stripes.unwrap_or(default.lines_per_unit), ..default });
        if patches.is_none() && lapped.is_none() && stripes.is_none() {
            return Ok(None);
        }
        let edges = [patches.map(|patches| patches.longest_edge()), lapped.map(|lapped| lapped.longest_edge())];
        let fine = match edges.into_iter().flatten().reduce(f64::min) {
            Some(longest) => mesh.subdivided(longest as f32),
            None => mesh.clone(),
        };
        if fine.triangles.len() > mesh.triangles.len() && !output.json {
            output.remark(&format!("note: cut into {} triangles, so that patches bend", fine.triangles.len()));
        }
        let options = SurfaceOptions { field: self.field(mesh, scene)?, patches, lapped, stripes };
        let surface = Surface::new(&fine, &options).map_err(report::surface)?;
        Ok(Some((fine, surface)))
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
