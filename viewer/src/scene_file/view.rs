//! What a scene file says of camera, lights and paper.

use glam::DVec3;

use super::value::{self, Colour, Deformed, Orbit};
use super::word::{Given, Kind, Word, name_of, named, switch};
use crate::ranges;
use crate::scene::{Camera as SceneCamera, Light, Lights, Projection, Scene};

/// Where a scene is seen from, as it was asked for.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Camera {
    /// Direction, and distance where one was given; `None`: as by default.
    pub orbit: Option<Orbit>,
    /// What it looks at; `None`: the middle of what is seen.
    pub target: Option<DVec3>,
    /// Vertical opening in degrees.
    pub field_of_view_deg: Option<f64>,
    /// Turn about the line of sight in degrees.
    pub roll_deg: Option<f64>,
    /// How lines of sight run.
    pub projection: Option<Projection>,
}

impl Camera {
    /// Whether it is left to find its own distance.
    pub fn fits_distance(&self) -> bool {
        self.orbit.is_none_or(|orbit| orbit.distance.is_none())
    }

    /// A camera in words.
    pub fn of(camera: &SceneCamera) -> Self {
        let SceneCamera { azimuth_deg, elevation_deg, distance, target, field_of_view_deg, roll_deg, projection } =
            *camera;
        Self {
            orbit: Some(Orbit { azimuth_deg, elevation_deg, distance: Some(distance) }),
            target: Some(target),
            field_of_view_deg: Some(field_of_view_deg),
            roll_deg: (roll_deg != 0.0).then_some(roll_deg),
            projection: (projection != Projection::Perspective).then_some(projection),
        }
    }

    /// Changes what was asked for; what was not stays.
    pub fn apply(&self, camera: &mut SceneCamera) {
        if let Some(Orbit { azimuth_deg, elevation_deg, distance }) = self.orbit {
            (camera.azimuth_deg, camera.elevation_deg) = (azimuth_deg, elevation_deg);
            camera.distance = distance.unwrap_or(camera.distance);
        }
        camera.target = self.target.unwrap_or(camera.target);
        camera.field_of_view_deg = self.field_of_view_deg.unwrap_or(camera.field_of_view_deg);
        camera.roll_deg = self.roll_deg.unwrap_or(0.0);
        camera.projection = self.projection.unwrap_or_default();
    }

    fn over(&self, base: &Self) -> Self {
        Self {
            orbit: self.orbit.or(base.orbit),
            target: self.target.or(base.target),
            field_of_view_deg: self.field_of_view_deg.or(base.field_of_view_deg),
            roll_deg: self.roll_deg.or(base.roll_deg),
            projection: self.projection.or(base.projection),
        }
    }
}

/// Camera, lights, paper and movement in words; `None`: by default.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct ViewEntry {
    /// Where it is seen from.
    pub camera: Camera,
    /// Lights; none: as by default.
    pub lights: Vec<Light>,
    /// Light from everywhere.
    pub ambient: Option<f64>,
    /// Colour of the paper; `None`: that of the map's preset.
    pub paper: Option<Colour>,
    /// Leave out the paper around the objects.
    pub transparent: Option<bool>,
    /// Time of the files' animations, in seconds.
    pub time_s: Option<f64>,
    /// A deformation of all meshes.
    pub deform: Option<Deformed>,
    /// Leave out the colours of the meshes.
    pub plain: Option<bool>,
}

