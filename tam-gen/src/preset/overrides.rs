//! Options that replace what a preset says, such as those of the command line.

use super::options::PlacementMethod;
use super::place::{Place, Violation};
use super::{Preset, Range, Tones};
use crate::problems::{FileError, Problem};

/// What to replace in a preset; [`None`] leaves the preset's own. Errors name these as options of the command line.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Overrides {
    /// `--size`: side of the finest level.
    pub size: Option<u32>,
    /// `--levels`: number of hand-built levels; sets the coarsest level.
    pub levels: Option<u32>,
    /// `--tones`: how many tones, or which.
    pub tones: Option<Tones>,
    /// `--seed`.
    pub seed: Option<u64>,
    /// `--placement`.
    pub placement: Option<PlacementMethod>,
    /// `--effort`: candidates per stroke of the progressive placement.
    pub effort: Option<u32>,
}

impl Preset {
    /// The preset with some options replaced, checked again.
    ///
    /// # Errors
    /// What no longer makes sense, in terms of the option that is to blame: `--size 300: a power of two from …`.
    pub fn apply(&self, overrides: &Overrides) -> Result<Preset, FileError> {
        let mut preset = self.clone();
        let mut given = Vec::new();
        let map = Place::of(&["map"]);
        if let Some(size) = overrides.size {
            preset.map.size = size;
            given.push((map.key("size"), format!("--size {size}")));
        }
        if let Some(levels) = overrides.levels {
            let option = format!("--levels {levels}");
            preset.map.coarsest = coarsest_of(preset.map.size, levels)
                .map_err(|problem| FileError::new("", "", vec![problem.labelled(&option)]))?;
            given.push((map.key("coarsest"), option));
        }
        if let Some(tones) = &overrides.tones {
            preset.map.tones = tones.clone();
            given.push((map.key("tones"), format!("--tones {}", in_words(tones))));
        }
        if let Some(seed) = overrides.seed {
            preset.seed = seed;
            given.push((Place::of(&["seed"]), format!("--seed {seed}")));
        }
        if let Some(method) = overrides.placement {
            preset.placement.method = method;
        }
        if let Some(effort) = overrides.effort {
            preset.placement.effort = effort;
            given.push((Place::of(&["placement", "effort"]), format!("--effort {effort}")));
        }
        let problems: Vec<Problem> = preset.validate().iter().map(|violation| in_terms_of(&given, violation)).collect();
        if problems.is_empty() { Ok(preset) } else { Err(FileError::new("", "", problems)) }
    }
}

/// The coarsest level of so many, or how many there can be.
fn coarsest_of(size: u32, levels: u32) -> Result<u32, LevelsProblem> {
    let smallest = Range::find("map", "coarsest").map_or(1, |range| range.min as u32);
    let most = (size / smallest).checked_ilog2().map_or(1, |steps| steps + 1);
    if (1..=most).contains(&levels) { Ok(size >> (levels - 1)) } else { Err(LevelsProblem { size, smallest, most }) }
}

struct LevelsProblem {
    size: u32,
    smallest: u32,
    most: u32,
}

impl LevelsProblem {
    fn labelled(self, option: &str) -> Problem {
        let Self { size, smallest, most } = self;
        Problem::general(option, option)
            .expected(format!("1 to {most} levels, as {size} px halve down to {smallest} px and no further"))
    }
}

/// A violation in terms of the option that caused it.
fn in_terms_of(given: &[(Place, String)], violation: &Violation) -> Problem {
    let option_at = |place: &Place| given.iter().find(|(at, _)| place.within(at)).map(|(_, option)| option);
    let problem = if let Some(option) = option_at(&violation.at) {
        let is_item = given.iter().all(|(at, _)| *at != violation.at);
        let message = if is_item { format!("{option}: {}", violation.problem) } else { option.clone() };
        Problem::general(option.as_str(), message)
    } else if let Some(option) = violation.related.iter().find_map(|(place, _)| option_at(place)) {
        Problem::general(option.as_str(), format!("{option}: {}", violation.problem))
    } else {
        Problem::general(violation.at.to_string(), &violation.problem)
    };
    problem.expected(&violation.expected).help(violation.help.clone())
}

fn in_words(tones: &Tones) -> String {
    match tones {
        Tones::Count(count) => count.to_string(),
        Tones::List(list) => list.iter().map(f64::to_string).collect::<Vec<_>>().join(","),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn refused(overrides: Overrides) -> String {
        Preset::default().apply(&overrides).expect_err("this must be refused").to_string()
    }

    #[test]
    fn errors_name_the_option() {
        let size = refused(Overrides { size: Some(300), ..Overrides::default() });
        assert!(size.contains("--size 300: a power of two from 64 to 4096 px"), "{size}");
        let levels = refused(Overrides { levels: Some(9), ..Overrides::default() });
        assert!(levels.contains("--levels 9: 1 to 6 levels"), "{levels}");
        let tones = refused(Overrides { tones: Some(Tones::List(vec![0.5, 0.2])), ..Overrides::default() });
        assert!(tones.contains("--tones 0.5,0.2: map.tones[1] is 0.2"), "{tones}");
        let tones = refused(Overrides { tones: Some(Tones::Count(65)), ..Overrides::default() });
        assert!(tones.contains("--tones 65: 1 to 64 tones"), "{tones}");
        let seed = refused(Overrides { seed: Some(u64::MAX), ..Overrides::default() });
        assert!(seed.contains("--seed 18446744073709551615: a whole number from 0"), "{seed}");
    }

    #[test]
    fn an_option_is_blamed_for_what_it_breaks_elsewhere() {
        let mut preset = Preset::default();
        preset.map.coarsest = 128;
        preset.map.size = 256;
        let error = preset.apply(&Overrides { size: Some(64), ..Overrides::default() }).expect_err("a coarsest above");
        assert!(error.to_string().contains("--size 64: map.coarsest is 128 px"), "{error}");
        preset.stroke.width_px = 20.0;
        let error = preset.apply(&Overrides { levels: Some(5), ..Overrides::default() }).expect_err("strokes too wide");
        assert!(error.to_string().contains("--levels 5: strokes of up to 20 px"), "{error}");
    }

    #[test]
    fn levels_count_from_the_size_that_is_asked_for() {
        let overrides = Overrides { size: Some(512), levels: Some(3), ..Overrides::default() };
        let preset = Preset::default().apply(&overrides).expect("a valid preset");
        assert_eq!((preset.map.coarsest, preset.level_count()), (128, 3));
    }
}
