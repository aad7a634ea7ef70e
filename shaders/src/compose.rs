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
    /// Suarez's light-aligned frames, fetched per fragment.
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
    "stripes",
    "strokes",
    "surface",
    "threshold",
);

/// What the adapter can do, as far as it changes a source.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub struct Capabilities {
    /// Fragments know the index of their triangle. Without it the first vertex of each triangle carries it.
    pub primitive_index: bool,
}

/// The WGSL of a pass.
pub fn compose(pass: Pass, capabilities: Capabilities) -> String {
    compose_source(pass.source(), capabilities)
}

/// The WGSL of a source that includes pieces by `//!include lib/NAME.wgsl`, and keeps lines between `//!if flat_face`,
/// `//!else` and `//!end` by the capabilities.
///
/// # Panics
/// If the source asks for a piece or a flag that does not exist: sources are part of the program.
pub fn compose_source(source: &str, capabilities: Capabilities) -> String {
    let mut composed = String::new();
    if capabilities.primitive_index {
        composed.push_str("enable primitive_index;\n");
    }
    composed.push_str("diagnostic(off, derivative_uniformity);\n");
    append(source, capabilities, &mut Vec::new(), &mut composed);
    composed
}

fn append(source: &str, capabilities: Capabilities, included: &mut Vec<&'static str>, composed: &mut String) {
    let mut kept = true;
    for line in source.lines() {
        let Some(directive) = line.trim_start().strip_prefix("//!") else {
            if kept {
                composed.push_str(line);
                composed.push('\n');
            }
            continue;
        };
        let (word, argument) = directive.split_once(' ').unwrap_or((directive, ""));
        match word {
            "include" => {
                let (path, piece) = PIECES
                    .iter()
                    .find(|(path, _)| *path == argument)
                    .unwrap_or_else(|| panic!("there is no piece {argument}"));
                if !included.contains(path) {
                    included.push(path);
                    append(piece, capabilities, included, composed);
                }
            }
            "if" => {
                assert_eq!(argument, "flat_face", "there is no flag {argument}");
                kept = !capabilities.primitive_index;
            }
            "else" => kept = !kept,
            "end" => kept = true,
            _ => panic!("there is no directive {word}"),
        }
    }
}
