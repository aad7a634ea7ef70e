//! Files for engines, pictures and turntables.

use egui::{RichText, Ui};
use tam_gen::export::Format;

use super::Panel;
use super::number::{self, Number};
use super::strokes::section;
use crate::app::command::Command;
use crate::app::words;

pub(super) fn show(panel: &mut Panel<'_>, ui: &mut Ui) {
    egui::ScrollArea::vertical().auto_shrink(false).show(ui, |ui| {
        section(ui, "Map for an engine", true, |ui| map(panel, ui));
        section(ui, "Picture", true, |ui| picture(panel, ui));
        section(ui, "Turntable", true, |ui| turntable(panel, ui));
        if let Some((what, part)) = &panel.results.writing {
            ui.add(egui::ProgressBar::new(*part).text(what.as_str()));
            if ui.button("Stop").clicked() {
                panel.ask(Command::Cancel);
            }
        }
    });
}

fn map(panel: &mut Panel<'_>, ui: &mut Ui) {
    let mut settings = panel.state.settings.export.clone();
    for format in Format::ALL {
        let mut on = settings.formats.iter().any(|name| name == format.name());
        let (title, engines) = split(format);
        let response = ui.checkbox(&mut on, capitalised(title)).on_hover_text(format.describe());
        if response.changed() {
            settings.formats.retain(|name| name != format.name());
            if on {
                settings.formats.push(format.name().to_owned());
            }
        }
        ui.indent(format.name(), |ui| ui.label(RichText::new(engines).small().weak()));
    }
    ui.checkbox(&mut settings.sheet, "Contact sheet");
    ui.checkbox(&mut settings.overwrite, "Replace files of the same names");
    ui.horizontal(|ui| {
        if ui.button("Folder…").clicked() {
            panel.ask(Command::ChooseExportFolder);
        }
        let shown = settings.folder.display().to_string();
        ui.add(egui::Label::new(RichText::new(&shown).weak()).truncate()).on_hover_text(&shown);
    });
    ui.horizontal(|ui| {
        let ready = !settings.formats.is_empty() && panel.results.writing.is_none();
        let button = egui::Button::new(RichText::new("Export").strong());
        if ui.add_enabled(ready, button).on_hover_text("Write the map (Ctrl+E)").clicked() {
            panel.ask(Command::Export);
        }
        if ui.button("Reveal").on_hover_text("Show the folder").clicked() {
            panel.ask(Command::Reveal(settings.folder.clone()));
        }
        ui.weak(format!("about {}", words::bytes(estimate(panel, &settings.formats))));
    });
    if settings != panel.state.settings.export {
        panel.ask(Command::SetExport(settings));
    }
}

/// What a format is, and which engines it is for.
fn split(format: Format) -> (&'static str, &'static str) {
    format.describe().split_once(": ").unwrap_or((format.describe(), ""))
}

fn capitalised(text: &str) -> String {
    let mut letters = text.chars();
    letters.next().map_or_else(String::new, |first| first.to_uppercase().chain(letters).collect())
}

/// About how large the files will be, in bytes.
fn estimate(panel: &Panel<'_>, formats: &[String]) -> u64 {
    let Some(made) = &panel.results.map else { return 0 };
    let size = u64::from(panel.state.document.preset.map.size);
    let levels = panel.state.document.preset.level_count() as u32;
    let columns = made.map.grid.columns() as u64;
    let plane = (0..levels).map(|level| (size >> level).pow(2)).sum::<u64>();
    let of = |format: Format| match format {
        // What zstd leaves of thin strokes, of soft ones less.
        Format::Ktx2 => plane * columns / 8,
        Format::Ktx2Bc4 => plane * columns / 5,
        Format::DdsArray | Format::DdsSlices => plane * columns,
        Format::RgbaPacked => plane * columns * 4 / 3 / 8,
        Format::Png => plane * columns / 4,
        Format::StrokesJson => made.map.strokes.strokes.len() as u64 * 190,
        Format::StrokesSvg => made.map.strokes.strokes.len() as u64 * 130,
    };
    Format::ALL.into_iter().filter(|format| formats.iter().any(|name| name == format.name())).map(of).sum::<u64>()
        + plane / 3
}

fn picture(panel: &mut Panel<'_>, ui: &mut Ui) {
    let mut settings = panel.state.settings.picture.clone();
    ui.horizontal(|ui| {
        let label = number::name(ui, "Size", "In pixels");
        for (prefix, side) in ["w ", "h "].into_iter().zip(&mut settings.size_px) {
            ui.add(egui::DragValue::new(side).range(16..=8192).prefix(prefix)).labelled_by(label.id);
        }
    });
    ui.horizontal_wrapped(|ui| {
        for (name, size) in [("Full HD", [1920, 1080]), ("4K", [3840, 2160]), ("Square", [2048, 2048])] {
            if ui.selectable_label(settings.size_px == size, name).clicked() {
                settings.size_px = size;
            }
        }
    });
    ui.checkbox(&mut settings.transparent, "Transparent paper");
    if ui.button("Save picture…").on_hover_text("Ctrl+Shift+P").clicked() {
        panel.ask(Command::SavePicture(None));
    }
    if settings != panel.state.settings.picture {
        panel.ask(Command::SetPicture(settings));
    }
}

fn turntable(panel: &mut Panel<'_>, ui: &mut Ui) {
    let mut settings = panel.state.settings.turntable.clone();
    let whole = |name, doc, min, max, default| Number { name, doc, unit: "", min, max, default, whole: true };
    let (mut side, mut frames, mut fps) =
        (f64::from(settings.side_px), f64::from(settings.frames), f64::from(settings.fps));
    let changed = number::row(ui, whole("Side", "Of its square frames, in pixels", 16.0, 2048.0, 512.0), &mut side)
        | number::row(ui, whole("Frames", "Of one round", 2.0, 360.0, 48.0), &mut frames)
        | number::row(ui, whole("Per second", "Frames per second", 1.0, 60.0, 24.0), &mut fps);
    if changed {
        (settings.side_px, settings.frames, settings.fps) = (side as u32, frames as u32, fps as u16);
        panel.ask(Command::SetTurntable(settings));
    }
    if ui
        .button("Save turntable…")
        .on_hover_text("What plays, else the camera going round; .png (APNG) or .gif")
        .clicked()
    {
        panel.ask(Command::SaveTurntable(None));
    }
}
