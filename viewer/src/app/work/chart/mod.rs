//! Measures all ways to draw the open scene while nothing else goes on.
//!
//! ```text
//! state ─► subject ─► plan (ways, the most telling first) ─► measured one by one ─► points
//!             └── changed: all anew; the older points stay until they are replaced
//! ```

mod measure;
mod plan;

use std::sync::Arc;

use super::subject::Subject;
use super::surface::MadeSurface;
use super::worker::Wake;
use crate::chart::{Figures, Way};
use crate::{Mapping, Method, RenderParams};
use measure::{ChartReply, ChartRequest, ChartWorker, Group, chart_worker};

/// Pixels of a picture that is measured: enough for figures that tell ways apart, and soon done.
pub(super) const PICTURE_PX: f64 = 256.0 * 256.0;

/// A way to draw, with its figures.
#[derive(Clone, Debug)]
pub struct MeasuredWay {
    /// The way.
    pub way: Way,
    /// What it costs, and how far it errs.
    pub figures: Figures,
    /// Of which scene; they are counted.
    number: u64,
}

/// What was measured so far.
#[derive(Clone, Debug, Default)]
pub struct ChartResults {
    /// All points, those of an older scene until they are replaced.
    pub points: Vec<MeasuredWay>,
    /// Ways that are still to be measured, and all there are.
    pub left: [usize; 2],
    /// Size of the pictures.
    pub size_px: [u32; 2],
    /// Whether the adapter computes on the processor.
    pub is_software: bool,
    /// Whether lapped patches are left out, as making them takes long.
    pub without_lapped: bool,
    /// Whether strokes cannot follow the mesh, as it is too large.
    pub without_surface: bool,
    /// Why something could not be measured.
    pub problem: Option<String>,
    /// The scene that is open; `None` while it changes.
    current: Option<u64>,
}

impl ChartResults {
    /// Whether a point is of the scene that is open.
    pub fn is_current(&self, point: &MeasuredWay) -> bool {
        self.current == Some(point.number)
    }

    /// The points of the scene that is open.
    pub fn current(&self) -> impl Iterator<Item = &MeasuredWay> {
        self.points.iter().filter(|point| self.is_current(point))
    }
}

/// Asks for what is missing on the chart.
pub(super) struct ChartDesk {
    worker: ChartWorker,
    subject: Option<Arc<Subject>>,
    number: u64,
    /// Ways of this subject that need not be asked for again.
    done: Vec<Way>,
    wants: bool,
}

impl ChartDesk {
    pub(super) fn start(wake: &Wake) -> std::io::Result<Self> {
        let worker = chart_worker(Arc::clone(wake))?;
        Ok(Self { worker, subject: None, number: 0, done: Vec::new(), wants: false })
    }

    /// Whether anything is being measured, or waits to be.
    pub(super) fn is_busy(&self) -> bool {
        self.wants || self.worker.is_busy()
    }

    /// Looks at the open scene, `None` while it is being made. `shown`: somebody looks at the chart; `rests`: nothing else
    /// goes on.
    pub(super) fn follow(
        &mut self,
        subject: Option<Subject>,
        made: &[MadeSurface],
        [shown, rests]: [bool; 2],
        results: &mut ChartResults,
    ) {
        let same = matches!((&subject, &self.subject), (Some(open), Some(known)) if *open == **known);
        results.current = same.then_some(self.number);
        self.wants = false;
        let Some(subject) = subject.filter(|_| shown) else {
            self.worker.cancel();
            return;
        };
        let lapped = lapped_of(&subject, made);
        let plan = plan::plan(&subject, lapped.is_some());
        let missing: Vec<Way> = plan.iter().filter(|way| !same || !self.done.contains(way)).copied().collect();
        results.left = [missing.len(), plan.len()];
        results.size_px = subject.size_px;
        results.without_surface = subject.mesh.triangles.len() > plan::SURFACE_TRIANGLES;
        results.without_lapped = !results.without_surface && lapped.is_none();
        self.wants = !missing.is_empty();
        if !rests {
            self.worker.cancel();
        } else if !same {
            self.number += 1;
            self.done.clear();
            let subject = Arc::new(subject);
            self.subject = Some(Arc::clone(&subject));
            results.current = Some(self.number);
            results.problem = None;
            self.worker.request(self.request(subject, missing, lapped, made));
        } else if !missing.is_empty() && !self.worker.is_busy() {
            let request = self.subject.clone().map(|subject| self.request(subject, missing, lapped, made));
            request.into_iter().for_each(|request| self.worker.request(request));
        } else if missing.is_empty() {
            results.points.retain(|point| point.number == self.number);
        }
    }

    fn request(
        &self,
        subject: Arc<Subject>,
        missing: Vec<Way>,
        lapped: Option<&MadeSurface>,
        made: &[MadeSurface],
    ) -> ChartRequest {
        let on_lapped = |way: &Way| way.params.needed_mapping() == Some(Mapping::Lapped);
        let (lapping, others): (Vec<Way>, Vec<Way>) = missing.into_iter().partition(on_lapped);
        // All on one surface, whichever are left, so that their costs can be compared.
        let all = plan::plan(&subject, false);
        let fits = subject.mesh.triangles.len() <= plan::SURFACE_TRIANGLES;
        let options = fits.then(|| subject.surface_options(all.iter().map(|way| &way.params)));
        let of_view = options.as_ref().and_then(|options| subject.made(options, made)).cloned();
        let mut groups = vec![Group { options, made: of_view, ways: others }];
        if let Some(lapped) = lapped {
            let options = Some(lapped.request.options.clone());
            groups.push(Group { options, made: Some(lapped.clone()), ways: lapping });
        }
        groups.retain(|group| !group.ways.is_empty());
        ChartRequest { number: self.number, subject, groups }
    }

