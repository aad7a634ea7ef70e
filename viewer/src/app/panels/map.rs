//! The map's images.

use std::sync::Arc;

use egui::{Align2, Color32, CornerRadius, FontId, Pos2, Rect, Sense, Stroke, Ui, Vec2};

use super::Panel;
use super::map_pictures as pictures;
use super::number::named;
use crate::app::command::Command;
use crate::app::state::{CellView, MapTab};
use crate::app::work::MadeMap;

pub(super) fn show(panel: &mut Panel<'_>, ui: &mut Ui) {
    let Some(made) = panel.results.map.clone() else {
        ui.centered_and_justified(|ui| ui.weak("The map is being made."));
        return;
    };
    let grid = &made.map.grid;
    let mut view = panel.state.transient.map;
    view.level = view.level.min(grid.hand_built - 1);
    view.column = view.column.min(grid.columns() - 1);
    ui.horizontal_wrapped(|ui| {
        for tab in MapTab::ALL {
            if ui.selectable_label(view.tab == tab, tab.label()).clicked() {
                view.tab = tab;
            }
        }
        ui.separator();
        if view.tab != MapTab::Grid {
            choices(ui, &made, &mut view);
        }
        numbers(ui, &made, &view);
    });
    ui.separator();
    match view.tab {
        MapTab::Grid => grid_of_cells(panel, ui, &made, &mut view),
        _ => zoomable(panel, ui, &made, &view),
    }
    if view != panel.state.transient.map {
        panel.ask(Command::ShowCell(view));
    }
}

fn choices(ui: &mut Ui, made: &MadeMap, view: &mut CellView) {
    let grid = &made.map.grid;
    let before = *view;
    let level = |level: usize| format!("{} px", grid.levels[level].size);
    let shown = egui::ComboBox::from_id_salt("level").selected_text(level(view.level)).width(72.0).show_ui(ui, |ui| {
        for other in 0..grid.hand_built {
            ui.selectable_value(&mut view.level, other, level(other));
        }
    });
    named(shown.response, "Level");
    if view.tab != MapTab::StrokeMap {
        let tone = |column: usize| format!("tone {:.2}", grid.tones[column]);
        let shown =
            egui::ComboBox::from_id_salt("column").selected_text(tone(view.column)).width(84.0).show_ui(ui, |ui| {
                for other in 0..grid.columns() {
                    ui.selectable_value(&mut view.column, other, tone(other));
                }
            });
        named(shown.response, "Column");
    }
    if before != *view {
        view.texel = None;
    }
}

/// Tone of the chosen cell: asked for and measured.
fn numbers(ui: &mut Ui, made: &MadeMap, view: &CellView) {
    let grid = &made.map.grid;
    if matches!(view.tab, MapTab::StrokeMap | MapTab::Grid) {
        let what =
            format!("{} tones, {} levels, {} strokes", grid.columns(), grid.hand_built, made.map.strokes.strokes.len());
        ui.weak(what);
        return;
    }
    let measure = tam_gen::preset::ToneMeasure::named(made.map.preset.map.tone_measure);
    let measured = measure.tone(&grid.levels[view.level].cells[view.column]);
    ui.weak(format!("asked {:.4}   measured {measured:.4}", grid.tones[view.column]));
}

fn colours(made: &MadeMap) -> pictures::Colours {
    made.preset.colours.srgb().unwrap_or(([255; 3], [0; 3]))
}

fn version(made: &Arc<MadeMap>) -> usize {
    Arc::as_ptr(made) as usize
}

