//! Reading Stanford PLY.

mod data;
mod header;

use glam::{Vec2, Vec3};

use crate::mesh::{MeshError, RawMesh};

use data::Data;
use header::{Element, Header, Shape};

/// Names under which texture coordinates are found.
const UV_NAMES: [[&str; 2]; 4] = [["u", "v"], ["s", "t"], ["texture_u", "texture_v"], ["texture_s", "texture_t"]];

/// Reads vertices (`x y z`, `nx ny nz`, texture coordinates), polygons and triangle strips, in text or binary.
///
/// Polygons are cut into fans. Other elements and properties are passed over.
pub(super) fn read(bytes: &[u8]) -> Result<RawMesh, MeshError> {
    let header = Header::read(bytes)?;
    let mut data = Data::new(&bytes[header.length..], header.encoding);
    let mut raw = RawMesh::default();
    let mut seen = false;
    for element in &header.elements {
        // Counts are numbers that anyone can write: the data must be able to hold them.
        let (needed, given) = (element.count.saturating_mul(data.least_bytes(element)), data.remaining() as u64);
        if needed > given {
            let what = format!("{} elements \"{}\"", element.count, element.name);
            return Err(MeshError::Truncated { what, needed, given });
        }
        match element.name.as_str() {
            "vertex" => {
                vertices(element, &mut data, &mut raw)?;
                seen = true;
            }
            "face" => faces(element, &mut data, &mut raw, fan)?,
            "tristrips" => faces(element, &mut data, &mut raw, strips)?,
            _ => pass_over(element, &mut data)?,
        }
    }
    if !seen {
        return Err(MeshError::damaged("its header declares no element \"vertex\""));
    }
    Ok(raw)
}

fn vertices(element: &Element, data: &mut Data, raw: &mut RawMesh) -> Result<(), MeshError> {
    let columns = |names: &[&str]| -> Option<Vec<usize>> { names.iter().map(|name| element.column(name)).collect() };
    let Some(position) = columns(&["x", "y", "z"]) else {
        return Err(MeshError::damaged("its vertices have no properties x, y and z"));
    };
    let normal = columns(&["nx", "ny", "nz"]);
    let uv = UV_NAMES.iter().find_map(|names| columns(names));
    let mut row = vec![0.0_f64; element.properties.len()];
    for _ in 0..element.count {
        for (property, value) in element.properties.iter().zip(&mut row) {
            match property.shape {
                Shape::Scalar(scalar) => *value = data.scalar(scalar)?,
                Shape::List { count, item } => data.list(count, item, |_| {})?,
            }
        }
        let vector = |columns: &[usize]| {
            let [x, y, z] = [0, 1, 2].map(|axis| row[columns[axis]] as f32);
            Vec3::new(x, y, z)
        };
        raw.positions.push(vector(&position));
        if let Some(normal) = &normal {
            raw.normals.push(vector(normal));
        }
        if let Some(uv) = &uv {
            raw.uvs.push(Vec2::new(row[uv[0]] as f32, row[uv[1]] as f32));
        }
    }
    Ok(())
}

/// Reads the lists of vertices and makes triangles of each by `cut`.
fn faces(
    element: &Element,
    data: &mut Data,
    raw: &mut RawMesh,
    cut: fn(&[u32], &mut Vec<[u32; 3]>),
) -> Result<(), MeshError> {
    let indices = element.column("vertex_indices").or_else(|| element.column("vertex_index"));
    let Some(indices) = indices else {
        return Err(MeshError::damaged(format!("its elements \"{}\" have no list vertex_indices", element.name)));
    };
    if element.column("texcoord").is_some() {
        raw.notes.push("Texture coordinates of faces (\"texcoord\") are not read, those of vertices are.".into());
    }
    let mut polygon = Vec::new();
    let mut too_few = 0;
    for _ in 0..element.count {
        for (at, property) in element.properties.iter().enumerate() {
            match property.shape {
                Shape::Scalar(scalar) => {
                    data.scalar(scalar)?;
                }
                Shape::List { count, item } if at == indices => {
                    polygon.clear();
                    // Negative indices become ones that are out of range.
                    data.list(count, item, |index| polygon.push(if index < 0.0 { u32::MAX } else { index as u32 }))?;
                    too_few += usize::from(polygon.len() < 3);
                    cut(&polygon, &mut raw.triangles);
                }
                Shape::List { count, item } => data.list(count, item, |_| {})?,
            }
        }
    }
    if too_few > 0 {
        raw.notes.push(format!("{too_few} faces with fewer than three corners were passed over."));
    }
    Ok(())
}

fn pass_over(element: &Element, data: &mut Data) -> Result<(), MeshError> {
    // Without properties there is nothing to pass over, however many there are.
    if element.properties.is_empty() {
        return Ok(());
    }
    for _ in 0..element.count {
        for property in &element.properties {
            match property.shape {
                Shape::Scalar(scalar) => {
                    data.scalar(scalar)?;
                }
                Shape::List { count, item } => data.list(count, item, |_| {})?,
            }
        }
    }
    Ok(())
}

fn fan(polygon: &[u32], triangles: &mut Vec<[u32; 3]>) {
    if let Some((&first, rest)) = polygon.split_first() {
        triangles.extend(rest.windows(2).map(|pair| [first, pair[0], pair[1]]));
    }
}

/// Strips, one after the other, with -1 between them.
fn strips(indices: &[u32], triangles: &mut Vec<[u32; 3]>) {
    for strip in indices.split(|&index| index == u32::MAX) {
        for (at, corners) in strip.windows(3).enumerate() {
            // Every other triangle of a strip runs the other way round.
            let [a, b, c] = [corners[0], corners[1], corners[2]];
            triangles.push(if at % 2 == 0 { [a, b, c] } else { [b, a, c] });
        }
    }
}
