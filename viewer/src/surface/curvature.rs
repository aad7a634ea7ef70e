//! Principal curvatures: of each triangle from the change of its corners' normals (Rusinkiewicz, "Estimating curvatures
//! and their derivatives on triangle meshes", 2004), carried to the nodes and averaged over a neighbourhood of fixed
//! size, so that they hardly depend on how fine the mesh is.

use faer::c64;
use glam::{DQuat, DVec3};
use rayon::prelude::*;

use super::graph::Graph;

/// Curvature at a node, in 1 / mesh units; positive where the surface is convex.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Curvature {
    /// Mean of the two principal curvatures.
    pub mean: f64,
    /// Half their difference, >= 0.
    pub deviation: f64,
    /// Direction of the greater (signed) one, as an angle of the node's frame.
    pub angle_rad: f64,
}

impl Curvature {
    /// The greatest curvature in any direction, without its sign.
    pub fn greatest(&self) -> f64 {
        self.mean.abs() + self.deviation
    }

    /// The angle of the direction that bends more, whichever way.
    pub fn higher_rad(&self) -> f64 {
        if self.mean >= 0.0 { self.angle_rad } else { self.angle_rad + std::f64::consts::FRAC_PI_2 }
    }

    /// How much more the surface bends in one direction than in the other: the difference of the curvatures' amounts.
    pub fn anisotropy(&self) -> f64 {
        2.0 * self.mean.abs().min(self.deviation)
    }
}

/// Radius of the neighbourhood as a share of the bounding box's diagonal.
pub(super) const RADIUS: f64 = 0.012;

/// Rounds of averaging at most: reached by meshes of millions of triangles.
const MAX_ROUNDS: f64 = 64.0;

/// Curvatures of all nodes.
pub fn curvatures(graph: &Graph) -> Vec<Curvature> {
    curvatures_on(graph, graph, |node| node)
}

/// Curvatures of the nodes of a coarser graph, given the node there that stands for one of `fine`.
pub(super) fn curvatures_on(fine: &Graph, graph: &Graph, stands_for: impl Fn(u32) -> u32 + Sync) -> Vec<Curvature> {
    let mut sums = vec![(0.0, c64::new(0.0, 0.0)); graph.len()];
    let of_triangle = |triangle: &[u32; 3]| of_triangle(fine, *triangle, graph, triangle.map(&stands_for));
    let of_triangles: Vec<_> = fine.triangles.par_iter().map(of_triangle).collect();
    for (triangle, shape) in fine.triangles.iter().zip(&of_triangles) {
        let Some(shape) = shape else { continue };
        for (k, node) in triangle.map(&stands_for).iter().enumerate() {
            let (mean, deviation) = &mut sums[*node as usize];
            *mean += shape.area * shape.mean;
            *deviation += shape.deviation * shape.axes[k] * shape.axes[k] * shape.area;
        }
    }
    let mut values: Vec<(f64, c64)> = sums
        .iter()
        .zip(&graph.areas)
        .map(|((mean, deviation), area)| {
            let scale = if *area > 0.0 { 1.0 / (3.0 * area) } else { 0.0 };
            (mean * scale, deviation * scale)
        })
        .collect();
    let radius = RADIUS * graph.diagonal() / graph.mean_link().max(1e-12);
    for _ in 0..(radius * radius).clamp(1.0, MAX_ROUNDS).round() as usize {
        values = averaged(graph, &values);
    }
    values
        .into_iter()
        .map(|(mean, deviation)| Curvature { mean, deviation: deviation.norm(), angle_rad: deviation.arg() / 2.0 })
        .collect()
}

struct Shape {
    area: f64,
    mean: f64,
    deviation: c64,
    /// Per corner: the triangle's first axis in the frame of the node that stands for it, a unit complex number.
    axes: [c64; 3],
}

fn of_triangle(fine: &Graph, triangle: [u32; 3], graph: &Graph, stand_for: [u32; 3]) -> Option<Shape> {
    let nodes = triangle.map(|node| node as usize);
    let p = nodes.map(|node| fine.positions[node]);
    let n = nodes.map(|node| fine.normals[node]);
    let cross = (p[1] - p[0]).cross(p[2] - p[0]);
    let normal = cross.try_normalize()?;
    let x = (p[1] - p[0]).try_normalize()?;
    let y = normal.cross(x);
    let plane = |v: DVec3| (v.dot(x), v.dot(y));
    // Least squares for II = [e f; f g] with II · edge = change of the normal, over the three edges.
    let (mut ata, mut atb) = (glam::DMat3::ZERO, DVec3::ZERO);
    for k in 0..3 {
        let (u, v) = plane(p[(k + 1) % 3] - p[k]);
        let (du, dv) = plane(n[(k + 1) % 3] - n[k]);
        for (row, right) in [(DVec3::new(u, v, 0.0), du), (DVec3::new(0.0, u, v), dv)] {
            ata += glam::DMat3::from_cols(row * row.x, row * row.y, row * row.z);
            atb += row * right;
        }
    }
    let trace = ata.x_axis.x + ata.y_axis.y + ata.z_axis.z;
    let determinant = ata.determinant();
    if determinant.is_nan() || determinant <= 1e-12 * trace.powi(3) {
        return None;
    }
    let [e, f, g] = (ata.inverse() * atb).to_array();
    let axes = stand_for.map(|node| node as usize);
    let axes = axes.map(|node| graph.flat(node, DQuat::from_rotation_arc(normal, graph.normals[node]) * x));
    Some(Shape { area: cross.length() / 2.0, mean: 0.5 * (e + g), deviation: c64::new(0.5 * (e - g), f), axes })
}

fn averaged(graph: &Graph, values: &[(f64, c64)]) -> Vec<(f64, c64)> {
    (0..graph.len())
        .into_par_iter()
        .map(|node| {
            let (own, area) = (values[node], graph.areas[node]);
            let (mut mean, mut deviation, mut total) = (own.0 * area, own.1 * area, area);
            for end in graph.ends(node) {
                let (other, area) = (values[end.node as usize], graph.areas[end.node as usize]);
                mean += other.0 * area;
                let turn = graph.turn_from(end.link, end.node);
                deviation += other.1 * turn * turn * area;
                total += area;
            }
            if total > 0.0 { (mean / total, deviation / total) } else { own }
        })
        .collect()
}
