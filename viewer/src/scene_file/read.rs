//! Scene files from TOML: everything that is wrong with one, by line and column.

use std::path::Path;

use tam_gen::files::{TextError, read_text};
use tam_gen::problems::{FileError, PROBLEMS_MAX, Problem, syntax_problem};
use toml::Spanned;
use toml::de::{DeTable, DeValue};

use super::object::PartEntry;
use super::value::{self, unknown};
use super::view::ViewEntry;
use super::word::Word;
use super::{LookEntry, OBJECTS_MAX, ObjectEntry, SCENE_BYTES_MAX, SceneFile};
use crate::scene::MAX_LIGHTS;

impl SceneFile {
    /// Reads a scene from TOML text; `origin` is what errors call the text. Paths stay as they are written.
    ///
    /// # Errors
    /// Everything that is wrong with it: syntax, unknown keys, values that make no sense, names that are taken.
    pub fn from_toml(source: &str, origin: &str) -> Result<Self, FileError> {
        let (table, errors) = DeTable::parse_recoverable(source);
        let refuse = |problems| Err(FileError::new(origin, source, problems));
        if !errors.is_empty() {
            return refuse(errors.iter().take(PROBLEMS_MAX).map(|error| syntax_problem(source, error)).collect());
        }
        let mut reading = Reading { source, problems: Vec::new() };
        let file = reading.scene(table.get_ref());
        if file.objects.is_empty() && reading.problems.is_empty() {
            let none = Problem::general("", "the scene has no objects");
            return refuse(vec![none.help("each is a table of its own: [[object]] with mesh = \"teapot\"".to_owned())]);
        }
        if reading.problems.is_empty() { Ok(file) } else { refuse(reading.problems) }
    }

    /// Reads a scene file; its paths are then seen from where the program runs, not from the file.
    ///
    /// # Errors
    /// As [`SceneFile::from_toml`], and if the file cannot be read or is larger than [`SCENE_BYTES_MAX`].
    pub fn load(path: impl AsRef<Path>) -> Result<Self, FileError> {
        let path = path.as_ref();
        let origin = path.display().to_string();
        let source =
            read_text(path, SCENE_BYTES_MAX).map_err(|error| FileError::new(&origin, "", vec![unread(error)]))?;
        let mut file = Self::from_toml(&source, &origin)?;
        file.found_from(path);
        Ok(file)
    }
}

fn unread(error: TextError) -> Problem {
    let message = match error {
        TextError::TooLarge(bytes) => {
            format!("the scene is larger than {} MiB: this is probably another file", bytes >> 20)
        }
        TextError::NotText(_) => format!("the scene is not text: {error}"),
        TextError::Folder | TextError::Io(_) => format!("cannot read the scene: {error}"),
    };
    Problem::general("", message)
}

struct Reading<'s> {
    source: &'s str,
    problems: Vec<Problem>,
}

type Key<'t, 'i> = &'t Spanned<std::borrow::Cow<'i, str>>;
type Value<'t, 'i> = &'t Spanned<DeValue<'i>>;

