//! What has been painted on each triangle, and which triangles are covered.

use glam::DVec2;

use super::grow::Patch;
use crate::surface::patches::{Entry, MAX_ENTRIES};

/// Steps along each side in which the cover of a triangle is looked at.
const STEPS: usize = 4;

/// A place counts as covered where less than this shows through.
const GREATEST_GAP: f64 = 1.0 / 64.0;

/// The paint on all triangles.
pub(super) struct Cover {
    /// Per triangle, in the order of painting.
    painted: Vec<Vec<Entry>>,
    covered: Vec<bool>,
}

impl Cover {
    pub(super) fn new(triangles: usize) -> Self {
        Self { painted: vec![Vec::new(); triangles], covered: vec![false; triangles] }
    }

    /// What has been painted on a triangle, in the order of painting, without what is hidden under later paint.
    #[cfg(test)]
    pub(super) fn of(&self, triangle: usize) -> &[Entry] {
        &self.painted[triangle]
    }

    pub(super) fn is_covered(&self, triangle: usize) -> bool {
        self.covered[triangle]
    }

    /// Paints a patch over what is there.
    pub(super) fn paste(&mut self, seed: u32, patch: &Patch, alphas: &[f64], offset_uv: DVec2) {
        for member in &patch.members {
            let behind = member.nodes.map(|node| alphas[node as usize] as f32);
            if behind == [0.0; 3] {
                continue;
            }
            let uv = member.nodes.map(|node| (patch.places[node as usize] + offset_uv).as_vec2());
            let painted = &mut self.painted[member.face as usize];
            if behind == [1.0; 3] {
                painted.clear();
            }
            painted.push(Entry { seed, uv, behind });
            let covered = &mut self.covered[member.face as usize];
            *covered = *covered || gap(painted) < GREATEST_GAP;
        }
    }

    /// Per triangle the first of its entries, and after the last their number; and the entries. Of too many on one
    /// triangle the last painted stay. The first is opaque everywhere: where a triangle is covered, what shows through
    /// the first does not show.
    pub(super) fn finish(self) -> (Vec<u32>, Vec<Entry>) {
        let mut starts = Vec::with_capacity(self.painted.len() + 1);
        let mut entries = Vec::with_capacity(self.painted.iter().map(Vec::len).sum());
        starts.push(0);
        for painted in self.painted {
            let kept = entries.len();
            let dropped = painted.len().saturating_sub(MAX_ENTRIES);
            entries.extend(painted.into_iter().skip(dropped));
            if let Some(first) = entries.get_mut(kept) {
                first.behind = [1.0; 3];
            }
            starts.push(entries.len() as u32);
        }
        (starts, entries)
    }
}

/// The greatest share of a triangle's ground that shows through at a place.
fn gap(painted: &[Entry]) -> f64 {
    let mut greatest = 0.0_f64;
    for i in 0..=STEPS {
        for j in 0..=STEPS - i {
            let corners = [i, j, STEPS - i - j].map(|steps| steps as f64 / STEPS as f64);
            let alpha = |entry: &Entry| (0..3).map(|k| corners[k] * f64::from(entry.behind[k])).sum::<f64>();
            greatest = greatest.max(painted.iter().map(|entry| 1.0 - alpha(entry)).product());
        }
    }
    greatest
}
