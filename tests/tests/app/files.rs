//! Presets, meshes, exports and sessions in files.

use egui_kittest::kittest::Queryable;
use image::AnimationDecoder;
use tam_gen::Preset;
use tam_tests::app::Window;
use tam_tests::command;
use tam_viewer::app::{Command, MeshSource, Pane, PresetSource, Severity};
use tam_viewer::mesh::sample::Sample;

use super::helpers::drop_file;

#[test]
fn files_are_dropped_onto_the_window_and_bad_ones_change_nothing() {
    let folder = tempfile::tempdir().expect("a folder");
    let mut window = Window::ready();
    let preset = folder.path().join("mine.toml");
    let (_, source) = Preset::embedded()[4];
    std::fs::write(&preset, source).expect("a writable folder");
    drop_file(&mut window, &preset);
    assert_eq!(window.app().state().document.source, PresetSource::File(preset.clone()));

    let mesh = folder.path().join("square.obj");
    std::fs::write(&mesh, "v -1 -1 0\nv 1 -1 0\nv 1 1 0\nv -1 1 0\nf 1 2 3 4\n").expect("a writable folder");
    drop_file(&mut window, &mesh);
    let loaded = window.app().results().mesh.as_ref().expect("a mesh");
    assert_eq!((loaded.mesh.triangles.len(), &loaded.source), (2, &MeshSource::File(mesh.clone())));
    let document = window.app().state().document.clone();
    assert!(window.app().messages().iter().all(|message| message.severity != Severity::Error));

    for (name, content) in [
        ("empty.obj", ""),
        ("nan.obj", "v nan 0 0\nv 1 inf 0\nv 0 1 0\nf 1 2 3\n"),
        ("cut.glb", "glTF\u{2}"),
        ("bad.toml", "stroke = { width_px = -1 }\n"),
        ("picture.gif", "GIF89a"),
        ("guides.json", "{"),
    ] {
        let path = folder.path().join(name);
        std::fs::write(&path, content).expect("a writable folder");
        let told = window.app().messages().len();
        drop_file(&mut window, &path);
        let new = &window.app().messages()[told..];
        assert!(new.iter().any(|message| message.severity == Severity::Error), "{name} is told: {new:?}");
        assert_eq!(window.app().state().document, document, "{name} changes nothing");
    }
    drop_file(&mut window, &folder.path().join("gone.stl"));
    assert_eq!(window.app().state().document, document);
}

#[test]
fn exports_pass_the_checker_and_pictures_are_written() {
    let folder = tempfile::tempdir().expect("a folder");
    let mut window = Window::ready();
    let mut export = window.app().state().settings.export.clone();
    export.formats = vec!["ktx2".to_owned(), "png".to_owned()];
    window.run(Command::SetExport(export));
    window.run(Command::ExportInto(folder.path().join("out")));
    window.run(Command::Export);
    let map = folder.path().join("out/pencil.ktx2");
    let checked = std::process::Command::new(command::tam_gen_path()).arg("check").arg(&map).output().expect("it runs");
    assert!(checked.status.success(), "{checked:?}");
    assert!(folder.path().join("out/pencil.sheet.png").is_file() && folder.path().join("out/cells").is_dir());

    // Files that are there already are not replaced without a word.
    window.run(Command::Export);
    let last = window.app().messages().last().expect("a message");
    assert!(last.severity == Severity::Error && last.text.contains("already there"), "{last:?}");

    let mut settings = window.app().state().settings.picture.clone();
    (settings.size_px, settings.transparent) = ([320, 200], true);
    window.run(Command::SetPicture(settings));
    let path = folder.path().join("picture.png");
    window.run(Command::SavePicture(Some(path.clone())));
    let saved = image::open(&path).expect("a picture").to_rgba8();
    assert_eq!(saved.dimensions(), (320, 200));
    assert!(saved.pixels().any(|pixel| pixel.0[3] == 0) && saved.pixels().any(|pixel| pixel.0[3] == 255));

    let mut settings = window.app().state().settings.turntable.clone();
    (settings.side_px, settings.frames) = (64, 3);
    window.run(Command::SetTurntable(settings));
    let path = folder.path().join("round.gif");
    window.run(Command::SaveTurntable(Some(path.clone())));
    assert!(path.is_file(), "{:?}", window.app().messages());

    // A folder is never written over, whatever it is called.
    let taken = folder.path().join("taken.png");
    std::fs::create_dir(&taken).expect("a writable folder");
    window.run(Command::SaveTurntable(Some(taken.clone())));
    let last = window.app().messages().last().expect("a message");
    assert!(last.severity == Severity::Error && last.text.contains("taken.png"), "{last:?}");
    assert_eq!(std::fs::read_dir(&taken).expect("a folder").count(), 0);
}

