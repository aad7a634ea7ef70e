//! The gallery.

use std::path::PathBuf;

use egui::{Color32, CornerRadius, Rect, Sense, Stroke, Ui};

use super::Panel;
use crate::app::command::Command;
use crate::app::state::PresetSource;

/// Side of a thumbnail at most, in points.
const SIDE: f32 = 104.0;

pub(super) fn show(panel: &mut Panel<'_>, ui: &mut Ui) {
    let state = panel.state;
    ui.horizontal_wrapped(|ui| {
        let mark = if state.is_unsaved() { " •" } else { "" };
        ui.strong(format!("{}{mark}", state.preset_name())).on_hover_text(match &state.document.source {
            PresetSource::Shipped(_) => "Comes with the tool; it is saved under a name of your own".to_owned(),
            PresetSource::File(path) => path.display().to_string(),
            PresetSource::New(_) => "Not saved yet".to_owned(),
        });
    });
    let description = &state.document.preset.description;
    if !description.is_empty() {
        ui.label(egui::RichText::new(description).weak().small());
    }
    ui.horizontal_wrapped(|ui| {
        ui.spacing_mut().item_spacing.x = 4.0;
        let buttons = [
            ("Open…", "Open a preset file (Ctrl+O); or drop one onto the window", Command::OpenPreset(None), true),
            ("Save", "Save the preset (Ctrl+S)", Command::Save, state.is_unsaved()),
            ("Save as…", "Save it under another name", Command::SaveAs(None), true),
            ("Duplicate", "Go on with a copy (Ctrl+D)", Command::Duplicate, true),
            ("Revert", "Back to what was last saved", Command::Revert, state.is_unsaved()),
        ];
        for (name, help, command, possible) in buttons {
            if ui.add_enabled(possible, egui::Button::new(name)).on_hover_text(help).clicked() {
                panel.commands.push(command);
            }
        }
    });
    ui.add_space(4.0);
    egui::ScrollArea::vertical().auto_shrink(false).show(ui, |ui| {
        ui.label(egui::RichText::new("SHIPPED").small().weak());
        let shipped = tam_gen::Preset::embedded().iter().map(|(name, _)| Card {
            name: (*name).to_owned(),
            key: preset_key(name),
            chosen: state.document.source == PresetSource::Shipped((*name).to_owned()),
            command: Command::OpenShipped((*name).to_owned()),
            help: None,
        });
        cards(panel, ui, shipped.collect());
        let recent: Vec<PathBuf> = state.settings.recent_presets.clone();
        ui.add_space(6.0);
        ui.label(egui::RichText::new("YOURS").small().weak());
        if recent.is_empty() {
            ui.label(egui::RichText::new("Presets that you save or open come here.").weak());
        }
        let own = recent.into_iter().map(|path| Card {
            name: path.file_stem().map_or_else(String::new, |stem| stem.to_string_lossy().into_owned()),
            key: file_key(&path),
            chosen: state.document.source == PresetSource::File(path.clone()),
            help: Some(path.display().to_string()),
            command: Command::OpenPreset(Some(path)),
        });
        cards(panel, ui, own.collect());
    });
}

/// Key of the thumbnail of a preset that comes with the tool.
pub(crate) fn preset_key(name: &str) -> String {
    format!("preset:{name}")
}

/// Key of the thumbnail of a preset file.
pub(crate) fn file_key(path: &std::path::Path) -> String {
    format!("preset file:{}", path.display())
}

/// A picture with a name under it.
pub(super) struct Card {
    pub name: String,
    pub key: String,
    pub chosen: bool,
    pub command: Command,
    pub help: Option<String>,
}

/// Pictures in rows, as many as fit.
pub(super) fn cards(panel: &mut Panel<'_>, ui: &mut Ui, cards: Vec<Card>) {
    let gap = 6.0;
    let columns = ((ui.available_width() + gap) / (SIDE + gap)).floor().max(2.0);
    let side = ((ui.available_width() - gap * (columns - 1.0)) / columns).clamp(32.0, SIDE * 1.4).floor();
    for row in cards.chunks(columns as usize) {
        ui.horizontal(|ui| {
            ui.spacing_mut().item_spacing.x = gap;
            for card in row {
                one(panel, ui, card, side);
            }
        });
    }
}

fn one(panel: &mut Panel<'_>, ui: &mut Ui, card: &Card, side: f32) {
    let (rect, response) = ui.allocate_exact_size(egui::vec2(side, side + 18.0), Sense::click());
    let enabled = response.enabled();
    response.widget_info(|| egui::WidgetInfo::selected(egui::Role::Button, enabled, card.chosen, &card.name));
    let picture = Rect::from_min_size(rect.min, egui::Vec2::splat(side));
    let painter = ui.painter_at(rect.expand(2.0));
    let visuals = ui.visuals().clone();
    let corner = CornerRadius::same(5);
    match panel.results.thumbnails.get(&card.key) {
        Some(thumbnail) => {
            let texture = panel.textures.of(thumbnail);
            let uv = Rect::from_min_max(egui::Pos2::ZERO, egui::Pos2::new(1.0, 1.0));
            egui::Image::from_texture((texture, picture.size())).uv(uv).corner_radius(corner).paint_at(ui, picture);
        }
        None => {
            painter.rect_filled(picture, corner, visuals.faint_bg_color);
        }
    }
    let stroke = if card.chosen {
        Stroke::new(2.5, visuals.selection.bg_fill)
    } else if response.hovered() || response.has_focus() {
        Stroke::new(1.5, visuals.widgets.hovered.fg_stroke.color)
    } else {
        Stroke::new(1.0, visuals.widgets.noninteractive.bg_stroke.color)
    };
    painter.rect_stroke(picture, corner, stroke, egui::StrokeKind::Inside);
    let colour = if card.chosen { visuals.strong_text_color() } else { visuals.text_color() };
    let words = shortened(&painter, &card.name, side, colour);
    let at = egui::pos2(rect.center().x - words.size().x * 0.5, picture.bottom() + 2.0);
    painter.galley(at, words, Color32::WHITE);
    if let Some(help) = &card.help {
        response.clone().on_hover_text(help);
    }
    if response.clicked() {
        panel.ask(card.command.clone());
    }
}

fn shortened(painter: &egui::Painter, text: &str, width: f32, colour: Color32) -> std::sync::Arc<egui::Galley> {
    let font = egui::FontId::proportional(12.0);
    let mut job = egui::text::LayoutJob::simple_singleline(text.to_owned(), font, colour);
    job.wrap = egui::text::TextWrapping::truncate_at_width(width);
    painter.layout_job(job)
}
