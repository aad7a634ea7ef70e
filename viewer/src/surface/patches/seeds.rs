//! Where patches have their centres: each new seed is the node farthest from all others, in a metric in which bent
//! places are longer.

use std::cmp::{Ordering, Reverse};
use std::collections::BinaryHeap;

use rayon::prelude::*;
use tam_gen::sequence::Draw;

use crate::surface::coarse::Ground;
use crate::surface::curvature::Curvature;
use crate::surface::graph::Graph;

/// A number that heaps can order.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(in crate::surface) struct Ordered(pub(in crate::surface) f64);

impl Eq for Ordered {}

impl PartialOrd for Ordered {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl Ord for Ordered {
    fn cmp(&self, other: &Self) -> Ordering {
        self.0.total_cmp(&other.0)
    }
}

/// Rounds in which the density is made smooth, where nodes are clusters and where they are not.
const SMOOTHING: [usize; 2] = [1, 4];

/// How many times closer patches stand at each node than on flat ground, 1..=`greatest`.
pub(super) fn density(ground: &Ground<'_>, spacing: f64, greatest: f64) -> Vec<f64> {
    let Ground { graph, curvatures, .. } = ground;
    let wanted = |curvature: &Curvature| (curvature.greatest() * spacing).clamp(1.0, greatest);
    let mut density: Vec<f64> = curvatures.iter().map(wanted).collect();
    for _ in 0..SMOOTHING[usize::from(ground.coarse.is_none())] {
        density = (0..graph.len())
            .into_par_iter()
            .map(|node| {
                let ends = graph.ends(node);
                let sum: f64 = ends.iter().map(|end| density[end.node as usize]).sum();
                (density[node] + sum) / (1 + ends.len()) as f64
            })
            .collect();
    }
    density
}

/// Length of a link in the metric.
pub(super) fn dense_length(graph: &Graph, density: &[f64], a: u32, b: u32) -> f64 {
    let (a, b) = (a as usize, b as usize);
    graph.positions[a].distance(graph.positions[b]) * 0.5 * (density[a] + density[b])
}

/// Nodes such that none is farther than `spacing` from one of them; one at least in every component.
pub(super) fn spread(graph: &Graph, density: &[f64], spacing: f64) -> Vec<u32> {
    let mut distance = vec![f64::INFINITY; graph.len()];
    // Nodes that no triangle has stay alone.
    let mut far: BinaryHeap<(Ordered, Reverse<u32>)> = (0..graph.len() as u32)
        .filter(|node| !graph.ends(*node as usize).is_empty())
        .map(|node| (Ordered(f64::INFINITY), Reverse(node)))
        .collect();
    let mut near: BinaryHeap<Reverse<(Ordered, u32)>> = BinaryHeap::new();
    let mut seeds = Vec::new();
    while let Some((Ordered(key), Reverse(seed))) = far.pop() {
        let current = distance[seed as usize];
        if current < key {
            // It has come closer since; wait until it is the farthest again.
            if current > spacing {
                far.push((Ordered(current), Reverse(seed)));
            }
            continue;
        }
        if key <= spacing {
            break;
        }
        seeds.push(seed);
        distance[seed as usize] = 0.0;
        near.push(Reverse((Ordered(0.0), seed)));
        while let Some(Reverse((Ordered(reached), node))) = near.pop() {
            if reached > distance[node as usize] {
                continue;
            }
            for end in graph.ends(node as usize) {
                let next = reached + dense_length(graph, density, node, end.node);
                if next < distance[end.node as usize] {
                    distance[end.node as usize] = next;
                    near.push(Reverse((Ordered(next), end.node)));
                }
            }
        }
    }
    seeds
}

/// Place of a seed on the tile, of one of the angles at which it is drawn.
pub(super) fn offset(seed: usize, angle: usize) -> [f64; 2] {
    let mut draw = Draw::new(((seed as u64) << 8) | angle as u64, "patch");
    [draw.unit(), draw.unit()]
}
