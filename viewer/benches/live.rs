//! From a moved slider to the new picture, as the window's user waits for it: `cargo bench -p tam-viewer --bench live`.
//!
//! Medians of [`RUNS`] changes per size of the map, in a view of 800 x 600 px: time of the map, and time until its picture is there.

use std::io::Write;
use std::time::{Duration, Instant};

use tam_viewer::app::{App, Command, Options};

/// Changes per size.
const RUNS: usize = 9;

fn main() {
    let ctx = egui::Context::default();
    let mut app = App::new(&ctx, Options::default()).expect("the application starts");
    let started = Instant::now();
    let mut time_s = 0.0;
    frames_until(&ctx, &mut app, &mut time_s, |app| app.results().picture.is_some());
    say(&format!("first picture after {:.0} ms", started.elapsed().as_secs_f64() * 1e3));
    frames_until(&ctx, &mut app, &mut time_s, |app| !app.is_busy());
    say(&format!("finished picture after {:.0} ms", started.elapsed().as_secs_f64() * 1e3));
    say(&format!("{:>6} {:>9} {:>12}", "map", "made", "shown after"));
    for size in [256_u32, 512, 1024] {
        let (mut made, mut shown) = (Vec::new(), Vec::new());
        for run in 0..=RUNS {
            let mut preset = app.state().document.preset.clone();
            preset.map.size = size;
            preset.stroke.width_px = 1.5 + run as f64 * 0.1;
            let before = app.results().picture.as_ref().map_or(0, |picture| picture.number);
            let start = Instant::now();
            app.run(&ctx, Command::SetPreset(Box::new(preset.clone())));
            frames_until(&ctx, &mut app, &mut time_s, |app| {
                let map = app.results().map.as_ref().is_some_and(|made| made.preset == preset);
                map && app.results().picture.as_ref().is_some_and(|picture| picture.number > before)
            });
            // The first changes the size, and makes room for it.
            if run > 0 {
                shown.push(start.elapsed());
                made.extend(app.results().map.as_ref().map(|made| made.took));
            }
            frames_until(&ctx, &mut app, &mut time_s, |app| !app.is_busy());
        }
        say(&format!("{size:>4} px {:>6.1} ms {:>9.1} ms", milliseconds(&mut made), milliseconds(&mut shown)));
    }
}

/// Draws frames until something has come to pass.
fn frames_until(ctx: &egui::Context, app: &mut App, time_s: &mut f64, done: impl Fn(&App) -> bool) {
    let start = Instant::now();
    loop {
        *time_s += 1.0 / 60.0;
        let input = egui::RawInput {
            screen_rect: Some(egui::Rect::from_min_size(egui::Pos2::ZERO, egui::vec2(1400.0, 950.0))),
            time: Some(*time_s),
            ..egui::RawInput::default()
        };
        // There is no screen: what would be uploaded is dropped.
        ctx.run_ui(input, |ui| app.show(ui)).textures_delta.clear();
        if done(app) {
            return;
        }
        let problems = (&app.results().picture_problem, &app.results().map_problem, &app.results().running);
        assert!(start.elapsed() < Duration::from_secs(60), "it never comes to pass: {problems:?}");
        std::thread::sleep(Duration::from_millis(1));
    }
}

fn say(line: &str) {
    let _ = writeln!(std::io::stdout().lock(), "{line}");
}

fn milliseconds(times: &mut [Duration]) -> f64 {
    times.sort();
    times[times.len() / 2].as_secs_f64() * 1e3
}
