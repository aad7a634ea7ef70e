//! How densely lines stand: closer where their directions draw together, so that they need not end.
//!
//! With X along and Y across the lines, a phase whose gradient is f Y exists where f Y has no curl, that is where the
//! derivative of ln f along X is minus the curl of Y. This is solved by least squares, with a little of the gradient of
//! ln f in all directions and of ln f itself, which keep f even where the field leaves it open or asks too much.

use faer::c64;
use glam::DVec3;

use super::growth::{Growth, Loop};
use crate::surface::graph::Graph;
use crate::surface::solve::{Factor, SolveError};

/// Weight of the gradient of ln f in all directions, against that along the lines.
const EVEN: f64 = 0.02;

/// Distance, as a share of the diagonal, over which ln f falls back to 0 where nothing is asked for.
const REACH: f64 = 0.5;

/// Greatest factor between the frequency of a node and the mean, and its inverse.
const MOST: f64 = 6.0;

/// Lines per unit at each node, about `lines_per_unit`.
pub(super) fn frequencies(
    graph: &Graph,
    loops: &[Option<Loop>],
    growths: &[Growth],
    directions: &[c64],
    lines_per_unit: f64,
) -> Result<Vec<f64>, SolveError> {
    let reach = REACH * graph.diagonal();
    let pull = EVEN / (reach * reach).max(1e-300);
    // Areas and weights are at least 1e-14 and 0.02: the matrix is positive definite.
    let mut diagonal: Vec<f64> = graph.areas.iter().map(|area| pull * area.max(1e-14) + 1e-12).collect();
    let mut off: Vec<f64> = graph.links.iter().map(|link| -EVEN * link.weight).collect();
    for link in &graph.links {
        diagonal[link.a as usize] += EVEN * link.weight;
        diagonal[link.b as usize] += EVEN * link.weight;
    }
    let mut right = vec![0.0; graph.len()];
    for (triangle, sides) in graph.triangles.iter().zip(loops) {
        let Some(sides) = sides else { continue };
        let Some(part) = of_triangle(graph, *triangle, sides, growths, directions) else { continue };
        for k in 0..3 {
            let next = (k + 1) % 3;
            diagonal[triangle[k] as usize] += part.area * part.along[k] * part.along[k];
            off[sides[k].link as usize] += part.area * part.along[k] * part.along[next];
            right[triangle[k] as usize] -= part.area * part.along[k] * part.curl;
        }
    }
    let logs = Factor::of_links(graph, &diagonal, &off)?.solve(|node| right[node]);
    let most = MOST.ln();
    Ok(logs.iter().map(|log| lines_per_unit * log.clamp(-most, most).exp()).collect())
}

struct Part {
    area: f64,
    /// Derivative along the lines of the function that is 1 at a corner and 0 at the others.
    along: [f64; 3],
    /// Curl of the unit directions across the lines.
    curl: f64,
}

/// None where the field is singular, and where there is no area.
fn of_triangle(
    graph: &Graph,
    triangle: [u32; 3],
    sides: &Loop,
    growths: &[Growth],
    directions: &[c64],
) -> Option<Part> {
    let nodes = triangle.map(|node| node as usize);
    let p = nodes.map(|node| graph.positions[node]);
    let cross = (p[1] - p[0]).cross(p[2] - p[0]);
    let normal = cross.try_normalize()?;
    let longest = (0..3).map(|k| p[k].distance_squared(p[(k + 1) % 3])).fold(0.0, f64::max);
    if cross.length() < 1e-4 * longest || nodes.iter().any(|node| graph.normals[*node].dot(normal) <= 0.0) {
        return None;
    }
    let (mut sign, mut sum, mut line) = (1.0, 0.0, DVec3::ZERO);
    for (node, side) in nodes.iter().zip(sides) {
        let growth = growths[side.link as usize];
        let lines = 0.5 * (growth.at_a + growth.at_b);
        sum += sign * if side.forward { lines } else { -growth.sign * lines };
        line += graph.standing(*node, directions[*node]) * sign;
        sign *= growth.sign;
    }
    if sign < 0.0 {
        return None;
    }
    let line = (line - normal * line.dot(normal)).try_normalize()?;
    let area = 0.5 * cross.length();
    let along = [0, 1, 2].map(|k| normal.cross(p[(k + 2) % 3] - p[(k + 1) % 3]).dot(line) / (2.0 * area));
    // No direction turns by more than a right angle within a triangle.
    let limit = 2.0 / longest.sqrt();
    Some(Part { area, along, curl: (sum / area).clamp(-limit, limit) })
}
