//! The open scene as a scene file, and a scene file as the open scene.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use glam::{DVec2, DVec3};
use tam_gen::Preset;

use super::state::{
    Document, FieldChoice, Look, MeshSource, ObjectRef, PresetSource, SceneObject, Standing, State, colours_of,
};
use super::work::LoadedMesh;
use crate::mesh::sample::Sample;
use crate::params::{Blend, Follow, Form, RenderParams, Silhouettes};
use crate::scene::{Lights, Material};
use crate::scene_file::value::{Colour, OrNone, Specular};
use crate::scene_file::{
    Camera, FieldEntry, LookEntry, MappingEntry, MeshEntry, ObjectEntry, PartEntry, SceneFile, ViewEntry, part_name,
};
use crate::surface::{StripeOptions, guides};

/// Lines of an object that says nothing of them, in pixels.
const LINES_PX: f64 = 2.0;

/// Files that a scene needs beside its own.
pub(super) trait Beside {
    /// The map's name or file of a preset.
    ///
    /// # Errors
    /// There is none, and none can be made.
    fn preset(&mut self, source: &PresetSource, preset: &Preset) -> Result<PathBuf, String>;

    /// The file of an object's guides.
    ///
    /// # Errors
    /// There is none, and none can be made.
    fn guides(&mut self, object: &str, text: &str) -> Result<PathBuf, String>;
}

/// The open scene in words, as `meshes` has the parts of its objects.
///
/// # Errors
/// What of it is in no file.
pub(super) fn to_file<'a>(
    state: &State,
    mesh_of: impl Fn(&MeshSource) -> Option<&'a LoadedMesh>,
    beside: &mut dyn Beside,
) -> Result<SceneFile, String> {
    let document = &state.document;
    let first = document.object(0);
    let view = ViewEntry {
        camera: Camera::of(&state.camera),
        lights: document.lights.lights.clone(),
        ambient: Some(document.lights.ambient),
        paper: Some(Colour(document.paper_colour())),
        ..ViewEntry::default()
    };
    let map = beside.preset(first.source, first.preset)?;
    let ink = colours_of(first.preset).1;
    let mut file =
        SceneFile { view, look: LookEntry { map: Some(map.clone()), ..LookEntry::default() }, objects: Vec::new() };
    for object in document.objects() {
        let mut entry = object_entry(&object, mesh_of(object.mesh), &document.part_presets, beside)?;
        let own = beside.preset(object.source, object.preset)?;
        entry.look.map = (own != map).then_some(own);
        let own_ink = colours_of(object.preset).1;
        if own_ink != ink {
            entry.look.ink = entry.look.ink.or(Some(Colour(own_ink)));
        }
        file.objects.push(entry);
    }
    file.name_objects();
    Ok(file)
}

fn object_entry(
    object: &ObjectRef<'_>,
    mesh: Option<&LoadedMesh>,
    part_presets: &BTreeMap<PathBuf, Preset>,
    beside: &mut dyn Beside,
) -> Result<ObjectEntry, String> {
    let mut entry = mesh.map_or_else(|| object.standing.entry(), |loaded| object.standing.known_parts(&loaded.mesh));
    (entry.mesh, entry.triangles) = match object.mesh {
        MeshSource::Sample(sample, triangles) => {
            let own = *triangles != sample.default_triangles();
            (PathBuf::from(sample.name()), own.then_some(*triangles as u32))
        }
        MeshSource::File(path) => (path.clone(), None),
    };
    if entry.name.is_empty() {
        entry.name = Path::new(&object.mesh.name()).file_stem().unwrap_or_default().to_string_lossy().into_owned();
    }
    let words = std::mem::take(&mut entry.look);
    entry.look = words.over(&look_entry(object.look));
    entry.look.visible = (!object.standing.visible).then_some(false);
    if !object.look.guides.is_empty() {
        entry.look.guides = Some(beside.guides(&entry.name, &guides::to_text(&object.look.guides))?);
    }
    for words in entry.parts.values_mut() {
        if let Some(preset) = words.look.map.as_ref().and_then(|map| part_presets.get(map)) {
            let source = source_of(words.look.map.as_deref().unwrap_or(Path::new("")));
            words.look.map = Some(beside.preset(&source, preset)?);
        }
    }
    let Some(mesh) = mesh else { return Ok(entry) };
    for (number, (part, material)) in mesh.mesh.parts.iter().zip(object.materials).enumerate() {
        let plain = Material { colour: part.colour, ..Material::default() };
        if *material != plain {
            let words = entry.parts.entry(part_name(number, &mesh.mesh.parts)).or_default();
            words.look = words.look.over(&material_entry(material, &plain));
        }
    }
    Ok(entry)
}

