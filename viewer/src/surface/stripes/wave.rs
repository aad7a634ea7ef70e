//! The wave whose argument is the phase: a complex number per cluster, so that neighbours differ as the links ask.
//!
//! Minimises the sum over links of w |ψ_b - e^(iω) ψ_a|², ψ_b conjugated where the ends differ in sign; so the system is
//! real, with a block of 2x2 for each pair. Its smallest eigenvector (Knöppel and others 2015, section 3) is found by
//! inverse iteration, per component. That wave fades where the links ask for most, and its phase is arbitrary there;
//! so it is then made equally strong everywhere, and smoothed again, in turn (Viertel and Osting, "An approach to quad
//! meshing based on harmonic cross-valued maps and the Ginzburg-Landau theory", 2019, section 4).

use std::f64::consts::TAU;

use faer::sparse::Triplet;
use glam::DVec2;

use super::clusters::Clusters;
use super::growth::Step;
use crate::surface::graph::Graph;
use crate::surface::solve::{Factor, SolveError};

/// Distance over which one round smooths the wave, as a share of the diagonal.
const REACH: f64 = 0.1;

/// Rounds of inverse iteration.
const ROUNDS: usize = 12;

/// Rounds of smoothing and levelling at most.
const LEVELLED: usize = 24;

/// Mean change of the wave in a round, below which it has settled.
const SETTLED: f64 = 1e-3;

/// The phase of each cluster, in lines.
pub(super) fn wave(graph: &Graph, steps: &[Step], clusters: &Clusters) -> Result<Vec<f64>, SolveError> {
    let reach = REACH * graph.diagonal();
    let pull = 1.0 / (reach * reach).max(1e-300);
    let count = clusters.firsts.len();
    let mut mass = vec![0.0; count];
    for (member, area) in clusters.members.iter().zip(&graph.areas) {
        mass[member.cluster as usize] += pull * area.max(1e-14) + 1e-12;
    }
    let factor = Factor::new(2 * count, &triplets(graph, steps, clusters, &mass))?;
    let components = components(graph, clusters);
    let mut wave: Vec<DVec2> = (0..count).map(start).collect();
    for round in 0..ROUNDS + LEVELLED {
        let flat = factor.solve(|row| wave[row / 2][row % 2] * mass[row / 2]);
        let mut next: Vec<DVec2> = flat.chunks_exact(2).map(|pair| DVec2::new(pair[0], pair[1])).collect();
        if round < ROUNDS {
            normalise(&components, &mass, &mut next);
        } else {
            next.iter_mut().for_each(|wave| *wave = wave.try_normalize().unwrap_or(DVec2::X));
        }
        let change = wave.iter().zip(&next).map(|(before, after)| before.distance(*after)).sum::<f64>();
        wave = next;
        if round > ROUNDS && change < SETTLED * count as f64 {
            break;
        }
    }
    Ok(wave.into_iter().map(|wave| wave.to_angle() / TAU).collect())
}

/// The lower triangle of the energy's matrix, and the masses.
fn triplets(graph: &Graph, steps: &[Step], clusters: &Clusters, mass: &[f64]) -> Vec<Triplet<usize, usize, f64>> {
    let mut triplets = Vec::with_capacity(2 * mass.len() + 8 * graph.links.len());
    for (row, mass) in mass.iter().flat_map(|mass| [mass, mass]).enumerate() {
        triplets.push(Triplet::new(row, row, *mass));
    }
    for (link, step) in graph.links.iter().zip(steps) {
        let [a, b] = [link.a, link.b].map(|node| clusters.members[node as usize]);
        // The same step, from cluster to cluster.
        let sign = a.sign * step.sign * b.sign;
        let lines = a.lines + a.sign * step.lines - sign * b.lines;
        let (sin, cos) = (TAU * lines).sin_cos();
        let block = [[cos, -sin], [sign * sin, sign * cos]];
        let (first, second) = (2 * a.cluster as usize, 2 * b.cluster as usize);
        for (row, entries) in block.into_iter().enumerate() {
            triplets.push(Triplet::new(first + row, first + row, link.weight));
            triplets.push(Triplet::new(second + row, second + row, link.weight));
            for (column, entry) in entries.into_iter().enumerate() {
                let entry = -link.weight * entry;
                // Within a cluster the block and its transpose add up.
                let (r, c) = (second + row, first + column);
                if r == c {
                    triplets.push(Triplet::new(r, c, 2.0 * entry));
                } else {
                    triplets.push(Triplet::new(r.max(c), r.min(c), entry));
                }
            }
        }
    }
    triplets
}

/// A direction by the cluster's number: nothing is preferred, and it is the same everywhere.
fn start(cluster: usize) -> DVec2 {
    // The finaliser of splitmix64.
    let mut z = (cluster as u64 + 1).wrapping_mul(0x9e37_79b9_7f4a_7c15);
    z = (z ^ z >> 30).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    z = (z ^ z >> 27).wrapping_mul(0x94d0_49bb_1331_11eb);
    let turn = (z >> 11) as f64 / (1_u64 << 53) as f64;
    DVec2::from_angle(TAU * turn)
}

/// Per cluster, the least one it is linked with, over any number of links.
fn components(graph: &Graph, clusters: &Clusters) -> Vec<u32> {
    fn root(of: &mut [u32], mut cluster: u32) -> u32 {
        while of[cluster as usize] != cluster {
            of[cluster as usize] = of[of[cluster as usize] as usize];
            cluster = of[cluster as usize];
        }
        cluster
    }
    let count = clusters.firsts.len() as u32;
    let mut of: Vec<u32> = (0..count).collect();
    for link in &graph.links {
        let [a, b] = [link.a, link.b].map(|node| root(&mut of, clusters.members[node as usize].cluster));
        of[a.max(b) as usize] = a.min(b);
    }
    (0..count).map(|cluster| root(&mut of, cluster)).collect()
}

/// Gives each component the mean square 1.
fn normalise(components: &[u32], mass: &[f64], wave: &mut [DVec2]) {
    let mut sums = vec![(0.0, 0.0); wave.len()];
    for ((component, mass), wave) in components.iter().zip(mass).zip(wave.iter()) {
        let (square, total) = &mut sums[*component as usize];
        *square += mass * wave.length_squared();
        *total += mass;
    }
    for (component, wave) in components.iter().zip(wave) {
        let (square, total) = sums[*component as usize];
        *wave *= (total / square.max(1e-300)).sqrt();
    }
}
