//! What measures: the chart of all ways to draw, and the fit.

use super::chart::{self, ChartDesk};
use super::engine::Demand;
use super::fit::{self, FitDesk};
use super::results::Results;
use super::subject::Subject;
use super::surface::MadeSurface;
use super::worker::Wake;
use crate::Scene;
use crate::app::state::State;

/// Both, each on a device of its own; the chart waits for the fit, as each would disturb what the other times.
pub(super) struct Measuring {
    chart: ChartDesk,
    fits: FitDesk,
}

impl Measuring {
    /// Starts both workers.
    ///
    /// # Errors
    /// Where the system gives no threads.
    pub(super) fn start(wake: &Wake) -> std::io::Result<Self> {
        Ok(Self { chart: ChartDesk::start(wake)?, fits: FitDesk::start(wake)? })
    }

    /// Whether anything is being measured, or waits to be.
    pub(super) fn is_busy(&self) -> bool {
        self.chart.is_busy() || self.fits.is_busy()
    }

    /// Measures what is open, while nothing else is `busy`.
    pub(super) fn follow(
        &mut self,
        state: &State,
        scene: &Scene,
        demand: Demand,
        busy: bool,
        made: &[MadeSurface],
        results: &mut Results,
    ) {
        let subject = |most_px| Subject::of(state, results, scene, demand.size_px, most_px);
        let [charted, fitted] = [chart::PICTURE_PX, fit::PICTURE_PX].map(subject);
        let shown = demand.chart_shown && !state.settings.chart.paused;
        let rests = !demand.is_moving() && !busy && !self.fits.is_busy();
        self.chart.follow(charted, made, [shown, rests], &mut results.chart);
        self.fits.follow(fitted.as_ref(), &state.settings.fit, &mut results.fit);
    }

    /// Looks for the least that the open scene needs. `false`: that is being done already, or map or mesh are not there.
    pub(super) fn fit(
        &self,
        state: &State,
        scene: &Scene,
        view_px: [u32; 2],
        made: &[MadeSurface],
        results: &mut Results,
    ) -> bool {
        let subject = Subject::of(state, results, scene, view_px, fit::PICTURE_PX);
        let Some(subject) = subject.filter(|_| !self.fits.is_busy()) else { return false };
        self.fits.fit(subject, state.settings.fit.clone(), made, &mut results.fit);
        true
    }

    /// Stops that.
    pub(super) fn cancel_fit(&self) {
        self.fits.cancel();
    }

    /// Takes what was measured; returns surfaces that were made for it.
    pub(super) fn collect(&mut self, results: &mut Results) -> Vec<MadeSurface> {
        self.fits.collect(&mut results.fit);
        self.chart.collect(&mut results.chart)
    }
}
