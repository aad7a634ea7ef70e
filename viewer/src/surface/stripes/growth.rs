//! How the phase wants to grow along the links.
//!
//! Directions have no sign, so each node picks one, and a link knows whether its two ends agree. What is said of a link
//! is said in the sign of its first node, from the first to the second.

use faer::c64;
use rayon::prelude::*;

use crate::surface::graph::Graph;

/// Growth along a link for one line per unit.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Growth {
    /// 1 where both ends agree on the sign of the direction, else -1.
    pub sign: f64,
    /// As the first node sees it: the link's length across its lines.
    pub at_a: f64,
    /// As the second does.
    pub at_b: f64,
}

/// Growth along a link, in lines.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Step {
    /// As in [`Growth`].
    pub sign: f64,
    /// From the first node to the second.
    pub lines: f64,
}

/// One side of a triangle on the way round.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Side {
    /// Index of its link.
    pub link: u32,
    /// Whether the way leads from the link's first node to its second.
    pub forward: bool,
}

/// The sides from corner 0 to 1, 1 to 2, and 2 to 0.
pub(super) type Loop = [Side; 3];

/// The sides of all triangles; none where two corners are one node.
pub(super) fn loops(graph: &Graph) -> Vec<Option<Loop>> {
    let side = |from: u32, to: u32| {
        let end = graph.ends(from as usize).iter().find(|end| end.node == to)?;
        Some(Side { link: end.link, forward: from < to })
    };
    graph.triangles.par_iter().map(|[a, b, c]| Some([side(*a, *b)?, side(*b, *c)?, side(*c, *a)?])).collect()
}

/// Growths of all links for lines that run this way: per node a direction in its frame, a unit complex number.
pub(super) fn growths(graph: &Graph, along: &[c64]) -> Vec<Growth> {
    graph
        .links
        .par_iter()
        .map(|link| {
            let (a, b) = (link.a as usize, link.b as usize);
            let chord = graph.positions[b] - graph.positions[a];
            let length = chord.length();
            let across = |node: usize| length * (graph.flat(node, chord) * along[node].conj()).im;
            let carried = along[a] * link.carry();
            let sign = if (along[b] * carried.conj()).re < 0.0 { -1.0 } else { 1.0 };
            Growth { sign, at_a: across(a), at_b: sign * across(b) }
        })
        .collect()
}

/// What the links ask for, given lines per unit at each node.
pub(super) fn steps(graph: &Graph, growths: &[Growth], frequencies: &[f64]) -> Vec<Step> {
    let step = |(link, growth): (&crate::surface::graph::Link, &Growth)| {
        let (a, b) = (frequencies[link.a as usize], frequencies[link.b as usize]);
        Step { sign: growth.sign, lines: 0.5 * (a * growth.at_a + b * growth.at_b) }
    };
    graph.links.iter().zip(growths).map(step).collect()
}

impl Step {
    /// Growth from `side`'s start to its end, in the sign of its start.
    pub(super) fn along(&self, side: Side) -> f64 {
        self.from(side.forward)
    }

    /// Growth to the other end, in the sign of the end it starts from.
    pub(super) fn from(&self, first: bool) -> f64 {
        if first { self.lines } else { -self.sign * self.lines }
    }
}
