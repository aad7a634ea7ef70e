//! Popping under a moving light, an orbit and a zoom.

use glam::{DVec3, dvec3};

use super::case::{Case, Hardened, Limit, Literal, Side, StabilityError};
use super::shapes::{even, light_from, sample, scene_with};
use super::stand::{SIDE, Stand, both, drawn_by};
use crate::measure::{Aov, Plane, Track, ink, largest_change, popping};
use crate::mesh::Mesh;
use crate::mesh::sample::Sample;
use crate::params::{Form, Mapping, Method, RenderParams};
use crate::scene::Scene;

const SLOPE: &str = "d log (greatest change of ink) / d log (step)";
const POPS: Limit = Limit::Below(0.3);
const CONTINUOUS: Limit = Limit::Above(0.9);
const SLOPES: &str = "Changes that are continuous shrink as the step, slope 1; a pop stays as large however short the step, \
                      slope 0. Steps of 1/8 to 1/32 of the span are compared.";

/// Of the methods whose tone lies between columns, or is a threshold.
const BY_DEGREES: Literal =
    Literal::Holds("the tone is between two columns, or strokes have a soft edge, in both forms");

pub(super) const CASES: [Case; 9] = [
    Case {
        name: "light sweep across a face's normal",
        method: "face-frame",
        failure: "The strokes of the face turn by half as the light passes.",
        figure: SLOPE,
        literal: Literal::Fails(POPS),
        hardened: Hardened::Holds,
        holds: CONTINUOUS,
        reason: SLOPES,
        run: |stand| swept(stand, 0.45, 0.013, -0.03),
    },
    Case {
        name: "light sweep away from the normals",
        method: "face-frame",
        failure: "The tone passes from one column to the next, and the whole face changes over.",
        figure: SLOPE,
        literal: Literal::Fails(POPS),
        hardened: Hardened::Holds,
        holds: CONTINUOUS,
        reason: SLOPES,
        run: |stand| swept(stand, 0.5053, 0.5, 0.02),
    },
    Case {
        name: "light sweep: six columns",
        method: "six-way",
        failure: "Strokes of the next column appear.",
        figure: SLOPE,
        literal: BY_DEGREES,
        hardened: Hardened::Holds,
        holds: CONTINUOUS,
        reason: SLOPES,
        run: |stand| relit(stand, Method::SixWay),
    },
    Case {
        name: "light sweep: many columns",
        method: "fine-tone",
        failure: "Strokes of the next column appear.",
        figure: SLOPE,
        literal: BY_DEGREES,
        hardened: Hardened::Holds,
        holds: CONTINUOUS,
        reason: SLOPES,
        run: |stand| relit(stand, Method::FineTone),
    },
    Case {
        name: "light sweep: thresholds",
        method: "stroke-map",
        failure: "A whole stroke passes its threshold.",
        figure: SLOPE,
        literal: BY_DEGREES,
        hardened: Hardened::Holds,
        holds: CONTINUOUS,
        reason: SLOPES,
        run: |stand| relit(stand, Method::StrokeMap),
    },
    Case {
        name: "light sweep: lines",
        method: "halftone",
        failure: "Lines widen.",
        figure: SLOPE,
        literal: BY_DEGREES,
        hardened: Hardened::Holds,
        holds: CONTINUOUS,
        reason: SLOPES,
        run: |stand| relit(stand, Method::Halftone),
    },
    Case {
        name: "orbit around a shining surface",
        method: "face-frame",
        failure: "The highlight moves, and the tone passes from one column to the next.",
        figure: SLOPE,
        literal: Literal::Fails(POPS),
        hardened: Hardened::Holds,
        holds: CONTINUOUS,
        reason: SLOPES,
        run: orbit,
    },
    Case {
        name: "zoom: levels of a map",
        method: "fine-tone",
        failure: "One level gives way to the next.",
        figure: SLOPE,
        literal: Literal::Holds("levels are mixed by the distance in both forms"),
        hardened: Hardened::Holds,
        holds: CONTINUOUS,
        reason: SLOPES,
        run: |stand| zoomed(stand, Method::FineTone, 3.97, 1.01),
    },
    Case {
        name: "zoom: lines that double",
        method: "halftone",
        failure: "New lines appear between the old ones as the view comes nearer.",
        figure: SLOPE,
        literal: Literal::Holds("lines as printed are fixed to the surface and never double"),
        hardened: Hardened::Holds,
        holds: CONTINUOUS,
        reason: SLOPES,
        run: |stand| zoomed(stand, Method::Halftone, 3.735, 1.002),
    },
];

/// Steps are halved so often; the longest ones are left out, as in them even continuous changes bend.
const HALVINGS: std::ops::RangeInclusive<u32> = 3..=5;

/// Samples along the side of a pixel where the surface moves: textures are read at steps of 1/256 of a texel, which single
/// samples would show as small pops.
const SMOOTH: u32 = 2;

