//! How a scene is drawn: method, mapping, form and lines.

use tam_shaders::cpu;

/// A shading method. Each is a pass of its own; all share scene, mesh and map.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord, serde::Serialize, serde::Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Method {
    /// The wanted tone in continuous grey: the yardstick of cost and accuracy.
    Phong,
    /// Praun 2001: six columns, weighted at the vertices.
    SixWay,
    /// Suarez 2013: light-aligned frames per face, blended across edges.
    FaceFrame,
    /// Freudenberg 2001: one composited map and a threshold.
    StrokeMap,
    /// Freudenberg 2001: lines whose width follows the tone.
    Halftone,
    /// Webb 2002: many columns, smooth tone.
    FineTone,
    /// Engraving, on Knöppel 2015: one line field over the whole surface.
    Stripes,
}

impl Method {
    /// All methods, the yardstick first.
    pub const ALL: [Self; 7] =
        [Self::Phong, Self::SixWay, Self::FaceFrame, Self::StrokeMap, Self::Halftone, Self::FineTone, Self::Stripes];

    /// Its name on the command line.
    pub fn name(self) -> &'static str {
        match self {
            Self::Phong => "phong",
            Self::SixWay => "six-way",
            Self::FaceFrame => "face-frame",
            Self::StrokeMap => "stroke-map",
            Self::Halftone => "halftone",
            Self::FineTone => "fine-tone",
            Self::Stripes => "stripes",
        }
    }

    /// The method of a name.
    pub fn named(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|method| method.name() == name)
    }

    /// Whether its strokes lie by a [`Mapping`]; `phong` has none, `face-frame` and `stripes` bring their own.
    pub fn takes_mapping(self) -> bool {
        !matches!(self, Self::Phong | Self::FaceFrame | Self::Stripes)
    }
}

/// How the tile reaches the surface.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord, serde::Serialize, serde::Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Mapping {
    /// The mesh's own parametrisation.
    Uv,
    /// The light-aligned frame of each face.
    Frames,
    /// Three planes, blended by the normal.
    Triplanar,
    /// Overlapping patches that follow a direction field (Praun 2001, section 6, made current).
    Patches,
    /// Lapped patches as Praun and others paint them.
    Lapped,
}

impl Mapping {
    /// All mappings.
    pub const ALL: [Self; 5] = [Self::Uv, Self::Frames, Self::Triplanar, Self::Patches, Self::Lapped];

    /// Its name on the command line.
    pub fn name(self) -> &'static str {
        match self {
            Self::Uv => "uv",
            Self::Frames => "frames",
            Self::Triplanar => "triplanar",
            Self::Patches => "patches",
            Self::Lapped => "lapped",
        }
    }

    /// The mapping of a name.
    pub fn named(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|mapping| mapping.name() == name)
    }

    /// Whether it needs a [`Surface`](crate::surface::Surface) on the mesh.
    pub fn takes_surface(self) -> bool {
        matches!(self, Self::Patches | Self::Lapped)
    }

    /// The mesh's own uv where it has one, else three planes.
    pub fn of(mesh: &crate::mesh::Mesh) -> Self {
        if mesh.uvs.is_empty() { Self::Triplanar } else { Self::Uv }
    }
}

/// Whether a method is drawn as its source prints it.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, PartialOrd, Ord, serde::Serialize, serde::Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Form {
    /// With the remedies for its known failures.
    #[default]
    Hardened,
    /// As printed, failures included.
    Literal,
}

/// How patterns that overlap are joined.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, PartialOrd, Ord, serde::Serialize, serde::Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Blend {
    /// Strokes thin out and end whole.
    #[default]
    Union,
    /// Strokes fade, as in pencil.
    Linear,
}

/// Which way the strokes of patches turn.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, serde::Serialize, serde::Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Follow {
    /// Along the direction field, still on the surface.
    #[default]
    Surface,
    /// Across the light, in quantised angles that pass into each other.
    Light,
}

/// Where the frames of `face-frame` are made; kept to be measured against each other.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, serde::Serialize, serde::Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum FaceFrameForm {
    /// By a compute pass when light or mesh change, and fetched by each fragment; the literal form is always drawn so.
    Fetched,
    /// By the vertex stage, three vertices a face, four frames each, as in the paper's geometry stage.
    Vertex,
    /// By a compute pass, and fetched by the vertex stage.
    #[default]
    VertexFetched,
}

