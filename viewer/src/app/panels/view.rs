//! The mesh in its material.

use egui::emath::GuiRounding as _;
use egui::{Align2, Color32, CornerRadius, CursorIcon, FontId, Key, PointerButton, Pos2, Rect, Sense, Stroke, Ui};
use glam::{DVec2, DVec3};

use super::Panel;
use super::number::named;
use super::orbit::{self, Drag};
use crate::app::actions::{debug_label, mapping_label, method_label};
use crate::app::command::Command;
use crate::app::pick::{Ray, pick_placed};
use crate::app::state::{Compare, Look, Motion, ObjectRef, PresetSource, Tool};
use crate::params::DebugView;
use crate::surface::Guide;
use crate::{Camera, Mapping, Method};

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
            let pointer = response.hover_pos().unwrap_or(rect.center());
            let ray = ray_at(&camera, rect, pointer);
            let under = picked(panel, &ray).map_or_else(|| orbit::on_target_plane(&camera, &ray), |(_, point)| point);
            panel.ask(Command::SetCamera(orbit::zoomed(&camera, scroll, Some(under))));
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

/// Methods and mappings as switches, and what else is at hand.
fn toolbar(panel: &mut Panel<'_>, ui: &mut Ui) {
    let look = &panel.state.document.look;
    let params = look.params;
    let mut asked = Vec::new();
    let mut set = |change: &dyn Fn(&mut crate::RenderParams)| {
        let mut look: Look = look.clone();
        change(&mut look.params);
        asked.push(Command::SetLook(Box::new(look)));
    };
    ui.horizontal_wrapped(|ui| {
        ui.spacing_mut().item_spacing.x = 3.0;
        for (number, method) in Method::ALL.into_iter().enumerate() {
            let button = ui.selectable_label(params.method == method, short_method(method));
            if button.on_hover_text(format!("{} ({})", method_label(method), number + 1)).clicked() {
                set(&|params| params.method = method);
            }
        }
        ui.separator();
        ui.add_enabled_ui(params.method.takes_mapping(), |ui| {
            let combo = egui::ComboBox::from_id_salt("mapping").selected_text(mapping_label(params.mapping));
            let shown = combo.width(128.0).show_ui(ui, |ui| {
                for (number, mapping) in Mapping::ALL.into_iter().enumerate() {
                    let text = format!("{}   Alt+{}", mapping_label(mapping), number + 1);
                    if ui.selectable_label(params.mapping == mapping, text).clicked() {
                        set(&|params| params.mapping = mapping);
                    }
                }
            });
            named(shown.response, "Mapping").on_hover_text("How strokes lie on the surface");
        });
        let debug = params.debug.map_or("Inspect", debug_label);
        let combo = egui::ComboBox::from_id_salt("inspect").selected_text(debug).width(96.0);
        let shown = combo.show_ui(ui, |ui| {
            if ui.selectable_label(params.debug.is_none(), "The picture").clicked() {
                set(&|params| params.debug = None);
            }
            for view in DebugView::ALL {
                let entry = ui.selectable_label(params.debug == Some(view), debug_label(view));
                if entry.on_hover_text(view.description()).clicked() {
                    set(&|params| params.debug = Some(view));
                }
            }
        });
        named(shown.response, "Inspect").on_hover_text("Show what the shader decides instead of strokes");
    });
    panel.commands.append(&mut asked);
    ui.horizontal_wrapped(|ui| {
        ui.spacing_mut().item_spacing.x = 3.0;
        compare_controls(panel, ui);
        ui.separator();
        play_controls(panel, ui);
        ui.separator();
        let guiding = panel.state.transient.tool == Tool::Guide;
        let button = ui.selectable_label(guiding, "Guides");
        if button.on_hover_text("Draw strokes on the mesh that the others follow (G)").clicked() {
            panel.ask(Command::SetTool(if guiding { Tool::Navigate } else { Tool::Guide }));
        }
        let wired = params.wireframe.is_some();
        if ui.selectable_label(wired, "Wires").on_hover_text("Show the triangles' edges (W)").clicked() {
            let mut look = panel.state.document.look.clone();
            look.params.wireframe = (!wired).then_some(1.0);
            panel.ask(Command::SetLook(Box::new(look)));
        }
        if ui.button("Whole").on_hover_text("Show the whole mesh (F)").clicked() {
            panel.ask(Command::FrameMesh);
        }
    });
    ui.add_space(2.0);
}

fn short_method(method: Method) -> &'static str {
    match method {
        Method::Phong => "Phong",
        Method::SixWay => "Six-way",
        Method::FaceFrame => "Face frames",
        Method::StrokeMap => "Stroke map",
        Method::Halftone => "Halftone",
        Method::FineTone => "Fine tones",
        Method::Stripes => "Stripes",
    }
}

