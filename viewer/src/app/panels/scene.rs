//! Objects, mesh, lights and colours.

use egui::{Color32, Ui};
use glam::DVec3;

use super::number::{self, Number};
use super::presets::{Card, cards};
use super::strokes::section;
use super::{Panel, camera, objects};
use crate::app::command::Command;
use crate::app::state::{MeshSource, State};
use crate::app::words::counted;
use crate::mesh::sample::Sample;
use crate::ranges;
use crate::scene::{Light, LightKind, MAX_LIGHTS};

pub(super) fn show(panel: &mut Panel<'_>, ui: &mut Ui) {
    egui::ScrollArea::vertical().auto_shrink(false).show(ui, |ui| {
        section(ui, "Objects", true, |ui| objects::list(panel, ui));
        let several = panel.state.document.object_count() > 1;
        section(ui, "Mesh", true, |ui| mesh(panel, ui));
        section(ui, "Place", several, |ui| objects::standing(panel, ui));
        section(ui, "Camera", false, |ui| camera::show(panel, ui));
        section(ui, "Light", true, |ui| lights(panel, ui));
        section(ui, "Colours", true, |ui| colours(panel, ui));
        section(ui, "Parts", false, |ui| objects::parts(panel, ui));
    });
}

/// Key of the thumbnail of a mesh.
pub(crate) fn mesh_key(mesh: &MeshSource) -> String {
    match mesh {
        MeshSource::Sample(sample, _) => format!("mesh:{}", sample.name()),
        MeshSource::File(path) => format!("mesh file:{}", path.display()),
    }
}

/// The meshes that are offered: samples, then files opened before.
pub(crate) fn offered(state: &State) -> Vec<MeshSource> {
    let files = state.settings.recent_meshes.iter().cloned().map(MeshSource::File);
    Sample::ALL.into_iter().map(MeshSource::sample).chain(files).collect()
}

fn mesh(panel: &mut Panel<'_>, ui: &mut Ui) {
    if ui
        .button("Load a mesh…")
        .on_hover_text("OBJ, glTF, GLB, PLY or STL (Ctrl+Shift+O); or drop it onto the window")
        .clicked()
    {
        panel.ask(Command::OpenMesh(None));
    }
    let chosen = panel.state.document.mesh.clone();
    let same = |source: &MeshSource| match (source, &chosen) {
        (MeshSource::Sample(own, _), MeshSource::Sample(other, _)) => own == other,
        (own, other) => own == other,
    };
    let list = offered(panel.state).into_iter().map(|source| Card {
        name: match &source {
            MeshSource::Sample(sample, _) => sample.name().to_owned(),
            MeshSource::File(_) => source.name(),
        },
        key: mesh_key(&source),
        chosen: same(&source),
        help: match &source {
            MeshSource::Sample(sample, _) => Some(sample.description().to_owned()),
            MeshSource::File(path) => Some(path.display().to_string()),
        },
        command: match &source {
            MeshSource::File(path) => Command::OpenMesh(Some(path.clone())),
            MeshSource::Sample(..) => Command::SetMesh(source.clone()),
        },
    });
    cards(panel, ui, list.collect());
    if let MeshSource::Sample(sample, triangles) = chosen {
        let mut count = triangles as f64;
        let doc = "Triangles of the sample, about";
        let (min, max) = (sample.least_triangles() as f64, 1_000_000.0);
        let default = sample.default_triangles() as f64;
        let number = Number { name: "Triangles", doc, unit: "", min, max, default, whole: true };
        if number::row(ui, number, &mut count) {
            panel.ask(Command::SetMesh(MeshSource::Sample(sample, count.round() as usize)));
        }
    }
    if let Some(mesh) = &panel.results.mesh {
        let text =
            format!("{}, {}", counted(mesh.mesh.triangles.len(), "triangle"), counted(mesh.mesh.parts.len(), "part"));
        ui.label(egui::RichText::new(text).weak());
        for note in mesh.report.notes() {
            ui.label(egui::RichText::new(format!("· {note}")).weak().small());
        }
    }
}

