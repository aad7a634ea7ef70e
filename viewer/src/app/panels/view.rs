//! The mesh in its material.

mod toolbar;

use egui::emath::GuiRounding as _;
use egui::{Align2, Color32, CornerRadius, CursorIcon, FontId, Key, PointerButton, Pos2, Rect, Sense, Stroke, Ui};
use glam::{DVec2, DVec3};

use super::Panel;
use super::number::named;
use super::orbit::{self, Drag};
use crate::Camera;
use crate::app::command::Command;
use crate::app::pick::{Ray, pick_placed};
use crate::app::state::{Compare, Look, Motion, ObjectRef, Tool};
use crate::surface::Guide;
use toolbar::{short_method, toolbar};

/// What the view found out about itself.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct ViewReport {
    /// Its size in pixels; 0 where it is hidden.
    pub size_px: [u32; 2],
    /// Whether something in it is being dragged.
    pub dragged: bool,
    /// The guide that is being drawn.
    guide: Vec<DVec3>,
    /// What the camera turns about while it is dragged.
    pivot: Option<DVec3>,
}

impl ViewReport {
    /// Nothing of the view is shown until it says so.
    pub(crate) fn hide(&mut self) {
        (self.size_px, self.dragged) = ([0; 2], false);
    }
}

/// Radius of the ball on which the light's handle moves, as a share of half the view's smaller side.
const BALL: f32 = 0.86;

pub(super) fn show(panel: &mut Panel<'_>, ui: &mut Ui) {
    toolbar(panel, ui);
    let per_point = ui.pixels_per_point();
    // Pixels of the picture are those of the screen.
    let rect = ui.available_rect_before_wrap().round_to_pixels(per_point);
    let response = ui.interact(rect, ui.scope_id().with("picture"), Sense::click_and_drag());
    let response = {
        let enabled = response.enabled();
        response.widget_info(|| egui::WidgetInfo::labeled(egui::Role::Image, enabled, "Picture of the mesh"));
        response
    };
    panel.view.size_px = [rect.width(), rect.height()].map(|side| (side * per_point).round().max(0.0) as u32);
    picture(panel, ui, rect);
    let handled = wipe(panel, ui, rect) | light_handle(panel, ui, rect);
    panel.view.dragged = handled || response.dragged();
    if !handled {
        match panel.state.transient.tool {
            Tool::Guide if response.dragged_by(PointerButton::Primary) || !panel.view.guide.is_empty() => {
                draw_guide(panel, ui, rect, &response);
            }
            _ => drags(panel, ui, &response, rect),
        }
    }
    if !handled && response.clicked() && panel.state.transient.tool == Tool::Navigate {
        choose_under_pointer(panel, rect, &response);
    }
    if response.hovered() {
        let scroll =
            ui.input(|input| f64::from(input.smooth_scroll_delta().y) + 250.0 * f64::from(input.zoom_delta() - 1.0));
        if scroll != 0.0 {
            let camera = panel.state.camera;
            // A camera that goes round comes nearer to what it goes around.
            let pointer = response.hover_pos().filter(|_| !goes_round(panel));
            let under = pointer.map(|pointer| {
                let ray = ray_at(&camera, rect, pointer);
                picked(panel, &ray).map_or_else(|| orbit::on_target_plane(&camera, &ray), |(_, point)| point)
            });
            panel.ask(Command::SetCamera(orbit::zoomed(&camera, scroll, under)));
        }
        if panel.state.transient.tool == Tool::Guide {
            ui.set_cursor_icon(CursorIcon::Crosshair);
        }
    }
    guides(panel, ui, rect);
    overlay(panel, ui, rect);
    response.context_menu(|ui| {
        if ui.button("Show the whole mesh").clicked() {
            panel.ask(Command::FrameMesh);
        }
        if ui.button("Save picture…").clicked() {
            panel.ask(Command::SavePicture(None));
        }
    });
}

fn picture(panel: &mut Panel<'_>, ui: &mut Ui, rect: Rect) {
    let painter = ui.painter_at(rect);
    let [r, g, b] = panel.state.document.paper_colour();
    painter.rect_filled(rect, CornerRadius::ZERO, Color32::from(egui::Rgba::from_rgb(r, g, b)));
    if let Some(shown) = &panel.results.picture {
        let texture = panel.textures.of(&shown.canvas);
        let uv = Rect::from_min_max(Pos2::ZERO, Pos2::new(1.0, 1.0));
        // A picture of another size is shown whole until the next is there.
        let [width, height] = shown.canvas.size_px().map(|side| side as f32);
        let size = egui::vec2(width, height);
        let scale = (rect.width() / size.x).min(rect.height() / size.y);
        painter.image(texture, Rect::from_center_size(rect.center(), size * scale), uv, Color32::WHITE);
    }
}

