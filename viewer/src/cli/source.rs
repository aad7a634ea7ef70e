//! What the user named: meshes and maps.

use std::path::Path;
use std::sync::atomic::AtomicBool;

use tam_gen::Job;
use tam_gen::command::{Failure, Output, Progress, source};
use tam_gen::import::{self, ImportError, ImportOptions};
use tam_gen::preset::nearest;
use tam_viewer::Method;
use tam_viewer::maps::HatchMap;
use tam_viewer::mesh::sample::Sample;
use tam_viewer::mesh::{Loaded, load, prepare};
use tam_viewer::scene_file::MeshEntry;

use super::report;

/// Whether a mesh of this name is made here.
pub(super) fn is_sample(named: &Path) -> bool {
    Sample::named(&named.to_string_lossy()).is_some()
}

/// The mesh of a sample's name or of a file.
pub(super) fn mesh(entry: &MeshEntry) -> Result<Loaded, Failure> {
    let named = entry.named.as_path();
    let name = named.to_string_lossy();
    if let Some(sample) = Sample::named(&name) {
        let triangles = entry.triangles.map_or(sample.default_triangles(), |triangles| triangles as usize);
        return prepare(sample.build(triangles)).map_err(report::mesh);
    }
    let is_path = named.components().count() != 1 || named.extension().is_some() || named.exists();
    if !is_path {
        let names = Sample::ALL.map(Sample::name);
        let meant = nearest(&name, names).map_or(String::new(), |meant| format!("did you mean `{meant}`? "));
        return Err(Failure::usage(
            format!("no mesh is called `{name}`"),
            format!(
                "{meant}the samples are {}; a mesh of your own is given as a file, such as ./mine.obj",
                names.join(", ")
            ),
        ));
    }
    if entry.triangles.is_some() {
        return Err(Failure::usage(
            format!("triangles are for samples; {} has those that it has", named.display()),
            "leave them out, or name a sample",
        ));
    }
    load(named).map_err(report::mesh)
}

/// The map of a preset or file, with all that the methods draw with.
pub(super) fn map(named: &Path, methods: &[Method], cancel: &AtomicBool, output: &Output) -> Result<HatchMap, Failure> {
    map_times(named, 1.0, methods, cancel, output)
}

/// The same for pictures so many times as high as what they look like: strokes of presets have more texels for that.
pub(super) fn map_times(
    named: &Path,
    times: f64,
    methods: &[Method],
    cancel: &AtomicBool,
    output: &Output,
) -> Result<HatchMap, Failure> {
    let progress = Progress::new("generating", output.quiet || output.json);
    let made = |part: f32| progress.set(part);
    let job = Job { progress: Some(&made), cancel: Some(cancel), measure: None };
    let is_name = named.components().count() == 1 && named.extension().is_none() && !named.exists();
    let map = if source::is_preset(named) || is_name {
        let (name, preset) = source::preset(named)?;
        HatchMap::finer(&name, &preset, preset.texels_for(times), &job)?
    } else {
        read(named)?
    };
    if methods.contains(&Method::FineTone) {
        let progress = Progress::new("finer tones", output.quiet || output.json);
        let made = |part: f32| progress.set(part);
        map.fine_with(&Job { progress: Some(&made), cancel: Some(cancel), measure: None })?;
    }
    Ok(map)
}

/// Reads a map, which must be one: a layer for each tone, with levels of detail.
fn read(path: &Path) -> Result<HatchMap, Failure> {
    let wrong = |what: &str| Failure::Work {
        kind: "source",
        message: format!("{} is no tonal art map: {what}", path.display()),
        help: Some("give a preset, or a map as `tam-gen generate` writes it".to_owned()),
    };
    let imported = match import::read(path, &ImportOptions::default()) {
        Ok(imported) => imported,
        Err(ImportError::Polarity(cause)) => return Err(wrong(&format!("ink cannot be told from paper, as {cause}"))),
        Err(error) => return Err(error.into()),
    };
    if imported.grid.columns() < 2 {
        return Err(wrong("it has one layer, and a map has an array of them, one for each tone"));
    }
    if imported.grid.levels.len() < 2 {
        return Err(wrong("it has no mip levels, which a map draws each on its own"));
    }
    Ok(HatchMap::from_import(&source::stem(path)?, imported))
}

/// Paper and ink of a map, in linear light, where its preset has them.
pub(super) fn colours(map: &HatchMap) -> Option<([f32; 3], [f32; 3])> {
    map.preset.as_ref()?.colours.linear().ok()
}
