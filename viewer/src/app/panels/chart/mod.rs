//! What every way to draw the open scene costs and how far it errs, and the least that the scene needs.

mod fit;
mod plot;
mod table;

use egui::{RichText, Ui};

use super::Panel;
use super::number::named;
use crate::app::command::Command;
use crate::app::state::{ChartSettings, ChartTab, ChartView};
use crate::app::work::{ChartResults, MeasuredWay};
use crate::chart::{MEASURES, Measure, Way};
use crate::{Method, RenderParams};

/// Width from which the table stands beside the plot, in points.
const WIDE: f32 = 560.0;

/// Least width of the table beside the plot: its longest names with their figures.
const TABLE_WIDTH: f32 = 318.0;

/// Height of a plot that has the table below it, in points.
const PLOT_HEIGHT: f32 = 230.0;

pub(super) fn show(panel: &mut Panel<'_>, ui: &mut Ui) {
    let view = panel.state.transient.chart;
    *panel.chart_shown = view.tab == ChartTab::Ways;
    ui.horizontal_wrapped(|ui| {
        for tab in ChartTab::ALL {
            if ui.selectable_label(view.tab == tab, tab.label()).clicked() {
                panel.ask(Command::ShowChart(ChartView { tab, ..view }));
            }
        }
        ui.separator();
        match view.tab {
            ChartTab::Ways => controls(panel, ui),
            ChartTab::Fit => fit::controls(panel, ui),
        }
    });
    ui.separator();
    match view.tab {
        ChartTab::Ways => ways(panel, ui),
        ChartTab::Fit => fit::show(panel, ui),
    }
}

fn measure(settings: &ChartSettings) -> &'static Measure {
    Measure::named(&settings.measure).unwrap_or(&MEASURES[0])
}

/// What is charted, whether it is measured, and how far that is.
fn controls(panel: &mut Panel<'_>, ui: &mut Ui) {
    let mut settings = panel.state.settings.chart.clone();
    let chosen = measure(&settings);
    let combo = egui::ComboBox::from_id_salt("measure").selected_text(capitalised(chosen.short)).width(180.0);
    let shown = combo.show_ui(ui, |ui| {
        for measure in &MEASURES {
            let response =
                ui.selectable_value(&mut settings.measure, measure.name.to_owned(), capitalised(measure.short));
            response.on_hover_text(measure.axis);
        }
    });
    named(shown.response, "Error that is charted").on_hover_text("What is charted against the cost");
    ui.checkbox(&mut settings.paused, "Pause").on_hover_text("Measure nothing; what was measured stays");
    progress(panel, ui);
    if settings != panel.state.settings.chart {
        panel.ask(Command::SetChart(settings));
    }
}

fn progress(panel: &Panel<'_>, ui: &mut Ui) {
    let chart = &panel.results.chart;
    let [left, all] = chart.left;
    let [width, height] = chart.size_px;
    if panel.state.settings.chart.paused {
        ui.weak("paused");
    } else if panel.results.fit.progress.is_some() {
        ui.weak("waits for the fit");
    } else if all == 0 {
        ui.weak("waits for map and mesh");
    } else if left > 0 {
        let done = (all - left) as f32 / all as f32;
        ui.add(egui::ProgressBar::new(done).desired_width(90.0).desired_height(10.0));
        let plural = if left == 1 { "way" } else { "ways" };
        ui.weak(format!("{left} of {all} {plural} left"));
    } else {
        ui.weak(format!("{} ways", chart.current().count()));
    }
    let mut remarks = vec![format!("Measured in pictures of {width} × {height} px, five pairs of frames a way.")];
    if chart.is_software {
        remarks.push("The adapter computes on the processor: costs on a graphics card differ.".to_owned());
    }
    if chart.without_lapped {
        let text = "Lapped patches are left out, as making them takes long: choose that mapping once to have them.";
        remarks.push(text.to_owned());
    }
    if chart.without_surface {
        remarks.push("The mesh is too large for strokes that follow it: patches and stripes are left out.".to_owned());
    }
    if all > 0 {
        let about = named(ui.add(egui::Label::new(RichText::new("ℹ").weak())), "How it is measured");
        about.on_hover_text(remarks.join("\n"));
    }
    if let Some(problem) = &chart.problem {
        let mark = egui::Label::new(RichText::new(problem).color(ui.visuals().error_fg_color).small()).truncate();
        ui.add(mark).on_hover_text(problem);
    }
}

