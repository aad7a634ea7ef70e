//! Values, from text: those of options, and of scene files.

use glam::{DVec2, DVec3};
use tam_gen::preset::nearest;

use super::look::FieldEntry;
use super::object::Place;
use super::word::Given;
use crate::mesh::deform::Deform;
use crate::ranges::{self, Range};
use crate::scene::{AxisView, Light, LightKind};

/// A camera's direction, and its distance where one was given.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Orbit {
    /// Around the upright axis, in degrees.
    pub azimuth_deg: f64,
    /// Above the horizon, in degrees.
    pub elevation_deg: f64,
    /// From the target, in world units.
    pub distance: Option<f64>,
}

/// A width, or none.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct OrNone(pub Option<f64>);

/// A deformation at a phase.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Deformed {
    /// Which one.
    pub deform: Deform,
    /// In periods.
    pub phase: f64,
}

/// A colour in linear light.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Colour(pub [f32; 3]);

/// Strength and exponent of a highlight.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Specular {
    /// 0..=1.
    pub strength: f64,
    /// Exponent, 1..=1000.
    pub shininess: f64,
}

/// A number in a range.
pub fn in_range(range: Range) -> impl Fn(&str) -> Result<f64, String> + Clone + Send + Sync + 'static {
    move |text| number(text, range)
}

/// A number in a range, or `none`.
pub fn or_none(range: Range) -> impl Fn(&str) -> Result<OrNone, String> + Clone + Send + Sync + 'static {
    move |text| if text == "none" { Ok(OrNone(None)) } else { number(text, range).map(|number| OrNone(Some(number))) }
}

/// A number in a range.
pub(super) fn number(text: &str, range: Range) -> Result<f64, String> {
    let number: f64 = text.trim().parse().map_err(|_| format!("{text:?} is no number; {range} is expected"))?;
    if range.contains(number) { Ok(number) } else { Err(format!("{number} is out of range; allowed: {range}")) }
}

