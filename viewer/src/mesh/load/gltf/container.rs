//! The chunks of a GLB.

use crate::mesh::MeshError;

const JSON: u32 = u32::from_le_bytes(*b"JSON");
const BIN: u32 = u32::from_le_bytes(*b"BIN\0");

/// The JSON, and the binary chunk if there is one. What does not begin as a GLB is taken for JSON.
pub(super) fn split(bytes: &[u8]) -> Result<(&[u8], Option<&[u8]>), MeshError> {
    if !bytes.starts_with(b"glTF") {
        return Ok((bytes, None));
    }
    let [_, version, length] = words(bytes)?;
    if version != 2 {
        return Err(MeshError::Unsupported(format!("glTF of version {version} (2 is read)")));
    }
    let given = bytes.len() as u64;
    if u64::from(length) > given {
        return Err(MeshError::Truncated { what: "its chunks".into(), needed: length.into(), given });
    }
    let mut rest = bytes.get(12..length as usize).unwrap_or_default();
    let (mut json, mut blob) = (None, None);
    while !rest.is_empty() {
        let [length, kind] = words(rest)?;
        let chunk = rest.get(8..).and_then(|rest| rest.get(..length as usize)).ok_or_else(|| {
            let given = rest.len() as u64;
            MeshError::Truncated { what: "a chunk and its header".into(), needed: u64::from(length) + 8, given }
        })?;
        match kind {
            JSON if json.is_none() => json = Some(chunk),
            BIN if blob.is_none() => blob = Some(chunk),
            _ => {}
        }
        rest = &rest[8 + chunk.len()..];
    }
    let json = json.ok_or_else(|| MeshError::damaged("it has no JSON chunk"))?;
    Ok((json, blob))
}

/// The first numbers of a header.
fn words<const N: usize>(bytes: &[u8]) -> Result<[u32; N], MeshError> {
    let Some(words) = bytes.as_chunks::<4>().0.first_chunk::<N>() else {
        let given = bytes.len() as u64;
        return Err(MeshError::Truncated { what: "a header".into(), needed: N as u64 * 4, given });
    };
    Ok(words.map(u32::from_le_bytes))
}