#[test]
fn a_turntable_shows_the_whole_mesh_in_every_frame() {
    let folder = tempfile::tempdir().expect("a folder");
    let mut window = Window::ready();
    let mut settings = window.app().state().settings.turntable.clone();
    (settings.side_px, settings.frames) = (128, 12);
    window.run(Command::SetTurntable(settings));
    let path = folder.path().join("round.gif");
    window.run(Command::SaveTurntable(Some(path.clone())));
    let file = std::io::BufReader::new(std::fs::File::open(&path).expect("a turntable"));
    let frames = image::codecs::gif::GifDecoder::new(file).expect("a GIF").into_frames();
    let frames = frames.collect_frames().expect("frames");
    assert_eq!(frames.len(), 12);
    for (number, frame) in frames.iter().enumerate() {
        let frame = frame.buffer();
        let paper = frame.get_pixel(0, 0);
        let on_border = |x, y| x == 0 || y == 0 || x == 127 || y == 127;
        let inked = frame.enumerate_pixels().filter(|(x, y, pixel)| on_border(*x, *y) && *pixel != paper).count();
        assert_eq!(inked, 0, "frame {number} is cut off");
        assert!(frame.pixels().any(|pixel| pixel != paper), "frame {number} is empty");
    }
}

#[test]
fn a_file_that_is_there_is_asked_about_by_its_whole_name() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("mine.toml");
    std::fs::write(&path, "older").expect("a writable folder");
    let mut window = Window::ready();
    for (answer, replaced) in [("Cancel", false), ("Replace", true)] {
        window.run(Command::SaveAs(Some(folder.path().join("mine"))));
        window.harness.run_steps(2);
        window.harness.get_by_role_and_label(egui::accesskit::Role::Button, answer).click();
        window.harness.run_steps(2);
        window.settle();
        assert!(window.app().state().transient.dialog.is_none());
        let now = std::fs::read_to_string(&path).expect("it is there");
        assert_eq!(now != "older", replaced, "{answer}");
    }
    assert_eq!(window.app().state().document.source, PresetSource::File(path));
}

#[test]
fn a_session_comes_back_also_when_the_window_was_lost() {
    let folder = tempfile::tempdir().expect("a folder");
    let session = folder.path().join("session.json");
    let changed = {
        let mut window = Window::open([1440.0, 900.0], Some(&session));
        window.settle();
        let mut preset = window.app().state().document.preset.clone();
        preset.stroke.width_px = 5.0;
        window.run(Command::SetPreset(Box::new(preset)));
        window.run(Command::SetMesh(MeshSource::Sample(Sample::Cube, 500)));
        window.harness.run_steps(40);
        let layout = || {
            let text = std::fs::read_to_string(&session).expect("the session is kept");
            serde_json::from_str::<serde_json::Value>(&text).expect("it is JSON")["layout"].clone()
        };
        let before = layout();
        // Where the panels are is kept at once, too.
        window.run(Command::ShowPane(Pane::Checks));
        window.harness.run_steps(40);
        assert_ne!(layout(), before);
        window.app().state().clone()
        // Dropped without being closed, as in a crash.
    };
    let mut window = Window::open([1440.0, 900.0], Some(&session));
    window.settle();
    assert_eq!(window.app().state().document, changed.document);
    assert!(window.app().state().is_unsaved());
    let messages = window.app().messages();
    assert!(messages.iter().any(|message| message.text.contains("did not end properly")), "{messages:?}");

    drop(window);

    std::fs::write(&session, "{ torn").expect("a writable folder");
    let mut window = Window::open([1440.0, 900.0], Some(&session));
    window.settle();
    assert_eq!(window.app().state().preset_name(), "pencil");
    let messages = window.app().messages();
    let told = messages.iter().find(|message| message.severity == Severity::Warning).expect("a warning");
    assert!(told.text.contains("session.unread-1.json"), "{told:?}");
    let kept = std::fs::read_to_string(folder.path().join("session.unread-1.json")).expect("it is kept");
    assert_eq!(kept, "{ torn");
}

