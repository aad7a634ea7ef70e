//! The points as a table: for keys, and for those who do not see the plot.

use egui::{RichText, Sense, Ui};

use super::super::Panel;
use super::super::number::named;
use super::plot::symbol;
use super::{Shown, number, switch_to, told};
use crate::app::command::Command;
use crate::app::state::{ChartSort, ChartView};
use crate::chart::COST_AXIS;

pub(super) fn show(panel: &mut Panel<'_>, ui: &mut Ui, shown: &Shown<'_>) {
    let view = panel.state.transient.chart;
    let mut chosen = None;
    egui::ScrollArea::both().id_salt("table").auto_shrink(false).show(ui, |ui| {
        egui::Grid::new("ways").num_columns(4).min_col_width(12.0).striped(true).spacing([8.0, 2.0]).show(ui, |ui| {
            ui.label("");
            head(panel, ui, ChartSort::Way, "Way", "Method, mapping and form");
            head(panel, ui, ChartSort::Cost, "Cost", COST_AXIS);
            let title = super::capitalised(shown.measure.name);
            head(panel, ui, ChartSort::Error, &title, shown.measure.axis);
            ui.end_row();
            for i in sorted(shown, view) {
                if row(ui, shown, i) {
                    chosen = Some(shown.points[i].way.params);
                }
            }
        });
    });
    if let Some(params) = chosen {
        switch_to(panel, &params);
    }
}

/// The head of a column, which sorts by it, and by a second click the other way round.
fn head(panel: &mut Panel<'_>, ui: &mut Ui, sort: ChartSort, title: &str, doc: &str) {
    let view = panel.state.transient.chart;
    let own = view.sort == sort;
    let arrow = match (own, view.descending) {
        (false, _) => "",
        (true, false) => " ⏶",
        (true, true) => " ⏷",
    };
    let button = egui::Button::new(RichText::new(format!("{title}{arrow}")).small().weak()).frame(false);
    let response = named(ui.add(button), &format!("Sort by {}", title.to_lowercase()));
    if response.on_hover_text(doc).clicked() {
        panel.ask(Command::ShowChart(ChartView { sort, descending: own && !view.descending, ..view }));
    }
}

/// Indices of the points in the order of the table; those without the figure come last either way.
fn sorted(shown: &Shown<'_>, view: ChartView) -> Vec<usize> {
    let mut order: Vec<usize> = (0..shown.points.len()).collect();
    let names: Vec<String> = shown.points.iter().map(|point| point.way.name()).collect();
    let figure = |i: usize| {
        let [cost, error] = shown.measure.point(&shown.points[i].figures);
        match view.sort {
            ChartSort::Way => 0.0,
            ChartSort::Cost => cost,
            ChartSort::Error => error,
        }
    };
    order.sort_by(|a, b| {
        let (one, other) = (figure(*a), figure(*b));
        let by_figure = one.total_cmp(&other).then_with(|| names[*a].cmp(&names[*b]));
        let turned = if view.descending { by_figure.reverse() } else { by_figure };
        one.is_nan().cmp(&other.is_nan()).then(turned)
    });
    order
}

/// A row; whether its way was chosen.
fn row(ui: &mut Ui, shown: &Shown<'_>, i: usize) -> bool {
    let point = shown.points[i];
    let best = shown.front.contains(&i);
    let (area, _) = ui.allocate_exact_size(egui::vec2(12.0, ui.spacing().interact_size.y), Sense::hover());
    symbol(ui.painter(), point.way.params.form, area.center(), 4.0, shown.colour(ui, i));
    let mut text = RichText::new(point.way.name());
    if best {
        text = text.strong();
    }
    if !shown.current[i] {
        text = text.weak();
    }
    let response = ui.selectable_label(shown.present == Some(i), text);
    let chosen = response.clicked();
    response.on_hover_text(told(shown, i));
    let figure = |text: String| {
        let text = RichText::new(text);
        if shown.current[i] { text } else { text.weak() }
    };
    ui.label(figure(format!("{:.2}x", point.figures.cost.ratio)));
    ui.label(figure((shown.measure.of)(&point.figures).map_or_else(|| "–".to_owned(), number)));
    ui.end_row();
    chosen
}
