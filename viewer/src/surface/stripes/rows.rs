//! Rows of lines on patches: in each triangle the phase is known up to sign and whole numbers; within a patch they are
//! chosen so that one line has one number from end to end.
//!
//! Each patch is walked over its triangles, breadth first from its seed. Across an edge, gradients tell the sign and the
//! phases of its middle the number. Where lines end or the field is singular there is no such numbering: a triangle
//! takes the nearest number, and the walk does not pass through it.

use std::collections::VecDeque;

use glam::DVec3;
use rayon::prelude::*;
use tam_shaders::cpu::lib::stripes::stripe_phase;
use tam_shaders::types::{NO_FACE, StripePhases};

use super::Stripes;
use crate::surface::graph::Graph;
use crate::surface::patches::Patches;

/// Greatest number of a row that 15 bits hold.
const GREATEST: f64 = 16_383.0;

/// How a triangle's phase becomes that of a patch: `sign * phase + number`.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct Row {
    /// Whether the sign is -1.
    pub(crate) turned: bool,
    /// Whole.
    pub(crate) number: f64,
}

impl Row {
    fn sign(self) -> f64 {
        if self.turned { -1.0 } else { 1.0 }
    }

    /// The phase of the patch.
    pub(crate) fn phase(self, of_triangle: f64) -> f64 {
        self.sign() * of_triangle + self.number
    }

    /// 16 bits: the sign in the lowest.
    fn packed(self) -> u32 {
        let number = self.number.clamp(-GREATEST, GREATEST) as i32;
        ((number << 1 | i32::from(self.turned)) & 0xffff) as u32
    }
}

/// A triangle in a patch, and which of all entries says so.
type Place = (u32, u32);

/// Per entry of the patches: the rows along in the low 16 bits, those across above.
///
/// `neighbours` are those of the mesh, edge k from corner k to the next.
pub(crate) fn rows(graph: &Graph, neighbours: &[[u32; 3]], patches: &Patches, stripes: &Stripes) -> Vec<u32> {
    let along = rows_of(graph, neighbours, patches, &stripes.along);
    let across = rows_of(graph, neighbours, patches, &stripes.across);
    along.iter().zip(&across).map(|(along, across)| along.packed() | across.packed() << 16).collect()
}

/// The rows of one field, per entry.
pub(crate) fn rows_of(graph: &Graph, neighbours: &[[u32; 3]], patches: &Patches, phases: &[StripePhases]) -> Vec<Row> {
    let mut of_entries = vec![Row::default(); patches.entries.len()];
    if phases.is_empty() {
        return of_entries;
    }
    let mut of_seeds: Vec<Vec<Place>> = vec![Vec::new(); patches.seeds.len()];
    for triangle in 0..graph.triangles.len() {
        let first = patches.starts[triangle];
        for (i, entry) in patches.of(triangle).iter().enumerate() {
            if let Some(places) = of_seeds.get_mut(entry.seed as usize) {
                places.push((triangle as u32, first + i as u32));
            }
        }
    }
    let walked: Vec<Vec<Row>> = of_seeds
        .par_iter()
        .zip(&patches.seeds)
        .map(|(places, seed)| walk(graph, neighbours, phases, places, seed.node))
        .collect();
    for (places, rows) in of_seeds.iter().zip(walked) {
        for ((_, entry), row) in places.iter().zip(rows) {
            of_entries[*entry as usize] = row;
        }
    }
    of_entries
}

/// The rows of one patch; its triangles are sorted.
fn walk(graph: &Graph, neighbours: &[[u32; 3]], phases: &[StripePhases], places: &[Place], seed: u32) -> Vec<Row> {
    let mut rows: Vec<Option<Row>> = vec![None; places.len()];
    let plain = |place: &Place| phases[place.0 as usize].code == 0;
    let at_seed = |place: &Place| plain(place) && graph.triangles[place.0 as usize].contains(&seed);
    // Parts of a patch that its seed does not reach start anew.
    let starts = places.iter().position(at_seed).into_iter().chain(0..places.len());
    let mut queue = VecDeque::new();
    for start in starts {
        if rows[start].is_some() {
            continue;
        }
        rows[start] = Some(Row::default());
        queue.push_back(start);
        while let Some(here) = queue.pop_front() {
            let (triangle, _) = places[here];
            let Some(row) = rows[here] else { continue };
            for (side, other) in neighbours[triangle as usize].iter().enumerate() {
                let Ok(there) = places.binary_search_by_key(other, |place| place.0) else { continue };
                if *other == NO_FACE || rows[there].is_some() {
                    continue;
                }
                if let Some(next) = across_edge(graph, phases, [triangle, *other], side, row) {
                    rows[there] = Some(next);
                    if plain(&places[there]) {
                        queue.push_back(there);
                    }
                }
            }
        }
    }
    rows.into_iter().map(Option::unwrap_or_default).collect()
}

