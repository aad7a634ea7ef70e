//! Whether a preset makes sense: every number in its range, and all parts fitting together.

use super::place::{Place, Violation, is_bare, nearest};
use super::structure::range_at;
use super::validate_stroke::check_strokes;
use super::{FamilyOptions, Preset, SEED_MAX, TONE_COUNT, Tones};

/// Most families of a preset: one per entry of the longest schedule.
const FAMILY_COUNT_MAX: usize = 64;

/// Least step between two tones, in texels of ink at the coarsest level.
const TONE_STEP_TEXELS: f64 = 0.25;

impl Preset {
    /// Everything that is wrong with the preset, or nothing.
    ///
    /// A preset without violations can be generated from; only tones that its ink cannot reach remain to be found out
    /// by doing it ([`crate::Map::deficits`]).
    pub fn validate(&self) -> Vec<Violation> {
        let mut found = Vec::new();
        check_words(self, &mut found);
        check_map(self, &mut found);
        check_tones(self, &mut found);
        check_placement(self, &mut found);
        check_families(self, &mut found);
        if self.families.len() <= FAMILY_COUNT_MAX {
            check_schedule(self, &mut found);
            check_strokes(self, &mut found);
        }
        found
    }
}

/// Checks numbers of a table against their ranges.
pub(super) fn check_ranges(table: &Place, numbers: &[(&str, f64)], found: &mut Vec<Violation>) {
    for (key, number) in numbers {
        let at = table.key(key);
        let Some(range) = range_at(&at).filter(|range| !range.contains(*number)) else { continue };
        let problem = if number.is_nan() {
            format!("{at} is not a number")
        } else {
            format!("{at} is {number}, which is out of range")
        };
        found.push(Violation::new(at, problem, range.describe()));
    }
}

fn check_words(preset: &Preset, found: &mut Vec<Violation>) {
    if preset.description.chars().any(char::is_control) {
        let at = Place::of(&["description"]);
        found.push(Violation::new(at, "description runs over more than a line", "one line of plain text"));
    }
    if preset.seed > SEED_MAX {
        let at = Place::of(&["seed"]);
        found.push(Violation::new(at, "seed is out of range", format!("a whole number from 0 to {SEED_MAX}")));
    }
    for (key, colour) in [("paper", &preset.colours.paper), ("ink", &preset.colours.ink)] {
        if csscolorparser::parse(colour).is_err() {
            let at = Place::of(&["colours", key]);
            let problem = format!("{at} is no colour");
            found.push(Violation::new(at, problem, "a CSS colour: \"#1a1a1a\", \"rgb(26 26 26)\", \"ivory\""));
        }
    }
}

fn check_map(preset: &Preset, found: &mut Vec<Violation>) {
    let before = found.len();
    let map = &preset.map;
    let table = Place::of(&["map"]);
    for (key, number) in map.numbers() {
        let at = table.key(key);
        let Some(range) = range_at(&at) else { continue };
        let is_power = number > 0.0 && (number as u32).is_power_of_two();
        if !range.contains(number) || !is_power {
            let cause = if is_power { "out of range" } else { "not a power of two" };
            let problem = format!("{at} is {number}, which is {cause}");
            found.push(Violation::new(at, problem, format!("a power of two from {}", range.describe())));
        }
    }
    if found.len() == before && map.coarsest > map.size {
        found.push(
            Violation::new(
                table.key("coarsest"),
                format!("map.coarsest is {} px, more than the finest level has", map.coarsest),
                format!("a power of two from 8 to {} px", map.size),
            )
            .related(table.key("size"), "the finest level"),
        );
    }
}

