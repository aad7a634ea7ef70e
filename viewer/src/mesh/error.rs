//! What can be wrong with a mesh or its file.

use std::path::PathBuf;

use super::Kind;

/// Why there is no mesh.
#[derive(Debug, thiserror::Error)]
pub enum MeshError {
    /// Something lies wrong in a file; what, is the source.
    #[error("{}: {source}", .path.display())]
    InFile {
        /// The file.
        path: PathBuf,
        /// What is wrong with it.
        source: Box<MeshError>,
    },
    /// The file cannot be read.
    #[error("it cannot be read: {0}")]
    Read(#[from] std::io::Error),
    /// A folder, where a file is expected.
    #[error("it is a folder; name the mesh file in it")]
    Folder,
    /// More bytes than are read.
    #[error("it has {bytes} bytes; at most {} are read", super::load::BYTES_MAX)]
    Large {
        /// Size of the file.
        bytes: u64,
    },
    /// No bytes at all.
    #[error("the file is empty")]
    Empty,
    /// Neither the name nor the content tells a kind that is read.
    #[error("it is no mesh of a known kind (its extension is \"{extension}\"); OBJ, glTF, GLB, PLY and STL are read")]
    UnknownKind {
        /// The file's extension; may be empty.
        extension: String,
    },
    /// The content is not of the kind that it should be.
    #[error("it is no {kind} file: {what}")]
    WrongKind {
        /// The kind expected.
        kind: Kind,
        /// What is there instead.
        what: String,
    },
    /// The file ends too early.
    #[error("it is cut short: {what} need {needed} bytes and {given} are there")]
    Truncated {
        /// What should be there.
        what: String,
        /// Bytes that it takes.
        needed: u64,
        /// Bytes that there are.
        given: u64,
    },
    /// Something in the content contradicts the format.
    #[error("it is damaged: {what}")]
    Damaged {
        /// What and where.
        what: String,
    },
    /// A feature of the format that is not read.
    #[error("{0} is not supported")]
    Unsupported(String),
    /// A file that the mesh refers to cannot be read.
    #[error("it refers to \"{uri}\", which cannot be read: {source}")]
    Resolve {
        /// The reference, as the file has it.
        uri: String,
        /// Why not.
        source: std::io::Error,
    },
    /// More vertices or triangles than a file of its size can need.
    #[error("it unfolds to {given} {what}; at most {most} are taken")]
    TooMany {
        /// Of what.
        what: &'static str,
        /// How many there are.
        given: u64,
        /// How many are taken.
        most: u64,
    },
    /// An attribute with a number of values that is not the number of vertices.
    #[error("{vertices} vertices have {given} {what}")]
    Lengths {
        /// Which attribute.
        what: &'static str,
        /// Number of its values.
        given: usize,
        /// Number of vertices.
        vertices: usize,
    },
    /// Parts that overlap, leave gaps or go beyond the triangles.
    #[error("part {part} begins at triangle {start}, where {expected} is expected, and ends at {end} of {triangles}")]
    Parts {
        /// Which part, from 0; the number of parts where the last ends too early.
        part: usize,
        /// Its first triangle.
        start: usize,
        /// One after its last.
        end: usize,
        /// Where it should begin.
        expected: usize,
        /// Number of triangles.
        triangles: usize,
    },
    /// No triangle is left after cleaning.
    #[error(
        "no usable triangle: of {triangles}, {out_of_range} point beyond the {vertices} vertices, {non_finite} have \
         coordinates that are not finite, {degenerate} have no area"
    )]
    Nothing {
        /// Triangles given.
        triangles: usize,
        /// Vertices given.
        vertices: usize,
        /// Triangles with an index out of range.
        out_of_range: usize,
        /// Triangles with a vertex that is not finite.
        non_finite: usize,
        /// Triangles without area.
        degenerate: usize,
    },
}

impl MeshError {
    /// Short form of [`MeshError::Damaged`].
    pub(super) fn damaged(what: impl Into<String>) -> Self {
        Self::Damaged { what: what.into() }
    }
}