#[test]
fn a_session_with_an_unknown_word_is_kept_aside_and_read_all_the_same() {
    let folder = tempfile::tempdir().expect("a folder");
    let session = folder.path().join("session.json");
    let mut window = Window::open([1440.0, 900.0], Some(&session));
    window.settle();
    let mut preset = window.app().state().document.preset.clone();
    preset.stroke.width_px = 5.0;
    window.run(Command::SetPreset(Box::new(preset.clone())));
    window.harness.run_steps(40);
    drop(window);
    let text = std::fs::read_to_string(&session).expect("the session is kept");
    let mut written: serde_json::Value = serde_json::from_str(&text).expect("it is JSON");
    written["state"]["document"]["look"]["params"]["method"] = "from-the-future".into();
    std::fs::write(&session, written.to_string()).expect("a writable folder");

    let mut window = Window::open([1440.0, 900.0], Some(&session));
    window.settle();
    window.harness.run_steps(40);
    assert_eq!(window.app().state().document.preset, preset, "what was not saved is still here");
    let warnings = window.app().messages().iter().filter(|message| message.severity == Severity::Warning);
    let told: Vec<_> = warnings.map(|warning| warning.text.as_str()).collect();
    assert!(told.len() == 1, "{told:?}");
    assert!(told[0].contains("document.look.params.method") && told[0].contains("session.unread-1.json"), "{told:?}");
    let aside = std::fs::read_to_string(folder.path().join("session.unread-1.json")).expect("it is kept");
    assert_eq!(aside, written.to_string());
    assert!(session.is_file(), "and the next session has its place");
}

#[test]
fn a_second_window_starts_from_the_same_session_and_leaves_it_alone() {
    let folder = tempfile::tempdir().expect("a folder");
    let session = folder.path().join("session.json");
    let mut first = Window::open([1440.0, 900.0], Some(&session));
    first.settle();
    let mut preset = first.app().state().document.preset.clone();
    preset.stroke.width_px = 5.0;
    first.run(Command::SetPreset(Box::new(preset)));
    first.harness.run_steps(40);
    let kept = std::fs::read(&session).expect("the session is kept");

    let mut second = Window::open([1440.0, 900.0], Some(&session));
    second.settle();
    assert_eq!(second.app().state().document, first.app().state().document);
    let told = second.app().messages().iter().filter(|message| message.text.contains("Another window")).count();
    assert_eq!((told, second.app().messages().len()), (1, 1), "{:?}", second.app().messages());
    second.run(Command::NewPreset);
    second.run(Command::ShowPane(Pane::Checks));
    second.harness.run_steps(40);
    assert_eq!(std::fs::read(&session).expect("it is there"), kept);

    // Who comes after the first is the next to keep it.
    drop(first);
    let mut third = Window::open([1440.0, 900.0], Some(&session));
    third.settle();
    third.run(Command::ShowPane(Pane::Checks));
    third.harness.run_steps(40);
    assert_ne!(std::fs::read(&session).expect("it is there"), kept);
}

#[test]
fn the_window_asks_before_changes_are_lost() {
    let mut window = Window::ready();
    let mut preset = window.app().state().document.preset.clone();
    preset.seed = 77;
    window.run(Command::SetPreset(Box::new(preset.clone())));
    for (answer, kept) in [("Cancel", true), ("Discard", false)] {
        window.harness.key_press_modifiers(egui::Modifiers::COMMAND, egui::Key::N);
        window.harness.run_steps(2);
        window.harness.get_by_role_and_label(egui::accesskit::Role::Button, answer).click();
        window.harness.run_steps(2);
        window.settle();
        let state = window.app().state();
        assert_eq!(state.document.preset == preset, kept, "{answer}");
        assert!(state.transient.dialog.is_none());
    }
    assert_eq!(window.app().state().preset_name(), "untitled");
}

#[test]
fn a_preset_that_another_program_changes_is_read_again() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("mine.toml");
    let mut window = Window::ready();
    window.run(Command::SaveAs(Some(path.clone())));
    let mut changed = window.app().state().document.preset.clone();
    changed.stroke.width_px = 6.5;
    std::fs::write(&path, changed.to_toml()).expect("a writable folder");
    let start = std::time::Instant::now();
    while window.app().state().document.preset != changed {
        assert!(start.elapsed().as_secs() < 20, "the change is never seen");
        std::thread::sleep(std::time::Duration::from_millis(20));
        window.harness.step();
    }
    window.settle();
    assert!(!window.app().state().is_unsaved());
    assert_eq!(window.app().results().map.as_ref().expect("a map").preset, changed);
}

#[test]
fn the_gallery_loads_every_preset() {
    let mut window = Window::ready();
    for (name, _) in Preset::embedded() {
        window.harness.get_by_role_and_label(egui::accesskit::Role::Button, name).click();
        window.harness.step();
        window.settle();
        let state = window.app().state();
        assert_eq!(state.document.source, PresetSource::Shipped((*name).to_owned()));
        assert_eq!(state.document.preset, Preset::named(name).expect("shipped").expect("valid"));
        let made = window.app().results().map.as_ref().expect("a map");
        assert_eq!(made.map.preset, state.document.preset);
        let key = format!("preset:{name}");
        assert!(window.app().results().thumbnails.contains_key(&key), "{name} has no thumbnail");
    }
}
