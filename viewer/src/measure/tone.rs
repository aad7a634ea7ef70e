//! Tone reproduction: whether the ink, seen from afar, is as dark as the light asks for.

use std::fmt;

use super::aov::Aov;
use super::blur::MaskedBlur;
use super::plane::{Plane, lightness};

/// A distribution of errors.
#[derive(Clone, Copy, Debug, Default, PartialEq, serde::Serialize)]
pub struct Errors {
    /// Mean error, with its sign.
    pub bias: f64,
    /// Root mean square error.
    pub rmse: f64,
    /// 95th percentile of the absolute error.
    pub percentile_95: f64,
}

/// Errors of tone over the pixels of a view.
#[derive(Clone, Copy, Debug, PartialEq, serde::Serialize)]
pub struct Tone {
    /// In L*, 0 ..= 100: drawn less wanted; positive is too light.
    pub lightness: Errors,
    /// In linear ink, 0 ..= 1: drawn less wanted; positive is too dark.
    pub ink: Errors,
    /// Least and greatest ink wanted, as means over the window.
    pub wanted_ink: [f64; 2],
    /// Least and greatest ink drawn, likewise: the tones that are reached.
    pub drawn_ink: [f64; 2],
}

/// Compares local means of the drawn ink with the wanted darkness: e = L*(G * H) - L*(G * Y), G a Gaussian of `sigma_px`
/// normalised inside the silhouette, H and Y the drawn and the wanted luminance, 1 - ink. METRICS asks for a σ of two
/// stroke periods at least.
///
/// Exact but for the cut of G at 4 σ. Y is taken at the middle of each pixel. What remains for a perfect method is the
/// grain of its map, which a flat quad shows. None where the mesh is not seen.
pub fn tone(ink: &Plane, aov: &Aov, sigma_px: f64) -> Option<Tone> {
    let covered = aov.covered();
    let wanted: Vec<f64> = aov.pixels.iter().map(|pixel| pixel.as_ref().map_or(0.0, |at| at.darkness)).collect();
    let blur = MaskedBlur::new(aov.size, &covered, sigma_px);
    let inside = |plane: Vec<f64>| plane.into_iter().zip(&covered).filter(|(_, inside)| **inside).map(|(ink, _)| ink);
    let drawn: Vec<f64> = inside(blur.apply(&ink.pixels)).collect();
    let wanted: Vec<f64> = inside(blur.apply(&wanted)).collect();
    let pairs = || drawn.iter().zip(&wanted);
    Some(Tone {
        lightness: Errors::of(pairs().map(|(drawn, wanted)| lightness(1.0 - drawn) - lightness(1.0 - wanted)))?,
        ink: Errors::of(pairs().map(|(drawn, wanted)| drawn - wanted))?,
        wanted_ink: range(&wanted),
        drawn_ink: range(&drawn),
    })
}

impl Errors {
    /// Bias, root mean square and 95th percentile; none of no errors.
    pub fn of(errors: impl Iterator<Item = f64>) -> Option<Self> {
        let mut errors: Vec<f64> = errors.collect();
        let count = errors.len() as f64;
        let bias = errors.iter().sum::<f64>() / count;
        let rmse = (errors.iter().map(|error| error * error).sum::<f64>() / count).sqrt();
        errors.iter_mut().for_each(|error| *error = error.abs());
        errors.sort_by(f64::total_cmp);
        let percentile_95 = *errors.get((0.95 * (count - 1.0)).round() as usize)?;
        Some(Self { bias, rmse, percentile_95 })
    }
}

fn range(values: &[f64]) -> [f64; 2] {
    values.iter().fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], value| [low.min(*value), high.max(*value)])
}

impl fmt::Display for Tone {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let (l, i) = (&self.lightness, &self.ink);
        write!(
            f,
            "tone L* bias {:+.2}, RMSE {:.2}, 95 % below {:.2}; ink bias {:+.4}, RMSE {:.4}; \
             wanted {:.3} to {:.3}, drawn {:.3} to {:.3}",
            l.bias,
            l.rmse,
            l.percentile_95,
            i.bias,
            i.rmse,
            self.wanted_ink[0],
            self.wanted_ink[1],
            self.drawn_ink[0],
            self.drawn_ink[1]
        )
    }
}

