//! Messages in the corner of the window.

use egui::{Align2, Area, Color32, Context, Id, Label, Order, RichText, Ui};

use super::number::named;
use crate::app::state::{Notice, Severity};

/// A message on the screen, and how long it still stays, in seconds; errors stay until they are closed.
pub(crate) struct Shown {
    notice: Notice,
    left_s: Option<f32>,
}

impl Shown {
    /// A message from now on.
    pub(crate) fn new(notice: Notice) -> Self {
        let left_s = match notice.severity {
            Severity::Done => Some(5.0),
            Severity::Info => Some(8.0),
            Severity::Warning => Some(15.0),
            Severity::Error => None,
        };
        Self { notice, left_s }
    }
}

/// Messages at once; older ones go.
const AT_ONCE: usize = 5;

/// Draws all messages, and takes out those that have been read.
pub(crate) fn notices(ctx: &Context, shown: &mut Vec<Shown>) {
    if shown.len() > AT_ONCE {
        shown.drain(..shown.len() - AT_ONCE);
    }
    if shown.is_empty() {
        return;
    }
    let area = Area::new(Id::unique("notices")).order(Order::Foreground);
    let area = area.anchor(Align2::RIGHT_BOTTOM, egui::vec2(-12.0, -36.0));
    let hovered = area
        .show(ctx, |ui| {
            ui.set_max_width(430.0);
            shown.retain(|shown| !one(ui, &shown.notice));
        })
        .response
        .contains_pointer();
    let step = ctx.input(|input| input.stable_dt.min(0.1));
    if !hovered {
        shown.iter_mut().filter_map(|shown| shown.left_s.as_mut()).for_each(|left| *left -= step);
        shown.retain(|shown| shown.left_s.is_none_or(|left| left > 0.0));
    }
    if shown.iter().any(|shown| shown.left_s.is_some()) {
        ctx.request_repaint_after(std::time::Duration::from_millis(100));
    }
}

/// One message; whether it was closed.
fn one(ui: &mut Ui, notice: &Notice) -> bool {
    let (mark, colour) = match notice.severity {
        Severity::Done => ("✔", Color32::from_rgb(70, 160, 90)),
        Severity::Info => ("ℹ", Color32::from_rgb(74, 132, 220)),
        Severity::Warning => ("⚠", Color32::from_rgb(200, 145, 20)),
        Severity::Error => ("✖", Color32::from_rgb(214, 70, 60)),
    };
    let frame = egui::Frame::popup(ui.style()).stroke(egui::Stroke::new(1.0, colour));
    frame
        .show(ui, |ui| {
            ui.horizontal_top(|ui| {
                ui.label(RichText::new(mark).color(colour).strong());
                let width = 360.0;
                ui.allocate_ui_with_layout(egui::vec2(width, 0.0), egui::Layout::top_down(egui::Align::LEFT), |ui| {
                    ui.set_max_width(width);
                    // Reports of presets point at columns, which only even letters keep in line.
                    let many = notice.text.lines().count() > 1;
                    let text = RichText::new(&notice.text);
                    ui.add(Label::new(if many { text.monospace().small() } else { text }).wrap());
                });
                named(ui.small_button("✖"), "Close message").clicked()
            })
            .inner
        })
        .inner
}
