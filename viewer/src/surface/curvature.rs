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
const RADIUS: f64 = 0.012;

/// Rounds of averaging at most: reached by meshes of millions of triangles.
const MAX_ROUNDS: f64 = 64.0;

/// Curvatures of all nodes.
pub fn curvatures(graph: &Graph) -> Vec<Curvature> {
    let mut sums = vec![(0.0, c64::new(0.0, 0.0)); graph.len()];
    let of_triangles: Vec<_> = graph.triangles.par_iter().map(|triangle| of_triangle(graph, *triangle)).collect();
    for (triangle, shape) in graph.triangles.iter().zip(&of_triangles) {
        let Some(shape) = shape else { continue };
        for (k, node) in triangle.iter().enumerate() {
            let (mean, deviation) = &mut sums[*node as usize];
            *mean += shape.area * shape.mean;
            *deviation += shape.deviation * c64::from_polar(shape.area, 2.0 * shape.turns_rad[k]);
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
    /// Per corner: the angle of the triangle's first axis in the node's frame.
    turns_rad: [f64; 3],
}

fn of_triangle(graph: &Graph, triangle: [u32; 3]) -> Option<Shape> {
    let nodes = triangle.map(|node| node as usize);
    let p = nodes.map(|node| graph.positions[node]);
    let n = nodes.map(|node| graph.normals[node]);
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
    let turns_rad = nodes.map(|node| graph.angle(node, DQuat::from_rotation_arc(normal, graph.normals[node]) * x));
    Some(Shape { area: cross.length() / 2.0, mean: 0.5 * (e + g), deviation: c64::new(0.5 * (e - g), f), turns_rad })
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
                deviation += other.1 * c64::from_polar(area, 2.0 * graph.turn_from(end.link, end.node));
                total += area;
            }
            if total > 0.0 { (mean / total, deviation / total) } else { own }
        })
        .collect()
}
