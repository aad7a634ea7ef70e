//! What our own files say of themselves: key/values, and the manifest.

use std::collections::BTreeMap;
use std::fs;
use std::path::Path;

use serde::Deserialize;

use super::assemble::Facts;
use super::collect::{Collected, names_in};

/// Largest manifest that is read, in bytes.
const MANIFEST_MAX: u64 = 16 << 20;

/// The part of [`crate::export::Manifest`] that an import needs; any version's will do.
#[derive(Debug, Deserialize)]
pub(super) struct ManifestFacts {
    version: String,
    tones: Vec<f64>,
    hand_built: usize,
    levels: Vec<LevelFacts>,
    preset_toml: Option<String>,
}

#[derive(Debug, Deserialize)]
struct LevelFacts {
    size: u32,
}

/// `STEM.json` in the folder; without a stem, the only manifest in the folder or the one above it.
pub(super) fn manifest_beside(dir: &Path, stem: Option<&str>) -> Option<ManifestFacts> {
    let parse = |path: &Path| {
        if fs::metadata(path).ok()?.len() > MANIFEST_MAX {
            return None;
        }
        serde_json::from_slice::<ManifestFacts>(&fs::read(path).ok()?).ok()
    };
    if let Some(stem) = stem {
        return parse(&dir.join(format!("{stem}.json")));
    }
    let is_cells = dir.file_name().is_some_and(|name| name == "cells");
    [Some(dir), dir.parent().filter(|_| is_cells)].into_iter().flatten().find_map(|dir| {
        let names = names_in(dir).ok()?;
        let mut manifests =
            names.iter().filter(|name| name.ends_with(".json")).filter_map(|name| parse(&dir.join(name)));
        manifests.next().filter(|_| manifests.next().is_none())
    })
}

/// What the file says, else what the manifest says if it describes these very cells.
pub(super) fn facts(collected: &Collected, manifest: Option<&ManifestFacts>) -> Facts {
    let key_values = &collected.key_values;
    if key_values.keys().any(|key| key.starts_with("tam.")) {
        return Facts {
            tones: tones(key_values),
            hand_built: key_values.get("tam.handBuiltLevels").and_then(|count| count.parse().ok()),
            preset_toml: key_values.get("tam.preset").cloned(),
            version: key_values.get("tam.version").cloned(),
        };
    }
    let columns = collected.levels.first().map_or(0, |level| level.cells.len());
    let fits = |manifest: &&ManifestFacts| {
        manifest.tones.len() == columns
            && manifest.levels.iter().map(|level| level.size).eq(collected.levels.iter().map(|level| level.width))
    };
    match manifest.filter(fits) {
        Some(manifest) => Facts {
            tones: Some(manifest.tones.clone()),
            hand_built: Some(manifest.hand_built),
            preset_toml: manifest.preset_toml.clone(),
            version: Some(manifest.version.clone()),
        },
        None => Facts::default(),
    }
}

/// The tones in the metadata.
pub(super) fn tones(key_values: &BTreeMap<String, String>) -> Option<Vec<f64>> {
    serde_json::from_str(key_values.get("tam.tones")?).ok()
}

/// The distribution in the metadata of a stroke map; empty where there is none.
pub(super) fn distribution(key_values: &BTreeMap<String, String>) -> Vec<Vec<f32>> {
    key_values.get("tam.distribution").and_then(|json| serde_json::from_str(json).ok()).unwrap_or_default()
}
