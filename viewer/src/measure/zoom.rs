//! Zoom: whether strokes stay while the view comes nearer.

use std::fmt;

use glam::DVec2;
use rayon::prelude::*;

use super::aov::Aov;
use super::blur::MaskedBlur;
use super::plane::Plane;
use super::track::Track;

/// Ink from which on a pixel certainly belongs to a stroke.
const CORE: f64 = 0.6;
/// Ink below which nothing of a stroke is left.
const GONE: f64 = 0.2;

/// Ink that comes and goes between a far and a near view of a surface.
#[derive(Clone, Copy, Debug, PartialEq, serde::Serialize)]
pub struct Zoom {
    /// Share of the far view's strokes, by pixels, of which nothing is left in the near one: an error. 0 for strokes
    /// that nest.
    pub deaths: f64,
    /// Share of the near view's strokes of which the far one has nothing: new strokes, as there is room for them.
    pub births: f64,
    /// What the deaths would be if the near view had nothing to do with the far one.
    pub deaths_by_chance: f64,
    /// Pixels of strokes of the far view that are seen in both.
    pub pixels: usize,
}

/// Deaths and births of ink between a far view and a near one of the same surface.
///
/// A pixel of a stroke (ink ≥ 0.6) of one view is dead, or new-born, where the other has no ink of 0.2 or more within
/// reach of its place. `reach_px`: in pixels of the near view, half a stroke as wide as it is seen there, and a pixel, so
/// that strokes may get thinner on the surface, as those of constant width on the screen do; and in pixels of the far
/// view, about half a stroke. A stroke half faded in counts as neither.
///
/// `forth` leads from the far view to the near one, `back` the other way. By chance: the share of places without ink
/// within reach, weighted by the far view's coverage over `sigma_px` (two stroke periods or more), as dark places have
/// more strokes to lose. None where the far view has no strokes.
pub fn zoom(
    [far, near]: [&Plane; 2],
    [far_aov, near_aov]: [&Aov; 2],
    [forth, back]: [&Track; 2],
    reach_px: [f64; 2],
    sigma_px: f64,
) -> Option<Zoom> {
    let lost = gone(near, near_aov, forth, reach_px[0]);
    let (deaths, pixels) = share(far, &lost);
    let (births, _) = share(near, &gone(far, far_aov, back, reach_px[1]));
    let mask = forth.mask();
    let coverage = MaskedBlur::new(far.size, &mask, sigma_px).apply(&far.pixels);
    let (mut chance, mut whole) = (0.0, 0.0);
    for (lost, coverage) in lost.iter().zip(&coverage) {
        let Some(lost) = lost else { continue };
        chance += coverage * f64::from(u8::from(*lost));
        whole += coverage;
    }
    (pixels > 0).then(|| Zoom { deaths, births, deaths_by_chance: chance / whole.max(1e-12), pixels })
}

/// For each pixel that is followed to another view, whether there is no ink near its place there.
fn gone(other: &Plane, aov: &Aov, track: &Track, reach_px: f64) -> Vec<Option<bool>> {
    let reach = reach_px.ceil() as i32;
    let around: Vec<DVec2> = (-reach..=reach)
        .flat_map(|y| (-reach..=reach).map(move |x| DVec2::new(f64::from(x), f64::from(y))))
        .filter(|step| step.length() <= reach_px)
        .collect();
    let near = |place: &DVec2| {
        around.iter().any(|step| aov.index(*place + *step).is_some_and(|pixel| other.pixels[pixel] >= GONE))
    };
    track.places_px.par_iter().map(|place| place.as_ref().map(|place| !near(place))).collect()
}

/// Of the followed pixels of strokes, the share that is gone, and how many there are.
fn share(ink: &Plane, gone: &[Option<bool>]) -> (f64, usize) {
    let strokes = ink.pixels.iter().zip(gone).filter(|(ink, _)| **ink >= CORE).filter_map(|(_, gone)| *gone);
    let (lost, all) = strokes.fold((0, 0), |(lost, all), gone| (lost + usize::from(gone), all + 1));
    (lost as f64 / f64::from(all.max(1)), all as usize)
}

