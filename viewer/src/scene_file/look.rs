//! What a scene file says of a look.

use std::path::PathBuf;

use glam::{DVec2, DVec3};

use super::value::{self, Colour, OrNone, Specular};
use super::word::{Given, Kind, Word, name_of, named, switch};
use crate::params::{Blend, Follow, Form, Mapping, Method, RenderParams, Silhouettes};
use crate::ranges;
use crate::scene::Material;

/// How strokes lie on the surface, as it was asked for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum MappingEntry {
    /// By the mesh's uv where it has one, else in patches.
    Auto,
    /// By this one.
    Is(Mapping),
}

impl MappingEntry {
    /// All names, in the order in which they are listed.
    pub const NAMES: [&str; 6] = ["auto", "uv", "frames", "triplanar", "patches", "lapped"];

    /// The mapping of a name.
    pub fn named(name: &str) -> Option<Self> {
        if name == "auto" { Some(Self::Auto) } else { Mapping::named(name).map(Self::Is) }
    }

    fn name(self) -> &'static str {
        match self {
            Self::Auto => "auto",
            Self::Is(mapping) => mapping.name(),
        }
    }

    /// The mapping of a mesh with or without uv.
    pub fn of(self, has_uv: bool) -> Mapping {
        match self {
            Self::Is(mapping) => mapping,
            Self::Auto if has_uv => Mapping::Uv,
            Self::Auto => Mapping::Patches,
        }
    }
}

/// What strokes follow, as it was asked for.
#[derive(Clone, Debug, PartialEq)]
pub enum FieldEntry {
    /// Rings round a finger.
    Curvature,
    /// Along a finger.
    Lower,
    /// Across the light.
    Light,
    /// The mesh's own uv.
    Uv,
    /// One direction in space.
    Along(DVec3),
    /// Strokes drawn on the surface, from a file; curvature between them.
    Guides(PathBuf),
}

/// A look in words; `None`: as the object's surroundings say, or by default.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct LookEntry {
    /// The shading method.
    pub method: Option<Method>,
    /// How strokes lie on the surface.
    pub mapping: Option<MappingEntry>,
    /// Hardened, or as printed.
    pub form: Option<Form>,
    /// How overlapping patterns are joined.
    pub blend: Option<Blend>,
    /// A preset by name or file, or a map.
    pub map: Option<PathBuf>,
    /// Repeats of the tile per unit.
    pub tiles: Option<f64>,
    /// Turn of the strokes, in degrees; added to that of the surroundings.
    pub rotate_deg: Option<f64>,
    /// Multiplies the repeats of the tile, and what the surroundings say.
    pub scale: Option<f64>,
    /// Shift of the tile in tiles; added to that of the surroundings.
    pub shift: Option<DVec2>,
    /// Added to the level of detail.
    pub level_bias: Option<f64>,
    /// Slope of the literal threshold.
    pub slope: Option<f64>,
    /// Least distance of halftone lines and stripes, in pixels.
    pub line_period_px: Option<f64>,
    /// Darkness above which stripes are crossed.
    pub cross_from: Option<OrNone>,
    /// How much the strokes of stripes differ.
    pub variety: Option<f64>,
    /// Width of contours, borders and creases, in pixels.
    pub lines_px: Option<OrNone>,
    /// Angle above which an edge is a crease, in degrees.
    pub crease_deg: Option<OrNone>,
    /// Whether contours are drawn.
    pub contours: Option<bool>,
    /// Whether borders are drawn.
    pub borders: Option<bool>,
    /// What strokes follow.
    pub field: Option<FieldEntry>,
    /// Strokes drawn on the surface, from a file, which the field follows.
    pub guides: Option<PathBuf>,
    /// How far directions spread.
    pub smoothing: Option<f64>,
    /// Stripes per unit at their coarsest.
    pub stripes: Option<f64>,
    /// Whether patches turn with the light.
    pub follow: Option<Follow>,
    /// Lay patches by projection on planes.
    pub planar: Option<bool>,
    /// Colour of the ink.
    pub ink: Option<Colour>,
    /// Colour under the strokes.
    pub colour: Option<Colour>,
    /// A highlight.
    pub specular: Option<Specular>,
    /// Shares of ambient and of direct light.
    pub lit: Option<[f64; 2]>,
    /// Whether it is seen.
    pub visible: Option<bool>,
}

