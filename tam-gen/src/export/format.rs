//! The formats on offer.

use std::str::FromStr;

/// A format of the exported map.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Format {
    /// One KTX2 array, R8 with Zstandard: the master file.
    Ktx2,
    /// One KTX2 array, BC4 with Zstandard.
    Ktx2Bc4,
    /// One DDS array, R8.
    DdsArray,
    /// One DDS per column, R8.
    DdsSlices,
    /// KTX2 files of three columns each, packed as R, G and B.
    RgbaPacked,
    /// One PNG per cell.
    Png,
    /// The strokes as JSON.
    StrokesJson,
    /// The strokes as vector paths.
    StrokesSvg,
}

impl Format {
    /// All formats, in the order in which they are offered.
    pub const ALL: [Format; 8] = [
        Self::Ktx2,
        Self::Ktx2Bc4,
        Self::DdsArray,
        Self::DdsSlices,
        Self::RgbaPacked,
        Self::Png,
        Self::StrokesJson,
        Self::StrokesSvg,
    ];

    /// The name used on the command line.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Ktx2 => "ktx2",
            Self::Ktx2Bc4 => "ktx2-bc4",
            Self::DdsArray => "dds-array",
            Self::DdsSlices => "dds-slices",
            Self::RgbaPacked => "rgba-packed",
            Self::Png => "png",
            Self::StrokesJson => "strokes-json",
            Self::StrokesSvg => "strokes-svg",
        }
    }

    /// What it is and which engines it is for, in one line.
    pub const fn describe(self) -> &'static str {
        match self {
            Self::Ktx2 => "KTX2 texture array, R8 with zstd, exact: wgpu, Bevy, Vulkan, OpenGL; the master file",
            Self::Ktx2Bc4 => "KTX2 texture array, BC4: half the GPU memory, nested, tones nearly exact; desktop GPUs",
            Self::DdsArray => "DDS texture array, R8: Godot 4 loads it directly; DirectX",
            Self::DdsSlices => "one DDS per tone, R8 with all levels: Unity, Unreal",
            Self::RgbaPacked => "KTX2 textures with three tones each in R, G, B (Praun's packing): three.js, WebGL",
            Self::Png => "one 8-bit grey PNG per tone and level: Blender, anything else",
            Self::StrokesJson => "the strokes and the cells that draw them: own renderers, research",
            Self::StrokesSvg => "the strokes of the darkest tone as vector paths: plotters, Inkscape, Illustrator",
        }
    }
}

impl std::fmt::Display for Format {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.pad(self.name())
    }
}

/// No format has this name.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[error("no format is called `{given}`{}; the formats are {}", meant(.given), names())]
pub struct UnknownFormat {
    /// The name given.
    pub given: String,
}

fn names() -> String {
    Format::ALL.map(Format::name).join(", ")
}

/// The nearest name, as a question, where one is near.
fn meant(given: &str) -> String {
    let distance = |format: &Format| strsim::damerau_levenshtein(&given.to_lowercase(), format.name());
    let nearest = Format::ALL.into_iter().min_by_key(distance).filter(|format| distance(format) <= 3);
    nearest.map_or(String::new(), |format| format!(" (did you mean `{format}`?)"))
}

impl FromStr for Format {
    type Err = UnknownFormat;

    fn from_str(name: &str) -> Result<Self, UnknownFormat> {
        let found = Self::ALL.into_iter().find(|format| format.name() == name);
        found.ok_or_else(|| UnknownFormat { given: name.into() })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_format_is_found_by_its_name_and_others_are_explained() {
        for format in Format::ALL {
            assert_eq!(format.name().parse(), Ok(format));
        }
        let error = "dds-aray".parse::<Format>().expect_err("misspelt").to_string();
        assert!(error.contains("did you mean `dds-array`?") && error.contains("strokes-svg"), "{error}");
        let error = "targa".parse::<Format>().expect_err("unknown").to_string();
        assert!(!error.contains("mean") && error.contains("ktx2-bc4"), "{error}");
    }
}
