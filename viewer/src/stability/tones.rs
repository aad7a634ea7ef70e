//! Tones between columns, in the middle, and at both ends.

use glam::{DVec3, dvec3};

use super::case::{Case, Hardened, Limit, Literal, Side, StabilityError};
use super::figures::{difference, mean_ink};
use super::shapes::{light_from, sample, scene_with};
use super::stand::{Stage, Stand, View, both, drawn_by, face_frame};
use crate::mesh::Mesh;
use crate::mesh::sample::Sample;
use crate::params::{Form, Mapping, Method, RenderParams};
use crate::scene::Scene;

pub(super) const CASES: [Case; 4] = [
    Case {
        name: "tone that passes from column to column",
        method: "face-frame",
        failure: "The nearest column is drawn: at the tone in the middle between two, all strokes of the darker one pop \
                  up at once.",
        figure: "mean change of ink, darkness 10⁻⁵ on either side of the middle between two columns",
        literal: Literal::Fails(Limit::Above(0.03)),
        hardened: Hardened::Holds,
        holds: Limit::Below(1e-3),
        reason: "The columns of this map lie a sixth apart in ink; a step of 2·10⁻⁵ in darkness changes the ink as little.",
        run: rounded_column,
    },
    Case {
        name: "mid-tones of a stroke map",
        method: "stroke-map",
        failure: "The ramp of the threshold lies wholly on one side: mid-tones lose half a ramp.",
        figure: "error of the mean ink at darkness ½, slope 6",
        literal: Literal::Fails(Limit::Above(0.05)),
        hardened: Hardened::Holds,
        holds: Limit::Below(0.03),
        reason: "Half a ramp of slope 6 is 1/12; the map itself has a grain of some hundredths in a part of a tile.",
        run: |stand| ends(stand.stage_of("engraving", 256)?, Method::StrokeMap, 80..176, &[0.5]),
    },
    Case {
        name: "tones at and beside paper and ink: strokes",
        method: "stroke-map",
        failure: "A ramp on one side never reaches solid ink where thresholds are high.",
        figure: "greatest error of the mean ink at darkness 0, 10⁻⁴, 1 - 10⁻⁴ and 1",
        literal: Literal::Fails(Limit::Above(5e-3)),
        hardened: Hardened::Holds,
        holds: Limit::Below(1e-3),
        reason: "Five pixels of the 1024 that are measured stay white in ink that should be solid; 10⁻⁴ may round to \
                 nothing, which is an error of as much.",
        run: |stand| ends(stand.stage()?, Method::StrokeMap, 32..64, &ENDS),
    },
    Case {
        name: "tones at and beside paper and ink: lines",
        method: "halftone",
        failure: "The same ramp: between lines the threshold is 1, and ink never comes there.",
        figure: "greatest error of the mean ink at darkness 0, 10⁻⁴, 1 - 10⁻⁴ and 1",
        literal: Literal::Fails(Limit::Above(0.05)),
        hardened: Hardened::Holds,
        holds: Limit::Below(1e-3),
        reason: "Half a ramp of slope 6, 1/12, is missing at 1; 10⁻⁴ may round to nothing.",
        run: |stand| ends(stand.stage()?, Method::Halftone, 32..64, &ENDS),
    },
];

const ENDS: [f64; 4] = [0.0, 1e-4, 1.0 - 1e-4, 1.0];

fn rounded_column(stand: &mut Stand) -> Result<[Side; 2], StabilityError> {
    let mesh = sample(Sample::Cube, 1200)?;
    let mut stage = stand.stage()?;
    let middle = 2.5 / stage.columns() as f64;
    let scenes = [-1e-5, 1e-5].map(|step| {
        // The front face of a cube, lit from the front at a slant: its luminance is the diffuse reflectance times 0.8.
        let mut scene = scene_with(light_from(dvec3(0.6, 0.0, 0.8)));
        scene.materials[0].diffuse = (1.0 - middle - step) / 0.8;
        scene
    });
    both(|form| {
        let params = face_frame(form);
        let views = scenes.each_ref().map(|scene| (scene, &params, &mesh));
        let figure = difference(&stage.draw(views[0])?, &stage.draw(views[1])?);
        stage.side_of(figure, &views)
    })
}

/// The greatest error of a square's mean ink over some darknesses, and its picture where it is greatest.
fn ends(
    mut stage: Stage<'_>,
    method: Method,
    inside: std::ops::Range<usize>,
    darknesses: &[f64],
) -> Result<[Side; 2], StabilityError> {
    let mesh: Mesh = sample(Sample::Quad, 2)?;
    // Both forms are shown where the literal one is worst.
    let mut shown = None;
    both(|form: Form| {
        let params = RenderParams { mapping: Mapping::Triplanar, slope: 6.0, ..drawn_by(method, form) };
        let mut worst: (f64, Scene) = (0.0, scene_with(light_from(DVec3::Z)));
        for darkness in darknesses {
            let mut scene = scene_with(light_from(DVec3::Z));
            scene.materials[0].diffuse = 1.0 - darkness;
            let view: View<'_> = (&scene, &params, &mesh);
            let error = (mean_ink(&stage.draw(view)?, stage.side(), inside.clone()) - darkness).abs();
            // What is no number is the worst there is.
            if error.is_nan() || error >= worst.0 {
                worst = (error, scene);
            }
        }
        let scene = shown.get_or_insert(worst.1);
        stage.side_of(worst.0, &[(scene, &params, &mesh)])
    })
}
