//! Measures ways to draw, one after another.

use std::sync::Arc;
use std::time::{Duration, Instant};

use tam_gen::Job;

use super::super::named::Named;
use super::super::stand::{Stand, is_lost};
use super::super::subject::Subject;
use super::super::surface::{MadeSurface, SurfaceRequest, make_surface};
use super::super::worker::{Manner, Wake, Worker};
use crate::RenderError;
use crate::chart::{Figures, MapChoice, Maps, Views, Way, is_repeated, measure_way, one_family};
use crate::gpu::Picture;
use crate::maps::HatchMap;
use crate::measure::Strokes;
use crate::mesh::Mesh;
use crate::surface::{Surface, SurfaceError, SurfaceOptions};

/// Pairs of frames that are timed; medians of five spread by a few percent, which the charts' axes do not show.
const PAIRS: u32 = 5;

/// The scene has come to rest when nothing changed for so long.
const REST: Duration = Duration::from_millis(250);

/// Between looks whether something did.
const LOOK: Duration = Duration::from_millis(10);

/// Ways that are measured on one surface.
#[derive(Clone, Debug)]
pub(super) struct Group {
    /// What has to be made of the surface; `None`: nothing, on meshes that are too large even for a field.
    pub options: Option<SurfaceOptions>,
    /// The same where it was made for the view already.
    pub made: Option<MadeSurface>,
    /// In the order in which they are measured.
    pub ways: Vec<Way>,
}

pub(super) struct ChartRequest {
    /// Tells subjects apart.
    pub number: u64,
    pub subject: Arc<Subject>,
    pub groups: Vec<Group>,
}

pub(super) enum ChartReply {
    /// Whether the adapter computes on the processor.
    Opened {
        is_software: bool,
    },
    /// A surface that the view may need too.
    Surface(Box<MadeSurface>),
    Measured {
        number: u64,
        way: Way,
        figures: Box<Figures>,
    },
    /// It draws what the hardened form draws.
    Repeated {
        number: u64,
        way: Way,
    },
    /// These cannot be measured, and why.
    Failed {
        number: u64,
        ways: Vec<Way>,
        problem: String,
    },
    /// All work broke down.
    Broken(String),
}

pub(super) type ChartWorker = Worker<ChartRequest, ChartReply>;

/// Starts the worker that measures.
pub(super) fn chart_worker(wake: Wake) -> std::io::Result<ChartWorker> {
    let failed = |words: String| ChartReply::Broken(format!("ways to draw could not be measured: {words}"));
    Worker::start(
        "chart",
        Manner { patience: Duration::ZERO, leaves_behind: false },
        wake,
        Lab::default,
        Lab::serve,
        failed,
    )
}

/// A device and what was last measured on it.
#[derive(Default)]
struct Lab {
    stand: Option<Stand>,
    /// The last surface that was made here.
    made: Option<MadeSurface>,
    bench: Option<Bench>,
}

/// A subject that is ready to be drawn.
struct Bench {
    number: u64,
    options: Option<SurfaceOptions>,
    mesh: Named<Mesh>,
    surface: Option<Named<Surface>>,
    maps: Maps,
    views: Views,
    drawn: Vec<(Way, Picture)>,
}

/// Why a bench could not be set up.
enum NotReady {
    Cancelled,
    Failed(String),
}

impl Lab {
    fn serve(&mut self, request: ChartRequest, job: &Job<'_>, reply: &dyn Fn(ChartReply)) {
        let began = Instant::now();
        while began.elapsed() < REST {
            if job.cancelled() {
                return;
            }
            std::thread::sleep(LOOK);
        }
        let number = request.number;
        for group in request.groups {
            match self.set_up(&request.subject, number, &group, job, reply) {
                Ok(()) => {}
                Err(NotReady::Cancelled) => return,
                Err(NotReady::Failed(problem)) => {
                    reply(ChartReply::Failed { number, ways: group.ways, problem });
                    continue;
                }
            }
            for way in group.ways {
                if job.cancelled() {
                    return;
                }
                match self.measured(&way, reply) {
                    Ok(Some(figures)) => reply(ChartReply::Measured { number, way, figures: Box::new(figures) }),
                    Ok(None) => reply(ChartReply::Repeated { number, way }),
                    Err(error) => {
                        let problem = format!("{} cannot be drawn: {error}", way.name());
                        reply(ChartReply::Failed { number, ways: vec![way], problem });
                    }
                }
            }
        }
    }

