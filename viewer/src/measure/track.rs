//! Where the surface points of one frame are in another, from the geometry: never from the pictures.

use glam::DVec2;
use rayon::prelude::*;
use tam_shaders::cpu::lib::scene as twin;

use super::aov::Aov;
use super::plane::Plane;
use crate::mesh::Mesh;
use crate::scene::Scene;

/// Points further from the surface that is seen at their place than so many of its pixels are hidden by it.
const FARTHEST_PX: f64 = 2.0;

/// Pixels at the contours of either frame that are left out: they may be covered in part.
const MARGIN_PX: usize = 2;

/// For each pixel of a frame, where its surface point is in another frame.
#[derive(Clone, Debug, PartialEq)]
pub struct Track {
    /// In pixels of the other frame, the first one from 0 to 1; none where the point is hidden there or beside the
    /// picture, and near contours of either frame.
    pub places_px: Vec<Option<DVec2>>,
}

impl Track {
    /// Follows the points of `before` to the frame `after`, which shows the same triangles with the vertices of `mesh`
    /// (moved or not) in `scene`.
    pub fn new(before: &Aov, after: &Aov, mesh: &Mesh, scene: &Scene) -> Self {
        let radius = mesh.positions.iter().map(|p| f64::from(p.length())).fold(0.0, f64::max);
        let scene = twin::Scene::from(&scene.shared(after.size, radius));
        let (from, to) = (before.interior(MARGIN_PX), after.interior(MARGIN_PX));
        let place = |(i, surface): (usize, &Option<super::Surface>)| {
            let surface = surface.as_ref().filter(|_| from[i])?;
            let corners =
                mesh.triangles[surface.face as usize].map(|vertex| mesh.positions[vertex as usize].as_dvec3());
            let weights = surface.weights;
            let p = corners[0] * weights.x + corners[1] * weights.y + corners[2] * weights.z;
            let p = scene.world_from_mesh.transform_point3(p);
            let clip = scene.clip_from_world * p.extend(1.0);
            let screen = DVec2::new(clip.w + clip.x, clip.w - clip.y) / (2.0 * clip.w);
            let place_px = screen * scene.viewport_px;
            let seen = after.index(place_px).filter(|j| clip.w > 0.0 && to[*j])?;
            let seen = after.pixels[seen].as_ref()?;
            let reach = FARTHEST_PX * seen.px_world / seen.facing.max(0.1);
            (p.distance_squared(seen.p_world) < reach * reach).then_some(place_px)
        };
        Self { places_px: before.pixels.par_iter().enumerate().map(place).collect() }
    }

    /// Every covered pixel stays where it is.
    pub fn still(aov: &Aov) -> Self {
        let width = aov.size[0] as usize;
        let middle = |i: usize| DVec2::new((i % width) as f64, (i / width) as f64) + 0.5;
        let place = |(i, inside): (usize, bool)| inside.then(|| middle(i));
        Self { places_px: aov.covered().into_iter().enumerate().map(place).collect() }
    }

    /// Pixels whose points are seen in both frames.
    pub fn mask(&self) -> Vec<bool> {
        self.places_px.iter().map(Option::is_some).collect()
    }

    /// A picture of the other frame, brought to the pixels of the first; 0 where nothing is followed.
    pub fn bring(&self, after: &Plane, size: [u32; 2]) -> Plane {
        let pixels = self.places_px.par_iter().map(|place| place.map_or(0.0, |place| after.at(place))).collect();
        Plane { size, pixels }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::prepare;
    use crate::mesh::sample::Sample;

    #[test]
    fn points_are_followed_over_a_move_of_camera_and_mesh_and_back() {
        let mesh = prepare(Sample::TorusKnot.build(4_000)).expect("a knot").mesh;
        let mut moved = mesh.clone();
        crate::mesh::deform::Deform::Breathe.apply(0.1, &mesh.positions, &mut moved.positions);
        let (first, mut second) = (Scene::of(&mesh), Scene::of(&mesh));
        second.camera.azimuth_deg += 4.0;
        let size = [120, 90];
        let before = Aov::new(&mesh, &first, size, None).expect("a view");
        let after = Aov::new(&moved, &second, size, None).expect("a view");
        let forth = Track::new(&before, &after, &moved, &second);
        let back = Track::new(&after, &before, &mesh, &first);
        let (mut followed, mut hidden, mut worst) = (0, 0, 0.0_f64);
        for (i, place) in forth.places_px.iter().enumerate() {
            let Some(place) = place else {
                hidden += usize::from(before.pixels[i].is_some());
                continue;
            };
            followed += 1;
            let pixel = after.index(*place).expect("inside the picture");
            if let Some(home) = back.places_px[pixel] {
                let start = DVec2::new((i % 120) as f64, (i / 120) as f64) + 0.5;
                worst = worst.max(home.distance(start));
            }
        }
        assert!(followed > 500 && hidden > 100, "{followed} followed, {hidden} hidden");
        // The way back starts at the middle of the pixel that was hit: half a diagonal off, stretched by the slant.
        assert!(worst < 2.5, "{worst} px");
        let moved_px = forth.places_px.iter().enumerate().flat_map(|(i, place)| {
            place.map(|place| place.distance(DVec2::new((i % 120) as f64, (i / 120) as f64) + 0.5))
        });
        assert!(moved_px.fold(0.0, f64::max) > 3.0, "the camera moved");
    }
}
