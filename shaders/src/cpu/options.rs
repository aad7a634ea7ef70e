//! The constants of a pipeline: `override`s in WGSL.

/// Which form of a method is drawn: `FORM` of `lib/form.wgsl`.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
#[repr(u32)]
pub enum Form {
    /// With the remedies for what the source leaves open.
    #[default]
    Hardened = 0,
    /// As the source prints it, with its failures.
    Literal = 1,
}

/// How the tile reaches the surface: `MAPPING` of `lib/mapping.wgsl`.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
#[repr(u32)]
pub enum Mapping {
    /// The mesh's own uv.
    #[default]
    Uv = 0,
    /// The light-aligned frame of the face.
    Frames = 1,
    /// Three planes across the axes.
    Triplanar = 2,
    /// Patches that follow the direction field.
    Patches = 3,
    /// Lapped textures, painted one over another.
    Lapped = 4,
}

/// How patterns that overlap are put together: `BLEND` of `lib/blend.wgsl`.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
#[repr(u32)]
pub enum Blend {
    /// Each at a reduced darkness, drawn over the others.
    #[default]
    Union = 0,
    /// Weighted sum.
    Linear = 1,
}

/// What a threshold is taken of: `PATTERN` of `stroke_map.wgsl`.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
#[repr(u32)]
pub enum PatternKind {
    /// The stroke map.
    #[default]
    Strokes = 0,
    /// Lines of variable width, without a map.
    Lines = 1,
}

/// Where the vertex stage has the frames from: `FRAMES` of `face_frame_vertex.wgsl`.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
#[repr(u32)]
pub enum Frames {
    /// It makes them.
    #[default]
    Here = 0,
    /// `face_frames.wgsl` made them.
    Fetched = 1,
}

/// What patches follow: `FOLLOW` of `lib/patches.wgsl`.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
#[repr(u32)]
pub enum Follow {
    /// They lie still on the surface.
    #[default]
    Surface = 0,
    /// They turn about their seeds with the light.
    Light = 1,
}

/// What is shown in the ink's place: `DEBUG` of `debug.wgsl`.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
#[repr(u32)]
pub enum DebugView {
    /// Nothing: the method has nothing of what is asked for.
    #[default]
    None = 0,
    /// The wanted darkness.
    Tone = 1,
    /// The level of detail.
    Level = 2,
    /// The columns that bracket the tone.
    Columns = 3,
    /// Directions of the mapping's strokes.
    Frames = 4,
    /// Directions of stripes.
    Stripes = 5,
    /// The share of the neighbours' patterns.
    Adjacency = 6,
    /// The triangles.
    Triangles = 7,
}

impl DebugView {
    /// All of them.
    pub const ALL: [Self; 8] = [
        Self::None,
        Self::Tone,
        Self::Level,
        Self::Columns,
        Self::Frames,
        Self::Stripes,
        Self::Adjacency,
        Self::Triangles,
    ];
}

/// All constants of a pipeline.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub struct Options {
    /// Which form of the method.
    pub form: Form,
    /// How the tile reaches the surface.
    pub mapping: Mapping,
    /// How patterns that overlap are put together.
    pub blend: Blend,
    /// What the threshold is taken of.
    pub pattern: PatternKind,
    /// Where the vertex stage has the frames from.
    pub frames: Frames,
    /// What patches follow.
    pub follow: Follow,
    /// What is shown in the ink's place.
    pub debug: DebugView,
}

impl Options {
    /// Name and number of each constant, as WGSL knows them; a pass has some of them only.
    pub fn constants(self) -> [(&'static str, f64); 7] {
        [
            ("FORM", f64::from(self.form as u32)),
            ("MAPPING", f64::from(self.mapping as u32)),
            ("BLEND", f64::from(self.blend as u32)),
            ("PATTERN", f64::from(self.pattern as u32)),
            ("FRAMES", f64::from(self.frames as u32)),
            ("FOLLOW", f64::from(self.follow as u32)),
            ("DEBUG", f64::from(self.debug as u32)),
        ]
    }
}