    /// Takes what was measured; returns surfaces that were made for it.
    pub(super) fn collect(&mut self, results: &mut ChartResults) -> Vec<MadeSurface> {
        let replies: Vec<ChartReply> = self.worker.replies().collect();
        replies.into_iter().filter_map(|reply| self.take(reply, results)).collect()
    }

    fn take(&mut self, reply: ChartReply, results: &mut ChartResults) -> Option<MadeSurface> {
        match reply {
            ChartReply::Opened { is_software } => results.is_software = is_software,
            ChartReply::Surface(made) => return Some(*made),
            ChartReply::Measured { number, way, figures } => {
                let name = way.name();
                results.points.retain(|point| point.way.name() != name);
                results.points.push(MeasuredWay { way, figures: *figures, number });
                if number == self.number {
                    self.done.push(way);
                }
            }
            ChartReply::Repeated { number, way } => {
                let name = way.name();
                results.points.retain(|point| point.way.name() != name);
                if number == self.number {
                    self.done.push(way);
                }
            }
            ChartReply::Failed { number, ways, problem } => {
                if number == self.number {
                    self.done.extend(ways);
                    results.problem = Some(problem);
                }
            }
            ChartReply::Broken(problem) => {
                // What broke down once is not tried until the scene changes.
                if let Some(subject) = &self.subject {
                    self.done.extend(plan::plan(subject, true));
                }
                results.problem = Some(problem);
            }
        }
        None
    }
}

/// A surface of lapped patches along the present field, where there is one.
fn lapped_of<'a>(subject: &Subject, made: &'a [MadeSurface]) -> Option<&'a MadeSurface> {
    let params = RenderParams { method: Method::SixWay, mapping: Mapping::Lapped, ..subject.look.params };
    subject.made(&subject.surface_options([&params]), made)
}

#[cfg(test)]
mod tests {
    use super::super::subject::tests::cube;
    use super::*;
    use crate::chart::Cost;

    fn desk() -> ChartDesk {
        ChartDesk::start(&(Arc::new(|| ()) as Wake)).expect("a thread")
    }

    fn measured(desk: &mut ChartDesk, way: &Way, results: &mut ChartResults) {
        let cost = Cost { ratio: 2.0, frame_ms: 2.0, phong_ms: 1.0 };
        let figures = Box::new(Figures { cost, ..Figures::default() });
        let number = desk.number;
        assert!(desk.take(ChartReply::Measured { number, way: *way, figures }, results).is_none());
    }

    #[test]
    fn older_points_stay_until_they_are_replaced_and_go_when_all_are_measured() {
        let (mut desk, mut results, subject) = (desk(), ChartResults::default(), cube());
        let ways = plan::plan(&subject, false);
        desk.follow(Some(subject.clone()), &[], [true, true], &mut results);
        ways.iter().for_each(|way| measured(&mut desk, way, &mut results));
        desk.follow(Some(subject.clone()), &[], [true, true], &mut results);
        assert_eq!((results.left, results.current().count()), ([0, ways.len()], ways.len()));

        let mut turned = subject;
        turned.scene.camera.azimuth_deg += 5.0;
        desk.follow(Some(turned.clone()), &[], [true, false], &mut results);
        assert_eq!((results.points.len(), results.current().count()), (ways.len(), 0), "grey while it moves");
        assert_eq!(results.left, [ways.len(); 2]);
        desk.follow(Some(turned.clone()), &[], [true, true], &mut results);
        measured(&mut desk, &ways[1], &mut results);
        desk.follow(Some(turned.clone()), &[], [true, true], &mut results);
        assert_eq!((results.points.len(), results.current().count()), (ways.len(), 1), "one is replaced");
        assert_eq!(results.left, [ways.len() - 1, ways.len()]);
        let number = desk.number;
        ways[2..].iter().for_each(|way| measured(&mut desk, way, &mut results));
        let failed = ChartReply::Failed { number, ways: vec![ways[0]], problem: "no such way".into() };
        assert!(desk.take(failed, &mut results).is_none());
        desk.follow(Some(turned), &[], [true, true], &mut results);
        assert_eq!(results.points.len(), ways.len() - 1, "what cannot be measured has no point");
        assert!(results.problem.is_some() && results.left[0] == 0, "and is not tried again");
    }

    #[test]
    fn nothing_is_measured_for_nobody_or_while_the_scene_is_being_made() {
        let (mut desk, mut results) = (desk(), ChartResults::default());
        for (subject, shown, rests, wants) in
            [(Some(cube()), false, true, false), (None, true, true, false), (Some(cube()), true, false, true)]
        {
            desk.follow(subject, &[], [shown, rests], &mut results);
            assert_eq!((desk.is_busy(), desk.worker.is_busy()), (wants, false), "{shown} {rests}");
        }
        desk.follow(Some(cube()), &[], [true, true], &mut results);
        assert!(desk.worker.is_busy());
        desk.follow(Some(cube()), &[], [false, true], &mut results);
        let start = std::time::Instant::now();
        while desk.is_busy() {
            assert!(start.elapsed() < std::time::Duration::from_secs(20), "it is stopped");
            std::thread::sleep(std::time::Duration::from_millis(1));
        }
        assert!(results.points.is_empty());
    }
}