/// What is said of a material that differs from another.
fn material_entry(material: &Material, plain: &Material) -> LookEntry {
    let Material { colour, ambient, diffuse, specular, shininess, rotation_deg, scale, shift, .. } = material.clone();
    let differs = |own: [f64; 2], other: [f64; 2]| own != other;
    LookEntry {
        colour: (colour != plain.colour).then_some(Colour(colour)),
        lit: differs([ambient, diffuse], [plain.ambient, plain.diffuse]).then_some([ambient, diffuse]),
        specular: differs([specular, shininess], [plain.specular, plain.shininess])
            .then_some(Specular { strength: specular, shininess }),
        rotate_deg: (rotation_deg != plain.rotation_deg).then_some(rotation_deg),
        scale: (scale != plain.scale).then_some(scale),
        shift: (shift != DVec2::ZERO).then_some(shift),
        ..LookEntry::default()
    }
}

/// A look in words: what is as by default is left out, but for what the command line has otherwise.
fn look_entry(look: &Look) -> LookEntry {
    let Look { params, field, smoothing, guides: _, planar, lines_per_unit } = look;
    let default = RenderParams::default();
    let number = |own: f64, default: f64| (own != default).then_some(own);
    let lines = Silhouettes::default();
    let own = params.silhouettes.unwrap_or_default();
    LookEntry {
        method: Some(params.method),
        mapping: Some(MappingEntry::Is(params.mapping)),
        form: (params.form != Form::Hardened).then_some(params.form),
        blend: (params.blend != Blend::Union).then_some(params.blend),
        tiles: number(params.tiles_per_unit, default.tiles_per_unit),
        level_bias: number(params.level_bias, default.level_bias),
        slope: number(params.slope, default.slope),
        line_period_px: number(params.line_period_px, default.line_period_px),
        cross_from: (params.cross_from != default.cross_from).then_some(OrNone(params.cross_from)),
        variety: number(params.variety, default.variety),
        lines_px: Some(OrNone(params.silhouettes.map(|lines| lines.width_px))),
        crease_deg: (own.crease_deg != lines.crease_deg).then_some(OrNone(own.crease_deg)),
        contours: (own.contours != lines.contours).then_some(own.contours),
        borders: (own.borders != lines.borders).then_some(own.borders),
        field: match field {
            FieldChoice::Curvature => None,
            FieldChoice::LowerCurvature => Some(FieldEntry::Lower),
            FieldChoice::Light => Some(FieldEntry::Light),
            FieldChoice::Uv => Some(FieldEntry::Uv),
            FieldChoice::Constant(direction) => Some(FieldEntry::Along(*direction)),
        },
        smoothing: number(*smoothing, 1.0),
        stripes: number(*lines_per_unit, StripeOptions::default().lines_per_unit),
        follow: (params.follow != Follow::Surface).then_some(params.follow),
        planar: planar.then_some(true),
        ..LookEntry::default()
    }
}

/// What a scene file opens.
pub(super) struct Opened {
    pub document: Document,
    /// The camera where the file says all of it.
    pub camera: crate::Camera,
    /// Whether it is to show everything.
    pub frames: bool,
    /// What the window does not show of it, in sentences.
    pub left_out: Vec<String>,
}

