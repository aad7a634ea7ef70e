//! The window without a screen, for benchmarks of how long its user waits.

use std::io::Write;
use std::sync::mpsc::{Receiver, channel};
use std::time::{Duration, Instant};

use eframe::egui_wgpu::{RenderState, RendererOptions, WgpuConfiguration};
use tam_viewer::app::{App, Options, setup};

/// Least time between two frames of the window, and the greatest.
const FRAME: Duration = Duration::from_micros(16_667);
const REST: Duration = Duration::from_millis(100);

const PATIENCE: Duration = Duration::from_secs(60);

/// The window without a screen.
pub(crate) struct Desk {
    pub ctx: egui::Context,
    pub app: App,
    pub size: egui::Vec2,
    /// Least time between two frames.
    pub frame: Duration,
    /// Longest time that anything may take.
    pub patience: Duration,
    /// What the last frame took.
    pub laid_out: Duration,
    time_s: f64,
    /// Whether a button is down, as it is while a slider moves.
    pub held: bool,
    was_held: bool,
    /// When the application asked for another frame.
    asked: Receiver<()>,
}

impl Desk {
    /// Of this size in points, each a pixel; frames come as a display asks for them.
    pub(crate) fn new(size: [f32; 2]) -> Self {
        let ctx = egui::Context::default();
        let (ask, asked) = channel();
        ctx.set_request_repaint_callback(move |info| {
            // What is to be drawn later is drawn by the clock below.
            if info.delay.is_zero() {
                let _ = ask.send(());
            }
        });
        let app = App::new(&ctx, &device(), Options::default()).expect("the application starts");
        Self {
            ctx,
            app,
            size: size.into(),
            frame: FRAME,
            patience: PATIENCE,
            laid_out: Duration::ZERO,
            time_s: 0.0,
            held: false,
            was_held: false,
            asked,
        }
    }

    /// Draws frames until something has come to pass.
    pub(crate) fn frames_until(&mut self, mut done: impl FnMut(&App) -> bool) {
        let start = Instant::now();
        loop {
            let drawn = Instant::now();
            let mut input = egui::RawInput {
                screen_rect: Some(egui::Rect::from_min_size(egui::Pos2::ZERO, self.size)),
                time: Some(self.time_s),
                ..egui::RawInput::default()
            };
            if self.held != self.was_held {
                // In a corner where there is nothing to take hold of.
                let pos = egui::pos2(1.0, self.size.y - 1.0);
                let (button, modifiers) = (egui::PointerButton::Primary, egui::Modifiers::NONE);
                input.events.push(egui::Event::PointerButton { pos, button, pressed: self.held, modifiers });
                self.was_held = self.held;
            }
            // There is no screen: what would be uploaded is dropped.
            let app = &mut self.app;
            self.ctx.run_ui(input, |ui| app.show(ui)).textures_delta.clear();
            self.laid_out = drawn.elapsed();
            if done(&self.app) {
                return;
            }
            let results = self.app.results();
            let problems = (&results.picture_problem, &results.map_problem, &results.running);
            assert!(start.elapsed() < self.patience, "it never comes to pass: {problems:?}");
            // The time of the display's frame, and then until there is something to show.
            std::thread::sleep(self.frame.saturating_sub(drawn.elapsed()));
            let _ = self.asked.recv_timeout(REST.saturating_sub(drawn.elapsed()));
            while self.asked.try_recv().is_ok() {}
            self.time_s += drawn.elapsed().as_secs_f64();
        }
    }
}

/// As a window has it, without a window.
fn device() -> RenderState {
    let config = WgpuConfiguration { wgpu_setup: setup(), ..WgpuConfiguration::default() };
    let made = async {
        let instance = config.wgpu_setup.new_instance().await;
        RenderState::create(&config, &instance, None, RendererOptions::default()).await
    };
    pollster::block_on(made).expect("an adapter")
}

/// Prints a line.
pub(crate) fn say(line: &str) {
    let _ = writeln!(std::io::stdout().lock(), "{line}");
}

/// The median.
pub(crate) fn milliseconds(times: &mut [Duration]) -> f64 {
    times.sort();
    times[times.len() / 2].as_secs_f64() * 1e3
}
