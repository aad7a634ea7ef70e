//! Movement of a mesh whose triangles stay: glTF morph targets and skins.

/// Vertex positions over time.
#[derive(Clone, Debug)]
pub struct Animation {}