/// Numbers between commas, each in its range; as many as there are ranges, or fewer down to `least`.
pub(super) fn numbers(text: &str, named: &[(&str, Range)], least: usize) -> Result<Vec<f64>, String> {
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
pub fn size(text: &str) -> Result<[u32; 2], String> {
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

/// `AZ,EL[,DIST]`, or the name of an axis view in place of the angles.
pub fn orbit(text: &str) -> Result<Orbit, String> {
    let (name, distance) = text.split_once(',').map_or((text, None), |(name, distance)| (name, Some(distance)));
    if name.starts_with(|first: char| first.is_ascii_alphabetic()) {
        let view = AxisView::ALL.into_iter().find(|view| view.name() == name);
        let [azimuth_deg, elevation_deg] = view
            .ok_or_else(|| format!("AZ: {}", unknown("view", name, AxisView::ALL.map(AxisView::name))))?
            .angles_deg();
        let distance =
            distance.map(|text| number(text, ranges::DISTANCE).map_err(|problem| format!("DIST: {problem}")));
        return Ok(Orbit { azimuth_deg, elevation_deg, distance: distance.transpose()? });
    }
    let named = [("AZ", ranges::AZIMUTH_DEG), ("EL", ranges::ELEVATION_DEG), ("DIST", ranges::DISTANCE)];
    let numbers = numbers(text, &named, 2)?;
    Ok(Orbit { azimuth_deg: numbers[0], elevation_deg: numbers[1], distance: numbers.get(2).copied() })
}

/// `X,Y,Z` in world units.
pub fn point(text: &str) -> Result<DVec3, String> {
    let at = numbers(text, &[("X", ranges::COORDINATE), ("Y", ranges::COORDINATE), ("Z", ranges::COORDINATE)], 3)?;
    Ok(DVec3::new(at[0], at[1], at[2]))
}

/// `X,Y,Z`, factors along the axes.
pub fn stretch(text: &str) -> Result<DVec3, String> {
    let by = numbers(text, &[("X", ranges::SCALE), ("Y", ranges::SCALE), ("Z", ranges::SCALE)], 3)?;
    Ok(DVec3::new(by[0], by[1], by[2]))
}

/// `U,V` in tiles.
pub fn shift(text: &str) -> Result<DVec2, String> {
    let by = numbers(text, &[("U", ranges::SHIFT), ("V", ranges::SHIFT)], 2)?;
    Ok(DVec2::new(by[0], by[1]))
}

/// `STRENGTH,SHININESS`; the exponent may be left out.
pub fn specular(text: &str) -> Result<Specular, String> {
    let numbers = numbers(text, &[("STRENGTH", ranges::SHARE), ("SHININESS", ranges::SHININESS)], 1)?;
    Ok(Specular { strength: numbers[0], shininess: numbers.get(1).copied().unwrap_or(24.0) })
}

/// A light: `AZ,EL[,I]`, `at:X,Y,Z[,I]` or `spot:X,Y,Z,TX,TY,TZ,CUTOFF,EXPONENT[,I]`.
pub fn light(text: &str) -> Result<Light, String> {
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

/// A light as it is written.
pub fn written_light(light: &Light) -> String {
    let (prefix, mut numbers) = match light.kind {
        LightKind::Directional { direction } => {
            let to_light = -direction.normalize_or(DVec3::NEG_Y);
            let around = to_light.x.atan2(to_light.z).to_degrees();
            let above = to_light.y.atan2(to_light.x.hypot(to_light.z)).to_degrees();
            // Angles that somebody wrote are short.
            let short = [around, above].map(|angle| (angle * 1e6).round() / 1e6);
            let is_exact = Light::from_angles(short[0], short[1]).kind == light.kind;
            ("", if is_exact { short.to_vec() } else { vec![around, above] })
        }
        LightKind::Positional { position } => ("at:", position.to_array().to_vec()),
        LightKind::Spot { position, direction, cutoff_deg, exponent } => {
            let target = position + direction;
            ("spot:", [&position.to_array()[..], &target.to_array(), &[cutoff_deg, exponent]].concat())
        }
    };
    if light.intensity != 1.0 {
        numbers.push(light.intensity);
    }
    format!("{prefix}{}", Given::Numbers(numbers))
}

/// A colour as CSS writes it, or red, green and blue in linear light, 0 to 1.
pub fn colour(text: &str) -> Result<Colour, String> {
    if !text.contains('(') && text.contains(',') {
        let rgb = numbers(text, &[("R", ranges::SHARE), ("G", ranges::SHARE), ("B", ranges::SHARE)], 3)?;
        return Ok(Colour([rgb[0] as f32, rgb[1] as f32, rgb[2] as f32]));
    }
    let colour = csscolorparser::parse(text).map_err(|error| format!("it is no CSS colour: {error}"))?;
    let [r, g, b, _] = colour.to_linear_rgba();
    Ok(Colour([r, g, b]))
}

/// A colour as it is written: as CSS has it where that is exact.
pub fn written_colour(colour: &Colour) -> Given {
    let [r, g, b] = colour.0;
    let css = csscolorparser::Color::from_linear_rgba(r, g, b, 1.0).to_css_hex().to_string();
    match self::colour(&css) {
        Ok(read) if read == *colour => Given::Text(css),
        // The shortest numbers that are read as these.
        _ => Given::Numbers(colour.0.map(|part| part.to_string().parse().unwrap_or_default()).to_vec()),
    }
}

/// `X,Y,Z[,TURN[,SCALE]]`: world units, degrees, a factor.
pub fn place(text: &str) -> Result<Place, String> {
    let at = [("X", ranges::COORDINATE), ("Y", ranges::COORDINATE), ("Z", ranges::COORDINATE)];
    let turned = [("TURN", ranges::AZIMUTH_DEG), ("SCALE", ranges::SCALE)];
    let n = numbers(text, &[&at[..], &turned].concat(), 3)?;
    Ok(Place {
        translation: DVec3::new(n[0], n[1], n[2]),
        turn_deg: n.get(3).copied().unwrap_or(0.0),
        scale: n.get(4).copied().unwrap_or(1.0),
    })
}

/// What strokes follow.
pub fn field(text: &str) -> Result<FieldEntry, String> {
    match text {
        "curvature" => return Ok(FieldEntry::Curvature),
        "lower" => return Ok(FieldEntry::Lower),
        "light" => return Ok(FieldEntry::Light),
        "uv" => return Ok(FieldEntry::Uv),
        _ => {}
    }
    if let Some(file) = text.strip_prefix("guides:") {
        return if file.is_empty() { Err("guides: needs a file".into()) } else { Ok(FieldEntry::Guides(file.into())) };
    }
    if text.contains(',') {
        let direction = point(text)?;
        return if direction.length() > 0.0 {
            Ok(FieldEntry::Along(direction))
        } else {
            Err("0,0,0 is no direction".into())
        };
    }
    Err("allowed: curvature, lower, light, uv, a direction X,Y,Z, or guides:FILE".into())
}

/// `NAME[,PHASE]`.
pub fn deformed(text: &str) -> Result<Deformed, String> {
    let (name, phase) = text.split_once(',').unwrap_or((text, "0.25"));
    let phase = number(phase, ranges::PHASE)?;
    let deform = Deform::named(name).ok_or_else(|| unknown("deformation", name, Deform::ALL.map(Deform::name)))?;
    Ok(Deformed { deform, phase })
}

/// What is said about a name that is none of those known.
pub fn unknown<'a>(what: &str, name: &str, known: impl IntoIterator<Item = &'a str> + Clone) -> String {
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
        assert_eq!(orbit("right,3"), Ok(Orbit { azimuth_deg: 90.0, elevation_deg: 0.0, distance: Some(3.0) }));
        assert!(orbit("frnt").expect_err("no such view").contains("did you mean `front`?"));
        assert!(orbit("top,-1").expect_err("no distance").contains("DIST"));
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
        for text in ["-40,45", "at:1,2,3,0.5", "spot:0,2,0,0,0,0,25,4,0.8", "120,-60.5,0.25"] {
            let read = light(text).expect("a light");
            let again = light(&written_light(&read)).expect("what was written");
            assert_eq!(again.shared(), read.shared(), "{text}");
        }
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
        for text in ["#ffffff", "#4a2f1b", "0.1,0.25,0.9"] {
            let read = colour(text).expect("a colour");
            assert_eq!(written_colour(&read).to_string(), text);
        }
        assert_eq!(colour("white"), Ok(Colour([1.0; 3])));
    }

    #[test]
    fn places_are_moved_turned_and_scaled() {
        let at = place("1,2,3,90,2").expect("a place");
        let nose = at.world_from_mesh().transform_point3(DVec3::Z);
        assert!(nose.distance(DVec3::new(3.0, 2.0, 3.0)) < 1e-12, "{nose}");
        assert_eq!(place("0,1,0").expect("a place").scale, 1.0);
        for (wrong, said) in [("0,1", "X,Y,Z"), ("0,0,0,0,0", "SCALE"), ("0,0,0,0,-1", "0.01 to 100"), ("x,0,0", "X")] {
            assert!(place(wrong).expect_err("no place").contains(said), "{wrong}");
        }
    }
}
