//! The application, used through its window.

use std::path::{Path, PathBuf};
use std::sync::Arc;

use egui_kittest::kittest::{NodeT, Queryable};
use tam_gen::Preset;
use tam_tests::app::Window;
use tam_tests::command;
use tam_viewer::app::{Command, MapTab, MeshSource, Pane, PresetSource, Severity, Tool};
use tam_viewer::mesh::sample::Sample;
use tam_viewer::{Mapping, Method};

/// The pixels of the view.
fn picture(window: &Window) -> Vec<u8> {
    let shown = window.app().results().picture.as_ref().expect("a picture");
    shown.image.pixels.iter().flat_map(|pixel| pixel.to_array()).collect()
}

/// Share of pixels that differ.
fn difference(a: &[u8], b: &[u8]) -> f64 {
    assert_eq!(a.len(), b.len());
    let pixels = a.chunks_exact(4).zip(b.chunks_exact(4));
    pixels.filter(|(a, b)| a != b).count() as f64 / (a.len() / 4) as f64
}

/// A file that is dropped onto the window.
#[derive(Debug)]
struct Dropped(PathBuf);

impl egui::DroppedFile for Dropped {
    fn path(&self) -> &Path {
        &self.0
    }

    fn bytes(&self) -> Result<Vec<u8>, String> {
        std::fs::read(&self.0).map_err(|error| error.to_string())
    }
}

fn drop_file(window: &mut Window, path: &Path) {
    window.harness.input_mut().dropped_files.push(Arc::new(Dropped(path.to_owned())));
    window.harness.step();
    window.settle();
}

#[test]
fn it_starts_with_a_finished_picture_and_every_panel_opens() {
    let mut window = Window::ready();
    let drawn = picture(&window);
    let paper = &drawn[..4];
    let inked = drawn.chunks_exact(4).filter(|pixel| *pixel != paper).count() as f64 / (drawn.len() / 4) as f64;
    assert!((0.05..0.95).contains(&inked), "{inked}");
    for (pane, shows) in [
        (Pane::Presets, "SHIPPED"),
        (Pane::Scene, "Load a mesh…"),
        (Pane::Strokes, "Randomise"),
        (Pane::Shading, "As printed in the paper"),
        (Pane::Export, "Contact sheet"),
        (Pane::Map, "Nesting"),
        (Pane::Checks, "Limit"),
        (Pane::View, "A | B"),
    ] {
        window.run(Command::ShowPane(pane));
        assert!(window.harness.query_all_by_label(shows).count() > 0, "{pane:?} shows no {shows:?}");
    }
    assert!(window.app().results().current_report().is_some_and(|report| report.holds()));
    assert!(window.app().messages().is_empty(), "{:?}", window.app().messages());
}

#[test]
fn stroke_sliders_change_what_they_name_and_the_picture_follows() {
    let mut window = Window::ready();
    for (name, key, number) in
        [("Width", "width_px", 3.0), ("Bow", "bow", 0.1), ("Taper in", "taper_in", 0.5), ("Opacity", "opacity", 0.5)]
    {
        let before = picture(&window);
        let sliders = window.harness.get_all_by_label(name);
        let slider = sliders.into_iter().find(|node| node.accesskit_node().role() == egui::accesskit::Role::Slider);
        slider.unwrap_or_else(|| panic!("{name} has a slider")).set_value_accesskit(number);
        window.harness.step();
        window.settle();
        let numbers = window.app().state().document.preset.stroke.numbers();
        let (_, set) = numbers.into_iter().find(|(other, _)| *other == key).expect("a stroke number");
        assert!((set - number).abs() < 1e-6, "{name}: {set}");
        assert!(difference(&before, &picture(&window)) > 0.01, "{name} changes the picture");
        let made = window.app().results().map.as_ref().expect("a map");
        assert_eq!(made.map.preset, window.app().state().document.preset);
        // The way back is beside it.
        let reset = format!("Reset {}", name.to_lowercase());
        window.harness.get_by_label(&reset).click();
        window.harness.step();
        window.settle();
    }
}