fn lights(panel: &mut Panel<'_>, ui: &mut Ui) {
    let mut lights = panel.state.document.lights.clone();
    let number = Number::view("Ambient", "Light from everywhere", ranges::SHARE, 0.12);
    number::row(ui, number, &mut lights.ambient);
    let mut gone = None;
    let only = lights.lights.len() == 1;
    for (index, light) in lights.lights.iter_mut().enumerate() {
        ui.push_id(index, |ui| {
            ui.horizontal(|ui| {
                ui.strong(format!("Light {}", index + 1));
                let delete = ui.add_enabled(!only, egui::Button::new("✖").small().frame(false));
                if number::named(delete, &format!("Remove light {}", index + 1)).clicked() {
                    gone = Some(index);
                }
            });
            one_light(ui, index, light);
        });
    }
    if let Some(gone) = gone {
        lights.lights.remove(gone);
    }
    let add = ui.add_enabled(lights.lights.len() < MAX_LIGHTS, egui::Button::new("Add a light"));
    if add.clicked() {
        lights.lights.push(Light { intensity: 0.4, ..Light::from_angles(60.0, 20.0) });
    }
    let mut handle = panel.state.settings.light_handle;
    if ui.checkbox(&mut handle, "Show the first as a sun in the view").changed() {
        panel.ask(Command::ShowLightHandle(handle));
    }
    if lights != panel.state.document.lights {
        panel.ask(Command::SetLights(lights));
    }
}

#[derive(Clone, Copy, PartialEq)]
enum Kind {
    Directional,
    Positional,
    Spot,
}

fn one_light(ui: &mut Ui, index: usize, light: &mut Light) {
    let named = |what: &str| format!("{what} {}", index + 1);
    let mut kind = match light.kind {
        LightKind::Directional { .. } => Kind::Directional,
        LightKind::Positional { .. } => Kind::Positional,
        LightKind::Spot { .. } => Kind::Spot,
    };
    let (place, towards) = match light.kind {
        LightKind::Directional { direction } => (-direction.normalize_or(DVec3::NEG_Y) * 2.5, direction),
        LightKind::Positional { position } => (position, -position),
        LightKind::Spot { position, direction, .. } => (position, direction),
    };
    let word = |kind| match kind {
        Kind::Directional => "Directional".to_owned(),
        Kind::Positional => "At a point".to_owned(),
        Kind::Spot => "Spot".to_owned(),
    };
    let all = [Kind::Directional, Kind::Positional, Kind::Spot];
    if number::choice(ui, &named("Kind"), "Where light comes from", &mut kind, &all, word) {
        light.kind = match kind {
            Kind::Directional => LightKind::Directional { direction: -place.normalize_or(DVec3::Y) },
            Kind::Positional => LightKind::Positional { position: place },
            Kind::Spot => LightKind::Spot {
                position: place,
                direction: towards.normalize_or(DVec3::NEG_Y),
                cutoff_deg: 35.0,
                exponent: 4.0,
            },
        };
    }
    let title = named("Strength");
    let strength = Number::view(&title, "Luminance of a white surface that faces it", ranges::INTENSITY, 1.0);
    number::row(ui, strength.between(0.0, 3.0), &mut light.intensity);
    match &mut light.kind {
        LightKind::Directional { direction } => {
            let to_light = -direction.normalize_or(DVec3::NEG_Y);
            let mut azimuth = to_light.x.atan2(to_light.z).to_degrees();
            let mut elevation = to_light.y.clamp(-1.0, 1.0).asin().to_degrees();
            let (around, above) = (named("Around"), named("Above"));
            let turn = Number {
                name: &around,
                doc: "Angle around",
                unit: "degrees",
                min: -180.0,
                max: 180.0,
                default: -40.0,
                whole: false,
            };
            let rise = Number {
                name: &above,
                doc: "Angle above the horizon",
                unit: "degrees",
                min: -90.0,
                max: 90.0,
                default: 45.0,
                whole: false,
            };
            if number::row(ui, turn, &mut azimuth) | number::row(ui, rise, &mut elevation) {
                light.kind = Light::from_angles(azimuth, elevation).kind;
            }
        }
        LightKind::Positional { position } => point(ui, &named("Place"), position),
        LightKind::Spot { position, direction, cutoff_deg, exponent } => {
            point(ui, &named("Place"), position);
            point(ui, &named("Towards"), direction);
            let (cutoff, edge) = (named("Cut-off"), named("Falls off"));
            number::row(
                ui,
                Number::view(&cutoff, "Angle beyond which there is no light", ranges::CUTOFF_DEG, 35.0),
                cutoff_deg,
            );
            let falls = Number::view(&edge, "Power of the cosine from the axis", ranges::SPOT_EXPONENT, 4.0);
            number::row(ui, falls.between(0.0, 64.0), exponent);
        }
    }
}

