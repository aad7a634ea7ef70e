//! Levels of detail: slanted surfaces, and zooms through all levels and beyond both ends.

use glam::dvec3;
use tam_gen::preset::PlacementMethod;
use tam_gen::{Job, Map, Preset, generate};

use super::case::{Case, Hardened, Limit, Literal, Side, StabilityError};
use super::figures::{difference, nan_count};
use super::shapes::{dim, even, light_from, sample};
use super::stand::{Stand, both, drawn_by, face_frame};
use crate::maps::HatchMap;
use crate::measure::{Aov, Track, ink, stroke_width, width_constancy, zoom};
use crate::mesh::prepare;
use crate::mesh::sample::Sample;
use crate::params::{Form, Mapping, Method, RenderParams};
use crate::scene::Scene;

pub(super) const CASES: [Case; 4] = [
    Case {
        name: "grazing views",
        method: "face-frame",
        failure: "The level follows the depth alone: on a surface seen from the side neighbouring pixels skip texels, and \
                  a small move of the camera changes them at random.",
        figure: "mean change of ink over 0.3° of orbit, plate seen at 8°",
        literal: Literal::Fails(Limit::Above(0.03)),
        hardened: Hardened::Holds,
        holds: Limit::Below(0.0225),
        reason: "Three quarters of the least that counts as failing: what is left is the motion of the strokes themselves.",
        run: grazing,
    },
    Case {
        name: "width of lines in a zoom",
        method: "halftone",
        failure: "Lines are fixed to the surface: they grow with it from fine hatching to broad bars.",
        figure: "d log width / d log zoom, over a zoom by 4",
        literal: Literal::Fails(Limit::Above(0.8)),
        hardened: Hardened::Holds,
        holds: Limit::Below(0.2),
        reason: "1 is fixed to the surface, 0 constant on the screen; within a doubling widths vary by half an octave, \
                 which a fit over two of them sees as up to a tenth.",
        run: line_width,
    },
    Case {
        name: "zoom through all levels and beyond both ends",
        method: "all with maps",
        failure: "Levels that do not exist are asked for.",
        figure: "pixels that are no number, over distances from 0.01 to 10 000",
        literal: Literal::Holds("both forms clamp the level; beyond the finest, strokes grow as in any texture"),
        hardened: Hardened::Holds,
        holds: Limit::Below(1.0),
        reason: "A level outside the map has no texel to read: whole pictures would be lost.",
        run: far_and_near,
    },
    Case {
        name: "strokes that die in a zoom",
        method: "levels of maps",
        failure: "Levels are drawn each by itself: while the view comes nearer, strokes fade and others appear elsewhere.",
        figure: "share of the far view's strokes of which nothing is left twice as near",
        literal: Literal::Fails(Limit::Above(0.1)),
        hardened: Hardened::Holds,
        holds: Limit::Below(1e-6),
        reason: "Unrelated strokes meet by chance alone, and two in five are lost. Nested ones are all there in the finer level: not \
                 one pixel is lost.",
        run: deaths,
    },
];

fn grazing(stand: &mut Stand) -> Result<[Side; 2], StabilityError> {
    // A thin plate: closed, so that every face has neighbours, and hardly more than its top is seen.
    let mut cube = Sample::Cube.build(1200);
    cube.positions.iter_mut().for_each(|position| position.y *= 0.02);
    let mesh = prepare(cube)?.mesh;
    let mut stage = stand.stage()?;
    let scenes = [0.0, 0.3].map(|azimuth_deg| {
        let mut scene = dim(light_from(dvec3(0.9, 0.1, 0.4)));
        scene.camera.distance = 3.0;
        scene.camera.azimuth_deg = azimuth_deg;
        scene.camera.elevation_deg = 8.0;
        scene
    });
    both(|form| {
        let params = RenderParams { tiles_per_unit: 6.0, ..face_frame(form) };
        let views = scenes.each_ref().map(|scene| (scene, &params, &mesh));
        let figure = difference(&stage.draw(views[0])?, &stage.draw(views[1])?);
        stage.side_of(figure, &views[..1])
    })
}

