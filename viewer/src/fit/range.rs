//! The cameras and lights that a scene is seen with.

use crate::chart::relit;
use crate::measure::Aov;
use crate::mesh::Mesh;
use crate::reference::ReferenceError;
use crate::scene::Scene;

/// Ranges of the camera and of the lights, both ends included; a range of one value is that value.
#[derive(Clone, Copy, Debug, PartialEq, serde::Serialize)]
pub struct FitRange {
    /// Distances of the camera as multiples of the scene's own, > 0, the nearer first.
    pub distance: [f64; 2],
    /// Turns of the camera about the upright axis from the scene's own, in degrees.
    pub orbit_deg: [f64; 2],
    /// Turns of all lights about the upright axis from the scene's own, in degrees.
    pub light_deg: [f64; 2],
}

/// A scene somewhere in the range, and what is wanted at each of its pixels.
#[derive(Clone, Debug)]
pub struct FitView {
    /// Where it is, in words.
    pub name: String,
    /// The scene.
    pub scene: Scene,
    /// What is wanted.
    pub aov: Aov,
}

impl FitRange {
    /// Views at all combinations of these places along the ranges, 0 ..= 1. Distances are spaced evenly in their
    /// logarithm, as levels of detail are.
    ///
    /// # Errors
    /// As [`Aov::new`].
    pub fn views(
        &self,
        mesh: &Mesh,
        scene: &Scene,
        size: [u32; 2],
        places: &[f64],
    ) -> Result<Vec<FitView>, ReferenceError> {
        let along = |range: [f64; 2]| {
            let mut values: Vec<f64> = places.iter().map(|at| range[0] + (range[1] - range[0]) * at).collect();
            values.dedup();
            values
        };
        let distances: Vec<f64> = along(self.distance.map(f64::ln)).into_iter().map(f64::exp).collect();
        let mut views = Vec::new();
        for distance in &distances {
            for orbit_deg in along(self.orbit_deg) {
                for light_deg in along(self.light_deg) {
                    let mut scene = relit(scene, light_deg);
                    scene.camera.distance *= distance;
                    scene.camera.azimuth_deg += orbit_deg;
                    let name = format!("distance {distance:.2}, orbit {orbit_deg:.0}°, light {light_deg:.0}°");
                    views.push(FitView { aov: Aov::new(mesh, &scene, size, None)?, scene, name });
                }
            }
        }
        Ok(views)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::prepare;
    use crate::mesh::sample::Sample;

    #[test]
    fn views_are_all_combinations_and_a_range_of_one_value_is_one_place() {
        let mesh = prepare(Sample::Cube.build(12)).expect("a cube").mesh;
        let scene = Scene::of(&mesh);
        let range = FitRange { distance: [0.5, 2.0], orbit_deg: [0.0, 0.0], light_deg: [-30.0, 30.0] };
        let views = range.views(&mesh, &scene, [32, 32], &[0.0, 0.5, 1.0]).expect("views");
        assert_eq!(views.len(), 9);
        let distances: Vec<f64> = views.iter().map(|view| view.scene.camera.distance / scene.camera.distance).collect();
        for (found, expected) in [(distances[0], 0.5), (distances[3], 1.0), (distances[8], 2.0)] {
            assert!((found - expected).abs() < 1e-12, "{distances:?}");
        }
        assert_eq!(views[1].scene.lights, scene.lights, "the middle of the lights is the scene's own");
    }
}