/// The row beyond side `side` of the first of two triangles; none over a hard edge.
fn across_edge(graph: &Graph, phases: &[StripePhases], [here, there]: [u32; 2], side: usize, row: Row) -> Option<Row> {
    let (here, there) = (here as usize, there as usize);
    let ends = [graph.triangles[here][side], graph.triangles[here][(side + 1) % 3]];
    let opposite = (0..3).find(|k| !ends.contains(&graph.triangles[there][*k]))?;
    if !ends.iter().all(|end| graph.triangles[there].contains(end)) {
        return None;
    }
    let middle = |triangle: usize, opposite: usize| {
        let mut weights = [0.5; 3];
        weights[opposite] = 0.0;
        stripe_phase(&phases[triangle], weights.into())
    };
    let slope = gradient(graph, phases, here).dot(gradient(graph, phases, there));
    let turned = row.turned != (slope < 0.0);
    let next = Row { turned, number: 0.0 };
    let number = row.phase(middle(here, (side + 2) % 3)) - next.phase(middle(there, opposite));
    Some(Row { number: number.round(), ..next })
}

/// Gradient of the phase between the corners, in lines per mesh unit.
fn gradient(graph: &Graph, phases: &[StripePhases], triangle: usize) -> DVec3 {
    let [a, b, c] = graph.triangles[triangle].map(|node| graph.positions[node as usize]);
    let [at_a, at_b, at_c] = phases[triangle].corners.map(f64::from);
    let normal = (b - a).cross(c - a);
    let slope = (c - a).cross(normal) * (at_b - at_a) + normal.cross(b - a) * (at_c - at_a);
    slope / normal.length_squared().max(1e-300)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::prepare;
    use crate::mesh::sample::Sample;
    use crate::surface::{PatchOptions, StripeOptions, Surface, SurfaceOptions};

    #[test]
    fn a_line_has_one_number_all_over_a_patch() {
        for (sample, most) in [(Sample::Torus, 0.0), (Sample::Hand, 0.004), (Sample::Head, 0.004)] {
            let mesh = prepare(sample.build(8_000)).expect("a sample").mesh;
            let options = SurfaceOptions {
                patches: Some(PatchOptions::default()),
                stripes: Some(StripeOptions::default()),
                ..SurfaceOptions::default()
            };
            let surface = Surface::new(&mesh, &options).expect("a surface");
            let (patches, stripes) = (surface.patches.expect("patches"), surface.stripes.expect("stripes"));
            let rows = rows_of(&surface.graph, &mesh.neighbours, &patches, &stripes.along);
            let of = |triangle: u32, seed: u32| {
                let at = patches.of(triangle as usize).iter().position(|entry| entry.seed == seed)?;
                Some(rows[patches.starts[triangle as usize] as usize + at])
            };
            let (mut edges, mut breaks) = (0, 0);
            for (triangle, others) in mesh.neighbours.iter().enumerate() {
                for (side, other) in others.iter().enumerate().filter(|(_, other)| **other != NO_FACE) {
                    for entry in patches.of(triangle).iter().filter(|entry| entry.seed != u32::MAX) {
                        let pair = [triangle as u32, *other];
                        let (Some(here), Some(there)) = (of(pair[0], entry.seed), of(*other, entry.seed)) else {
                            continue;
                        };
                        let Some(expected) = across_edge(&surface.graph, &stripes.along, pair, side, here) else {
                            continue;
                        };
                        edges += 1;
                        breaks += usize::from(expected != there);
                    }
                }
            }
            assert!(edges > 20_000 && breaks as f64 <= most * f64::from(edges), "{breaks} of {edges}");
        }
    }

    #[test]
    fn codes_hold_sign_and_number() {
        for (turned, number) in [(false, 0.0), (true, 0.0), (true, -7.0), (false, 900.0), (true, -16_383.0)] {
            let code = Row { turned, number }.packed();
            for field in [0, 1] {
                let [sign, found] = tam_shaders::cpu::lib::strokes::entry_row(&[code << (16 * field)], 0, field);
                assert_eq!((sign < 0, f64::from(found)), (turned, number));
            }
        }
    }
}