/// All cells: the finest of each tone in a row, its coarser ones beside each other under it, as large as they fit.
fn grid_of_cells(panel: &mut Panel<'_>, ui: &mut Ui, made: &Arc<MadeMap>, view: &mut CellView) {
    let grid = &made.map.grid;
    let measure = tam_gen::preset::ToneMeasure::named(made.map.preset.map.tone_measure);
    egui::ScrollArea::both().auto_shrink(false).show(ui, |ui| {
        let gap = 6.0;
        let label = 14.0;
        let columns = grid.columns() as f32;
        let by_width = (ui.available_width() - gap * columns) / columns;
        let by_height = (ui.available_height() - 2.0 * gap - label) / 1.5;
        let largest = by_width.min(by_height).clamp(48.0, grid.levels[0].size as f32 * 2.0);
        let size = egui::vec2((largest + gap) * columns, largest * 1.5 + 2.0 * gap + label);
        let (area, _) = ui.allocate_exact_size(size, Sense::hover());
        for column in 0..grid.columns() {
            let x = area.left() + column as f32 * (largest + gap);
            let finest = Pos2::new(x, area.top() + label);
            let mut next = finest + egui::vec2(0.0, largest + gap);
            ui.painter().text(
                Pos2::new(x + largest * 0.5, area.top()),
                Align2::CENTER_TOP,
                format!("{:.3}", grid.tones[column]),
                FontId::proportional(11.0),
                ui.visuals().weak_text_color(),
            );
            for level in 0..grid.hand_built {
                // Gaps between the coarser ones come out of their sides, so that they end where the finest does.
                let side = largest / (1 << level) as f32;
                let rect = if level == 0 {
                    Rect::from_min_size(finest, Vec2::splat(side))
                } else {
                    let rect = Rect::from_min_size(next, Vec2::splat((side - 2.0).max(4.0)));
                    next.x += side;
                    rect
                };
                let tone = measure.tone(&grid.levels[level].cells[column]);
                cell(panel, ui, made, (level, column), rect, tone, view);
            }
        }
    });
}

fn cell(
    panel: &mut Panel<'_>,
    ui: &mut Ui,
    made: &Arc<MadeMap>,
    (level, column): (usize, usize),
    rect: Rect,
    tone: f64,
    view: &mut CellView,
) {
    let grid = &made.map.grid;
    let name = format!("cell {level} {column}");
    let colours = colours(made);
    let texture =
        panel.textures.sharp(ui.ctx(), &name, version(made), || pictures::cell(&grid.levels[level], column, colours));
    let uv = Rect::from_min_max(Pos2::ZERO, Pos2::new(1.0, 1.0));
    ui.painter().image(texture.id(), rect, uv, Color32::WHITE);
    let response = ui.interact(rect, ui.scope_id().with((level, column)), Sense::click());
    let title = format!("Cell of tone {:.2} at {} px", grid.tones[column], grid.levels[level].size);
    let response = named(response, &title);
    let chosen = view.level == level && view.column == column;
    if chosen || response.hovered() {
        let width = if chosen { 2.0 } else { 1.0 };
        let stroke = Stroke::new(width, ui.visuals().selection.bg_fill);
        ui.painter().rect_stroke(rect, CornerRadius::ZERO, stroke, egui::StrokeKind::Outside);
    }
    if response.clicked() {
        *view = CellView { tab: view.tab, level, column, texel: None };
    }
    if response.double_clicked() {
        view.tab = MapTab::Cell;
    }
    response.on_hover_text(format!(
        "{title}\nasked {:.4}, measured {tone:.4}\ndouble click: see its texels",
        grid.tones[column]
    ));
}

