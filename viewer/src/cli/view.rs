//! The options that say what is drawn and how, the same for every command that draws.

use std::path::PathBuf;

use clap::builder::{PossibleValue, PossibleValuesParser, TypedValueParser};
use clap::{Args, ValueEnum};
use glam::{DMat4, DVec2, DVec3};
use tam_gen::command::Failure;
use tam_viewer::gpu::GpuOptions;
use tam_viewer::mesh::Mesh;
use tam_viewer::scene::MAX_LIGHTS;
use tam_viewer::{Blend, DebugView, Form, Light, Mapping, Method, RenderParams, Scene, Silhouettes, ranges};

use super::object::{ObjectArg, object};
use super::parse::{self, Colour, Deformed, OrNone, Orbit, Specular};
use super::stage::with_colours;
use super::surface::SurfaceArgs;

/// What is drawn and how.
#[derive(Debug, Args)]
pub(super) struct ViewArgs {
    /// A sample (see `tam-viewer meshes`), or an OBJ, glTF, GLB, PLY or STL file
    #[arg(long, value_name = "NAME|FILE", default_value = "torus-knot", help_heading = "What is drawn")]
    pub(super) mesh: PathBuf,
    /// A preset by name or file, generated on the fly, or a map: a KTX2 or DDS array, a folder of pictures
    #[arg(long, value_name = "PRESET|FILE", default_value = "pencil", help_heading = "What is drawn")]
    pub(super) map: PathBuf,
    /// Triangles of a sample, about [default: where it looks right]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(2..=20_000_000), help_heading = "What is drawn")]
    pub(super) triangles: Option<u32>,
    /// Deform the mesh: twist, wave or breathe, at a phase in periods
    #[arg(long, value_name = "NAME[,PHASE]", value_parser = parse::deformed, allow_hyphen_values = true, help_heading = "What is drawn")]
    pub(super) deform: Option<Deformed>,
    /// Time of the file's animation, in seconds
    #[arg(long, value_name = "S", value_parser = parse::in_range(ranges::TIME_S), allow_hyphen_values = true, help_heading = "What is drawn")]
    pub(super) time: Option<f64>,
    /// Scale the mesh by a factor along each axis
    #[arg(long, value_name = "X,Y,Z", value_parser = parse::stretch, allow_hyphen_values = true, help_heading = "What is drawn")]
    stretch: Option<DVec3>,

