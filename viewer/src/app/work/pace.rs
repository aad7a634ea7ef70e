//! How fast this machine is, and how much coarser what only passes is made for that.

use std::time::Duration;

/// Where a picture to be looked at is expected to cost more than this on the device, in milliseconds, those that only
/// pass are drawn smaller, up to so many times.
const COSTLY_MS: f64 = 42.0;
const COARSEST: u32 = 8;

/// Sides that pictures keep however costly they are.
const LEAST_PX: u32 = 160;

/// How many times as many pixels a picture has to have as another, for what both took to tell of mesh and pixels.
const UNLIKE: f64 = 1.5;

/// How far off that costs have to be before the size of what passes changes.
const SLACK: f64 = 1.15;

/// How long a band of a picture may take, in milliseconds, that the window waits for, and how many there are at most.
const BAND_MS: f64 = 90.0;
const BANDS: u32 = 12;

/// Bands of a picture whose cost nobody knows.
const FIRST_BANDS: u32 = 3;

/// Where a map takes longer than this, in milliseconds, a smaller one stands in for it while a slider moves, yet none
/// smaller than so many texels to a side.
const SLOW_MAP_MS: f64 = 50.0;
const LEAST_DRAFT_PX: u32 = 256;

/// What pictures and maps took; nothing at first.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct Pace {
    /// The last picture, and the last one of another size: pixels, and what they took in milliseconds.
    pictures: [Option<(f64, f64)>; 2],
    /// How many times smaller pictures that pass were drawn last.
    coarser: u32,
    map_ms_per_texel: f64,
}

/// What a picture is expected to take, in milliseconds: a part that goes with the mesh, and one with the pixels.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Expected {
    mesh_ms: f64,
    ms_per_pixel: f64,
}

impl Expected {
    fn ms(self, pixels: f64) -> f64 {
        self.mesh_ms + self.ms_per_pixel * pixels
    }
}

/// Pixels as they count: each is shaded once, but four samples are kept and made one.
fn pixels(size_px: [u32; 2], samples: u32) -> f64 {
    f64::from(size_px[0]) * f64::from(size_px[1]) * f64::from(3 + samples) / 4.0
}

impl Pace {
    /// A picture was drawn.
    pub(super) fn picture_drawn(&mut self, size_px: [u32; 2], samples: u32, took: Duration) {
        let (pixels, ms) = (pixels(size_px, samples), took.as_secs_f64() * 1e3);
        let [last, before] = &mut self.pictures;
        if last.is_some_and(|(of, _)| of.max(pixels) > UNLIKE * of.min(pixels)) {
            *before = *last;
        }
        *last = Some((pixels, ms));
    }

    fn expected(&self) -> Option<Expected> {
        let [last, before] = self.pictures;
        let (pixels, ms) = last?;
        let of_pixels = Expected { mesh_ms: 0.0, ms_per_pixel: ms / pixels };
        Some(before.map_or(of_pixels, |(other, other_ms)| {
            let ms_per_pixel = ((ms - other_ms) / (pixels - other)).clamp(0.0, ms / pixels);
            Expected { mesh_ms: ms - ms_per_pixel * pixels, ms_per_pixel }
        }))
    }

    /// How many times smaller pictures that only pass are drawn in place of one of this size.
    pub(super) fn coarser(&mut self, size_px: [u32; 2], samples: u32) -> u32 {
        let Some(expected) = self.expected() else { return 1 };
        let ms = |coarser: u32| match coarser {
            1 => expected.ms(pixels(size_px, samples)),
            _ => expected.ms(pixels(size_px.map(|side| side.div_ceil(coarser)), 1)),
        };
        let coarsest = (size_px[0].min(size_px[1]) / LEAST_PX).clamp(1, COARSEST);
        let least = |most_ms: f64| (1..coarsest).find(|coarser| ms(*coarser) <= most_ms).unwrap_or(coarsest);
        // What is about right stays as it is: pictures that change their size flicker.
        self.coarser = self.coarser.clamp(least(COSTLY_MS * SLACK), least(COSTLY_MS / SLACK));
        self.coarser
    }

    /// In how many bands a picture of this size is drawn, so that the window can draw itself in between.
    pub(super) fn bands(&self, size_px: [u32; 2], samples: u32) -> u32 {
        let Some(expected) = self.expected() else { return FIRST_BANDS };
        let ms = expected.ms(pixels(size_px, samples));
        // Each band goes through the mesh again: all together no more than once more.
        let most = (ms / expected.mesh_ms).min(f64::from(BANDS));
        (ms / BAND_MS).ceil().min(most).max(1.0) as u32
    }

    /// A whole map was made, its finest level so large.
    pub(super) fn map_made(&mut self, size: u32, took: Duration) {
        self.map_ms_per_texel = took.as_secs_f64() * 1e3 / f64::from(size).powi(2);
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

    const SIZE_PX: [u32; 2] = [1000, 1000];

    fn after(pictures: &[([u32; 2], u32, u64)]) -> Pace {
        let mut pace = Pace::default();
        for (size_px, samples, ms) in pictures {
            pace.picture_drawn(*size_px, *samples, Duration::from_millis(*ms));
        }
        pace
    }

    #[test]
    fn costly_pictures_are_coarser_while_they_pass() {
        assert_eq!((Pace::default().coarser(SIZE_PX, 4), Pace::default().bands(SIZE_PX, 4)), (1, FIRST_BANDS));
        let coarser = [1, 33, 70, 200, 5000].map(|ms| after(&[(SIZE_PX, 4, ms)]).coarser(SIZE_PX, 4));
        assert_eq!(coarser, [1, 1, 2, 2, SIZE_PX[1] / LEAST_PX]);
        assert_eq!(after(&[(SIZE_PX, 4, 50_000)]).coarser([8000, 6000], 4), COARSEST);
        assert_eq!(after(&[(SIZE_PX, 4, 50_000)]).coarser([300, 100], 4), 1);
        let bands = [1, 33, 70, 200, 5000].map(|ms| after(&[(SIZE_PX, 4, ms)]).bands(SIZE_PX, 4));
        assert_eq!(bands, [1, 1, 1, 3, BANDS]);
    }

    #[test]
    fn what_the_mesh_alone_takes_is_known_from_pictures_of_two_sizes() {
        let pace = after(&[([500, 500], 1, 120), (SIZE_PX, 1, 195)]);
        let Expected { mesh_ms, ms_per_pixel } = pace.expected().expect("two pictures");
        assert!((mesh_ms - 95.0).abs() < 1e-9 && (ms_per_pixel - 1e-4).abs() < 1e-12);
        assert_eq!(pace.bands(SIZE_PX, 1), 2, "each goes through the mesh again");
        // A small picture that takes longer than a large one is of another mesh.
        let pace = after(&[(SIZE_PX, 1, 20), ([500, 500], 1, 120)]);
        assert_eq!(pace.expected(), Some(Expected { mesh_ms: 120.0, ms_per_pixel: 0.0 }));
    }

    #[test]
    fn pictures_that_pass_keep_their_size_as_long_as_it_is_about_right() {
        let mut pace = after(&[(SIZE_PX, 4, 75)]);
        assert_eq!(pace.coarser(SIZE_PX, 4), 2);
        for (ms, expected) in [(45, 2), (38, 2), (25, 1), (38, 1), (46, 1), (52, 2)] {
            pace.picture_drawn(SIZE_PX, 4, Duration::from_millis(ms));
            assert_eq!(pace.coarser(SIZE_PX, 4), expected, "at {ms} ms");
        }
    }
}
