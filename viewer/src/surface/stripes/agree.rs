//! One way of counting lines for neighbouring triangles: the phase of a triangle is known up to sign and whole numbers, and
//! these are chosen so that phases are equal along shared edges. Across an edge, gradients tell the sign and the phases of its
//! middle the number.

use std::collections::VecDeque;

use glam::DVec3;
use rayon::prelude::*;
use tam_shaders::types::NO_FACE;

use super::StripePhases;
use super::phase::stripe_phase;
use crate::surface::graph::Graph;

/// Phases are counted from a multiple of this, so that 32 bits hold them well.
const PERIOD: i32 = 16;

/// How a triangle's phase is counted otherwise: `sign * phase + number`.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct Count {
    /// Whether the sign is -1.
    pub(crate) turned: bool,
    /// Whole.
    pub(crate) number: f64,
}

impl Count {
    /// The phase that is counted so.
    pub(crate) fn phase(self, of_triangle: f64) -> f64 {
        let sign = if self.turned { -1.0 } else { 1.0 };
        sign * of_triangle + self.number
    }
}

/// The edges between triangles, as the phases of one field see them.
pub(crate) struct Edges<'a> {
    pub(crate) graph: &'a Graph,
    pub(crate) phases: &'a [StripePhases],
    /// Per triangle, the gradient of the phase between the corners, in lines per mesh unit.
    slopes: Vec<DVec3>,
}

impl<'a> Edges<'a> {
    pub(crate) fn new(graph: &'a Graph, phases: &'a [StripePhases]) -> Self {
        let slopes = graph.triangles.par_iter().zip(phases).map(|(nodes, phases)| gradient(graph, *nodes, phases));
        Self { graph, phases, slopes: slopes.collect() }
    }

    /// How the second of two triangles is counted as the first one, beyond whose side `side` it is; none over a hard edge.
    pub(crate) fn beyond(&self, [here, there]: [u32; 2], side: usize, count: Count) -> Option<Count> {
        let (here, there) = (here as usize, there as usize);
        let ends = [self.graph.triangles[here][side], self.graph.triangles[here][(side + 1) % 3]];
        let opposite = (0..3).find(|k| !ends.contains(&self.graph.triangles[there][*k]))?;
        if !ends.iter().all(|end| self.graph.triangles[there].contains(end)) {
            return None;
        }
        let turned = count.turned != (self.slopes[here].dot(self.slopes[there]) < 0.0);
        let next = Count { turned, number: 0.0 };
        let number = count.phase(self.middle(here, (side + 2) % 3)) - next.phase(self.middle(there, opposite));
        Some(Count { number: number.round(), ..next })
    }

    /// The phase in the middle of the side opposite to a corner.
    fn middle(&self, triangle: usize, opposite: usize) -> f64 {
        let phases = &self.phases[triangle];
        if phases.is_linear() {
            let [a, b] = [1, 2].map(|k| f64::from(phases.corners[(opposite + k) % 3]));
            return 0.5 * (a + b);
        }
        let mut weights = [0.5; 3];
        weights[opposite] = 0.0;
        stripe_phase(phases, weights.into())
    }
}

fn gradient(graph: &Graph, nodes: [u32; 3], phases: &StripePhases) -> DVec3 {
    let [a, b, c] = nodes.map(|node| graph.positions[node as usize]);
    let [at_a, at_b, at_c] = phases.corners.map(f64::from);
    let normal = (b - a).cross(c - a);
    let slope = (c - a).cross(normal) * (at_b - at_a) + normal.cross(b - a) * (at_c - at_a);
    slope / normal.length_squared().max(1e-300)
}

/// The phases of one field, counted alike on both sides of every edge but those where lines that end leave no way to.
/// `neighbours` are those of the mesh, edge k from corner k to the next.
pub(super) fn agreed(graph: &Graph, neighbours: &[[u32; 3]], phases: &[StripePhases]) -> Vec<StripePhases> {
    let edges = Edges::new(graph, phases);
    let mut counts: Vec<Option<Count>> = vec![None; phases.len()];
    let mut queue = VecDeque::new();
    // Where lines end or the field is singular the walk does not pass through.
    let linear = (0..phases.len()).filter(|triangle| phases[*triangle].is_linear());
    for start in linear.chain(0..phases.len()) {
        if counts[start].is_some() {
            continue;
        }
        counts[start] = Some(Count::default());
        queue.push_back(start as u32);
        while let Some(here) = queue.pop_front() {
            let Some(count) = counts[here as usize] else { continue };
            for (side, there) in neighbours[here as usize].iter().enumerate() {
                if *there == NO_FACE || counts[*there as usize].is_some() {
                    continue;
                }
                if let Some(next) = edges.beyond([here, *there], side, count) {
                    counts[*there as usize] = Some(next);
                    if phases[*there as usize].is_linear() {
                        queue.push_back(*there);
                    }
                }
            }
        }
    }
    let counted = |(phases, count): (&StripePhases, Option<Count>)| {
        let count = count.unwrap_or_default();
        let least = phases.corners.map(|phase| count.phase(f64::from(phase))).into_iter().fold(f64::INFINITY, f64::min);
        let whole = f64::from(PERIOD) * (least / f64::from(PERIOD)).floor();
        phases.recounted(count.turned, (count.number - whole) as i32)
    };
    phases.par_iter().zip(counts).map(counted).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::prepare;
    use crate::mesh::sample::Sample;
    use crate::surface::{StripeOptions, Surface, SurfaceOptions};

    #[test]
    fn phases_are_the_same_on_both_sides_of_nearly_all_edges() {
        for (sample, most) in [(Sample::Torus, 0.03), (Sample::Hand, 0.04), (Sample::Head, 0.04)] {
            let mesh = prepare(sample.build(8_000)).expect("a sample").mesh;
            let options = SurfaceOptions { stripes: Some(StripeOptions::default()), ..SurfaceOptions::default() };
            let surface = Surface::new(&mesh, &options).expect("a surface");
            let stripes = surface.stripes.expect("stripes were asked for");
            for phases in [&stripes.along, &stripes.across] {
                assert!(phases.iter().flat_map(|own| own.corners).all(|phase| phase.abs() < 200.0));
                let edges = Edges::new(&surface.graph, phases);
                let (mut all, mut apart) = (0, 0);
                for (here, others) in mesh.neighbours.iter().enumerate() {
                    for (side, there) in others.iter().enumerate().filter(|(_, there)| **there != NO_FACE) {
                        let pair = [here as u32, *there];
                        let Some(count) = edges.beyond(pair, side, Count::default()) else { continue };
                        all += 1;
                        apart += usize::from(count != Count::default());
                    }
                }
                assert!(all > 20_000 && apart as f64 <= most * f64::from(all), "{}: {apart} of {all}", sample.name());
            }
        }
    }
}