    /// How strokes lie on the surface; auto: by the mesh's uv where it has one, else patches
    #[arg(long, value_enum, default_value = "auto", help_heading = "How it is hatched")]
    mapping: MappingArg,
    #[command(flatten)]
    pub(super) surface: SurfaceArgs,
    /// With the remedies for known failures, or as the paper prints it
    #[arg(long, value_enum, default_value = "hardened", help_heading = "How it is hatched")]
    form: FormArg,
    /// How overlapping patterns are joined
    #[arg(long, value_enum, default_value = "union", help_heading = "How it is hatched")]
    blend: BlendArg,
    /// Repeats of the tile per unit; meshes are 2 units long [default: 1.5]
    #[arg(long, value_name = "N", value_parser = parse::in_range(ranges::TILES_PER_UNIT), allow_hyphen_values = true, help_heading = "How it is hatched")]
    tiles: Option<f64>,
    /// Turn all strokes
    #[arg(long, value_name = "DEG", value_parser = parse::in_range(ranges::AZIMUTH_DEG), allow_hyphen_values = true, help_heading = "How it is hatched")]
    rotate: Option<f64>,
    /// Multiply the repeats of the tile
    #[arg(long, value_name = "FACTOR", value_parser = parse::in_range(ranges::SCALE), allow_hyphen_values = true, help_heading = "How it is hatched")]
    scale: Option<f64>,
    /// Shift the tile, in tiles
    #[arg(long, value_name = "U,V", value_parser = parse::shift, allow_hyphen_values = true, help_heading = "How it is hatched")]
    shift: Option<DVec2>,
    /// For one object of the mesh: map, colour, rotate, scale, shift, specular; may be repeated
    #[arg(long, value_name = "NAME:KEY=VALUE,…", value_parser = object, help_heading = "How it is hatched")]
    pub(super) object: Vec<ObjectArg>,
    /// Added to the level of detail; negative is finer
    #[arg(long, value_name = "LEVELS", value_parser = parse::in_range(ranges::LEVEL_BIAS), allow_hyphen_values = true, help_heading = "How it is hatched")]
    level_bias: Option<f64>,
    /// Slope of the literal threshold of stroke-map and halftone
    #[arg(long, value_name = "C", value_parser = parse::in_range(ranges::SLOPE), allow_hyphen_values = true, help_heading = "How it is hatched")]
    slope: Option<f64>,
    /// Least distance of halftone lines and stripes
    #[arg(long, value_name = "PX", value_parser = parse::in_range(ranges::LINE_PERIOD_PX), allow_hyphen_values = true, help_heading = "How it is hatched")]
    line_period: Option<f64>,
    /// Darkness above which stripes are crossed by others, or none [default: 0.55]
    #[arg(long, value_name = "DARKNESS|none", value_parser = parse::or_none(ranges::SHARE), allow_hyphen_values = true, help_heading = "How it is hatched")]
    cross: Option<OrNone>,
    /// How much the strokes of stripes differ: 0 for plain lines, up to 1 for a lively burin
    #[arg(long, value_name = "SHARE", value_parser = parse::in_range(ranges::VARIETY), default_value = "0", allow_hyphen_values = true, help_heading = "How it is hatched")]
    pub(super) variety: f64,
    /// Width of contours, borders and creases, or none [default: 2 in a picture of 1024 px]
    #[arg(long, value_name = "PX|none", value_parser = parse::or_none(ranges::LINE_WIDTH_PX), allow_hyphen_values = true, help_heading = "How it is hatched")]
    lines: Option<OrNone>,
    /// Angle of faces above which their edge is drawn as a crease, or none
    #[arg(long, value_name = "DEG|none", value_parser = parse::or_none(ranges::CREASE_DEG), allow_hyphen_values = true, help_heading = "How it is hatched")]
    crease: Option<OrNone>,

    /// Show what the method works with instead of its ink: the wanted tone, the level of detail, the columns that are
    /// mixed, the direction of strokes, the blend of neighbours, or the triangles
    #[arg(long, value_name = "VIEW", value_parser = debug_view(), help_heading = "What is checked")]
    debug: Option<DebugView>,
    /// Draw all edges of triangles, this wide
    #[arg(long, value_name = "PX", value_parser = parse::in_range(ranges::WIREFRAME_PX), allow_hyphen_values = true, help_heading = "What is checked")]
    wireframe: Option<f64>,

    /// Azimuth and elevation in degrees, and the distance [default: 30,18 and all in the picture]
    #[arg(long, value_name = "AZ,EL[,DIST]", value_parser = parse::orbit, allow_hyphen_values = true, help_heading = "Camera")]
    pub(super) camera: Option<Orbit>,
    /// What the camera looks at [default: the middle of what is seen]
    #[arg(long, value_name = "X,Y,Z", value_parser = parse::point, allow_hyphen_values = true, help_heading = "Camera")]
    pub(super) target: Option<DVec3>,
    /// Vertical opening in degrees
    #[arg(long, value_name = "DEG", value_parser = parse::in_range(ranges::FIELD_OF_VIEW_DEG), allow_hyphen_values = true, help_heading = "Camera")]
    fov: Option<f64>,