#[test]
fn undo_and_redo_restore_every_byte() {
    let mut window = Window::ready();
    let bytes = |window: &Window| serde_json::to_string(&window.app().state().document).expect("JSON");
    let mut states = vec![(bytes(&window), picture(&window))];
    let mut preset = window.app().state().document.preset.clone();
    preset.stroke.width_px = 4.0;
    let mut look = window.app().state().document.look.clone();
    look.params.method = Method::StrokeMap;
    let mut lights = window.app().state().document.lights.clone();
    lights.ambient = 0.5;
    let commands = [Command::SetPreset(Box::new(preset)), Command::SetLook(Box::new(look)), Command::SetLights(lights)];
    for command in commands {
        window.run(command);
        // Longer than changes that belong together.
        window.harness.run_steps(10);
        states.push((bytes(&window), picture(&window)));
    }
    for (state, drawn) in states.iter().rev().skip(1) {
        window.harness.key_press_modifiers(egui::Modifiers::COMMAND, egui::Key::Z);
        window.harness.step();
        window.settle();
        assert_eq!(&bytes(&window), state);
        assert_eq!(difference(drawn, &picture(&window)), 0.0, "the same state is the same picture");
    }
    for (state, _) in &states[1..] {
        window.run(Command::Redo);
        assert_eq!(&bytes(&window), state);
    }
}

#[test]
fn a_drag_in_the_view_turns_the_camera_and_one_step_back_undoes_it() {
    let mut window = Window::ready();
    let before = window.app().state().camera;
    let view = window.harness.get_by_label("Picture of the mesh").rect();
    let start = view.center() + egui::vec2(40.0, 30.0);
    window.harness.hover_at(start);
    window.harness.step();
    window.harness.drag_at(start);
    for step in 1..6 {
        window.harness.hover_at(start + egui::vec2(20.0 * step as f32, 4.0 * step as f32));
        window.harness.step();
    }
    window.harness.drop_at(start + egui::vec2(100.0, 20.0));
    window.harness.step();
    window.settle();
    window.harness.run_steps(10);
    let after = window.app().state().camera;
    assert!((after.azimuth_deg - before.azimuth_deg).abs() > 10.0 && after.elevation_deg > before.elevation_deg);
    window.harness.key_press(egui::Key::OpenBracket);
    window.harness.step();
    window.settle();
    assert_eq!(window.app().state().camera, before);
}

#[test]
fn keys_switch_methods_mappings_and_move_the_light() {
    let mut window = Window::ready();
    let keys = [egui::Key::Num1, egui::Key::Num3, egui::Key::Num4, egui::Key::Num5, egui::Key::Num6, egui::Key::Num7];
    let methods =
        [Method::Phong, Method::FaceFrame, Method::StrokeMap, Method::Halftone, Method::FineTone, Method::Stripes];
    let mut pictures = vec![picture(&window)];
    for (key, method) in keys.into_iter().zip(methods) {
        window.harness.key_press(key);
        window.harness.step();
        window.settle();
        assert_eq!(window.app().state().document.look.params.method, method);
        let drawn = picture(&window);
        assert!(pictures.iter().all(|other| difference(other, &drawn) > 0.01), "{method:?} looks like another");
        pictures.push(drawn);
    }
    window.harness.key_press(egui::Key::Num2);
    window.harness.key_press_modifiers(egui::Modifiers::ALT, egui::Key::Num3);
    window.harness.step();
    window.settle();
    let params = window.app().state().document.look.params;
    assert_eq!((params.method, params.mapping), (Method::SixWay, Mapping::Triplanar));
    let lights = window.app().state().document.lights.clone();
    for key in [egui::Key::O, egui::Key::L, egui::Key::I, egui::Key::K, egui::Key::U, egui::Key::J] {
        let before = window.app().state().document.lights.clone();
        window.harness.key_press(key);
        window.harness.step();
        assert_ne!(window.app().state().document.lights, before, "{key:?}");
    }
    window.settle();
    assert_ne!(window.app().state().document.lights, lights);
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
        window.app().state().clone()
        // Dropped without being closed, as in a crash.
    };
    let mut window = Window::open([1440.0, 900.0], Some(&session));
    window.settle();
    assert_eq!(window.app().state().document, changed.document);
    assert!(window.app().state().is_unsaved());
    let messages = window.app().messages();
    assert!(messages.iter().any(|message| message.text.contains("did not end properly")), "{messages:?}");

    std::fs::write(&session, "{ torn").expect("a writable folder");
    let mut window = Window::open([1440.0, 900.0], Some(&session));
    window.settle();
    assert_eq!(window.app().state().preset_name(), "pencil");
    assert!(window.app().messages().iter().any(|message| message.severity == Severity::Warning));
}

