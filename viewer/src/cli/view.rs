//! The options that say what is drawn and how, the same for every command that draws.

use std::path::PathBuf;

use clap::builder::{PossibleValue, PossibleValuesParser, TypedValueParser};
use clap::{Args, ValueEnum};
use glam::{DVec2, DVec3};
use tam_gen::command::{Failure, words::path_text};
use tam_viewer::gpu::GpuOptions;
use tam_viewer::scene::MAX_LIGHTS;
use tam_viewer::scene_file::value::{self, Colour, Deformed, OrNone, Orbit, Specular};
use tam_viewer::scene_file::{Camera, LookEntry, MappingEntry, OBJECTS_MAX, ObjectEntry, SceneFile, ViewEntry};
use tam_viewer::{
    Blend, DebugView, Form, Inspect, Light, Mapping, Method, Projection, RenderParams, Silhouettes, ranges,
};

use super::object::{ObjectArg, Settings, object, place};
use super::stage::DEFAULT_MAP;
use super::surface::SurfaceArgs;

/// What is drawn and how.
#[derive(Debug, Args)]
pub(super) struct ViewArgs {
    /// A sample (see `tam-viewer meshes`), or an OBJ, glTF, GLB, PLY or STL file; each one given is an object, named as
    /// the file [default: torus-knot]
    #[arg(long, value_name = "NAME|FILE", help_heading = "What is drawn")]
    mesh: Vec<PathBuf>,
    /// A scene file, with objects, looks, camera and light (see `tam-viewer schema`); options here go before what it says
    /// of all
    #[arg(long, value_name = "FILE", help_heading = "What is drawn")]
    scene: Option<PathBuf>,
    /// Where an object stands: moved, turned about the upright axis in degrees, scaled; may be repeated
    #[arg(long, value_name = "NAME:X,Y,Z[,TURN[,SCALE]]", value_parser = place, help_heading = "What is drawn")]
    place: Vec<ObjectArg>,
    /// A preset by name or file, generated on the fly, or a map: a KTX2 or DDS array, a folder of pictures [default:
    /// pencil]
    #[arg(long, value_name = "PRESET|FILE", help_heading = "What is drawn")]
    map: Option<PathBuf>,
    /// Triangles of a sample, about [default: where it looks right]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(2..=20_000_000), help_heading = "What is drawn")]
    triangles: Option<u32>,
    /// Deform the mesh: twist, wave or breathe, at a phase in periods
    #[arg(long, value_name = "NAME[,PHASE]", value_parser = value::deformed, allow_hyphen_values = true, help_heading = "What is drawn")]
    deform: Option<Deformed>,
    /// Time of the file's animation, in seconds
    #[arg(long, value_name = "S", value_parser = value::in_range(ranges::TIME_S), allow_hyphen_values = true, help_heading = "What is drawn")]
    time: Option<f64>,
    /// Scale the mesh by a factor along each axis
    #[arg(long, value_name = "X,Y,Z", value_parser = value::stretch, allow_hyphen_values = true, help_heading = "What is drawn")]
    stretch: Option<DVec3>,

