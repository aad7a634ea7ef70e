//! How fast this machine is, and how much coarser what only passes is made for that.

use std::time::Duration;

/// Where a picture to be looked at costs more than this on the device, in milliseconds, those that only pass are drawn
/// smaller, up to so many times.
const COSTLY_MS: f64 = 45.0;
const COARSEST: f64 = 4.0;

/// Where a map takes longer than this, in milliseconds, a smaller one stands in for it while a slider moves, yet none
/// smaller than so many texels to a side.
const SLOW_MAP_MS: f64 = 50.0;
const LEAST_DRAFT_PX: u32 = 256;

/// What whole pictures and maps took; nothing at first.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct Pace {
    picture_ms: f64,
    map_ms_per_texel: f64,
}

impl Pace {
    /// A picture to be looked at was drawn.
    pub(super) fn picture_drawn(&mut self, took: Duration) {
        self.picture_ms = took.as_secs_f64() * 1e3;
    }

    /// A whole map was made, its finest level so large.
    pub(super) fn map_made(&mut self, size: u32, took: Duration) {
        self.map_ms_per_texel = took.as_secs_f64() * 1e3 / f64::from(size).powi(2);
    }

    /// How many times smaller pictures that only pass are drawn.
    pub(super) fn coarser(self) -> u32 {
        (self.picture_ms / COSTLY_MS).sqrt().ceil().clamp(1.0, COARSEST) as u32
    }

    /// Side of the map that stands in for one of this side while a slider moves, if that takes too long.
    pub(super) fn draft_px(self, size: u32) -> Option<u32> {
        let slow = |side: u32| self.map_ms_per_texel * f64::from(side).powi(2) > SLOW_MAP_MS && side > LEAST_DRAFT_PX;
        let mut side = size;
        while slow(side) {
            side /= 2;
        }
        (side < size).then_some(side)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn slow_maps_are_halved_until_they_are_quick() {
        let mut pace = Pace::default();
        assert_eq!(pace.draft_px(4096), None, "nothing is known yet");
        pace.map_made(1024, Duration::from_millis(100));
        let drafts = [256, 512, 1024, 2048, 4096].map(|size| pace.draft_px(size));
        assert_eq!(drafts, [None, None, Some(512), Some(512), Some(512)]);
        pace.map_made(256, Duration::from_secs(1));
        assert_eq!(pace.draft_px(4096), Some(LEAST_DRAFT_PX));
    }

    #[test]
    fn costly_pictures_are_coarser_while_they_pass() {
        let coarser = [1, 44, 46, 300, 5000].map(|ms| {
            let mut pace = Pace::default();
            pace.picture_drawn(Duration::from_millis(ms));
            pace.coarser()
        });
        assert_eq!(coarser, [1, 1, 2, 3, 4]);
    }
}
