//! Reading mesh files: OBJ, glTF and GLB, PLY, STL.
//!
//! OBJ, PLY and STL are read by our own readers: no content makes them panic, they take memory in proportion to the
//! file, and half a million triangles take them a fraction of a second.

mod gltf;
mod kind;
mod mtl;
mod obj;
mod ply;
mod stl;
mod text;

#[cfg(test)]
mod tests;

use std::io;
use std::path::{Path, PathBuf};

pub use kind::Kind;

use super::{Loaded, MeshError, RawMesh, prepare};
use crate::stage::stage;

/// Most bytes of a file that are read.
pub const BYTES_MAX: u64 = 2 << 30;

/// Gives the bytes of a file that another refers to, by the reference as written there.
pub type Resolve<'a> = &'a dyn Fn(&str) -> io::Result<Vec<u8>>;

/// Reads and prepares a mesh file. Its kind is told by the extension, else by the content.
///
/// Files that it refers to (`.mtl`, `.bin`) are looked for beside it and below its folder's parents as their relative
/// paths say; absolute paths and addresses are refused.
///
/// # Errors
///
/// [`MeshError::InFile`] with the path, around what is wrong. No content of any file makes it panic.
pub fn load(path: &Path) -> Result<Loaded, MeshError> {
    load_file(path).map_err(|source| MeshError::InFile { path: path.into(), source: Box::new(source) })
}

fn load_file(path: &Path) -> Result<Loaded, MeshError> {
    let bytes = stage("file", || read_bytes(path))?;
    let extension = path.extension().map(|extension| extension.to_string_lossy().into_owned()).unwrap_or_default();
    let kind = Kind::from_extension(&extension)
        .or_else(|| Kind::from_content(&bytes))
        .ok_or(MeshError::UnknownKind { extension })?;
    let folder = path.parent().unwrap_or(Path::new(""));
    let beside = |uri: &str| {
        let bytes = read_bytes(&folder.join(relative(uri)?));
        bytes.map_err(|error| match error {
            MeshError::Read(error) => error,
            other => io::Error::other(other.to_string()),
        })
    };
    let mut raw = stage("reading", || read_raw(&bytes, kind, &beside))?;
    drop(bytes);
    raw.name = path.file_stem().map(|stem| stem.to_string_lossy().into_owned()).unwrap_or_default();
    stage("preparing", || prepare(raw))
}

/// Reads the bytes of a mesh file, without preparing it; `resolve` gives those of files that it refers to.
///
/// # Errors
///
/// [`MeshError`] for what is no mesh of this kind. Memory is bounded by the bytes given.
pub fn read_raw(bytes: &[u8], kind: Kind, resolve: Resolve) -> Result<RawMesh, MeshError> {
    if bytes.is_empty() {
        return Err(MeshError::Empty);
    }
    match kind {
        Kind::Obj => obj::read(bytes, resolve),
        Kind::Gltf => gltf::read(bytes, resolve),
        Kind::Ply => ply::read(bytes),
        Kind::Stl => stl::read(bytes),
    }
}

fn read_bytes(path: &Path) -> Result<Vec<u8>, MeshError> {
    let about = std::fs::metadata(path)?;
    if about.is_dir() {
        return Err(MeshError::Folder);
    }
    if about.len() > BYTES_MAX {
        return Err(MeshError::Large { bytes: about.len() });
    }
    Ok(std::fs::read(path)?)
}

/// The relative path that a reference in a file means; percent codes are decoded.
fn relative(uri: &str) -> io::Result<PathBuf> {
    let refused = |why: &str| Err(io::Error::new(io::ErrorKind::InvalidInput, why));
    if uri.contains("://") {
        return refused("addresses are not followed");
    }
    let mut decoded = Vec::with_capacity(uri.len());
    let mut rest = uri.as_bytes();
    while let Some((&byte, after)) = rest.split_first() {
        let code = (byte == b'%').then(|| after.get(..2)).flatten();
        let code = code.and_then(|code| u8::from_str_radix(std::str::from_utf8(code).ok()?, 16).ok());
        decoded.push(code.unwrap_or(byte));
        rest = if code.is_some() { &after[2..] } else { after };
    }
    // Exporters on Windows write their own separator.
    let path = PathBuf::from(String::from_utf8_lossy(&decoded).replace('\\', "/"));
    if path.is_absolute() {
        return refused("absolute paths are not followed");
    }
    Ok(path)
}
