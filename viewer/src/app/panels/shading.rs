//! How strokes are put on the surface.

use egui::Ui;
use glam::DVec3;

use super::Panel;
use super::number::{self, Number};
use super::strokes::section;
use crate::app::actions::{mapping_label, method_label};
use crate::app::command::Command;
use crate::app::state::{FieldChoice, Look};
use crate::params::{Blend, Silhouettes};
use crate::{Follow, Form, Mapping, Method, RenderParams, ranges};

pub(super) fn show(panel: &mut Panel<'_>, ui: &mut Ui) {
    let mut look = panel.state.document.look.clone();
    egui::ScrollArea::vertical().auto_shrink(false).show(ui, |ui| {
        section(ui, "Method", true, |ui| method(ui, &mut look));
        if look.params.needed_mapping().is_some() || look.params.method == Method::Stripes {
            section(ui, "Direction", true, |ui| direction(panel, ui, &mut look));
        }
        section(ui, "Detail", true, |ui| detail(ui, &mut look));
        section(ui, "Lines", true, |ui| lines(ui, &mut look));
        if let Some(problem) = &panel.results.surface_problem {
            ui.colored_label(ui.visuals().error_fg_color, problem);
        }
    });
    if look != panel.state.document.look {
        panel.ask(Command::SetLook(Box::new(look)));
    }
}

fn method(ui: &mut Ui, look: &mut Look) {
    let params = &mut look.params;
    let label = |method: Method| method_label(method).to_owned();
    number::choice(ui, "Method", "How tone becomes strokes (keys 1 to 7)", &mut params.method, &Method::ALL, label);
    ui.label(egui::RichText::new(describe(params.method)).weak().small());
    if params.method.takes_mapping() {
        let label = |mapping: Mapping| mapping_label(mapping).to_owned();
        let doc = "How strokes lie on the surface (Alt and 1 to 5)";
        number::choice(ui, "Mapping", doc, &mut params.mapping, &Mapping::ALL, label);
    }
    let mut literal = params.form == Form::Literal;
    let response = ui.checkbox(&mut literal, "As printed in the paper");
    if response.on_hover_text("Without the cures for its known failures (P)").changed() {
        params.form = if literal { Form::Literal } else { Form::Hardened };
    }
}

fn describe(method: Method) -> &'static str {
    match method {
        Method::Phong => "The wanted tone in grey: what all others are measured by.",
        Method::SixWay => "Praun 2001: six columns, blended at vertices. The classic.",
        Method::FaceFrame => "Suarez 2013: strokes turn with the light, face by face.",
        Method::StrokeMap => "Freudenberg 2001: one image and a threshold; crisp.",
        Method::Halftone => "Freudenberg 2001: lines whose width follows the tone.",
        Method::FineTone => "Webb 2002: many columns; the smoothest tones.",
        Method::Stripes => "Engraving: one line field over the whole surface, exact tone.",
    }
}

fn direction(panel: &Panel<'_>, ui: &mut Ui, look: &mut Look) {
    let has_uv = panel.results.mesh.as_ref().is_some_and(|mesh| !mesh.mesh.uvs.is_empty());
    let chosen = look.field;
    let kind = |choice: FieldChoice| std::mem::discriminant(&choice);
    let offered: Vec<FieldChoice> = FieldChoice::ALL
        .into_iter()
        .filter(|choice| *choice != FieldChoice::Uv || has_uv)
        .map(|choice| if kind(choice) == kind(chosen) { chosen } else { choice })
        .collect();
    let doc = "What strokes follow, where no guide is near";
    number::choice(ui, "Strokes run", doc, &mut look.field, &offered, |choice| choice.label().to_owned());
    if let FieldChoice::Constant(direction) = &mut look.field {
        ui.horizontal(|ui| {
            let label = number::name(ui, "Direction", "In the mesh's space");
            for (axis, value) in [("x", &mut direction.x), ("y", &mut direction.y), ("z", &mut direction.z)] {
                let drag = egui::DragValue::new(value).speed(0.02).range(-1.0..=1.0).prefix(format!("{axis} "));
                ui.add(drag).labelled_by(label.id);
            }
        });
        if direction.length() < 1e-6 {
            *direction = DVec3::Y;
        }
    }
    let smoothing = "How far directions spread into places without one, as a multiple of the default";
    number::row(ui, Number::view("Smoothing", smoothing, ranges::SMOOTHING, 1.0), &mut look.smoothing);
    if look.params.needed_mapping() == Some(Mapping::Patches) && look.params.method != Method::Stripes {
        let mut follows = look.params.follow == Follow::Light;
        let response = ui.checkbox(&mut follows, "Turn with the light");
        if response.on_hover_text("Strokes turn across the light, in steps that pass into each other").changed() {
            look.params.follow = if follows { Follow::Light } else { Follow::Surface };
        }
        ui.checkbox(&mut look.planar, "Lay patches flat")
            .on_hover_text("By projection: quicker to make, true on flat ground only");
    }
    ui.horizontal(|ui| {
        let guides = look.guides.len();
        number::name(ui, "Guides", "Strokes that you draw on the mesh, and all others follow");
        ui.label(if guides == 0 { "none".to_owned() } else { guides.to_string() });
        let clear = egui::Button::new("Clear").small();
        if ui.add_enabled(guides > 0, clear).on_hover_text("Take all guides away").clicked() {
            look.guides.clear();
        }
    });
}

