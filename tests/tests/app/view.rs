//! The view: camera, light, looks, guides.

use egui_kittest::kittest::Queryable;
use tam_gen::Preset;
use tam_tests::app::Window;
use tam_viewer::app::{Command, MeshSource, Motion, Tool};
use tam_viewer::mesh::sample::Sample;
use tam_viewer::{Mapping, Method};

use super::helpers::{difference, picture};

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
fn two_looks_are_wiped_and_one_preset_beside_another() {
    let mut window = Window::ready();
    let alone = picture(&window);
    window.harness.key_press(egui::Key::C);
    window.harness.step();
    window.settle();
    let compare = window.app().state().document.compare.clone().expect("comparing");
    let both = picture(&window);
    let width = window.app().results().picture.as_ref().expect("a picture").canvas.size_px()[0] as usize;
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
fn views_are_filled_to_their_pixels_at_any_size_of_the_interface() {
    let mut window = Window::ready();
    for zoom in [1.0, 1.5, 2.0] {
        window.run(Command::SetZoom(zoom));
        let size = window.app().results().picture.as_ref().expect("a picture").canvas.size_px();
        let view = window.harness.get_by_label("Picture of the mesh").rect();
        for (pixels, points) in size.into_iter().zip([view.width(), view.height()]) {
            assert!((pixels as f32 - points * zoom).abs() <= 1.0, "{zoom}: {size:?} {view:?}");
        }
    }
}

#[test]
fn a_mesh_too_fine_for_a_surface_is_drawn_without_and_the_user_is_told() {
    let mut window = Window::ready();
    window.run(Command::SetMesh(MeshSource::Sample(Sample::Quad, 2_050_000)));
    let results = window.app().results();
    let mesh = results.mesh.as_ref().expect("it is loaded");
    assert!(mesh.mesh.triangles.len() > 2_000_000, "{} triangles", mesh.mesh.triangles.len());
    let told: Vec<_> = window.app().messages().iter().map(|message| message.text.as_str()).collect();
    let wanted = |text: &&str| text.contains("three planes instead");
    assert_eq!(told.into_iter().filter(wanted).count(), 1, "once: {:?}", window.app().messages());
    assert!(results.picture.as_ref().is_some_and(|picture| picture.surface.is_none()) && !picture(&window).is_empty());
    // Back on a mesh that is fine enough, strokes follow the form again.
    window.run(Command::SetMesh(MeshSource::Sample(Sample::Sphere, 2000)));
    let results = window.app().results();
    assert!(results.surface_problem.is_none());
    assert!(results.picture.as_ref().is_some_and(|picture| picture.surface.is_some()));
}

#[test]
fn surfaces_are_made_while_something_plays_and_not_while_a_slider_is_held() {
    let mut window = Window::ready();
    window.harness.key_press(egui::Key::Space);
    window.harness.step();
    assert!(window.app().state().transient.motion.is_some());
    let asked = |window: &Window| window.app().results().running.iter().any(|(name, _)| *name == "Surface");
    let lasts = |window: &mut Window, wanted: bool| {
        let start = std::time::Instant::now();
        while asked(window) != wanted {
            assert!(start.elapsed().as_secs() < 60, "a surface is being made: {}", !wanted);
            window.harness.step();
        }
    };
    let corner = egui::pos2(2.0, 2.0);
    window.harness.hover_at(corner);
    window.harness.drag_at(corner);
    window.harness.step();
    let mut look = window.app().state().document.look.clone();
    look.params.method = Method::Stripes;
    let ctx = window.harness.ctx.clone();
    window.harness.state_mut().run(&ctx, Command::SetLook(Box::new(look)));
    for _ in 0..20 {
        window.harness.step();
        assert!(!asked(&window), "while a button is held");
    }
    window.harness.drop_at(corner);
    lasts(&mut window, true);
    lasts(&mut window, false);
    // One surface serves all frames of what plays.
    for motion in [Motion::Orbit, Motion::Light] {
        window.harness.state_mut().run(&ctx, Command::Play(Some(motion)));
        for _ in 0..20 {
            window.harness.step();
            assert!(!asked(&window), "{motion:?} asks for it again");
        }
    }
    assert!(window.app().results().surface_problem.is_none());
}