/// The line between two sides, which can be dragged; whether it is.
fn wipe(panel: &mut Panel<'_>, ui: &mut Ui, rect: Rect) -> bool {
    let Some(compare) = panel.state.document.compare.clone() else { return false };
    let x = rect.left() + rect.width() * compare.split as f32;
    let line = Rect::from_x_y_ranges(x - 6.0..=x + 6.0, rect.y_range());
    let response =
        ui.interact(line, ui.scope_id().with("wipe"), Sense::drag()).on_hover_cursor(CursorIcon::ResizeHorizontal);
    let response = named(response, "Wipe between A and B");
    let painter = ui.painter_at(rect);
    let colour = ui.visuals().selection.bg_fill;
    painter.vline(x, rect.y_range(), Stroke::new(2.0, colour));
    painter.circle_filled(Pos2::new(x, rect.center().y), 7.0, colour);
    let text = |at: Pos2, align: Align2, text: &str| tag(&painter, ui, at, align, text);
    let names = |look: &Look, name: &str| format!("{} · {}", short_method(look.params.method), name);
    let own = panel.state.preset_name();
    let other = compare.preset.as_ref().map_or(own.as_str(), |(name, _)| name.as_str());
    text(
        Pos2::new(x - 12.0, rect.bottom() - 10.0),
        Align2::RIGHT_BOTTOM,
        &format!("A  {}", names(&panel.state.document.look, &own)),
    );
    text(
        Pos2::new(x + 12.0, rect.bottom() - 10.0),
        Align2::LEFT_BOTTOM,
        &format!("B  {}", names(&compare.look, other)),
    );
    if response.dragged()
        && let Some(pointer) = response.interact_pointer_pos()
    {
        let split = f64::from(((pointer.x - rect.left()) / rect.width()).clamp(0.02, 0.98));
        panel.ask(Command::SetCompare(Some(Box::new(Compare { split, ..compare }))));
    }
    response.dragged()
}

/// Words on a ground of their own, legible over any picture.
fn tag(painter: &egui::Painter, ui: &Ui, at: Pos2, align: Align2, text: &str) {
    let visuals = ui.visuals();
    let galley = painter.layout_no_wrap(text.to_owned(), FontId::proportional(12.0), visuals.strong_text_color());
    let rect = align.anchor_size(at, galley.size());
    painter.rect_filled(
        rect.expand2(egui::vec2(6.0, 3.0)),
        CornerRadius::same(4),
        visuals.panel_fill.gamma_multiply(0.86),
    );
    painter.galley(rect.min, galley, visuals.strong_text_color());
}

/// The sun that stands for the first light; whether it is dragged.
fn light_handle(panel: &mut Panel<'_>, ui: &mut Ui, rect: Rect) -> bool {
    if !panel.state.settings.light_handle {
        return false;
    }
    let Some(light) = panel.state.document.lights.lights.first().copied() else { return false };
    let camera = sight(panel);
    let towards = orbit::towards(&light, &camera);
    let [right, up] = camera.axes();
    let radius = rect.width().min(rect.height()) * 0.5 * BALL;
    let seen = egui::vec2(towards.dot(right) as f32, -towards.dot(up) as f32);
    let behind = towards.dot(camera.forward()) > 0.0;
    let at = rect.center() + seen * radius;
    let area = Rect::from_center_size(at, egui::Vec2::splat(26.0));
    let response = ui.interact(area, ui.scope_id().with("light"), Sense::drag()).on_hover_cursor(CursorIcon::Grab);
    let response = named(response, "Light");
    let painter = ui.painter_at(rect);
    let core = if behind { Color32::from_rgb(150, 130, 90) } else { Color32::from_rgb(255, 196, 60) };
    let rim = Stroke::new(1.5, Color32::from_rgb(96, 68, 10));
    for ray in 0..8 {
        let angle = ray as f32 * std::f32::consts::TAU / 8.0;
        let out = egui::vec2(angle.cos(), angle.sin());
        painter.line_segment([at + out * 9.0, at + out * 12.5], Stroke::new(2.0, core));
    }
    painter.circle(at, 6.0, core, rim);
    if response.hovered() || response.dragged() {
        painter.circle_stroke(rect.center(), radius, Stroke::new(1.0, core.gamma_multiply(0.35)));
    }
    if response.dragged()
        && let Some(pointer) = response.interact_pointer_pos()
    {
        let offset = (pointer - rect.center()) / radius;
        let direction = orbit::on_ball(&camera, DVec2::new(f64::from(offset.x), f64::from(-offset.y)), behind);
        set_first_light(panel, orbit::turned(&light, &camera, direction));
    }
    response.on_hover_text("Drag to move the light; Shift or the right button drags it from anywhere").dragged()
}