const METHODS: [&str; 7] = ["phong", "six-way", "face-frame", "stroke-map", "halftone", "fine-tone", "stripes"];
/// Names of the forms.
pub(super) const FORMS: [&str; 2] = ["hardened", "literal"];
/// Names of the blends.
pub(super) const BLENDS: [&str; 2] = ["union", "linear"];
/// Names of what patches follow.
pub(super) const FOLLOWED: [&str; 2] = ["surface", "light"];

/// A word whose value is read by one function and written by another.
macro_rules! word {
    ($name:literal, $kind:expr, $field:ident, $read:expr, $write:expr, $about:literal) => {
        Word {
            name: $name,
            kind: $kind,
            about: $about,
            set: |look, text| {
                look.$field = Some($read(text)?);
                Ok(())
            },
            get: |look| look.$field.as_ref().map($write),
        }
    };
}

/// A word whose value is a number.
macro_rules! number {
    ($name:literal, $range:expr, $field:ident, $about:literal) => {
        word!(
            $name,
            Kind::Number($range),
            $field,
            |text: &str| value::number(text, $range),
            |n| Given::Number(*n),
            $about
        )
    };
}

/// A word whose value is a number or none.
macro_rules! number_or_none {
    ($name:literal, $range:expr, $field:ident, $about:literal) => {
        word!($name, Kind::NumberOrNone($range), $field, value::or_none($range), or_none, $about)
    };
}

/// A word whose value is true or false.
macro_rules! switch {
    ($name:literal, $field:ident, $about:literal) => {
        word!($name, Kind::Switch, $field, switch, |on| Given::Switch(*on), $about)
    };
}

fn or_none(given: &OrNone) -> Given {
    given.0.map_or(Given::Text("none".into()), Given::Number)
}

fn mapping(text: &str) -> Result<MappingEntry, String> {
    MappingEntry::named(text).ok_or_else(|| value::unknown("mapping", text, MappingEntry::NAMES))
}

fn path(text: &str) -> Result<PathBuf, String> {
    if text.is_empty() { Err("a name or a file is expected".into()) } else { Ok(text.into()) }
}

fn lit(text: &str) -> Result<[f64; 2], String> {
    let shares = value::numbers(text, &[("AMBIENT", ranges::SHARE), ("DIFFUSE", ranges::SHARE)], 2)?;
    Ok([shares[0], shares[1]])
}

impl FieldEntry {
    fn written(&self) -> Given {
        Given::Text(match self {
            Self::Curvature => "curvature".into(),
            Self::Lower => "lower".into(),
            Self::Light => "light".into(),
            Self::Uv => "uv".into(),
            Self::Along(along) => return Given::Numbers(along.to_array().to_vec()),
            Self::Guides(path) => format!("guides:{}", path.display()),
        })
    }
}