impl Reading<'_> {
    fn scene(&mut self, table: &DeTable<'_>) -> SceneFile {
        let mut file = SceneFile::default();
        for (key, value) in table {
            match key.get_ref().as_ref() {
                "object" => self.objects(value, &mut file.objects),
                "light" => self.lights(value, &mut file.view),
                name if ViewEntry::WORDS.iter().any(|word| word.name == name) => {
                    self.set(name, key, value, |text| Word::set(ViewEntry::WORDS, &mut file.view, name, text));
                }
                name if is_look(name) => self.set(name, key, value, |text| file.look.set(name, text)),
                name => {
                    let own = ViewEntry::WORDS.iter().map(|word| word.name).chain(["light", "object"]);
                    self.unknown(name, key, own.chain(look_names()).collect());
                }
            }
        }
        file
    }

    fn objects(&mut self, value: Value<'_, '_>, objects: &mut Vec<ObjectEntry>) {
        let Some(array) = value.get_ref().as_array() else {
            self.wrong("object", value.span(), "objects are tables of a list", "[[object]]");
            return;
        };
        if array.len() > OBJECTS_MAX {
            let found = format!("the scene has {} objects", array.len());
            self.wrong("object", value.span(), found, format!("at most {OBJECTS_MAX} are drawn"));
            return;
        }
        let mut names = std::collections::HashSet::new();
        for (index, item) in array.iter().enumerate() {
            if self.is_full() {
                return;
            }
            let at = format!("object[{index}]");
            let Some(table) = item.get_ref().as_table() else {
                self.wrong(&at, item.span(), "an object is a table", "[[object]]");
                continue;
            };
            let object = self.object(&at, table);
            if object.mesh.as_os_str().is_empty() {
                self.wrong(&at, item.span(), "the object has no mesh", "mesh = a sample's name, or a file");
            }
            if !object.name.is_empty() && !names.insert(object.name.clone()) {
                let span = table.get("name").map_or(item.span(), Spanned::span);
                self.wrong(&at, span, format!("two objects are called `{}`", object.name), "a name of its own");
            }
            objects.push(object);
        }
    }

    fn object(&mut self, at: &str, table: &DeTable<'_>) -> ObjectEntry {
        let mut object = ObjectEntry::default();
        for (key, value) in table {
            let name = key.get_ref().as_ref();
            let at = format!("{at}.{name}");
            if name == "part" {
                self.parts(&at, value, &mut object);
            } else if ObjectEntry::WORDS.iter().any(|word| word.name == name) {
                self.set(&at, key, value, |text| Word::set(ObjectEntry::WORDS, &mut object, name, text));
            } else if is_look(name) {
                self.set(&at, key, value, |text| object.look.set(name, text));
            } else {
                let own = ObjectEntry::WORDS.iter().map(|word| word.name).chain(["part"]);
                self.unknown(&at, key, own.chain(look_names()).collect());
            }
        }
        object
    }

    fn parts(&mut self, at: &str, value: Value<'_, '_>, object: &mut ObjectEntry) {
        let Some(table) = value.get_ref().as_table() else {
            self.wrong(at, value.span(), "parts are tables by their names", "[object.part.NAME]");
            return;
        };
        for (part, value) in table {
            let at = format!("{at}.{}", part.get_ref());
            let Some(words) = value.get_ref().as_table() else {
                self.wrong(&at, value.span(), "a part is a table", "[object.part.NAME]");
                continue;
            };
            let mut entry = PartEntry::default();
            for (key, value) in words {
                let name = key.get_ref().as_ref();
                let at = format!("{at}.{name}");
                if PartEntry::WORDS.iter().any(|word| word.name == name) {
                    self.set(&at, key, value, |text| Word::set(PartEntry::WORDS, &mut entry, name, text));
                } else if is_look(name) {
                    self.set(&at, key, value, |text| entry.look.set(name, text));
                } else {
                    let own = PartEntry::WORDS.iter().map(|word| word.name);
                    self.unknown(&at, key, own.chain(look_names()).collect());
                }
            }
            object.parts.insert(part.get_ref().to_string(), entry);
        }
    }

    fn lights(&mut self, value: Value<'_, '_>, view: &mut ViewEntry) {
        let items: Vec<Value<'_, '_>> = match value.get_ref().as_array() {
            // A list of numbers is one light.
            Some(array) if array.iter().all(|item| item.get_ref().as_array().is_some() || item.get_ref().is_str()) => {
                array.iter().collect()
            }
            _ => vec![value],
        };
        if items.len() > MAX_LIGHTS {
            let found = format!("{} lights are given", items.len());
            self.wrong("light", value.span(), found, format!("at most {MAX_LIGHTS} are drawn"));
            return;
        }
        for item in items {
            match text_of(item.get_ref()).and_then(|text| value::light(&text)) {
                Ok(light) => view.lights.push(light),
                Err(problem) => self.wrong("light", item.span(), format!("light: {problem}"), LIGHT),
            }
        }
    }

    /// Sets a word, or says what is wrong with its value.
    fn set(&mut self, at: &str, key: Key<'_, '_>, value: Value<'_, '_>, set: impl FnOnce(&str) -> Result<(), String>) {
        if let Err(problem) = text_of(value.get_ref()).and_then(|text| set(&text)) {
            self.wrong(at, value.span(), format!("{}: {problem}", key.get_ref()), "");
        }
    }

    fn unknown(&mut self, at: &str, key: Key<'_, '_>, known: Vec<&'static str>) {
        self.wrong(at, key.span(), unknown("setting", key.get_ref(), known), "");
    }

    fn wrong(
        &mut self,
        at: &str,
        span: std::ops::Range<usize>,
        problem: impl Into<String>,
        expected: impl Into<String>,
    ) {
        if !self.is_full() {
            self.problems.push(Problem::general(at, problem).at_span(self.source, span).expected(expected));
        }
    }

    fn is_full(&self) -> bool {
        self.problems.len() >= PROBLEMS_MAX
    }
}

/// How lights are written.
pub(super) const LIGHT: &str =
    "AZ,EL[,INTENSITY] from far, at:X,Y,Z[,I] from a point, spot:X,Y,Z,TX,TY,TZ,CUTOFF_DEG,EXPONENT[,I]";

fn is_look(name: &str) -> bool {
    name == "color" || look_names().any(|known| known == name)
}

