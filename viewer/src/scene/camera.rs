//! The camera: an orbit around a point.

use glam::{DMat3, DMat4, DVec2, DVec3};

/// How lines of sight run.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, serde::Serialize, serde::Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Projection {
    /// They meet in the camera.
    #[default]
    Perspective,
    /// They are parallel. The picture is as large as perspective has it at the target.
    Orthographic,
}

impl Projection {
    /// Both.
    pub const ALL: [Self; 2] = [Self::Perspective, Self::Orthographic];

    /// Its name on the command line.
    pub fn name(self) -> &'static str {
        match self {
            Self::Perspective => "perspective",
            Self::Orthographic => "orthographic",
        }
    }
}

/// A look along an axis.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum AxisView {
    /// From +z.
    Front,
    /// From -z.
    Back,
    /// From -x.
    Left,
    /// From +x.
    Right,
    /// From +y, with -z up.
    Top,
    /// From -y, with +z up.
    Bottom,
}

impl AxisView {
    /// All of them.
    pub const ALL: [Self; 6] = [Self::Front, Self::Back, Self::Left, Self::Right, Self::Top, Self::Bottom];

    /// Its name on the command line.
    pub fn name(self) -> &'static str {
        match self {
            Self::Front => "front",
            Self::Back => "back",
            Self::Left => "left",
            Self::Right => "right",
            Self::Top => "top",
            Self::Bottom => "bottom",
        }
    }

    /// Azimuth and elevation, in degrees.
    pub fn angles_deg(self) -> [f64; 2] {
        match self {
            Self::Front => [0.0, 0.0],
            Self::Back => [180.0, 0.0],
            Self::Left => [-90.0, 0.0],
            Self::Right => [90.0, 0.0],
            Self::Top => [0.0, 90.0],
            Self::Bottom => [0.0, -90.0],
        }
    }
}

/// A camera on an orbit. What a stored one does not name is as by default.
#[derive(Clone, Copy, Debug, PartialEq, serde::Serialize, serde::Deserialize)]
#[serde(default)]
pub struct Camera {
    /// Angle around the vertical axis in degrees; 0 looks at the mesh from +z, 90 from +x.
    pub azimuth_deg: f64,
    /// Angle above the horizon in degrees, -90..=90.
    pub elevation_deg: f64,
    /// From the target, in world units, > 0. Meshes are 2 units long.
    pub distance: f64,
    /// What it looks at, in world units.
    pub target: DVec3,
    /// Vertical opening in degrees, 1..=150. Parallel lines of sight span what it spans at the target.
    pub field_of_view_deg: f64,
    /// Turn about the line of sight in degrees; what is seen turns counter-clockwise.
    pub roll_deg: f64,
    /// How lines of sight run.
    pub projection: Projection,
}

impl Default for Camera {
    fn default() -> Self {
        Self {
            azimuth_deg: 30.0,
            elevation_deg: 18.0,
            distance: 4.6,
            target: DVec3::ZERO,
            field_of_view_deg: 30.0,
            roll_deg: 0.0,
            projection: Projection::Perspective,
        }
    }
}

/// How far before the target parallel lines of sight begin, in world units.
const PARALLEL_BEFORE: f64 = 4000.0;

impl Camera {
    /// The distance at which a sphere about the target fills the picture.
    ///
    /// `radius` in world units, `aspect` is width over height.
    pub fn fit_distance(&self, radius: f64, aspect: f64) -> f64 {
        let half = self.half_height() * aspect.min(1.0);
        let outline = if self.is_parallel() { half } else { half.atan().sin() };
        radius / outline * 1.06
    }