impl LookEntry {
    /// All words of looks.
    pub const WORDS: &[Word<Self>] = &[
        word!(
            "method",
            Kind::Name(&METHODS),
            method,
            |text| named("method", text, &METHODS),
            name_of,
            "The shading method"
        ),
        word!(
            "mapping",
            Kind::Name(&MappingEntry::NAMES),
            mapping,
            mapping,
            |mapping| Given::Text(mapping.name().into()),
            "How strokes lie on the surface; auto: by the mesh's uv where it has one, else patches"
        ),
        word!(
            "form",
            Kind::Name(&FORMS),
            form,
            |text| named("form", text, &FORMS),
            name_of,
            "With the remedies for known failures, or as the paper prints it"
        ),
        word!(
            "blend",
            Kind::Name(&BLENDS),
            blend,
            |text| named("blend", text, &BLENDS),
            name_of,
            "How overlapping patterns are joined"
        ),
        word!(
            "map",
            Kind::Text("a preset by name or file, or a map"),
            map,
            path,
            |map| Given::Text(map.display().to_string()),
            "A preset by name or file, or a map: a KTX2 or DDS array, a folder of pictures"
        ),
        number!("tiles", ranges::TILES_PER_UNIT, tiles, "Repeats of the tile per unit; meshes are 2 units long"),
        number!("rotate", ranges::AZIMUTH_DEG, rotate_deg, "Turn of the strokes, added to that of all"),
        number!("scale", ranges::SCALE, scale, "Multiplies the repeats of the tile, and what is said of all"),
        word!(
            "shift",
            Kind::Numbers("U,V"),
            shift,
            value::shift,
            |by| Given::Numbers(by.to_array().to_vec()),
            "Shift of the tile in tiles, added to that of all"
        ),
        number!("level-bias", ranges::LEVEL_BIAS, level_bias, "Added to the level of detail; negative is finer"),
        number!("slope", ranges::SLOPE, slope, "Slope of the literal threshold of stroke-map and halftone"),
        number!("line-period", ranges::LINE_PERIOD_PX, line_period_px, "Least distance of halftone lines and stripes"),
        number_or_none!(
            "cross",
            ranges::SHARE,
            cross_from,
            "Darkness above which stripes are crossed by others, or none"
        ),
        number!("variety", ranges::VARIETY, variety, "How much the strokes of stripes differ"),
        number_or_none!("lines", ranges::LINE_WIDTH_PX, lines_px, "Width of contours, borders and creases, or none"),
        number_or_none!(
            "crease",
            ranges::CREASE_DEG,
            crease_deg,
            "Angle of faces above which their edge is drawn as a crease, or none"
        ),
        switch!("contours", contours, "Whether lines are drawn where the surface turns away"),
        switch!("borders", borders, "Whether lines are drawn where the surface ends"),
        word!(
            "field",
            Kind::Text("curvature, lower, light, uv, X,Y,Z, or guides:FILE"),
            field,
            value::field,
            FieldEntry::written,
            "What strokes follow with patches, lapped and stripes"
        ),
        word!(
            "guides",
            Kind::Text("a file of guides"),
            guides,
            path,
            |guides| Given::Text(guides.display().to_string()),
            "Strokes drawn on the surface, which the field follows"
        ),
        number!("smoothing", ranges::SMOOTHING, smoothing, "How far directions spread, as a multiple of the default"),
        number!("stripes", ranges::LINES_PER_UNIT, stripes, "Stripes per unit at their coarsest"),
        word!(
            "follow",
            Kind::Name(&FOLLOWED),
            follow,
            |text| named("way to turn", text, &FOLLOWED),
            name_of,
            "Whether patches lie still along the field, or turn across the light"
        ),
        switch!("planar", planar, "Lay patches by projection on planes"),
        word!("ink", Kind::Colour, ink, value::colour, value::written_colour, "Colour of the ink"),
        word!("colour", Kind::Colour, colour, value::colour, value::written_colour, "Colour under the strokes"),
        word!(
            "specular",
            Kind::Numbers("STRENGTH[,SHININESS]"),
            specular,
            value::specular,
            |s| Given::Numbers(vec![s.strength, s.shininess]),
            "A highlight"
        ),
        word!(
            "lit",
            Kind::Numbers("AMBIENT,DIFFUSE"),
            lit,
            lit,
            |lit| Given::Numbers(lit.to_vec()),
            "Shares of ambient and of direct light that are seen"
        ),
        switch!("visible", visible, "Whether it is drawn"),
    ];

    /// Sets a word to a value.
    ///
    /// # Errors
    /// No word is called so, or the value makes no sense.
    pub fn set(&mut self, name: &str, text: &str) -> Result<(), String> {
        // As some spell it.
        let name = if name == "color" { "colour" } else { name };
        Word::set(Self::WORDS, self, name, text)
    }

    /// What was said, word by word.
    pub fn given(&self) -> impl Iterator<Item = (&'static str, Given)> {
        Self::WORDS.iter().filter_map(|word| Some((word.name, (word.get)(self)?)))
    }

