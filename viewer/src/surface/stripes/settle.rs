//! The phases of all nodes, from those of the clusters: with the whole numbers as the wave has them, the phases whose
//! differences are nearest to what the links ask for are those of a linear system.

use super::clusters::Clusters;
use super::growth::Step;
use crate::surface::graph::Graph;
use crate::surface::solve::{Factor, SolveError};

/// Solutions, each with the whole numbers of the one before.
const ROUNDS: usize = 3;

/// How much a phase is held where it was, against a link of weight 1.
const HELD: f64 = 1e-6;

/// The phase of each node, in lines.
pub(super) fn settled(
    graph: &Graph,
    steps: &[Step],
    clusters: &Clusters,
    of_clusters: &[f64],
) -> Result<Vec<f64>, SolveError> {
    let mut phases: Vec<f64> = clusters.members.iter().map(|member| member.phase(of_clusters)).collect();
    let mut diagonal = vec![HELD; graph.len()];
    for link in &graph.links {
        diagonal[link.a as usize] += link.weight;
        diagonal[link.b as usize] += link.weight;
    }
    let off: Vec<f64> = graph.links.iter().zip(steps).map(|(link, step)| -link.weight * step.sign).collect();
    let factor = Factor::of_links(graph, &diagonal, &off)?;
    for _ in 0..ROUNDS {
        let mut right = vec![0.0; graph.len()];
        for (link, step) in graph.links.iter().zip(steps) {
            let (a, b) = (link.a as usize, link.b as usize);
            let excess = step.sign * phases[b] - phases[a] - step.lines;
            let excess = link.weight * (excess - excess.round());
            right[a] += excess;
            right[b] -= step.sign * excess;
        }
        for (phase, change) in phases.iter_mut().zip(factor.solve(|node| right[node])) {
            *phase += change;
        }
    }
    Ok(phases)
}
