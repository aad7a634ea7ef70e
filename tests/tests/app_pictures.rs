//! Draws the application's pictures of the front page, by using it for a whole task:
//! `cargo test -p tam-tests --test app_pictures -- --ignored`.

use std::path::PathBuf;

use egui_kittest::kittest::{NodeT, Queryable};
use image::RgbaImage;
use image::imageops::{FilterType, resize};
use tam_tests::app::Window;
use tam_viewer::app::{Command, MapTab, MeshSource, Pane, Theme};
use tam_viewer::mesh::sample::Sample;
use tam_viewer::turntable::{FrameFile, FrameWriter};
use tam_viewer::{Mapping, Method};

fn folder() -> PathBuf {
    PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("../viewer/pictures")
}

fn save(window: &mut Window, name: &str) {
    window.settle();
    let picture = window.harness.render().expect("a picture of the window");
    let path = folder().join(name);
    image::DynamicImage::from(picture).into_rgb8().save(&path).expect("a writable folder");
}

fn slide(window: &mut Window, name: &str, number: f64) {
    let sliders = window.harness.get_all_by_label(name);
    let slider = sliders.into_iter().find(|node| node.accesskit_node().role() == egui::accesskit::Role::Slider);
    slider.unwrap_or_else(|| panic!("{name} has a slider")).set_value_accesskit(number);
    window.harness.step();
}

fn set_mesh(window: &mut Window, sample: Sample) {
    window.run(Command::SetMesh(MeshSource::sample(sample)));
}

/// A new material for the hand: from the shipped pen, wider, bowed, on cream.
fn new_material(window: &mut Window) {
    set_mesh(window, Sample::Hand);
    window.run(Command::OpenShipped("fine-pen".to_owned()));
    window.run(Command::Duplicate);
    slide(window, "Width", 2.2);
    slide(window, "Bow", 0.03);
    slide(window, "Taper out", 0.6);
    let mut preset = window.app().state().document.preset.clone();
    (preset.colours.paper, preset.colours.ink) = ("#f6ecd9".to_owned(), "#7a2c1a".to_owned());
    window.run(Command::SetPreset(Box::new(preset)));
    window.settle();
}

#[test]
#[ignore = "draws the pictures of the front page"]
fn windows_in_three_sizes_dark_and_light() {
    let mut window = Window::open([1280.0, 720.0], None);
    window.settle();
    new_material(&mut window);
    save(&mut window, "app-hand-1280.png");

    let mut window = Window::open([1920.0, 1080.0], None);
    window.settle();
    new_material(&mut window);
    window.run(Command::SetTheme(Theme::Light));
    let mut shown = window.app().state().transient.map;
    (shown.tab, shown.column) = (MapTab::Nesting, 3);
    window.run(Command::ShowCell(shown));
    window.run(Command::ShowPane(Pane::Scene));
    window.run(Command::ShowPane(Pane::Shading));
    save(&mut window, "app-light-1920.png");

    let mut window = Window::open([2560.0, 1440.0], None);
    window.settle();
    set_mesh(&mut window, Sample::Head);
    window.run(Command::OpenShipped("engraving".to_owned()));
    let mut look = window.app().state().document.look.clone();
    (look.params.method, look.params.mapping) = (Method::FineTone, Mapping::Patches);
    window.run(Command::SetLook(Box::new(look)));
    window.harness.key_press(egui::Key::C);
    window.harness.step();
    window.settle();
    window.run(Command::ShowPane(Pane::Checks));
    window.run(Command::ShowPane(Pane::Export));
    save(&mut window, "app-compare-2560.png");
}

#[test]
#[ignore = "draws the pictures of the front page"]
fn the_chart_of_the_open_scene() {
    let mut window = Window::open([1920.0, 1080.0], None);
    window.settle();
    set_mesh(&mut window, Sample::Hand);
    window.run(Command::SetTheme(Theme::Light));
    window.run(Command::ShowPane(Pane::Scene));
    window.run(Command::ShowPane(Pane::Shading));
    window.run(Command::ShowPane(Pane::Chart));
    window.settle_measuring();
    save(&mut window, "app-chart-1920.png");
}

/// Width of the recording's frames.
const RECORDED: [u32; 2] = [640, 400];

#[test]
#[ignore = "draws the pictures of the front page"]
fn a_short_recording() {
    let mut window = Window::open([1120.0, 700.0], None);
    window.settle();
    let file = FrameFile::of(&folder().join("app.png")).expect("APNG");
    let mut frames: Vec<RgbaImage> = Vec::new();
    let shoot = |window: &mut Window, frames: &mut Vec<RgbaImage>| {
        window.settle();
        let picture = window.harness.render().expect("a picture of the window");
        frames.push(resize(&picture, RECORDED[0], RECORDED[1], FilterType::CatmullRom));
    };
    shoot(&mut window, &mut frames);
    for width in [2.4, 3.2, 4.2, 5.0, 3.4, 2.2] {
        slide(&mut window, "Width", width);
        shoot(&mut window, &mut frames);
    }
    for preset in ["ballpoint", "charcoal", "brush", "engraving"] {
        window.run(Command::OpenShipped(preset.to_owned()));
        window.run(Command::Discard(Box::new(Command::OpenShipped(preset.to_owned()))));
        shoot(&mut window, &mut frames);
    }
    set_mesh(&mut window, Sample::Hand);
    shoot(&mut window, &mut frames);
    for step in 0..6 {
        let mut lights = window.app().state().document.lights.clone();
        lights.lights[0] = tam_viewer::Light::from_angles(-40.0 + 22.0 * f64::from(step), 40.0);
        window.run(Command::SetLights(lights));
        shoot(&mut window, &mut frames);
    }
    window.harness.key_press(egui::Key::Num7);
    window.harness.step();
    shoot(&mut window, &mut frames);
    let mut writer = FrameWriter::new(&file, RECORDED, frames.len() as u32, 2, true).expect("a writable folder");
    frames.into_iter().for_each(|frame| writer.write(frame).expect("a frame"));
    writer.finish().expect("a recording");
}
