//! Splitting points into vertices where uv or normal differ.

use glam::Vec3;

use crate::mesh::table::{Table, join};
use crate::mesh::{Mesh, NONE, RawMesh};

use super::clean::Faces;
use super::groups::Groups;
use super::weld::Surface;

/// The vertices, in the order of the source.
pub(super) struct Split {
    /// Per vertex its point.
    pub(super) points: Vec<u32>,
    /// Per vertex its normal group.
    pub(super) groups: Vec<u32>,
    /// Per vertex the first vertex of the source that it stands for.
    pub(super) sources: Vec<u32>,
    /// Per vertex the file's normal, or that of a face.
    pub(super) normals: Vec<Vec3>,
    /// Per vertex whether the normal is the file's.
    pub(super) given: Vec<bool>,
    /// Vertex indices.
    pub(super) triangles: Vec<[u32; 3]>,
}

/// One vertex per point, uv and normal group; with an animation also per vertex of the source, since what lies in one
/// place now may part (closed lips).
pub(super) fn split(raw: &RawMesh, surface: &Surface, faces: &Faces, groups: &Groups) -> Split {
    let alike = alike(raw, surface);
    let mut table = Table::new(surface.points.len() * 2);
    let mut found: Vec<[u32; 2]> = Vec::new();
    let mut triangles = vec![[0; 3]; faces.corners.len()];
    // Nearly all corners at a vertex of the source are of one group: the first found saves the search.
    let mut first = vec![NONE; raw.positions.len()];
    for (face, corners) in faces.corners.iter().enumerate() {
        for k in 0..3 {
            let key = [alike[corners[k] as usize], groups.corners[face][k]];
            let first = &mut first[key[0] as usize];
            if *first != NONE && found[*first as usize] == key {
                triangles[face][k] = *first;
                continue;
            }
            let (vertex, new) = table.find_or_insert(join(&key), |other| found[other as usize] == key);
            if new {
                found.push(key);
            }
            if *first == NONE {
                *first = vertex;
            }
            triangles[face][k] = vertex;
        }
    }

    let mut order: Vec<u32> = (0..found.len() as u32).collect();
    order.sort_unstable_by_key(|&vertex| (found[vertex as usize][0], vertex));
    let mut place = vec![0; order.len()];
    order.iter().enumerate().for_each(|(at, &vertex)| place[vertex as usize] = at as u32);
    triangles.iter_mut().flatten().for_each(|vertex| *vertex = place[*vertex as usize]);

    let sorted = || order.iter().map(|&vertex| found[vertex as usize]);
    Split {
        points: sorted().map(|[source, _]| surface.point_of[source as usize]).collect(),
        groups: sorted().map(|[_, group]| group).collect(),
        sources: sorted().map(|[source, _]| source).collect(),
        normals: sorted().map(|[_, group]| groups.normals[group as usize]).collect(),
        given: sorted().map(|[_, group]| groups.given[group as usize]).collect(),
        triangles,
    }
}

/// Per used vertex of the source, the first with the same point and uv.
fn alike(raw: &RawMesh, surface: &Surface) -> Vec<u32> {
    let all = 0..raw.positions.len() as u32;
    if raw.animation.is_some() {
        return all.collect();
    }
    if raw.uvs.is_empty() {
        let mut first = vec![NONE; surface.points.len()];
        let first_of = |vertex: u32| {
            let point = surface.point_of[vertex as usize];
            if point == NONE {
                return vertex;
            }
            let first = &mut first[point as usize];
            *first = vertex.min(*first);
            *first
        };
        return all.map(first_of).collect();
    }
    let mut table = Table::new(surface.points.len() * 2);
    let mut found: Vec<([u32; 3], u32)> = Vec::new();
    let first_of = |vertex: u32| {
        let point = surface.point_of[vertex as usize];
        if point == NONE {
            return vertex;
        }
        let [u, v] = (raw.uvs[vertex as usize] + glam::Vec2::ZERO).to_array().map(f32::to_bits);
        let key = [point, u, v];
        let (item, new) = table.find_or_insert(join(&key), |other| found[other as usize].0 == key);
        if new {
            found.push((key, vertex));
        }
        found[item as usize].1
    };
    all.map(first_of).collect()
}

/// Smooth normals where the file gives none.
pub(super) fn fill_smooth_normals(mesh: &mut Mesh, given: &[bool]) {
    if given.iter().all(|given| *given) {
        return;
    }
    let mut smooth = Vec::new();
    mesh.normals_of(&mesh.positions, &mut smooth);
    for ((normal, smooth), given) in mesh.normals.iter_mut().zip(smooth).zip(given) {
        if !given {
            *normal = smooth;
        }
    }
}
