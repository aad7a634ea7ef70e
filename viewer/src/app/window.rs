//! The window: draws the panels, carries out what they ask for, and lets the engine follow.

mod keeping;

use std::collections::HashSet;
use std::path::PathBuf;
use std::sync::Arc;
use std::time::{Duration, Instant};

use eframe::egui_wgpu::RenderState;
use egui::{Context, Key, KeyboardShortcut, Ui, ViewportCommand};
use egui_tiles::{SimplificationOptions, TileId, UiResponse};
use glam::DVec3;

use super::actions::{Action, actions, is_possible};
use super::apply::{Effect, Model, apply, command_line, save_scene, tell};
use super::ask::Asker;
use super::command::Command;
use super::history::History;
use super::layout::Pane;
use super::panels::{Panel, ShownNotice, ViewReport, dialogs, menu_bar, notices, status_bar};
use super::state::{Dialog, Notice, PresetSource, Severity, State};
use super::textures::Textures;
use super::watch::FileWatch;
use super::work::{Demand, Engine, MARGIN, Results, Wake};
use super::{panels, style};
use crate::gpu::Gpu;
pub use keeping::Leaving;
use keeping::{KeptSession, Left, Written, look_up_saved, restore};

/// How long a movement by the wheel is taken to go on, in seconds.
const WHEEL_S: f64 = 0.18;

/// Seconds of one round of what plays.
const ROUND_S: f64 = 10.0;

/// How the window starts.
#[derive(Clone, Debug, Default)]
pub struct Options {
    /// Where the session is kept; `None`: nowhere.
    pub session: Option<PathBuf>,
    /// Files to open.
    pub files: Vec<PathBuf>,
    /// Where the application is put when the window's device is lost, and taken from by the window after it.
    pub left: Leaving,
}

/// The application.
pub struct App {
    model: Model,
    engine: Engine,
    gpu: Gpu,
    results: Results,
    textures: Textures,
    asker: Asker,
    watch: FileWatch,
    view: ViewReport,
    chart_shown: bool,
    notices: Vec<ShownNotice>,
    messages: Vec<Notice>,
    session: Option<KeptSession>,
    written: Option<Written>,
    thumbnails: HashSet<String>,
    camera_moved_s: f64,
    title: String,
    /// When it started, until the first picture is there.
    started: Option<Instant>,
    /// Number of the picture that was on the screen last.
    seen: u64,
    /// Where all is put when the device is lost.
    left: Leaving,
    is_left: bool,
}

impl App {
    /// Starts the application in a context, with the session that was left; its pictures are drawn on the device that
    /// draws the window.
    ///
    /// # Errors
    /// Where the system gives no threads.
    pub fn new(ctx: &Context, window: &RenderState, mut options: Options) -> std::io::Result<Self> {
        style::install(ctx);
        let repaint = ctx.clone();
        let wake: Wake = Arc::new(move || repaint.request_repaint());
        let gpu = Gpu::watched(&window.device, &window.queue, &window.adapter);
        let results = Results { adapter: Some(gpu.adapter.to_string()), ..Results::default() };
        let engine = Engine::start(&wake, gpu.clone())?;
        options.left.open_on(&gpu);
        let (model, session) = match options.left.take() {
            Some(Left { model, session }) => {
                // They were opened by the window before.
                options.files.clear();
                (model, session)
            }
            None => {
                let (mut state, layout, session) = restore(options.session);
                look_up_saved(&mut state);
                (Model { state, history: History::default(), layout }, session)
            }
        };
        let mut app = Self {
            model,
            engine,
            gpu,
            results,
            textures: Textures::new(window.clone()),
            left: options.left,
            is_left: false,
            asker: Asker::new(Arc::clone(&wake)),
            watch: FileWatch::new(wake),
            view: ViewReport::default(),
            chart_shown: false,
            notices: Vec::new(),
            messages: Vec::new(),
            session,
            written: None,
            thumbnails: HashSet::new(),
            camera_moved_s: f64::NEG_INFINITY,
            title: String::new(),
            started: Some(Instant::now()),
            seen: 0,
        };
        if !options.files.is_empty() {
            app.carry_out(ctx, vec![Command::OpenFiles(options.files)]);
        }
        Ok(app)
    }

    /// All state.
    pub fn state(&self) -> &State {
        &self.model.state
    }

    /// What was made so far.
    pub fn results(&self) -> &Results {
        &self.results
    }

    /// Every message so far.
    pub fn messages(&self) -> &[Notice] {
        &self.messages
    }

    /// The window's device, on which pictures of the view are drawn.
    pub fn gpu(&self) -> &Gpu {
        &self.gpu
    }