    /// The distance at which all of `points` (world units) are in the picture, with `margin` (0..1) of each side left
    /// free; `aspect` is width over height. Direction, target and opening stay.
    pub fn fit_points(&self, points: impl IntoIterator<Item = DVec3>, aspect: f64, margin: f64) -> f64 {
        let (right, up, slope) = self.picture_axes(aspect, margin);
        let forward = self.forward();
        let needed = points.into_iter().map(|point| {
            let from_target = point - self.target;
            let across = (from_target.dot(right).abs() / slope.x).max(from_target.dot(up).abs() / slope.y);
            if self.is_parallel() { across } else { across - from_target.dot(forward) }
        });
        // Never nearer than a mesh of no extent would let it.
        needed.fold(1e-2, f64::max)
    }

    /// Moves target and distance so that `points` fill the middle of the picture; direction and opening stay.
    pub fn frame_points(&mut self, points: &[DVec3], aspect: f64, margin: f64) {
        // Moving the target changes the perspective a little, which a second round mends.
        for _ in 0..2 {
            self.distance = self.fit_points(points.iter().copied(), aspect, margin);
            let (right, up, _) = self.picture_axes(aspect, margin);
            let forward = self.forward();
            let (mut low, mut high) = (DVec2::MAX, DVec2::MIN);
            for point in points {
                let from_target = *point - self.target;
                let depth = self.distance + if self.is_parallel() { 0.0 } else { from_target.dot(forward) };
                let at = DVec2::new(from_target.dot(right), from_target.dot(up)) / depth;
                (low, high) = (low.min(at), high.max(at));
            }
            let middle = (low + high) * 0.5 * self.distance;
            if middle.is_finite() {
                self.target += right * middle.x + up * middle.y;
            }
        }
        self.distance = self.fit_points(points.iter().copied(), aspect, margin);
    }

    /// Right and up in the picture, and half of its sides at distance 1, less the margin.
    fn picture_axes(&self, aspect: f64, margin: f64) -> (DVec3, DVec3, DVec2) {
        let [right, up] = self.axes();
        let half = self.half_height() * (1.0 - margin);
        (right, up, DVec2::new(half * aspect, half))
    }

    /// Right and up in the picture, unit.
    pub fn axes(&self) -> [DVec3; 2] {
        // At the poles the horizon turns with the azimuth, so that the picture does not jump there.
        let azimuth = self.azimuth_deg.to_radians();
        let right = DVec3::new(azimuth.cos(), 0.0, -azimuth.sin());
        let up = right.cross(self.forward());
        let (sin, cos) = self.roll_deg.to_radians().sin_cos();
        if self.roll_deg == 0.0 { [right, up] } else { [right * cos - up * sin, up * cos + right * sin] }
    }

    /// Half of the picture's height at distance 1.
    fn half_height(&self) -> f64 {
        (self.field_of_view_deg.to_radians() * 0.5).tan()
    }

    /// Whether lines of sight are parallel.
    pub fn is_parallel(&self) -> bool {
        self.projection == Projection::Orthographic
    }

    /// The line of sight through a place of the picture, -1..=1 from left to right and from bottom to top: where it starts,
    /// before all that is seen, and its direction, unit; `aspect` is width over height.
    pub fn ray(&self, at: DVec2, aspect: f64) -> (DVec3, DVec3) {
        let [right, up] = self.axes();
        let half = self.half_height();
        let across = right * (at.x * half * aspect) + up * (at.y * half);
        if self.is_parallel() {
            // What is nearer than the camera's place is seen as well.
            (self.target + across * self.distance - self.forward() * PARALLEL_BEFORE, self.forward())
        } else {
            (self.place(), (self.forward() + across).normalize())
        }
    }

    /// Unit, from the camera into the picture.
    pub fn forward(&self) -> DVec3 {
        let (azimuth, elevation) = (self.azimuth_deg.to_radians(), self.elevation_deg.to_radians());
        -DVec3::new(azimuth.sin() * elevation.cos(), elevation.sin(), azimuth.cos() * elevation.cos())
    }

    /// Its place in the world.
    pub fn place(&self) -> DVec3 {
        self.target - self.forward() * self.distance
    }