fn compare_controls(panel: &mut Panel<'_>, ui: &mut Ui) {
    let compare = panel.state.document.compare.clone();
    let button = ui.selectable_label(compare.is_some(), "A | B");
    if button.on_hover_text("Wipe between two methods or presets (C)").clicked() {
        let started = Compare { look: panel.state.document.look.clone(), preset: None, split: 0.5 };
        let mut started = Box::new(started);
        started.look.params.method =
            if started.look.params.method == Method::Stripes { Method::SixWay } else { Method::Stripes };
        panel.ask(Command::SetCompare(compare.is_none().then_some(started)));
    }
    let Some(mut compare) = compare else { return };
    let before = compare.clone();
    let combo = egui::ComboBox::from_id_salt("other method").selected_text(short_method(compare.look.params.method));
    let shown = combo.width(86.0).show_ui(ui, |ui| {
        for method in Method::ALL {
            ui.selectable_value(&mut compare.look.params.method, method, method_label(method));
        }
    });
    named(shown.response, "Method of B");
    if compare.look.params.method.takes_mapping() {
        let combo =
            egui::ComboBox::from_id_salt("other mapping").selected_text(mapping_label(compare.look.params.mapping));
        let shown = combo.width(96.0).show_ui(ui, |ui| {
            for mapping in Mapping::ALL {
                ui.selectable_value(&mut compare.look.params.mapping, mapping, mapping_label(mapping));
            }
        });
        named(shown.response, "Mapping of B");
    }
    let name = compare.preset.as_ref().map_or("same preset", |(name, _)| name.as_str()).to_owned();
    let shown = egui::ComboBox::from_id_salt("other preset").selected_text(name).width(96.0).show_ui(ui, |ui| {
        if ui.selectable_label(compare.preset.is_none(), "same preset").clicked() {
            compare.preset = None;
        }
        for (name, _) in tam_gen::Preset::embedded() {
            let chosen = compare.preset.as_ref().is_some_and(|(other, _)| other == name);
            if ui.selectable_label(chosen, *name).clicked()
                && let Some(Ok(preset)) = tam_gen::Preset::named(name)
            {
                compare.preset = Some(((*name).to_owned(), preset));
            }
        }
        for path in &panel.state.settings.recent_presets {
            let name = PresetSource::File(path.clone()).name();
            let chosen = compare.preset.as_ref().is_some_and(|(other, _)| *other == name);
            if ui.selectable_label(chosen, &name).on_hover_text(path.display().to_string()).clicked() {
                match tam_gen::Preset::load(path) {
                    Ok(preset) => compare.preset = Some((name, preset)),
                    // What is wrong with it is told where it is opened.
                    Err(_) => panel.commands.push(Command::OpenPreset(Some(path.clone()))),
                }
            }
        }
    });
    named(shown.response, "Preset of B");
    if compare != before {
        panel.ask(Command::SetCompare(Some(Box::new(compare))));
    }
}

fn play_controls(panel: &mut Panel<'_>, ui: &mut Ui) {
    use crate::mesh::deform::Deform;
    let playing = panel.state.transient.motion;
    let button = ui.selectable_label(playing.is_some(), if playing.is_some() { "⏸" } else { "▶" });
    if named(button, "Play").on_hover_text("Play or stop (Space)").clicked() {
        panel.ask(Command::Play(if playing.is_some() { None } else { Some(Motion::Orbit) }));
    }
    let label = |motion: Motion| match motion {
        Motion::Orbit => "Camera".to_owned(),
        Motion::Light => "Light".to_owned(),
        Motion::Animation => "Animation".to_owned(),
        Motion::Deform(deform) => {
            let name = deform.name();
            name[..1].to_uppercase() + &name[1..]
        }
    };
    let shown = egui::ComboBox::from_id_salt("motion")
        .selected_text(playing.map_or_else(|| "Turntable".to_owned(), label))
        .width(84.0)
        .show_ui(ui, |ui| {
            let animated = panel.results.mesh.as_ref().is_some_and(|mesh| mesh.mesh.animation.is_some());
            let motions = [Motion::Orbit, Motion::Light].into_iter().chain(Deform::ALL.map(Motion::Deform));
            for motion in motions.chain(animated.then_some(Motion::Animation)) {
                if ui.selectable_label(playing == Some(motion), label(motion)).clicked() {
                    panel.commands.push(Command::Play(Some(motion)));
                }
            }
        });
    named(shown.response, "What plays");
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
    let camera = panel.state.camera;
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
        let ray = pressed.map(|pressed| ray_at(&panel.state.camera, rect, pressed));
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
                set_first_light(panel, orbit::light_dragged(light, &panel.state.camera, by));
            }
        }
        Some(drag) => {
            let (camera, pivot) = (&panel.state.camera, panel.view.pivot);
            panel.ask(Command::SetCamera(orbit::dragged(camera, drag, by, rect.height(), pivot)));
        }
        None => {}
    }
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
    let ray = response.interact_pointer_pos().map(|pointer| ray_at(&panel.state.camera, rect, pointer));
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
        let ray = ray_at(&panel.state.camera, rect, pointer);
        let point = pick_placed(&mesh.mesh, world, &ray).map(|(point, _)| world.inverse().transform_point3(point));
        let step = panel.state.camera.pixel_at_1(rect.height() as u32) * panel.state.camera.distance * 6.0;
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
    let camera: &Camera = &panel.state.camera;
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
