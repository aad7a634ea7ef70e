//! The chart of the open scene, and the fit.

use egui::accesskit::Role;
use egui_kittest::kittest::{NodeT, Queryable};
use tam_tests::app::Window;
use tam_viewer::app::{ChartTab, ChartView, Command, MeshSource, Pane};
use tam_viewer::chart::Way;
use tam_viewer::mesh::sample::Sample;
use tam_viewer::{Form, Mapping, Method};

/// A window with a scene that is soon measured.
fn small_scene() -> Window {
    let mut window = Window::ready();
    window.run(Command::SetMesh(MeshSource::Sample(Sample::Cube, 200)));
    let mut preset = window.app().state().document.preset.clone();
    (preset.map.size, preset.map.coarsest) = (64, 32);
    window.run(Command::SetPreset(Box::new(preset)));
    // Longer than changes that belong together.
    window.harness.run_steps(10);
    window
}

/// Lets the application work until so many ways of the open scene are measured.
fn measure_some(window: &mut Window, count: usize) {
    let start = std::time::Instant::now();
    while window.app().results().chart.current().count() < count {
        assert!(start.elapsed() < std::time::Duration::from_secs(120), "{:?}", window.app().results().chart.problem);
        window.harness.step();
        // What measures needs the processor more.
        std::thread::sleep(std::time::Duration::from_millis(30));
    }
    window.harness.run_steps(2);
}

/// Names of the measured ways of the open scene.
fn current(window: &Window) -> Vec<String> {
    window.app().results().chart.current().map(|point| point.way.name()).collect()
}

/// The way that the view shows.
fn present(window: &Window) -> String {
    Way { params: window.app().state().document.look.params, map: 0 }.name()
}

fn document(window: &Window) -> String {
    serde_json::to_string(&window.app().state().document).expect("JSON")
}

fn press(window: &mut Window, role: Role, name: &str) {
    window.harness.get_by_role_and_label(role, name).click_accesskit();
    window.harness.run_steps(2);
    window.settle();
}

#[test]
fn every_way_is_measured_and_a_click_on_a_point_or_a_row_switches_to_it() {
    let mut window = small_scene();
    assert_eq!(window.app().results().chart.points.len(), 0, "nothing is measured for nobody");
    window.run(Command::ShowPane(Pane::Chart));
    window.settle_measuring();
    let names = current(&window);
    for expected in ["six-way, uv", "fine-tone, patches", "stripes, crossed", "stripes, varied", "halftone, triplanar"]
    {
        assert!(names.iter().any(|name| name == expected), "{expected} is not among {names:?}");
    }
    assert!(names.iter().all(|name| !name.contains("lapped") && name != "phong"), "{names:?}");
    let chart = &window.app().results().chart;
    assert_eq!((chart.left[0], &chart.problem), (0, &None));
    assert!(chart.points.iter().all(|point| point.figures.cost.ratio > 0.3 && point.figures.tone_rmse.is_some()));

    let before = document(&window);
    let role_of = |window: &Window, name: &str| {
        let node = window.harness.get_by_label(name);
        node.accesskit_node().role()
    };
    let row = "stripes, crossed";
    let role = role_of(&window, row);
    press(&mut window, role, row);
    assert_eq!(present(&window), row);
    window.harness.run_steps(10);
    let switched = document(&window);
    assert_ne!(switched, before);

    // The same by the mouse, on the point itself.
    let name = "halftone, triplanar";
    let at = window.harness.get_by_label(&format!("Point of {name}")).rect().center();
    window.harness.hover_at(at);
    window.harness.step();
    window.harness.drag_at(at);
    window.harness.step();
    window.harness.drop_at(at);
    window.harness.step();
    window.settle();
    let pointed = present(&window);
    assert!(names.contains(&pointed) && pointed != row, "{pointed}");
    let params = window.app().state().document.look.params;
    assert_eq!((params.method, params.form), (Method::Halftone, Form::Hardened), "the point that was met: {pointed}");
    window.harness.run_steps(10);
    window.settle_measuring();
    assert_eq!(current(&window).len(), names.len(), "another way to draw is no other scene");

    for state in [&switched, &before] {
        window.harness.key_press_modifiers(egui::Modifiers::COMMAND, egui::Key::Z);
        window.harness.step();
        window.settle();
        assert_eq!(&document(&window), state, "each is one step");
    }
}

#[test]
fn points_of_an_older_scene_stay_until_they_are_replaced_and_a_pause_leaves_them() {
    let mut window = small_scene();
    window.run(Command::ShowPane(Pane::Chart));
    measure_some(&mut window, 4);
    window.harness.get_by_role_and_label(Role::CheckBox, "Pause").click();
    window.harness.run_steps(2);
    window.settle_measuring();
    let old = window.app().results().chart.points.len();
    let mut camera = window.app().state().camera;
    camera.azimuth_deg += 30.0;
    window.run(Command::SetCamera(camera));
    window.harness.run_steps(10);
    let chart = &window.app().results().chart;
    assert_eq!((chart.points.len(), chart.current().count()), (old, 0), "they are old and still there");
    window.harness.get_by_role_and_label(Role::CheckBox, "Pause").click();
    window.harness.run_steps(2);
    measure_some(&mut window, 2);
    let chart = &window.app().results().chart;
    assert!(chart.current().count() < chart.points.len(), "those that are not replaced yet are kept");
    assert_eq!(chart.points.len(), old.max(chart.current().count()), "none is there twice");
    // Once nobody looks, nothing is measured.
    window.run(Command::ShowPane(Pane::Map));
    window.settle_measuring();
    let measured = window.app().results().chart.current().count();
    window.harness.run_steps(10);
    assert_eq!(window.app().results().chart.current().count(), measured);
    assert!(window.app().results().chart.left[0] > 0, "it was stopped");
}

