//! All measures of one picture.

use std::fmt;

use super::aov::Aov;
use super::direction::{Direction, direction};
use super::edge_continuity::{EdgeContinuity, edge_continuity};
use super::greyness::{Greyness, greyness};
use super::plane::Plane;
use super::run_length::{RunLength, run_length};
use super::tone::{Tone, tone};
use super::width::{Width, stroke_width};

/// Sizes of windows.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MeasureOptions {
    /// Standard deviation of the window in which tones are compared: two stroke periods or more.
    pub tone_sigma_px: f64,
    /// Standard deviation of the window of a stroke's direction: about a stroke's width.
    pub stroke_sigma_px: f64,
}

impl Default for MeasureOptions {
    fn default() -> Self {
        Self { tone_sigma_px: 20.0, stroke_sigma_px: 2.0 }
    }
}

/// What one picture shows.
#[derive(Clone, Copy, Debug, PartialEq, serde::Serialize)]
pub struct Measures {
    /// None where the mesh is not seen.
    pub tone: Option<Tone>,
    /// Against the wanted directions.
    pub direction: Direction,
    /// Along the wanted directions.
    pub run_length: RunLength,
    /// Beside the map's own.
    pub greyness: Greyness,
    /// Of the strokes at mesh edges.
    pub edge_continuity: EdgeContinuity,
    /// Of the strokes on the screen.
    pub width: Width,
}

/// Measures the ink of a picture against its view.
pub fn measures(ink: &Plane, aov: &Aov, options: &MeasureOptions) -> Measures {
    Measures {
        tone: tone(ink, aov, options.tone_sigma_px),
        direction: direction(ink, aov, options.stroke_sigma_px),
        run_length: run_length(ink, aov),
        greyness: greyness(ink, aov),
        edge_continuity: edge_continuity(ink, aov),
        width: stroke_width(ink, aov, options.stroke_sigma_px),
    }
}

impl fmt::Display for Measures {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if let Some(tone) = &self.tone {
            writeln!(f, "{tone}")?;
        }
        writeln!(f, "{}", self.direction)?;
        writeln!(f, "{}", self.run_length)?;
        writeln!(f, "{}", self.greyness)?;
        writeln!(f, "{}", self.edge_continuity)?;
        write!(f, "{}", self.width)
    }
}

#[cfg(test)]
mod tests {
    use super::super::testing::{Dashes, ramp_aov};
    use super::*;

    #[test]
    fn measures_are_the_same_for_any_number_of_threads() {
        let aov = ramp_aov([150, 110], 0.1, 0.5);
        let ink =
            Dashes { angle_rad: 0.05, length_px: 30.0, gap_px: 10.0, period_px: 7.0, width_px: 2.0 }.drawn(aov.size);
        let by = |threads: usize| {
            let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("threads");
            pool.install(|| measures(&ink, &aov, &MeasureOptions::default()))
        };
        let alone = by(1);
        assert_eq!(alone, by(3));
        assert!(alone.direction.pixels > 1000 && alone.run_length.samples > 1000, "{alone}");
    }

    #[test]
    fn measures_are_written_with_nothing_where_nothing_is() {
        let aov = ramp_aov([40, 40], 0.1, 0.5);
        let paper = Plane::from_fn(aov.size, |_, _| 0.0);
        let found = measures(&paper, &aov, &MeasureOptions::default());
        let json = serde_json::to_value(found).expect("it serialises");
        assert!(json["direction"]["mean_deg"].is_null() && json["run_length"]["mean_px"].is_null(), "{json}");
        assert!(json["tone"]["ink"]["bias"].as_f64().is_some_and(|bias| bias < -0.2), "{json}");
        let lines = found.to_string();
        assert!(lines.contains("no strokes to follow") && lines.lines().count() == 6, "{lines}");
    }
}
