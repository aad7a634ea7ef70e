//! How far the camera has to be when it goes around what is seen.

use glam::DMat4;

use super::super::named::Named;
use crate::Camera;
use crate::mesh::Mesh;
use crate::turntable::swept;

/// Share of the picture's sides left free around the mesh.
pub(crate) const MARGIN: f64 = 0.08;

/// The distances at which the mesh is whole, of the camera that went around last: vertices are not gone through for each
/// frame.
#[derive(Default)]
pub(super) struct Round {
    known: Option<(Asked, Whole)>,
}

/// A mesh, and where it stands.
type Placed = (Named<Mesh>, DMat4);

/// What distances depend on.
struct Asked {
    placed: Vec<Placed>,
    /// At distance 0.
    camera: Camera,
    view_px: [u32; 2],
    frame_px: [u32; 2],
}

/// Distances at which the mesh is in the picture.
#[derive(Clone, Copy)]
struct Whole {
    /// As the view stands still.
    still: f64,
    /// All the way around, in frames.
    around: f64,
}

impl Round {
    /// The distance of a camera that goes around a mesh, for a view of this size that shows it as it stands still: where
    /// that shows the mesh whole, every frame does. A view that shows only part of it, as somebody has come nearer, stays
    /// as near in proportion; none comes nearer than it is.
    pub(super) fn distance(
        &mut self,
        camera: &Camera,
        placed: &[Placed],
        view_px: [u32; 2],
        frame_px: [u32; 2],
    ) -> f64 {
        // Nothing was seen yet but what is written now.
        let view_px = if view_px.contains(&0) { frame_px } else { view_px };
        let asked = Asked { placed: placed.to_vec(), camera: Camera { distance: 0.0, ..*camera }, view_px, frame_px };
        let whole = match &self.known {
            Some((known, whole)) if *known == asked => *whole,
            _ => asked.whole(),
        };
        self.known = Some((asked, whole));
        let farther = (whole.around / whole.still).max(1.0);
        camera.distance.max((camera.distance * farther).min(whole.around))
    }
}

impl PartialEq for Asked {
    fn eq(&self, other: &Self) -> bool {
        self.placed == other.placed
            && (self.camera, self.view_px, self.frame_px) == (other.camera, other.view_px, other.frame_px)
    }
}

impl Asked {
    fn whole(&self) -> Whole {
        let aspect = |[width, height]: [u32; 2]| f64::from(width) / f64::from(height);
        let points = self.placed.iter().flat_map(|(mesh, world)| {
            mesh.positions.iter().map(|position| world.transform_point3(position.as_dvec3()))
        });
        let rings = swept(points.clone(), self.camera.target);
        Whole {
            still: self.camera.fit_points(points, aspect(self.view_px), MARGIN),
            around: self.camera.fit_points(rings, aspect(self.frame_px), MARGIN),
        }
    }
}

#[cfg(test)]
mod tests {
    use glam::DVec3;

    use super::*;
    use crate::mesh::prepare;
    use crate::mesh::sample::Sample;
    use crate::scene::Scene;
    use crate::turntable::Path;

    const VIEW_PX: [u32; 2] = [840, 520];

    fn mesh(sample: Sample) -> Named<Mesh> {
        Named::mesh(prepare(sample.build(sample.least_triangles().max(2_000))).expect("a mesh").mesh)
    }

    fn framed(mesh: &Mesh, elevation_deg: f64) -> Camera {
        let points: Vec<DVec3> = mesh.positions.iter().map(|position| position.as_dvec3()).collect();
        let mut camera = Camera { elevation_deg, ..Camera::default() };
        camera.frame_points(&points, f64::from(VIEW_PX[0]) / f64::from(VIEW_PX[1]), MARGIN);
        camera
    }

    /// How far out of the middle anything is in any of 12 frames; 1 is the border.
    fn outermost(mesh: &Mesh, camera: Camera, frame_px: [u32; 2]) -> f64 {
        let start = Scene { camera, ..Scene::of(mesh) };
        let of_frame = |frame: u32| {
            let camera = Path::Orbit.scene(&start, f64::from(frame) / 12.0).camera;
            let clip = camera.clip_from_world(frame_px, 2.0);
            let places = mesh.positions.iter().map(move |position| clip.project_point3(position.as_dvec3()));
            places.map(|place| place.x.abs().max(place.y.abs())).fold(0.0, f64::max)
        };
        (0..12).map(of_frame).fold(0.0, f64::max)
    }

    #[test]
    fn what_a_still_view_shows_whole_is_whole_all_the_way_around() {
        let mut cut_off = 0;
        for sample in [Sample::Teapot, Sample::Chair, Sample::Quad, Sample::Hand] {
            let mesh = mesh(sample);
            for elevation_deg in [-90.0, 0.0, 18.0, 60.0] {
                let camera = framed(&mesh, elevation_deg);
                for frame_px in [VIEW_PX, [512, 512]] {
                    let placed = [(mesh.clone(), DMat4::IDENTITY)];
                    let distance = Round::default().distance(&camera, &placed, VIEW_PX, frame_px);
                    assert!(distance >= camera.distance);
                    let out = outermost(&mesh, Camera { distance, ..camera }, frame_px);
                    let what = format!("{} from {elevation_deg} degrees in {frame_px:?}: {out}", sample.name());
                    assert!(out < 1.0 - 0.9 * MARGIN, "{what}");
                    let as_it_was = outermost(&mesh, camera, frame_px);
                    cut_off += u32::from(as_it_was > 1.0);
                    // Slices and rings make it look no larger than it is by a percent or two.
                    assert!(distance == camera.distance || out > 0.85, "{what} is farther than needed");
                }
            }
        }
        assert!(cut_off > 8, "at the view's own distance only {cut_off} are cut off");
    }

    #[test]
    fn who_has_come_nearer_stays_near_and_who_is_far_stays_where_he_is() {
        let (mesh, mut round) = (mesh(Sample::Teapot), Round::default());
        let camera = framed(&mesh, 18.0);
        let mut of = |share: f64| {
            let nearer = Camera { distance: camera.distance * share, ..camera };
            round.distance(&nearer, &[(mesh.clone(), DMat4::IDENTITY)], VIEW_PX, VIEW_PX) / camera.distance
        };
        let (whole, near, far) = (of(1.0), of(0.25), of(3.0));
        assert!(whole > 1.0 && (near - whole * 0.25).abs() < 1e-9 && far == 3.0, "{whole} {near} {far}");
        // The wheel never turns without anything coming nearer for long, and never leaps.
        for step in 1..40 {
            let (before, after) = (of(f64::from(step) * 0.05), of(f64::from(step + 1) * 0.05));
            assert!(after >= before && after - before <= 0.05 * whole + 1e-9, "{before} {after}");
        }
    }
}
