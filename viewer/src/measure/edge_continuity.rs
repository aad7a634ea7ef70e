//! Edge continuity: whether strokes cross the edges of the mesh unharmed.

use std::fmt;

use super::aov::Aov;
use super::direction::INKED;
use super::plane::Plane;

/// How often the ink changes between neighbouring pixels.
#[derive(Clone, Copy, Debug, PartialEq, serde::Serialize)]
pub struct EdgeContinuity {
    /// Changes across edges over changes inside faces: 1 where edges do not show. None where there are no pairs of
    /// either kind, or no changes inside faces.
    pub ratio: Option<f64>,
    /// Share of the pairs across an edge of which one pixel is inked and one is not, 0 ..= 1.
    pub across: f64,
    /// The same of pairs inside a face.
    pub inside: f64,
    /// Pairs across edges.
    pub across_pairs: usize,
}

/// P(pixels differ across a mesh edge) / P(pixels differ inside faces), over pairs of neighbours in rows and columns that
/// are inked (≥ 0.5) or not. Contours and hard edges are left out. Faces should be wider than some pixels: of smaller ones
/// the pairs across edges are all there are.
pub fn edge_continuity(ink: &Plane, aov: &Aov) -> EdgeContinuity {
    let [width, height] = aov.size.map(|side| side as usize);
    // Pairs and changes, inside faces and across edges.
    let (mut pairs, mut changes) = ([0_usize; 2], [0_usize; 2]);
    for i in 0..aov.pixels.len() {
        let right = (i % width + 1 < width).then_some(i + 1);
        let below = (i / width + 1 < height).then_some(i + width);
        for j in [right, below].into_iter().flatten().filter(|j| aov.joined(i, *j)) {
            let face = |i: usize| aov.pixels[i].as_ref().map(|surface| surface.face);
            let across = usize::from(face(i) != face(j));
            pairs[across] += 1;
            changes[across] += usize::from((ink.pixels[i] >= INKED) != (ink.pixels[j] >= INKED));
        }
    }
    let [inside, across] = [0, 1].map(|kind| changes[kind] as f64 / pairs[kind].max(1) as f64);
    let comparable = pairs[1] > 0 && changes[0] > 0;
    EdgeContinuity { ratio: comparable.then(|| across / inside), across, inside, across_pairs: pairs[1] }
}

impl fmt::Display for EdgeContinuity {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self.ratio {
            Some(ratio) => {
                write!(f, "ink changes {ratio:.2} times as often across edges ({} pairs)", self.across_pairs)
            }
            None => write!(f, "no edges to compare"),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::super::testing::{Grating, flat_aov};
    use super::*;

    #[test]
    fn strokes_that_cross_edges_have_one_and_strokes_cut_there_more() {
        let mut aov = flat_aov([200, 200], 0.4, 0.4);
        for (i, surface) in aov.pixels.iter_mut().flatten().enumerate() {
            surface.face = ((i % 200) / 20 + 11 * (i / 200 / 20)) as u32;
        }
        let grating = Grating { angle_rad: 0.4, period_px: 7.0, shift: 0.0 };
        let whole = grating.drawn_on(&aov);
        let found = edge_continuity(&whole, &aov);
        assert!((found.ratio.expect("edges") - 1.0).abs() < 0.1, "{found}");
        // Every face by itself.
        let pieces: Vec<Plane> =
            (0..5).map(|k| Grating { shift: 0.37 * f64::from(k), ..grating }.drawn_on(&aov)).collect();
        let piece = |(i, surface): (usize, &Option<super::super::Surface>)| {
            surface.as_ref().map_or(0.0, |surface| pieces[surface.face as usize * 3 % 5].pixels[i])
        };
        let cut = Plane { size: aov.size, pixels: aov.pixels.iter().enumerate().map(piece).collect() };
        let found = edge_continuity(&cut, &aov);
        assert!(found.ratio.expect("edges") > 1.5, "{found}");
    }

    #[test]
    fn without_edges_or_ink_there_is_no_ratio() {
        let aov = flat_aov([20, 20], 0.0, 0.4);
        assert_eq!(edge_continuity(&Plane::from_fn(aov.size, |x, _| f64::from(x % 2)), &aov).ratio, None);
    }
}