    /// Whether anything that the view shows is still being made or drawn.
    pub fn is_busy(&self) -> bool {
        self.engine.is_busy()
    }

    /// Whether ways to draw the scene are being measured, for the chart or a fit, or are still to be.
    pub fn is_measuring(&self) -> bool {
        self.engine.is_measuring()
    }

    /// Carries out a command, as if a panel had asked for it.
    pub fn run(&mut self, ctx: &Context, command: Command) {
        self.carry_out(ctx, vec![command]);
    }

    /// Draws the whole window and goes on with all work.
    pub fn show(&mut self, ui: &mut Ui) {
        let ctx = ui.ctx().clone();
        style::follow(&ctx, &self.model.state.settings);
        let mut commands = self.collect();
        if self.results.device_lost.is_some() || self.gpu.is_lost() {
            self.leave(&ctx);
            return;
        }
        // What has come is drawn with at once, while the panels are laid out.
        self.follow(&ctx);
        let actions = actions(&self.model.state);
        self.shortcuts(&ctx, &actions, &mut commands);
        dropped(&ctx, &mut commands);
        self.panels(ui, &actions, &mut commands);
        self.closing(&ctx, &mut commands);
        self.carry_out(&ctx, commands);
        self.play(&ctx);
        self.frame_mesh();
        self.follow(&ctx);
        // A picture that is being drawn asks for the next frame itself: drawing the window meanwhile would only delay it.
        if self.model.state.transient.motion.is_some() && !self.engine.is_drawing() {
            ctx.request_repaint();
        }
        self.thumbnails();
        let (time_s, held) = ctx.input(|input| (input.time, input.pointer.any_down()));
        if self.model.history.watch(time_s, held, &self.model.state) {
            ctx.request_repaint_after(Duration::from_millis(100));
        }
        self.keep(&ctx, time_s, held);
        self.name_window(&ctx);
        let told = std::mem::take(&mut self.model.state.transient.notices);
        for notice in told {
            self.messages.push(notice.clone());
            self.notices.push(ShownNotice::new(notice));
        }
        notices(&ctx, &mut self.notices);
    }

    /// Notes when a new picture came to the screen: now, and as long later as the window took to draw itself before.
    fn see(&mut self, frame_s: Option<f32>) {
        let Some(shown) = self.results.picture.as_ref().filter(|shown| shown.number != self.seen) else { return };
        self.seen = shown.number;
        let drawing = Duration::from_secs_f32(frame_s.unwrap_or(0.0).max(0.0));
        self.results.to_screen = Some(shown.began.elapsed() + drawing);
    }

    /// What workers, dialogs and other programs have brought.
    fn collect(&mut self) -> Vec<Command> {
        let (told, back) = self.engine.collect(&mut self.results);
        self.model.state.transient.notices.extend(told);
        if self.results.picture.is_some()
            && let Some(started) = self.started.take()
        {
            tracing::info!("first picture after {:.2} s", started.elapsed().as_secs_f64());
        }
        let mut commands: Vec<Command> = self.asker.answers().collect();
        let state = &mut self.model.state;
        if self.results.mesh.as_ref().is_some_and(|mesh| mesh.source == state.document.mesh) {
            state.transient.mesh_before = None;
        } else if back {
            commands.push(Command::KeepMesh);
        }
        if self.watch.changed() {
            commands.extend(self.changed_on_disk());
        }
        commands
    }

    /// What to do about a preset file that has changed.
    fn changed_on_disk(&mut self) -> Option<Command> {
        let state = &self.model.state;
        let path = state.document.source.file()?.clone();
        // A file that is just being written is read at its next change.
        let preset = tam_gen::Preset::load(&path).ok()?;
        if state.saved_preset() == Some(&preset) {
            None
        } else if state.is_unsaved() {
            Some(Command::ShowDialog(Some(Dialog::ChangedOnDisk(path))))
        } else {
            Some(Command::Reload)
        }
    }

    fn shortcuts(&self, ctx: &Context, actions: &[Action], commands: &mut Vec<Command>) {
        let dialog = self.model.state.transient.dialog.is_some();
        let typing = ctx.text_edit_focused();
        let mut keyed: Vec<&Action> = actions.iter().filter(|action| action.shortcut.is_some()).collect();
        // Those with more keys held come first: others would match them too.
        keyed.sort_by_key(|action| std::cmp::Reverse(action.shortcut.map_or(0, |keys| held_keys(keys.modifiers))));
        for action in keyed {
            let Some(keys) = action.shortcut else { continue };
            if dialog || (typing && belong_to_text(&keys)) {
                continue;
            }
            if ctx.input_mut(|input| input.consume_shortcut(&keys))
                && is_possible(action, &self.model.state, &self.model.history)
            {
                commands.push(action.command.clone());
            }
        }
    }

