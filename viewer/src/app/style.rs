//! Colours and sizes of the window: neutral greys, so that paper and ink are judged rightly.

use egui::{Color32, Context, CornerRadius, Stroke, Style, Theme as Shade, ThemePreference, Visuals};

use super::state::{Settings, Theme};

/// The colour of what is chosen: a blue that shows on dark and on light.
const ACCENT: Color32 = Color32::from_rgb(74, 132, 220);

/// Sets up both themes; done once.
pub(crate) fn install(ctx: &Context) {
    // The size of the interface is a setting, with keys of its own.
    ctx.options_mut(|options| options.zoom_with_keyboard = false);
    for shade in [Shade::Dark, Shade::Light] {
        ctx.style_mut_of(shade, |style| dress(style, shade));
    }
}

/// Follows the settings.
pub(crate) fn follow(ctx: &Context, settings: &Settings) {
    let preference = match settings.theme {
        Theme::Dark => ThemePreference::Dark,
        Theme::Light => ThemePreference::Light,
        Theme::System => ThemePreference::System,
    };
    if ctx.options(|options| options.theme_preference) != preference {
        ctx.set_theme(preference);
    }
    if (ctx.zoom_factor() - settings.zoom).abs() > 1e-3 {
        ctx.set_zoom_factor(settings.zoom);
    }
}

fn dress(style: &mut Style, shade: Shade) {
    let mut visuals = match shade {
        Shade::Dark => Visuals::dark(),
        Shade::Light => Visuals::light(),
    };
    let grey = Color32::from_gray;
    match shade {
        Shade::Dark => {
            visuals.panel_fill = grey(37);
            visuals.window_fill = grey(43);
            visuals.extreme_bg_color = grey(26);
            visuals.faint_bg_color = grey(44);
            visuals.selection.bg_fill = ACCENT;
            visuals.selection.stroke = Stroke::new(1.0, grey(250));
            visuals.widgets.noninteractive.fg_stroke.color = grey(190);
            visuals.widgets.inactive.fg_stroke.color = grey(205);
            visuals.widgets.inactive.bg_stroke = Stroke::new(1.0, grey(74));
        }
        Shade::Light => {
            visuals.panel_fill = grey(240);
            visuals.window_fill = grey(246);
            visuals.extreme_bg_color = grey(253);
            visuals.faint_bg_color = grey(232);
            visuals.selection.bg_fill = Color32::from_rgb(120, 170, 240);
            visuals.selection.stroke = Stroke::new(1.0, grey(10));
            visuals.widgets.noninteractive.fg_stroke.color = grey(55);
            visuals.widgets.inactive.fg_stroke.color = grey(40);
            visuals.widgets.inactive.bg_stroke = Stroke::new(1.0, grey(176));
        }
    }
    let corner = CornerRadius::same(4);
    let widgets = &mut visuals.widgets;
    for widget in [&mut widgets.inactive, &mut widgets.hovered, &mut widgets.active, &mut widgets.open] {
        widget.corner_radius = corner;
    }
    style.visuals = visuals;
    style.spacing.item_spacing = egui::vec2(6.0, 4.0);
    style.spacing.button_padding = egui::vec2(6.0, 2.0);
    style.spacing.interact_size.y = 19.0;
    style.interaction.tooltip_delay = 0.4;
}