    /// Makes what all ways of a group share, unless it is there.
    fn set_up(
        &mut self,
        subject: &Subject,
        number: u64,
        group: &Group,
        job: &Job<'_>,
        reply: &dyn Fn(ChartReply),
    ) -> Result<(), NotReady> {
        if self.bench.as_ref().is_some_and(|bench| bench.number == number && bench.options == group.options) {
            return Ok(());
        }
        self.bench = None;
        let made = match &group.options {
            Some(options) => Some(self.surface(subject, options, group.made.as_ref(), job, reply)?),
            None => None,
        };
        let mesh = made.as_ref().map_or(&subject.mesh, |made| &made.mesh);
        let surface = made.as_ref().map(|made| &made.surface);
        let words = |error: &dyn std::fmt::Display| NotReady::Failed(format!("the scene cannot be measured: {error}"));
        let quiet = Job { progress: None, ..*job };
        let single = HatchMap::from_preset(&subject.name, &one_family(&subject.preset), &quiet)
            .map_err(|error| if job.cancelled() { NotReady::Cancelled } else { words(&error) })?;
        let choice = MapChoice { size: subject.preset.map.size, tones: subject.map.grid.columns() as u32 };
        let maps = Maps { choice, whole: Arc::clone(subject.map.shared()), single: Arc::new(single) };
        let strokes = surface.map(|surface| Strokes { graph: &surface.graph, field: &surface.field });
        let views = Views::new(mesh, &subject.scene, subject.size_px, strokes).map_err(|error| words(&error))?;
        self.bench = Some(Bench {
            number,
            options: group.options.clone(),
            mesh: mesh.clone(),
            surface: surface.cloned(),
            maps,
            views,
            drawn: Vec::new(),
        });
        if job.cancelled() { Err(NotReady::Cancelled) } else { Ok(()) }
    }

    /// A surface of the view's, or the last one made here, or a new one.
    fn surface(
        &mut self,
        subject: &Subject,
        options: &SurfaceOptions,
        of_view: Option<&MadeSurface>,
        job: &Job<'_>,
        reply: &dyn Fn(ChartReply),
    ) -> Result<MadeSurface, NotReady> {
        if let Some(made) = of_view {
            return Ok(made.clone());
        }
        if let Some(made) = subject.made(options, self.made.as_slice()) {
            return Ok(made.clone());
        }
        let request = SurfaceRequest { mesh: subject.mesh.clone(), options: options.clone() };
        let made = make_surface(request, job).map_err(|error| match error {
            SurfaceError::Cancelled => NotReady::Cancelled,
            error => NotReady::Failed(format!("strokes cannot follow this mesh: {error}")),
        })?;
        self.made = Some(made.clone());
        reply(ChartReply::Surface(Box::new(made.clone())));
        Ok(made)
    }

    /// The figures of a way; `None` where its printed form draws the same as the hardened one. A device that went away is
    /// opened again, once.
    fn measured(&mut self, way: &Way, reply: &dyn Fn(ChartReply)) -> Result<Option<Figures>, RenderError> {
        match self.try_measured(way, reply) {
            Err(error) if is_lost(&error) => {
                self.stand = None;
                self.try_measured(way, reply)
            }
            result => result,
        }
    }

    fn try_measured(&mut self, way: &Way, reply: &dyn Fn(ChartReply)) -> Result<Option<Figures>, RenderError> {
        let stand = match &mut self.stand {
            Some(stand) => stand,
            None => {
                let stand = self.stand.insert(Stand::open()?);
                reply(ChartReply::Opened { is_software: stand.is_software() });
                stand
            }
        };
        let Some(Bench { mesh, surface, maps, views, drawn, .. }) = &mut self.bench else { return Ok(None) };
        let (renderer, setting) = stand.with(mesh, surface.as_ref(), views.size_px())?;
        let (figures, picture) = measure_way(renderer, &setting, mesh, maps, views, way, PAIRS)?;
        if is_repeated(way, &picture, drawn.iter().map(|(way, picture)| (way, picture))) {
            return Ok(None);
        }
        drawn.push((*way, picture));
        Ok(Some(figures))
    }
}
