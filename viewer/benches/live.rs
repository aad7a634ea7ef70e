//! From a moved slider to the new picture, as the window's user waits for it: `cargo bench -p tam-viewer --bench live`.
//!
//! Frames are drawn when the application asks for them, as a window does. Medians of [`RUNS`] changes per size of the map, in a view of 800 x 600 px: what map was made meanwhile, in what time; the
//! time until its picture is there; and, from letting go, until the whole map is seen in a picture to be looked at.

use std::io::Write;
use std::sync::mpsc::{Receiver, channel};
use std::time::{Duration, Instant};

use tam_viewer::app::{App, Command, Options};

/// Changes per size.
const RUNS: usize = 9;

/// Least time between two frames of the window, and the greatest.
const FRAME: Duration = Duration::from_micros(16_667);
const REST: Duration = Duration::from_millis(100);

fn main() {
    let mut desk = Desk::new();
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
    shown.zip(results.map.as_ref()).is_some_and(|(shown, made)| std::sync::Arc::ptr_eq(shown, &made.hatch))
}

/// The window without a screen.
struct Desk {
    ctx: egui::Context,
    app: App,
    time_s: f64,
    /// Whether a button is down, as it is while a slider moves.
    held: bool,
    was_held: bool,
    /// When the application asked for another frame.
    asked: Receiver<()>,
}

impl Desk {
    fn new() -> Self {
        let ctx = egui::Context::default();
        let (ask, asked) = channel();
        ctx.set_request_repaint_callback(move |info| {
            // What is to be drawn later is drawn by the clock below.
            if info.delay.is_zero() {
                let _ = ask.send(());
            }
        });
        let app = App::new(&ctx, Options::default()).expect("the application starts");
        Self { ctx, app, time_s: 0.0, held: false, was_held: false, asked }
    }

    /// Draws frames until something has come to pass.
    fn frames_until(&mut self, done: impl Fn(&App) -> bool) {
        let start = Instant::now();
        loop {
            let drawn = Instant::now();
            let mut input = egui::RawInput {
                screen_rect: Some(egui::Rect::from_min_size(egui::Pos2::ZERO, egui::vec2(1400.0, 950.0))),
                time: Some(self.time_s),
                ..egui::RawInput::default()
            };
            if self.held != self.was_held {
                // In a corner where there is nothing to take hold of.
                let pos = egui::pos2(1.0, 949.0);
                let (button, modifiers) = (egui::PointerButton::Primary, egui::Modifiers::NONE);
                input.events.push(egui::Event::PointerButton { pos, button, pressed: self.held, modifiers });
                self.was_held = self.held;
            }
            // There is no screen: what would be uploaded is dropped.
            let app = &mut self.app;
            self.ctx.run_ui(input, |ui| app.show(ui)).textures_delta.clear();
            if done(&self.app) {
                return;
            }
            let results = self.app.results();
            let problems = (&results.picture_problem, &results.map_problem, &results.running);
            assert!(start.elapsed() < Duration::from_secs(60), "it never comes to pass: {problems:?}");
            // The time of the display's frame, and then until there is something to show.
            std::thread::sleep(FRAME.saturating_sub(drawn.elapsed()));
            let _ = self.asked.recv_timeout(REST.saturating_sub(drawn.elapsed()));
            while self.asked.try_recv().is_ok() {}
            self.time_s += drawn.elapsed().as_secs_f64();
        }
    }
}

fn say(line: &str) {
    let _ = writeln!(std::io::stdout().lock(), "{line}");
}

fn milliseconds(times: &mut [Duration]) -> f64 {
    times.sort();
    times[times.len() / 2].as_secs_f64() * 1e3
}
