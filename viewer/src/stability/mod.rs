//! Where methods fail: cases that show the failure in the form that the source prints, and measure the hardened one.
//!
//! ```text
//! cause ─► cases ─► stand (draws both forms) ─► sides: figure and picture ─► outcome: fails as said, holds as said
//! ```
//!
//! A case is data: what fails, what is measured, from where on it counts as failed and as held, and why there. Where no
//! form fails, or where nothing cures the failure, the case says so, and the outcome is checked against that as well.

mod case;
mod figures;
mod levels;
mod lights;
mod maps;
mod meshes;
mod motion;
mod shapes;
mod stand;
mod surfaces;
mod tones;

pub use case::{Case, Hardened, Limit, Literal, Outcome, Side, StabilityError, Verdict};
pub use figures::{difference, nan_count};
pub use shapes::{light_from, loaded, unmended};
pub use stand::Stand;

/// Cases that fail for one reason.
#[derive(Clone, Copy, Debug)]
pub struct Cause {
    /// In a word.
    pub name: &'static str,
    /// In the order in which they are told.
    pub cases: &'static [Case],
}

/// All cases, by cause.
pub const CAUSES: [Cause; 7] = [
    Cause { name: "lights", cases: &lights::CASES },
    Cause { name: "meshes", cases: &meshes::CASES },
    Cause { name: "tones", cases: &tones::CASES },
    Cause { name: "levels", cases: &levels::CASES },
    Cause { name: "motion", cases: &motion::CASES },
    Cause { name: "surfaces", cases: &surfaces::CASES },
    Cause { name: "maps", cases: &maps::CASES },
];

/// All cases.
pub fn cases() -> impl Iterator<Item = &'static Case> {
    CAUSES.iter().flat_map(|cause| cause.cases)
}