impl ViewEntry {
    /// All words but lights, of which there may be several.
    pub const WORDS: &[Word<Self>] = &[
        Word {
            name: "camera",
            kind: Kind::Numbers("AZ,EL[,DIST], or front, back, left, right, top, bottom[,DIST]"),
            about: "Azimuth and elevation in degrees, or a look along an axis, and the distance",
            set: |view, text| value::orbit(text).map(|orbit| view.camera.orbit = Some(orbit)),
            get: |view| {
                let Orbit { azimuth_deg, elevation_deg, distance } = view.camera.orbit?;
                Some(Given::Numbers([azimuth_deg, elevation_deg].into_iter().chain(distance).collect()))
            },
        },
        Word {
            name: "target",
            kind: Kind::Numbers("X,Y,Z"),
            about: "What the camera looks at",
            set: |view, text| value::point(text).map(|target| view.camera.target = Some(target)),
            get: |view| view.camera.target.map(|target| Given::Numbers(target.to_array().to_vec())),
        },
        Word {
            name: "fov",
            kind: Kind::Number(ranges::FIELD_OF_VIEW_DEG),
            about: "Vertical opening in degrees",
            set: |view, text| {
                let opening = value::number(text, ranges::FIELD_OF_VIEW_DEG)?;
                view.camera.field_of_view_deg = Some(opening);
                Ok(())
            },
            get: |view| view.camera.field_of_view_deg.map(Given::Number),
        },
        Word {
            name: "roll",
            kind: Kind::Number(ranges::AZIMUTH_DEG),
            about: "Turn about the line of sight; what is seen turns counter-clockwise",
            set: |view, text| value::number(text, ranges::AZIMUTH_DEG).map(|roll| view.camera.roll_deg = Some(roll)),
            get: |view| view.camera.roll_deg.map(Given::Number),
        },
        Word {
            name: "projection",
            kind: Kind::Name(&PROJECTIONS),
            about: "Whether lines of sight meet in the camera, or are parallel",
            set: |view, text| {
                named("projection", text, &PROJECTIONS).map(|projection| view.camera.projection = Some(projection))
            },
            get: |view| view.camera.projection.as_ref().map(name_of),
        },
        Word {
            name: "ambient",
            kind: Kind::Number(ranges::SHARE),
            about: "Light from everywhere",
            set: |view, text| value::number(text, ranges::SHARE).map(|share| view.ambient = Some(share)),
            get: |view| view.ambient.map(Given::Number),
        },
        Word {
            name: "paper",
            kind: Kind::Colour,
            about: "Colour of the paper; that of the map's preset where nothing is said",
            set: |view, text| value::colour(text).map(|colour| view.paper = Some(colour)),
            get: |view| view.paper.as_ref().map(value::written_colour),
        },
        Word {
            name: "transparent",
            kind: Kind::Switch,
            about: "Leave out the paper around the objects",
            set: |view, text| switch(text).map(|on| view.transparent = Some(on)),
            get: |view| view.transparent.map(Given::Switch),
        },
        Word {
            name: "colours",
            kind: Kind::Name(&COLOURS),
            about: "Colours under the strokes: none, or the mesh's own",
            set: |view, text| match COLOURS.iter().position(|name| *name == text) {
                Some(index) => {
                    view.plain = Some(index == 0);
                    Ok(())
                }
                None => Err(value::unknown("kind of colours", text, COLOURS)),
            },
            get: |view| view.plain.map(|plain| Given::Text(COLOURS[usize::from(!plain)].into())),
        },
        Word {
            name: "time",
            kind: Kind::Number(ranges::TIME_S),
            about: "Time of the files' animations",
            set: |view, text| value::number(text, ranges::TIME_S).map(|time_s| view.time_s = Some(time_s)),
            get: |view| view.time_s.map(Given::Number),
        },
        Word {
            name: "deform",
            kind: Kind::Text("NAME[,PHASE]: twist, wave or breathe, at a phase in periods"),
            about: "Deform all meshes",
            set: |view, text| value::deformed(text).map(|deformed| view.deform = Some(deformed)),
            get: |view| view.deform.map(|Deformed { deform, phase }| Given::Text(format!("{},{phase}", deform.name()))),
        },
    ];

    /// Colours of meshes that say nothing of it.
    pub fn colour_of(&self, part: [f32; 3]) -> [f32; 3] {
        if self.plain == Some(true) { [1.0; 3] } else { part }
    }

    /// What was said, word by word.
    pub fn given(&self) -> impl Iterator<Item = (&'static str, Given)> {
        Self::WORDS.iter().filter_map(|word| Some((word.name, (word.get)(self)?)))
    }

    /// This view, and what it leaves open as `base` says.
    #[must_use]
    pub fn over(&self, base: &Self) -> Self {
        Self {
            camera: self.camera.over(&base.camera),
            lights: if self.lights.is_empty() { base.lights.clone() } else { self.lights.clone() },
            ambient: self.ambient.or(base.ambient),
            paper: self.paper.or(base.paper),
            transparent: self.transparent.or(base.transparent),
            time_s: self.time_s.or(base.time_s),
            deform: self.deform.or(base.deform),
            plain: self.plain.or(base.plain),
        }
    }

    /// The scene, with the camera's place still to be found; `colours` are paper and ink of the map's preset.
    pub fn scene(&self, colours: Option<([f32; 3], [f32; 3])>) -> Scene {
        let mut scene = Scene::default();
        if let Some((paper, ink)) = colours {
            (scene.paper, scene.ink) = (paper, ink);
        }
        scene.paper = self.paper.map_or(scene.paper, |paper| paper.0);
        scene.transparent = self.transparent.unwrap_or(false);
        let lights: &mut Lights = &mut scene.lights;
        if !self.lights.is_empty() {
            lights.lights.clone_from(&self.lights);
        }
        lights.ambient = self.ambient.unwrap_or(lights.ambient);
        self.camera.apply(&mut scene.camera);
        scene
    }
}

const PROJECTIONS: [&str; 2] = ["perspective", "orthographic"];
const COLOURS: [&str; 2] = ["none", "mesh"];
