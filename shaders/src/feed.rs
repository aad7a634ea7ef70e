//! What the vertices of a pass carry, each feed with an entry point of its own.

/// What the vertices of a pass carry.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Feed {
    /// Place and normal.
    #[default]
    Vertices,
    /// The mesh's own uv beside.
    Uvs,
    /// Corners of triangles with what they see of patches.
    Corners,
    /// The same of patches that turn with the light.
    Turning,
    /// Corners of lapped textures.
    Lapped,
    /// Corners with the phases of lines.
    Lines,
    /// The same with the patches on which strokes are counted.
    Strokes,
    /// Nothing: three vertices to a face are pulled from storage buffers, with what belongs to the face.
    Faces,
    /// The same, where fragments are told their face.
    Faced,
}

impl Feed {
    /// All feeds.
    pub const ALL: [Self; 9] = [
        Self::Vertices,
        Self::Uvs,
        Self::Corners,
        Self::Turning,
        Self::Lapped,
        Self::Lines,
        Self::Strokes,
        Self::Faces,
        Self::Faced,
    ];

    /// The entry point of the vertex stage.
    pub fn vertex_entry(self) -> &'static str {
        match self {
            Self::Vertices => "vertex",
            Self::Uvs => "vertex_uv",
            Self::Corners => "vertex_corner",
            Self::Turning => "vertex_turning",
            Self::Lapped => "vertex_lapped",
            Self::Lines => "vertex_lines",
            Self::Strokes => "vertex_strokes",
            Self::Faces => "vertex_face",
            Self::Faced => "vertex_faced",
        }
    }

    /// Whether its vertices are pulled from storage buffers, three to a face.
    pub fn is_pulled(self) -> bool {
        matches!(self, Self::Faces | Self::Faced)
    }
}
