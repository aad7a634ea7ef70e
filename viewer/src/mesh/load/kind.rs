//! Telling kinds of mesh files apart.

use std::fmt;

/// A kind of mesh file.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Kind {
    /// Wavefront OBJ.
    Obj,
    /// glTF 2.0, as JSON or as GLB.
    Gltf,
    /// Stanford PLY, in text or binary.
    Ply,
    /// STL, in text or binary.
    Stl,
}

impl Kind {
    /// By a file's extension, without dot, in any case.
    pub fn from_extension(extension: &str) -> Option<Self> {
        match extension.to_ascii_lowercase().as_str() {
            "obj" => Some(Self::Obj),
            "gltf" | "glb" => Some(Self::Gltf),
            "ply" => Some(Self::Ply),
            "stl" => Some(Self::Stl),
            _ => None,
        }
    }

    /// By a file's content.
    pub fn from_content(bytes: &[u8]) -> Option<Self> {
        let text = bytes.trim_ascii_start();
        if bytes.starts_with(b"glTF") || text.starts_with(b"{") {
            Some(Self::Gltf)
        } else if bytes.starts_with(b"ply\n") || bytes.starts_with(b"ply\r") {
            Some(Self::Ply)
        } else if super::stl::is_text(bytes) || super::stl::binary_bytes(bytes) == Some(bytes.len() as u64) {
            Some(Self::Stl)
        } else {
            let mut lines = bytes.split(|&byte| byte == b'\n').map(<[u8]>::trim_ascii_start).take(10_000);
            lines.any(|line| line.starts_with(b"v ")).then_some(Self::Obj)
        }
    }
}

impl fmt::Display for Kind {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        formatter.write_str(match self {
            Self::Obj => "OBJ",
            Self::Gltf => "glTF",
            Self::Ply => "PLY",
            Self::Stl => "STL",
        })
    }
}
