//! Search for a command.

use egui::{Key, Modifiers, RichText, TextEdit, Ui};

use super::Panel;
use crate::app::actions::{Action, keys_in_words};
use crate::app::command::Command;
use crate::app::state::Dialog;

/// Commands that are listed at once.
const SHOWN: usize = 12;

pub(super) fn show(panel: &mut Panel<'_>, ui: &mut Ui, typed: &str, actions: &[Action]) {
    ui.set_width(440.0);
    let mut text = typed.to_owned();
    let id = ui.scope_id().with("chosen");
    let mut chosen: usize = ui.data(|data| data.get_temp(id)).unwrap_or(0);
    // Arrows and Enter are for the list, not for the text.
    let (down, up, enter) = ui.input_mut(|input| {
        (
            input.consume_key(Modifiers::NONE, Key::ArrowDown),
            input.consume_key(Modifiers::NONE, Key::ArrowUp),
            input.consume_key(Modifiers::NONE, Key::Enter),
        )
    });
    let edit = ui.add(TextEdit::singleline(&mut text).hint_text("Search for a command").desired_width(f32::INFINITY));
    let enabled = edit.enabled();
    edit.widget_info(|| {
        let mut info = egui::WidgetInfo::text_edit(enabled, typed, &text, "");
        info.label = Some("Search for a command".to_owned());
        info
    });
    edit.request_focus();
    if text != typed {
        chosen = 0;
    }
    let found = search(actions, &text);
    let last = found.len().saturating_sub(1);
    chosen = (chosen + usize::from(down)).saturating_sub(usize::from(up)).min(last);
    let mut run = None;
    egui::ScrollArea::vertical().max_height(360.0).show(ui, |ui| {
        for (index, action) in found.iter().enumerate() {
            let keys = action.shortcut.map_or_else(String::new, |keys| keys_in_words(ui.ctx(), &keys));
            let group = action.group.title();
            let button = egui::Button::new(&action.name)
                .right_text(RichText::new(if keys.is_empty() { group.to_owned() } else { keys }).weak())
                .min_size(egui::vec2(ui.available_width(), 0.0))
                .selected(index == chosen)
                .frame_when_inactive(false);
            let response = ui.add_enabled((panel.can)(action), button);
            if response.clicked() || (enter && index == chosen && (panel.can)(action)) {
                run = Some(action.command.clone());
            }
        }
        if found.is_empty() {
            ui.weak("No command is called that.");
        }
    });
    ui.data_mut(|data| data.insert_temp(id, chosen));
    match run {
        Some(command) => {
            ui.data_mut(|data| data.insert_temp(id, 0_usize));
            panel.ask(Command::ShowDialog(None));
            panel.ask(command);
        }
        None if text != typed => panel.ask(Command::ShowDialog(Some(Dialog::Palette(text)))),
        None => {}
    }
}

/// The actions whose name has all letters that were typed, in their order; those that have them together first.
fn search<'a>(actions: &'a [Action], typed: &str) -> Vec<&'a Action> {
    let wanted = typed.trim().to_lowercase();
    let mut found: Vec<(usize, &Action)> =
        actions.iter().filter_map(|action| Some((distance(&action.name.to_lowercase(), &wanted)?, action))).collect();
    found.sort_by_key(|(distance, _)| *distance);
    found.into_iter().map(|(_, action)| action).take(SHOWN).collect()
}

/// How far a name is from what was typed; `None` if letters are missing.
fn distance(name: &str, wanted: &str) -> Option<usize> {
    if let Some(at) = name.find(wanted) {
        return Some(at);
    }
    let mut letters = name.char_indices();
    let mut first = None;
    let mut last = 0;
    for letter in wanted.chars() {
        let (at, _) = letters.find(|(_, other)| *other == letter)?;
        first.get_or_insert(at);
        last = at;
    }
    Some(1000 + last - first.unwrap_or(0))
}

#[cfg(test)]
mod tests {
    use super::super::super::actions::actions;
    use super::super::super::state::State;
    use super::*;

    #[test]
    fn commands_are_found_by_part_of_their_name_or_by_their_letters() {
        let all = actions(&State::default());
        let first = |typed: &str| search(&all, typed).first().map(|action| action.name.as_str());
        assert_eq!(first("undo"), Some("Undo"));
        assert_eq!(first("wiref"), Some("Wireframe"));
        assert!(first("svpr").is_some_and(|name| name.starts_with("Save p")), "{:?}", first("svpr"));
        assert!(first("xqz").is_none());
        assert_eq!(search(&all, "").len(), SHOWN);
    }
}
