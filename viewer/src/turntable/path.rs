//! What changes along a turntable.

use glam::Vec3;

use crate::mesh::Mesh;
use crate::mesh::deform::Deform;
use crate::scene::{Light, LightKind, Scene};

/// How much nearer the camera is in the middle of [`Path::Zoom`].
const ZOOM: f64 = 5.0;

/// A closed path: phase 1 is phase 0 again.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, serde::Serialize, serde::Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Path {
    /// The camera goes once around the mesh.
    Orbit,
    /// All lights go once around the vertical axis.
    Light,
    /// The camera comes to a fifth of its distance, and back.
    Zoom,
    /// The animation of the file, once.
    Animation,
    /// A deformation, once.
    Deform(Deform),
}

impl Path {
    /// The names of all paths on the command line.
    pub const NAMES: [&str; 5] = ["orbit", "light", "zoom", "animation", "deform"];

    /// Its name on the command line.
    pub fn name(self) -> &'static str {
        match self {
            Self::Orbit => "orbit",
            Self::Light => "light",
            Self::Zoom => "zoom",
            Self::Animation => "animation",
            Self::Deform(_) => "deform",
        }
    }

    /// The scene at a phase, in `0.0 ..= 1.0`; `start` is that of phase 0.
    pub fn scene(self, start: &Scene, phase: f64) -> Scene {
        let mut scene = start.clone();
        match self {
            Self::Orbit => scene.camera.azimuth_deg += 360.0 * phase,
            Self::Light => scene.lights.lights.iter_mut().for_each(|light| turn(light, phase)),
            // Even steps look even if they are steps of the logarithm; the cosine has no kink at either end.
            Self::Zoom => scene.camera.distance /= ZOOM.powf(0.5 - 0.5 * (std::f64::consts::TAU * phase).cos()),
            Self::Animation | Self::Deform(_) => {}
        }
        scene
    }

    /// Whether vertices move.
    pub fn moves_vertices(self) -> bool {
        matches!(self, Self::Animation | Self::Deform(_))
    }

    /// Positions of the vertices at a phase, into `out`; at rest where nothing moves them.
    pub fn positions(self, mesh: &Mesh, phase: f64, out: &mut Vec<Vec3>) {
        match self {
            Self::Animation => {
                let duration_s = mesh.animation.as_ref().map_or(0.0, |animation| animation.duration_s());
                mesh.pose(duration_s * phase, out);
            }
            Self::Deform(deform) => deform.apply(phase as f32, &mesh.positions, out),
            _ => out.clone_from(&mesh.positions),
        }
    }
}

/// Turns a light about the vertical axis through the origin.
fn turn(light: &mut Light, phase: f64) {
    let rotation = glam::DQuat::from_rotation_y(std::f64::consts::TAU * phase);
    match &mut light.kind {
        LightKind::Directional { direction } => *direction = rotation * *direction,
        LightKind::Positional { position } => *position = rotation * *position,
        LightKind::Spot { position, direction, .. } => {
            *position = rotation * *position;
            *direction = rotation * *direction;
        }
    }
}

#[cfg(test)]
mod tests {
    use glam::DVec3;

    use super::*;

    #[test]
    fn paths_close() {
        let scene = Scene::default();
        for path in [Path::Orbit, Path::Light, Path::Zoom] {
            let end = path.scene(&scene, 1.0);
            let camera = end.camera.view_from_world();
            assert!(camera.abs_diff_eq(scene.camera.view_from_world(), 1e-9), "{path:?}");
            let LightKind::Directional { direction } = end.lights.lights[0].kind else { panic!("{end:?}") };
            let LightKind::Directional { direction: start } = scene.lights.lights[0].kind else { panic!("{scene:?}") };
            assert!(direction.distance(start) < 1e-9, "{path:?}");
            assert_ne!(path.scene(&scene, 0.5), scene, "{path:?} moves");
        }
    }

    #[test]
    fn the_zoom_is_nearest_in_the_middle() {
        let scene = Scene::default();
        let distance = |phase| Path::Zoom.scene(&scene, phase).camera.distance;
        assert!((distance(0.5) - scene.camera.distance / ZOOM).abs() < 1e-12);
        assert!(distance(0.25) > distance(0.5) && distance(0.25) < distance(0.1));
    }

    #[test]
    fn every_kind_of_light_turns() {
        let at = DVec3::new(1.0, 2.0, 0.0);
        let spot = LightKind::Spot { position: at, direction: -at, cutoff_deg: 20.0, exponent: 1.0 };
        for kind in [LightKind::Positional { position: at }, spot] {
            let mut light = Light { kind, intensity: 1.0 };
            turn(&mut light, 0.5);
            let (LightKind::Positional { position } | LightKind::Spot { position, .. }) = light.kind else {
                panic!("{light:?}")
            };
            assert!(position.distance(DVec3::new(-1.0, 2.0, 0.0)) < 1e-9);
        }
    }
}
