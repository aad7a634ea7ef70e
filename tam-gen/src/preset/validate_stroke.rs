//! Whether strokes and their tips make sense.

use super::place::{Place, Violation};
use super::validate::check_ranges;
use super::{FamilyOptions, Preset, StrokeOptions, TipOptions, tip_source};

/// Checks the common strokes, and those of every family where they differ.
pub(super) fn check_strokes(preset: &Preset, found: &mut Vec<Violation>) {
    let common = Place::of(&["stroke"]);
    check_ranges(&common, &preset.stroke.numbers(), found);
    if let Some(tip) = &preset.stroke.tip {
        check_tip(&common.key("tip"), tip, found);
    }
    for (name, family) in &preset.families {
        let own = Place::of(&["families", name]);
        if let Some(tip) = &family.tip {
            check_tip(&own.key("tip"), tip, found);
        }
        check_shape(preset, &Keys { own, family, common: &common }, &family.stroke(&preset.stroke), found);
    }
}

/// Where the numbers of a family's strokes stand: with the family, or with all strokes.
struct Keys<'a> {
    own: Place,
    family: &'a FamilyOptions,
    common: &'a Place,
}

impl Keys<'_> {
    fn of(&self, key: &str) -> Place {
        let is_own = self.family.numbers().iter().any(|(set, _)| *set == key);
        if is_own { self.own.key(key) } else { self.common.key(key) }
    }

    /// The key, of two, that the family sets itself, and the other one.
    fn pair(&self, first: &str, second: &str) -> (Place, Place) {
        let (first, second) = (self.of(first), self.of(second));
        if second.within(&self.own) { (second, first) } else { (first, second) }
    }
}

fn check_shape(preset: &Preset, keys: &Keys<'_>, stroke: &StrokeOptions, found: &mut Vec<Violation>) {
    let mut report = |violation: Violation| {
        // Families that share a number share its violation.
        if !found.iter().any(|known| known.at == violation.at) {
            found.push(violation);
        }
    };
    if stroke.length_min > stroke.length_max {
        let (at, other) = keys.pair("length_min", "length_max");
        let problem =
            format!("the shortest stroke ({}) is longer than the longest ({})", stroke.length_min, stroke.length_max);
        report(Violation::new(at, problem, "length_min must not be above length_max").related(other, "and this"));
    }
    if stroke.taper_in + stroke.taper_out > 1.0 {
        let (at, other) = keys.pair("taper_in", "taper_out");
        let problem = format!("the tapers are longer than the stroke: {} and {}", stroke.taper_in, stroke.taper_out);
        report(
            Violation::new(at, problem, "taper_in and taper_out together reach at most 1").related(other, "and this"),
        );
    }
    let widest = stroke.width_px * (1.0 + stroke.width_jitter);
    let coarsest = f64::from(preset.map.coarsest);
    if widest >= coarsest && coarsest > 0.0 {
        let at = keys.of("width_px");
        let problem = format!("strokes of up to {widest} px are as wide as the coarsest level, {coarsest} px");
        report(
            Violation::new(at, problem, format!("below {:.1} px", coarsest / (1.0 + stroke.width_jitter)))
                .help("make the strokes narrower, or leave out coarse levels: raise map.coarsest")
                .related(Place::of(&["map", "coarsest"]), "the coarsest level"),
        );
    }
}

fn check_tip(place: &Place, tip: &TipOptions, found: &mut Vec<Violation>) {
    check_ranges(place, &tip.numbers(), found);
    match (&tip.path, &tip.image) {
        (None, None) => found.push(Violation::new(
            place.clone(),
            format!("{place} has no shape"),
            "path = \"M0 0 …\" or image = \"tip.png\"",
        )),
        (Some(_), Some(_)) => found.push(
            Violation::new(place.key("image"), format!("{place} has two shapes"), "either path or image, not both")
                .related(place.key("path"), "the other shape"),
        ),
        (None, Some(image)) if !image.starts_with("data:") => found.push(
            Violation::new(
                place.key("image"),
                format!("the picture of {place} is a file, but the preset is none"),
                "a data: address that holds the picture",
            )
            .help("load the preset as a file, and pictures are looked for beside it"),
        ),
        (path, _) => {
            if let Err(problem) = tip_source::check_shape(tip) {
                let (key, expected) = match path {
                    Some(_) => ("path", "SVG path data of a shape with an area, such as \"M0 0 L1 0 L0.5 1 Z\""),
                    None => ("image", "a data: address of a PNG or SVG picture in base64"),
                };
                found.push(Violation::new(place.key(key), format!("{place}: {problem}"), expected));
            }
        }
    }
}
