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
