//! The application in a window that nobody sees.

use std::path::Path;
use std::time::{Duration, Instant};

use egui_kittest::Harness;
use tam_viewer::app::{App, Command, Options, setup};

/// Longest time that anything may take that the view shows.
const PATIENCE: Duration = Duration::from_secs(120);

/// Longest time that measuring may take: some forty ways of drawing, each in a dozen pictures.
const MEASURING: Duration = Duration::from_secs(400);

/// A window with the application.
pub struct Window {
    /// What is on the screen.
    pub harness: Harness<'static, App>,
}

impl Window {
    /// Opens the application in a window of this size, in points, with a session of its own or none.
    ///
    /// # Panics
    /// If it does not start.
    pub fn open(size: [f32; 2], session: Option<&Path>) -> Self {
        Self::with(size, Options { session: session.map(Path::to_owned), ..Options::default() })
    }

    /// Opens the application with these options.
    ///
    /// # Panics
    /// If it does not start.
    pub fn with(size: [f32; 2], options: Options) -> Self {
        let harness =
            Harness::builder().with_size(size).with_step_dt(0.1).wgpu_setup(setup()).build_eframe(move |creation| {
                let window = creation.wgpu_render_state.as_ref().expect("a device");
                App::new(&creation.egui_ctx, window, options).expect("the application starts")
            });
        Self { harness }
    }

    /// A window large enough for all panels, without a session, once its first picture is drawn.
    pub fn ready() -> Self {
        let mut window = Self::open([1440.0, 900.0], None);
        window.settle();
        window
    }

    /// Lets the application work until it is at rest.
    ///
    /// # Panics
    /// If it never is.
    pub fn settle(&mut self) {
        self.wait_until_still(PATIENCE, |app| !app.is_busy());
    }

    /// Lets the application work until the chart in sight and any fit are finished too.
    ///
    /// # Panics
    /// If they never are.
    pub fn settle_measuring(&mut self) {
        self.wait_until_still(MEASURING, |app| !app.is_busy() && !app.is_measuring());
    }

    fn wait_until_still(&mut self, patience: Duration, rests: impl Fn(&App) -> bool) {
        let start = Instant::now();
        let mut still = 0;
        while still < 4 {
            assert!(start.elapsed() < patience, "the application never comes to rest");
            self.harness.step();
            let app = self.harness.state();
            still = if app.results().picture.is_some() && rests(app) { still + 1 } else { 0 };
            if still == 0 {
                // What works beside the window needs the processor more than a window that waits.
                std::thread::sleep(Duration::from_millis(30));
            }
        }
    }

    /// Carries out a command and lets the application work until it is at rest.
    pub fn run(&mut self, command: Command) {
        let ctx = self.harness.ctx.clone();
        self.harness.state_mut().run(&ctx, command);
        self.settle();
    }

    /// The application.
    pub fn app(&self) -> &App {
        self.harness.state()
    }
}
