//! `--object NAME:key=value,…` and `--place NAME:…`: what is said of one object, or of one part of a mesh.

use tam_gen::command::Failure;
use tam_gen::preset::nearest;
use tam_viewer::mesh::Mesh;
use tam_viewer::scene_file::value::unknown;
use tam_viewer::scene_file::{LookEntry, ObjectEntry, SceneFile, part_numbers};

/// What is said of one object or part.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct ObjectArg {
    /// Its name.
    pub(super) name: String,
    /// What is said.
    pub(super) settings: Settings,
}

/// Words for one object or part.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct Settings {
    /// Place and count of triangles.
    object: ObjectEntry,
    /// How it is drawn.
    look: LookEntry,
}

/// Words of objects that options can set: their meshes are given before.
fn own_words() -> impl Iterator<Item = &'static str> {
    ObjectEntry::WORDS.iter().map(|word| word.name).filter(|name| !["name", "mesh"].contains(name))
}

/// Whether something can be said of an object or a part by this word.
fn is_word(key: &str) -> bool {
    key == "color" || own_words().chain(LookEntry::WORDS.iter().map(|word| word.name)).any(|word| word == key)
}

/// Reads `NAME:key=value,…`; a value may itself have commas.
pub(super) fn object(text: &str) -> Result<ObjectArg, String> {
    let expected = "expected: NAME:key=value,… with keys such as method, mapping, map, ink, colour, rotate, visible";
    // Names and paths may have colons too: the first one before a key counts, or else the last one before anything like it.
    let is_key = |at: &usize| text[at + 1..].split_once('=').is_some_and(|(key, _)| is_word(key.trim()));
    let before_key = text.match_indices(':').map(|(at, _)| at).find(is_key);
    let key_end = text.find('=').ok_or(expected)?;
    let name_end = before_key.or_else(|| text[..key_end].rfind(':')).ok_or(expected)?;
    let (name, words) = (&text[..name_end], &text[name_end + 1..]);
    let mut arg = ObjectArg { name: name.into(), ..ObjectArg::default() };
    let mut pairs: Vec<(&str, String)> = Vec::new();
    for piece in words.split(',') {
        match (piece.split_once('='), pairs.last_mut()) {
            (Some((key, value)), _) => pairs.push((key.trim(), value.trim().into())),
            (None, Some((_, value))) => *value += &format!(",{piece}"),
            (None, None) => return Err(expected.into()),
        }
    }
    let Settings { object, look } = &mut arg.settings;
    for (key, value) in &pairs {
        let set = if own_words().any(|word| word == *key) {
            object.set(key, value)
        } else if is_word(key) {
            look.set(key, value)
        } else {
            let known: Vec<&str> = own_words().chain(LookEntry::WORDS.iter().map(|word| word.name)).collect();
            return Err(unknown("setting", key, known));
        };
        set.map_err(|problem| format!("{key}: {problem}"))?;
    }
    Ok(arg)
}

/// Reads `NAME:X,Y,Z[,TURN[,SCALE]]`.
pub(super) fn place(text: &str) -> Result<ObjectArg, String> {
    let (name, place) = text.rsplit_once(':').ok_or("expected: NAME:X,Y,Z[,TURN[,SCALE]]")?;
    let mut arg = ObjectArg { name: name.into(), ..ObjectArg::default() };
    arg.settings.object.set("place", place)?;
    Ok(arg)
}

impl Settings {
    /// Whether it says how many triangles a sample has, which is needed before it is made.
    fn counts_triangles(&self) -> bool {
        self.object.triangles.is_some()
    }

    /// Says it of the object of this name, if there is one.
    fn say(&self, name: &str, file: &mut SceneFile) -> bool {
        let Some(object) = file.objects.iter_mut().find(|object| object.name == name) else { return false };
        object.place = self.object.place.or(object.place);
        object.stretch = self.object.stretch.or(object.stretch);
        object.triangles = self.object.triangles.or(object.triangles);
        object.look = self.look.over(&object.look);
        true
    }
}

/// Says of objects how many triangles they have.
///
/// # Errors
/// No object is called so.
pub(super) fn count<'a>(
    file: &mut SceneFile,
    settings: impl Iterator<Item = (&'a str, &'a Settings)>,
) -> Result<(), Failure> {
    for (name, said) in settings.filter(|(_, said)| said.counts_triangles()) {
        match file.objects.iter_mut().find(|object| object.name == name) {
            Some(object) => object.triangles = said.object.triangles,
            None => return Err(unknown_name(name, file, &[])),
        }
    }
    Ok(())
}