fn look_names() -> impl Iterator<Item = &'static str> {
    LookEntry::WORDS.iter().map(|word| word.name)
}

/// A value as an option would have it.
fn text_of(value: &DeValue<'_>) -> Result<String, String> {
    match value {
        DeValue::String(text) => Ok(text.to_string()),
        DeValue::Integer(number) => Ok(number.to_string()),
        DeValue::Float(number) => Ok(number.to_string()),
        DeValue::Boolean(on) => Ok(on.to_string()),
        DeValue::Array(items) => {
            let texts: Result<Vec<String>, String> = items
                .iter()
                .map(|item| match item.get_ref() {
                    DeValue::Array(_) | DeValue::Table(_) => Err("a list of numbers is expected".to_owned()),
                    plain => text_of(plain),
                })
                .collect();
            texts.map(|texts| texts.join(","))
        }
        DeValue::Datetime(_) => Err("dates do not belong here".to_owned()),
        DeValue::Table(_) => Err("a table does not belong here".to_owned()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const SCENE: &str = r##"
camera = [40, 10, 6.5]
light = ["-30,60", "at:2,1,2,0.5"]
paper = "#faf4e6"
method = "six-way"
map = "pencil"

[[object]]
name = "left"
mesh = "chair"
place = [-1.2, 0, 0, 30]
[object.part.seat]
method = "stripes"
rotate = 30

[[object]]
mesh = "models/statue.glb"
place = "1.2,0,0,0,0.5"
ink = "#4a2f1b"
lines = "none"
visible = false
"##;

    #[test]
    fn a_scene_is_read_and_what_is_written_is_read_as_the_same() {
        let file = SceneFile::from_toml(SCENE, "scene.toml").expect("it makes sense");
        assert_eq!((file.view.lights.len(), file.objects.len()), (2, 2));
        assert_eq!(file.objects[0].parts["seat"].look.rotate_deg, Some(30.0));
        assert_eq!(file.objects[1].place.map(|place| place.scale), Some(0.5));
        assert!(!file.objects[1].look.is_visible());
        let written = file.to_toml();
        assert_eq!(SceneFile::from_toml(&written, "again").expect("what was written"), file, "{written}");
    }

    #[test]
    fn paths_are_seen_from_the_file_and_names_stay_names() {
        let folder = tempfile::tempdir().expect("a folder");
        let path = folder.path().join("scene.toml");
        std::fs::write(&path, SCENE).expect("it is written");
        let file = SceneFile::load(&path).expect("it makes sense");
        assert_eq!(file.objects[0].mesh, Path::new("chair"));
        assert_eq!(file.objects[1].mesh, folder.path().join("models/statue.glb"));
        assert_eq!(file.relative_to(folder.path()), SceneFile::from_toml(SCENE, "").expect("the same"));
    }

    #[test]
    fn everything_that_is_wrong_is_named_with_its_line_and_column() {
        let wrong = "metod = \"phong\"\nambient = 2\n[[object]]\nname = \"a\"\nmesh = \"chair\"\nplace = [0, 0]\n\
                     [[object]]\nname = \"a\"\n[object.part.seat]\nmapping = 3\nlight = 1979-05-27\n";
        let error = SceneFile::from_toml(wrong, "scene.toml").expect_err("much is wrong");
        let found: Vec<(Option<usize>, Option<usize>)> =
            error.problems.iter().map(|problem| (problem.line, problem.column)).collect();
        let lines: Vec<usize> = found.iter().filter_map(|(line, _)| *line).collect();
        assert_eq!(lines, [1, 2, 6, 7, 8, 10, 11], "{error}");
        let report = error.report(false);
        for words in
            ["did you mean `method`?", "0 to 1", "X,Y,Z", "no mesh", "two objects are called `a`", "scene.toml:1:1"]
        {
            assert!(report.contains(words), "{words}: {report}");
        }
    }

    #[test]
    fn what_is_no_scene_is_refused_in_a_sentence() {
        for (text, said) in [
            ("", "no objects"),
            ("= 3", "scene.toml:1"),
            ("object = 3", "[[object]]"),
            ("object = [3]", "an object is a table"),
            ("[[object]]\nmesh = \"\"", "mesh"),
            ("light = [\"sun\"]\n[[object]]\nmesh = \"cube\"", "light"),
        ] {
            let report = SceneFile::from_toml(text, "scene.toml").expect_err("no scene").report(false);
            assert!(report.contains(said), "{report}");
        }
        let many = "[[object]]\nmesh = \"cube\"\n".repeat(OBJECTS_MAX + 1);
        let error = SceneFile::from_toml(&many, "scene.toml").expect_err("too many");
        assert_eq!(error.problems.len(), 1);
        assert!(error.to_string().contains("20000"), "{error}");
    }
}
