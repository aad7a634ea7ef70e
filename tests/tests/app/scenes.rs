//! Scenes of several objects: chosen, placed, taken back, saved, opened, and drawn by the command line.

use egui_kittest::kittest::Queryable;
use glam::DVec3;
use tam_gen::Preset;
use tam_tests::app::Window;
use tam_tests::command::tam_viewer;
use tam_viewer::app::{Command, MeshSource, Severity, Standing};
use tam_viewer::mesh::sample::Sample;
use tam_viewer::scene_file::SceneFile;
use tam_viewer::{Mapping, Method};

use super::helpers::{difference, picture};

fn names(window: &Window) -> Vec<String> {
    window.app().state().document.objects().map(|object| object.name()).collect()
}

/// A teapot, with a cube beside it that has a look and a preset of its own.
fn two_objects() -> Window {
    let mut window = Window::ready();
    window.run(Command::SetMesh(MeshSource::Sample(Sample::Teapot, 3000)));
    window.run(Command::AddObject(Some(MeshSource::Sample(Sample::Chair, 3000))));
    let mut look = window.app().state().document.look.clone();
    (look.params.method, look.params.mapping) = (Method::FineTone, Mapping::Triplanar);
    window.run(Command::SetLook(Box::new(look)));
    window.run(Command::OpenShipped("fine-pen".to_owned()));
    window
}

/// The command on the clipboard after asking for it, as the words that a shell makes of it.
fn copied(window: &mut Window) -> Vec<String> {
    let ctx = window.harness.ctx.clone();
    window.harness.state_mut().run(&ctx, Command::CopyCommand);
    window.harness.step();
    let commands = &window.harness.output().platform_output.commands;
    let text = commands.iter().find_map(|command| match command {
        egui::OutputCommand::CopyText(text) => Some(text.clone()),
        _ => None,
    });
    shlex::split(&text.expect("a command was copied")).expect("a shell reads it")
}

#[test]
fn objects_are_chosen_by_a_click_placed_hidden_and_taken_back() {
    let mut window = two_objects();
    assert_eq!(names(&window), ["teapot", "chair"]);
    window.run(Command::FrameMesh);
    let framed = picture(&window);

    // A click on the left object chooses it, and changes no pixel.
    let view = window.harness.get_by_label("Picture of the mesh").rect();
    let on_teapot = view.center() - egui::vec2(view.width() * 0.2, 0.0);
    window.harness.hover_at(on_teapot);
    window.harness.step();
    window.harness.drag_at(on_teapot);
    window.harness.step();
    window.harness.drop_at(on_teapot);
    window.harness.step();
    window.settle();
    assert_eq!(window.app().state().document.chosen(), 0);
    assert_eq!(window.app().state().document.look.params.method, Method::SixWay);
    assert!(difference(&framed, &picture(&window)) < 1e-6, "choosing draws nothing anew");

    let hidden = Standing { visible: false, ..Standing::default() };
    window.run(Command::SetStanding(0, Box::new(hidden)));
    assert!(difference(&framed, &picture(&window)) > 0.02);
    window.harness.run_steps(10);
    window.run(Command::Undo);
    assert!(difference(&framed, &picture(&window)) < 1e-6);

    let mut standing = window.app().state().document.standing.clone();
    (standing.place.turn_deg, standing.place.translation) = (70.0, DVec3::new(0.0, 0.5, 0.0));
    window.run(Command::SetStanding(0, Box::new(standing)));
    assert!(difference(&framed, &picture(&window)) > 0.02);
    window.run(Command::DuplicateObject);
    window.run(Command::RemoveObject(1));
    assert_eq!(names(&window), ["teapot", "teapot"]);
    assert_eq!(window.app().results().meshes.iter().filter(|mesh| mesh.source.name() == "teapot").count(), 1);
    assert!(window.app().messages().iter().all(|message| message.severity != Severity::Error));
}

