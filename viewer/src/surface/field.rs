//! The direction field: which way strokes run at every node, up to 180 degrees.
//!
//! Directions are kept as z = e^(2iθ) in the nodes' frames, so that opposite ones are the same. The field is the
//! smoothest one that still follows what is wanted where that is clear: (A + λCM) z = λCM q, with A the connection
//! Laplacian of the links, M the nodes' areas, q the wanted directions and C how clear they are.
//! Knöppel and others, "Globally optimal direction fields", 2013; curvature as the guide after Hertzmann and Zorin,
//! "Illustrating smooth surfaces", 2000, which Praun and others 2001, section 6, follow.

use std::f64::consts::{FRAC_PI_2, PI};

use faer::c64;
use glam::{DVec2, DVec3};
use rayon::prelude::*;

use super::curvature::Curvature;
use super::graph::{Graph, Link, wrapped};
use super::guides::{Guide, anchors};
use super::solve::{Factor, SolveError};
use crate::mesh::Mesh;
use crate::stage::Held;

/// What strokes follow.
#[derive(Clone, Debug, PartialEq, serde::Serialize, serde::Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum FieldSource {
    /// The direction in which the surface bends most: rings round a finger.
    Curvature,
    /// The direction in which it bends least: along a finger.
    LowerCurvature,
    /// A constant direction in mesh space, as far as it lies in the surface.
    Constant(DVec3),
    /// Across the projection of the light, given by the direction towards it in mesh space.
    Light(DVec3),
    /// The first coordinate of the mesh's own parametrisation.
    Uv,
}

/// How a field is made.
#[derive(Clone, Debug, PartialEq, serde::Serialize, serde::Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct FieldOptions {
    /// What strokes follow where no guide is near.
    pub source: FieldSource,
    /// How far directions spread, as a multiple of the default, 0.1..=10.
    pub smoothing: f64,
    /// Strokes drawn on the surface; the field follows them exactly.
    pub guides: Vec<Guide>,
}

impl Default for FieldOptions {
    fn default() -> Self {
        Self { source: FieldSource::Curvature, smoothing: 1.0, guides: Vec::new() }
    }
}

/// The directions at the nodes of a [`Graph`].
#[derive(Clone, Debug, PartialEq, serde::Serialize, serde::Deserialize)]
pub struct Field {
    /// Per node: the angle in the node's frame, -π/2..=π/2, in radians.
    pub angles_rad: Vec<f64>,
    /// Per node, 0..=1: how clear the direction is; 0 at singularities.
    pub strengths: Vec<f64>,
}

/// Distance over which clear directions reach into unclear places, as a share of the diagonal, at smoothing 1.
const REACH: f64 = 0.08;

/// Radius of curvature, as a share of the diagonal, below which an anisotropic place is clear.
const CLEAR_RADIUS: f64 = 0.25;

/// How clear the horizontal is that stands in where nothing else says anything.
const FALLBACK: f64 = 2e-3;

/// How much more than its clear surroundings a guide counts.
const GUIDE_WEIGHT: f64 = 1e4;

/// The field of a surface.
///
/// # Errors
/// [`SolveError`] if the system cannot be factorised.
pub fn field(
    graph: &Graph,
    mesh: &Mesh,
    curvatures: &[Curvature],
    options: &FieldOptions,
) -> Result<Field, SolveError> {
    let reach = REACH * options.smoothing * graph.diagonal();
    let lambda = 1.0 / (reach * reach).max(1e-300);
    let mut wanted = wanted(graph, mesh, curvatures, &options.source);
    for anchor in anchors(graph, &options.guides) {
        let along = graph.flat(anchor.node, anchor.direction);
        wanted[anchor.node] += along * along * (GUIDE_WEIGHT * anchor.weight);
    }
    let mass: Vec<f64> = graph.areas.iter().map(|area| lambda * area.max(1e-14)).collect();
    let own = |(wanted, mass): (&c64, &f64)| c64::new(mass * wanted.norm().max(1e-9), 0.0);
    let mut diagonal: Vec<c64> = wanted.iter().zip(&mass).map(own).collect();
    for link in &graph.links {
        diagonal[link.a as usize] += link.weight;
        diagonal[link.b as usize] += link.weight;
    }
    // z_b is compared with z_a carried over.
    let off = |link: &Link| -(link.carry() * link.carry() * link.weight);
    let off: Vec<c64> = graph.links.iter().map(off).collect();
    let z = Factor::of_links(graph, &diagonal, &off)?.solve(|node| wanted[node] * mass[node]);
    Ok(Field {
        angles_rad: z.iter().map(|z| z.arg() / 2.0).collect(),
        strengths: z.iter().map(|z| z.norm().min(1.0)).collect(),
    })
}