/// One picture, moved by dragging and enlarged by the wheel.
fn zoomable(panel: &mut Panel<'_>, ui: &mut Ui, made: &Arc<MadeMap>, view: &CellView) {
    let grid = &made.map.grid;
    let (level, column) = (view.level, view.column);
    let own = &grid.levels[level];
    let colours = colours(made);
    let offending = offending_texels(panel, level, column);
    let name = format!("map {:?}", view.tab);
    let salt = version(made) ^ (level * 131 + column * 7919 + offending.len() * 104_729);
    let texture = panel.textures.sharp(ui.ctx(), &name, salt, || match view.tab {
        MapTab::Tiling => pictures::tiling(own, column, colours),
        MapTab::Nesting => pictures::nesting(grid, level, column),
        MapTab::StrokeMap => pictures::stroke_map(&made.map, level),
        _ if offending.is_empty() => pictures::cell(own, column, colours),
        _ => pictures::offending(own, column, &offending),
    });
    let rect = ui.available_rect_before_wrap();
    let response = ui.interact(rect, ui.scope_id().with(&name), Sense::click_and_drag());
    let response = named(response, &format!("{} of the map", view.tab.label()));
    let size = texture.size_vec2();
    let id = ui.scope_id().with("zoom").with(&name);
    // Where the picture is, in its own pixels: what is in the middle, and points per pixel; 0: all of it.
    let whole = (rect.width() / size.x).min(rect.height() / size.y);
    let (mut middle, mut scale): (Vec2, f32) = ui.data(|data| data.get_temp(id)).unwrap_or((size * 0.5, 0.0));
    if scale <= whole || response.double_clicked() {
        (middle, scale) = (size * 0.5, whole);
    }
    if let Some(pointer) = response.hover_pos() {
        let turned = ui.input(|input| input.smooth_scroll_delta().y);
        let zoomed = (scale * (turned * 0.005).exp()).clamp(whole, 64.0);
        let under = (pointer - rect.center()) / scale + middle;
        middle = under - (pointer - rect.center()) / zoomed;
        scale = zoomed;
    }
    middle -= response.drag_delta() / scale;
    if let Some(texel) = view.texel
        && ui.data(|data| data.get_temp::<u32>(id.with("shown"))) != Some(texel)
    {
        let side = own.size;
        middle = egui::vec2((texel % side) as f32 + 0.5, (texel / side) as f32 + 0.5);
        scale = scale.max(12.0);
        ui.data_mut(|data| data.insert_temp(id.with("shown"), texel));
    }
    ui.data_mut(|data| data.insert_temp(id, (middle, scale)));
    let painter = ui.painter_at(rect);
    painter.rect_filled(rect, CornerRadius::ZERO, ui.visuals().extreme_bg_color);
    let shown = Rect::from_min_size(rect.center() - middle * scale, size * scale);
    let uv = Rect::from_min_max(Pos2::ZERO, Pos2::new(1.0, 1.0));
    painter.image(texture.id(), shown, uv, Color32::WHITE);
    if view.tab == MapTab::Tiling {
        let line = Stroke::new(1.0, ui.visuals().selection.bg_fill.gamma_multiply(0.25));
        for part in 1..3 {
            let at = shown.lerp_inside(Vec2::splat(part as f32 / 3.0));
            painter.vline(at.x, shown.y_range(), line);
            painter.hline(shown.x_range(), at.y, line);
        }
    }
    if view.tab == MapTab::Nesting {
        legend(ui, &painter, rect, grid.columns());
    }
    texel_under_mouse(ui, &response, made, view, shown, scale);
}

fn offending_texels(panel: &Panel<'_>, level: usize, column: usize) -> Vec<u32> {
    let Some(report) = panel.results.current_report() else { return Vec::new() };
    let cells = report.findings.iter().flat_map(|finding| &finding.cells);
    let here = cells.filter(|cell| cell.level == level && cell.column == column);
    here.flat_map(|cell| cell.texels.iter().copied()).collect()
}

fn legend(ui: &Ui, painter: &egui::Painter, rect: Rect, columns: usize) {
    let shown = columns.min(12);
    let width = 16.0;
    let ground =
        Rect::from_min_size(rect.left_top() + egui::vec2(8.0, 8.0), egui::vec2(width * shown as f32 + 190.0, 22.0));
    painter.rect_filled(ground, CornerRadius::same(4), ui.visuals().panel_fill.gamma_multiply(0.88));
    for part in 0..shown {
        let column = part * columns / shown;
        let at = ground.left_top() + egui::vec2(6.0 + width * part as f32, 5.0);
        let colour = pictures::column_colour(column, columns);
        painter.rect_filled(Rect::from_min_size(at, egui::vec2(width - 2.0, 12.0)), CornerRadius::same(2), colour);
    }
    painter.text(
        ground.right_center() - egui::vec2(6.0, 0.0),
        Align2::RIGHT_CENTER,
        "first inked by; full: coarser too",
        FontId::proportional(11.5),
        ui.visuals().text_color(),
    );
}

fn texel_under_mouse(ui: &Ui, response: &egui::Response, made: &MadeMap, view: &CellView, shown: Rect, scale: f32) {
    let Some(pointer) = response.hover_pos() else { return };
    let at = (pointer - shown.min) / scale;
    let side = made.map.grid.levels[view.level].size as usize;
    if at.x < 0.0 || at.y < 0.0 || !shown.contains(pointer) {
        return;
    }
    let (x, y) = (at.x as usize % side, at.y as usize % side);
    let text = match view.tab {
        MapTab::StrokeMap => {
            let threshold = made.map.stroke_map.levels[view.level].threshold[y * side + x];
            format!("{x}, {y}: inked from {:.3}", f64::from(threshold) / 255.0)
        }
        _ => {
            let ink = made.map.grid.levels[view.level].cells[view.column][y * side + x];
            format!("{x}, {y}: ink {:.3}", f64::from(ink) / 255.0)
        }
    };
    let painter = ui.painter_at(response.rect);
    let at = response.rect.right_bottom() - egui::vec2(8.0, 8.0);
    painter.text(at, Align2::RIGHT_BOTTOM, text, FontId::monospace(11.5), ui.visuals().weak_text_color());
}
