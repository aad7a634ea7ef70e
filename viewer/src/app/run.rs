//! Opens the window.

use std::panic::{AssertUnwindSafe, catch_unwind, resume_unwind, set_hook, take_hook};
use std::path::PathBuf;
use std::sync::Arc;

use eframe::NativeOptions;
use eframe::egui_wgpu::{WgpuConfiguration, WgpuSetup, WgpuSetupCreateNew};

use super::window::{App, Options};
use crate::gpu::{Gpu, GpuOptions};

/// Smallest window in which everything can be reached, in points.
const LEAST: [f32; 2] = [880.0, 560.0];

/// Why there is no window.
#[derive(Debug, thiserror::Error)]
pub enum AppError {
    /// The system gives none.
    #[error("no window can be opened: {0}")]
    Window(String),
    /// The picture of the window could not be written.
    #[error("the picture of the window could not be written: {0}")]
    Picture(String),
}

/// How the window is opened.
#[derive(Clone, Debug, Default)]
pub struct WindowOptions {
    /// What the application starts with.
    pub app: Options,
    /// Width and height in points; `None`: as it was left.
    pub size: Option<[f32; 2]>,
    /// Write a picture of the window here once all is drawn, and close it.
    pub picture: Option<PathBuf>,
}

/// Opens the window and returns when it is closed.
///
/// # Errors
/// [`AppError`]: no display, no adapter, or the picture that was asked for could not be written.
pub fn run(options: WindowOptions) -> Result<(), AppError> {
    let viewport = egui::ViewportBuilder::default()
        .with_title("tam-viewer")
        .with_app_id("tam-viewer")
        .with_min_inner_size(LEAST)
        .with_inner_size(options.size.unwrap_or([1440.0, 900.0]));
    let native = NativeOptions {
        viewport,
        persist_window: options.size.is_none() && options.picture.is_none(),
        wgpu_options: WgpuConfiguration { wgpu_setup: setup(), ..WgpuConfiguration::default() },
        ..NativeOptions::default()
    };
    let (sent, written) = std::sync::mpsc::channel();
    // What draws the panels, and whatever else draws, breaks down on a device that is lost: nobody needs to read of that.
    let (told, left) = (take_hook(), options.app.left.clone());
    set_hook(Box::new(move |panic| if left.is_device_lost() { tracing::debug!("{panic}") } else { told(panic) }));
    let mut opened = 0;
    loop {
        let (start, picture, sent) = (options.app.clone(), options.picture.clone(), sent.clone());
        let creator = move |creation: &eframe::CreationContext<'_>| -> Result<Box<dyn eframe::App>, _> {
            let window = creation.wgpu_render_state.as_ref().ok_or("the window is not drawn by wgpu")?;
            let app = App::new(&creation.egui_ctx, window, start)?;
            Ok(match picture {
                Some(path) => Box::new(Photographer { app, path, still: 0, asked: false, sent }),
                None => Box::new(app) as Box<dyn eframe::App>,
            })
        };
        let native = native.clone();
        let ended = catch_unwind(AssertUnwindSafe(|| eframe::run_native("tam-viewer", native, Box::new(creator))));
        opened += 1;
        match ended {
            // All was left for the next window.
            _ if options.app.left.is_some() && opened <= REOPENED => {
                tracing::warn!("the graphics device went away; the window is opened again");
            }
            _ if options.app.left.is_some() => {
                return Err(AppError::Window("its graphics device is lost again and again".to_owned()));
            }
            Ok(Ok(())) => break,
            Ok(Err(error)) => return Err(AppError::Window(error.to_string())),
            Err(panic) => resume_unwind(panic),
        }
    }
    match written.try_recv() {
        Ok(Err(problem)) => Err(AppError::Picture(problem)),
        _ => Ok(()),
    }
}

/// Windows that are opened after one whose device was lost.
const REOPENED: u32 = 5;

/// How a window opens the device on which it and its pictures are drawn: the adapter that [`Gpu::open`] takes, of those
/// that can show a window, with all that drawing makes use of.
pub fn setup() -> WgpuSetup {
    let select = |adapters: &[wgpu::Adapter], surface: Option<&wgpu::Surface<'_>>| {
        let shows = |adapter: &&wgpu::Adapter| surface.is_none_or(|surface| adapter.is_surface_supported(surface));
        let able: Vec<wgpu::Adapter> = adapters.iter().filter(shows).cloned().collect();
        Gpu::choose(&able, &GpuOptions::default()).cloned().map_err(|error| error.to_string())
    };
    WgpuSetup::CreateNew(WgpuSetupCreateNew {
        native_adapter_selector: Some(Arc::new(select)),
        device_descriptor: Arc::new(Gpu::descriptor),
        ..WgpuSetupCreateNew::without_display_handle()
    })
}

/// Frames without any work after which the window has come to rest.
const AT_REST: u32 = 8;

/// Runs the application until all is drawn, takes a picture of the window, and closes it.
struct Photographer {
    app: App,
    path: PathBuf,
    still: u32,
    asked: bool,
    sent: std::sync::mpsc::Sender<Result<(), String>>,
}

impl eframe::App for Photographer {
    fn ui(&mut self, ui: &mut egui::Ui, frame: &mut eframe::Frame) {
        eframe::App::ui(&mut self.app, ui, frame);
        let ready = self.app.results().picture.is_some() && !self.app.is_busy() && !self.app.is_measuring();
        self.still = if ready { self.still + 1 } else { 0 };
        ui.ctx().request_repaint();
        if self.still > AT_REST && !self.asked {
            self.asked = true;
            let (path, sent, ctx) = (self.path.clone(), self.sent.clone(), ui.ctx().clone());
            ui.ctx().request_screenshot(move |image| {
                // A window that is closed meanwhile asks for no answer.
                let _ = sent.send(write(&path, &image));
                ctx.send_viewport_cmd(egui::ViewportCommand::Close);
                ctx.request_repaint();
            });
        }
    }
}

/// Colours of a window that shows anything at all: letters alone have as many shades.
const COLOURS: usize = 64;

fn write(path: &std::path::Path, image: &egui::ColorImage) -> Result<(), String> {
    let colours: std::collections::HashSet<_> = image.pixels.iter().collect();
    if colours.len() < COLOURS {
        return Err("the window is blank".to_owned());
    }
    let pixels = image.pixels.iter().flat_map(|pixel| pixel.to_array()).collect();
    let picture = image::RgbaImage::from_raw(image.size[0] as u32, image.size[1] as u32, pixels)
        .ok_or_else(|| "it has no pixels".to_owned())?;
    let mut png = std::io::Cursor::new(Vec::new());
    picture.write_to(&mut png, image::ImageFormat::Png).map_err(|error| error.to_string())?;
    tam_gen::files::replace(path, png.get_ref()).map_err(|error| format!("{}: {error}", path.display()))
}