    /// How strokes lie on the surface; auto: by the mesh's uv where it has one, else patches [default: auto]
    #[arg(long, value_name = "MAPPING", value_parser = mapping_entry(), help_heading = "How it is hatched")]
    mapping: Option<MappingEntry>,
    #[command(flatten)]
    pub(super) surface: SurfaceArgs,
    /// With the remedies for known failures, or as the paper prints it [default: hardened]
    #[arg(long, value_enum, help_heading = "How it is hatched")]
    form: Option<FormArg>,
    /// How overlapping patterns are joined [default: union]
    #[arg(long, value_enum, help_heading = "How it is hatched")]
    blend: Option<BlendArg>,
    /// Repeats of the tile per unit; meshes are 2 units long [default: 1.5]
    #[arg(long, value_name = "N", value_parser = value::in_range(ranges::TILES_PER_UNIT), allow_hyphen_values = true, help_heading = "How it is hatched")]
    tiles: Option<f64>,
    /// Turn all strokes
    #[arg(long, value_name = "DEG", value_parser = value::in_range(ranges::AZIMUTH_DEG), allow_hyphen_values = true, help_heading = "How it is hatched")]
    rotate: Option<f64>,
    /// Multiply the repeats of the tile
    #[arg(long, value_name = "FACTOR", value_parser = value::in_range(ranges::SCALE), allow_hyphen_values = true, help_heading = "How it is hatched")]
    scale: Option<f64>,
    /// Shift the tile, in tiles
    #[arg(long, value_name = "U,V", value_parser = value::shift, allow_hyphen_values = true, help_heading = "How it is hatched")]
    shift: Option<DVec2>,
    /// For one object, or one part of a mesh: method, mapping, map, ink, colour, rotate, visible=false, or any other of
    /// these words; may be repeated
    #[arg(long, value_name = "NAME:KEY=VALUE,…", value_parser = object, help_heading = "How it is hatched")]
    object: Vec<ObjectArg>,
    /// Added to the level of detail; negative is finer
    #[arg(long, value_name = "LEVELS", value_parser = value::in_range(ranges::LEVEL_BIAS), allow_hyphen_values = true, help_heading = "How it is hatched")]
    level_bias: Option<f64>,
    /// Slope of the literal threshold of stroke-map and halftone
    #[arg(long, value_name = "C", value_parser = value::in_range(ranges::SLOPE), allow_hyphen_values = true, help_heading = "How it is hatched")]
    slope: Option<f64>,
    /// Least distance of halftone lines and stripes
    #[arg(long, value_name = "PX", value_parser = value::in_range(ranges::LINE_PERIOD_PX), allow_hyphen_values = true, help_heading = "How it is hatched")]
    line_period: Option<f64>,
    /// Darkness above which stripes are crossed by others, or none [default: 0.55]
    #[arg(long, value_name = "DARKNESS|none", value_parser = value::or_none(ranges::SHARE), allow_hyphen_values = true, help_heading = "How it is hatched")]
    cross: Option<OrNone>,
    /// How much the strokes of stripes differ: 0 for plain lines, up to 1 for a lively burin [default: 0]
    #[arg(long, value_name = "SHARE", value_parser = value::in_range(ranges::VARIETY), allow_hyphen_values = true, help_heading = "How it is hatched")]
    variety: Option<f64>,
    /// Width of contours, borders and creases, or none [default: 2 in a picture of 1024 px]
    #[arg(long, value_name = "PX|none", value_parser = value::or_none(ranges::LINE_WIDTH_PX), allow_hyphen_values = true, help_heading = "How it is hatched")]
    lines: Option<OrNone>,
    /// Angle of faces above which their edge is drawn as a crease, or none
    #[arg(long, value_name = "DEG|none", value_parser = value::or_none(ranges::CREASE_DEG), allow_hyphen_values = true, help_heading = "How it is hatched")]
    crease: Option<OrNone>,

    /// Draw lines, periods and strokes as a picture of this height has them, so that a larger one is the same picture in more
    /// pixels; maps of presets are made finer for it [default: its own height]
    #[arg(long, value_name = "PX", value_parser = clap::value_parser!(u32).range(16..=16384), help_heading = "How it is hatched")]
    for_height: Option<u32>,

    /// Show what the method works with instead of its ink: the wanted tone, the level of detail, the columns that are
    /// mixed, the direction of strokes, the blend of neighbours, or the triangles
    #[arg(long, value_name = "VIEW", value_parser = debug_view(), help_heading = "What is checked")]
    debug: Option<DebugView>,
    /// Draw all edges of triangles, this wide
    #[arg(long, value_name = "PX", value_parser = value::in_range(ranges::WIREFRAME_PX), allow_hyphen_values = true, help_heading = "What is checked")]
    wireframe: Option<f64>,

    /// Azimuth and elevation in degrees, or front, back, left, right, top or bottom, and the distance [default: 30,18 and
    /// all in the picture]
    #[arg(long, value_name = "AZ,EL[,DIST]|VIEW[,DIST]", value_parser = value::orbit, allow_hyphen_values = true, help_heading = "Camera")]
    camera: Option<Orbit>,
    /// What the camera looks at [default: the middle of what is seen]
    #[arg(long, value_name = "X,Y,Z", value_parser = value::point, allow_hyphen_values = true, help_heading = "Camera")]
    target: Option<DVec3>,
    /// Vertical opening in degrees
    #[arg(long, value_name = "DEG", value_parser = value::in_range(ranges::FIELD_OF_VIEW_DEG), allow_hyphen_values = true, help_heading = "Camera")]
    fov: Option<f64>,
    /// Turn about the line of sight: what is seen turns counter-clockwise
    #[arg(long, value_name = "DEG", value_parser = value::in_range(ranges::AZIMUTH_DEG), allow_hyphen_values = true, help_heading = "Camera")]
    roll: Option<f64>,
    /// Whether lines of sight meet in the camera, or are parallel [default: perspective]
    #[arg(long, value_enum, help_heading = "Camera")]
    projection: Option<ProjectionArg>,

