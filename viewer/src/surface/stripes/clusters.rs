//! Nodes in clusters much smaller than a line is wide: within one, the phase follows from that of its first node by the
//! steps of the links alone. A surface of any size has a few thousand, so the wave costs little.

use std::collections::VecDeque;

use super::growth::Step;
use crate::surface::graph::Graph;

/// About how many clusters there are, where there are more nodes.
const COUNT: usize = 4_000;

/// The clusters of a surface.
pub(super) struct Clusters {
    /// First node of each.
    pub firsts: Vec<u32>,
    /// Per node: how it follows its cluster.
    pub members: Vec<Member>,
}

/// A node's phase is `sign * (phase of the cluster + lines)`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Member {
    pub cluster: u32,
    pub sign: f64,
    pub lines: f64,
}

impl Member {
    /// The node's phase, given its cluster's.
    pub(super) fn phase(self, of_clusters: &[f64]) -> f64 {
        self.sign * (of_clusters[self.cluster as usize] + self.lines)
    }
}

/// Grows clusters one by one, each over links from the first node that is left.
pub(super) fn clusters(graph: &Graph, steps: &[Step]) -> Clusters {
    let size = graph.len().div_ceil(COUNT);
    let mut firsts = Vec::new();
    let mut members: Vec<Option<Member>> = vec![None; graph.len()];
    let mut queue = VecDeque::new();
    for first in 0..graph.len() {
        if members[first].is_some() {
            continue;
        }
        let cluster = firsts.len() as u32;
        firsts.push(first as u32);
        let own = Member { cluster, sign: 1.0, lines: 0.0 };
        members[first] = Some(own);
        queue.push_back((first, own));
        let mut left = size - 1;
        while let Some((node, member)) = queue.pop_front() {
            for end in graph.ends(node) {
                if left == 0 || members[end.node as usize].is_some() {
                    continue;
                }
                let step = steps[end.link as usize];
                let lines = member.lines + member.sign * step.from(node as u32 == graph.links[end.link as usize].a);
                let next = Member { cluster, sign: step.sign * member.sign, lines };
                members[end.node as usize] = Some(next);
                queue.push_back((end.node as usize, next));
                left -= 1;
            }
        }
    }
    let alone = Member { cluster: 0, sign: 1.0, lines: 0.0 };
    Clusters { firsts, members: members.into_iter().map(|member| member.unwrap_or(alone)).collect() }
}
