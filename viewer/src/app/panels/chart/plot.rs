//! The points, by cost and error.

use egui::{Align2, Color32, FontId, Pos2, Rect, Sense, Stroke, Ui};
use egui_plot::{GridInput, GridMark, Plot, PlotBounds, PlotPoint, VLine};
use tam_gen::chart::{Axis, Label, along, place_labels, tick};

use super::super::Panel;
use super::super::number::named;
use super::{Shown, switch_to, told};
use crate::chart::{COST_AXIS, COST_LOG_FROM};
use crate::{Form, Method};

/// How much of its colour a point keeps that is not on the front.
const PALE: f32 = 0.5;

/// Radius in which a point is met, in points.
const REACH: f32 = 8.0;

/// Labels further than this from their points are tied to them by a line.
const TIED: f64 = 14.0;

/// Decades up to which an axis is marked at twos and fives too.
const FINE_DECADES: f64 = 2.2;

/// Labels that find no place nearer than this are left out: the table has them in bold.
const FAR: f64 = 70.0;

/// Room below an axis' least number, as a share of it.
const FOOT: f64 = 0.06;

/// Least height between two ticks of an even axis.
const STEP_HEIGHT: f32 = 34.0;

const LABEL_SIZE: f32 = 11.0;

pub(super) fn show(panel: &mut Panel<'_>, ui: &mut Ui, shown: &Shown<'_>, height: f32) {
    let mark = Some((1.0, Method::Phong.name().to_owned()));
    let x = Axis { label: COST_AXIS.to_owned(), log_from: Some(COST_LOG_FROM), mark };
    let y = Axis { label: shown.measure.axis.to_owned(), log_from: shown.measure.log_from, mark: None };
    let places: Vec<(usize, [f64; 2])> = (0..shown.points.len()).filter_map(|i| Some((i, shown.place(i)?))).collect();
    let ranges = [x.range(places.iter().map(|(_, place)| place[0])), y.range(places.iter().map(|(_, place)| place[1]))];
    let [mut low, high] = [0, 1].map(|end| [placed(&x, ranges[0][end]), placed(&y, ranges[1][end])]);
    // Points at the foot are seen whole.
    low[1] -= FOOT * (high[1] - low[1]);
    let at = |place: [f64; 2]| [placed(&x, place[0]), placed(&y, place[1])];
    let weak = ui.visuals().weak_text_color();
    let (x_log, y_log) = (x.log_from.is_some(), y.log_from.is_some());
    let written = |log: bool| {
        move |mark: GridMark, _: &std::ops::RangeInclusive<f64>| {
            tick(if log { 10.0_f64.powf(mark.value) } else { mark.value })
        }
    };
    // Upright it would be longer than many a plot is high.
    let title = ui.label(egui::RichText::new(&y.label).size(LABEL_SIZE).weak());
    let height = (height - title.rect.height() - ui.spacing().item_spacing.y).max(60.0);
    let plot = Plot::new("ways")
        .height(height)
        .show_x(false)
        .show_y(false)
        .allow_drag(false)
        .allow_zoom(false)
        .allow_scroll(false)
        .allow_boxed_zoom(false)
        .allow_axis_zoom_drag(false)
        .allow_double_click_reset(false)
        .show_crosshair(false)
        .grid_color(weak.gamma_multiply(0.35))
        .label_formatter(|_| None)
        .x_axis_label(egui::RichText::new(&x.label).size(LABEL_SIZE))
        .x_axis_formatter(written(x_log))
        .y_axis_formatter(written(y_log))
        .y_axis_min_width(34.0);
    let plot = if x_log { plot.x_grid_spacer(decades) } else { plot };
    let steps = f64::from((height / STEP_HEIGHT).floor().max(1.0));
    let plot = if y_log { plot.y_grid_spacer(decades) } else { plot.y_grid_spacer(move |input| even(input, steps)) };
    let drawn = plot.show(ui, |plot| {
        plot.set_plot_bounds(PlotBounds::from_min_max(low, high));
        plot.vline(
            VLine::new("yardstick", placed(&x, 1.0)).color(weak.gamma_multiply(0.6)).width(1.0).allow_hover(false),
        );
    });
    let frame = *drawn.transform.frame();
    let on_screen = |place: [f64; 2]| drawn.transform.position_from_point(&PlotPoint::from(at(place)));
    named_picture(&drawn.response);
    let painter = ui.painter_at(frame);
    // One by one, as the joints of a line grow where it turns sharply.
    let front: Vec<Pos2> = shown.front.iter().filter_map(|i| shown.place(*i)).map(on_screen).collect();
    for ends in front.windows(2) {
        painter.line_segment([ends[0], ends[1]], Stroke::new(1.4, weak));
    }
    let yardstick = painter.text(
        Pos2::new(on_screen([1.0, ranges[1][1]]).x + 3.0, frame.top() + 2.0),
        Align2::LEFT_TOP,
        Method::Phong.name(),
        FontId::proportional(LABEL_SIZE),
        weak,
    );
    // What is on the front lies over the rest, and what is open over what was.
    let mut order: Vec<&(usize, [f64; 2])> = places.iter().collect();
    order.sort_by_key(|(i, _)| (shown.current[*i], shown.front.contains(i)));
    for (i, place) in order {
        marker(ui, &painter, shown, *i, on_screen(*place));
    }
    let mut taken: Vec<Pos2> = places.iter().map(|(_, place)| on_screen(*place)).collect();
    taken.extend([yardstick.left_center(), yardstick.center(), yardstick.right_center()]);
    name_front(ui, &painter, shown, frame, &taken, &on_screen);
    let mut chosen = None;
    for (i, place) in &places {
        let name = shown.points[*i].way.name();
        let middle = on_screen(*place);
        let area = Rect::from_center_size(middle, egui::Vec2::splat(2.0 * REACH)).intersect(frame);
        // The table is there for keys.
        let response = ui.interact(area, ui.scope_id().with(("point", &name)), Sense::CLICK | Sense::HOVER);
        let response = named(response, &format!("Point of {name}"));
        if response.hovered() {
            painter.circle_stroke(middle, REACH - 1.0, Stroke::new(1.0, ui.visuals().text_color()));
            ui.set_cursor_icon(egui::CursorIcon::PointingHand);
        }
        if response.clicked() {
            chosen = Some(shown.points[*i].way.params);
        }
        response.on_hover_text_at_pointer(format!("{name}\n{}", told(shown, *i)));
    }
    if let Some(params) = chosen {
        switch_to(panel, &params);
    }
}