    /// A light: AZ,EL[,INTENSITY] from far, at:X,Y,Z[,I] from a point, spot:X,Y,Z,TX,TY,TZ,CUTOFF_DEG,EXPONENT[,I]; may
    /// be repeated
    #[arg(long, value_name = "LIGHT", value_parser = value::light, allow_hyphen_values = true, help_heading = "Light and colours")]
    light: Vec<Light>,
    /// Light from everywhere, 0 to 1
    #[arg(long, value_name = "SHARE", value_parser = value::in_range(ranges::SHARE), allow_hyphen_values = true, help_heading = "Light and colours")]
    ambient: Option<f64>,
    /// A highlight
    #[arg(long, value_name = "STRENGTH[,SHININESS]", value_parser = value::specular, allow_hyphen_values = true, help_heading = "Light and colours")]
    specular: Option<Specular>,
    /// Colour of the paper [default: the preset's]
    #[arg(long, value_name = "COLOUR", value_parser = value::colour, help_heading = "Light and colours")]
    paper: Option<Colour>,
    /// Colour of the ink [default: the preset's]
    #[arg(long, value_name = "COLOUR", value_parser = value::colour, help_heading = "Light and colours")]
    ink: Option<Colour>,
    /// Colours under the strokes [default: mesh]
    #[arg(long, value_enum, help_heading = "Light and colours")]
    colours: Option<ColoursArg>,
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
}