fn ways(panel: &mut Panel<'_>, ui: &mut Ui) {
    let measure = measure(&panel.state.settings.chart);
    let results = panel.results;
    if results.chart.points.is_empty() {
        let text = match (panel.state.settings.chart.paused, &results.map_problem) {
            (true, _) => "Nothing was measured yet: untick Pause to measure every way to draw this scene.",
            (_, Some(_)) => "The preset makes no map: mend it under Strokes, then every way to draw it is measured.",
            _ => "Every way to draw this scene is measured while nothing moves; the first points are there soon.",
        };
        ui.centered_and_justified(|ui| ui.weak(text));
        return;
    }
    let shown = Shown::new(panel, measure);
    if ui.available_width() >= WIDE {
        let size = ui.available_size();
        let beside = (size.x * 0.36).clamp(TABLE_WIDTH, 460.0);
        ui.horizontal_top(|ui| {
            let gap = ui.spacing().item_spacing.x;
            column(ui, size.x - beside - gap, |ui| plot::show(panel, ui, &shown, size.y));
            column(ui, beside, |ui| table::show(panel, ui, &shown));
        });
    } else {
        egui::ScrollArea::vertical().auto_shrink(false).show(ui, |ui| {
            plot::show(panel, ui, &shown, PLOT_HEIGHT);
            table::show(panel, ui, &shown);
        });
    }
}

/// A part of the panel from its top to its bottom.
fn column(ui: &mut Ui, width: f32, show: impl FnOnce(&mut Ui)) {
    let size = egui::vec2(width, ui.available_height());
    ui.allocate_ui_with_layout(size, egui::Layout::top_down(egui::Align::LEFT), |ui| {
        ui.set_width(width);
        show(ui);
    });
}

/// What plot and table both show.
struct Shown<'a> {
    measure: &'static Measure,
    points: Vec<&'a MeasuredWay>,
    /// By point: whether it is of the open scene.
    current: Vec<bool>,
    /// Indices of the points of the open scene that nothing beats, by growing cost.
    front: Vec<usize>,
    /// The way that the view shows.
    present: Option<usize>,
}

impl<'a> Shown<'a> {
    fn new(panel: &Panel<'a>, measure: &'static Measure) -> Self {
        let chart: &'a ChartResults = &panel.results.chart;
        let points: Vec<&MeasuredWay> = chart.points.iter().collect();
        let current: Vec<bool> = points.iter().map(|point| chart.is_current(point)).collect();
        let places: Vec<usize> = (0..points.len()).filter(|i| current[*i]).collect();
        let front = measure.front(places.iter().map(|i| &points[*i].figures)).into_iter().map(|i| places[i]).collect();
        let own = Way { params: panel.state.document.look.params, map: 0 }.name();
        let present = points.iter().position(|point| point.way.name() == own);
        Self { measure, points, current, front, present }
    }

    /// Cost and error of a point; `None` where it has none.
    fn place(&self, i: usize) -> Option<[f64; 2]> {
        let [cost, error] = self.measure.point(&self.points[i].figures);
        (cost.is_finite() && error.is_finite()).then_some([cost, error])
    }

    /// Colour of a point, as on the charts of the command.
    fn colour(&self, ui: &Ui, i: usize) -> egui::Color32 {
        if self.current[i] {
            method_colour(ui, self.points[i].way.params.method)
        } else {
            ui.visuals().weak_text_color()
        }
    }
}

/// The colour of a method; on dark ground it is mixed with white.
fn method_colour(ui: &Ui, method: Method) -> egui::Color32 {
    // The yardstick is no point.
    let group = Method::ALL.iter().position(|other| *other == method).map_or(0, |place| place.saturating_sub(1));
    let [r, g, b] = tam_gen::chart::GROUP_COLOURS[group % tam_gen::chart::GROUP_COLOURS.len()];
    let colour = egui::Color32::from_rgb(r, g, b);
    if ui.visuals().dark_mode { colour.lerp_to_gamma(egui::Color32::WHITE, 0.3) } else { colour }
}

/// Draws the scene in a way from now on.
fn switch_to(panel: &mut Panel<'_>, params: &RenderParams) {
    let look = panel.state.document.look.with_way(params);
    panel.ask(Command::SetLook(Box::new(look)));
}

/// What is known of a way, in lines.
fn told(shown: &Shown<'_>, i: usize) -> String {
    let figures = &shown.points[i].figures;
    let cost = &figures.cost;
    let mut lines = vec![
        format!("{:.2}x phong: {:.2} ms against {:.2} ms", cost.ratio, cost.frame_ms, cost.phong_ms),
        format!("memory: {}", crate::app::words::bytes(figures.bytes)),
    ];
    let error = |measure: &Measure| Some(format!("{}: {}", measure.short, number((measure.of)(figures)?)));
    lines.extend(MEASURES.iter().filter_map(error));
    if !shown.current[i] {
        lines.push("of the scene as it was before".to_owned());
    }
    lines.join("\n")
}

/// An error in three digits.
fn number(error: f64) -> String {
    match error.abs() {
        0.0 => "0".to_owned(),
        size if size < 1e-3 => format!("{error:.1e}"),
        size if size < 1.0 => format!("{error:.3}"),
        size if size < 10.0 => format!("{error:.2}"),
        _ => format!("{error:.1}"),
    }
}

fn capitalised(text: &str) -> String {
    let mut letters = text.chars();
    letters.next().map_or_else(String::new, |first| first.to_uppercase().chain(letters).collect())
}
