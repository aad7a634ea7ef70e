//! The wave whose argument is the phase: at every node a complex number, so that neighbours differ as the links ask.
//!
//! Minimises the sum over links of w |ψ_b - e^(iω) ψ_a|², ψ_b conjugated where the ends differ in sign; so the system is
//! real, with a block of 2x2 for each pair. Its smallest eigenvector (Knöppel and others 2015, section 3) is found by
//! inverse iteration, per component. That wave fades where the links ask for most, and its phase is arbitrary there;
//! so it is then made equally strong everywhere, and smoothed again, in turn (Viertel and Osting, "An approach to quad
//! meshing based on harmonic cross-valued maps and the Ginzburg-Landau theory", 2019, section 4).

use std::f64::consts::TAU;

use glam::DVec2;

use super::growth::Step;
use crate::surface::graph::Graph;
use crate::surface::solve::{Factor, SolveError};

/// Distance over which one round smooths the wave, as a share of the diagonal.
const REACH: f64 = 0.1;

/// Rounds of inverse iteration at most.
const ROUNDS: usize = 12;

/// Rounds of smoothing and levelling at most.
const LEVELLED: usize = 12;

/// Mean change of the wave in a round, below which it has settled.
const SETTLED: f64 = 2e-3;

/// The wave at each node.
pub(super) fn wave(graph: &Graph, steps: &[Step]) -> Result<Vec<DVec2>, SolveError> {
    let reach = REACH * graph.diagonal();
    let pull = 1.0 / (reach * reach).max(1e-300);
    let mass: Vec<f64> = graph.areas.iter().map(|area| pull * area.max(1e-14) + 1e-12).collect();
    let factor = Factor::of_blocks(graph, &mass, |link| {
        let Step { sign, lines } = steps[link];
        let (sin, cos) = (TAU * lines).sin_cos();
        [[cos, -sin], [sign * sin, sign * cos]]
    })?;
    let components = components(graph);
    let mut wave: Vec<DVec2> = (0..graph.len()).map(start).collect();
    for round in 0..ROUNDS + LEVELLED {
        let flat = factor.solve(|row| wave[row / 2][row % 2] * mass[row / 2]);
        let mut next: Vec<DVec2> = flat.chunks_exact(2).map(|pair| DVec2::new(pair[0], pair[1])).collect();
        if round < ROUNDS {
            normalise(&components, &graph.areas, &mut next);
        } else {
            next.iter_mut().for_each(|wave| *wave = wave.try_normalize().unwrap_or(DVec2::X));
        }
        let change = wave.iter().zip(&next).map(|(before, after)| before.distance(*after)).sum::<f64>();
        wave = next;
        if round >= ROUNDS && change < SETTLED * wave.len() as f64 {
            break;
        }
    }
    Ok(wave)
}

/// A direction by the node's number: nothing is preferred, and it is the same everywhere.
fn start(node: usize) -> DVec2 {
    // The finaliser of splitmix64.
    let mut z = (node as u64 + 1).wrapping_mul(0x9e37_79b9_7f4a_7c15);
    z = (z ^ z >> 30).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    z = (z ^ z >> 27).wrapping_mul(0x94d0_49bb_1331_11eb);
    let turn = (z >> 11) as f64 / (1_u64 << 53) as f64;
    DVec2::from_angle(TAU * turn)
}

/// Per node, the least node it is linked with, over any number of links.
fn components(graph: &Graph) -> Vec<u32> {
    let mut of: Vec<u32> = (0..graph.len() as u32).collect();
    fn root(of: &mut [u32], mut node: u32) -> u32 {
        while of[node as usize] != node {
            of[node as usize] = of[of[node as usize] as usize];
            node = of[node as usize];
        }
        node
    }
    for link in &graph.links {
        let (a, b) = (root(&mut of, link.a), root(&mut of, link.b));
        of[a.max(b) as usize] = a.min(b);
    }
    (0..graph.len() as u32).map(|node| root(&mut of, node)).collect()
}

/// Gives each component the mean square 1.
fn normalise(components: &[u32], areas: &[f64], wave: &mut [DVec2]) {
    let mut sums = vec![(0.0, 0.0); wave.len()];
    for ((component, area), wave) in components.iter().zip(areas).zip(wave.iter()) {
        let (square, total) = &mut sums[*component as usize];
        *square += area.max(1e-14) * wave.length_squared();
        *total += area.max(1e-14);
    }
    for (component, wave) in components.iter().zip(wave) {
        let (square, total) = sums[*component as usize];
        *wave *= (total / square.max(1e-300)).sqrt();
    }
}
