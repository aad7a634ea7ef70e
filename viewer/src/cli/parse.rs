//! Values of options, from text.

use glam::{DVec2, DVec3};
use tam_gen::preset::nearest;
use tam_viewer::mesh::deform::Deform;
use tam_viewer::ranges::{self, Range};
use tam_viewer::{Light, LightKind};

/// A camera's direction, and its distance where one was given.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Orbit {
    pub(super) azimuth_deg: f64,
    pub(super) elevation_deg: f64,
    pub(super) distance: Option<f64>,
}

/// A width, or none.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct OrNone(pub(super) Option<f64>);

/// A deformation at a phase.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Deformed {
    pub(super) deform: Deform,
    pub(super) phase: f64,
}

/// A colour in linear light.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Colour(pub(super) [f32; 3]);

/// Strength and exponent of a highlight.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Specular {
    pub(super) strength: f64,
    pub(super) shininess: f64,
}

/// A number in a range.
pub(super) fn in_range(range: Range) -> impl Fn(&str) -> Result<f64, String> + Clone + Send + Sync + 'static {
    move |text| number(text, range)
}

/// A number in a range, or `none`.
pub(super) fn or_none(range: Range) -> impl Fn(&str) -> Result<OrNone, String> + Clone + Send + Sync + 'static {
    move |text| if text == "none" { Ok(OrNone(None)) } else { number(text, range).map(|number| OrNone(Some(number))) }
}

fn number(text: &str, range: Range) -> Result<f64, String> {
    let number: f64 = text.trim().parse().map_err(|_| format!("{text:?} is no number; {range} is expected"))?;
    if range.contains(number) { Ok(number) } else { Err(format!("{number} is out of range; allowed: {range}")) }
}

/// Numbers between commas, each in its range; as many as there are ranges, or fewer down to `least`.
fn numbers(text: &str, named: &[(&str, Range)], least: usize) -> Result<Vec<f64>, String> {
    let words: Vec<&str> = text.split(',').collect();
    if words.len() < least || words.len() > named.len() {
        let names: Vec<&str> = named.iter().map(|(name, _)| *name).collect();
        return Err(format!("{} numbers are given; expected: {}", words.len(), names.join(",")));
    }
    let number = |(word, (name, range)): (&&str, &(&str, Range))| {
        number(word, *range).map_err(|problem| format!("{name}: {problem}"))
    };
    words.iter().zip(named).map(number).collect()
}

/// `WIDTHxHEIGHT`, or one number for both.
pub(super) fn size(text: &str) -> Result<[u32; 2], String> {
    let side = |word: &str| match word.trim().parse::<u32>() {
        Ok(0) => Err("a picture without pixels cannot be drawn".to_owned()),
        Ok(side) => Ok(side),
        Err(_) => Err(format!("{word:?} is no number of pixels; expected: WIDTHxHEIGHT, such as 1024x768")),
    };
    match text.split_once(['x', 'X']) {
        Some((width, height)) => Ok([side(width)?, side(height)?]),
        None => side(text).map(|side| [side; 2]),
    }
}

/// `AZ,EL[,DIST]`.
pub(super) fn orbit(text: &str) -> Result<Orbit, String> {
    let named = [("AZ", ranges::AZIMUTH_DEG), ("EL", ranges::ELEVATION_DEG), ("DIST", ranges::DISTANCE)];
    let numbers = numbers(text, &named, 2)?;
    Ok(Orbit { azimuth_deg: numbers[0], elevation_deg: numbers[1], distance: numbers.get(2).copied() })
}

/// `X,Y,Z` in world units.
pub(super) fn point(text: &str) -> Result<DVec3, String> {
    let at = numbers(text, &[("X", ranges::COORDINATE), ("Y", ranges::COORDINATE), ("Z", ranges::COORDINATE)], 3)?;
    Ok(DVec3::new(at[0], at[1], at[2]))
}

/// `X,Y,Z`, factors along the axes.
pub(super) fn stretch(text: &str) -> Result<DVec3, String> {
    let by = numbers(text, &[("X", ranges::SCALE), ("Y", ranges::SCALE), ("Z", ranges::SCALE)], 3)?;
    Ok(DVec3::new(by[0], by[1], by[2]))
}

/// `U,V` in tiles.
pub(super) fn shift(text: &str) -> Result<DVec2, String> {
    let by = numbers(text, &[("U", ranges::SHIFT), ("V", ranges::SHIFT)], 2)?;
    Ok(DVec2::new(by[0], by[1]))
}

/// `STRENGTH,SHININESS`; the exponent may be left out.
pub(super) fn specular(text: &str) -> Result<Specular, String> {
    let numbers = numbers(text, &[("STRENGTH", ranges::SHARE), ("SHININESS", ranges::SHININESS)], 1)?;
    Ok(Specular { strength: numbers[0], shininess: numbers.get(1).copied().unwrap_or(24.0) })
}

