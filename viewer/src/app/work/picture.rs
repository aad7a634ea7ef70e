//! The picture of the view, and the thumbnails of galleries, which are drawn when the view rests.

use std::sync::Arc;
use std::time::{Duration, Instant};

use tam_gen::Job;

use super::canvases::Canvas;
use super::named::Named;
use super::painter::{Painted, Painter, Shot};
use super::thumbnails::{ThumbnailRequest, Thumbnails};
use super::worker::{Manner, Wake, Worker};
use crate::gpu::{Gpu, GpuError};
use crate::maps::HatchMap;
use crate::surface::Surface;
use crate::{Camera, RenderError};

/// A picture that was drawn, on the window's device.
pub struct Shown {
    /// Its pixels.
    pub canvas: Arc<Canvas>,
    /// Time on the device.
    pub cost: Duration,
    /// When it was asked for.
    pub asked: Instant,
    /// When it began to be drawn: what was drawn before is finished first.
    pub began: Instant,
    /// Counts pictures.
    pub number: u64,
    /// As it was drawn, going round where that plays.
    pub camera: Camera,
    /// The map that it was drawn with, on the side of the document.
    pub map: Option<Named<HatchMap>>,
    /// The surface by which strokes lay on that side; none where the mapping takes none, or it is still to be made.
    pub surface: Option<Named<Surface>>,
    /// Whether it is coarser than what is looked at, as another follows at once.
    passing: bool,
    /// Per pixel.
    pub(super) samples: u32,
}

impl Shown {
    /// Whether it is to be looked at, not one of many that pass.
    pub fn is_still(&self) -> bool {
        !self.passing
    }
}

/// A picture that is asked for.
pub(super) struct ViewRequest {
    pub shot: Shot,
    /// Whether it is coarser than what is looked at, as another follows at once: it is finished in any case.
    pub passing: bool,
    /// In how many bands it is drawn. Between them it can be given up, and the window can draw itself.
    pub bands: u32,
    pub asked: Instant,
}

pub(super) enum PictureRequest {
    View(Box<ViewRequest>),
    Thumbnail(ThumbnailRequest),
}

pub(super) enum PictureReply {
    Shown(Shown),
    Thumbnail {
        key: String,
        canvas: Arc<Canvas>,
    },
    /// The window's device went away, for this reason.
    Lost(String),
    Failed(String),
}

pub(super) type PictureWorker = Worker<PictureRequest, PictureReply>;

struct Studio {
    painter: Painter,
    thumbnails: Thumbnails,
    number: u64,
}

/// Starts the worker that draws on the window's device.
pub(super) fn picture_worker(wake: Wake, gpu: Gpu) -> std::io::Result<PictureWorker> {
    let failed = |words: String| PictureReply::Failed(format!("the picture could not be drawn: {words}"));
    Worker::start(
        "pictures",
        Manner { patience: Duration::ZERO, leaves_behind: false },
        wake,
        move || Studio::new(gpu.clone()),
        Studio::serve,
        failed,
    )
}

impl Studio {
    fn new(gpu: Gpu) -> Self {
        Self { painter: Painter::new(gpu), thumbnails: Thumbnails::default(), number: 0 }
    }

    fn serve(&mut self, request: PictureRequest, job: &Job<'_>, reply: &dyn Fn(PictureReply)) {
        match self.draw(request, job, reply) {
            Ok(()) => {}
            Err(RenderError::Gpu(GpuError::Lost(cause))) => reply(PictureReply::Lost(cause)),
            Err(error) => reply(PictureReply::Failed(error.to_string())),
        }
    }

    fn draw(
        &mut self,
        request: PictureRequest,
        job: &Job<'_>,
        reply: &dyn Fn(PictureReply),
    ) -> Result<(), RenderError> {
        match request {
            PictureRequest::View(request) => {
                let ViewRequest { shot, passing, bands, asked } = *request;
                let began = Instant::now();
                let is_wanted = || passing || !job.cancelled();
                let Some(painted) = self.painter.paint_in_bands(&shot, bands, &is_wanted)? else { return Ok(()) };
                let Painted { canvas, cost } = painted;
                self.number += 1;
                let chosen = shot.sides.first().and_then(|side| side.sitters.get(shot.chosen));
                reply(PictureReply::Shown(Shown {
                    canvas,
                    cost,
                    asked,
                    began,
                    number: self.number,
                    camera: shot.posed().camera,
                    map: chosen.and_then(|sitter| sitter.maps.first().cloned()),
                    surface: chosen.and_then(|sitter| sitter.surface.clone()),
                    passing,
                    samples: shot.samples,
                }));
            }
            PictureRequest::Thumbnail(request) => {
                if let Some(canvas) = self.thumbnails.paint(&mut self.painter, &request)? {
                    reply(PictureReply::Thumbnail { key: request.key, canvas: Arc::new(canvas) });
                }
            }
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use std::cell::RefCell;

    use super::super::thumbnails::Subject;
    use super::*;
    use crate::gpu::GpuOptions;

    fn thumbnail(studio: &mut Studio, key: &str) -> Vec<PictureReply> {
        let replies = RefCell::new(Vec::new());
        let of = Subject::Preset(Box::default());
        let request = PictureRequest::Thumbnail(ThumbnailRequest { key: key.to_owned(), of });
        studio.serve(request, &Job::default(), &|reply| replies.borrow_mut().push(reply));
        replies.into_inner()
    }

    #[test]
    fn that_the_device_went_away_is_told_apart_from_what_fails_on_it() {
        let gpu = Gpu::open(&GpuOptions::default()).expect("an adapter");
        let mut studio = Studio::new(gpu.clone());
        let replies = thumbnail(&mut studio, "before");
        assert!(matches!(&replies[..], [PictureReply::Thumbnail { key, .. }] if key == "before"));
        gpu.device.destroy();
        let replies = thumbnail(&mut studio, "after");
        assert!(matches!(&replies[..], [PictureReply::Lost(_)]));
    }
}