#[test]
fn saved_and_copied_scenes_are_drawn_by_the_command_line_as_the_window_shows_them() {
    let folder = tempfile::tempdir().expect("a folder");
    let mut window = two_objects();
    // Materials and parts of the chair, a preset that no file holds, another light.
    let mesh = window.app().results().mesh.clone().expect("a mesh");
    let mut materials = tam_viewer::Scene::of(&mesh.mesh).materials;
    (materials[0].rotation_deg, materials[0].colour) = (40.0, [0.9, 0.3, 0.2]);
    window.run(Command::SetMaterials(materials));
    let mut standing = window.app().state().document.standing.clone();
    standing.place.turn_deg = 25.0;
    standing.parts.entry("top rail".to_owned()).or_default().look.visible = Some(false);
    window.run(Command::SetStanding(1, Box::new(standing)));
    let mut lights = window.app().state().document.lights.clone();
    lights.lights.push(tam_viewer::Light { intensity: 0.4, ..tam_viewer::Light::from_angles(70.0, 15.0) });
    window.run(Command::SetLights(lights));
    let [width, height] = window.app().results().picture.as_ref().expect("a picture").canvas.size_px();
    let size = format!("{width}x{height}");

    let command = copied(&mut window);
    assert_eq!(command[..2], ["tam-viewer", "render"]);
    let words: Vec<&str> = command[1..].iter().map(String::as_str).chain(["-o", "copied.png"]).collect();
    let run = tam_viewer(folder.path(), &words);
    assert_eq!(run.status, 0, "{command:?}: {run:?}");
    let shown = picture(&window);
    let drawn = |name: &str| image::open(folder.path().join(name)).expect("a picture").into_rgba8().into_raw();
    assert_eq!(difference(&shown, &drawn("copied.png")), 0.0, "{command:?}");

    let mut preset = window.app().state().document.preset.clone();
    preset.stroke.width_px += 1.0;
    window.run(Command::SetPreset(Box::new(preset)));
    let changed = picture(&window);
    let path = folder.path().join("scene.toml");
    window.run(Command::SaveScene(Some(path.clone())));
    assert!(folder.path().join("scene-fine-pen.toml").is_file(), "the preset is saved beside it");
    assert!(!window.app().state().is_unsaved());
    let run = tam_viewer(folder.path(), &["render", "--scene", "scene.toml", "--size", &size, "-o", "saved.png"]);
    assert_eq!(run.status, 0, "{run:?}");
    assert_eq!(difference(&changed, &drawn("saved.png")), 0.0, "{}", std::fs::read_to_string(&path).expect("text"));

    // Opened in another window, it is the same picture and the same file.
    let mut other = Window::ready();
    other.run(Command::OpenFiles(vec![path.clone()]));
    assert_eq!(names(&other), ["teapot", "chair"]);
    let of_other = picture(&other);
    assert_eq!(difference(&changed, &of_other), 0.0);
    let again = folder.path().join("again.toml");
    other.run(Command::SaveScene(Some(again.clone())));
    let [first, second] = [path, again].map(|path| SceneFile::load(path).expect("a scene"));
    assert_eq!(first, second);
    assert!(other.app().messages().iter().all(|message| message.severity != Severity::Error));
}

#[test]
fn scenes_that_cannot_be_opened_change_nothing() {
    let folder = tempfile::tempdir().expect("a folder");
    let mut window = Window::ready();
    let document = window.app().state().document.clone();
    for (name, text, said) in [
        ("empty.toml", "object = []\n", "no objects"),
        ("word.toml", "[[object]]\nmesh = \"cube\"\nmetod = 1\n", "did you mean `method`?"),
        ("map.toml", "[[object]]\nmesh = \"cube\"\nmap = \"gone.toml\"\n", "gone.toml"),
        ("guides.toml", "[[object]]\nmesh = \"cube\"\nguides = \"gone.json\"\n", "gone.json"),
    ] {
        let path = folder.path().join(name);
        std::fs::write(&path, text).expect("a writable folder");
        let told = window.app().messages().len();
        window.run(Command::OpenScene(Some(path)));
        let new = &window.app().messages()[told..];
        assert!(
            new.iter().any(|message| message.severity == Severity::Error && message.text.contains(said)),
            "{new:?}"
        );
        assert_eq!(window.app().state().document, document, "{name}");
    }
    // A mesh that is gone leaves the others.
    let path = folder.path().join("half.toml");
    std::fs::write(&path, "[[object]]\nmesh = \"cube\"\n[[object]]\nmesh = \"gone.obj\"\n").expect("a writable folder");
    window.run(Command::OpenScene(Some(path)));
    assert_eq!(names(&window), ["cube", "gone"]);
    assert!(window.app().messages().iter().any(|message| message.text.contains("gone.obj")));
    let paper = Preset::named("pencil").expect("shipped").expect("valid").colours.srgb().expect("colours").0;
    let inked = picture(&window).chunks_exact(4).filter(|pixel| pixel[..3] != paper).count();
    assert!(inked > 1000, "the cube is drawn");
}