/// Means of squares of so many pixels.
fn averaged(pixels: &[[f32; 4]], samples: u32) -> Vec<[f32; 4]> {
    let (side, samples) = ((SIDE * samples) as usize, samples as usize);
    let mean = |i: usize| {
        let (left, top) = (i % SIDE as usize * samples, i / SIDE as usize * samples);
        let of = |channel: usize| {
            let rows = (top..top + samples).flat_map(|y| &pixels[y * side + left..][..samples]);
            rows.map(|pixel| pixel[channel]).sum::<f32>() / (samples * samples) as f32
        };
        [0, 1, 2, 3].map(of)
    };
    (0..(SIDE * SIDE) as usize).map(mean).collect()
}

/// The slope of the greatest change over the step, in a scene that changes with t in 0 ..= 1, and its first and last frame.
fn film(
    stand: &mut Stand,
    samples: u32,
    mesh: &Mesh,
    params: impl Fn(Form) -> RenderParams,
    scene: impl Fn(f64) -> Scene,
) -> Result<[Side; 2], StabilityError> {
    let mut stage = stand.stage_of("fine-pen", SIDE * samples)?;
    let uploaded = stage.upload(mesh)?;
    let count = 1_usize << HALVINGS.end();
    let scenes: Vec<Scene> = (0..=count).map(|i| scene(i as f64 / count as f64)).collect();
    let aovs = scenes.iter().map(|scene| Aov::new(mesh, scene, [SIDE; 2], None)).collect::<Result<Vec<Aov>, _>>()?;
    both(|form| {
        let params = params(form);
        let mut inks: Vec<Plane> = Vec::new();
        for (scene, aov) in scenes.iter().zip(&aovs) {
            let pixels = averaged(&stage.draw_uploaded(scene, &params, &uploaded)?, samples);
            inks.push(ink(&pixels, aov, mesh, scene));
        }
        let changes = HALVINGS.map(|halving| {
            let stride = count >> halving;
            let change = |from: usize| {
                let to = from + stride;
                let track = Track::new(&aovs[from], &aovs[to], mesh, &scenes[to]);
                largest_change(&inks[from], &inks[to], &track, 4.0)
            };
            (stride as f64 / count as f64, (0..count).step_by(stride).map(change).fold(0.0, f64::max))
        });
        let found = popping(&changes.collect::<Vec<_>>()).ok_or(StabilityError::Nothing("nothing changes"))?;
        stage.side_of(found.slope, &[(&scenes[0], &params, mesh), (&scenes[count], &params, mesh)])
    })
}

/// A cube in front of a light that moves to the side, from x by so much.
fn swept(stand: &mut Stand, intensity: f64, from: f64, by: f64) -> Result<[Side; 2], StabilityError> {
    let mesh = sample(Sample::Cube, 1200)?;
    let lit = |t: f64| {
        let mut scene = scene_with(light_from(dvec3(from + by * t, 0.0, 1.0)));
        scene.lights.ambient = 0.3;
        scene.lights.lights[0].intensity = intensity;
        scene
    };
    film(stand, 1, &mesh, |form| drawn_by(Method::FaceFrame, form), lit)
}

/// A ring under a light that turns by half a degree.
fn relit(stand: &mut Stand, method: Method) -> Result<[Side; 2], StabilityError> {
    let mesh = sample(Sample::Torus, 3_000)?;
    let lit = |t: f64| {
        let angle_rad = 0.5_f64.to_radians() * t + 0.4;
        let mut scene = scene_with(light_from(dvec3(angle_rad.sin(), 0.6, angle_rad.cos())));
        scene.camera.elevation_deg = 35.0;
        scene
    };
    film(stand, 1, &mesh, |form| drawn_by(method, form), lit)
}

/// A long lens, so that the view is nearly the same all over the front of the cube, and a broad highlight.
fn orbit(stand: &mut Stand) -> Result<[Side; 2], StabilityError> {
    let mesh = sample(Sample::Cube, 1200)?;
    let turned = |t: f64| {
        let mut scene = scene_with(light_from(dvec3(-0.3, 0.0, 1.0)));
        scene.camera.target = DVec3::Z;
        scene.camera.field_of_view_deg = 1.0;
        scene.camera.distance = 100.0;
        scene.camera.azimuth_deg = 2.0 + 8.0 * t;
        scene.lights.ambient = 0.135;
        scene.materials[0].diffuse = 0.2;
        scene.materials[0].specular = 0.6;
        scene.materials[0].shininess = 24.0;
        scene
    };
    film(stand, 1, &mesh, |form| drawn_by(Method::FaceFrame, form), turned)
}

/// A square in even tone, from this distance to one that is so much nearer.
fn zoomed(stand: &mut Stand, method: Method, distance: f64, nearer: f64) -> Result<[Side; 2], StabilityError> {
    let mesh = sample(Sample::Quad, 2)?;
    let scene = |t: f64| {
        let mut scene = even(0.4);
        scene.camera.distance = distance / nearer.powf(t);
        scene
    };
    let params = |form| RenderParams { mapping: Mapping::Uv, tiles_per_unit: 1.0, ..drawn_by(method, form) };
    film(stand, SMOOTH, &mesh, params, scene)
}