    /// Side of a pixel in world units at distance 1, for a picture of this height; where lines of sight are parallel, all
    /// pixels are as large as those at the target.
    pub fn pixel_at_1(&self, height_px: u32) -> f64 {
        2.0 * self.half_height() / f64::from(height_px)
    }

    /// Into the camera's space: x right, y up, the picture towards -z.
    pub fn view_from_world(&self) -> DMat4 {
        let [right, up] = self.axes();
        let rotation = DMat3::from_cols(right, up, -self.forward()).transpose();
        let place = self.place();
        DMat4::from_mat3(rotation) * DMat4::from_translation(-place)
    }

    /// Into clip space with depth 0 (near) ..= 1 (far); `radius` is that of everything about the target.
    pub fn clip_from_world(&self, size_px: [u32; 2], radius: f64) -> DMat4 {
        let aspect = f64::from(size_px[0]) / f64::from(size_px[1]);
        if self.is_parallel() {
            let height = self.half_height() * self.distance;
            let (near, far) = (self.distance - radius * 2.0 - 1e-3, self.distance + radius * 2.0 + 1e-3);
            let width = height * aspect;
            return glam::dcamera::rh::proj::directx::orthographic(-width, width, -height, height, near, far)
                * self.view_from_world();
        }
        let far = self.distance + radius * 2.0 + 1e-3;
        let near = (self.distance - radius * 2.0).max(far * 1e-4);
        glam::dcamera::rh::proj::directx::perspective(self.field_of_view_deg.to_radians(), aspect, near, far)
            * self.view_from_world()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn cameras() -> impl Iterator<Item = Camera> {
        Projection::ALL.into_iter().flat_map(|projection| {
            [(0.0, 0.0, 0.0), (77.0, 40.0, 25.0), (-130.0, -90.0, -140.0), (10.0, 90.0, 0.0)].map(
                |(azimuth_deg, elevation_deg, roll_deg)| Camera {
                    azimuth_deg,
                    elevation_deg,
                    roll_deg,
                    projection,
                    target: DVec3::new(0.3, -0.2, 0.1),
                    ..Camera::default()
                },
            )
        })
    }

    #[test]
    fn both_projections_see_the_target_plane_alike_and_parallel_ones_see_all_depths_so() {
        for camera in cameras() {
            let [right, up] = camera.axes();
            let half = camera.half_height() * camera.distance;
            let clip_from_world = camera.clip_from_world([300, 200], 2.0);
            for (x, y, depth) in [(0.5, -0.25, 0.0), (-1.0, 0.75, 0.0), (0.5, 0.5, 1.3), (-0.4, 0.2, -1.3)] {
                let across = right * (x * half * 1.5) + up * (y * half);
                let at = clip_from_world.project_point3(camera.target + across + camera.forward() * depth);
                let shrinks = if camera.is_parallel() { 1.0 } else { camera.distance / (camera.distance + depth) };
                assert!((at.truncate() - DVec2::new(x, y) * shrinks).length() < 1e-9, "{camera:?} {at}");
                assert!(at.z > 0.0 && at.z < 1.0);
            }
        }
    }

    #[test]
    fn a_roll_turns_what_is_seen_counter_clockwise() {
        for mut camera in cameras() {
            camera.roll_deg = 0.0;
            let [right, _] = camera.axes();
            let point = camera.target + right * 0.5;
            camera.roll_deg = 30.0;
            let at = camera.clip_from_world([200, 200], 2.0).project_point3(point).truncate();
            assert!((at.to_angle().to_degrees() - 30.0).abs() < 1e-9, "{at}");
        }
    }

    #[test]
    fn rays_run_through_the_places_that_they_are_of() {
        for camera in cameras() {
            let clip_from_world = camera.clip_from_world([300, 200], 2.0);
            for at in [DVec2::ZERO, DVec2::new(0.6, -0.3), DVec2::new(-0.9, 0.8)] {
                let (from, along) = camera.ray(at, 1.5);
                let plane = (camera.target - from).dot(camera.forward()) / along.dot(camera.forward());
                let seen = clip_from_world.project_point3(from + along * plane).truncate();
                assert!(seen.distance(at) < 1e-9, "{seen} {at}");
            }
        }
    }

    #[test]
    fn axis_views_look_along_their_axes() {
        for (view, from) in [
            (AxisView::Front, DVec3::Z),
            (AxisView::Back, DVec3::NEG_Z),
            (AxisView::Left, DVec3::NEG_X),
            (AxisView::Right, DVec3::X),
            (AxisView::Top, DVec3::Y),
            (AxisView::Bottom, DVec3::NEG_Y),
        ] {
            let [azimuth_deg, elevation_deg] = view.angles_deg();
            let camera = Camera { azimuth_deg, elevation_deg, ..Camera::default() };
            assert!((camera.forward() + from).length() < 1e-12, "{view:?}");
        }
    }

    #[test]
    fn a_stored_camera_without_roll_and_projection_has_none() {
        let text =
            r#"{"azimuth_deg":1.0,"elevation_deg":2.0,"distance":3.0,"target":[0.0,0.0,0.0],"field_of_view_deg":30.0}"#;
        let camera: Camera = serde_json::from_str(text).expect("it is whole");
        assert_eq!((camera.roll_deg, camera.projection, camera.distance), (0.0, Projection::Perspective, 3.0));
    }

    #[test]
    fn framed_points_touch_opposite_sides_of_the_picture() {
        let points: Vec<DVec3> = (0..40)
            .map(|k| f64::from(k) * 2.4)
            .map(|a| DVec3::new(1.4 * a.cos() + 0.5, 0.3 * (a * 1.7).sin(), 0.8 * a.sin()))
            .collect();
        for (azimuth_deg, elevation_deg, aspect) in [(30.0, 18.0, 1.0), (-120.0, 60.0, 2.0), (0.0, -80.0, 0.5)] {
            let mut camera = Camera { azimuth_deg, elevation_deg, ..Camera::default() };
            for projection in Projection::ALL {
                (camera.projection, camera.roll_deg) = (projection, aspect * 10.0);
                camera.frame_points(&points, aspect, 0.1);
                let clip_from_world = camera.clip_from_world([(1000.0 * aspect) as u32, 1000], 4.0);
                let placed: Vec<_> = points.iter().map(|point| clip_from_world.project_point3(*point)).collect();
                let extent = |side: fn(&DVec3) -> f64| {
                    let sides = placed.iter().map(side);
                    (sides.clone().fold(f64::MAX, f64::min), sides.fold(f64::MIN, f64::max))
                };
                let ((left, right), (bottom, top)) = (extent(|p| p.x), extent(|p| p.y));
                let widest = right.max(-left).max(top).max(-bottom);
                assert!((widest - 0.9).abs() < 1e-6, "{widest}");
                // Two rounds of centring leave a hundredth of the picture.
                assert!((left + right).abs() < 0.02 && (bottom + top).abs() < 0.02, "{left} {right} {bottom} {top}");
            }
        }
    }

    #[test]
    fn the_target_is_in_the_middle_and_a_fitting_sphere_stays_inside() {
        for mut camera in cameras() {
            camera.distance = camera.fit_distance(1.3, 0.75);
            let clip_from_world = camera.clip_from_world([300, 400], 1.3);
            let middle = clip_from_world.project_point3(camera.target);
            assert!(middle.truncate().length() < 1e-9, "{middle}");
            for i in 0..200 {
                let (a, z) = (f64::from(i) * 2.4, f64::from(i) / 100.0 - 0.995);
                let r = (1.0 - z * z).sqrt();
                let p = clip_from_world.project_point3(camera.target + 1.3 * DVec3::new(r * a.cos(), r * a.sin(), z));
                assert!(p.x.abs() < 1.0 && p.y.abs() < 1.0 && p.z > 0.0 && p.z < 1.0, "{p}");
            }
        }
    }
}