    /// A light: AZ,EL[,INTENSITY] from far, at:X,Y,Z[,I] from a point, spot:X,Y,Z,TX,TY,TZ,CUTOFF_DEG,EXPONENT[,I]; may
    /// be repeated
    #[arg(long, value_name = "LIGHT", value_parser = parse::light, allow_hyphen_values = true, help_heading = "Light and colours")]
    light: Vec<Light>,
    /// Light from everywhere, 0 to 1
    #[arg(long, value_name = "SHARE", value_parser = parse::in_range(ranges::SHARE), allow_hyphen_values = true, help_heading = "Light and colours")]
    ambient: Option<f64>,
    /// A highlight
    #[arg(long, value_name = "STRENGTH[,SHININESS]", value_parser = parse::specular, allow_hyphen_values = true, help_heading = "Light and colours")]
    specular: Option<Specular>,
    /// Colour of the paper [default: the preset's]
    #[arg(long, value_name = "COLOUR", value_parser = parse::colour, help_heading = "Light and colours")]
    paper: Option<Colour>,
    /// Colour of the ink [default: the preset's]
    #[arg(long, value_name = "COLOUR", value_parser = parse::colour, help_heading = "Light and colours")]
    ink: Option<Colour>,
    /// Colours under the strokes
    #[arg(long, value_enum, default_value = "mesh", help_heading = "Light and colours")]
    colours: ColoursArg,
    /// Leave out the paper around the mesh
    #[arg(long, help_heading = "Light and colours")]
    transparent: bool,

    #[command(flatten)]
    pub(super) adapter: AdapterArgs,
}

/// Which adapter draws.
#[derive(Debug, Args)]
pub(super) struct AdapterArgs {
    /// Part of the adapter's name [default: WGPU_ADAPTER_NAME, or the fastest kind]
    #[arg(long, value_name = "NAME", help_heading = "Adapter")]
    adapter: Option<String>,
    /// Do without primitive indices, as on adapters that have none
    #[arg(long, help_heading = "Adapter")]
    flat_face: bool,
}