fn set_first_light(panel: &mut Panel<'_>, light: crate::Light) {
    let mut lights = panel.state.document.lights.clone();
    if let Some(first) = lights.lights.first_mut() {
        *first = light;
        panel.ask(Command::SetLights(lights));
    }
}

fn drags(panel: &mut Panel<'_>, ui: &Ui, response: &egui::Response, rect: Rect) {
    if response.drag_started() {
        let pressed = ui.input(|input| input.pointer.press_origin());
        let ray = pressed.map(|pressed| ray_at(&sight(panel), rect, pressed));
        panel.view.pivot = ray.and_then(|ray| picked(panel, &ray)).map(|(_, point)| point);
    }
    let by = response.drag_delta();
    if by == egui::Vec2::ZERO {
        return;
    }
    let held = ui.input(|input| input.modifiers);
    let buttons = [PointerButton::Primary, PointerButton::Secondary, PointerButton::Middle];
    let Some(button) = buttons.into_iter().find(|button| response.dragged_by(*button)) else { return };
    match orbit::meaning(panel.state.settings.navigation, button, held) {
        Some(Drag::Light) => {
            if let Some(light) = panel.state.document.lights.lights.first() {
                set_first_light(panel, orbit::light_dragged(light, &sight(panel), by));
            }
        }
        Some(drag) => {
            let (camera, pivot) = (&panel.state.camera, panel.view.pivot);
            panel.ask(Command::SetCamera(orbit::dragged(camera, drag, by, rect.height(), pivot)));
        }
        None => {}
    }
}

/// Whether the camera goes round by itself.
fn goes_round(panel: &Panel<'_>) -> bool {
    panel.state.transient.motion == Some(Motion::Orbit)
}

/// The camera of what is seen: it goes round where that plays.
fn sight(panel: &Panel<'_>) -> Camera {
    let shown = panel.results.picture.as_ref().filter(|_| goes_round(panel));
    shown.map_or(panel.state.camera, |shown| shown.camera)
}

/// The line of sight through a place of the view.
fn ray_at(camera: &Camera, rect: Rect, at: Pos2) -> Ray {
    let offset = (at - rect.center()) / (rect.size() * 0.5);
    let at = DVec2::new(f64::from(offset.x), f64::from(-offset.y));
    Ray::through(camera, at, f64::from(rect.width() / rect.height()))
}

/// The object that is seen first along a line of sight, and where it is met.
fn picked(panel: &Panel<'_>, ray: &Ray) -> Option<(usize, DVec3)> {
    let hit = |(index, object): (usize, ObjectRef<'_>)| {
        let loaded = panel.results.meshes.iter().find(|loaded| loaded.source == *object.mesh)?;
        let world = object.standing.world_from_mesh();
        let (point, distance) = pick_placed(&loaded.mesh, world, ray).filter(|_| object.standing.visible)?;
        Some((index, point, distance))
    };
    let hits = panel.state.document.objects().enumerate().filter_map(hit);
    hits.min_by(|a, b| a.2.total_cmp(&b.2)).map(|(index, point, _)| (index, point))
}

/// Chooses the object under the mouse, where there is more than one.
fn choose_under_pointer(panel: &mut Panel<'_>, rect: Rect, response: &egui::Response) {
    if panel.state.document.object_count() == 1 {
        return;
    }
    let ray = response.interact_pointer_pos().map(|pointer| ray_at(&sight(panel), rect, pointer));
    if let Some((index, _)) = ray.and_then(|ray| picked(panel, &ray)) {
        panel.ask(Command::Choose(index));
    }
}

