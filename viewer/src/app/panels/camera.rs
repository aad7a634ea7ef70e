//! The camera: looks along axes, projection, opening and roll.

use egui::Ui;

use super::Panel;
use super::number::{self, Number};
use crate::app::command::Command;
use crate::{AxisView, Camera, Projection, ranges};

pub(super) fn show(panel: &mut Panel<'_>, ui: &mut Ui) {
    let before = panel.state.camera;
    let mut camera = before;
    ui.horizontal_wrapped(|ui| {
        for view in AxisView::ALL {
            let [azimuth_deg, elevation_deg] = view.angles_deg();
            let azimuth_deg = azimuth_deg.rem_euclid(360.0);
            let is_it = (camera.azimuth_deg, camera.elevation_deg) == (azimuth_deg, elevation_deg);
            let name = view.name()[..1].to_uppercase() + &view.name()[1..];
            if ui.selectable_label(is_it, name).clicked() {
                camera = Camera { azimuth_deg, elevation_deg, roll_deg: 0.0, ..camera };
            }
        }
    });
    let word = |projection| match projection {
        Projection::Perspective => "Perspective".to_owned(),
        Projection::Orthographic => "Orthographic".to_owned(),
    };
    let doc = "Whether lines of sight meet in the camera, or are parallel";
    number::choice(ui, "Projection", doc, &mut camera.projection, &Projection::ALL, word);
    let default = Camera::default();
    let opening = Number::view("Opening", "From bottom to top", ranges::FIELD_OF_VIEW_DEG, default.field_of_view_deg);
    let mut opened = camera.field_of_view_deg;
    if number::row(ui, opening.between(5.0, 100.0), &mut opened) {
        // What is at the target stays as large as it is.
        let height = |degrees: f64| (degrees.to_radians() * 0.5).tan();
        let distance = camera.distance * height(camera.field_of_view_deg) / height(opened);
        camera.distance = distance.clamp(ranges::DISTANCE.min, ranges::DISTANCE.max);
        camera.field_of_view_deg = opened;
    }
    let roll = Number {
        name: "Roll",
        doc: "Turn about the line of sight",
        unit: "degrees",
        min: -180.0,
        max: 180.0,
        default: 0.0,
        whole: false,
    };
    number::row(ui, roll, &mut camera.roll_deg);
    if camera != before {
        panel.ask(Command::SetCamera(camera));
    }
}