#[test]
fn two_looks_are_wiped_and_one_preset_beside_another() {
    let mut window = Window::ready();
    let alone = picture(&window);
    window.harness.key_press(egui::Key::C);
    window.harness.step();
    window.settle();
    let compare = window.app().state().document.compare.clone().expect("comparing");
    let both = picture(&window);
    let width = window.app().results().picture.as_ref().expect("a picture").image.size[0];
    let half = |pixels: &[u8], right: bool| -> Vec<u8> {
        let rows = pixels.chunks_exact(width * 4);
        rows.flat_map(|row| if right { &row[width * 2 + 16..] } else { &row[..width * 2 - 16] }).copied().collect()
    };
    assert_eq!(difference(&half(&alone, false), &half(&both, false)), 0.0);
    assert!(difference(&half(&alone, true), &half(&both, true)) > 0.02);
    let brush = Preset::named("brush").expect("shipped").expect("valid");
    let with_brush = tam_viewer::app::Compare { preset: Some(("brush".to_owned(), brush)), ..compare };
    window.run(Command::SetCompare(Some(Box::new(with_brush))));
    assert_eq!(difference(&half(&alone, false), &half(&picture(&window), false)), 0.0);
}

#[test]
fn the_map_panel_shows_every_view_and_checks_lead_to_the_texels() {
    let mut window = Window::ready();
    for tab in MapTab::ALL {
        let mut shown = window.app().state().transient.map;
        shown.tab = tab;
        window.run(Command::ShowCell(shown));
        assert_eq!(window.app().state().transient.map.tab, tab);
    }
    // Strokes so wide that a level cannot keep them apart fail somewhere.
    let mut preset = window.app().state().document.preset.clone();
    preset.placement.method = tam_gen::preset::PlacementMethod::Random;
    (preset.stroke.grain, preset.stroke.width_jitter) = (0.9, 0.9);
    window.run(Command::SetPreset(Box::new(preset)));
    window.run(Command::ShowPane(Pane::Checks));
    let title = "Tone average";
    window.harness.get_by_role_and_label(egui::accesskit::Role::Button, title).click();
    window.harness.step();
    window.settle();
    assert_eq!(window.app().state().transient.map.tab, MapTab::Cell);
}

#[test]
fn everything_that_can_be_used_has_a_name() {
    use egui::accesskit::Role;
    let mut window = Window::ready();
    let mut nameless = Vec::new();
    for pane in Pane::ALL {
        window.run(Command::ShowPane(pane));
        let root = window.harness.root();
        let nodes = root.children_recursive();
        for node in nodes {
            let accessible = node.accesskit_node();
            let used = matches!(
                accessible.role(),
                Role::Button
                    | Role::CheckBox
                    | Role::Slider
                    | Role::ComboBox
                    | Role::TextInput
                    | Role::SpinButton
                    | Role::RadioButton
                    | Role::ColorWell
                    | Role::Link
            );
            let named = accessible.label().is_some_and(|label| !label.trim().is_empty());
            if used && !named {
                nameless.push((pane, accessible.role(), accessible.value(), node.rect()));
            }
        }
    }
    assert!(nameless.is_empty(), "{nameless:#?}");
}

/// Names of all widgets of a role that can be used now.
fn names_of(window: &Window, wanted: egui::accesskit::Role) -> Vec<String> {
    let nodes = window.harness.root().children_recursive();
    let used = nodes.filter(|node| node.accesskit_node().role() == wanted && !node.accesskit_node().is_disabled());
    used.filter_map(|node| node.accesskit_node().label()).collect()
}

#[test]
fn every_slider_and_checkbox_changes_the_state() {
    use egui::accesskit::Role;
    let mut window = Window::ready();
    let bytes = |window: &Window| serde_json::to_string(window.app().state()).expect("JSON");
    let mut tried = 0;
    for pane in [Pane::Strokes, Pane::Shading, Pane::Scene, Pane::Export] {
        window.run(Command::ShowPane(pane));
        for role in [Role::Slider, Role::CheckBox] {
            for name in names_of(&window, role) {
                let before = bytes(&window);
                let found = window.harness.query_all_by_role_and_label(role, &name).next();
                // Some options go with the one that was switched off before.
                let Some(node) = found.filter(|node| !node.accesskit_node().is_disabled()) else { continue };
                if role == Role::Slider {
                    let accessible = node.accesskit_node();
                    let ends =
                        [accessible.min_numeric_value(), accessible.max_numeric_value()].map(|end| end.unwrap_or(0.0));
                    let now = accessible.numeric_value().unwrap_or(ends[0]);
                    let part = if (now - ends[0]) / (ends[1] - ends[0]) < 0.3 { 0.5 } else { 0.1 };
                    node.set_value_accesskit(ends[0] + (ends[1] - ends[0]) * part);
                } else {
                    node.click_accesskit();
                }
                window.harness.run_steps(2);
                assert_ne!(bytes(&window), before, "{pane:?}: {role:?} {name:?} changes nothing");
                tried += 1;
            }
        }
        // What was tried here must not hide what is tried next.
        let ctx = window.harness.ctx.clone();
        let fresh = tam_viewer::app::Document::default();
        for command in [
            Command::SetPreset(Box::new(fresh.preset)),
            Command::SetLook(Box::new(fresh.look)),
            Command::SetLights(fresh.lights),
            Command::SetMesh(fresh.mesh),
        ] {
            window.harness.state_mut().run(&ctx, command);
        }
        window.settle();
    }
    assert!(tried > 45, "{tried} controls");
}

