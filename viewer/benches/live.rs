//! From a moved slider to the new picture, as the window's user waits for it: `cargo bench -p tam-viewer --bench live`.
//!
//! Frames are drawn when the application asks for them, as a window does. Medians of [`RUNS`] changes per size of the map, in a view of 800 x 600 px: what map was made meanwhile, in what time; the
//! time until its picture is there; and, from letting go, until the whole map is seen in a picture to be looked at.

mod desk;

use std::time::Instant;

use desk::{Desk, milliseconds, say};
use tam_viewer::app::{App, Command};

/// Changes per size.
const RUNS: usize = 9;

fn main() {
    let mut desk = Desk::new([1400.0, 950.0]);
    let started = Instant::now();
    desk.frames_until(|app| app.results().picture.is_some());
    say(&format!("first picture after {:.0} ms", started.elapsed().as_secs_f64() * 1e3));
    desk.frames_until(|app| {
        let results = app.results();
        let laid = results.picture.as_ref().is_some_and(|picture| picture.is_still() && picture.surface.is_some());
        laid && is_shown(app)
    });
    say(&format!("finished picture after {:.0} ms", started.elapsed().as_secs_f64() * 1e3));
    desk.frames_until(|app| !app.is_busy());
    say(&format!("all small pictures and checks after {:.0} ms", started.elapsed().as_secs_f64() * 1e3));
    say(&format!(
        "{:>7} {:>11} {:>9} {:>9} {:>12} {:>12}",
        "map", "made of", "made in", "drawn in", "shown after", "whole after"
    ));
    for size in [256_u32, 512, 1024] {
        let (mut side, mut made, mut drawn, mut shown, mut whole) = (0, Vec::new(), Vec::new(), Vec::new(), Vec::new());
        for run in 0..=RUNS {
            let mut preset = desk.app.state().document.preset.clone();
            preset.map.size = size;
            preset.stroke.width_px = 1.5 + run as f64 * 0.1;
            let start = Instant::now();
            desk.held = true;
            desk.app.run(&desk.ctx, Command::SetPreset(Box::new(preset.clone())));
            desk.frames_until(|app| {
                app.results().map.as_ref().is_some_and(|made| made.preset == preset) && is_shown(app)
            });
            // The first changes the size, and makes room for it.
            if run > 0 {
                shown.push(start.elapsed());
                if let Some(map) = &desk.app.results().map {
                    side = map.map.grid.levels[0].size;
                    made.push(map.took);
                    drawn.extend(desk.app.results().picture.as_ref().map(|picture| picture.cost));
                }
            }
            let start = Instant::now();
            desk.held = false;
            desk.frames_until(|app| {
                let still = app.results().picture.as_ref().is_some_and(|picture| picture.is_still());
                still && app.results().map.as_ref().is_some_and(|made| !made.draft) && is_shown(app)
            });
            if run > 0 {
                whole.push(start.elapsed());
            }
            desk.frames_until(|app| !app.is_busy());
        }
        let [made, drawn, shown, whole] = [made, drawn, shown, whole].map(|mut times| milliseconds(&mut times));
        say(&format!("{size:>4} px {side:>8} px {made:>6.1} ms {drawn:>6.1} ms {shown:>9.1} ms {whole:>9.1} ms"));
    }
}

/// Whether the picture is of the map that was made last.
fn is_shown(app: &App) -> bool {
    let results = app.results();
    let shown = results.picture.as_ref().and_then(|picture| picture.map.as_ref());
    shown.zip(results.map.as_ref()).is_some_and(|(shown, made)| *shown == made.hatch)
}
