//! Frames that are anchored in one place for the whole mesh.

use glam::DVec3;

use super::case::{Case, Hardened, Limit, Literal, Side, StabilityError};
use super::shapes::{light_from, sample, scene_with};
use super::stand::{Stand, both, drawn_by};
use crate::chart::one_family;
use crate::maps::HatchMap;
use crate::measure::{Aov, Strokes, direction, ink, tone};
use crate::mesh::sample::Sample;
use crate::params::{Mapping, Method, RenderParams};
use crate::surface::{FieldOptions, FieldSource, Surface, SurfaceOptions};

pub(super) const CASES: [Case; 2] = [
    Case {
        name: "strokes on a fine mesh",
        method: "face-frame",
        failure: "The place in the tile is a dot product with the frame of the face: from face to face the strokes are \
                  turned about the origin, not about themselves, and swirl with no regard to light or form.",
        figure: "mean angle between strokes and their wanted direction, ring of 60 000 triangles (°)",
        literal: Literal::Fails(Limit::Above(15.0)),
        hardened: Hardened::StillFails(
            "nothing cures it within the method: the anchor would have to be larger than a stroke and independent of the \
             mesh. That is a patch: use --mapping patches.",
        ),
        holds: Limit::Below(9.0),
        reason: "Strokes by the uv of a sphere are off by 6° at most, patches on a hand by 5°; strokes by chance by 45°.",
        run: swirl,
    },
    Case {
        name: "lines on frames of faces",
        method: "halftone, frames",
        failure: "The ramp is one-sided, so lines are too thin; and a ramp as wide as the change to the neighbours on the \
                  screen is wrong where these lie on other faces, with lines of their own.",
        figure: "error of tone on a ring, RMS (L*)",
        literal: Literal::Fails(Limit::Above(2.0)),
        hardened: Hardened::Holds,
        holds: Limit::Below(1.0),
        reason: "The same lines laid from three planes err by 0.3 to 0.4.",
        run: dark_lines,
    },
];

const SIDE: u32 = 256;

fn swirl(stand: &mut Stand) -> Result<[Side; 2], StabilityError> {
    let to_light = DVec3::new(1.0, 2.0, 1.0);
    let mesh = sample(Sample::Torus, 60_000)?;
    let field = FieldOptions { source: FieldSource::Light(to_light), ..FieldOptions::default() };
    let surface = Surface::new(&mesh, &SurfaceOptions { field, ..SurfaceOptions::default() })?;
    let mut scene = scene_with(light_from(to_light));
    scene.lights.ambient = 0.3;
    scene.camera.elevation_deg = 40.0;
    let strokes = Strokes { graph: &surface.graph, field: &surface.field };
    let aov = Aov::new(&mesh, &scene, [SIDE; 2], Some(strokes))?;
    let mut stage = stand.stage_with("one family", SIDE, || {
        let preset = one_family(&super::stand::preset("fine-pen")?);
        Ok(HatchMap::from_preset("one family", &preset, &tam_gen::Job::default())?)
    })?;
    both(|form| {
        let params = drawn_by(Method::FaceFrame, form);
        let ink = ink(&stage.draw((&scene, &params, &mesh))?, &aov, &mesh, &scene);
        let off = direction(&ink, &aov, 2.0).mean_deg.ok_or(StabilityError::Nothing("no strokes"))?;
        stage.side_of(off, &[(&scene, &params, &mesh)])
    })
}

fn dark_lines(stand: &mut Stand) -> Result<[Side; 2], StabilityError> {
    let mesh = sample(Sample::Torus, 3_000)?;
    let mut scene = scene_with(light_from(DVec3::new(1.0, 2.0, 1.0)));
    scene.lights.ambient = 0.3;
    scene.camera.elevation_deg = 30.0;
    let aov = Aov::new(&mesh, &scene, [SIDE; 2], None)?;
    let mut stage = stand.stage_of("fine-pen", SIDE)?;
    both(|form| {
        let params = RenderParams { mapping: Mapping::Frames, ..drawn_by(Method::Halftone, form) };
        let ink = ink(&stage.draw((&scene, &params, &mesh))?, &aov, &mesh, &scene);
        let found = tone(&ink, &aov, 20.0).ok_or(StabilityError::Nothing("no tone"))?;
        stage.side_of(found.lightness.rmse, &[(&scene, &params, &mesh)])
    })
}
