//! Greyness: how much of the ink is neither ink nor paper. Crisp strokes are grey at their edges only; blending makes
//! all of a stroke grey.

use std::fmt;

use super::aov::Aov;
use super::plane::Plane;

/// Coverage from which on a pixel holds ink, and up to which it is grey.
const GREY: std::ops::RangeInclusive<f64> = 0.2..=0.8;

/// Greyness of a picture.
#[derive(Clone, Copy, Debug, PartialEq, serde::Serialize)]
pub struct Greyness {
    /// Share of the inked pixels that are grey, 0 ..= 1; 0 where nothing is inked.
    pub share: f64,
    /// Pixels with ink: coverage ≥ 0.2.
    pub inked: usize,
}

/// The share of pixels between 0.2 and 0.8 coverage among those of at least 0.2, where the mesh is seen. To be read
/// beside that of the map itself, [`greyness_of`], at the level it is drawn at: thin strokes are mostly edge.
pub fn greyness(ink: &Plane, aov: &Aov) -> Greyness {
    greyness_of(ink.pixels.iter().zip(&aov.pixels).filter(|(_, surface)| surface.is_some()).map(|(ink, _)| *ink))
}

/// The same of any coverages, 0 ..= 1.
pub fn greyness_of(coverages: impl Iterator<Item = f64>) -> Greyness {
    let (mut grey, mut inked) = (0_usize, 0_usize);
    for coverage in coverages.filter(|coverage| coverage >= GREY.start()) {
        inked += 1;
        grey += usize::from(coverage <= *GREY.end());
    }
    Greyness { share: grey as f64 / inked.max(1) as f64, inked }
}

impl fmt::Display for Greyness {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{:.0} % of the ink is grey", 100.0 * self.share)
    }
}

#[cfg(test)]
mod tests {
    use super::super::testing::{Grating, flat_aov};
    use super::*;

    #[test]
    fn strokes_are_grey_at_their_edges_and_blended_ones_all_over() {
        let aov = flat_aov([120, 120], 0.3, 0.4);
        let grating = Grating { angle_rad: 0.3, period_px: 20.0, ..Grating::default() };
        let crisp = grating.drawn_on(&aov);
        // Of 8 px of ink, about 1.2 at each edge are anti-aliased, half of them between the limits.
        let share = greyness(&crisp, &aov).share;
        assert!(share > 0.05 && share < 0.25, "{share}");
        let other = Grating { shift: 0.5, ..grating }.drawn_on(&aov);
        let mixed = crisp.pixels.iter().zip(&other.pixels).map(|(a, b)| 0.5 * (a + b)).collect();
        let share = greyness(&Plane { size: aov.size, pixels: mixed }, &aov).share;
        assert!(share > 0.9, "{share}");
    }

    #[test]
    fn what_is_not_the_mesh_does_not_count() {
        let mut aov = flat_aov([4, 1], 0.0, 0.5);
        aov.pixels[3] = None;
        let ink = Plane { size: [4, 1], pixels: vec![0.1, 0.5, 0.9, 0.5] };
        assert_eq!(greyness(&ink, &aov), Greyness { share: 0.5, inked: 2 });
    }
}
