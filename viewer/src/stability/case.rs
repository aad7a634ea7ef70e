//! What a case is, and what came of it.

use std::fmt;

use image::RgbImage;
use tam_gen::GenerateError;

use super::stand::Stand;
use crate::gpu::GpuError;
use crate::mesh::MeshError;
use crate::reference::ReferenceError;
use crate::renderer::RenderError;
use crate::surface::SurfaceError;

/// Why a case could not be run.
#[derive(Debug, thiserror::Error)]
pub enum StabilityError {
    /// It cannot be drawn.
    #[error(transparent)]
    Render(#[from] RenderError),
    /// The mesh of the case.
    #[error(transparent)]
    Mesh(#[from] MeshError),
    /// Its surface.
    #[error(transparent)]
    Surface(#[from] SurfaceError),
    /// What is wanted in its view.
    #[error(transparent)]
    Reference(#[from] ReferenceError),
    /// Its map.
    #[error(transparent)]
    Generate(#[from] GenerateError),
    /// The preset of its map.
    #[error("there is no preset `{0}`, or it is not valid")]
    Preset(String),
    /// What should be measured is not there.
    #[error("nothing to measure: {0}")]
    Nothing(&'static str),
}

impl From<GpuError> for StabilityError {
    fn from(error: GpuError) -> Self {
        Self::Render(error.into())
    }
}

/// Where a figure must be; no limit allows NaN.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Limit {
    /// More than this.
    Above(f64),
    /// Less than this.
    Below(f64),
}

impl Limit {
    /// Whether a figure is there.
    pub fn allows(self, figure: f64) -> bool {
        match self {
            Self::Above(least) => figure > least,
            Self::Below(most) => figure < most,
        }
    }
}

impl fmt::Display for Limit {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Above(least) => write!(f, "> {least}"),
            Self::Below(most) => write!(f, "< {most}"),
        }
    }
}

/// What the literal form does.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Literal {
    /// It fails: its figure is there.
    Fails(Limit),
    /// It holds as the hardened one should, for this reason: there is nothing to mend.
    Holds(&'static str),
}

/// What the hardened form does.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Hardened {
    /// It holds.
    Holds,
    /// It still fails, for this reason.
    StillFails(&'static str),
}

/// A failure, and what is measured of it.
#[derive(Clone, Copy, Debug)]
pub struct Case {
    /// In a few words; no other case has them.
    pub name: &'static str,
    /// The method, as on the command line, or the placement of a map.
    pub method: &'static str,
    /// What fails, in a sentence.
    pub failure: &'static str,
    /// What is measured, with its unit.
    pub figure: &'static str,
    /// What the literal form does.
    pub literal: Literal,
    /// What the hardened form does.
    pub hardened: Hardened,
    /// Where the figure of a form is that does not fail.
    pub holds: Limit,
    /// Why the limits are where they are.
    pub reason: &'static str,
    /// Draws and measures the literal and the hardened form.
    pub run: fn(&mut Stand) -> Result<[Side; 2], StabilityError>,
}

/// One form of a case.
#[derive(Clone, Debug, PartialEq)]
pub struct Side {
    /// As [`Case::figure`] says.
    pub figure: f64,
    /// The frames that were measured, side by side, sRGB. What is no number is magenta, what is beyond paper and ink is
    /// orange.
    pub picture: RgbImage,
}

/// What came of a case.
#[derive(Clone, Debug)]
pub struct Outcome {
    /// The case.
    pub case: &'static Case,
    /// The form that the source prints.
    pub literal: Side,
    /// The mended one.
    pub hardened: Side,
}

/// An outcome in a word.
#[derive(Clone, Copy, Debug, PartialEq, Eq, serde::Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Verdict {
    /// The literal form fails, the hardened one holds.
    Held,
    /// Both forms hold: there is nothing to mend.
    NothingToMend,
    /// The hardened form fails, as is known.
    StillFailing,
    /// A figure is not where the case says it is.
    Unexpected,
}

impl Verdict {
    /// For people.
    pub fn words(self) -> &'static str {
        match self {
            Self::Held => "held",
            Self::NothingToMend => "nothing to mend",
            Self::StillFailing => "still failing",
            Self::Unexpected => "not as expected",
        }
    }
}

impl Case {
    /// Runs both forms.
    ///
    /// # Errors
    /// It cannot be drawn or measured.
    pub fn outcome(&'static self, stand: &mut Stand) -> Result<Outcome, StabilityError> {
        let [literal, hardened] = (self.run)(stand)?;
        Ok(Outcome { case: self, literal, hardened })
    }
}

impl Outcome {
    /// Whether the literal form shows the failure.
    pub fn literal_fails(&self) -> bool {
        matches!(self.case.literal, Literal::Fails(limit) if limit.allows(self.literal.figure))
    }

    /// Whether the hardened form does not.
    pub fn hardened_holds(&self) -> bool {
        self.case.holds.allows(self.hardened.figure)
    }

    /// How it ended, beside what the case says.
    pub fn verdict(&self) -> Verdict {
        let literal_as_said = match self.case.literal {
            Literal::Fails(_) => self.literal_fails(),
            Literal::Holds(_) => self.case.holds.allows(self.literal.figure),
        };
        match (literal_as_said, self.case.literal, self.case.hardened, self.hardened_holds()) {
            (true, Literal::Fails(_), Hardened::Holds, true) => Verdict::Held,
            (true, Literal::Holds(_), Hardened::Holds, true) => Verdict::NothingToMend,
            (true, _, Hardened::StillFails(_), false) => Verdict::StillFailing,
            _ => Verdict::Unexpected,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    static CASE: Case = Case {
        name: "test",
        method: "phong",
        failure: "",
        figure: "",
        literal: Literal::Fails(Limit::Above(0.1)),
        hardened: Hardened::Holds,
        holds: Limit::Below(0.01),
        reason: "",
        run: |_| Err(StabilityError::Nothing("test")),
    };
    static SOUND: Case = Case { literal: Literal::Holds(""), ..CASE };
    static UNMENDED: Case = Case { hardened: Hardened::StillFails(""), ..CASE };

    fn verdict(case: &'static Case, figures: [f64; 2]) -> Verdict {
        let [literal, hardened] = figures.map(|figure| Side { figure, picture: RgbImage::new(1, 1) });
        Outcome { case, literal, hardened }.verdict()
    }

    #[test]
    fn figures_on_the_wrong_side_are_unexpected() {
        assert_eq!(verdict(&CASE, [0.2, 0.0]), Verdict::Held);
        for wrong in [[0.05, 0.0], [0.2, 0.05], [f64::NAN, 0.0], [0.2, f64::NAN]] {
            assert_eq!(verdict(&CASE, wrong), Verdict::Unexpected, "{wrong:?}");
        }
    }

    #[test]
    fn what_needs_no_mending_and_what_is_not_mended_is_told() {
        assert_eq!(verdict(&SOUND, [0.0, 0.0]), Verdict::NothingToMend);
        assert_eq!(verdict(&SOUND, [0.2, 0.0]), Verdict::Unexpected);
        assert_eq!(verdict(&UNMENDED, [0.2, 0.2]), Verdict::StillFailing);
        // A failure that is gone should be called so.
        assert_eq!(verdict(&UNMENDED, [0.2, 0.0]), Verdict::Unexpected);
    }
}
