//! Panels and their controls.

use egui_kittest::kittest::{NodeT, Queryable};
use tam_tests::app::Window;
use tam_viewer::Method;
use tam_viewer::app::{Command, Dialog, MapTab, Pane};

use super::helpers::{compare_with_kept, difference, names_of, picture};

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
        (Pane::Chart, "All ways"),
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
fn commands_are_found_by_typing() {
    let mut window = Window::ready();
    window.harness.key_press_modifiers(egui::Modifiers::COMMAND, egui::Key::K);
    window.harness.run_steps(2);
    window.harness.event(egui::Event::Text("wirefr".to_owned()));
    window.harness.run_steps(2);
    window.harness.key_press(egui::Key::Enter);
    window.harness.run_steps(2);
    window.settle();
    assert!(window.app().state().document.inspect.wireframe.is_some());
    assert!(window.app().state().transient.dialog.is_none());
}

#[test]
fn keys_that_edit_text_are_left_to_the_field_that_is_typed_in() {
    let mut window = Window::ready();
    let mut preset = window.app().state().document.preset.clone();
    preset.stroke.width_px = 4.0;
    window.run(Command::SetPreset(Box::new(preset.clone())));
    window.harness.run_steps(10);
    window.harness.get_by_label("About").click_accesskit();
    window.harness.run_steps(20);
    window.harness.get_by_role_and_label(egui::accesskit::Role::MultilineTextInput, "Description").focus();
    window.harness.run_steps(2);
    window.harness.event(egui::Event::Text("Soft. ".to_owned()));
    window.harness.run_steps(20);
    assert!(window.app().state().document.preset.description.contains("Soft. "));
    for _ in 0..3 {
        window.harness.key_press_modifiers(egui::Modifiers::COMMAND, egui::Key::Z);
        window.harness.run_steps(2);
    }
    // The field has taken back its own text, and nobody the width.
    assert_eq!(window.app().state().document.preset, preset);
    window.harness.key_press_modifiers(egui::Modifiers::COMMAND, egui::Key::K);
    window.harness.run_steps(2);
    assert!(matches!(window.app().state().transient.dialog, Some(Dialog::Palette(_))), "other keys work as ever");
}
