//! Finds the least that the open scene needs.

use std::sync::Arc;
use std::time::{Duration, Instant};

use tam_gen::{GenerateError, Job};

use super::stand::{Stand, is_lost};
use super::subject::{Subject, bare};
use super::surface::{MadeSurface, SurfaceRequest, make_surface};
use super::worker::{Manner, Wake, Worker};
use crate::app::state::FitSettings;
use crate::app::words;
use crate::fit::{Bench, Fit, FitError, FitOptions, fit};
use crate::surface::SurfaceError;
use crate::{Follow, Mapping, Method, RenderParams};

/// Pixels of a picture in which tone is measured, at most: those of most views. Larger maps are sampled in larger
/// pictures, so that what is fitted holds for no more than these.
pub(super) const PICTURE_PX: f64 = 768.0 * 768.0;

/// Pairs of frames that are timed per way.
const PAIRS: u32 = 7;

/// What a fit has found.
#[derive(Debug)]
pub struct FittedScene {
    /// The present way, the fitted one, and what fails below it.
    pub fit: Fit,
    /// Size of the pictures that it was measured in.
    pub size_px: [u32; 2],
    /// How long that took.
    pub took: Duration,
    subject: Subject,
    settings: FitSettings,
}

impl FittedScene {
    /// What was asked for.
    pub fn asked(&self) -> &FitSettings {
        &self.settings
    }
}

/// What became of the last fit that was asked for.
#[derive(Default)]
pub struct FitResults {
    /// Part done, while it runs.
    pub progress: Option<f32>,
    /// What it found, or why it found nothing.
    pub outcome: Option<Result<Arc<FittedScene>, String>>,
    /// Whether scene and settings are still those that were fitted.
    pub is_current: bool,
}

pub(super) struct FitRequest {
    subject: Subject,
    settings: FitSettings,
    of_view: Option<MadeSurface>,
}

/// `None`: it was stopped.
type FitReply = Option<Result<Arc<FittedScene>, String>>;

/// Fits when it is asked to.
pub(super) struct FitDesk {
    worker: Worker<FitRequest, FitReply>,
}

impl FitDesk {
    pub(super) fn start(wake: &Wake) -> std::io::Result<Self> {
        let work = |stand: &mut Option<Stand>, request: FitRequest, job: &Job<'_>, reply: &dyn Fn(FitReply)| {
            let fitted = match fitted(stand, &request, job) {
                Err(Failure::Render(error)) if is_lost(&error) => {
                    *stand = None;
                    fitted(stand, &request, job)
                }
                result => result,
            };
            reply(match fitted {
                Ok(fitted) => Some(Ok(Arc::new(fitted))),
                Err(Failure::Cancelled) => None,
                Err(Failure::Render(error)) => Some(Err(error.to_string())),
                Err(Failure::Told(problem)) => Some(Err(problem)),
            });
        };
        let failed = |words: String| Some(Err(format!("the scene could not be fitted: {words}")));
        let worker = Worker::start(
            "fit",
            Manner { patience: Duration::ZERO, leaves_behind: false },
            Arc::clone(wake),
            || None,
            work,
            failed,
        )?;
        Ok(Self { worker })
    }

    pub(super) fn is_busy(&self) -> bool {
        self.worker.is_busy()
    }

    /// Begins; what it is about to say of the last one is forgotten.
    pub(super) fn fit(&self, subject: Subject, settings: FitSettings, made: &[MadeSurface], results: &mut FitResults) {
        results.outcome = None;
        if let Some(problem) = refusal(&subject) {
            results.outcome = Some(Err(problem.to_owned()));
            return;
        }
        let options = subject.surface_options(&all_ways(&subject, &settings));
        let of_view = subject.made(&options, made).cloned();
        self.worker.request(FitRequest { subject, settings, of_view });
    }

    pub(super) fn cancel(&self) {
        self.worker.cancel();
    }

    /// Takes what was found.
    pub(super) fn collect(&self, results: &mut FitResults) {
        for reply in self.worker.replies() {
            results.outcome = reply;
        }
    }

    /// Looks whether the last fit is of the open scene.
    pub(super) fn follow(&self, subject: Option<&Subject>, settings: &FitSettings, results: &mut FitResults) {
        results.progress = self.worker.progress();
        results.is_current = match (&results.outcome, subject) {
            (Some(Ok(fitted)), Some(subject)) => fitted.subject == *subject && fitted.settings == *settings,
            (Some(Ok(_)), None) => false,
            _ => true,
        };
    }
}