    fn panels(&mut self, ui: &mut Ui, actions: &[Action], commands: &mut Vec<Command>) {
        let Model { state, history, layout } = &mut self.model;
        let can = |action: &Action| is_possible(action, state, history);
        let mut panel = Panel {
            state,
            results: &self.results,
            textures: &mut self.textures,
            commands,
            view: &mut self.view,
            chart_shown: &mut self.chart_shown,
            can: &can,
        };
        panel.view.hide();
        *panel.chart_shown = false;
        egui::Panel::top("menu").show(ui, |ui| menu_bar(&mut panel, ui, actions));
        egui::Panel::bottom("status").show(ui, |ui| status_bar(&mut panel, ui));
        let ctx = ui.ctx().clone();
        egui::CentralPanel::no_frame().show(ui, |ui| layout.ui(&mut Docks { panel: &mut panel }, ui));
        dialogs(&mut panel, &ctx, actions);
    }

    fn carry_out(&mut self, ctx: &Context, commands: Vec<Command>) {
        let camera = self.model.state.camera;
        for command in commands {
            for effect in apply(&mut self.model, command) {
                self.perform(ctx, effect);
            }
        }
        if self.model.state.camera != camera {
            self.camera_moved_s = ctx.input(|input| input.time);
        }
    }

    fn perform(&mut self, ctx: &Context, effect: Effect) {
        let mut started = true;
        match effect {
            Effect::Ask(ask) => self.asker.ask(ask),
            Effect::Export => started = self.engine.export(&self.model.state),
            Effect::SavePicture(path) => {
                started = self.engine.save_picture(&self.model.state, &self.results, path);
            }
            Effect::SaveTurntable(path) => {
                started = self.engine.save_turntable(&self.model.state, &self.results, path);
            }
            Effect::SaveScene(path) => save_scene(&mut self.model.state, &self.results, &path),
            Effect::CopyCommand => match command_line(&self.model.state, &self.results, self.view.size_px) {
                Ok(command) => {
                    ctx.copy_text(command);
                    let text = "The command that draws this view is on the clipboard.";
                    tell(&mut self.model.state, Severity::Done, text.to_owned());
                }
                Err(problem) => tell(&mut self.model.state, Severity::Warning, problem),
            },
            Effect::CancelFile => self.engine.cancel_file(),
            Effect::Fit => started = self.engine.fit(&self.model.state, &mut self.results, self.view.size_px),
            Effect::CancelFit => self.engine.cancel_fit(),
            Effect::Reveal(folder) => {
                if let Err(error) = opener::open(&folder) {
                    let text = format!("{} cannot be shown: {error}", folder.display());
                    tell(&mut self.model.state, Severity::Error, text);
                }
            }
            Effect::ReloadMesh => self.engine.reload_mesh(&mut self.results),
            Effect::Close => ctx.send_viewport_cmd(ViewportCommand::Close),
        }
        if !started {
            let text = "Something else is still being written or made; try again when it is done.";
            tell(&mut self.model.state, Severity::Warning, text.to_owned());
        }
    }

    /// Asks before changes are lost.
    fn closing(&self, ctx: &Context, commands: &mut Vec<Command>) {
        let state = &self.model.state;
        if ctx.input(|input| input.viewport().close_requested()) && state.has_unsaved() && !state.transient.may_close {
            ctx.send_viewport_cmd(ViewportCommand::CancelClose);
            commands.push(Command::Quit);
        }
    }

    fn play(&mut self, ctx: &Context) {
        let transient = &mut self.model.state.transient;
        if transient.motion.is_some() {
            let step_s = f64::from(ctx.input(|input| input.stable_dt)).min(0.1);
            transient.phase = (transient.phase + step_s / ROUND_S).fract();
        }
    }

    /// Puts a new mesh into the view, once it is there and the view has a size.
    fn frame_mesh(&mut self) {
        let state = &mut self.model.state;
        let Some(mesh) = self.results.mesh.as_ref().filter(|mesh| mesh.source == state.document.mesh) else { return };
        let [width, height] = self.view.size_px;
        if !state.transient.frame_mesh || self.results.meshes_to_come || width == 0 || height == 0 {
            return;
        }
        let mut points: Vec<DVec3> = Vec::new();
        for object in state.document.objects().filter(|object| object.standing.visible) {
            let Some(loaded) = self.results.meshes.iter().find(|loaded| loaded.source == *object.mesh) else {
                continue;
            };
            let world = object.standing.world_from_mesh();
            points.extend(loaded.mesh.positions.iter().map(|position| world.transform_point3(position.as_dvec3())));
        }
        if points.is_empty() {
            points.extend(mesh.mesh.positions.iter().map(|position| position.as_dvec3()));
        }
        state.camera.frame_points(&points, f64::from(width) / f64::from(height), MARGIN);
        state.transient.frame_mesh = false;
    }