    /// This look, and what it leaves open as `base` says. Turns and shifts are added, scales multiplied.
    #[must_use]
    pub fn over(&self, base: &Self) -> Self {
        Self {
            method: self.method.or(base.method),
            mapping: self.mapping.or(base.mapping),
            form: self.form.or(base.form),
            blend: self.blend.or(base.blend),
            map: self.map.as_ref().or(base.map.as_ref()).cloned(),
            tiles: self.tiles.or(base.tiles),
            rotate_deg: joined(self.rotate_deg, base.rotate_deg, |a, b| a + b),
            scale: joined(self.scale, base.scale, |a, b| a * b),
            shift: joined(self.shift, base.shift, |a, b| a + b),
            level_bias: self.level_bias.or(base.level_bias),
            slope: self.slope.or(base.slope),
            line_period_px: self.line_period_px.or(base.line_period_px),
            cross_from: self.cross_from.or(base.cross_from),
            variety: self.variety.or(base.variety),
            lines_px: self.lines_px.or(base.lines_px),
            crease_deg: self.crease_deg.or(base.crease_deg),
            contours: self.contours.or(base.contours),
            borders: self.borders.or(base.borders),
            field: self.field.as_ref().or(base.field.as_ref()).cloned(),
            guides: self.guides.as_ref().or(base.guides.as_ref()).cloned(),
            smoothing: self.smoothing.or(base.smoothing),
            stripes: self.stripes.or(base.stripes),
            follow: self.follow.or(base.follow),
            planar: self.planar.or(base.planar),
            ink: self.ink.or(base.ink),
            colour: self.colour.or(base.colour),
            specular: self.specular.or(base.specular),
            lit: self.lit.or(base.lit),
            visible: self.visible.or(base.visible),
        }
    }

    /// How it is drawn on a mesh with or without uv; lines are `lines_px` wide where nothing is said of them.
    pub fn params(&self, has_uv: bool, lines_px: f64) -> RenderParams {
        let silhouettes = Some(Silhouettes { width_px: lines_px, ..Silhouettes::default() });
        let mapping = MappingEntry::Auto.of(has_uv);
        self.apply(&RenderParams { silhouettes, mapping, ..RenderParams::default() }, has_uv)
    }

    /// What it says of a way to draw; what it does not say of stays.
    #[must_use]
    pub fn apply(&self, base: &RenderParams, has_uv: bool) -> RenderParams {
        let lines = base.silhouettes.unwrap_or_default();
        let width_px = self.lines_px.map_or(base.silhouettes.map(|lines| lines.width_px), |lines| lines.0);
        let silhouettes = width_px.map(|width_px| Silhouettes {
            width_px,
            contours: self.contours.unwrap_or(lines.contours),
            borders: self.borders.unwrap_or(lines.borders),
            crease_deg: self.crease_deg.map_or(lines.crease_deg, |crease| crease.0),
        });
        RenderParams {
            method: self.method.unwrap_or(base.method),
            mapping: self.mapping.map_or(base.mapping, |mapping| mapping.of(has_uv)),
            form: self.form.unwrap_or(base.form),
            blend: self.blend.unwrap_or(base.blend),
            follow: self.follow.unwrap_or(base.follow),
            tiles_per_unit: self.tiles.unwrap_or(base.tiles_per_unit),
            level_bias: self.level_bias.unwrap_or(base.level_bias),
            slope: self.slope.unwrap_or(base.slope),
            line_period_px: self.line_period_px.unwrap_or(base.line_period_px),
            cross_from: self.cross_from.map_or(base.cross_from, |cross| cross.0),
            variety: self.variety.unwrap_or(base.variety),
            silhouettes,
            ..*base
        }
    }

