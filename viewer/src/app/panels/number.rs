//! Rows for numbers: name, slider, number with its unit, and the way back to the default.

use egui::{Response, Slider, SliderClamping, Ui, WidgetText};

/// A number as its users need to know it.
#[derive(Clone, Copy, Debug)]
pub(super) struct Number<'a> {
    pub name: &'a str,
    pub doc: &'a str,
    pub unit: &'a str,
    pub min: f64,
    pub max: f64,
    pub default: f64,
    /// Only whole numbers.
    pub whole: bool,
}

impl<'a> Number<'a> {
    pub(super) fn of(range: &'a tam_gen::preset::Range, name: &'a str) -> Self {
        let whole = matches!(range.table, "map" | "placement");
        let tam_gen::preset::Range { doc, unit, min, max, default, .. } = *range;
        Self { name, doc, unit, min, max, default, whole }
    }

    pub(super) fn view(name: &'a str, doc: &'a str, range: crate::ranges::Range, default: f64) -> Self {
        Self { name, doc, unit: range.unit, min: range.min, max: range.max, default, whole: false }
    }

    /// Within these limits only.
    pub(super) fn between(self, min: f64, max: f64) -> Self {
        Self { min: self.min.max(min), max: self.max.min(max), ..self }
    }
}

/// Width of the names before sliders, in points.
const NAME_WIDTH: f32 = 98.0;

/// Width of the numbers and buttons behind sliders, in points.
const NUMBER_WIDTH: f32 = 92.0;

/// A row for a number; whether it was changed.
pub(super) fn row(ui: &mut Ui, number: Number<'_>, value: &mut f64) -> bool {
    let mut changed = false;
    ui.horizontal(|ui| {
        let label = name(ui, number.name, number.doc);
        changed = slider(ui, number, value, &label);
        changed |= reset(ui, number.name, (*value - number.default).abs() > 1e-12, || *value = number.default);
    });
    changed
}

/// Rows for the three coordinates of a point or a stretch: its name, and below it as much room as there is.
pub(super) fn axes(ui: &mut Ui, title: &str, doc: &str, range: crate::ranges::Range, value: &mut glam::DVec3) {
    let label = ui.label(title).on_hover_text(doc);
    ui.horizontal(|ui| {
        let width = ((ui.available_width() - 2.0 * ui.spacing().item_spacing.x) / 3.0).clamp(40.0, 90.0);
        let size = egui::vec2(width, ui.spacing().interact_size.y);
        for (axis, value) in [("x ", &mut value.x), ("y ", &mut value.y), ("z ", &mut value.z)] {
            let drag = egui::DragValue::new(value).speed(0.02).range(range.min..=range.max).prefix(axis);
            ui.add_sized(size, drag.max_decimals(3)).labelled_by(label.id);
        }
    });
}

/// A row for two numbers in order; whether one was changed.
pub(super) fn range_row(ui: &mut Ui, number: Number<'_>, default: [f64; 2], range: &mut [f64; 2]) -> bool {
    let before = *range;
    ui.horizontal(|ui| {
        let label = name(ui, number.name, number.doc);
        let suffix = if number.unit == "degrees" { "°" } else { "" };
        let speed = if number.unit == "degrees" { 1.0 } else { 0.02 };
        let [from, to] = before;
        for (prefix, value, within) in [("from ", 0, number.min..=to), ("to ", 1, from..=number.max)] {
            let drag = egui::DragValue::new(&mut range[value]).speed(speed).range(within).max_decimals(2);
            ui.add(drag.prefix(prefix).suffix(suffix)).labelled_by(label.id);
        }
        reset(ui, number.name, before != default, || *range = default);
    });
    before != *range
}

/// The name in front of a row, with its help.
pub(super) fn name(ui: &mut Ui, name: impl Into<WidgetText>, doc: &str) -> Response {
    let height = ui.spacing().interact_size.y;
    let layout = egui::Layout::left_to_right(egui::Align::Center);
    let size = egui::vec2(NAME_WIDTH, height);
    let label = |ui: &mut Ui| {
        ui.set_min_width(NAME_WIDTH);
        ui.add(egui::Label::new(name).truncate())
    };
    let response = ui.allocate_ui_with_layout(size, layout, label).inner;
    if doc.is_empty() { response } else { response.on_hover_text(doc) }
}

/// The slider of a row.
pub(super) fn slider(ui: &mut Ui, number: Number<'_>, value: &mut f64, label: &Response) -> bool {
    let Number { unit, min, max, whole, .. } = number;
    let free = ui.available_width() - NUMBER_WIDTH;
    ui.spacing_mut().slider_width = free.max(40.0);
    // All numbers are equally wide, so that what follows them stands in line.
    ui.spacing_mut().interact_size.x = 58.0;
    let logarithmic = min >= 0.0 && max > 90.0 * min.max(0.02) && max > 2.0;
    let suffix = match unit {
        "" | "tile" | "candidates" | "tile lengths" | "tip lengths" | "tiles per unit" | "lines per unit"
        | "levels" => "",
        "degrees" => "°",
        unit => unit,
    };
    let spaced = if suffix.is_empty() || suffix == "°" { suffix.to_owned() } else { format!(" {suffix}") };
    let mut slider = Slider::new(value, min..=max)
        .logarithmic(logarithmic)
        .smallest_positive(if whole { 1.0 } else { 0.01 })
        .clamping(SliderClamping::Always)
        .suffix(spaced)
        .trailing_fill(true);
    // Sliders round to what they show.
    let decimals = if min > 0.0 && min < 1e-3 { 4 } else { 3 };
    slider = if whole { slider.integer() } else { slider.max_decimals(decimals) };
    let response = ui.add(slider).labelled_by(label.id);
    let response = if number.doc.is_empty() { response } else { response.on_hover_text(number.doc) };
    response.changed()
}

/// The way back to the default, where it was left.
pub(super) fn reset(ui: &mut Ui, name: &str, is_off: bool, back: impl FnOnce()) -> bool {
    let button = egui::Button::new("↺").small().frame(false);
    let response = ui.add_visible(is_off, button);
    let response = named(response, &format!("Reset {}", name.to_lowercase())).on_hover_text("Back to the default");
    if response.clicked() {
        back();
        return true;
    }
    false
}

/// Gives a widget a name for those who do not see it.
pub(super) fn named(response: Response, name: &str) -> Response {
    let enabled = response.enabled();
    response.widget_info(|| egui::WidgetInfo::labeled(egui::Role::Button, enabled, name));
    response
}

/// A row with a choice of words; whether it was changed.
pub(super) fn choice<T: PartialEq + Copy>(
    ui: &mut Ui,
    title: &str,
    doc: &str,
    chosen: &mut T,
    all: &[T],
    word: impl Fn(T) -> String,
) -> bool {
    let before = *chosen;
    ui.horizontal(|ui| {
        let label = name(ui, title, doc);
        let combo = egui::ComboBox::from_id_salt(title).selected_text(word(*chosen)).width(ui.available_width() - 8.0);
        let shown = combo.show_ui(ui, |ui| {
            for one in all {
                ui.selectable_value(chosen, *one, word(*one));
            }
        });
        shown.response.labelled_by(label.id);
    });
    before != *chosen
}