    /// Asks for what the state and the view need by now.
    fn follow(&mut self, ctx: &Context) {
        let state = &self.model.state;
        let wheel = ctx.input(|input| input.time) - self.camera_moved_s < WHEEL_S;
        if wheel {
            ctx.request_repaint_after(Duration::from_secs_f64(WHEEL_S));
        }
        let held = ctx.input(|input| input.pointer.any_down());
        let demand = Demand {
            size_px: self.view.size_px,
            held: held || wheel,
            plays: state.transient.motion.is_some(),
            chart_shown: self.chart_shown,
        };
        self.engine.follow(state, demand, &mut self.results);
        self.watch.follow(state.document.source.file().map(PathBuf::as_path));
    }

    /// Asks for small pictures once the first large one is there.
    fn thumbnails(&mut self) {
        if self.results.picture.is_none() {
            return;
        }
        let state = &self.model.state;
        for (name, _) in tam_gen::Preset::embedded() {
            let key = panels::preset_key(name);
            if self.thumbnails.insert(key.clone())
                && let Some(Ok(preset)) = tam_gen::Preset::named(name)
            {
                self.engine.preset_thumbnail(key, &preset);
            }
        }
        for path in &state.settings.recent_presets {
            // What is saved again looks different.
            let saved = state.saved.get(&PresetSource::File(path.clone()).key());
            let key = panels::file_key(path);
            let mark = format!("{key} {}", saved.map_or_else(String::new, tam_gen::Preset::to_toml));
            if self.thumbnails.insert(mark)
                && let Some(preset) = saved.cloned().or_else(|| tam_gen::Preset::load(path).ok())
            {
                self.engine.preset_thumbnail(key, &preset);
            }
        }
        for mesh in panels::offered_meshes(state) {
            let key = panels::mesh_key(&mesh);
            if self.thumbnails.insert(key.clone()) {
                self.engine.mesh_thumbnail(key, &mesh);
            }
        }
    }

    fn name_window(&mut self, ctx: &Context) {
        let state = &self.model.state;
        let mark = if state.is_unsaved() { " •" } else { "" };
        let title = format!("{}{mark} – tam-viewer", state.preset_name());
        if title != self.title {
            ctx.send_viewport_cmd(ViewportCommand::Title(title.clone()));
            self.title = title;
        }
    }
}

impl eframe::App for App {
    fn ui(&mut self, ui: &mut Ui, frame: &mut eframe::Frame) {
        self.show(ui);
        self.see(frame.info().cpu_usage);
    }

    fn on_exit(&mut self) {
        self.write_session(true);
    }
}

/// The panels in their places.
struct Docks<'a, 'b> {
    panel: &'a mut Panel<'b>,
}

impl egui_tiles::Behavior<Pane> for Docks<'_, '_> {
    fn pane_ui(&mut self, ui: &mut Ui, _: TileId, pane: &mut Pane) -> UiResponse {
        let margin = if *pane == Pane::View { 4 } else { 8 };
        egui::Frame::new().fill(ui.visuals().panel_fill).inner_margin(margin).show(ui, |ui| {
            ui.take_available_space();
            ui.push_id(*pane, |ui| self.panel.show(ui, *pane));
        });
        UiResponse::None
    }

    fn tab_title_for_pane(&mut self, pane: &Pane) -> egui::WidgetText {
        pane.title().into()
    }

    fn simplification_options(&self) -> SimplificationOptions {
        SimplificationOptions { all_panes_must_have_tabs: true, ..SimplificationOptions::default() }
    }

    fn gap_width(&self, _: &egui::Style) -> f32 {
        3.0
    }

    fn min_size(&self) -> f32 {
        120.0
    }
}

/// Whether a field of text takes these keys while it is typed in.
fn belong_to_text(keys: &KeyboardShortcut) -> bool {
    let edits = [Key::A, Key::C, Key::V, Key::X, Key::Y, Key::Z].contains(&keys.logical_key);
    !keys.modifiers.command || edits
}

fn held_keys(modifiers: egui::Modifiers) -> u8 {
    u8::from(modifiers.command) + u8::from(modifiers.shift) + u8::from(modifiers.alt)
}

/// Files that were dropped onto the window.
fn dropped(ctx: &Context, commands: &mut Vec<Command>) {
    let files = ctx.input(|input| input.raw.dropped_files.clone());
    let paths: Vec<PathBuf> = files.iter().map(|file| file.path().to_owned()).collect();
    if !paths.is_empty() {
        commands.push(Command::OpenFiles(paths));
    }
}
