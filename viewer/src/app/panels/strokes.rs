//! All that a preset says.

use egui::{CollapsingHeader, Ui};
use tam_gen::Preset;
use tam_gen::preset::{FamilyOptions, MeasureName, PlacementMethod, Range, Tones};

use super::Panel;
use super::number::{self, Number};
use super::schedule;
use crate::app::command::Command;
use crate::app::words::option_name;

/// Groups of stroke numbers: title and keys.
const GROUPS: [(&str, &[&str]); 4] = [
    ("Shape", &["width_px", "width_jitter", "length_min", "length_max"]),
    ("Gesture", &["angle_jitter_deg", "bow", "s_curve"]),
    ("Pressure", &["taper_in", "taper_out", "taper_fade"]),
    ("Ink", &["opacity", "grain"]),
];

pub(super) fn show(panel: &mut Panel<'_>, ui: &mut Ui) {
    let mut preset = panel.state.document.preset.clone();
    egui::ScrollArea::vertical().auto_shrink(false).show(ui, |ui| {
        if let Some(problem) = &panel.results.map_problem {
            ui.colored_label(ui.visuals().error_fg_color, problem);
        }
        ui.horizontal(|ui| {
            if ui.button("Randomise").on_hover_text("Change every number that is not locked (Ctrl+R)").clicked() {
                panel.ask(Command::Randomise);
            }
            ui.label(egui::RichText::new("Locks keep a number as it is.").weak().small());
        });
        super::stroke_preview::show(panel, ui, &preset);
        for (title, keys) in GROUPS {
            section(ui, title, true, |ui| strokes(panel, ui, &mut preset, keys));
        }
        section(ui, "Families", true, |ui| families(ui, &mut preset));
        section(ui, "Schedule", true, |ui| schedule::show(ui, &mut preset));
        section(ui, "Map", true, |ui| map(ui, &mut preset));
        section(ui, "Placement", false, |ui| placement(ui, &mut preset));
        section(ui, "About", false, |ui| about(ui, &mut preset));
    });
    if preset != panel.state.document.preset {
        panel.ask(Command::SetPreset(Box::new(preset)));
    }
}

pub(super) fn section(ui: &mut Ui, title: &str, open: bool, content: impl FnOnce(&mut Ui)) {
    CollapsingHeader::new(egui::RichText::new(title).strong()).default_open(open).show_unindented(ui, content);
}

fn strokes(panel: &mut Panel<'_>, ui: &mut Ui, preset: &mut Preset, keys: &[&'static str]) {
    let numbers = preset.stroke.numbers();
    for key in keys {
        let Some(range) = Range::find("stroke", key) else { continue };
        let Some((_, mut value)) = numbers.iter().find(|(other, _)| other == key).copied() else { continue };
        let name = option_name(key);
        let number = Number::of(range, &name);
        let mut changed = false;
        ui.horizontal(|ui| {
            lock(panel, ui, key, &name);
            let label = number::name(ui, &name, range.doc);
            changed = number::slider(ui, number, &mut value, &label);
            let off = (value - range.default).abs() > 1e-12;
            changed |= number::reset(ui, &name, off, || value = range.default);
        });
        if changed {
            preset.stroke.set_number(key, value);
            keep_lengths(preset, key);
        }
    }
}

/// The shortest stroke is no longer than the longest: whichever is moved takes the other along.
fn keep_lengths(preset: &mut Preset, moved: &str) {
    let stroke = &mut preset.stroke;
    match moved {
        "length_min" => stroke.length_max = stroke.length_max.max(stroke.length_min),
        "length_max" => stroke.length_min = stroke.length_min.min(stroke.length_max),
        _ => {}
    }
}

fn lock(panel: &mut Panel<'_>, ui: &mut Ui, key: &str, name: &str) {
    let locked = panel.state.settings.locked.iter().any(|known| known == key);
    let icon = if locked { "🔒" } else { "🔓" };
    let text = egui::RichText::new(icon).small();
    let button = egui::Button::new(if locked { text } else { text.weak() }).small().frame(false);
    let response = number::named(ui.add(button), &format!("Lock {}", name.to_lowercase()));
    if response.on_hover_text("Keep this number when randomising").clicked() {
        panel.ask(Command::Lock(key.to_owned(), !locked));
    }
}