fn detail(ui: &mut Ui, look: &mut Look) {
    let default = RenderParams::default();
    let params = &mut look.params;
    if params.method.takes_mapping() || params.method == Method::FaceFrame {
        let doc = "Repeats of the tile per world unit; meshes are 2 units long";
        let tiles = Number::view("Tiles", doc, ranges::TILES_PER_UNIT, default.tiles_per_unit).between(0.1, 20.0);
        number::row(ui, tiles, &mut params.tiles_per_unit);
        let doc = "Added to the level of detail: negative draws finer, thinner strokes";
        number::row(
            ui,
            Number::view("Level bias", doc, ranges::LEVEL_BIAS, default.level_bias),
            &mut params.level_bias,
        );
    }
    if params.method.takes_mapping() && params.mapping.takes_surface() {
        let word = |blend: Blend| match blend {
            Blend::Union => "Union (whole strokes)".to_owned(),
            Blend::Linear => "Linear (soft, for pencil)".to_owned(),
        };
        let doc = "How patterns that overlap are joined";
        number::choice(ui, "Overlaps", doc, &mut params.blend, &[Blend::Union, Blend::Linear], word);
    }
    if matches!(params.method, Method::StrokeMap | Method::Halftone) && params.form == Form::Literal {
        let doc = "Slope of the threshold as printed";
        number::row(
            ui,
            Number::view("Slope", doc, ranges::SLOPE, default.slope).between(1.01, 40.0),
            &mut params.slope,
        );
    }
    if matches!(params.method, Method::Halftone | Method::Stripes) {
        let doc = "Least distance of lines on the screen; they double where there is more room";
        let period = Number::view("Line spacing", doc, ranges::LINE_PERIOD_PX, default.line_period_px);
        number::row(ui, period.between(2.0, 40.0), &mut params.line_period_px);
    }
    if params.method == Method::Stripes {
        let mut crossed = params.cross_from.is_some();
        if ui.checkbox(&mut crossed, "Cross dark places").changed() {
            params.cross_from = crossed.then_some(default.cross_from.unwrap_or(0.55));
        }
        if let Some(cross_from) = &mut params.cross_from {
            let doc = "Darkness above which lines are crossed by others";
            let number = Number { name: "Cross from", doc, unit: "", min: 0.0, max: 1.0, default: 0.55, whole: false };
            number::row(ui, number, cross_from);
        }
        let doc = "How much strokes differ: from banknote to lively burin";
        number::row(ui, Number::view("Variety", doc, ranges::VARIETY, default.variety), &mut params.variety);
        let doc = "Lines per unit at their coarsest, before any is doubled";
        let lines = Number::view("Coarsest lines", doc, ranges::LINES_PER_UNIT, Look::default().lines_per_unit);
        number::row(ui, lines, &mut look.lines_per_unit);
    }
}

fn lines(ui: &mut Ui, look: &mut Look) {
    let mut drawn = look.params.silhouettes.is_some();
    if ui.checkbox(&mut drawn, "Draw outlines").changed() {
        look.params.silhouettes = drawn.then(Silhouettes::default);
    }
    let Some(silhouettes) = &mut look.params.silhouettes else { return };
    let default = Silhouettes::default();
    let width = Number::view("Width", "On the screen", ranges::LINE_WIDTH_PX, default.width_px).between(0.25, 12.0);
    number::row(ui, width, &mut silhouettes.width_px);
    ui.checkbox(&mut silhouettes.contours, "Where the surface turns away");
    ui.checkbox(&mut silhouettes.borders, "Where the surface ends");
    let mut creases = silhouettes.crease_deg.is_some();
    if ui.checkbox(&mut creases, "At hard edges").changed() {
        silhouettes.crease_deg = creases.then_some(default.crease_deg.unwrap_or(75.0));
    }
    if let Some(crease_deg) = &mut silhouettes.crease_deg {
        let doc = "Angle above which an edge is hard";
        number::row(ui, Number::view("Hard above", doc, ranges::CREASE_DEG, 75.0), crease_deg);
    }
}
