//! The view on the window's device: what is made, what is drawn, and what becomes of a window whose device is lost.

use std::time::{Duration, Instant};

use egui_kittest::kittest::Queryable;
use tam_tests::app::Window;
use tam_viewer::Camera;
use tam_viewer::app::{Command, Leaving, MeshSource, Options};
use tam_viewer::gpu::Made;
use tam_viewer::mesh::sample::Sample;

use super::helpers::{difference, picture};

/// Frames over which nothing may be made.
const FRAMES: u32 = 100;

fn number(window: &Window) -> u64 {
    window.app().results().picture.as_ref().expect("a picture").number
}

/// Lets the window draw until there is another picture.
fn next_picture(window: &mut Window) {
    let (before, start) = (number(window), Instant::now());
    while number(window) == before {
        assert!(start.elapsed() < Duration::from_secs(60), "no picture comes");
        window.harness.step();
        std::thread::sleep(Duration::from_millis(1));
    }
}

#[test]
fn pictures_of_a_camera_that_moves_make_nothing_on_the_device() {
    let mut window = Window::ready();
    let camera = window.app().state().camera;
    let turned = |frame: u32| Camera { azimuth_deg: camera.azimuth_deg + f64::from(frame), ..camera };
    let draw = |window: &mut Window, frame: u32| {
        let ctx = window.harness.ctx.clone();
        window.harness.state_mut().run(&ctx, Command::SetCamera(turned(frame)));
        next_picture(window);
    };
    let before = window.app().gpu().made();
    assert!(before.buffers > 0 && before.textures > 0 && before.bind_groups > 0 && before.pipelines > 0, "{before:?}");
    let mut round = |from: u32| {
        let before = window.app().gpu().made();
        (from..from + FRAMES).for_each(|frame| draw(&mut window, frame));
        let after = window.app().gpu().made();
        // How large pictures are that pass goes with what they cost, and those of another size are drawn into textures of
        // their own.
        assert!(after.textures - before.textures < u64::from(FRAMES), "most are drawn into those before");
        Made { textures: before.textures, ..after } == before
    };
    // The first that pass are drawn by pipelines of their own, which have one sample: that is once.
    assert!((0..3).any(|number| round(1 + number * FRAMES)), "every round makes something");
}

#[test]
fn frames_in_which_nothing_changed_draw_nothing() {
    let mut window = Window::ready();
    let before = (number(&window), window.app().gpu().made());
    window.harness.run_steps(FRAMES as usize);
    assert_eq!((number(&window), window.app().gpu().made()), before);
}

#[test]
fn the_window_shows_the_pixels_that_are_on_the_device() {
    let mut window = Window::ready();
    window.run(Command::SetMesh(MeshSource::Sample(Sample::Teapot, 2000)));
    let view = window.harness.get_by_label("Picture of the mesh").rect();
    let drawn = picture(&window);
    let size = window.app().results().picture.as_ref().expect("a picture").canvas.size_px();
    let drawn = image::RgbaImage::from_raw(size[0], size[1], drawn).expect("all pixels");
    let seen = window.harness.render().expect("a picture of the window");
    // The lower third, where nothing lies over it.
    let (left, top) = (view.left().round() as u32, view.top().round() as u32);
    let rows = size[1] * 2 / 3..size[1] - 40;
    let pixels = rows.flat_map(|y| (20..size[0] - 20).map(move |x| (x, y)));
    let (mut count, mut off) = (0, 0);
    for (x, y) in pixels {
        let (own, shown) = (drawn.get_pixel(x, y).0, seen.get_pixel(left + x, top + y).0);
        count += 1;
        off += u32::from(own.into_iter().zip(shown).any(|(own, shown)| own.abs_diff(shown) > 1));
    }
    assert!(count > 10_000 && off == 0, "{off} of {count} pixels differ");
}

#[test]
fn a_window_whose_device_is_lost_leaves_everything_to_the_next_one() {
    let left = Leaving::default();
    let options = || Options { left: left.clone(), ..Options::default() };
    let mut window = Window::with([1440.0, 900.0], options());
    window.settle();
    window.run(Command::SetMesh(MeshSource::Sample(Sample::Chair, 3000)));
    let (state, shown) = (window.app().state().clone(), picture(&window));
    window.app().gpu().device.destroy();
    let camera = Camera { azimuth_deg: state.camera.azimuth_deg + 10.0, ..state.camera };
    let ctx = window.harness.ctx.clone();
    window.harness.state_mut().run(&ctx, Command::SetCamera(camera));
    let start = Instant::now();
    while !left.is_some() {
        assert!(start.elapsed() < Duration::from_secs(60), "nobody notices that the device is gone");
        window.harness.step();
    }
    drop(window);
    let mut window = Window::with([1440.0, 900.0], options());
    window.settle();
    assert!(!left.is_some());
    let now = window.app().state();
    assert_eq!((&now.document, &now.settings), (&state.document, &state.settings));
    assert_eq!(now.camera, camera);
    let told: Vec<_> = window.app().messages().iter().map(|message| message.text.as_str()).collect();
    assert!(told.iter().any(|text| text.contains("device went away")), "{told:?}");
    // What was done before can be undone.
    window.run(Command::Undo);
    assert_ne!(window.app().state().document, state.document);
    window.run(Command::Redo);
    window.run(Command::SetCamera(state.camera));
    assert_eq!(difference(&shown, &picture(&window)), 0.0);
}
