//! Which families each column adds.

use egui::Ui;
use tam_gen::Preset;

pub(super) fn show(ui: &mut Ui, preset: &mut Preset) {
    let columns = preset.map.tones.count();
    let names: Vec<String> = preset.families.keys().cloned().collect();
    ui.label(egui::RichText::new("What each column adds to the lighter one before it").weak().small());
    // Long maps share entries; the schedule then stays as short as it is.
    let shown = preset.schedule.len();
    egui::ScrollArea::horizontal().id_salt("schedule").show(ui, |ui| {
        egui::Grid::new("schedule").spacing([4.0, 2.0]).show(ui, |ui| {
            ui.label("");
            for entry in 0..shown {
                ui.label(egui::RichText::new(columns_of(entry, shown, columns)).small().weak());
            }
            ui.end_row();
            for name in &names {
                ui.label(name);
                for entry in 0..shown {
                    let is_on = preset.schedule[entry].split_whitespace().any(|family| family == name);
                    let mut on = is_on;
                    // An entry always keeps one family.
                    let alone = is_on && preset.schedule[entry].split_whitespace().count() == 1;
                    let response = ui.add_enabled(!alone, egui::Checkbox::without_text(&mut on));
                    let (enabled, title) = (response.enabled(), format!("Family {name} in entry {}", entry + 1));
                    response.widget_info(|| egui::WidgetInfo::selected(egui::Role::CheckBox, enabled, on, &title));
                    if on != is_on {
                        toggle(&mut preset.schedule[entry], name, on);
                    }
                }
                ui.end_row();
            }
        });
    });
    ui.horizontal(|ui| {
        if ui.add_enabled(shown < 64, egui::Button::new("Longer")).on_hover_text("One more entry").clicked() {
            let last = preset.schedule.last().cloned().or_else(|| names.first().cloned());
            preset.schedule.extend(last);
        }
        if ui.add_enabled(shown > 1, egui::Button::new("Shorter")).on_hover_text("One entry fewer").clicked() {
            preset.schedule.pop();
        }
        let fits = shown == columns;
        if ui.add_enabled(!fits, egui::Button::new("One per tone")).clicked() {
            let old = preset.schedule.clone();
            preset.schedule = (0..columns).map(|column| old[column * old.len() / columns].clone()).collect();
        }
    });
}

/// Adds or removes a family; an entry always keeps one.
fn toggle(entry: &mut String, name: &str, on: bool) {
    let mut families: Vec<&str> = entry.split_whitespace().filter(|family| *family != name).collect();
    if on {
        families.push(name);
    }
    if !families.is_empty() {
        *entry = families.join(" ");
    }
}

/// The columns, counted from 1, that an entry serves.
fn columns_of(entry: usize, entries: usize, columns: usize) -> String {
    let served: Vec<usize> = (0..columns).filter(|column| column * entries / columns.max(1) == entry).collect();
    match (served.first(), served.last()) {
        (Some(first), Some(last)) if first < last => format!("{}–{}", first + 1, last + 1),
        (Some(only), _) => format!("{}", only + 1),
        _ => "–".to_owned(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_entry_never_loses_its_last_family() {
        let mut entry = "h v".to_owned();
        toggle(&mut entry, "h", false);
        assert_eq!(entry, "v");
        toggle(&mut entry, "v", false);
        assert_eq!(entry, "v");
        toggle(&mut entry, "h", true);
        assert_eq!(entry, "v h");
    }

    #[test]
    fn columns_are_shared_out_as_the_generator_does() {
        assert_eq!([0, 1, 2].map(|entry| columns_of(entry, 3, 6)), ["1–2", "3–4", "5–6"]);
        assert_eq!([0, 5].map(|entry| columns_of(entry, 6, 6)), ["1", "6"]);
        assert_eq!(columns_of(1, 6, 2), "–");
    }
}
