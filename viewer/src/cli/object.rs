//! `--object NAME:key=value,…`: what differs for one object of the mesh.

use std::path::PathBuf;

use glam::DVec2;
use tam_gen::command::Failure;
use tam_gen::preset::nearest;
use tam_viewer::Material;
use tam_viewer::mesh::Part;
use tam_viewer::ranges;

use super::parse::{self, Colour, Specular};

const KEYS: [&str; 6] = ["map", "colour", "rotate", "scale", "shift", "specular"];

/// What differs for one object.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct ObjectArg {
    /// The object's name.
    pub(super) name: String,
    /// Its own map.
    pub(super) map: Option<PathBuf>,
    colour: Option<Colour>,
    rotate_deg: Option<f64>,
    scale: Option<f64>,
    shift: Option<DVec2>,
    specular: Option<Specular>,
}

/// Reads `NAME:key=value,…`; a value may itself have commas.
pub(super) fn object(text: &str) -> Result<ObjectArg, String> {
    let expected = "expected: NAME:key=value,… with the keys map, colour, rotate, scale, shift, specular";
    // Names and paths may have colons too: the last one before the first key counts.
    let key_end = text.find('=').ok_or(expected)?;
    let name_end = text[..key_end].rfind(':').ok_or(expected)?;
    let (name, settings) = (&text[..name_end], &text[name_end + 1..]);
    let mut object = ObjectArg { name: name.into(), ..ObjectArg::default() };
    let mut pairs: Vec<(&str, String)> = Vec::new();
    for piece in settings.split(',') {
        match (piece.split_once('='), pairs.last_mut()) {
            (Some((key, value)), _) => pairs.push((key.trim(), value.trim().into())),
            (None, Some((_, value))) => *value += &format!(",{piece}"),
            (None, None) => return Err(expected.into()),
        }
    }
    for (key, value) in &pairs {
        let value = value.as_str();
        let set = match *key {
            "map" => {
                object.map = Some(value.into());
                Ok(())
            }
            "colour" | "color" => parse::colour(value).map(|colour| object.colour = Some(colour)),
            "rotate" => parse::in_range(ranges::AZIMUTH_DEG)(value).map(|angle| object.rotate_deg = Some(angle)),
            "scale" => parse::in_range(ranges::SCALE)(value).map(|scale| object.scale = Some(scale)),
            "shift" => parse::shift(value).map(|shift| object.shift = Some(shift)),
            "specular" => parse::specular(value).map(|specular| object.specular = Some(specular)),
            other => Err(parse::unknown("setting", other, KEYS)),
        };
        set.map_err(|problem| format!("{key}: {problem}"))?;
    }
    Ok(object)
}

impl ObjectArg {
    /// Changes the materials of the objects of its name; `map` is the number of its own map.
    ///
    /// # Errors
    /// No object is called so.
    pub(super) fn apply(&self, parts: &[Part], materials: &mut [Material], map: Option<usize>) -> Result<(), Failure> {
        let mut found = false;
        for (part, material) in parts.iter().zip(materials).filter(|(part, _)| part.name == self.name) {
            found |= part.name == self.name;
            material.map = map.unwrap_or(material.map);
            material.colour = self.colour.map_or(material.colour, |colour| colour.0);
            material.rotation_deg += self.rotate_deg.unwrap_or(0.0);
            material.scale *= self.scale.unwrap_or(1.0);
            material.shift += self.shift.unwrap_or(DVec2::ZERO);
            if let Some(specular) = self.specular {
                (material.specular, material.shininess) = (specular.strength, specular.shininess);
            }
        }
        if found { Ok(()) } else { Err(unknown(&self.name, parts)) }
    }
}

fn unknown(name: &str, parts: &[Part]) -> Failure {
    let mut names: Vec<&str> = parts.iter().map(|part| part.name.as_str()).filter(|name| !name.is_empty()).collect();
    names.dedup();
    let meant = nearest(name, names.iter().copied()).map_or(String::new(), |meant| format!("did you mean `{meant}`? "));
    let listed = if names.is_empty() { "its objects have no names".to_owned() } else { names.join(", ") };
    Failure::usage(format!("no object of the mesh is called `{name}`"), format!("{meant}there are: {listed}"))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn part(name: &str) -> Part {
        Part { name: name.into(), colour: [1.0; 3], triangles: 0..1 }
    }

    #[test]
    fn values_may_have_commas() {
        let seat = object("the seat:shift=0.25,-0.5,rotate=30,specular=0.5,40").expect("an object");
        assert_eq!(
            (seat.name.as_str(), seat.shift, seat.rotate_deg),
            ("the seat", Some(DVec2::new(0.25, -0.5)), Some(30.0))
        );
        assert_eq!(seat.specular, Some(Specular { strength: 0.5, shininess: 40.0 }));
        let mut materials = [Material::default(), Material { scale: 2.0, ..Material::default() }];
        let parts = [part("legs"), part("the seat")];
        seat.apply(&parts, &mut materials, Some(1)).expect("found");
        assert_eq!(materials[0], Material::default());
        assert_eq!((materials[1].map, materials[1].rotation_deg, materials[1].scale), (1, 30.0, 2.0));
    }

    #[test]
    fn what_makes_no_sense_is_named() {
        for (wrong, expected) in [
            ("seat", "NAME:key=value"),
            ("seat:size=2", "size"),
            ("seat:scale=-1", "0.01 to 100"),
            ("seat:rotat=3", "`rotate`"),
        ] {
            let problem = object(wrong).expect_err("no sense");
            assert!(problem.contains(expected), "{problem}");
        }
        let failure =
            object("seet:rotate=3").expect("an object").apply(&[part("seat")], &mut [Material::default()], None);
        assert!(matches!(failure, Err(Failure::Usage { help: Some(help), .. }) if help.contains("`seat`")));
    }
}