fn line_width(stand: &mut Stand) -> Result<[Side; 2], StabilityError> {
    let mesh = sample(Sample::Quad, 2)?;
    let mut stage = stand.stage_of("fine-pen", 256)?;
    let zooms = [1.0, 2.0_f64.sqrt(), 2.0, 8.0_f64.sqrt(), 4.0];
    let near = |zoom: f64| {
        let mut scene = even(0.35);
        scene.camera.distance = 2.0 / zoom;
        scene
    };
    both(|form| {
        let params = RenderParams { mapping: Mapping::Uv, tiles_per_unit: 0.5, ..drawn_by(Method::Halftone, form) };
        let mut widths = Vec::new();
        for zoom in zooms {
            let scene = near(zoom);
            let aov = Aov::new(&mesh, &scene, [stage.side(); 2], None)?;
            let pixels = stage.draw((&scene, &params, &mesh))?;
            let width = stroke_width(&ink(&pixels, &aov, &mesh, &scene), &aov, 2.0);
            widths.push((zoom, width.median_px.ok_or(StabilityError::Nothing("no lines"))?));
        }
        let slope = width_constancy(&widths).ok_or(StabilityError::Nothing("no widths"))?;
        stage.side_of(slope.abs(), &[(&near(1.0), &params, &mesh), (&near(4.0), &params, &mesh)])
    })
}

fn far_and_near(stand: &mut Stand) -> Result<[Side; 2], StabilityError> {
    let mesh = sample(Sample::Torus, 800)?;
    let mut stage = stand.stage()?;
    let uploaded = stage.upload(&mesh)?;
    let near = |distance: f64| {
        let mut scene = dim(light_from(dvec3(0.5, 0.3, 1.0)));
        // Towards the skin of the ring, which the camera never enters.
        scene.camera.target.y = 0.7;
        scene.camera.distance = distance + 0.35;
        scene
    };
    both(|form| {
        let mut broken = 0;
        for method in [Method::SixWay, Method::FaceFrame, Method::StrokeMap, Method::Halftone, Method::FineTone] {
            let params = drawn_by(method, form);
            for distance in [0.01, 0.1, 1.0, 10.0, 100.0, 1e3, 1e4] {
                broken += nan_count(&stage.draw_uploaded(&near(distance), &params, &uploaded)?);
            }
        }
        let params = drawn_by(Method::FineTone, form);
        stage.side_of(broken as f64, &[(&near(0.1), &params, &mesh), (&near(10.0), &params, &mesh)])
    })
}

/// Short strokes of full ink, so that many are born and each is clear.
const PEN: &str = r#"
schedule = ["a"]

[map]
size = 256
coarsest = 16
tones = 8

[stroke]
length_min = 0.15
length_max = 0.3
width_px = 2.0

[families]
a = { angle_deg = 0 }
"#;

fn pen(change: impl FnOnce(&mut Preset)) -> Result<Map, StabilityError> {
    let mut preset = Preset::from_toml(PEN, "pen").map_err(|_| StabilityError::Preset("pen".into()))?;
    change(&mut preset);
    Ok(generate(&preset, &Job::default())?)
}

/// Strokes by chance, drawn anew for each level.
fn unrelated() -> Result<Map, StabilityError> {
    let by_chance = |seed: u64| {
        pen(|preset| {
            preset.placement.method = PlacementMethod::Random;
            preset.seed = seed;
        })
    };
    let mut map = by_chance(100)?;
    for level in 1..map.grid.levels.len() {
        map.grid.levels[level] = by_chance(100 + level as u64)?.grid.levels[level].clone();
    }
    Ok(map)
}

fn deaths(stand: &mut Stand) -> Result<[Side; 2], StabilityError> {
    let mesh = sample(Sample::Quad, 2)?;
    let near = |distance: f64| -> Scene {
        // The tone of the lightest column.
        let mut scene = even(0.125);
        scene.camera.distance = distance;
        scene
    };
    both(|form| {
        let mut stage = match form {
            Form::Literal => stand.stage_with("unrelated pen", 256, || Ok(HatchMap::from_map("pen", &unrelated()?)))?,
            Form::Hardened => stand.stage_with("nested pen", 256, || Ok(HatchMap::from_map("pen", &pen(|_| ())?)))?,
        };
        let params =
            RenderParams { mapping: Mapping::Uv, tiles_per_unit: 2.0, ..drawn_by(Method::SixWay, Form::Hardened) };
        let [far, near] = [near(8.0), near(4.0)];
        let [from, to] = [Aov::new(&mesh, &far, [256; 2], None)?, Aov::new(&mesh, &near, [256; 2], None)?];
        let inks = [
            ink(&stage.draw((&far, &params, &mesh))?, &from, &mesh, &far),
            ink(&stage.draw((&near, &params, &mesh))?, &to, &mesh, &near),
        ];
        let tracks = [Track::new(&from, &to, &mesh, &near), Track::new(&to, &from, &mesh, &far)];
        let found = zoom([&inks[0], &inks[1]], [&from, &to], [&tracks[0], &tracks[1]], [3.0, 1.0], 16.0);
        let figure = found.ok_or(StabilityError::Nothing("no strokes"))?.deaths;
        stage.side_of(figure, &[(&far, &params, &mesh), (&near, &params, &mesh)])
    })
}