/// What is shown in place of a method's ink, over the same geometry, light, mapping and map.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord, serde::Serialize, serde::Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum DebugView {
    /// The wanted darkness, in linear light, with isolines at the map's tones.
    Tone,
    /// The level of detail that the method samples.
    Level,
    /// The two columns that bracket the wanted tone, by their shares.
    Columns,
    /// The direction in which strokes run on the screen.
    Frames,
    /// How much of the neighbours' patterns `face-frame` blends in.
    Adjacency,
    /// The triangles.
    Triangles,
}

impl DebugView {
    /// All views.
    pub const ALL: [Self; 6] = [Self::Tone, Self::Level, Self::Columns, Self::Frames, Self::Adjacency, Self::Triangles];

    /// Its name on the command line.
    pub fn name(self) -> &'static str {
        match self {
            Self::Tone => "tone",
            Self::Level => "level",
            Self::Columns => "columns",
            Self::Frames => "frames",
            Self::Adjacency => "adjacency",
            Self::Triangles => "triangles",
        }
    }

    /// The view of a name.
    pub fn named(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|view| view.name() == name)
    }

    /// What its colours say, in one line. Where a method has nothing of it, the surface is grey.
    pub fn description(self) -> &'static str {
        match self {
            Self::Tone => "Wanted tone, with a line where it is that of a column",
            Self::Level => {
                "Level of detail: 0 green, then yellow, orange, red, magenta; hatched: magnified; dark: coarser than the map"
            }
            Self::Columns => "Columns of the map that are mixed, a hue for each; grey is paper",
            Self::Frames => {
                "Direction of strokes: horizontal red, rising green, vertical cyan, falling violet; pale where they disagree"
            }
            Self::Adjacency => "Share of the neighbours' patterns in face-frame: none is white",
            Self::Triangles => "Triangles of the mesh",
        }
    }
}

/// Contour, border and crease lines.
#[derive(Clone, Copy, Debug, PartialEq, serde::Serialize, serde::Deserialize)]
#[serde(default)]
pub struct Silhouettes {
    /// On the screen, 0.25..=64.
    pub width_px: f64,
    /// Where the surface turns away.
    pub contours: bool,
    /// Where the surface ends.
    pub borders: bool,
    /// Where faces meet at more than this many degrees, 0..=180; `None`: no creases.
    pub crease_deg: Option<f64>,
}

impl Default for Silhouettes {
    fn default() -> Self {
        Self { width_px: 2.0, contours: true, borders: true, crease_deg: Some(75.0) }
    }
}

/// What of the drawing itself a picture shows. What a stored one does not name is as by default.
#[derive(Clone, Copy, Debug, Default, PartialEq, serde::Serialize, serde::Deserialize)]
#[serde(default)]
pub struct Inspect {
    /// What is shown in place of the ink; `None`: the ink.
    pub debug: Option<DebugView>,
    /// Width in pixels of lines along all edges of triangles, 0.25..=16; `None`: no such lines.
    pub wireframe: Option<f64>,
}

impl Inspect {
    /// The same for a picture so many times as high.
    #[must_use]
    pub fn times_as_high(&self, times: f64) -> Self {
        Self { wireframe: self.wireframe.map(|width_px| width_px * times), ..*self }
    }
}

/// How an object is drawn: the look of its strokes and lines. What a stored one does not name is as by default.
#[derive(Clone, Copy, Debug, PartialEq, serde::Serialize, serde::Deserialize)]
#[serde(default)]
pub struct RenderParams {
    /// The shading method.
    pub method: Method,
    /// How strokes lie on the surface, for methods that take a mapping.
    pub mapping: Mapping,
    /// Hardened, or as printed.
    pub form: Form,
    /// How overlapping patterns are joined.
    pub blend: Blend,
    /// Which way patches turn; the surface must have been made for it.
    pub follow: Follow,
    /// Where `face-frame` makes its frames.
    pub face_frame: FaceFrameForm,
    /// Repeats of the tile per world unit, > 0. Meshes are 2 units long.
    pub tiles_per_unit: f64,
    /// Added to the level of detail, -4..=4; negative is finer.
    pub level_bias: f64,
    /// Slope of the literal one-sided threshold, > 1 (Freudenberg's c).
    pub slope: f64,
    /// Least distance of halftone lines and stripes on the screen, in pixels, 2..=256.
    pub line_period_px: f64,
    /// Darkness above which stripes are crossed by others, 0..=1; `None`: never.
    pub cross_from: Option<f64>,
    /// How much the strokes of stripes differ, 0..=1: 0 are plain lines; above, lines swell and waver, and then break
    /// into strokes with tapered ends. The surface must have patches that follow it.
    pub variety: f64,
    /// Lines over the strokes.
    pub silhouettes: Option<Silhouettes>,
}

