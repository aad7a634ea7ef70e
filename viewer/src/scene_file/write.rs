//! Scenes as TOML, and as the options of a command.

use toml::Value;

use super::SceneFile;
use super::value::written_light;
use super::word::Given;

impl SceneFile {
    /// The scene as TOML; reading it back gives the same scene.
    pub fn to_toml(&self) -> String {
        let Self { view, look, objects } = self;
        let mut text = lines(view.given());
        if !view.lights.is_empty() {
            let lights = view.lights.iter().map(|light| Value::String(written_light(light)));
            text += &format!("light = {}\n", Value::Array(lights.collect()));
        }
        text += &lines(look.given());
        for object in objects {
            text += &format!("\n[[object]]\n{}{}", lines(object.given()), lines(object.look.given()));
            for (name, part) in &object.parts {
                let key = Value::String(name.clone());
                text += &format!("[object.part.{key}]\n{}{}", lines(part.given()), lines(part.look.given()));
            }
        }
        text
    }

    /// The scene as options of `tam-viewer render`: names, and values, which are empty where an option stands alone.
    /// Objects are called as the command calls them, by their meshes.
    pub fn to_options(&self) -> Vec<(String, String)> {
        let mut file = self.clone();
        file.objects.iter_mut().for_each(|object| object.name.clear());
        file.name_objects();
        let Self { view, look, objects } = &file;
        let option = |(name, given): (&str, Given)| match given {
            // On the command line these stand without a value, and off where they are not named.
            Given::Switch(on) => on.then(|| (format!("--{name}"), String::new())),
            given => Some((format!("--{name}"), given.to_string())),
        };
        let mut options: Vec<(String, String)> = Vec::new();
        options.extend(objects.iter().map(|object| ("--mesh".into(), object.mesh.display().to_string())));
        options.extend(view.given().filter_map(option));
        options.extend(view.lights.iter().map(|light| ("--light".into(), written_light(light))));
        let (of_all, of_each): (Vec<_>, Vec<_>) = look.given().partition(|(name, _)| !ONLY_OF_OBJECTS.contains(name));
        options.extend(of_all.into_iter().filter_map(option));
        for object in objects {
            let own = object.given().filter(|(word, _)| ["triangles", "stretch"].contains(word));
            let words = own.chain(of_each.iter().cloned()).chain(object.look.given());
            push(&mut options, &object.name, object.given(), words);
            for (name, part) in &object.parts {
                push(&mut options, &format!("{}/{name}", object.name), part.given(), part.look.given());
            }
        }
        options
    }
}

/// Words of looks that are no options of their own.
const ONLY_OF_OBJECTS: [&str; 6] = ["contours", "borders", "guides", "colour", "lit", "visible"];

/// Options for one object or part: its place among `placed`, and the words of its look.
fn push(
    options: &mut Vec<(String, String)>,
    name: &str,
    mut placed: impl Iterator<Item = (&'static str, Given)>,
    words: impl Iterator<Item = (&'static str, Given)>,
) {
    if let Some((_, place)) = placed.find(|(word, _)| *word == "place") {
        options.push(("--place".into(), format!("{name}:{place}")));
    }
    let pairs: Vec<String> = words.map(|(word, given)| format!("{word}={given}")).collect();
    if !pairs.is_empty() {
        options.push(("--object".into(), format!("{name}:{}", pairs.join(","))));
    }
}

fn lines(given: impl Iterator<Item = (&'static str, Given)>) -> String {
    given.map(|(name, given)| format!("{name} = {}\n", toml_value(given))).collect()
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
