//! Flat faces: a square, and a cube with hard edges.

use glam::{Vec2, Vec3, vec2};

use super::super::RawMesh;
use super::sheet::{Sheet, UV_UNIT, Vertex, density_for};

/// Segments of the sides of a square or cube: they take their next one in turn, so that numbers in between are met.
fn sides<const N: usize>(density: f64) -> [usize; N] {
    std::array::from_fn(|axis| ((density + (axis as f64 + 0.5) / N as f64) as usize).max(1))
}

/// A square of side 2 in the xy plane that faces +z; uv 0..=4 in both directions. At least 2 triangles.
pub(super) fn quad(triangles: usize) -> RawMesh {
    let density = density_for(triangles, |density| 2 * sides::<2>(density).iter().product::<usize>());
    let [columns, rows] = sides(density);
    let mut mesh = RawMesh::default();
    add_face(&mut mesh, [columns, rows], Vec3::ZERO, Vec3::X, Vec3::Y);
    mesh
}

/// A cube of side 2: six faces, each with uv 0..=4 of its own; every edge is a seam. At least 12 triangles.
pub(super) fn cube(triangles: usize) -> RawMesh {
    let count = |[x, y, z]: [usize; 3]| 4 * (x * y + y * z + z * x);
    let density = density_for(triangles, |density| count(sides(density)));
    let counts = sides::<3>(density);
    let mut mesh = RawMesh::default();
    for axis in 0..3 {
        let [right, up] = [(axis + 1) % 3, (axis + 2) % 3];
        let outward = Vec3::AXES[axis];
        // Walls have u around the vertical and v upwards.
        let (u, v) = if up == 1 { (up, right) } else { (right, up) };
        let (u, v) = if v == 1 || axis == 1 { (u, v) } else { (v, u) };
        for side in [1.0, -1.0] {
            let along_v = Vec3::AXES[v];
            let along_u = along_v.cross(outward * side);
            add_face(&mut mesh, [counts[u], counts[v]], outward * side, along_u, along_v);
        }
    }
    mesh
}

/// A face of half side 1 about `centre`, which `u` across `v` points away from.
fn add_face(mesh: &mut RawMesh, [columns, rows]: [usize; 2], centre: Vec3, u: Vec3, v: Vec3) {
    Sheet::open(columns, rows).add_to(mesh, |i, j| {
        // Whole numbers first, so that faces meet in the same bits.
        let at = vec2((2.0 * i - columns as f32) / columns as f32, (2.0 * j as f32 - rows as f32) / rows as f32);
        Vertex { position: centre + u * at.x + v * at.y, normal: u.cross(v), uv: (at + Vec2::ONE) / UV_UNIT }
    });
}
