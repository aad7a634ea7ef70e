//! The surface as a graph of nodes with tangent frames, which field, patches and stripes are computed on.
//!
//! A node is a normal group of the mesh: corners that share one smooth normal. Seams of the parametrisation do not
//! show in it; hard edges separate it.

use std::f64::consts::{PI, TAU};
use std::sync::OnceLock;

use faer::c64;
use glam::{DQuat, DVec2, DVec3};
use rayon::prelude::*;

use super::solve::{Pattern, SolveError};
use crate::mesh::Mesh;
use crate::stage::Held;

/// Nodes, triangles and links of a surface.
#[derive(Clone, Debug, Default)]
pub struct Graph {
    /// Per node, in mesh space.
    pub positions: Vec<DVec3>,
    /// Per node, unit.
    pub normals: Vec<DVec3>,
    /// Per node, unit and perpendicular to the normal: angles at a node are counted from it, counter-clockwise seen
    /// from outside.
    pub tangents: Vec<DVec3>,
    /// Per node: a third of the area of its triangles.
    pub areas: Vec<f64>,
    /// Nodes of the mesh's triangles, in the mesh's order.
    pub triangles: Vec<[u32; 3]>,
    /// Pairs of nodes that share a triangle, each once, sorted.
    pub links: Vec<Link>,
    /// Per vertex of the mesh, its node.
    pub node_of_vertex: Vec<u32>,
    starts: Vec<u32>,
    ends: Vec<End>,
    pattern: OnceLock<Pattern>,
}

/// Two nodes of a triangle.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Link {
    /// The lesser node.
    pub a: u32,
    /// The greater node.
    pub b: u32,
    /// Half the sum of the cotangents of the opposite angles, 0.02..=20.
    pub weight: f64,
    /// Unit complex number: times a direction in the frame of `a`, it gives the same direction in that of `b`, carried
    /// over by the least rotation that turns the one normal into the other.
    pub turn: DVec2,
}

impl Link {
    /// Its turn, to calculate with.
    pub(crate) fn carry(&self) -> c64 {
        c64::new(self.turn.x, self.turn.y)
    }
}

/// A link as seen from one of its nodes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct End {
    /// The node at the other end.
    pub node: u32,
    /// Index of the link.
    pub link: u32,
}

/// Bounds of the weights: slivers have cotangents without bound.
const WEIGHTS: std::ops::RangeInclusive<f64> = 0.02..=20.0;

impl Graph {
    /// The graph of a mesh.
    pub fn new(mesh: &Mesh) -> Self {
        let count = mesh.normal_groups.iter().max().map_or(0, |group| *group as usize + 1);
        let mut positions = vec![DVec3::ZERO; count];
        let mut normals = vec![DVec3::Y; count];
        for (vertex, group) in mesh.normal_groups.iter().enumerate() {
            positions[*group as usize] = mesh.positions[vertex].as_dvec3();
            normals[*group as usize] = mesh.normals[vertex].as_dvec3().try_normalize().unwrap_or(DVec3::Y);
        }
        let tangents = normals.par_iter().map(|normal| fixed_tangent(*normal)).collect();
        let triangles = mesh.triangles.iter().map(|corners| corners.map(|v| mesh.normal_groups[v as usize])).collect();
        let mut graph = Self {
            positions,
            normals,
            tangents,
            triangles,
            node_of_vertex: mesh.normal_groups.clone(),
            ..Self::default()
        };
        graph.measure();
        graph.link(&[]);
        graph
    }

    /// A graph of given nodes, with given areas; `touching` are nodes to be linked even where no triangle has them.
    pub(super) fn of_nodes(
        positions: Vec<DVec3>,
        normals: Vec<DVec3>,
        areas: Vec<f64>,
        triangles: Vec<[u32; 3]>,
        touching: &[[u32; 2]],
        node_of_vertex: Vec<u32>,
    ) -> Self {
        let tangents = normals.par_iter().map(|normal| fixed_tangent(*normal)).collect();
        let mut graph = Self { positions, normals, tangents, areas, triangles, node_of_vertex, ..Self::default() };
        graph.link(touching);
        graph
    }

    /// Nodes.
    pub fn len(&self) -> usize {
        self.positions.len()
    }

    /// Whether there are no nodes.
    pub fn is_empty(&self) -> bool {
        self.positions.is_empty()
    }

    /// Links of a node.
    pub fn ends(&self, node: usize) -> &[End] {
        &self.ends[self.starts[node] as usize..self.starts[node + 1] as usize]
    }

    /// The third axis of a node's frame: normal x tangent.
    pub fn bitangent(&self, node: usize) -> DVec3 {
        self.normals[node].cross(self.tangents[node])
    }

    /// The direction at an angle of a node's frame.
    pub fn direction(&self, node: usize, angle_rad: f64) -> DVec3 {
        self.standing(node, c64::from_polar(1.0, angle_rad))
    }

    /// The direction in mesh space that one in a node's frame means.
    pub(crate) fn standing(&self, node: usize, flat: c64) -> DVec3 {
        self.tangents[node] * flat.re + self.bitangent(node) * flat.im
    }

    /// The angle of a direction in a node's frame, -π..=π; what stands off the tangent plane does not count.
    pub fn angle(&self, node: usize, direction: DVec3) -> f64 {
        direction.dot(self.bitangent(node)).atan2(direction.dot(self.tangents[node]))
    }

    /// A direction in a node's frame, as a unit complex number; 1 for one that stands upright.
    pub(crate) fn flat(&self, node: usize, direction: DVec3) -> c64 {
        unit(c64::new(direction.dot(self.tangents[node]), direction.dot(self.bitangent(node))))
    }

