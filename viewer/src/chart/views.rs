//! The views that every way is drawn into, and what is wanted there.

use glam::DQuat;

use crate::measure::{Aov, Strokes, Track};
use crate::mesh::Mesh;
use crate::reference::ReferenceError;
use crate::scene::{LightKind, Scene};

/// Turn of the camera between the two frames of the orbit.
const ORBIT_DEG: f64 = 2.0;
/// Magnification of a short zoom, in which strokes stay what they are.
const NEARER: f64 = 1.05;
/// Magnification of a zoom through a whole level of detail.
pub(super) const ZOOM: f64 = 2.0;
/// Turn of the lights over the whole sweep.
const SWEEP_DEG: f64 = 1.0;
/// Steps of the sweep are halved so often.
pub(super) const HALVINGS: u32 = 3;

/// A scene and what is wanted at each of its pixels.
#[derive(Clone, Debug)]
pub(super) struct View {
    pub(super) scene: Scene,
    pub(super) aov: Aov,
}

/// A scene standing still, turned, nearer, and under a light that turns.
#[derive(Clone, Debug)]
pub struct Views {
    pub(super) still: View,
    pub(super) turned: View,
    pub(super) nearer: View,
    pub(super) zoomed: View,
    /// The scene under each light of the sweep, the still one first.
    pub(super) sweep: Vec<Scene>,
    /// What is wanted at its end.
    pub(super) swept: Aov,
    pub(super) to_turned: Track,
    pub(super) to_nearer: Track,
    pub(super) to_zoomed: Track,
    pub(super) from_zoomed: Track,
    pub(super) stay: Track,
}

impl Views {
    /// The views of a scene, in pictures of this size. Zooms are those of a lens: the camera stays where it is, so that
    /// they show the same surfaces.
    ///
    /// # Errors
    /// As [`Aov::new`].
    pub fn new(
        mesh: &Mesh,
        scene: &Scene,
        size: [u32; 2],
        strokes: Option<Strokes<'_>>,
    ) -> Result<Self, ReferenceError> {
        let view = |scene: Scene| Ok::<_, ReferenceError>(View { aov: Aov::new(mesh, &scene, size, strokes)?, scene });
        let still = view(scene.clone())?;
        let mut orbit = scene.clone();
        orbit.camera.azimuth_deg += ORBIT_DEG;
        let (turned, nearer, zoomed) = (view(orbit)?, view(magnified(scene, NEARER))?, view(magnified(scene, ZOOM))?);
        let steps = 1 << HALVINGS;
        let sweep = (0..=steps).map(|step| relit(scene, SWEEP_DEG * f64::from(step) / f64::from(steps))).collect();
        let swept = view(relit(scene, SWEEP_DEG))?.aov;
        let track = |from: &View, to: &View| Track::new(&from.aov, &to.aov, mesh, &to.scene);
        Ok(Self {
            sweep,
            swept,
            to_turned: track(&still, &turned),
            to_nearer: track(&still, &nearer),
            to_zoomed: track(&still, &zoomed),
            from_zoomed: track(&zoomed, &still),
            stay: Track::still(&still.aov),
            still,
            turned,
            nearer,
            zoomed,
        })
    }

    /// Width and height of the pictures.
    pub fn size_px(&self) -> [u32; 2] {
        self.still.aov.size
    }

    /// The scene that stands still.
    pub fn scene(&self) -> &Scene {
        &self.still.scene
    }
}

/// The scene through a lens of so many times the focal length.
fn magnified(scene: &Scene, factor: f64) -> Scene {
    let mut scene = scene.clone();
    let half = 0.5 * scene.camera.field_of_view_deg.to_radians();
    scene.camera.field_of_view_deg = 2.0 * (half.tan() / factor).atan().to_degrees();
    scene
}

/// The scene with its lights turned about the upright axis through what the camera looks at.
pub(crate) fn relit(scene: &Scene, turn_deg: f64) -> Scene {
    let mut scene = scene.clone();
    let turn = DQuat::from_rotation_y(turn_deg.to_radians());
    let about = scene.camera.target;
    for light in &mut scene.lights.lights {
        match &mut light.kind {
            LightKind::Directional { direction } => *direction = turn * *direction,
            LightKind::Positional { position } => *position = about + turn * (*position - about),
            LightKind::Spot { position, direction, .. } => {
                *position = about + turn * (*position - about);
                *direction = turn * *direction;
            }
        }
    }
    scene
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::prepare;
    use crate::mesh::sample::Sample;

    #[test]
    fn a_zoom_moves_points_away_from_the_middle_by_its_factor() {
        let mesh = prepare(Sample::Sphere.build(2_000)).expect("a sphere").mesh;
        let views = Views::new(&mesh, &Scene::of(&mesh), [96, 64], None).expect("a view");
        let middle = glam::DVec2::new(48.0, 32.0);
        let mut followed = 0;
        for (i, place) in views.to_zoomed.places_px.iter().enumerate() {
            let Some(place) = place else { continue };
            followed += 1;
            let from = glam::DVec2::new((i % 96) as f64, (i / 96) as f64) + 0.5 - middle;
            assert!((*place - middle - from * ZOOM).length() < 0.01, "{place} from {from}");
        }
        assert!(followed > 200, "{followed} points");
    }

    #[test]
    fn the_sweep_turns_every_kind_of_light_by_a_degree() {
        let mut scene = Scene::default();
        scene.lights.lights.push(crate::Light::at(glam::DVec3::new(2.0, 1.0, 0.0)));
        let lit = relit(&scene, SWEEP_DEG);
        let angle = |kind: LightKind| match kind {
            LightKind::Directional { direction } => direction.x.atan2(direction.z),
            LightKind::Positional { position } | LightKind::Spot { position, .. } => position.x.atan2(position.z),
        };
        for (before, after) in scene.lights.lights.iter().zip(&lit.lights.lights) {
            let turned = (angle(after.kind) - angle(before.kind)).to_degrees();
            assert!((turned - 1.0).abs() < 1e-9, "{turned}");
        }
    }
}