impl Field {
    /// Per node e^(2iθ).
    pub(super) fn doubled(&self) -> Vec<c64> {
        self.angles_rad.par_iter().map(|angle| c64::from_polar(1.0, 2.0 * angle)).collect()
    }

    /// The direction at a node, in mesh space.
    pub fn direction(&self, graph: &Graph, node: usize) -> DVec3 {
        graph.direction(node, self.angles_rad[node])
    }

    /// The angle at `to`, so chosen among the two opposite ones that it continues an angle at `from`.
    pub fn continued(&self, graph: &Graph, link: u32, from: u32, to: u32, angle_rad: f64) -> f64 {
        let carried = angle_rad + graph.turn_from(link, from).arg();
        let own = self.angles_rad[to as usize];
        if wrapped(own - carried).abs() > FRAC_PI_2 { own + PI } else { own }
    }

    /// The index of the field in each triangle, in halves: the field turns by `π · index` on a way around it. On a
    /// closed surface they sum to twice the Euler characteristic.
    pub fn indices(&self, graph: &Graph) -> Vec<i32> {
        let links = |a: u32, b: u32| graph.ends(a as usize).iter().find(|end| end.node == b).map(|end| end.link);
        graph
            .triangles
            .par_iter()
            .map(|triangle| {
                let (mut turns, mut changes) = (0.0, 0.0);
                for k in 0..3 {
                    let (a, b) = (triangle[k], triangle[(k + 1) % 3]);
                    let Some(link) = links(a, b) else { return 0 };
                    let turn = graph.turn_from(link, a).arg();
                    turns += turn;
                    changes += wrapped(2.0 * (self.angles_rad[b as usize] - self.angles_rad[a as usize] - turn));
                }
                ((changes + 2.0 * wrapped(turns)) / (2.0 * PI)).round() as i32
            })
            .collect()
    }
}

impl Held for Field {
    fn held(&self) -> usize {
        self.angles_rad.held() + self.strengths.held()
    }
}

/// What is wanted at each node: its direction as e^(2iθ), as long as it is clear.
fn wanted(graph: &Graph, mesh: &Mesh, curvatures: &[Curvature], source: &FieldSource) -> Vec<c64> {
    let clear_radius = CLEAR_RADIUS * graph.diagonal();
    let along = match source {
        FieldSource::Uv => uv_directions(graph, mesh),
        _ => Vec::new(),
    };
    let projected = |node: usize, direction: DVec3| {
        let normal = graph.normals[node];
        let flat = direction - normal * direction.dot(normal);
        let along = graph.flat(node, flat);
        along * along * flat.length_squared()
    };
    (0..graph.len())
        .into_par_iter()
        .map(|node| {
            let z = match source {
                FieldSource::Curvature | FieldSource::LowerCurvature => {
                    let curvature = &curvatures[node];
                    let quarter = if *source == FieldSource::Curvature { 0.0 } else { FRAC_PI_2 };
                    let clear = (curvature.anisotropy() * clear_radius).powi(2);
                    c64::from_polar(clear / (1.0 + clear), 2.0 * (curvature.higher_rad() + quarter))
                }
                FieldSource::Constant(direction) => projected(node, direction.normalize_or_zero()),
                // Across: a quarter turn, which is a half turn of z.
                FieldSource::Light(to_light) => -projected(node, to_light.normalize_or_zero()),
                FieldSource::Uv => projected(node, along[node].normalize_or_zero()),
            };
            // Level strokes, where nothing else is to be followed; on level ground, from left to right.
            z - projected(node, DVec3::Y) * FALLBACK + projected(node, DVec3::X) * (0.1 * FALLBACK)
        })
        .collect()
}

/// Per node the direction in which u grows and v does not.
fn uv_directions(graph: &Graph, mesh: &Mesh) -> Vec<DVec3> {
    let mut sums = vec![DVec3::ZERO; graph.len()];
    if mesh.uvs.is_empty() {
        return sums;
    }
    for corners in &mesh.triangles {
        let corners = corners.map(|vertex| vertex as usize);
        let p = corners.map(|vertex| mesh.positions[vertex].as_dvec3());
        let uv = corners.map(|vertex| mesh.uvs[vertex].as_dvec2());
        let (first, second): (DVec2, DVec2) = (uv[1] - uv[0], uv[2] - uv[0]);
        let along = (p[1] - p[0]) * second.y - (p[2] - p[0]) * first.y;
        let along = along.normalize_or_zero() * first.perp_dot(second).signum();
        let area = (p[1] - p[0]).cross(p[2] - p[0]).length();
        for vertex in corners {
            sums[graph.node_of_vertex[vertex] as usize] += along * area;
        }
    }
    sums
}
