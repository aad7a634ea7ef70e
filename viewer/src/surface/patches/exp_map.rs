//! The discrete exponential map: coordinates around a seed that are true to length along the ways out from it.
//! Schmidt, Grimm, Wyvill, "Interactive decal compositing with discrete exponential maps", 2006; each node is predicted
//! from all its finished neighbours, weighted by one over the distance.

use std::cmp::Reverse;
use std::collections::BinaryHeap;

use faer::c64;
use glam::DVec2;

use super::seeds::{Ordered, dense_length};
use crate::surface::graph::{Graph, unit};

/// A node in a patch.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Visit {
    pub(super) node: u32,
    /// Place in the patch, in mesh units: the seed is the origin.
    pub(super) place: DVec2,
    /// Times a direction in the node's frame, it gives the direction in the patch: a unit complex number.
    pub(super) turn: c64,
    /// Distance to the seed, in mesh units; bending does not change it.
    pub(super) radius: f64,
}

/// Explores one patch after the other with the same memory.
pub(super) struct Explorer {
    /// Per node, the way to it in the metric; infinite where it was not reached.
    distance: Vec<f64>,
    /// Per node, its visit; `u32::MAX` where it is not finished.
    finished: Vec<u32>,
    touched: Vec<u32>,
    heap: BinaryHeap<Reverse<(Ordered, u32)>>,
    /// Places by projection on the seed's tangent plane, instead of predicted ones.
    planar: bool,
}

const UNFINISHED: u32 = u32::MAX;

impl Explorer {
    pub(super) fn new(nodes: usize, planar: bool) -> Self {
        Self {
            planar,
            distance: vec![f64::INFINITY; nodes],
            finished: vec![UNFINISHED; nodes],
            touched: Vec::new(),
            heap: BinaryHeap::new(),
        }
    }

    /// All nodes within a distance of the seed (in the metric), in the order of their distance. Times a direction in the
    /// seed's frame, `axis` gives that in the patch.
    pub(super) fn explore(&mut self, graph: &Graph, density: &[f64], seed: u32, axis: c64, reach: f64) -> Vec<Visit> {
        for node in self.touched.drain(..) {
            self.distance[node as usize] = f64::INFINITY;
            self.finished[node as usize] = UNFINISHED;
        }
        let mut visits: Vec<Visit> = Vec::new();
        self.reach(seed, 0.0);
        while let Some(Reverse((Ordered(distance), node))) = self.heap.pop() {
            if self.finished[node as usize] != UNFINISHED || distance > self.distance[node as usize] {
                continue;
            }
            let visit = if node == seed {
                Visit { node, place: DVec2::ZERO, turn: axis, radius: 0.0 }
            } else if self.planar {
                projected(graph, seed, node)
            } else {
                self.predicted(graph, &visits, node)
            };
            self.finished[node as usize] = visits.len() as u32;
            visits.push(visit);
            for end in graph.ends(node as usize) {
                let next = distance + dense_length(graph, density, node, end.node);
                // The first ring always belongs to a patch.
                if next < self.distance[end.node as usize] && (next <= reach || node == seed) {
                    self.reach(end.node, next);
                }
            }
        }
        visits
    }

    /// Which of the last visits was of this node; none of them where the number is too great.
    pub(super) fn visited(&self, node: u32) -> usize {
        self.finished[node as usize] as usize
    }

    fn reach(&mut self, node: u32, distance: f64) {
        if self.distance[node as usize].is_infinite() {
            self.touched.push(node);
        }
        self.distance[node as usize] = distance;
        self.heap.push(Reverse((Ordered(distance), node)));
    }

    fn predicted(&self, graph: &Graph, visits: &[Visit], node: u32) -> Visit {
        let (mut place, mut turn, mut total) = (DVec2::ZERO, c64::new(0.0, 0.0), 0.0);
        for end in graph.ends(node as usize) {
            let Some(from) = visits.get(self.finished[end.node as usize] as usize) else { continue };
            let step = graph.positions[node as usize] - graph.positions[end.node as usize];
            let length = step.length();
            let weight = 1.0 / length.max(1e-12);
            // The step as seen from both its ends: the mean direction is that of the arc between them.
            let link_turn = graph.turn_from(end.link, node);
            let here = graph.flat(end.node as usize, step);
            let there = graph.flat(node as usize, step) * link_turn;
            let along = unit(here + there) * from.turn * length;
            place += weight * (from.place + DVec2::new(along.re, along.im));
            turn += link_turn * from.turn * weight;
            total += weight;
        }
        let place = if total > 0.0 { place / total } else { place };
        Visit { node, place, turn: unit(turn), radius: place.length() }
    }
}

/// A node dropped onto the tangent plane of the seed.
fn projected(graph: &Graph, seed: u32, node: u32) -> Visit {
    let (from, to) = (seed as usize, node as usize);
    let step = graph.positions[to] - graph.positions[from];
    let place = DVec2::new(step.dot(graph.tangents[from]), step.dot(graph.bitangent(from)));
    Visit { node, place, turn: graph.flat(from, graph.tangents[to]), radius: step.length() }
}

/// The map around a node: other nodes within a distance and their places in the node's frame, in mesh units, nearest
/// first.
pub fn exponential_map(graph: &Graph, node: u32, reach: f64) -> Vec<(u32, DVec2)> {
    let density = vec![1.0; graph.len()];
    let visits = Explorer::new(graph.len(), false).explore(graph, &density, node, c64::new(1.0, 0.0), reach);
    visits.into_iter().map(|visit| (visit.node, visit.place)).collect()
}
