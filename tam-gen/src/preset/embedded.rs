//! The presets that come with the tool.

use super::{Preset, place::nearest};
use crate::problems::FileError;

macro_rules! presets {
    ($($name:literal),+ $(,)?) => {
        &[$(($name, include_str!(concat!("../../../presets/", $name, ".toml")))),+]
    };
}

const EMBEDDED: &[(&str, &str)] = presets![
    "pencil",
    "ballpoint",
    "fine-pen",
    "engraving",
    "charcoal",
    "brush",
    "stipple",
    "loose-sketch",
    "woodcut",
];

impl Preset {
    /// The presets that come with the tool: name and TOML source of each.
    pub fn embedded() -> &'static [(&'static str, &'static str)] {
        EMBEDDED
    }

    /// The preset of the given name that comes with the tool; [`None`] if there is none.
    pub fn named(name: &str) -> Option<Result<Preset, FileError>> {
        let (name, source) = EMBEDDED.iter().find(|(known, _)| *known == name)?;
        Some(Self::from_toml(source, &format!("presets/{name}.toml")))
    }

    /// The name, among those that come with the tool, that was probably meant.
    pub fn nearest_name(name: &str) -> Option<&'static str> {
        nearest(name, EMBEDDED.iter().map(|(known, _)| *known))
    }
}