    /// Times a direction in the frame of `from`, it gives the same direction at the link's other end.
    pub(crate) fn turn_from(&self, link: u32, from: u32) -> c64 {
        let link = &self.links[link as usize];
        if from == link.a { link.carry() } else { link.carry().conj() }
    }

    /// Length of the diagonal of the bounding box.
    pub fn diagonal(&self) -> f64 {
        let low = self.positions.iter().copied().fold(DVec3::INFINITY, DVec3::min);
        let high = self.positions.iter().copied().fold(DVec3::NEG_INFINITY, DVec3::max);
        if self.is_empty() { 0.0 } else { (high - low).length() }
    }

    /// Mean length of the links; 0 where there are none.
    pub fn mean_link(&self) -> f64 {
        let length = |link: &Link| self.positions[link.a as usize].distance(self.positions[link.b as usize]);
        self.links.iter().map(length).sum::<f64>() / self.links.len().max(1) as f64
    }

    /// How systems on this graph are solved.
    pub(super) fn pattern(&self) -> Result<&Pattern, SolveError> {
        if let Some(known) = self.pattern.get() {
            return Ok(known);
        }
        let pattern = Pattern::new(self)?;
        Ok(self.pattern.get_or_init(|| pattern))
    }

    fn measure(&mut self) {
        self.areas = vec![0.0; self.positions.len()];
        for triangle in &self.triangles {
            let [a, b, c] = triangle.map(|node| self.positions[node as usize]);
            let third = (b - a).cross(c - a).length() / 6.0;
            for node in triangle {
                self.areas[*node as usize] += third;
            }
        }
    }

    fn link(&mut self, touching: &[[u32; 2]]) {
        // Per triangle and corner: the opposite link and half the cotangent at the corner.
        let of_corner = |triangle: &[u32; 3], k: usize| {
            let (i, j) = (triangle[(k + 1) % 3], triangle[(k + 2) % 3]);
            let [at, u, v] = [k, (k + 1) % 3, (k + 2) % 3].map(|k| self.positions[triangle[k] as usize]);
            let (u, v) = (u - at, v - at);
            let area = u.cross(v).length().max(1e-12 * (u.length_squared() + v.length_squared()));
            (i.min(j), i.max(j), 0.5 * u.dot(v) / area.max(1e-300))
        };
        let mut halves: Vec<(u32, u32, f64)> = vec![(0, 0, 0.0); 3 * self.triangles.len() + touching.len()];
        let (of_triangles, besides) = halves.split_at_mut(3 * self.triangles.len());
        of_triangles.par_chunks_exact_mut(3).zip(&self.triangles).for_each(|(halves, triangle)| {
            halves.iter_mut().enumerate().for_each(|(k, half)| *half = of_corner(triangle, k));
        });
        besides.iter_mut().zip(touching).for_each(|(half, [a, b])| *half = (*a.min(b), *a.max(b), 0.0));
        // A stable sort: the sums are the same for any number of threads.
        halves.par_sort_by_key(|(a, b, _)| (*a, *b));
        let same = |x: &(u32, u32, f64), y: &(u32, u32, f64)| (x.0, x.1) == (y.0, y.1);
        let links = || halves.chunk_by(same).filter(|same| same[0].0 != same[0].1);
        let mut sums: Vec<(u32, u32, f64)> = Vec::with_capacity(links().count());
        sums.extend(links().map(|same| (same[0].0, same[0].1, same.iter().map(|half| half.2).sum::<f64>())));
        drop(halves);
        self.links = sums
            .par_iter()
            .map(|&(a, b, weight)| Link {
                a,
                b,
                weight: weight.clamp(*WEIGHTS.start(), *WEIGHTS.end()),
                turn: self.turn(a as usize, b as usize),
            })
            .collect();
        let mut counts = vec![0u32; self.len() + 1];
        for link in &self.links {
            counts[link.a as usize + 1] += 1;
            counts[link.b as usize + 1] += 1;
        }
        for node in 0..self.len() {
            counts[node + 1] += counts[node];
        }
        self.starts = counts.clone();
        self.ends = vec![End { node: 0, link: 0 }; 2 * self.links.len()];
        for (index, link) in self.links.iter().enumerate() {
            for (from, to) in [(link.a, link.b), (link.b, link.a)] {
                let place = &mut counts[from as usize];
                self.ends[*place as usize] = End { node: to, link: index as u32 };
                *place += 1;
            }
        }
    }

    fn turn(&self, a: usize, b: usize) -> DVec2 {
        let least = DQuat::from_rotation_arc(self.normals[a], self.normals[b]);
        let turn = self.flat(b, least * self.tangents[a]);
        DVec2::new(turn.re, turn.im)
    }
}

impl Held for Graph {
    fn held(&self) -> usize {
        let nodes = self.positions.held() + self.normals.held() + self.tangents.held() + self.areas.held();
        let links = self.links.held() + self.starts.held() + self.ends.held();
        nodes + links + self.triangles.held() + self.node_of_vertex.held()
    }
}

/// A complex number of length 1; 1 for none.
pub(crate) fn unit(z: c64) -> c64 {
    let length = z.norm_sqr().sqrt();
    if length > 0.0 { z / length } else { c64::new(1.0, 0.0) }
}

/// A unit vector perpendicular to a normal: level, where the normal does not stand upright.
pub fn fixed_tangent(normal: DVec3) -> DVec3 {
    let up = if normal.y.abs() > 0.9 { DVec3::Z } else { DVec3::Y };
    up.cross(normal).normalize()
}

/// The same angle within -π..=π.
pub fn wrapped(angle_rad: f64) -> f64 {
    let turned = (angle_rad + PI).rem_euclid(TAU) - PI;
    if turned.is_finite() { turned } else { 0.0 }
}