fn families(ui: &mut Ui, preset: &mut Preset) {
    let names: Vec<String> = preset.families.keys().cloned().collect();
    let mut gone = None;
    for name in &names {
        let Some(family) = preset.families.get_mut(name) else { continue };
        ui.push_id(name, |ui| {
            ui.horizontal(|ui| {
                ui.strong(name);
                let own = family.numbers().len() - 1;
                if own > 0 {
                    ui.weak(format!("{own} of its own"));
                }
                let delete = egui::Button::new("✖").small().frame(false);
                let delete = number::named(ui.add_enabled(names.len() > 1, delete), &format!("Remove family {name}"));
                if delete.on_hover_text("Remove this family").clicked() {
                    gone = Some(name.clone());
                }
            });
            family_numbers(ui, name, family, &preset.stroke);
        });
    }
    if let Some(gone) = gone {
        remove_family(preset, &gone);
    }
    if ui.button("Add a family").on_hover_text("Strokes in another direction").clicked() {
        let name = ('a'..='z').map(String::from).find(|name| !preset.families.contains_key(name));
        if let Some(name) = name {
            preset.families.insert(name, FamilyOptions { angle_deg: 45.0, ..FamilyOptions::default() });
        }
    }
}

fn family_numbers(ui: &mut Ui, name: &str, family: &mut FamilyOptions, common: &tam_gen::preset::StrokeOptions) {
    if let Some(range) = Range::find("families", "angle_deg") {
        let title = format!("Angle of {name}");
        number::row(ui, Number { whole: false, ..Number::of(range, &title) }, &mut family.angle_deg);
    }
    let set = family.numbers();
    for (key, value) in set.iter().filter(|(key, _)| *key != "angle_deg") {
        let Some(range) = Range::find("stroke", key) else { continue };
        let mut value = *value;
        let title = format!("{} of {name}", option_name(key));
        ui.horizontal(|ui| {
            let label = number::name(ui, &title, range.doc);
            if number::slider(ui, Number::of(range, &title), &mut value, &label) {
                family.set_number(key, Some(value));
            }
            // The way back is to what all families share.
            if number::reset(ui, &title, true, || ()) {
                family.set_number(key, None);
            }
        });
    }
    let missing: Vec<_> =
        common.numbers().into_iter().filter(|(key, _)| !set.iter().any(|(own, _)| own == key)).collect();
    let shown = egui::ComboBox::from_id_salt("own").selected_text("Give it its own…").width(130.0).show_ui(ui, |ui| {
        for (key, value) in missing {
            if ui.selectable_label(false, option_name(key)).clicked() {
                family.set_number(key, Some(value));
            }
        }
    });
    number::named(shown.response, &format!("A number of its own for {name}"));
}

/// Takes a family out, and out of the schedule.
fn remove_family(preset: &mut Preset, name: &str) {
    preset.families.remove(name);
    let Some(other) = preset.families.keys().next().cloned() else { return };
    for entry in &mut preset.schedule {
        let left: Vec<&str> = entry.split_whitespace().filter(|family| *family != name).collect();
        *entry = if left.is_empty() { other.clone() } else { left.join(" ") };
    }
}