/// The scene that a file describes, in place of a document whose comparison and camera it has not.
///
/// # Errors
/// A preset or guides that cannot be read.
pub(super) fn from_file(file: &SceneFile, camera: &crate::Camera) -> Result<Opened, String> {
    let mut left_out = Vec::new();
    if file.view.time_s.is_some() || file.view.deform.is_some() {
        left_out.push("Time and deformation of a scene are drawn by the command line; here they play.".to_owned());
    }
    let mut document = Document::default();
    document.lights = lights(&file.view);
    let mut objects = Vec::with_capacity(file.objects.len());
    for entry in &file.objects {
        let words = entry.look.over(&file.look);
        let map = words.map.clone().unwrap_or_else(|| PathBuf::from("pencil"));
        let (source, preset) = match preset_of(&map)? {
            Some(found) => found,
            None => {
                left_out.push(format!(
                    "{} is no preset: it is drawn by the command line, and here as pencil.",
                    map.display()
                ));
                preset_of(Path::new("pencil"))?.ok_or("pencil comes with the tool")?
            }
        };
        for map in entry.parts.values().filter_map(|part| part.look.map.as_ref()) {
            match preset_of(map)? {
                Some((_, preset)) => {
                    document.part_presets.insert(map.clone(), preset);
                }
                None => {
                    left_out.push(format!("{} is no preset: parts have it on the command line only.", map.display()))
                }
            }
        }
        objects.push(object_of(entry, &words, &file.view, source, preset)?);
    }
    document.set_objects(objects, 0);
    let paper = file.view.paper.map(|paper| paper.0);
    document.paper = paper.filter(|paper| *paper != colours_of(&document.preset).0);
    let mut camera = *camera;
    file.view.camera.apply(&mut camera);
    Ok(Opened { document, camera, frames: file.view.camera.fits_distance(), left_out })
}

fn lights(view: &ViewEntry) -> Lights {
    view.scene(None).lights
}

/// The preset of a name or file; `None`: it is a map.
fn preset_of(map: &Path) -> Result<Option<(PresetSource, Preset)>, String> {
    match source_of(map) {
        PresetSource::Shipped(name) => match Preset::named(&name) {
            Some(preset) => Ok(Some((PresetSource::Shipped(name), preset.map_err(|error| error.to_string())?))),
            None => Ok(None),
        },
        source => {
            if !map.extension().is_some_and(|kind| kind.eq_ignore_ascii_case("toml")) {
                return Ok(None);
            }
            Ok(Some((source, Preset::load(map).map_err(|error| error.to_string())?)))
        }
    }
}

fn source_of(map: &Path) -> PresetSource {
    let name = map.to_string_lossy();
    if Preset::named(&name).is_some() || (map.components().count() == 1 && map.extension().is_none()) {
        PresetSource::Shipped(name.into_owned())
    } else {
        PresetSource::File(map.to_owned())
    }
}

fn object_of(
    entry: &ObjectEntry,
    words: &LookEntry,
    view: &ViewEntry,
    source: PresetSource,
    preset: Preset,
) -> Result<SceneObject, String> {
    let MeshEntry { named, triangles } = entry.mesh_entry();
    let mesh = match Sample::named(&named.to_string_lossy()) {
        Some(sample) => {
            MeshSource::Sample(sample, triangles.map_or(sample.default_triangles(), |triangles| triangles as usize))
        }
        None => MeshSource::File(named),
    };
    let mut look = Look { params: words.params(true, LINES_PX), ..Look::default() }.with(words, true);
    let from = words.guides.as_ref().or(match &words.field {
        Some(FieldEntry::Guides(path)) => Some(path),
        _ => None,
    });
    if let Some(path) = from {
        look.guides = guides::read(path).map_err(|error| format!("{}: {error}", path.display()))?;
    }
    let ink = words.ink.filter(|ink| ink.0 != colours_of(&preset).1);
    let white = (view.plain == Some(true)).then_some(Colour([1.0; 3]));
    // What is said of the materials of all parts.
    let of_all = LookEntry {
        ink,
        colour: words.colour.or(white),
        lit: words.lit,
        specular: words.specular,
        rotate_deg: words.rotate_deg,
        scale: words.scale,
        shift: words.shift,
        ..LookEntry::default()
    };
    let standing = Standing {
        name: entry.name.clone(),
        place: entry.place.unwrap_or_default(),
        stretch: entry.stretch.unwrap_or(DVec3::ONE),
        visible: words.is_visible(),
        words: PartEntry { place: None, look: of_all },
        parts: entry.parts.clone(),
    };
    Ok(SceneObject { standing, mesh, look, materials: Vec::new(), source, preset })
}
