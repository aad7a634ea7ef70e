//! From what a file says to a mesh that the renderer can rely on.
//!
//! ```text
//! clean ─► weld ─► adjacency ─► orient ─► normal groups ─► vertices ─► Mesh
//! ```

pub(super) mod adjacency;
mod clean;
mod groups;
mod orient;
mod place;
mod vertices;
mod weld;

#[cfg(test)]
mod tests;

use glam::Vec2;

use super::{Loaded, Mesh, MeshError, MeshReport, Part, RawMesh};

/// Most triangles taken: their indices are counted in 31 bits, as GPU interfaces do.
pub const TRIANGLES_MAX: usize = (1 << 31) / 3;

/// Makes a checked mesh: clean, welded, consistently oriented, with neighbours and normals, centred and scaled.
///
/// - Triangles with indices out of range, coordinates that are not finite, no area, or the points of an earlier
///   triangle are dropped, and vertices that no triangle uses then.
/// - Vertices within 1e-6 of the bounding box's diagonal are one point.
/// - Each component is oriented consistently: outward by its volume if closed, else as most of its triangles were.
///   Edges of more than two triangles, and edges where a one-sided surface closes on itself, are boundaries.
/// - Normals are the file's where they are usable, else smooth, with creases over [`CREASE_DEGREES`](super::CREASE_DEGREES).
/// - The order of vertices and triangles stays. With an animation, vertices of the source are not united.
///
/// # Errors
///
/// [`MeshError::Nothing`] if no triangle is left, [`MeshError::TooMany`] above [`TRIANGLES_MAX`],
/// [`MeshError::Lengths`] and [`MeshError::Parts`] if `raw` contradicts itself.
pub fn prepare(raw: RawMesh) -> Result<Loaded, MeshError> {
    check(&raw)?;
    let mut report = MeshReport { reader_notes: raw.notes.clone(), made: raw.made, ..Default::default() };

    let mut faces = clean::usable(&raw, &mut report);
    let welded = weld::weld(&raw.positions, &faces);
    clean::drop_collapsed(&raw, &welded, &mut faces, &mut report);
    if faces.corners.is_empty() {
        return Err(MeshError::Nothing {
            triangles: raw.triangles.len(),
            vertices: raw.positions.len(),
            out_of_range: report.dropped_out_of_range,
            non_finite: report.dropped_non_finite,
            degenerate: report.dropped_degenerate,
        });
    }
    let mut surface = weld::Surface::new(&raw, &welded, &mut faces, &mut report);
    drop(welded);
    let mut neighbours = adjacency::neighbours(&surface.triangles, surface.points.len(), &mut report);
    let flipped = orient::orient(&mut surface, &mut faces, &mut neighbours, &mut report);

    let shape = groups::Shape::new(&surface, &mut report);
    let groups = groups::groups(&raw, &surface, &faces, &neighbours, &shape, &flipped, &mut report);
    let (placement, point_positions) = place::place(&surface.points);
    let split = vertices::split(&raw, &surface, &faces, &groups);

    let parts = parts(&raw, &faces.origins);
    let mut uvs: Vec<Vec2> = split.sources.iter().filter_map(|&source| raw.uvs.get(source as usize)).copied().collect();
    for uv in uvs.iter_mut().filter(|uv| !uv.is_finite()) {
        *uv = Vec2::ZERO;
        report.mended_uvs += 1;
    }
    let mut mesh = Mesh {
        name: raw.name,
        positions: split.points.iter().map(|&point| point_positions[point as usize]).collect(),
        normals: split.normals,
        uvs,
        points: split.points,
        point_count: surface.points.len(),
        normal_groups: split.groups,
        sources: split.sources,
        midpoints: Vec::new(),
        triangles: split.triangles,
        neighbours,
        parts,
        placement,
        animation: raw.animation,
    };
    vertices::fill_smooth_normals(&mut mesh, &split.given);

    report.vertices = mesh.positions.len();
    report.points = mesh.point_count;
    report.triangles = mesh.triangles.len();
    report.parts = mesh.parts.len();
    report.has_uv = !mesh.uvs.is_empty();
    report.normals_from_file = split.given.iter().filter(|given| **given).count();
    Ok(Loaded { mesh, report })
}

/// What a [`RawMesh`] promises about itself.
fn check(raw: &RawMesh) -> Result<(), MeshError> {
    let vertices = raw.positions.len();
    for (what, given) in [("normals", raw.normals.len()), ("texture coordinates", raw.uvs.len())] {
        if given != 0 && given != vertices {
            return Err(MeshError::Lengths { what, given, vertices });
        }
    }
    for (what, given, most) in
        [("triangles", raw.triangles.len(), TRIANGLES_MAX), ("vertices", vertices, u32::MAX as usize - 1)]
    {
        if given > most {
            return Err(MeshError::TooMany { what, given: given as u64, most: most as u64 });
        }
    }
    let triangles = raw.triangles.len();
    let mut expected = 0;
    for (part, range) in raw.parts.iter().map(|part| &part.triangles).enumerate() {
        if range.start != expected || range.end < range.start || range.end > triangles {
            return Err(MeshError::Parts { part, start: range.start, end: range.end, expected, triangles });
        }
        expected = range.end;
    }
    if !raw.parts.is_empty() && expected != triangles {
        let part = raw.parts.len();
        return Err(MeshError::Parts { part, start: triangles, end: triangles, expected, triangles });
    }
    Ok(())
}

/// The parts that kept a triangle; `origins` are the kept triangles' indices in `raw`, ascending.
fn parts(raw: &RawMesh, origins: &[u32]) -> Vec<Part> {
    if raw.parts.is_empty() {
        return vec![Part { name: raw.name.clone(), colour: [1.0; 3], triangles: 0..origins.len() as u32 }];
    }
    let mut begin = 0;
    let mut parts = Vec::new();
    for part in &raw.parts {
        let end = origins.partition_point(|&origin| (origin as usize) < part.triangles.end);
        if end > begin {
            let colour = part.colour.unwrap_or([1.0; 3]);
            parts.push(Part { name: part.name.clone(), colour, triangles: begin as u32..end as u32 });
        }
        begin = end;
    }
    parts
}