fn map(ui: &mut Ui, preset: &mut Preset) {
    let powers: Vec<u32> = (6..=12).map(|power| 1 << power).collect();
    let px = |size: u32| format!("{size} px");
    let size_doc = Range::find("map", "size").map_or("", |range| range.doc);
    if number::choice(ui, "Size", size_doc, &mut preset.map.size, &powers, px) {
        preset.map.coarsest = preset.map.coarsest.min(preset.map.size);
    }
    let coarser: Vec<u32> = (3..=12).map(|power| 1 << power).filter(|size| *size <= preset.map.size).collect();
    let coarsest_doc = Range::find("map", "coarsest").map_or("", |range| range.doc);
    number::choice(ui, "Coarsest", coarsest_doc, &mut preset.map.coarsest, &coarser, px);
    tones(ui, preset);
    let measures = [MeasureName::MeanCoverage, MeasureName::NonPaper];
    let word = |measure| match measure {
        MeasureName::MeanCoverage => "Mean coverage".to_owned(),
        MeasureName::NonPaper => "Share of inked texels".to_owned(),
    };
    number::choice(
        ui,
        "Tone is",
        "How the tone of an image is measured",
        &mut preset.map.tone_measure,
        &measures,
        word,
    );
    ui.checkbox(&mut preset.map.tail, "Levels below the coarsest")
        .on_hover_text("Box-filtered levels down to one texel, which some engines want");
}

fn tones(ui: &mut Ui, preset: &mut Preset) {
    let mut count = preset.map.tones.count() as f64;
    let (min, max) = (*tam_gen::preset::TONE_COUNT.start() as f64, *tam_gen::preset::TONE_COUNT.end() as f64);
    let doc = "Columns of the map, evenly spaced between paper and solid ink";
    let number = Number { name: "Tones", doc, unit: "", min, max, default: 6.0, whole: true };
    if number::row(ui, number, &mut count) {
        preset.map.tones = Tones::Count(count.round() as u32);
    }
    let mut own = matches!(preset.map.tones, Tones::List(_));
    if ui.checkbox(&mut own, "Each tone on its own").on_hover_text("Any tones, lightest first").changed() {
        let list = preset.map.tones.list();
        preset.map.tones = if own { Tones::List(list) } else { Tones::Count(list.len() as u32) };
    }
    if let Tones::List(list) = &mut preset.map.tones {
        let last = list.len();
        for column in 0..last {
            let low = if column == 0 { 0.001 } else { list[column - 1] + 0.002 };
            let high = if column + 1 < last { list[column + 1] - 0.002 } else { 1.0 };
            let title = format!("Tone {}", column + 1);
            let default = (column + 1) as f64 / (last + 1) as f64;
            let number = Number {
                name: &title,
                doc: "Darkness: 0 is paper, 1 solid ink",
                unit: "",
                min: low.min(high),
                max: high,
                default,
                whole: false,
            };
            number::row(ui, number, &mut list[column]);
        }
    }
}

fn placement(ui: &mut Ui, preset: &mut Preset) {
    let word = |method: PlacementMethod| match method {
        PlacementMethod::Progressive => "Progressive (ours)".to_owned(),
        PlacementMethod::Praun => "Praun 2001".to_owned(),
        PlacementMethod::Random => "Random".to_owned(),
    };
    let doc = "How strokes find their places; the others are there to compare with";
    number::choice(ui, "Method", doc, &mut preset.placement.method, &PlacementMethod::ALL, word);
    let keys: &[&str] = match preset.placement.method {
        PlacementMethod::Progressive => &["effort"],
        PlacementMethod::Praun => &["candidates_first", "candidates_last"],
        PlacementMethod::Random => &[],
    };
    for key in keys {
        let Some(range) = Range::find("placement", key) else { continue };
        let found = preset.placement.numbers().into_iter().find(|(other, _)| other == key);
        let Some((_, mut value)) = found else { continue };
        let name = option_name(key);
        if number::row(ui, Number::of(range, &name), &mut value) {
            preset.placement.set_number(key, value);
        }
    }
    let mut seed = preset.seed.min(u64::from(u32::MAX)) as f64;
    let doc = "Same preset, same seed, same bytes";
    let number = Number { name: "Seed", doc, unit: "", min: 0.0, max: 10_000.0, default: 1.0, whole: true };
    if number::row(ui, number, &mut seed) {
        preset.seed = seed as u64;
    }
}

fn about(ui: &mut Ui, preset: &mut Preset) {
    let label = ui.label("Description");
    let edit = egui::TextEdit::multiline(&mut preset.description).desired_rows(2).desired_width(f32::INFINITY);
    if ui.add(edit).labelled_by(label.id).changed() {
        preset.description.retain(|c| !c.is_control());
    }
}