fn named_picture(response: &egui::Response) {
    let enabled = response.enabled();
    response.widget_info(|| egui::WidgetInfo::labeled(egui::Role::Image, enabled, "Chart of all ways"));
}

/// A number's place on an axis.
fn placed(axis: &Axis, number: f64) -> f64 {
    axis.log_from.map_or(number, |least| number.max(least).log10())
}

/// Ticks of a logarithmic axis: powers of ten, and twos and fives where there are few of these.
fn decades(input: GridInput) -> Vec<GridMark> {
    let (least, most) = input.bounds;
    let fine = most - least < FINE_DECADES;
    let mut marks = Vec::new();
    for decade in least.floor() as i32..=most.ceil() as i32 {
        for (factor, step_size) in [(1.0_f64, 1.0), (2.0, 0.3), (5.0, 0.3)] {
            let value = f64::from(decade) + factor.log10();
            if (factor == 1.0 || fine) && (least..=most).contains(&value) {
                marks.push(GridMark { value, step_size });
            }
        }
    }
    marks
}

/// Ticks of an even axis, at about so many steps of 1, 2 or 5 times a power of ten.
fn even(input: GridInput, steps: f64) -> Vec<GridMark> {
    let (least, most) = input.bounds;
    let rough = (most - least) / steps;
    let decade = 10.0_f64.powf(rough.log10().floor());
    let step = [1.0, 2.0, 5.0, 10.0].map(|factor| factor * decade).into_iter().find(|step| *step >= rough);
    let step = step.unwrap_or(rough);
    if !(step.is_finite() && step > 0.0) {
        return Vec::new();
    }
    let first = (least / step).ceil() as i64;
    let last = (most / step).floor() as i64;
    (first..=last).map(|mark| GridMark { value: mark as f64 * step, step_size: step }).collect()
}

