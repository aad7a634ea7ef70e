//! The tones of the columns, and how the tone of an image is measured.

use serde::{Deserialize, Serialize};

/// The tones of a map: how many, or which.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, schemars::JsonSchema)]
#[serde(untagged, expecting = "a count of tones (6), or a list of tones, lightest first ([0.1, 0.25, 0.5])")]
pub enum Tones {
    /// So many tones, evenly spaced between paper and solid ink without either: `(k + 1) / (count + 1)`.
    Count(#[schemars(range(min = 1, max = 64))] u32),
    /// The tones themselves: darkness in `(0, 1]`, rising.
    List(#[schemars(length(min = 1, max = 64), inner(range(min = 0.001, max = 1)))] Vec<f64>),
}

impl Default for Tones {
    /// Six tones, as in Praun and others (2001) and its student implementation.
    fn default() -> Self {
        Self::Count(6)
    }
}

impl Tones {
    /// The darkness of every column, lightest first.
    pub fn list(&self) -> Vec<f64> {
        match self {
            Self::Count(count) => (1..=*count).map(|k| f64::from(k) / f64::from(count + 1)).collect(),
            Self::List(list) => list.clone(),
        }
    }

    /// The number of columns.
    pub fn count(&self) -> usize {
        match self {
            Self::Count(count) => *count as usize,
            Self::List(list) => list.len(),
        }
    }
}

/// The measures of tone that a preset can name.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Hash, Serialize, Deserialize, schemars::JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum MeasureName {
    /// Mean ink coverage, in linear light.
    #[default]
    MeanCoverage,
    /// Share of texels that are not paper white, as in the student implementation of Praun's paper.
    NonPaper,
}

/// How much tone a texel of given ink counts: a measure of tone that is a mean over texels.
///
/// A library user with another idea of darkness supplies one with [`ToneMeasure::new`] and passes it in
/// [`crate::Job::measure`].
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct ToneMeasure {
    weight_of_ink: [u32; 256],
    /// The weight of every step of ink, if all weigh the same.
    per_ink: Option<u32>,
}

impl ToneMeasure {
    /// Weight of a texel of solid ink; weights are whole numbers, so that sums are exact.
    pub const SOLID: u32 = 255 * 256;

    /// A measure from the darkness that a texel of a given coverage (0 ..= 1) counts as.
    ///
    /// The function is taken to start at 0, to end at 1 and never to fall; what leaves this is clamped to it.
    pub fn new(darkness_of_coverage: impl Fn(f64) -> f64) -> Self {
        let mut weight_of_ink = [0; 256];
        for ink in 1..256 {
            let darkness = darkness_of_coverage(ink as f64 / 255.0).clamp(0.0, 1.0);
            let weight = if darkness.is_nan() { 0 } else { (darkness * f64::from(Self::SOLID)).round() as u32 };
            weight_of_ink[ink] = weight.max(weight_of_ink[ink - 1]);
        }
        weight_of_ink[255] = Self::SOLID;
        let per_ink = weight_of_ink[1];
        let even = (0..).zip(&weight_of_ink).all(|(ink, weight)| *weight == per_ink * ink);
        Self { weight_of_ink, per_ink: even.then_some(per_ink) }
    }

    /// One of the measures that a preset can name.
    pub fn named(name: MeasureName) -> Self {
        match name {
            MeasureName::MeanCoverage => Self::new(|coverage| coverage),
            MeasureName::NonPaper => Self::new(|coverage| if coverage > 0.0 { 1.0 } else { 0.0 }),
        }
    }

    /// The weight of a texel of the given ink, `0 ..= SOLID`.
    #[inline]
    pub fn weight(&self, ink: u8) -> u32 {
        self.weight_of_ink[usize::from(ink)]
    }

    /// What texels weigh more when each has gone from one ink to another that is no less.
    #[inline]
    pub(crate) fn gain(&self, inks: impl Iterator<Item = (u8, u8)>) -> u64 {
        match self.per_ink {
            Some(per_ink) => {
                u64::from(per_ink) * u64::from(inks.map(|(before, after)| u32::from(after - before)).sum::<u32>())
            }
            None => inks.map(|(before, after)| u64::from(self.weight(after) - self.weight(before))).sum(),
        }
    }

    /// The tone of an image of ink, `0.0 ..= 1.0`.
    pub fn tone(&self, ink: &[u8]) -> f64 {
        let sum: u64 = match self.per_ink {
            // A thousand texels at a time, in 32 bits, which is several times as fast.
            Some(per_ink) => ink
                .chunks(1024)
                .map(|some| u64::from(per_ink) * u64::from(some.iter().map(|&ink| u32::from(ink)).sum::<u32>()))
                .sum(),
            None => ink.iter().map(|&ink| u64::from(self.weight(ink))).sum(),
        };
        sum as f64 / (f64::from(Self::SOLID) * ink.len().max(1) as f64)
    }
}

impl Default for ToneMeasure {
    fn default() -> Self {
        Self::named(MeasureName::MeanCoverage)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn counted_tones_leave_out_paper_and_solid_ink() {
        let tones = Tones::Count(6).list();
        assert_eq!(tones.len(), 6);
        assert!(tones[0] > 0.0 && tones[5] < 1.0);
    }

    #[test]
    fn measures_agree_on_paper_and_on_solid_ink_and_differ_between() {
        let (mean, share) = (ToneMeasure::default(), ToneMeasure::named(MeasureName::NonPaper));
        for measure in [&mean, &share] {
            assert_eq!(measure.tone(&[0; 16]), 0.0);
            assert_eq!(measure.tone(&[255; 16]), 1.0);
        }
        assert!((mean.tone(&[51, 0]) - 0.1).abs() < 1e-4);
        assert_eq!(share.tone(&[51, 0]), 0.5);
    }

    #[test]
    fn a_measure_that_misbehaves_is_made_monotone() {
        let measure = ToneMeasure::new(|coverage| if coverage > 0.5 { f64::NAN } else { 1.0 - coverage });
        assert!((1..256).all(|ink| measure.weight(ink as u8) >= measure.weight(ink as u8 - 1)));
    }
}