#[test]
fn the_table_sorts_by_its_heads() {
    let mut window = small_scene();
    window.run(Command::ShowPane(Pane::Chart));
    measure_some(&mut window, 5);
    window.harness.get_by_role_and_label(Role::CheckBox, "Pause").click();
    window.harness.run_steps(2);
    window.settle_measuring();
    let first = |window: &Window| {
        let points = &window.app().results().chart.points;
        let top = |name: &String| {
            let rows = window.harness.query_all_by_label(name);
            rows.map(|row| row.rect().top()).fold(f32::INFINITY, f32::min)
        };
        points.iter().min_by(|a, b| top(&a.way.name()).total_cmp(&top(&b.way.name()))).expect("rows").clone()
    };
    let costs = |window: &Window| {
        let mut ratios: Vec<f64> =
            window.app().results().chart.points.iter().map(|point| point.figures.cost.ratio).collect();
        ratios.sort_by(f64::total_cmp);
        ratios
    };
    let costs = costs(&window);
    assert_eq!(first(&window).figures.cost.ratio, costs[0]);
    press(&mut window, Role::Button, "Sort by cost");
    assert_eq!(first(&window).figures.cost.ratio, costs[costs.len() - 1]);
    press(&mut window, Role::Button, "Sort by way");
    let mut names = current(&window);
    names.sort();
    assert_eq!(first(&window).way.name(), names[0]);
}

#[test]
fn a_fit_runs_to_its_end_and_using_it_is_one_step() {
    let mut window = small_scene();
    let mut look = window.app().state().document.look.clone();
    (look.params.method, look.params.mapping) = (Method::FineTone, Mapping::Triplanar);
    window.run(Command::SetLook(Box::new(look)));
    let mut preset = window.app().state().document.preset.clone();
    (preset.map.size, preset.map.coarsest) = (256, 32);
    window.run(Command::SetPreset(Box::new(preset)));
    window.harness.run_steps(10);
    let mut fit = window.app().state().settings.fit.clone();
    // Far away, so that the finest levels are never sampled.
    (fit.distance, fit.light_deg, fit.error) = ([4.0, 4.0], [0.0, 0.0], 0.1);
    window.run(Command::SetFit(fit));
    window.run(Command::ShowPane(Pane::Chart));
    window.run(Command::ShowChart(ChartView { tab: ChartTab::Fit, ..ChartView::default() }));
    let before = document(&window);
    press(&mut window, Role::Button, "Fit to this scene");
    window.settle_measuring();
    let outcome = window.app().results().fit.outcome.clone().expect("it has ended");
    let fitted = outcome.unwrap_or_else(|problem| panic!("{problem}"));
    let best = fitted.fit.best.map.expect("a map");
    assert!(best.size < 256 && fitted.fit.best.bytes < fitted.fit.full.bytes, "{:?}", fitted.fit.best);
    assert!(fitted.fit.best.worst.error <= 0.1);
    assert!(window.app().results().fit.is_current);

    press(&mut window, Role::Button, "Use it");
    let changed = &window.app().state().document;
    assert_eq!((changed.preset.map.size, changed.preset.map.coarsest), (best.size, best.coarsest));
    assert_eq!(changed.look.params.method, fitted.fit.best.params.method);
    assert!(!window.app().results().fit.is_current, "what is open is no longer what was fitted");
    window.harness.run_steps(10);
    window.harness.key_press_modifiers(egui::Modifiers::COMMAND, egui::Key::Z);
    window.harness.step();
    window.settle();
    assert_eq!(document(&window), before, "map and way are one step");
}

#[test]
fn what_cannot_be_fitted_is_told_in_the_panel() {
    let mut window = small_scene();
    window.run(Command::ShowPane(Pane::Chart));
    window.run(Command::ShowChart(ChartView { tab: ChartTab::Fit, ..ChartView::default() }));
    let mut fit = window.app().state().settings.fit.clone();
    (fit.distance, fit.light_deg, fit.error) = ([1.0, 1.0], [0.0, 0.0], 1e-4);
    window.run(Command::SetFit(fit));
    let problem = |window: &mut Window| {
        press(window, Role::Button, "Fit to this scene");
        window.settle_measuring();
        let outcome = window.app().results().fit.outcome.clone().expect("it has ended");
        let problem = outcome.expect_err("it cannot be done");
        let (first, rest) = problem.split_at(1);
        let shown = first.to_uppercase() + rest;
        assert!(window.harness.query_all_by_label(&shown).count() > 0, "{shown:?} is on the screen");
        problem
    };
    let text = problem(&mut window);
    assert!(text.contains("no way stays within 0.0001") && text.contains("Allow a greater error"), "{text}");
    let mut look = window.app().state().document.look.clone();
    look.params.method = Method::Phong;
    window.run(Command::SetLook(Box::new(look)));
    assert!(problem(&mut window).contains("choose another method"));
}
