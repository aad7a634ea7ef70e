//! Whole WGSL modules from shared pieces: each piece is included once, where it is first asked for.

/// The passes, each with an entry file of its own.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Pass {
    /// Normals and barycentric planes of all faces.
    FaceGeometry,
    /// Light-aligned frames of all faces.
    FaceFrames,
    /// Continuous grey: the wanted tone.
    Phong,
    /// Praun's blend of six columns, weighted at the vertices.
    SixWay,
    /// Suarez's light-aligned frames, fetched per fragment: the literal form.
    FaceFrame,
    /// The same with the work in the vertex stage.
    FaceFrameVertex,
    /// Freudenberg's threshold, and halftone lines.
    StrokeMap,
    /// Webb's many columns.
    FineTone,
    /// Lines along a field over the whole surface.
    Stripes,
    /// What a method works with, in its ink's place.
    Debug,
    /// The edges that are contours, borders and creases.
    LineEdges,
    /// Contours, borders, creases and the wireframe.
    Lines,
}

impl Pass {
    /// All passes.
    pub const ALL: [Self; 12] = [
        Self::FaceGeometry,
        Self::FaceFrames,
        Self::Phong,
        Self::SixWay,
        Self::FaceFrame,
        Self::FaceFrameVertex,
        Self::StrokeMap,
        Self::FineTone,
        Self::Stripes,
        Self::Debug,
        Self::LineEdges,
        Self::Lines,
    ];

    /// The stem of its entry file, and its label on the GPU.
    pub fn name(self) -> &'static str {
        match self {
            Self::FaceGeometry => "face_geometry",
            Self::FaceFrames => "face_frames",
            Self::Phong => "phong",
            Self::SixWay => "six_way",
            Self::FaceFrame => "face_frame",
            Self::FaceFrameVertex => "face_frame_vertex",
            Self::StrokeMap => "stroke_map",
            Self::FineTone => "fine_tone",
            Self::Stripes => "stripes",
            Self::Debug => "debug",
            Self::LineEdges => "line_edges",
            Self::Lines => "lines",
        }
    }

    fn source(self) -> &'static str {
        match self {
            Self::FaceGeometry => include_str!("../wgsl/face_geometry.wgsl"),
            Self::FaceFrames => include_str!("../wgsl/face_frames.wgsl"),
            Self::Phong => include_str!("../wgsl/phong.wgsl"),
            Self::SixWay => include_str!("../wgsl/six_way.wgsl"),
            Self::FaceFrame => include_str!("../wgsl/face_frame.wgsl"),
            Self::FaceFrameVertex => include_str!("../wgsl/face_frame_vertex.wgsl"),
            Self::StrokeMap => include_str!("../wgsl/stroke_map.wgsl"),
            Self::FineTone => include_str!("../wgsl/fine_tone.wgsl"),
            Self::Stripes => include_str!("../wgsl/stripes.wgsl"),
            Self::Debug => include_str!("../wgsl/debug.wgsl"),
            Self::LineEdges => include_str!("../wgsl/line_edges.wgsl"),
            Self::Lines => include_str!("../wgsl/lines.wgsl"),
        }
    }
}

macro_rules! pieces {
    ($($name:literal),* $(,)?) => {
        /// The pieces that passes include, by path.
        const PIECES: &[(&str, &str)] = &[$((concat!("lib/", $name, ".wgsl"), include_str!(concat!("../wgsl/lib/", $name, ".wgsl")))),*];
    };
}

pieces!(
    "adjacency",
    "barycentric",
    "blend",
    "colour",
    "columns",
    "corners",
    "directions",
    "edges",
    "face_frame",
    "faced",
    "form",
    "halftone",
    "light",
    "mapping",
    "material",
    "mesh",
    "mesh_types",
    "octahedral",
    "patched",
    "patches",
    "scene",
    "stages",
    "striped",
    "stripes",
    "strokes",
    "surface",
    "threshold",
);

/// The WGSL of a pass.
pub fn compose(pass: Pass) -> String {
    compose_source(pass.source())
}

/// The WGSL of a source that includes pieces by `//!include lib/NAME.wgsl`.
///
/// # Panics
/// If the source asks for a piece that does not exist: sources are part of the program.
pub fn compose_source(source: &str) -> String {
    let mut composed = String::from("diagnostic(off, derivative_uniformity);\n");
    append(source, &mut Vec::new(), &mut composed);
    composed
}

fn append(source: &str, included: &mut Vec<&'static str>, composed: &mut String) {
    for line in source.lines() {
        let Some(directive) = line.strip_prefix("//!") else {
            composed.push_str(line);
            composed.push('\n');
            continue;
        };
        let wanted = directive.strip_prefix("include ").unwrap_or_else(|| panic!("there is no directive {directive}"));
        let (path, piece) =
            PIECES.iter().find(|(path, _)| *path == wanted).unwrap_or_else(|| panic!("there is no piece {wanted}"));
        if !included.contains(path) {
            included.push(path);
            append(piece, included, composed);
        }
    }
}