impl AdapterArgs {
    pub(super) fn options(&self) -> GpuOptions {
        GpuOptions { adapter: self.adapter.clone() }
    }
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
enum ProjectionArg {
    Perspective,
    Orthographic,
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

/// Reads the name of a mapping, or `auto`; the help says what each is.
fn mapping_entry() -> impl TypedValueParser<Value = MappingEntry> {
    let about = [
        "The mesh's uv where it has one, else patches",
        "The mesh's own parametrisation",
        "The light-aligned frame of each face",
        "Three planes, blended by the normal",
        "Overlapping patches that follow the form",
        "Lapped patches, as Praun and others paint them",
    ];
    let names = MappingEntry::NAMES.into_iter().zip(about).map(|(name, about)| PossibleValue::new(name).help(about));
    PossibleValuesParser::new(names)
        .map(|name| MappingEntry::named(&name).expect("the parser lets only these names through"))
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
    /// The scene in words: that of the file, with what the options say before what it says of all, and the objects given
    /// here beside its own. What is said of single objects is left for [`ViewArgs::settings`].
    ///
    /// # Errors
    /// A scene file that cannot be read or makes no sense, or more than is drawn.
    pub(super) fn file(&self, method: Option<Method>) -> Result<SceneFile, Failure> {
        if self.light.len() > MAX_LIGHTS {
            return Err(Failure::usage(
                format!("{} lights are given, and at most {MAX_LIGHTS} are drawn", self.light.len()),
                "leave out the faintest",
            ));
        }
        let mut file = match &self.scene {
            Some(path) => SceneFile::load(path).map_err(|error| Failure::File { kind: "scene", error })?,
            None => SceneFile::default(),
        };
        file.objects.extend(self.mesh.iter().map(|mesh| ObjectEntry::of(mesh, None)));
        if file.objects.is_empty() {
            file.objects.push(ObjectEntry::of(DEFAULT_MESH, None));
        }
        if file.objects.len() > OBJECTS_MAX {
            return Err(Failure::usage(
                format!("{} objects are given, and at most {OBJECTS_MAX} are drawn", file.objects.len()),
                "leave some of them out",
            ));
        }
        file.name_objects();
        for object in &mut file.objects {
            object.stretch = object.stretch.or(self.stretch);
        }
        self.count_triangles(&mut file)?;
        file.view = self.view_entry().over(&file.view);
        file.look = self.look_entry(method).over(&file.look);
        Ok(file)
    }

    /// `--triangles`, where there are samples.
    fn count_triangles(&self, file: &mut SceneFile) -> Result<(), Failure> {
        let Some(triangles) = self.triangles else { return Ok(()) };
        let mut samples = file.objects.iter_mut().filter(|object| super::source::is_sample(&object.mesh)).peekable();
        if samples.peek().is_none() {
            return Err(Failure::usage(
                "--triangles is for samples; a file has the triangles that it has",
                "leave it out, or name a sample",
            ));
        }
        samples.for_each(|sample| sample.triangles = sample.triangles.or(Some(triangles)));
        Ok(())
    }

    /// What is said of single objects and parts, in order.
    pub(super) fn settings(&self) -> impl Iterator<Item = (&str, &Settings)> {
        self.place.iter().chain(&self.object).map(|arg| (arg.name.as_str(), &arg.settings))
    }

    fn view_entry(&self) -> ViewEntry {
        ViewEntry {
            camera: Camera {
                orbit: self.camera,
                target: self.target,
                field_of_view_deg: self.fov,
                roll_deg: self.roll,
                projection: self.projection.map(|projection| match projection {
                    ProjectionArg::Perspective => Projection::Perspective,
                    ProjectionArg::Orthographic => Projection::Orthographic,
                }),
            },
            lights: self.light.clone(),
            ambient: self.ambient,
            paper: self.paper,
            transparent: self.transparent.then_some(true),
            time_s: self.time,
            deform: self.deform,
            plain: self.colours.map(|colours| colours == ColoursArg::None),
        }
    }

    fn look_entry(&self, method: Option<Method>) -> LookEntry {
        let mut look = LookEntry {
            method,
            mapping: self.mapping,
            form: self.form.map(|form| match form {
                FormArg::Hardened => Form::Hardened,
                FormArg::Literal => Form::Literal,
            }),
            blend: self.blend.map(|blend| match blend {
                BlendArg::Union => Blend::Union,
                BlendArg::Linear => Blend::Linear,
            }),
            map: self.map.clone(),
            tiles: self.tiles,
            rotate_deg: self.rotate,
            scale: self.scale,
            shift: self.shift,
            level_bias: self.level_bias,
            slope: self.slope,
            line_period_px: self.line_period,
            cross_from: self.cross,
            variety: self.variety,
            lines_px: self.lines,
            crease_deg: self.crease,
            ink: self.ink,
            specular: self.specular,
            ..LookEntry::default()
        };
        self.surface.say(&mut look);
        look
    }

    /// What of the drawing itself is shown, in a picture of this size.
    pub(super) fn inspect(&self, size: [u32; 2]) -> Inspect {
        Inspect { debug: self.debug, wireframe: self.wireframe }.times_as_high(self.times_as_high(size))
    }

    /// How a look in words is drawn.
    pub(super) fn params(&self, look: &LookEntry, has_uv: bool, size: [u32; 2]) -> RenderParams {
        let times = self.times_as_high(size);
        look.params(has_uv, line_width_px(size.map(|side| (f64::from(side) / times).round() as u32)))
    }

    /// How many times as high a picture of this size is as the one that it looks like.
    pub(super) fn times_as_high(&self, size: [u32; 2]) -> f64 {
        self.for_height.map_or(1.0, |height| f64::from(size[1]) / f64::from(height))
    }

    /// Whether a mapping was asked for by name.
    pub(super) fn mapping_given(&self) -> bool {
        self.mapping.is_some_and(|mapping| mapping != MappingEntry::Auto)
    }
}

/// What is drawn where nothing is named.
const DEFAULT_MESH: &str = "torus-knot";

impl ViewArgs {
    /// What a picture is called where nothing is said: as its scene file, or its first mesh.
    pub(super) fn stem(&self) -> String {
        let named = self.scene.as_ref().or(self.mesh.first());
        let stem = named.and_then(|path| path.file_stem()).map(|stem| stem.to_string_lossy().into_owned());
        stem.unwrap_or_else(|| DEFAULT_MESH.to_owned())
    }

    /// The options that name what is drawn.
    pub(super) fn named(&self) -> String {
        let scene = self.scene.iter().map(|path| ("--scene", path_text(path)));
        let meshes = self.mesh.iter().map(|path| ("--mesh", path_text(path)));
        let map = self.map.iter().map(|path| ("--map", path_text(path)));
        let mut words: Vec<(&str, String)> = scene.chain(meshes).collect();
        if words.is_empty() {
            words.push(("--mesh", DEFAULT_MESH.to_owned()));
        }
        if self.scene.is_none() && self.map.is_none() {
            words.push(("--map", DEFAULT_MAP.to_owned()));
        }
        words.extend(map);
        words.into_iter().map(|(name, value)| format!("{name} {value}")).collect::<Vec<_>>().join(" ")
    }
}
