//! What the window adds to a picture, and what comes to the screen while something moves: `cargo bench -p tam-viewer --bench
//! window`; after `--`, a number of triangles chooses the rows of that mesh.
//!
//! The camera turns about the mesh by a degree a picture, as if the mouse dragged it. Medians of [`RUNS`] pictures: from
//! the change to the picture in the window's hands, the device's own part of that, and what is beyond it; then what the
//! window takes to lay itself out.

mod desk;

use std::time::{Duration, Instant};

use desk::{Desk, milliseconds, say};
use tam_viewer::Camera;
use tam_viewer::app::{Command, MeshSource};
use tam_viewer::mesh::sample::Sample;

/// Pictures per row.
const RUNS: usize = 30;

fn main() {
    say(&format!(
        "{:>11} {:>9} {:>12} {:>10} {:>10} {:>10} {:>10} {:>10}",
        "view", "triangles", "drawn at", "whole", "slowest", "on device", "beyond", "window"
    ));
    let wanted = std::env::args().skip(1).find(|word| !word.starts_with("--"));
    for (size_px, triangles) in
        [([1024, 1024], 6_000), ([3840, 2160], 6_000), ([1024, 1024], 100_000), ([1024, 1024], 870_000)]
    {
        if wanted.as_ref().is_none_or(|wanted| *wanted == triangles.to_string()) {
            row(size_px, triangles);
        }
    }
}

fn row(size_px: [u32; 2], triangles: usize) {
    let mut desk = Desk::new(size_px.map(|side| side as f32));
    desk.app.run(&desk.ctx, Command::SetMesh(MeshSource::Sample(Sample::Teapot, triangles)));
    desk.patience = Duration::from_secs(600);
    // Panels take their shares, so it takes some steps.
    for _ in 0..20 {
        desk.frames_until(|app| {
            !app.is_busy() && app.results().picture.as_ref().is_some_and(|picture| picture.is_still())
        });
        if give_view(&mut desk, size_px) {
            break;
        }
    }
    desk.frame = Duration::ZERO;
    desk.held = true;
    let camera = desk.app.state().camera;
    let (mut whole, mut on_device, mut beyond, mut window) = (Vec::new(), Vec::new(), Vec::new(), Vec::new());
    let mut drawn_px = [0; 2];
    for run in 0..RUNS + 5 {
        let number = desk.app.results().picture.as_ref().map(|picture| picture.number);
        let moved = Camera { azimuth_deg: camera.azimuth_deg + 1.0 + run as f64, ..camera };
        desk.app.run(&desk.ctx, Command::SetCamera(moved));
        let (mut came, start) = (Duration::ZERO, Instant::now());
        desk.frames_until(|app| {
            let picture = app.results().picture.as_ref();
            let is_new = picture.map(|picture| picture.number) != number;
            came = picture.map_or(came, |picture| picture.asked.elapsed());
            is_new
        });
        let waited = start.elapsed();
        // The first ones find out how costly pictures are.
        if let Some(picture) = desk.app.results().picture.as_ref().filter(|_| run >= 5) {
            drawn_px = picture.canvas.size_px();
            whole.push(waited);
            on_device.push(picture.cost);
            beyond.push(came.saturating_sub(picture.cost + desk.laid_out));
            window.push(desk.laid_out);
        }
    }
    let slowest = whole.iter().max().map_or(0.0, |time| time.as_secs_f64() * 1e3);
    let [whole, on_device, beyond, window] =
        [whole, on_device, beyond, window].map(|mut times| milliseconds(&mut times));
    say(&format!(
        "{:>11} {triangles:>9} {:>12} {whole:>7.1} ms {slowest:>7.1} ms {on_device:>7.1} ms {beyond:>7.2} ms {window:>7.2} ms",
        format!("{}x{}", size_px[0], size_px[1]),
        format!("{}x{}", drawn_px[0], drawn_px[1]),
    ));
}

/// Makes the window larger or smaller, so that its view comes nearer to this size; whether it has that already.
fn give_view(desk: &mut Desk, size_px: [u32; 2]) -> bool {
    let shown = desk.app.results().picture.as_ref().filter(|picture| picture.is_still());
    let has = shown.map_or(size_px, |picture| picture.canvas.size_px());
    for axis in 0..2 {
        desk.size[axis] += size_px[axis] as f32 - has[axis] as f32;
    }
    has == size_px
}