/// Why a scene cannot be fitted at all.
fn refusal(subject: &Subject) -> Option<&'static str> {
    let params = &subject.look.params;
    if params.method == Method::Phong {
        return Some("Phong draws no strokes that could be fitted: choose another method under Shading first.");
    }
    let turns = params.follow == Follow::Light && params.needed_mapping() == Some(Mapping::Patches);
    turns.then_some("Strokes that turn with the light cannot be fitted: untick that under Shading first.")
}

/// The present way, and each that may take its place.
fn all_ways(subject: &Subject, settings: &FitSettings) -> Vec<RenderParams> {
    let present = RenderParams { follow: Follow::Surface, ..bare(&subject.look.params) };
    let mut ways = vec![present];
    let has_uv = !subject.mesh.uvs.is_empty();
    for method in settings.methods.iter().filter(|method| **method != Method::Phong) {
        let others = settings.mappings.iter().filter(|mapping| has_uv || **mapping != Mapping::Uv);
        let mappings = std::iter::once(&present.mapping).chain(others);
        for mapping in mappings.take(if method.takes_mapping() { usize::MAX } else { 1 }) {
            let way = RenderParams { method: *method, mapping: *mapping, ..present };
            if !ways.contains(&way) {
                ways.push(way);
            }
        }
    }
    ways
}

enum Failure {
    Cancelled,
    Render(crate::RenderError),
    Told(String),
}

impl From<FitError> for Failure {
    fn from(error: FitError) -> Self {
        match error {
            FitError::Generate(GenerateError::Cancelled) => Self::Cancelled,
            FitError::Render(error) => Self::Render(error),
            error @ FitError::OutOfReach { .. } => {
                Self::Told(format!("{error}. Allow a greater error, a narrower range, or other methods."))
            }
            error @ FitError::Unseen(_) => Self::Told(format!("{error}. Choose other distances.")),
            error => Self::Told(error.to_string()),
        }
    }
}

fn fitted(stand: &mut Option<Stand>, request: &FitRequest, job: &Job<'_>) -> Result<FittedScene, Failure> {
    let FitRequest { subject, settings, of_view } = request;
    let start = Instant::now();
    let ways = all_ways(subject, settings);
    let options = subject.surface_options(&ways);
    let needs_surface = options.patches.is_some() || options.lapped.is_some() || options.stripes.is_some();
    let made = match of_view {
        _ if !needs_surface => None,
        Some(made) => Some(made.clone()),
        None => {
            let most = super::engine::SURFACE_TRIANGLES;
            if subject.mesh.triangles.len() > most {
                let most = words::counted(most, "triangle");
                return Err(Failure::Told(format!(
                    "Strokes follow meshes of up to {most}: untick patches and stripes."
                )));
            }
            let quiet = Job { progress: None, ..*job };
            let request = SurfaceRequest { mesh: subject.mesh.clone(), options };
            Some(make_surface(request, &quiet).map_err(|error| match error {
                SurfaceError::Cancelled => Failure::Cancelled,
                error => Failure::Told(format!("strokes cannot follow this mesh: {error}")),
            })?)
        }
    };
    let mesh = made.as_ref().map_or(&subject.mesh, |made| &made.mesh);
    let stand = match stand {
        Some(stand) => stand,
        None => stand.insert(Stand::open().map_err(|error| Failure::Render(error.into()))?),
    };
    let surface = made.as_ref().map(|made| &made.surface);
    let (renderer, setting) = stand.with(mesh, surface, subject.size_px).map_err(Failure::Render)?;
    let mut bench = Bench { renderer, setting, mesh, name: &subject.name, preset: &subject.preset };
    let options =
        FitOptions { range: settings.range(), error: settings.error, full: ways[0], ways: &ways, pairs: PAIRS };
    let fit = fit(&mut bench, &subject.scene, &options, job)?;
    Ok(FittedScene {
        fit,
        size_px: subject.size_px,
        took: start.elapsed(),
        subject: subject.clone(),
        settings: settings.clone(),
    })
}
