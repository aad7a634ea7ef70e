//! How strokes are put on the surface.

use glam::{DMat4, DVec3};
use serde::{Deserialize, Serialize};

use crate::mesh::Mesh;
use crate::scene::Lights;
use crate::scene_file::{FieldEntry, LookEntry};
use crate::surface::{FieldOptions, FieldSource, Guide, StripeOptions, SurfaceNeeds, SurfaceOptions};
use crate::{Mapping, Method, RenderParams};

/// What strokes follow.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum FieldChoice {
    /// Rings round a finger.
    #[default]
    Curvature,
    /// Along a finger.
    LowerCurvature,
    /// Across the light.
    Light,
    /// The mesh's own uv.
    Uv,
    /// One direction in space.
    Constant(DVec3),
}

impl FieldChoice {
    /// All kinds, in the order in which they are offered.
    pub const ALL: [Self; 5] = [Self::Curvature, Self::LowerCurvature, Self::Light, Self::Uv, Self::Constant(DVec3::Y)];

    /// What it is called.
    pub fn label(self) -> &'static str {
        match self {
            Self::Curvature => "Around the form",
            Self::LowerCurvature => "Along the form",
            Self::Light => "Across the light",
            Self::Uv => "The mesh's uv",
            Self::Constant(_) => "One direction",
        }
    }
}

/// Method, mapping, and what both need of the surface.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct Look {
    /// How frames are drawn.
    pub params: RenderParams,
    /// What strokes follow.
    pub field: FieldChoice,
    /// How far directions spread, as a multiple of the default.
    pub smoothing: f64,
    /// Strokes drawn on the surface, which the field follows.
    pub guides: Vec<Guide>,
    /// Lay patches by projection on planes.
    pub planar: bool,
    /// Stripes per unit at their coarsest.
    pub lines_per_unit: f64,
}

impl Default for Look {
    fn default() -> Self {
        Self {
            params: RenderParams { method: Method::SixWay, mapping: Mapping::Patches, ..RenderParams::default() },
            field: FieldChoice::default(),
            smoothing: 1.0,
            guides: Vec::new(),
            planar: false,
            lines_per_unit: StripeOptions::default().lines_per_unit,
        }
    }
}

impl Look {
    /// The same, as far as a mesh allows: uv where it has none become patches.
    pub fn fitted(&self, mesh: &Mesh) -> Self {
        let mut fitted = self.clone();
        if mesh.uvs.is_empty() {
            if fitted.params.mapping == Mapping::Uv {
                fitted.params.mapping = Mapping::Patches;
            }
            if fitted.field == FieldChoice::Uv {
                fitted.field = FieldChoice::Curvature;
            }
        }
        fitted
    }

    /// The same drawn in another way: its method, form, and what goes with these; lines over the strokes and all that
    /// methods share stay.
    pub fn with_way(&self, way: &RenderParams) -> Self {
        let mut look = self.clone();
        let params = &mut look.params;
        (params.method, params.form) = (way.method, way.form);
        if way.method.takes_mapping() {
            params.mapping = way.mapping;
        }
        if way.method == Method::Stripes {
            (params.cross_from, params.variety) = (way.cross_from, way.variety);
        }
        look
    }

    /// The same with what words say of a part of a mesh with or without uv; guides in files stay as they are.
    pub fn with(&self, words: &LookEntry, has_uv: bool) -> Self {
        let field = match &words.field {
            None | Some(FieldEntry::Guides(_)) => self.field,
            Some(FieldEntry::Curvature) => FieldChoice::Curvature,
            Some(FieldEntry::Lower) => FieldChoice::LowerCurvature,
            Some(FieldEntry::Light) => FieldChoice::Light,
            Some(FieldEntry::Uv) => FieldChoice::Uv,
            Some(FieldEntry::Along(direction)) => FieldChoice::Constant(*direction),
        };
        Self {
            params: words.apply(&self.params, has_uv),
            field,
            smoothing: words.smoothing.unwrap_or(self.smoothing),
            guides: self.guides.clone(),
            planar: words.planar.unwrap_or(self.planar),
            lines_per_unit: words.stripes.unwrap_or(self.lines_per_unit),
        }
    }

    /// What has to be made of the surface of a mesh that stands here before it can be drawn; `None`: nothing.
    pub fn surface_options(&self, lights: &Lights, world_from_mesh: DMat4) -> Option<SurfaceOptions> {
        let field = self.field_options(lights, world_from_mesh);
        SurfaceNeeds::of(&self.params).options(field, &self.params, self.planar, self.lines_per_unit)
    }

    /// Which way strokes run on a mesh that stands here.
    pub fn field_options(&self, lights: &Lights, world_from_mesh: DMat4) -> FieldOptions {
        let source = match self.field {
            FieldChoice::Curvature => FieldSource::Curvature,
            FieldChoice::LowerCurvature => FieldSource::LowerCurvature,
            FieldChoice::Light => FieldSource::Light(lights.towards_first(world_from_mesh)),
            FieldChoice::Uv => FieldSource::Uv,
            FieldChoice::Constant(direction) => FieldSource::Constant(direction),
        };
        FieldOptions { source, smoothing: self.smoothing, guides: self.guides.clone() }
    }
}
