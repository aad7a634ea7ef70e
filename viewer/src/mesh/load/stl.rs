//! Reading STL.

use glam::Vec3;

use crate::mesh::{MeshError, RawMesh, RawPart};

use super::Kind;
use super::text::{Words, shown};

/// Bytes before the triangles: a comment of 80, then their number.
const HEADER: usize = 84;
const TRIANGLE: usize = 50;

/// Reads text or binary STL. Facet normals are not taken: they are those of the triangles, which preparation makes
/// smooth where the angle is below the crease.
pub(super) fn read(bytes: &[u8]) -> Result<RawMesh, MeshError> {
    // Binary files may begin with "solid" too; their length tells them.
    match binary_bytes(bytes) {
        Some(needed) if needed == bytes.len() as u64 => read_binary(bytes),
        _ if is_text(bytes) => read_text(bytes),
        Some(needed) if needed <= bytes.len() as u64 => read_binary(bytes),
        Some(needed) => {
            let what = format!("{} triangles", (needed - HEADER as u64) / TRIANGLE as u64);
            Err(MeshError::Truncated { what, needed, given: bytes.len() as u64 })
        }
        None => Err(MeshError::WrongKind {
            kind: Kind::Stl,
            what: format!("it begins with \"{}\", and is too short to be binary", shown(bytes)),
        }),
    }
}

/// Whether these are the words of a text STL: "solid", and a facet or the end soon after.
pub(super) fn is_text(bytes: &[u8]) -> bool {
    let mut words = Words::new(&bytes[..bytes.len().min(4096)]);
    words.next().is_some_and(|word| word.eq_ignore_ascii_case(b"solid"))
        && words.any(|word| word.eq_ignore_ascii_case(b"facet") || word.eq_ignore_ascii_case(b"endsolid"))
}

/// Length of the binary file whose header this is.
pub(super) fn binary_bytes(bytes: &[u8]) -> Option<u64> {
    let count = bytes.get(HEADER - 4..)?.first_chunk().copied().map(u32::from_le_bytes)?;
    Some(HEADER as u64 + TRIANGLE as u64 * u64::from(count))
}

fn read_binary(bytes: &[u8]) -> Result<RawMesh, MeshError> {
    let mut raw = RawMesh::default();
    let needed = binary_bytes(bytes).unwrap_or(0) as usize;
    let body = bytes.get(HEADER..needed).unwrap_or_default();
    if bytes.len() > needed {
        raw.notes.push(format!("{} bytes after the last triangle were not read.", bytes.len() - needed));
    }
    raw.positions.reserve_exact(body.len() / TRIANGLE * 3);
    for triangle in body.as_chunks::<TRIANGLE>().0 {
        // After the normal, nine numbers; then two bytes that mean different things to different programs.
        let numbers = triangle[12..48].as_chunks::<4>().0;
        let number = |at: usize| f32::from_le_bytes(numbers[at]);
        raw.positions.extend([0, 3, 6].map(|at| Vec3::new(number(at), number(at + 1), number(at + 2))));
    }
    raw.triangles = in_threes(raw.positions.len());
    Ok(raw)
}

fn read_text(bytes: &[u8]) -> Result<RawMesh, MeshError> {
    let mut raw = RawMesh::default();
    let mut solids: Vec<(String, usize)> = Vec::new();
    let mut open = false;
    for (at, line) in bytes.split(|&byte| byte == b'\n').enumerate() {
        let damaged = |what: &str| MeshError::damaged(format!("{what} in line {}: \"{}\"", at + 1, shown(line)));
        let mut words = Words::new(line);
        let Some(word) = words.next() else { continue };
        match word.to_ascii_lowercase().as_slice() {
            b"vertex" => {
                let [Some(x), Some(y), Some(z)] = [words.number(), words.number(), words.number()] else {
                    return Err(damaged("a vertex without three numbers"));
                };
                raw.positions.push(Vec3::new(x, y, z));
            }
            b"endloop" if raw.positions.len() % 3 != 0 => return Err(damaged("a loop that is no triangle")),
            b"solid" => {
                open = true;
                solids.push((shown(words.rest()), raw.positions.len() / 3));
            }
            b"endsolid" => open = false,
            b"facet" | b"outer" | b"endloop" | b"endfacet" => {}
            _ => return Err(damaged("an unknown word")),
        }
    }
    if raw.positions.len() % 3 != 0 {
        return Err(MeshError::damaged("it ends within a triangle"));
    }
    if open {
        return Err(MeshError::damaged("it ends without \"endsolid\""));
    }
    raw.triangles = in_threes(raw.positions.len());
    let ends = solids.iter().skip(1).map(|solid| solid.1).chain([raw.triangles.len()]).collect::<Vec<_>>();
    let parts = solids.into_iter().zip(ends).filter(|((_, start), end)| start < end);
    raw.parts = parts.map(|((name, start), end)| RawPart { name, colour: None, triangles: start..end }).collect();
    Ok(raw)
}

/// Triangles of vertices in order, three each.
fn in_threes(vertices: usize) -> Vec<[u32; 3]> {
    (0..(vertices / 3) as u32).map(|triangle| [0, 1, 2].map(|corner| triangle * 3 + corner)).collect()
}