/// Says of objects and parts what options say of them: of the object of that name, else of the part `OBJECT/PART`, else of
/// every part of that name.
///
/// # Errors
/// Nothing is called so.
pub(super) fn say<'a>(
    file: &mut SceneFile,
    settings: impl Iterator<Item = (&'a str, &'a Settings)>,
    meshes: &[&Mesh],
) -> Result<(), Failure> {
    for (name, said) in settings {
        if said.say(name, file) {
            continue;
        }
        let mut found = false;
        for (object, mesh) in file.objects.iter_mut().zip(meshes) {
            let inner = name.strip_prefix(object.name.as_str()).and_then(|rest| rest.strip_prefix('/'));
            let part =
                [inner, Some(name)].into_iter().flatten().find(|name| !part_numbers(name, &mesh.parts).is_empty());
            if let Some(part) = part {
                let entry = object.parts.entry(part.to_owned()).or_default();
                entry.place = said.object.place.or(entry.place);
                entry.look = said.look.over(&entry.look);
                found = true;
            }
        }
        if !found {
            return Err(unknown_name(name, file, meshes));
        }
        if said.object.stretch.is_some() || said.counts_triangles() {
            return Err(Failure::usage(
                format!("`{name}` is a part of a mesh, which has neither triangles nor a stretch of its own"),
                "say it of the object",
            ));
        }
    }
    Ok(())
}

/// Names that are listed when one is not known.
const LISTED: usize = 24;

fn unknown_name(name: &str, file: &SceneFile, meshes: &[&Mesh]) -> Failure {
    let objects = file.objects.iter().map(|object| object.name.as_str());
    let parts = meshes.iter().flat_map(|mesh| &mesh.parts).map(|part| part.name.as_str());
    let mut names: Vec<&str> = Vec::new();
    for known in objects.chain(parts).filter(|name| !name.is_empty()) {
        if !names.contains(&known) && names.len() <= LISTED {
            names.push(known);
        }
    }
    let meant = nearest(name, names.iter().copied()).map_or(String::new(), |meant| format!("did you mean `{meant}`? "));
    let more = if names.len() > LISTED { ", …" } else { "" };
    names.truncate(LISTED);
    Failure::usage(
        format!("no object, and no part of one, is called `{name}`"),
        format!("{meant}there are: {}{more}", names.join(", ")),
    )
}

#[cfg(test)]
mod tests {
    use glam::DVec2;
    use tam_viewer::mesh::prepare;
    use tam_viewer::mesh::sample::Sample;
    use tam_viewer::scene_file::value::Specular;

    use super::*;

    #[test]
    fn values_may_have_commas() {
        let seat = object("the seat:shift=0.25,-0.5,rotate=30,specular=0.5,40").expect("an object");
        let look = &seat.settings.look;
        assert_eq!(
            (seat.name.as_str(), look.shift, look.rotate_deg),
            ("the seat", Some(DVec2::new(0.25, -0.5)), Some(30.0))
        );
        assert_eq!(look.specular, Some(Specular { strength: 0.5, shininess: 40.0 }));
        let odd = object("a=b:c:rotate=3,map=C:/x.toml").expect("an object");
        assert_eq!((odd.name.as_str(), odd.settings.look.rotate_deg), ("a=b:c", Some(3.0)));
        let place = place("C:/a:1,2,3,90").expect("a place");
        assert_eq!((place.name.as_str(), place.settings.object.place.map(|at| at.turn_deg)), ("C:/a", Some(90.0)));
    }

    #[test]
    fn what_makes_no_sense_is_named() {
        for (wrong, expected) in [
            ("seat", "NAME:key=value"),
            ("seat:size=2", "size"),
            ("seat:scale=-1", "0.01 to 100"),
            ("seat:rotat=3", "`rotate`"),
            ("seat:place=0,0,0,0,0", "SCALE"),
            ("seat:mesh=cube", "mesh"),
        ] {
            let problem = object(wrong).expect_err("no sense");
            assert!(problem.contains(expected), "{problem}");
        }
    }

    #[test]
    fn objects_go_before_parts_and_names_that_are_none_bring_the_nearest() {
        let chair = prepare(Sample::Chair.build(3000)).expect("a chair").mesh;
        let objects = vec![ObjectEntry::of("chair", None), ObjectEntry::of("chair", None)];
        let mut file = SceneFile { objects, ..SceneFile::default() };
        file.name_objects();
        let said = |file: &mut SceneFile, texts: &[&str]| {
            let args: Vec<ObjectArg> = texts.iter().map(|text| object(text).expect("it makes sense")).collect();
            say(file, args.iter().map(|arg| (arg.name.as_str(), &arg.settings)), &[&chair, &chair])
        };
        said(&mut file, &["chair-2:rotate=10", "seat:rotate=20", "chair/top rail:rotate=30"]).expect("they are there");
        assert_eq!((file.objects[0].look.rotate_deg, file.objects[1].look.rotate_deg), (None, Some(10.0)));
        assert!(file.objects.iter().all(|object| object.parts["seat"].look.rotate_deg == Some(20.0)));
        assert_eq!((file.objects[0].parts.len(), file.objects[1].parts.len()), (2, 1));
        let failure = said(&mut file, &["seet:rotate=3"]);
        assert!(matches!(failure, Err(Failure::Usage { help: Some(help), .. }) if help.contains("`seat`")));
    }
}