/// Part of the window as a small picture, compared with the one that is kept.
fn compare_with_kept(window: &mut Window, area: egui::Rect, name: &str) {
    let picture = window.harness.render().expect("a picture of the window");
    let side = |from: f32, to: f32| (from.max(0.0) as u32, (to - from.max(0.0)) as u32);
    let ((x, width), (y, height)) = (side(area.left(), area.right()), side(area.top(), area.bottom()));
    let part = image::imageops::crop_imm(&picture, x, y, width, height).to_image();
    // Letters are drawn by the processor and put together by the adapter, whose rounding differs by CPU class.
    let options = egui_kittest::SnapshotOptions::new().threshold(2.0).max_failed_pixels(40);
    egui_kittest::image_snapshot_options(&part, name, &options);
}

#[test]
fn panels_and_dialogs_look_as_they_did() {
    let mut window = Window::ready();
    let label = window.harness.get_by_label("Randomise").rect();
    let strokes = egui::Rect::from_min_size(label.min, egui::vec2(330.0, 380.0));
    compare_with_kept(&mut window, strokes, "strokes");
    window.run(Command::ShowPane(Pane::Shading));
    compare_with_kept(&mut window, strokes, "shading");
    window.run(Command::SetTheme(tam_viewer::app::Theme::Light));
    window.run(Command::ShowPane(Pane::Export));
    compare_with_kept(&mut window, strokes, "export-light");
}

#[test]
fn tiny_windows_and_hidden_views_do_no_harm() {
    let mut window = Window::ready();
    for size in [[200.0, 120.0], [30.0, 30.0], [1.0, 1.0], [900.0, 560.0]] {
        window.harness.set_size(size.into());
        window.harness.run_steps(3);
    }
    window.settle();
    assert!(window.app().results().picture_problem.is_none(), "{:?}", window.app().results().picture_problem);
}

#[test]
fn guides_are_drawn_with_the_mouse_and_strokes_follow_them() {
    let mut window = Window::ready();
    window.run(Command::SetMesh(MeshSource::Sample(Sample::Quad, 2000)));
    let before = picture(&window);
    window.run(Command::SetTool(Tool::Guide));
    let view = window.harness.get_by_label("Picture of the mesh").rect();
    let start = view.center() - egui::vec2(60.0, 60.0);
    window.harness.hover_at(start);
    window.harness.step();
    window.harness.drag_at(start);
    for step in 1..13 {
        window.harness.hover_at(start + egui::vec2(10.0, 10.0) * step as f32);
        window.harness.step();
    }
    window.harness.drop_at(start + egui::vec2(120.0, 120.0));
    window.harness.run_steps(2);
    window.settle();
    let guides = &window.app().state().document.look.guides;
    assert_eq!(guides.len(), 1);
    assert!(guides[0].points.len() >= 5, "{guides:?}");
    assert!(difference(&before, &picture(&window)) > 0.05);
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
fn commands_are_found_by_typing() {
    let mut window = Window::ready();
    window.harness.key_press_modifiers(egui::Modifiers::COMMAND, egui::Key::K);
    window.harness.run_steps(2);
    window.harness.event(egui::Event::Text("wirefr".to_owned()));
    window.harness.run_steps(2);
    window.harness.key_press(egui::Key::Enter);
    window.harness.run_steps(2);
    window.settle();
    assert!(window.app().state().document.look.params.wireframe.is_some());
    assert!(window.app().state().transient.dialog.is_none());
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
fn views_are_filled_to_their_pixels_at_any_size_of_the_interface() {
    let mut window = Window::ready();
    for zoom in [1.0, 1.5, 2.0] {
        window.run(Command::SetZoom(zoom));
        let size = window.app().results().picture.as_ref().expect("a picture").image.size;
        let view = window.harness.get_by_label("Picture of the mesh").rect();
        for (pixels, points) in size.into_iter().zip([view.width(), view.height()]) {
            assert!((pixels as f32 - points * zoom).abs() <= 1.0, "{zoom}: {size:?} {view:?}");
        }
    }
}
