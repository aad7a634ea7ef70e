//! What was found, in words and percentages.

use super::search::{Fit, Tried};
use crate::chart::Way;

impl Tried {
    /// How it is drawn, in words.
    pub fn way(&self) -> String {
        Way { params: self.params, map: 0 }.name()
    }

    /// The same with its map: `six-way, patches, 256 to 32 px, 6 tones`.
    pub fn label(&self) -> String {
        let map = self.map.map_or_else(
            || "no map".to_owned(),
            |map| {
                let plural = if map.tones == 1 { "" } else { "s" };
                format!("{} to {} px, {} tone{plural}", map.size, map.coarsest, map.tones)
            },
        );
        format!("{}, {map}", self.way())
    }
}

impl Fit {
    /// What is saved of the memory and of the frame's cost over `phong`, in percent of the present one's; below 0 it takes
    /// more.
    pub fn saved_percent(&self) -> [f64; 2] {
        let saved = |now: f64, fitted: f64| 100.0 * (1.0 - fitted / now);
        [saved(self.full.bytes as f64, self.best.bytes as f64), saved(self.full.cost_ratio, self.best.cost_ratio)]
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::fit::{FitMap, Worst};
    use crate::{Method, RenderParams, Scene};

    #[test]
    fn what_is_saved_is_told_against_the_present_one() {
        let tried = |method, cost_ratio, bytes, map| Tried {
            params: RenderParams { method, ..RenderParams::default() },
            map,
            cost_ratio,
            bytes,
            worst: Worst { error: 0.01, view: String::new() },
            missed: None,
        };
        let full = tried(Method::FineTone, 4.0, 1000, Some(FitMap { size: 256, tones: 1, coarsest: 32 }));
        let best = tried(Method::Stripes, 3.0, 1500, None);
        assert_eq!(full.label(), "fine-tone, triplanar, 256 to 32 px, 1 tone");
        assert!(best.label().ends_with(", no map"), "{}", best.label());
        let fit = Fit { full, best, failing: Vec::new(), views: 9, scene: Scene::default() };
        assert_eq!(fit.saved_percent(), [-50.0, 25.0]);
    }
}
