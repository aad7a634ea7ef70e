//! The picture of the view, and the thumbnails of galleries, which are drawn when the view rests.

use std::sync::Arc;
use std::time::Duration;

use egui::ColorImage;
use image::RgbaImage;
use tam_gen::Job;

use super::painter::{Painted, Painter, Shot};
use super::thumbnails::{ThumbnailRequest, Thumbnails};
use super::worker::{Wake, Worker};
use crate::RenderError;
use crate::gpu::GpuError;
use crate::maps::HatchMap;
use crate::surface::Surface;

/// Whether a picture is one of many.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Stillness {
    /// Another will follow at once: it may be coarser.
    Moving,
    /// It is looked at.
    Still,
}

/// A picture that was drawn.
pub struct Shown {
    /// Its pixels.
    pub image: Arc<ColorImage>,
    /// Time on the device.
    pub cost: Duration,
    /// Whether it was drawn as one of many.
    pub stillness: Stillness,
    /// Counts pictures.
    pub number: u64,
    /// The map that it was drawn with, on the side of the document.
    pub map: Option<Arc<HatchMap>>,
    /// The surface by which strokes lay on that side; none where the mapping takes none, or it is still to be made.
    pub surface: Option<Arc<Surface>>,
}

impl Shown {
    /// Whether it is to be looked at, not one of many that pass.
    pub fn is_still(&self) -> bool {
        self.stillness == Stillness::Still
    }
}

pub(super) enum PictureRequest {
    View(Box<Shot>, Stillness),
    Thumbnail(ThumbnailRequest),
}

pub(super) enum PictureReply {
    /// The adapter was opened.
    Adapter(String),
    Shown(Shown),
    Thumbnail {
        key: String,
        image: Arc<ColorImage>,
    },
    /// The device went away and was opened again.
    Reopened(String),
    Failed(String),
}

pub(super) type PictureWorker = Worker<PictureRequest, PictureReply>;

#[derive(Default)]
struct Studio {
    painter: Option<Painter>,
    thumbnails: Thumbnails,
    number: u64,
}

/// Starts the worker that draws.
pub(super) fn picture_worker(wake: Wake) -> std::io::Result<PictureWorker> {
    let failed = |words: String| PictureReply::Failed(format!("the picture could not be drawn: {words}"));
    // A frame cannot be stopped once it is begun.
    Worker::start("pictures", Duration::MAX, wake, Studio::default, Studio::serve, failed)
}

impl Studio {
    fn serve(&mut self, request: PictureRequest, _: &Job<'_>, reply: &dyn Fn(PictureReply)) {
        match self.draw(&request, reply) {
            Ok(()) => {}
            Err(RenderError::Gpu(error @ (GpuError::Lost(_) | GpuError::Failed(_)))) => {
                self.painter = None;
                self.thumbnails = Thumbnails::default();
                match self.draw(&request, reply) {
                    Ok(()) => reply(PictureReply::Reopened(error.to_string())),
                    Err(again) => reply(PictureReply::Failed(again.to_string())),
                }
            }
            Err(error) => reply(PictureReply::Failed(error.to_string())),
        }
    }

    fn draw(&mut self, request: &PictureRequest, reply: &dyn Fn(PictureReply)) -> Result<(), RenderError> {
        if self.painter.is_none() {
            let painter = Painter::open()?;
            reply(PictureReply::Adapter(painter.adapter()));
            self.painter = Some(painter);
        }
        let Some(painter) = &mut self.painter else { return Ok(()) };
        match request {
            PictureRequest::View(shot, stillness) => {
                let Painted { image, cost } = painter.paint(shot)?;
                self.number += 1;
                let image = Arc::new(color_image(&image));
                let chosen = shot.sides.first().and_then(|side| side.sitters.get(shot.chosen));
                reply(PictureReply::Shown(Shown {
                    image,
                    cost,
                    stillness: *stillness,
                    number: self.number,
                    map: chosen.and_then(|sitter| sitter.maps.first().cloned()),
                    surface: chosen.and_then(|sitter| sitter.surface.clone()),
                }));
            }
            PictureRequest::Thumbnail(request) => {
                if let Some(image) = self.thumbnails.paint(painter, request)? {
                    reply(PictureReply::Thumbnail { key: request.key.clone(), image: Arc::new(color_image(&image)) });
                }
            }
        }
        Ok(())
    }
}

/// As the window takes it.
fn color_image(image: &RgbaImage) -> ColorImage {
    let size = [image.width() as usize, image.height() as usize];
    ColorImage::from_rgba_unmultiplied(size, image)
}

#[cfg(test)]
mod tests {
    use std::cell::RefCell;

    use super::super::thumbnails::Subject;
    use super::*;

    #[test]
    fn a_device_that_went_away_is_opened_again_and_the_picture_is_drawn() {
        let mut studio = Studio::default();
        let replies = RefCell::new(Vec::new());
        let request = |key: &str| {
            let of = Subject::Preset(Box::default());
            PictureRequest::Thumbnail(ThumbnailRequest { key: key.to_owned(), of })
        };
        studio.serve(request("before"), &Job::default(), &|reply| replies.borrow_mut().push(reply));
        studio.painter.as_ref().expect("it is open").lose_device();
        studio.serve(request("after"), &Job::default(), &|reply| replies.borrow_mut().push(reply));
        let replies = replies.into_inner();
        let drawn = |wanted: &str| {
            replies.iter().any(|reply| matches!(reply, PictureReply::Thumbnail { key, .. } if key == wanted))
        };
        assert!(drawn("before") && drawn("after"));
        assert!(replies.iter().any(|reply| matches!(reply, PictureReply::Reopened(_))));
        assert!(!replies.iter().any(|reply| matches!(reply, PictureReply::Failed(_))));
    }
}
