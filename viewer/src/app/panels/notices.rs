//! Messages in the corner of the window.

use egui::{Align2, Area, Color32, Context, Id, Label, Order, RichText, Ui};

use super::number::named;
use crate::app::state::{Notice, Severity};

/// A message on the screen, and how long it still stays, in seconds; errors stay until they are closed.
pub(crate) struct Shown {
    notice: Notice,
    left_s: Option<f64>,
    /// When time last ran for it; it stands still under the pointer.
    counted_s: Option<f64>,
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
        Self { notice, left_s, counted_s: None }
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
    let now_s = ctx.input(|input| input.time);
    for shown in shown.iter_mut() {
        let since_s = shown.counted_s.filter(|_| !hovered).map_or(0.0, |counted_s| now_s - counted_s);
        shown.left_s = shown.left_s.map(|left_s| left_s - since_s);
        shown.counted_s = (!hovered).then_some(now_s);
    }
    shown.retain(|shown| shown.left_s.is_none_or(|left_s| left_s > 0.0));
    let soonest_s = shown.iter().filter_map(|shown| shown.left_s).fold(f64::INFINITY, f64::min);
    if soonest_s.is_finite() && !hovered {
        ctx.request_repaint_after(std::time::Duration::from_secs_f64(soonest_s));
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn messages_go_by_the_clock_however_few_frames_are_drawn() {
        let ctx = Context::default();
        let notice = |severity| Shown::new(Notice { severity, text: "It is done.".into() });
        let mut shown = vec![notice(Severity::Done), notice(Severity::Error)];
        let mut left_at = |time_s: f64| {
            let input = egui::RawInput { time: Some(time_s), ..egui::RawInput::default() };
            ctx.run_ui(input, |ui| notices(ui.ctx(), &mut shown)).textures_delta.clear();
            shown.len()
        };
        assert_eq!([0.0, 1.0, 4.9, 5.1].map(&mut left_at), [2, 2, 2, 1], "errors stay");
    }
}
