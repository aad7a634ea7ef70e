//! Scenes as TOML, and as the options of a command.

use toml::{Table, Value};

use super::SceneFile;
use super::value::written_light;
use super::word::Given;

impl SceneFile {
    /// The scene as TOML; reading it back gives the same scene.
    pub fn to_toml(&self) -> String {
        let Self { view, look, objects } = self;
        let mut top = Table::new();
        extend(&mut top, view.given());
        if !view.lights.is_empty() {
            let lights = view.lights.iter().map(|light| Value::String(written_light(light)));
            top.insert("light".into(), Value::Array(lights.collect()));
        }
        extend(&mut top, look.given());
        let mut text = top.to_string();
        for object in objects {
            let mut table = Table::new();
            extend(&mut table, object.given());
            extend(&mut table, object.look.given());
            let mut parts = Table::new();
            for (name, part) in &object.parts {
                let mut words = Table::new();
                extend(&mut words, part.given());
                extend(&mut words, part.look.given());
                parts.insert(name.clone(), Value::Table(words));
            }
            if !parts.is_empty() {
                table.insert("part".into(), Value::Table(parts));
            }
            let list = Table::from_iter([("object".to_owned(), Value::Array(vec![Value::Table(table)]))]);
            text += "\n";
            text += &list.to_string();
        }
        text
    }

    /// The scene as options of `tam-viewer render`, two for each: the name, and its value.
    pub fn to_options(&self) -> Vec<(String, String)> {
        let Self { view, look, objects } = self;
        let option = |(name, given): (&str, Given)| match given {
            // On the command line these stand without a value, and off where they are not named.
            Given::Switch(on) => on.then(|| (format!("--{name}"), String::new())),
            given => Some((format!("--{name}"), given.to_string())),
        };
        let mut options: Vec<(String, String)> = Vec::new();
        for object in objects {
            options.push(("--mesh".into(), object.mesh.display().to_string()));
        }
        options.extend(view.given().filter_map(option));
        options.extend(view.lights.iter().map(|light| ("--light".into(), written_light(light))));
        let (plain, own): (Vec<_>, Vec<_>) = look.given().partition(|(name, _)| OPTIONS.contains(name));
        options.extend(plain.into_iter().filter_map(option));
        for object in objects {
            if let Some(place) = object.given().find(|(name, _)| *name == "place") {
                options.push(("--place".into(), format!("{}:{}", object.name, place.1)));
            }
            let words: Vec<_> = own.iter().cloned().chain(object.look.given()).collect();
            push_object(&mut options, &object.name, &words);
            for (name, part) in &object.parts {
                let name = format!("{}/{name}", object.name);
                if let Some(place) = part.given().next() {
                    options.push(("--place".into(), format!("{name}:{}", place.1)));
                }
                push_object(&mut options, &name, &part.look.given().collect::<Vec<_>>());
            }
        }
        options
    }
}

/// Words of a look that are options of their own; the others are said of each object.
const OPTIONS: [&str; 24] = [
    "method",
    "mapping",
    "form",
    "blend",
    "map",
    "tiles",
    "rotate",
    "scale",
    "shift",
    "level-bias",
    "slope",
    "line-period",
    "cross",
    "variety",
    "lines",
    "crease",
    "field",
    "smoothing",
    "stripes",
    "follow",
    "planar",
    "ink",
    "specular",
    "colours",
];

fn push_object(options: &mut Vec<(String, String)>, name: &str, words: &[(&str, Given)]) {
    if !words.is_empty() {
        let pairs: Vec<String> = words.iter().map(|(word, given)| format!("{word}={given}")).collect();
        options.push(("--object".into(), format!("{name}:{}", pairs.join(","))));
    }
}

fn extend(table: &mut Table, given: impl Iterator<Item = (&'static str, Given)>) {
    table.extend(given.map(|(name, given)| (name.to_owned(), toml_value(given))));
}

fn toml_value(given: Given) -> Value {
    match given {
        Given::Number(number) => toml_number(number),
        Given::Numbers(numbers) => Value::Array(numbers.into_iter().map(toml_number).collect()),
        Given::Text(text) => Value::String(text),
        Given::Switch(on) => Value::Boolean(on),
    }
}

/// Whole numbers without a point.
fn toml_number(number: f64) -> Value {
    if number.fract() == 0.0 && number.abs() < 1e9 { Value::Integer(number as i64) } else { Value::Float(number) }
}
