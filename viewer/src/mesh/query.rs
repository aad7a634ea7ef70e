//! Questions to a mesh.

use glam::{DVec3, Vec3};
use rayon::prelude::*;

use super::{Mesh, NONE, Placement};

/// An edge between two triangles, or at a boundary.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Edge {
    /// Vertices of the first triangle at its ends, in that triangle's order.
    pub vertices: [u32; 2],
    /// Its triangles; the second is [`NONE`] at a boundary.
    pub triangles: [u32; 2],
}

impl Placement {
    /// Takes a position of the file to the mesh.
    pub fn mesh_from_file(&self, position: Vec3) -> Vec3 {
        ((position.as_dvec3() - self.centre) * self.scale).as_vec3()
    }

    /// Takes a position of the mesh to the file.
    pub fn file_from_mesh(&self, position: Vec3) -> DVec3 {
        position.as_dvec3() / self.scale + self.centre
    }
}

impl Mesh {
    /// Index of the part that a triangle belongs to. A triangle that is not there belongs to the last part.
    pub fn part_of(&self, triangle: u32) -> usize {
        let after = self.parts.partition_point(|part| part.triangles.end <= triangle);
        after.min(self.parts.len().saturating_sub(1))
    }

    /// Repeats of a texture per mesh unit: the mean over the surface of √(uv area / mesh area); `None` without uv.
    pub fn uv_density(&self) -> Option<f64> {
        if self.uvs.is_empty() {
            return None;
        }
        let (mut sum, mut area) = (0.0, 0.0);
        for triangle in &self.triangles {
            let [a, b, c] = triangle.map(|vertex| self.positions[vertex as usize].as_dvec3());
            let [p, q, r] = triangle.map(|vertex| self.uvs[vertex as usize].as_dvec2());
            let mesh_area = (b - a).cross(c - a).length();
            let uv_area = (q - p).perp_dot(r - p).abs();
            // The mean is weighted by the area: √(uv / mesh) · mesh = √(uv · mesh).
            sum += (uv_area * mesh_area).sqrt();
            area += mesh_area;
        }
        (area > 0.0).then(|| sum / area)
    }

    /// Every edge of the welded surface once, in the order of the triangles. An edge of more than two triangles is a
    /// boundary of the first of them.
    pub fn edges(&self) -> Vec<Edge> {
        let mut edges = Vec::with_capacity(self.triangles.len() * 3 / 2);
        // A boundary edge, and where it stands among the edges.
        let mut boundary: Vec<([u32; 2], usize)> = Vec::new();
        for (face, (triangle, neighbours)) in self.triangles.iter().zip(&self.neighbours).enumerate() {
            for (k, &other) in neighbours.iter().enumerate() {
                let vertices = [triangle[k], triangle[(k + 1) % 3]];
                if other == NONE {
                    let mut points = vertices.map(|vertex| self.points[vertex as usize]);
                    points.sort_unstable();
                    boundary.push((points, edges.len()));
                }
                if other > face as u32 {
                    edges.push(Edge { vertices, triangles: [face as u32, other] });
                }
            }
        }
        boundary.sort_unstable();
        let mut repeated: Vec<usize> =
            boundary.chunk_by(|a, b| a.0 == b.0).flat_map(|same| same[1..].iter().map(|(_, at)| *at)).collect();
        repeated.sort_unstable();
        let mut repeated = repeated.into_iter().peekable();
        let mut at = 0;
        edges.retain(|_| {
            let again = repeated.next_if_eq(&at).is_some();
            at += 1;
            !again
        });
        edges
    }

    /// Positions of the vertices at a time of the animation, in mesh coordinates, into `out`; the animation repeats.
    /// Without an animation, and where it leads out of the numbers, the positions at rest.
    pub fn pose(&self, time_s: f64, out: &mut Vec<Vec3>) {
        let Some(animation) = &self.animation else {
            out.clone_from(&self.positions);
            return;
        };
        let mut file = Vec::new();
        animation.positions_at(time_s, &mut file);
        let place = |(&source, &rest): (&u32, &Vec3)| {
            let position = file.get(source as usize).map(|&position| self.placement.mesh_from_file(position));
            position.filter(|position| position.is_finite()).unwrap_or(rest)
        };
        self.sources.par_iter().zip(&self.positions).with_min_len(8192).map(place).collect_into_vec(out);
        let first = out.len() - self.midpoints.len();
        for (k, &[a, b]) in self.midpoints.iter().enumerate() {
            out[first + k] = (out[a as usize] + out[b as usize]) * 0.5;
        }
    }
}