/// A light: `AZ,EL[,I]`, `at:X,Y,Z[,I]` or `spot:X,Y,Z,TX,TY,TZ,CUTOFF,EXPONENT[,I]`.
pub(super) fn light(text: &str) -> Result<Light, String> {
    let intensity = ("INTENSITY", ranges::INTENSITY);
    let place = [("X", ranges::COORDINATE), ("Y", ranges::COORDINATE), ("Z", ranges::COORDINATE)];
    let (mut light, given) = if let Some(text) = text.strip_prefix("at:") {
        let numbers = numbers(text, &[&place[..], &[intensity]].concat(), 3)?;
        (Light::at(DVec3::new(numbers[0], numbers[1], numbers[2])), numbers.get(3).copied())
    } else if let Some(text) = text.strip_prefix("spot:") {
        let towards = [("TX", ranges::COORDINATE), ("TY", ranges::COORDINATE), ("TZ", ranges::COORDINATE)];
        let cone = [("CUTOFF_DEG", ranges::CUTOFF_DEG), ("EXPONENT", ranges::SPOT_EXPONENT)];
        let n = numbers(text, &[&place[..], &towards, &cone, &[intensity]].concat(), 8)?;
        let (position, target) = (DVec3::new(n[0], n[1], n[2]), DVec3::new(n[3], n[4], n[5]));
        if position == target {
            return Err("the spot light shines at its own place; TX,TY,TZ must differ from X,Y,Z".to_owned());
        }
        let kind = LightKind::Spot { position, direction: target - position, cutoff_deg: n[6], exponent: n[7] };
        (Light { kind, intensity: 1.0 }, n.get(8).copied())
    } else {
        let numbers = numbers(text, &[("AZ", ranges::AZIMUTH_DEG), ("EL", ranges::ELEVATION_DEG), intensity], 2)?;
        (Light::from_angles(numbers[0], numbers[1]), numbers.get(2).copied())
    };
    light.intensity = given.unwrap_or(1.0);
    Ok(light)
}

/// A colour as CSS writes it.
pub(super) fn colour(text: &str) -> Result<Colour, String> {
    let colour = csscolorparser::parse(text).map_err(|error| format!("it is no CSS colour: {error}"))?;
    let [r, g, b, _] = colour.to_linear_rgba();
    Ok(Colour([r, g, b]))
}

/// `NAME[,PHASE]`.
pub(super) fn deformed(text: &str) -> Result<Deformed, String> {
    let (name, phase) = text.split_once(',').unwrap_or((text, "0.25"));
    let phase = number(phase, ranges::PHASE)?;
    let deform = Deform::named(name).ok_or_else(|| unknown("deformation", name, Deform::ALL.map(Deform::name)))?;
    Ok(Deformed { deform, phase })
}

/// What is said about a name that is none of those known.
pub(super) fn unknown<'a>(what: &str, name: &str, known: impl IntoIterator<Item = &'a str> + Clone) -> String {
    let meant = nearest(name, known.clone()).map_or(String::new(), |meant| format!("did you mean `{meant}`? "));
    let known: Vec<&str> = known.into_iter().collect();
    format!("no {what} is called `{name}`; {meant}there are {}", known.join(", "))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sizes_have_two_sides_or_one() {
        assert_eq!(size("640x480"), Ok([640, 480]));
        assert_eq!(size("512"), Ok([512, 512]));
        for wrong in ["", "0x5", "5x0", "x", "-3x4", "1e3", "99999999999x1"] {
            assert!(size(wrong).is_err(), "{wrong}");
        }
    }

    #[test]
    fn numbers_out_of_range_are_named_with_the_range() {
        assert_eq!(orbit("10,-20"), Ok(Orbit { azimuth_deg: 10.0, elevation_deg: -20.0, distance: None }));
        let problem = orbit("10,95").expect_err("too high");
        assert!(problem.contains("EL") && problem.contains("95") && problem.contains("-90 to 90"), "{problem}");
        assert!(orbit("10").is_err() && orbit("1,2,3,4").is_err() && orbit("nan,0").is_err());
        assert_eq!(or_none(ranges::LINE_WIDTH_PX)("none"), Ok(OrNone(None)));
        assert!(in_range(ranges::SHARE)("1.5").is_err());
    }

    #[test]
    fn lights_are_read_in_all_their_forms() {
        assert_eq!(light("30,40"), Ok(Light::from_angles(30.0, 40.0)));
        assert_eq!(light("at:1,2,3,0.5").map(|light| light.intensity), Ok(0.5));
        let spot = light("spot:0,2,0,0,0,0,25,4,0.8").expect("a spot light");
        let LightKind::Spot { direction, cutoff_deg, exponent, .. } = spot.kind else { panic!("{spot:?}") };
        assert_eq!((direction, cutoff_deg, exponent), (DVec3::new(0.0, -2.0, 0.0), 25.0, 4.0));
        for wrong in ["at:1,2", "spot:0,2,0,0,0,0,95,4", "spot:1,1,1,1,1,1,20,1", "sun", "10,20,-1"] {
            assert!(light(wrong).is_err(), "{wrong}");
        }
    }

    #[test]
    fn names_that_are_none_bring_the_nearest() {
        let problem = deformed("twits").expect_err("no such name");
        assert!(problem.contains("did you mean `twist`?"), "{problem}");
        assert_eq!(deformed("wave,0.5").map(|deformed| deformed.phase), Ok(0.5));
        assert!(colour("inky").is_err());
        assert_eq!(colour("white"), Ok(Colour([1.0; 3])));
    }
}