    /// How a part takes light and strokes, where this is said of one that takes them as `base`. Turns and shifts are added,
    /// scales multiplied.
    #[must_use]
    pub fn material(&self, base: &Material) -> Material {
        let specular = self.specular.unwrap_or(Specular { strength: base.specular, shininess: base.shininess });
        let [ambient, diffuse] = self.lit.unwrap_or([base.ambient, base.diffuse]);
        Material {
            colour: self.colour.map_or(base.colour, |colour| colour.0),
            ambient,
            diffuse,
            specular: specular.strength,
            shininess: specular.shininess,
            rotation_deg: base.rotation_deg + self.rotate_deg.unwrap_or(0.0),
            scale: base.scale * self.scale.unwrap_or(1.0),
            shift: base.shift + self.shift.unwrap_or(DVec2::ZERO),
            map: base.map,
        }
    }

    /// Whether it is seen.
    pub fn is_visible(&self) -> bool {
        self.visible.unwrap_or(true)
    }

    pub(super) fn paths_mut(&mut self) -> impl Iterator<Item = &mut PathBuf> {
        let guides = match &mut self.field {
            Some(FieldEntry::Guides(path)) => Some(path),
            _ => None,
        };
        self.map.iter_mut().chain(guides).chain(&mut self.guides)
    }
}

fn joined<T: Copy>(own: Option<T>, base: Option<T>, join: fn(T, T) -> T) -> Option<T> {
    match (own, base) {
        (Some(own), Some(base)) => Some(join(own, base)),
        (own, base) => own.or(base),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_word_is_read_as_it_is_written() {
        let mut look = LookEntry::default();
        let values = [
            ("method", "stripes"),
            ("mapping", "patches"),
            ("form", "literal"),
            ("blend", "linear"),
            ("map", "./a map.ktx2"),
            ("tiles", "2.5"),
            ("rotate", "-30"),
            ("scale", "0.5"),
            ("shift", "0.25,-0.5"),
            ("level-bias", "-1"),
            ("slope", "4"),
            ("line-period", "5"),
            ("cross", "none"),
            ("variety", "0.75"),
            ("lines", "1.5"),
            ("crease", "none"),
            ("contours", "false"),
            ("borders", "true"),
            ("field", "guides:strokes.json"),
            ("guides", "more.json"),
            ("smoothing", "2"),
            ("stripes", "6"),
            ("follow", "light"),
            ("planar", "true"),
            ("ink", "#123456"),
            ("colour", "0.1,0.2,0.3"),
            ("specular", "0.5,40"),
            ("lit", "0.5,1"),
            ("visible", "false"),
        ];
        assert_eq!(values.len(), LookEntry::WORDS.len());
        for (name, text) in values {
            look.set(name, text).expect("it makes sense");
        }
        let written: Vec<(&str, String)> = look.given().map(|(name, given)| (name, given.to_string())).collect();
        assert_eq!(written, values.map(|(name, text)| (name, text.to_owned())));
        let mut again = LookEntry::default();
        for (name, text) in &written {
            again.set(name, text).expect("what was written");
        }
        assert_eq!(again, look);
        assert_eq!(again.over(&LookEntry::default()), look);
        assert_eq!(LookEntry::default().over(&look), look);
    }

    #[test]
    fn turns_add_and_scales_multiply() {
        let base = LookEntry { rotate_deg: Some(10.0), scale: Some(2.0), tiles: Some(3.0), ..LookEntry::default() };
        let own = LookEntry { rotate_deg: Some(20.0), scale: Some(2.0), tiles: Some(4.0), ..LookEntry::default() };
        let both = own.over(&base);
        assert_eq!((both.rotate_deg, both.scale, both.tiles), (Some(30.0), Some(4.0), Some(4.0)));
    }

    #[test]
    fn names_stand_as_the_library_has_them() {
        assert_eq!(METHODS, Method::ALL.map(Method::name));
        assert_eq!(MappingEntry::NAMES[1..], Mapping::ALL.map(Mapping::name));
        for (word, wrong) in [("method", "phon"), ("blend", "unison"), ("follow", "surfaces"), ("mapping", "patch")] {
            let problem = LookEntry::default().set(word, wrong).expect_err("no such name");
            assert!(problem.contains("did you mean"), "{problem}");
        }
        let problem = LookEntry::default().set("rotat", "3").expect_err("no such word");
        assert!(problem.contains("`rotate`"), "{problem}");
    }
}
