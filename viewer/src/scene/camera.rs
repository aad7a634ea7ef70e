//! The camera: an orbit around a point.

use glam::{DMat4, DVec3};

/// A perspective camera on an orbit.
#[derive(Clone, Copy, Debug, PartialEq, serde::Serialize, serde::Deserialize)]
pub struct Camera {
    /// Angle around the vertical axis in degrees; 0 looks at the mesh from +z, 90 from +x.
    pub azimuth_deg: f64,
    /// Angle above the horizon in degrees, -90..=90.
    pub elevation_deg: f64,
    /// From the target, in world units, > 0. Meshes are 2 units long.
    pub distance: f64,
    /// What it looks at, in world units.
    pub target: DVec3,
    /// Vertical opening in degrees, 1..=150.
    pub field_of_view_deg: f64,
}

impl Default for Camera {
    fn default() -> Self {
        Self { azimuth_deg: 30.0, elevation_deg: 18.0, distance: 4.6, target: DVec3::ZERO, field_of_view_deg: 30.0 }
    }
}

impl Camera {
    /// The distance at which a sphere about the target fills the picture.
    ///
    /// `radius` in world units, `aspect` is width over height.
    pub fn fit_distance(&self, radius: f64, aspect: f64) -> f64 {
        let half = (self.field_of_view_deg.to_radians() * 0.5).tan() * aspect.min(1.0);
        radius / half.atan().sin() * 1.06
    }

    /// The distance at which all of `points` (world units) are in the picture, with `margin` (0..1) of each side left
    /// free; `aspect` is width over height. Direction, target and opening stay.
    pub fn fit_points(&self, points: impl IntoIterator<Item = DVec3>, aspect: f64, margin: f64) -> f64 {
        let (right, up, slope) = self.picture_axes(aspect, margin);
        let forward = self.forward();
        let needed = points.into_iter().map(|point| {
            let from_target = point - self.target;
            let across = (from_target.dot(right).abs() / slope.x).max(from_target.dot(up).abs() / slope.y);
            across - from_target.dot(forward)
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
            let (mut low, mut high) = (glam::DVec2::MAX, glam::DVec2::MIN);
            for point in points {
                let from_target = *point - self.target;
                let depth = self.distance + from_target.dot(forward);
                let at = glam::DVec2::new(from_target.dot(right), from_target.dot(up)) / depth;
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
    fn picture_axes(&self, aspect: f64, margin: f64) -> (DVec3, DVec3, glam::DVec2) {
        let azimuth = self.azimuth_deg.to_radians();
        let right = DVec3::new(azimuth.cos(), 0.0, -azimuth.sin());
        let half = (self.field_of_view_deg.to_radians() * 0.5).tan() * (1.0 - margin);
        (right, right.cross(self.forward()), glam::DVec2::new(half * aspect, half))
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

    /// Side of a pixel in world units at distance 1, for a picture of this height.
    pub fn pixel_at_1(&self, height_px: u32) -> f64 {
        2.0 * (self.field_of_view_deg.to_radians() * 0.5).tan() / f64::from(height_px)
    }

    /// Into the camera's space: x right, y up, the picture towards -z.
    pub fn view_from_world(&self) -> DMat4 {
        // At the poles the horizon turns with the azimuth, so that the picture does not jump there.
        let azimuth = self.azimuth_deg.to_radians();
        let right = DVec3::new(azimuth.cos(), 0.0, -azimuth.sin());
        let forward = self.forward();
        let up = right.cross(forward);
        let place = self.place();
        let rotation = glam::DMat3::from_cols(right, up, -forward).transpose();
        DMat4::from_mat3(rotation) * DMat4::from_translation(-place)
    }

    /// Into clip space with depth 0 (near) ..= 1 (far); `radius` is that of everything about the target.
    pub fn clip_from_world(&self, size_px: [u32; 2], radius: f64) -> DMat4 {
        let aspect = f64::from(size_px[0]) / f64::from(size_px[1]);
        let far = self.distance + radius * 2.0 + 1e-3;
        let near = (self.distance - radius * 2.0).max(far * 1e-4);
        glam::dcamera::rh::proj::directx::perspective(self.field_of_view_deg.to_radians(), aspect, near, far)
            * self.view_from_world()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn framed_points_touch_opposite_sides_of_the_picture() {
        let points: Vec<DVec3> = (0..40)
            .map(|k| f64::from(k) * 2.4)
            .map(|a| DVec3::new(1.4 * a.cos() + 0.5, 0.3 * (a * 1.7).sin(), 0.8 * a.sin()))
            .collect();
        for (azimuth_deg, elevation_deg, aspect) in [(30.0, 18.0, 1.0), (-120.0, 60.0, 2.0), (0.0, -80.0, 0.5)] {
            let mut camera = Camera { azimuth_deg, elevation_deg, ..Camera::default() };
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

    #[test]
    fn the_target_is_in_the_middle_and_a_fitting_sphere_stays_inside() {
        for (azimuth_deg, elevation_deg) in [(0.0, 0.0), (77.0, 40.0), (-130.0, -90.0), (10.0, 90.0)] {
            let mut camera =
                Camera { azimuth_deg, elevation_deg, target: DVec3::new(0.3, -0.2, 0.1), ..Camera::default() };
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
