//! Lights that leave a face without a direction of strokes. Suarez and others (2013), algorithm 1: the projection of the
//! light on the face, normalised.

use glam::{DVec3, dvec3};

use super::case::{Case, Hardened, Limit, Literal, Side, StabilityError};
use super::figures::{difference, inked_count, nan_count};
use super::shapes::{dim, light_from, sample, scene_with};
use super::stand::{Stand, both, face_frame};
use crate::mesh::Mesh;
use crate::mesh::sample::Sample;
use crate::params::{Form, RenderParams};
use crate::scene::{Light, Scene};

pub(super) const CASES: [Case; 5] = [
    Case {
        name: "light on a face's normal",
        method: "face-frame",
        failure: "The projection of the light on the face vanishes, and its direction is 0 / 0: the strokes of the face \
                  are other ones than with the light a hair beside.",
        figure: "mean change of ink, light on the normal against 0.006° beside",
        literal: Literal::Fails(Limit::Above(0.05)),
        hardened: Hardened::Holds,
        holds: Limit::Below(1e-3),
        reason: "Strokes that stay change by the tone alone, below 10⁻⁴ here; unrelated strokes of this map by a tenth \
                 and more.",
        run: |stand| beside(stand, [light_from(DVec3::Z), light_from(dvec3(1e-4, 0.0, 1.0))]),
    },
    Case {
        name: "light that crosses a face's normal",
        method: "face-frame",
        failure: "The projection turns round, and the strokes of the face with it: by half a turn, at once.",
        figure: "mean change of ink, light 0.06° on either side of the normal",
        literal: Literal::Fails(Limit::Above(0.05)),
        hardened: Hardened::Holds,
        holds: Limit::Below(2e-3),
        reason: "A step of 0.11° changes the tone by less than 10⁻³; strokes turned by half are unrelated ones.",
        run: |stand| beside(stand, [light_from(dvec3(-1e-3, 0.0, 1.0)), light_from(dvec3(1e-3, 0.0, 1.0))]),
    },
    Case {
        name: "positional light above a face's centre",
        method: "face-frame",
        failure: "The light stands on the normal through the centre, where the frame of the face is taken: 0 / 0.",
        figure: "mean change of ink, light above the centre against 10⁻⁵ beside",
        literal: Literal::Fails(Limit::Above(0.05)),
        hardened: Hardened::Holds,
        holds: Limit::Below(1e-3),
        reason: "The tone does not change; unrelated strokes change by a tenth and more.",
        run: |stand| around_centre(stand, [0.0, 1e-5], 0.01),
    },
    Case {
        name: "positional light in a face's centre",
        method: "face-frame",
        failure: "The light has no direction at all from there: the vector to be projected is 0.",
        figure: "mean change of ink, light in the centre against 10⁻⁴ beside, along the face",
        literal: Literal::Fails(Limit::Above(0.05)),
        hardened: Hardened::StillFails(
            "a light within the face has a direction as soon as it leaves the centre, and another one on the other side: \
             no rule is continuous there. Nothing is drawn that is no number, and above the face nothing jumps.",
        ),
        holds: Limit::Below(1e-3),
        reason: "As for the light above the centre.",
        run: |stand| around_centre(stand, [0.0, 1e-4], 0.0),
    },
    Case {
        name: "light in the plane of a face",
        method: "face-frame",
        failure: "Light grazes the face: the projection is the light itself, and the face is dark.",
        figure: "inked pixels of a cube with its front face in the plane of the light",
        literal: Literal::Holds(
            "the projection is as long as it gets: only lights near the normal lose it. What is out of range beside the \
             right angle is a case of its own, below",
        ),
        hardened: Hardened::Holds,
        holds: Limit::Above(5000.0),
        reason: "The dark face fills three quarters of the 9216 pixels; one that is dropped or no number has none of them.",
        run: |stand| {
            let mesh = sample(Sample::Cube, FINE)?;
            let mut scene = scene_with(light_from(DVec3::X));
            scene.camera.azimuth_deg = 30.0;
            let mut stage = stand.stage()?;
            both(|form| {
                let params = face_frame(form);
                let figure = inked_count(&stage.draw((&scene, &params, &mesh))?);
                stage.side_of(figure, &[(&scene, &params, &mesh)])
            })
        },
    },
];

/// Triangles of a cube most of which lie beside others of the same plane: what fails at right angles is left out.
const FINE: usize = 1200;

/// How much the picture of a cube changes from one light to another. It is closed, so that every face has three
/// neighbours and only the light is at fault.
fn beside(stand: &mut Stand, lights: [Light; 2]) -> Result<[Side; 2], StabilityError> {
    let mesh = sample(Sample::Cube, FINE)?;
    changed(stand, &mesh, face_frame, lights.map(dim))
}

/// The same for lights at two places along x above the centre of a triangle in the middle of the cube's front, seen from
/// near.
fn around_centre(stand: &mut Stand, along: [f64; 2], above: f64) -> Result<[Side; 2], StabilityError> {
    let mesh = sample(Sample::Cube, FINE)?;
    let corners = mesh.triangles.iter().map(|t| t.map(|v| mesh.positions[v as usize].as_dvec3()));
    let centres = corners.map(|[a, b, c]| (a + b + c) / 3.0);
    let middle = centres.min_by(|a, b| a.distance(DVec3::Z).total_cmp(&b.distance(DVec3::Z)));
    let centre = middle.ok_or(StabilityError::Nothing("a cube has a front face"))?;
    let scenes = along.map(|x| {
        let mut scene = dim(Light::at(centre + dvec3(x, 0.0, above)));
        scene.camera.target = centre;
        scene.camera.distance = 0.12;
        scene
    });
    // Some strokes long and clear, as from half the usual distance.
    let params = |form| RenderParams { tiles_per_unit: 20.0, ..face_frame(form) };
    changed(stand, &mesh, params, scenes)
}

fn changed(
    stand: &mut Stand,
    mesh: &Mesh,
    params: impl Fn(Form) -> RenderParams,
    scenes: [Scene; 2],
) -> Result<[Side; 2], StabilityError> {
    let mut stage = stand.stage()?;
    both(|form| {
        let params = params(form);
        let views = scenes.each_ref().map(|scene| (scene, &params, mesh));
        let [at, beside] = [stage.draw(views[0])?, stage.draw(views[1])?];
        let broken = nan_count(&at) + nan_count(&beside);
        // What is no number does not hold; in the literal form it is left out, as the rest fails as well.
        let figure = if broken > 0 && form == Form::Hardened { f64::NAN } else { difference(&at, &beside) };
        stage.side_of(figure, &views)
    })
}