fn marker(ui: &Ui, painter: &egui::Painter, shown: &Shown<'_>, i: usize, at: Pos2) {
    let best = shown.front.contains(&i);
    let colour = shown.colour(ui, i);
    let colour = if best { colour } else { colour.gamma_multiply(PALE) };
    let radius = if best { 5.0 } else { 4.0 };
    symbol(painter, shown.points[i].way.params.form, at, radius, colour);
    if shown.present == Some(i) {
        painter.circle_stroke(at, radius + 4.0, Stroke::new(2.0, ui.visuals().selection.bg_fill));
    }
}

/// A dot for hardened forms, a triangle for those as printed.
pub(super) fn symbol(painter: &egui::Painter, form: Form, at: Pos2, radius: f32, colour: Color32) {
    match form {
        Form::Hardened => {
            painter.circle_filled(at, radius, colour);
        }
        Form::Literal => {
            let corner = |turn: f32| at + radius * 1.25 * egui::Vec2::angled(turn.to_radians());
            let corners = [-90.0, 30.0, 150.0].map(corner).to_vec();
            painter.add(egui::Shape::convex_polygon(corners, colour, Stroke::NONE));
        }
    }
}

/// Writes the names of the points on the front where there is room.
fn name_front(
    ui: &Ui,
    painter: &egui::Painter,
    shown: &Shown<'_>,
    frame: Rect,
    taken: &[Pos2],
    on_screen: &dyn Fn([f64; 2]) -> Pos2,
) {
    let pixel = |at: Pos2| [f64::from(at.x), f64::from(at.y)];
    let named: Vec<(Pos2, std::sync::Arc<egui::Galley>)> = shown
        .front
        .iter()
        .filter_map(|i| {
            let text = shown.points[*i].way.name();
            let galley = painter.layout_no_wrap(text, FontId::proportional(LABEL_SIZE), ui.visuals().text_color());
            Some((on_screen(shown.place(*i)?), galley))
        })
        .collect();
    let labels: Vec<Label> = named
        .iter()
        .map(|(at, galley)| Label { point: pixel(*at), size: [f64::from(galley.size().x), f64::from(galley.size().y)] })
        .collect();
    let mut taken: Vec<[f64; 2]> = taken.iter().copied().map(pixel).collect();
    taken.extend(along(&labels.iter().map(|label| label.point).collect::<Vec<_>>()));
    let inner = frame.shrink(3.0);
    let bounds = [inner.left(), inner.top(), inner.right(), inner.bottom()].map(f64::from);
    for ((at, galley), [left, top]) in named.into_iter().zip(place_labels(&labels, &taken, bounds)) {
        let corner = Pos2::new(left as f32, top as f32);
        let text = Rect::from_min_size(corner, galley.size());
        let nearest = text.clamp(at);
        let away = f64::from(nearest.distance(at));
        if away > FAR {
            continue;
        }
        if away > TIED {
            painter.line_segment([at, nearest], Stroke::new(0.8, ui.visuals().weak_text_color()));
        }
        // Legible also over the line and the grid.
        painter.rect_filled(text.expand(1.0), 2.0, ui.visuals().extreme_bg_color.gamma_multiply(0.7));
        painter.galley(corner, galley, ui.visuals().text_color());
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ticks_are_few_round_and_within_the_axis() {
        let ticks = |marks: Vec<GridMark>| marks.iter().map(|mark| mark.value).collect::<Vec<_>>();
        let input = |bounds| GridInput { bounds, base_step_size: 0.1 };
        assert_eq!(ticks(even(input((0.0, 97.0)), 4.0)), [0.0, 50.0]);
        assert_eq!(ticks(even(input((0.0, 0.55)), 6.0)), [0.0, 0.1, 0.2, 0.30000000000000004, 0.4, 0.5]);
        assert!(even(input((0.0, f64::NAN)), 6.0).is_empty());
        let written: Vec<String> =
            ticks(decades(input((-0.1, 1.4)))).iter().map(|value| tick(10.0_f64.powf(*value))).collect();
        assert_eq!(written, ["1", "2", "5", "10", "20"]);
        assert_eq!(ticks(decades(input((-2.5, 1.0)))), [-2.0, -1.0, 0.0, 1.0], "powers of ten alone");
    }
}