/// Collects the points of a guide under the mouse.
fn draw_guide(panel: &mut Panel<'_>, ui: &Ui, rect: Rect, response: &egui::Response) {
    if ui.input(|input| input.key_pressed(Key::Escape)) {
        panel.view.guide.clear();
    } else if response.dragged() {
        let Some(mesh) = panel.results.mesh.as_ref() else { return };
        let Some(pointer) = response.interact_pointer_pos() else { return };
        // Guides are kept where the mesh is, not where it stands.
        let world = panel.state.document.standing.world_from_mesh();
        let camera = sight(panel);
        let ray = ray_at(&camera, rect, pointer);
        let point = pick_placed(&mesh.mesh, world, &ray).map(|(point, _)| world.inverse().transform_point3(point));
        let step = camera.pixel_at_1(rect.height() as u32) * camera.distance * 6.0;
        if let Some(point) =
            point.filter(|point| panel.view.guide.last().is_none_or(|last| last.distance(*point) > step))
        {
            panel.view.guide.push(point);
        }
    } else {
        let points = std::mem::take(&mut panel.view.guide);
        if points.len() >= 2 {
            let mut look = panel.state.document.look.clone();
            look.guides.push(Guide { points });
            panel.ask(Command::SetLook(Box::new(look)));
        }
    }
}

fn guides(panel: &Panel<'_>, ui: &Ui, rect: Rect) {
    let drawn = &panel.state.document.look.guides;
    if panel.state.transient.tool != Tool::Guide && panel.view.guide.is_empty() {
        return;
    }
    let camera = sight(panel);
    let clip = camera.clip_from_world([rect.width().max(1.0) as u32, rect.height().max(1.0) as u32], 4.0);
    let world = panel.state.document.standing.world_from_mesh();
    let place = |point: &DVec3| {
        let at = clip.project_point3(world.transform_point3(*point));
        rect.center() + egui::vec2(at.x as f32, -at.y as f32) * rect.size() * 0.5
    };
    let painter = ui.painter_at(rect);
    let line = |points: &[DVec3], colour| {
        painter.add(egui::Shape::line(points.iter().map(place).collect(), Stroke::new(2.5, colour)));
    };
    drawn.iter().for_each(|guide| line(&guide.points, Color32::from_rgb(230, 80, 50)));
    line(&panel.view.guide, Color32::from_rgb(255, 160, 60));
    let text = if drawn.is_empty() {
        "Draw on the mesh: strokes follow your lines.".to_owned()
    } else {
        format!("{} drawn; Ctrl+Z takes the last one back", crate::app::words::counted(drawn.len(), "guide"))
    };
    tag(&painter, ui, rect.center_top() + egui::vec2(0.0, 12.0), Align2::CENTER_TOP, &text);
}

/// What is missing or under way, over the picture.
fn overlay(panel: &Panel<'_>, ui: &Ui, rect: Rect) {
    let painter = ui.painter_at(rect);
    let results = panel.results;
    let message = |text: &str| tag(&painter, ui, rect.center(), Align2::CENTER_CENTER, text);
    if let Some(problem) = &results.picture_problem {
        message(problem);
    } else if results.picture.is_none() {
        let text = match (&results.map, &results.mesh) {
            (None, _) => "Making the map…",
            (_, None) => "Loading the mesh…",
            _ => "Drawing the first picture…",
        };
        message(text);
    }
    let slow = results.running.iter().find(|(name, _)| matches!(*name, "Surface" | "Mesh"));
    if let Some((name, part)) = slow {
        let what = if *name == "Mesh" { "Loading the mesh" } else { "Laying strokes on the surface" };
        let bar = Rect::from_min_size(rect.left_bottom() + egui::vec2(12.0, -26.0), egui::vec2(210.0, 16.0));
        painter.rect_filled(bar.expand(3.0), CornerRadius::same(4), ui.visuals().panel_fill.gamma_multiply(0.86));
        let mut done = bar;
        done.set_width(bar.width() * part.clamp(0.0, 1.0));
        painter.rect_filled(done, CornerRadius::same(3), ui.visuals().selection.bg_fill.gamma_multiply(0.6));
        painter.text(
            bar.left_center() + egui::vec2(6.0, 0.0),
            Align2::LEFT_CENTER,
            format!("{what}  {:.0} %", part * 100.0),
            FontId::proportional(11.5),
            ui.visuals().strong_text_color(),
        );
        ui.ctx().request_repaint_after(std::time::Duration::from_millis(100));
    }
}