impl AdapterArgs {
    pub(super) fn options(&self) -> GpuOptions {
        GpuOptions { adapter: self.adapter.clone(), flat_face: self.flat_face }
    }
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(super) enum MappingArg {
    /// The mesh's uv where it has one, else patches
    Auto,
    /// The mesh's own parametrisation
    Uv,
    /// The light-aligned frame of each face
    Frames,
    /// Three planes, blended by the normal
    Triplanar,
    /// Overlapping patches that follow the form
    Patches,
    /// Lapped patches, as Praun and others paint them
    Lapped,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
enum FormArg {
    Hardened,
    Literal,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
enum BlendArg {
    /// Strokes thin out and end whole
    Union,
    /// Strokes fade, as in pencil
    Linear,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
enum ColoursArg {
    /// Paper only
    None,
    /// The mesh's own
    Mesh,
}

/// Reads the name of a method, and lists all in the help.
pub(super) fn method() -> impl TypedValueParser<Value = Method> {
    PossibleValuesParser::new(Method::ALL.map(Method::name))
        .map(|name| Method::named(&name).expect("the parser lets only these names through"))
}

/// Reads the name of a mapping, and lists all in the help.
pub(super) fn mapping() -> impl TypedValueParser<Value = Mapping> {
    PossibleValuesParser::new(Mapping::ALL.map(Mapping::name))
        .map(|name| Mapping::named(&name).expect("the parser lets only these names through"))
}

/// Reads the name of a debug view; the help says what each shows.
fn debug_view() -> impl TypedValueParser<Value = DebugView> {
    let names = DebugView::ALL.map(|view| PossibleValue::new(view.name()).help(view.description()));
    PossibleValuesParser::new(names)
        .map(|name| DebugView::named(&name).expect("the parser lets only these names through"))
}

/// Width of lines where none is given: in proportion to the picture, within what reads as a line.
pub(super) fn line_width_px(size: [u32; 2]) -> f64 {
    let side = f64::from(size[0].min(size[1]));
    (Silhouettes::default().width_px * side / 1024.0).clamp(1.0, 6.0)
}

impl ViewArgs {
    /// How frames are drawn.
    pub(super) fn params(&self, method: Method, mesh: &Mesh, size: [u32; 2]) -> RenderParams {
        let default = RenderParams::default();
        let lines = Silhouettes::default();
        let width_px = self.lines.map_or(Some(line_width_px(size)), |lines| lines.0);
        let crease_deg = self.crease.map_or(lines.crease_deg, |crease| crease.0);
        RenderParams {
            method,
            mapping: self.mapping(mesh),
            form: match self.form {
                FormArg::Hardened => Form::Hardened,
                FormArg::Literal => Form::Literal,
            },
            blend: match self.blend {
                BlendArg::Union => Blend::Union,
                BlendArg::Linear => Blend::Linear,
            },
            follow: self.surface.follow(),
            tiles_per_unit: self.tiles.unwrap_or(default.tiles_per_unit),
            level_bias: self.level_bias.unwrap_or(default.level_bias),
            slope: self.slope.unwrap_or(default.slope),
            line_period_px: self.line_period.unwrap_or(default.line_period_px),
            cross_from: self.cross.map_or(default.cross_from, |cross| cross.0),
            variety: self.variety,
            silhouettes: width_px.map(|width_px| Silhouettes { width_px, crease_deg, ..lines }),
            debug: self.debug,
            wireframe: self.wireframe,
            ..default
        }
    }

    /// The mapping that methods draw a mesh with.
    pub(super) fn mapping(&self, mesh: &Mesh) -> Mapping {
        match self.mapping {
            MappingArg::Auto if mesh.uvs.is_empty() => Mapping::Patches,
            MappingArg::Auto | MappingArg::Uv => Mapping::Uv,
            MappingArg::Frames => Mapping::Frames,
            MappingArg::Triplanar => Mapping::Triplanar,
            MappingArg::Patches => Mapping::Patches,
            MappingArg::Lapped => Mapping::Lapped,
        }
    }

    /// The mapping asked for by name, if any.
    pub(super) fn mapping_given(&self) -> bool {
        self.mapping != MappingArg::Auto
    }

    /// The scene; the camera's place is still that of a default. `colours` are paper and ink of the map's preset, and
    /// `maps` the numbers of the objects' own maps.
    ///
    /// # Errors
    /// More lights than are drawn, or an object that is not there.
    pub(super) fn scene(
        &self,
        mesh: &Mesh,
        colours: Option<([f32; 3], [f32; 3])>,
        maps: &[Option<usize>],
    ) -> Result<Scene, Failure> {
        if self.light.len() > MAX_LIGHTS {
            return Err(Failure::usage(
                format!("{} lights are given, and at most {MAX_LIGHTS} are drawn", self.light.len()),
                "leave out the faintest",
            ));
        }
        let mut scene = with_colours(Scene::of(mesh), colours);
        scene.paper = self.paper.map_or(scene.paper, |paper| paper.0);
        scene.ink = self.ink.map_or(scene.ink, |ink| ink.0);
        scene.transparent = self.transparent;
        if !self.light.is_empty() {
            scene.lights.lights.clone_from(&self.light);
        }
        scene.lights.ambient = self.ambient.unwrap_or(scene.lights.ambient);
        scene.world_from_mesh = DMat4::from_scale(self.stretch.unwrap_or(DVec3::ONE));
        if let Some(Orbit { azimuth_deg, elevation_deg, distance }) = self.camera {
            (scene.camera.azimuth_deg, scene.camera.elevation_deg) = (azimuth_deg, elevation_deg);
            scene.camera.distance = distance.unwrap_or(scene.camera.distance);
        }
        scene.camera.target = self.target.unwrap_or(scene.camera.target);
        scene.camera.field_of_view_deg = self.fov.unwrap_or(scene.camera.field_of_view_deg);
        for material in &mut scene.materials {
            if self.colours == ColoursArg::None {
                material.colour = [1.0; 3];
            }
            material.rotation_deg = self.rotate.unwrap_or(material.rotation_deg);
            material.scale = self.scale.unwrap_or(material.scale);
            material.shift = self.shift.unwrap_or(material.shift);
            if let Some(specular) = self.specular {
                (material.specular, material.shininess) = (specular.strength, specular.shininess);
            }
        }
        for (object, map) in self.object.iter().zip(maps) {
            object.apply(&mesh.parts, &mut scene.materials, *map)?;
        }
        Ok(scene)
    }

    /// Whether the camera is left to find its own distance.
    pub(super) fn fits_distance(&self) -> bool {
        self.camera.is_none_or(|camera| camera.distance.is_none())
    }
}
