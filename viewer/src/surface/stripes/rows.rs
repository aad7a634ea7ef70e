//! Rows of lines on patches: in each triangle the phase is known up to sign and whole numbers; within a patch they are
//! chosen so that one line has one number from end to end.
//!
//! Each patch is walked over its triangles, breadth first from its seed. Where lines end or the field is singular there is no
//! such numbering: a triangle takes the nearest number, and the walk does not pass through it.

use std::collections::VecDeque;

use rayon::prelude::*;
use tam_shaders::types::NO_FACE;

use super::agree::{Count, Edges};
use super::{StripePhases, Stripes};
use crate::surface::graph::Graph;
use crate::surface::patches::Patches;

/// Greatest number of a row that 15 bits hold.
const GREATEST: f64 = 16_383.0;

/// How a triangle's phase becomes that of a patch, in 16 bits: the sign in the lowest.
fn packed(count: Count) -> u32 {
    let number = count.number.clamp(-GREATEST, GREATEST) as i32;
    ((number << 1 | i32::from(count.turned)) & 0xffff) as u32
}

/// A triangle in a patch, and which of all entries says so.
type Place = (u32, u32);

/// Per entry of the patches: the rows along in the low 16 bits, those across above.
///
/// `neighbours` are those of the mesh, edge k from corner k to the next.
pub(crate) fn rows(graph: &Graph, neighbours: &[[u32; 3]], patches: &Patches, stripes: &Stripes) -> Vec<u32> {
    let along = rows_of(graph, neighbours, patches, &stripes.along);
    let across = rows_of(graph, neighbours, patches, &stripes.across);
    along.iter().zip(&across).map(|(along, across)| packed(*along) | packed(*across) << 16).collect()
}

/// The rows of one field, per entry.
pub(crate) fn rows_of(
    graph: &Graph,
    neighbours: &[[u32; 3]],
    patches: &Patches,
    phases: &[StripePhases],
) -> Vec<Count> {
    let mut of_entries = vec![Count::default(); patches.entries.len()];
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
    let edges = Edges::new(graph, phases);
    let walked: Vec<Vec<Count>> = of_seeds
        .par_iter()
        .zip(&patches.seeds)
        .map(|(places, seed)| walk(&edges, neighbours, places, seed.node))
        .collect();
    for (places, rows) in of_seeds.iter().zip(walked) {
        for ((_, entry), row) in places.iter().zip(rows) {
            of_entries[*entry as usize] = row;
        }
    }
    of_entries
}

/// The rows of one patch; its triangles are sorted.
fn walk(edges: &Edges<'_>, neighbours: &[[u32; 3]], places: &[Place], seed: u32) -> Vec<Count> {
    let mut rows: Vec<Option<Count>> = vec![None; places.len()];
    let plain = |place: &Place| edges.phases[place.0 as usize].is_linear();
    let at_seed = |place: &Place| plain(place) && edges.graph.triangles[place.0 as usize].contains(&seed);
    // Parts of a patch that its seed does not reach start anew.
    let starts = places.iter().position(at_seed).into_iter().chain(0..places.len());
    let mut queue = VecDeque::new();
    for start in starts {
        if rows[start].is_some() {
            continue;
        }
        rows[start] = Some(Count::default());
        queue.push_back(start);
        while let Some(here) = queue.pop_front() {
            let (triangle, _) = places[here];
            let Some(row) = rows[here] else { continue };
            for (side, other) in neighbours[triangle as usize].iter().enumerate() {
                let Ok(there) = places.binary_search_by_key(other, |place| place.0) else { continue };
                if *other == NO_FACE || rows[there].is_some() {
                    continue;
                }
                if let Some(next) = edges.beyond([triangle, *other], side, row) {
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
            let edges = Edges::new(&surface.graph, &stripes.along);
            let (mut crossed, mut breaks) = (0, 0);
            for (triangle, others) in mesh.neighbours.iter().enumerate() {
                for (side, other) in others.iter().enumerate().filter(|(_, other)| **other != NO_FACE) {
                    for entry in patches.of(triangle).iter().filter(|entry| entry.seed != u32::MAX) {
                        let pair = [triangle as u32, *other];
                        let (Some(here), Some(there)) = (of(pair[0], entry.seed), of(*other, entry.seed)) else {
                            continue;
                        };
                        let Some(expected) = edges.beyond(pair, side, here) else {
                            continue;
                        };
                        crossed += 1;
                        breaks += usize::from(expected != there);
                    }
                }
            }
            assert!(crossed > 20_000 && breaks as f64 <= most * f64::from(crossed), "{breaks} of {crossed}");
        }
    }

    #[test]
    fn codes_hold_sign_and_number() {
        for (turned, number) in [(false, 0.0), (true, 0.0), (true, -7.0), (false, 900.0), (true, -16_383.0)] {
            let code = packed(Count { turned, number });
            for field in [0, 1] {
                let [sign, found] = tam_shaders::cpu::lib::strokes::patch_row(code << (16 * field), field);
                assert_eq!((sign < 0, f64::from(found)), (turned, number));
            }
        }
    }
}