impl fmt::Display for Zoom {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let [deaths, births, chance] = [self.deaths, self.births, self.deaths_by_chance].map(|share| 100.0 * share);
        write!(f, "{deaths:.2} % of strokes die while zooming in ({chance:.1} % by chance), {births:.1} % are born")
    }
}

#[cfg(test)]
mod tests {
    use glam::DVec2;
    use tam_gen::sequence::Draw;

    use super::super::testing::{averaged, flat_aov};
    use super::*;

    const SIZE: [u32; 2] = [240, 180];
    /// From the far view to the near one.
    const FACTOR: f64 = 2.0;
    /// Half a stroke of 2 px as it is seen nearer, and a pixel; and half a stroke.
    const REACH_PX: [f64; 2] = [3.0, 1.0];

    /// Level strokes in units of near pixels: left end, middle and length.
    fn strokes(count: usize, seed: u64) -> Vec<(DVec2, f64)> {
        let mut draw = Draw::new(seed, "zoom");
        let mut place = move || {
            let at = DVec2::new(0.5 + 0.5 * draw.signed(), 0.5 + 0.5 * draw.signed());
            (at * DVec2::new(340.0, 180.0) - DVec2::new(100.0, 0.0), 50.0 + 20.0 * draw.signed())
        };
        (0..count).map(|_| place()).collect()
    }

    /// Strokes 2 px wide on the screen, at this many near pixels for one of its own.
    fn drawn(strokes: &[(DVec2, f64)], scale: f64) -> Plane {
        averaged(SIZE, |place| {
            let place = place * scale;
            let inked = |(start, length): &(DVec2, f64)| {
                let along = place.x - start.x;
                (0.0..*length).contains(&along) && (place.y - start.y).abs() < scale
            };
            f64::from(u8::from(strokes.iter().any(inked)))
        })
    }

    /// Two views of one plane, the far one showing more of it.
    fn zoomed(far: &[(DVec2, f64)], near: &[(DVec2, f64)]) -> Zoom {
        let aov = flat_aov(SIZE, 0.0, 0.3);
        let middle = |i: usize| {
            let width = SIZE[0] as usize;
            DVec2::new((i % width) as f64, (i / width) as f64) + 0.5
        };
        let track = |factor: f64| {
            let place = |i: usize| Some(middle(i) * factor).filter(|place| aov.index(*place).is_some());
            Track { places_px: (0..aov.pixels.len()).map(place).collect() }
        };
        let inks = [drawn(far, FACTOR), drawn(near, 1.0)];
        let tracks = [track(FACTOR), track(1.0 / FACTOR)];
        zoom([&inks[0], &inks[1]], [&aov, &aov], [&tracks[0], &tracks[1]], REACH_PX, 20.0).expect("strokes")
    }

    #[test]
    fn strokes_that_nest_are_born_and_none_dies() {
        let all = strokes(60, 1);
        let found = zoomed(&all[..30], &all);
        assert_eq!(found.deaths, 0.0, "{found}");
        assert!(found.births > 0.2 && found.pixels > 500, "{found:?}");
    }

    #[test]
    fn a_level_of_unrelated_strokes_is_a_control_that_dies_as_by_chance() {
        let found = zoomed(&strokes(30, 1), &strokes(60, 2));
        assert!(found.deaths > 0.3, "{found}");
        // Some hundred strokes make the chance: theirs is known to a tenth.
        assert!((found.deaths / found.deaths_by_chance - 1.0).abs() < 0.2, "{found}");
    }

    #[test]
    fn strokes_that_come_the_other_way_die() {
        let all = strokes(60, 1);
        let found = zoomed(&all, &all[..30]);
        assert!(found.deaths > 0.2 && found.births == 0.0, "{found}");
    }

    #[test]
    fn no_strokes_have_no_zoom() {
        let aov = flat_aov([8, 8], 0.0, 0.0);
        let (paper, still) = (Plane::from_fn([8, 8], |_, _| 0.0), Track::still(&aov));
        assert_eq!(zoom([&paper, &paper], [&aov, &aov], [&still, &still], [2.0, 1.0], 4.0), None);
    }
}