fn check_tones(preset: &Preset, found: &mut Vec<Violation>) {
    let at = Place::of(&["map", "tones"]);
    let count = preset.map.tones.count();
    let (fewest, most) = (TONE_COUNT.start(), TONE_COUNT.end());
    if !TONE_COUNT.contains(&count) {
        found.push(Violation::new(
            at,
            format!("map.tones asks for {count} tones"),
            format!("{fewest} to {most} tones"),
        ));
        return;
    }
    let tones = preset.map.tones.list();
    let place_of = |column: usize| match preset.map.tones {
        Tones::Count(_) => at.clone(),
        Tones::List(_) => at.item(column),
    };
    let coarsest = f64::from(preset.map.coarsest.max(8));
    let least_step = TONE_STEP_TEXELS / (coarsest * coarsest);
    for (column, &tone) in tones.iter().enumerate() {
        let place = place_of(column);
        let before = if column == 0 { 0.0 } else { tones[column - 1] };
        if !(tone > 0.0 && tone <= 1.0) {
            let problem = format!("{place} is {tone}, which is no darkness");
            found.push(Violation::new(place, problem, "above 0 (paper), up to 1 (solid ink)"));
        } else if tone <= before {
            let problem = format!("{place} is {tone}, not darker than the one before it");
            found.push(Violation::new(place, problem, format!("above {before}: tones rise, lightest first")));
        } else if tone - before < least_step {
            let problem = format!("{place} is too near to the tone before it for the coarsest level");
            found.push(
                Violation::new(place, problem, format!("at least {:.2e} above {before}", least_step))
                    .help(format!(
                        "a step must be worth a quarter of a texel of ink at {coarsest} px: leave the tone out, or \
                         raise map.coarsest"
                    ))
                    .related(Place::of(&["map", "coarsest"]), "the coarsest level"),
            );
        }
    }
}

fn check_placement(preset: &Preset, found: &mut Vec<Violation>) {
    let table = Place::of(&["placement"]);
    let placement = &preset.placement;
    check_ranges(&table, &placement.numbers(), found);
    if placement.candidates_last > placement.candidates_first {
        found.push(
            Violation::new(
                table.key("candidates_last"),
                "placement.candidates_last is more than placement.candidates_first",
                format!("up to {}: the search needs fewer in dark columns", placement.candidates_first),
            )
            .related(table.key("candidates_first"), "candidates in the lightest column"),
        );
    }
}

fn check_families(preset: &Preset, found: &mut Vec<Violation>) {
    let at = Place::of(&["families"]);
    let count = preset.families.len();
    if count == 0 || count > FAMILY_COUNT_MAX {
        let problem = format!("the preset has {count} families");
        found.push(
            Violation::new(at.clone(), problem, format!("1 to {FAMILY_COUNT_MAX} families"))
                .help("a family is a table such as [families.h] with angle_deg = 0"),
        );
    }
    for (name, family) in preset.families.iter().take(FAMILY_COUNT_MAX) {
        let place = at.key(name);
        if !is_bare(name) {
            let problem = format!("{name:?} is no name for a family");
            found.push(Violation::new(place.clone(), problem, "a word of letters, digits, _ and -"));
        }
        check_ranges(&place, &FamilyOptions::numbers(family), found);
    }
}

fn check_schedule(preset: &Preset, found: &mut Vec<Violation>) {
    let at = Place::of(&["schedule"]);
    let names = || preset.families.keys().map(String::as_str);
    let known = names().collect::<Vec<_>>().join(", ");
    let count = preset.schedule.len();
    if !TONE_COUNT.contains(&count) {
        let allowed = format!("1 to {} entries, one per column", TONE_COUNT.end());
        found.push(Violation::new(at.clone(), format!("schedule has {count} entries"), allowed));
    }
    for (column, entry) in preset.schedule.iter().enumerate().take(*TONE_COUNT.end()) {
        let place = at.item(column);
        if entry.split_whitespace().next().is_none() {
            let problem = format!("{place} names no family");
            found.push(Violation::new(place.clone(), problem, format!("one or more of {known}")));
        }
        for name in entry.split_whitespace().filter(|name| !preset.families.contains_key(*name)) {
            let problem = format!("{place} names the family {name:?}, which does not exist");
            let expected = match nearest(name, names()) {
                Some(meant) => format!("did you mean {meant:?}?"),
                None => format!("one or more of {known}"),
            };
            found.push(
                Violation::new(place.clone(), problem, expected)
                    .help(format!("describe it in a table [families.{name}], or name another: {known}")),
            );
        }
    }
}