fn point(ui: &mut Ui, title: &str, point: &mut DVec3) {
    let range = ranges::Range { min: -100.0, max: 100.0, unit: "units" };
    number::axes(ui, title, "In world units; meshes are 2 units long", range, point);
}

fn colours(panel: &mut Panel<'_>, ui: &mut Ui) {
    let mut preset = panel.state.document.preset.clone();
    let Ok((mut paper, mut ink)) = preset.colours.srgb() else { return };
    let row = |ui: &mut Ui, title: &str, colour: &mut [u8; 3], css: &mut String| {
        ui.horizontal(|ui| {
            let label = number::name(ui, title, "Exported maps hold no colour: engines bring their own");
            if ui.color_edit_button_srgb(colour).labelled_by(label.id).changed() {
                *css = hex(*colour);
            }
            ui.monospace(css.as_str());
        });
    };
    // Where the preset is not the one that the paper comes from, paper is chosen for the scene.
    let document = &panel.state.document;
    if document.paper.is_some() || document.object(0).source != &document.source {
        let mut paper = document.paper_colour();
        let mut asked = None;
        ui.horizontal(|ui| {
            let label = number::name(ui, "Paper", "Of the scene");
            if ui.color_edit_button_rgb(&mut paper).labelled_by(label.id).changed() {
                asked = Some(Some(paper));
            }
            let own = ui.add_enabled(document.paper.is_some(), egui::Button::new("↺").frame(false));
            if number::named(own, "Paper of the first object")
                .on_hover_text("That of the first object's preset")
                .clicked()
            {
                asked = Some(None);
            }
        });
        panel.commands.extend(asked.map(Command::SetPaper));
    } else {
        row(ui, "Paper", &mut paper, &mut preset.colours.paper);
    }
    row(ui, "Ink", &mut ink, &mut preset.colours.ink);
    ui.horizontal(|ui| {
        for (name, paper, ink) in PAIRS {
            let colour = |css: &str| {
                csscolorparser::parse(css).map_or(Color32::WHITE, |colour| {
                    let [r, g, b, _] = colour.to_rgba8();
                    Color32::from_rgb(r, g, b)
                })
            };
            let button = egui::Button::new(egui::RichText::new("//").color(colour(ink)).strong()).fill(colour(paper));
            if number::named(ui.add(button), &format!("Colours: {name}")).on_hover_text(name).clicked() {
                (preset.colours.paper, preset.colours.ink) = (paper.to_owned(), ink.to_owned());
            }
        }
    });
    if preset.colours != panel.state.document.preset.colours {
        panel.ask(Command::SetPreset(Box::new(preset)));
    }
}

/// Papers and inks that go together.
const PAIRS: [(&str, &str, &str); 6] = [
    ("black on white", "#ffffff", "#111111"),
    ("sepia on ivory", "#faf4e6", "#4a2f1b"),
    ("blue ballpoint", "#fdfdfb", "#1d3f8f"),
    ("red chalk on cream", "#f6ecd9", "#9a3a23"),
    ("white on slate", "#27323a", "#f2efe6"),
    ("ink on kraft", "#c8a67a", "#2a1c10"),
];

fn hex([r, g, b]: [u8; 3]) -> String {
    format!("#{r:02x}{g:02x}{b:02x}")
}