impl RenderParams {
    /// The same for a picture so many times as high that is to look alike: lines, periods and levels keep their shares of
    /// it. Maps whose strokes have `texels` times as many texels, see
    /// [`HatchMap::finer`](crate::maps::HatchMap::finer), take up as much of that as they have.
    #[must_use]
    pub fn times_as_high(&self, times: f64, texels: f64) -> Self {
        Self {
            level_bias: self.level_bias + (times / texels).log2(),
            line_period_px: self.line_period_px * times,
            silhouettes: self.silhouettes.map(|lines| Silhouettes { width_px: lines.width_px * times, ..lines }),
            ..*self
        }
    }

    /// Where the frames of `face-frame` are made: the literal form has its fragments fetch them.
    pub fn frames_made(&self) -> FaceFrameForm {
        if self.form == Form::Literal { FaceFrameForm::Fetched } else { self.face_frame }
    }

    /// The mapping whose patches a frame needs: that of its strokes, also where these make up stripes.
    pub fn needed_mapping(&self) -> Option<Mapping> {
        match self.method {
            Method::Stripes => (self.variety > 0.0).then_some(Mapping::Patches),
            method => method.takes_mapping().then_some(self.mapping),
        }
    }
}

impl Default for RenderParams {
    fn default() -> Self {
        Self {
            method: Method::FineTone,
            mapping: Mapping::Triplanar,
            form: Form::Hardened,
            blend: Blend::Union,
            follow: Follow::Surface,
            face_frame: FaceFrameForm::default(),
            tiles_per_unit: 1.5,
            level_bias: 0.0,
            slope: 6.0,
            line_period_px: 6.0,
            cross_from: Some(0.55),
            variety: 0.0,
            silhouettes: Some(Silhouettes::default()),
        }
    }
}

/// The constants that shaders know these choices by.
macro_rules! constants {
    ($($choice:ident { $($name:ident),+ })+) => {$(
        impl From<$choice> for cpu::$choice {
            fn from(choice: $choice) -> Self {
                match choice {
                    $($choice::$name => Self::$name,)+
                }
            }
        }
    )+};
}

constants! {
    Form { Hardened, Literal }
    Mapping { Uv, Frames, Triplanar, Patches, Lapped }
    Blend { Union, Linear }
    Follow { Surface, Light }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn stored_parameters_come_back_and_lacking_ones_are_as_by_default() {
        let params = RenderParams {
            method: Method::FaceFrame,
            face_frame: FaceFrameForm::Vertex,
            follow: Follow::Light,
            cross_from: None,
            ..RenderParams::default()
        };
        let text = serde_json::to_string(&params).expect("they are numbers and names");
        assert!(text.contains(r#""face_frame":"vertex""#), "{text}");
        assert_eq!(serde_json::from_str::<RenderParams>(&text).expect("what was written"), params);
        let lacking: RenderParams =
            serde_json::from_str(r#"{"form":"literal","silhouettes":{"width_px":3.0}}"#).expect("some of it");
        let silhouettes = Some(Silhouettes { width_px: 3.0, ..Silhouettes::default() });
        assert_eq!(lacking, RenderParams { form: Form::Literal, silhouettes, ..RenderParams::default() });
        let inspect = Inspect { debug: Some(DebugView::Level), wireframe: Some(1.0) };
        let text = serde_json::to_string(&inspect).expect("they are numbers and names");
        assert_eq!(serde_json::from_str::<Inspect>(&text).expect("what was written"), inspect);
    }
}
