//! Which figures are charted against the cost, and in which words.

use tam_gen::chart::pareto_front;

use super::figures::Figures;
use super::ways::Way;
use crate::gpu::Picture;
use crate::params::{Form, RenderParams};

/// On the axis of cost.
pub const COST_AXIS: &str = "time of a frame over that of phong (ratio)";

/// Where the axis of cost is logarithmic from.
pub const COST_LOG_FROM: f64 = 0.1;

/// Breaks at edges up to this are none: they are counted over about 10⁴ pairs of pixels.
const EDGE_NOISE: f64 = 0.02;

/// An error that is charted against the cost; less is better.
#[derive(Clone, Copy, Debug)]
pub struct Measure {
    /// Name of its files.
    pub name: &'static str,
    /// In a title.
    pub short: &'static str,
    /// On the axis, with its unit.
    pub axis: &'static str,
    /// Where the axis is logarithmic from; `None`: even, from 0.
    pub log_from: Option<f64>,
    /// The error, where it can be measured.
    pub of: fn(&Figures) -> Option<f64>,
}

/// All that are charted.
pub const MEASURES: [Measure; 7] = [
    Measure {
        name: "tone",
        short: "error of tone",
        axis: "error of tone, RMS (L*)",
        log_from: Some(0.05),
        of: |figures| figures.tone_rmse,
    },
    Measure {
        name: "direction",
        short: "error of direction",
        axis: "mean angle to the wanted direction (°)",
        log_from: None,
        of: |figures| figures.direction_deg,
    },
    Measure {
        name: "edges",
        short: "break at mesh edges",
        axis: "changes of ink, across edges / inside faces - 1",
        log_from: None,
        // Less change at edges than elsewhere is no break: faces meet where the surface is steep and dark.
        of: |figures| figures.edge_continuity.map(|ratio| (ratio - 1.0).max(EDGE_NOISE)),
    },
    Measure {
        name: "orbit",
        short: "change under an orbit",
        axis: "change of strokes over 2° of orbit (1 unrelated)",
        log_from: None,
        of: |figures| figures.orbit_change,
    },
    Measure {
        name: "zoom",
        short: "change under a zoom",
        axis: "change of strokes, a twentieth nearer (1 unrelated)",
        log_from: None,
        of: |figures| figures.zoom_change,
    },
    Measure {
        name: "light",
        short: "swimming under the light",
        axis: "swimming over 1° of light (1 unrelated)",
        log_from: Some(1e-4),
        of: |figures| figures.swimming.map(|swimming| swimming.max(0.0)),
    },
    Measure {
        name: "popping",
        short: "popping under the light",
        axis: "greatest change over 1/8° of light (1 a whole stroke)",
        log_from: None,
        of: |figures| figures.popping_rest,
    },
];

impl Measure {
    /// The one of this name.
    pub fn named(name: &str) -> Option<&'static Self> {
        MEASURES.iter().find(|measure| measure.name == name)
    }

    /// Cost and error; an error that cannot be measured is no number.
    pub fn point(&self, figures: &Figures) -> [f64; 2] {
        [figures.cost.ratio, (self.of)(figures).unwrap_or(f64::NAN)]
    }

    /// Indices of the ways that no other beats in both cost and error, by growing cost.
    pub fn front<'a>(&self, figures: impl IntoIterator<Item = &'a Figures>) -> Vec<usize> {
        pareto_front(&figures.into_iter().map(|figures| self.point(figures)).collect::<Vec<_>>())
    }
}

/// Whether a literal form draws what the hardened one drew already, among the ways and pictures of before: it is no way of
/// its own in this scene.
pub fn is_repeated<'a>(way: &Way, picture: &Picture, drawn: impl IntoIterator<Item = (&'a Way, &'a Picture)>) -> bool {
    let hardened = Way { params: RenderParams { form: Form::Hardened, ..way.params }, ..*way };
    hardened != *way && drawn.into_iter().any(|(other, shown)| *other == hardened && shown == picture)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::chart::Cost;

    fn figures(ratio: f64, tone_rmse: Option<f64>) -> Figures {
        let cost = Cost { ratio, frame_ms: ratio, phong_ms: 1.0 };
        Figures { cost, tone_rmse, edge_continuity: Some(0.5), swimming: Some(-1e-3), ..Figures::default() }
    }

    #[test]
    fn the_front_leaves_out_what_cannot_be_measured() {
        let tone = Measure::named("tone").expect("a measure");
        let of = [figures(1.0, None), figures(3.0, Some(0.1)), figures(2.0, Some(0.5)), figures(4.0, Some(0.2))];
        assert_eq!(tone.front(&of), [2, 1]);
        assert!(Measure::named("direction").expect("a measure").front(&of).is_empty());
    }

    #[test]
    fn errors_are_never_negative() {
        let of = figures(1.0, Some(0.1));
        for (name, expected) in [("edges", EDGE_NOISE), ("light", 0.0)] {
            let measure = Measure::named(name).expect("a measure");
            assert_eq!((measure.of)(&of), Some(expected), "{name}");
        }
    }
}