#[cfg(test)]
mod tests {
    use super::super::aov::Surface;
    use super::super::testing::{Grating, ramp_aov};
    use super::*;

    #[test]
    fn a_grating_that_widens_with_the_darkness_has_the_tone() {
        let aov = ramp_aov([240, 160], 0.15, 0.6);
        let period_px = 5.0;
        let grating = Grating { angle_rad: 0.4, period_px, ..Grating::default() };
        let ink = grating.drawn_on(&aov);
        let found = tone(&ink, &aov, 2.5 * period_px).expect("it is seen");
        assert!(found.ink.rmse < 4e-3 && found.ink.bias.abs() < 1e-3, "{found}");
        assert!(found.lightness.rmse < 0.4 && found.lightness.bias.abs() < 0.1, "{found}");
        assert!((found.drawn_ink[0] - found.wanted_ink[0]).abs() < 0.02, "{found}");
    }

    #[test]
    fn controls_too_light_and_without_regard_to_light_are_told() {
        let aov = ramp_aov([240, 160], 0.15, 0.6);
        let light = Plane { size: aov.size, pixels: aov.pixels.iter().flatten().map(|at| at.darkness - 0.1).collect() };
        let found = tone(&light, &aov, 12.0).expect("it is seen");
        assert!((found.ink.bias + 0.1).abs() < 1e-9 && (found.ink.rmse - 0.1).abs() < 1e-9, "{found}");
        assert!(found.lightness.bias > 4.0, "{found}");
        let even = Plane { size: aov.size, pixels: vec![0.375; light.pixels.len()] };
        let found = tone(&even, &aov, 12.0).expect("it is seen");
        // The right mean, and wrong everywhere: a ramp of 0.45 has a deviation of 0.45 / √12, less at the ends.
        assert!(found.ink.bias.abs() < 2e-3 && (found.ink.rmse - 0.13).abs() < 0.015, "{found}");
        assert!(found.lightness.rmse > 6.0 && found.lightness.percentile_95 > 10.0, "{found}");
    }

    /// Six nested columns, each weighted by how near its tone is to the wanted one; weights that are not clamped at 0 take
    /// ink away again.
    #[test]
    fn weights_that_are_not_clamped_are_told() {
        let aov = ramp_aov([240, 160], 0.15, 0.6);
        let grating = Grating { angle_rad: 0.4, period_px: 5.0, ..Grating::default() };
        let columns: Vec<Plane> =
            (1..=6).map(|k| grating.drawn_on(&ramp_aov(aov.size, f64::from(k) / 6.0, f64::from(k) / 6.0))).collect();
        let drawn = |least: f64| {
            let ink = |(pixel, at): (usize, &Option<Surface>)| {
                let wanted = at.as_ref().map_or(0.0, |at| 6.0 * at.darkness);
                let weight = |k: usize| (1.0 - (wanted - (k + 1) as f64).abs()).max(least);
                columns.iter().enumerate().map(|(k, column)| weight(k) * column.pixels[pixel]).sum::<f64>()
            };
            let pixels = aov.pixels.iter().enumerate().map(ink).map(|ink| ink.clamp(0.0, 1.0)).collect();
            tone(&Plane { size: aov.size, pixels }, &aov, 12.5).expect("it is seen")
        };
        let clamped = drawn(0.0);
        assert!(clamped.ink.rmse < 4e-3, "{clamped}");
        let loose = drawn(f64::NEG_INFINITY);
        assert!(loose.ink.rmse > 0.1 && loose.lightness.rmse > 10.0, "{loose}");
    }

    #[test]
    fn nothing_seen_has_no_tone() {
        let aov = Aov { size: [4, 4], pixels: vec![None; 16] };
        assert_eq!(tone(&Plane::from_fn([4, 4], |_, _| 1.0), &aov, 2.0), None);
    }
}
