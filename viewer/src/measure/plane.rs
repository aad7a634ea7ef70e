//! One number per pixel.

use glam::DVec2;

use super::aov::Aov;
use crate::mesh::Mesh;
use crate::scene::Scene;

/// A picture of one number per pixel, by rows from the top.
#[derive(Clone, Debug, PartialEq)]
pub struct Plane {
    /// Width and height in pixels.
    pub size: [u32; 2],
    /// Width x height numbers.
    pub pixels: Vec<f64>,
}

impl Plane {
    /// A picture from a function of the column and the row.
    pub fn from_fn(size: [u32; 2], pixel: impl Fn(u32, u32) -> f64) -> Self {
        let pixel = &pixel;
        let pixels = (0..size[1]).flat_map(|y| (0..size[0]).map(move |x| pixel(x, y))).collect();
        Self { size, pixels }
    }

    /// Bilinear sample; the middle of the first pixel is at (0.5, 0.5). Beyond the edge the nearest pixels go on.
    pub fn at(&self, place_px: DVec2) -> f64 {
        let [width, height] = self.size.map(|side| side as usize);
        let last = DVec2::new(width as f64 - 1.0, height as f64 - 1.0);
        let place = (place_px - 0.5).clamp(DVec2::ZERO, last);
        let corner = place.floor();
        let share = place - corner;
        let (x, y) = (corner.x as usize, corner.y as usize);
        let (right, down) = ((x + 1).min(width - 1), (y + 1).min(height - 1));
        let row = |y: usize| {
            let row = &self.pixels[y * width..];
            row[x] + (row[right] - row[x]) * share.x
        };
        row(y) + (row(down) - row(y)) * share.y
    }
}

/// Ink coverage of a rendered picture, 0 paper ..= 1 ink: where each pixel lies between the paper in the material's
/// colour and the ink, in linear light. 0 where the mesh is not seen, where paper and ink are one colour, and where a
/// literal form drew no number; beyond 0 ..= 1 it is cut, as on a screen.
///
/// `pixels`: linear light, by rows from the top, as many as the view has.
pub fn ink(pixels: &[[f32; 4]], aov: &Aov, mesh: &Mesh, scene: &Scene) -> Plane {
    let ink = glam::Vec3::from(scene.ink).as_dvec3();
    let coverage = |(pixel, surface): (&[f32; 4], &Option<super::Surface>)| {
        let Some(surface) = surface else { return 0.0 };
        let material = scene.material(mesh.part_of(surface.face));
        let paper = (glam::Vec3::from(scene.paper) * glam::Vec3::from(material.colour)).as_dvec3();
        let colour = glam::Vec3::new(pixel[0], pixel[1], pixel[2]).as_dvec3();
        let range = paper - ink;
        let coverage = (paper - colour).dot(range) / range.length_squared().max(1e-12);
        if coverage.is_finite() { coverage.clamp(0.0, 1.0) } else { 0.0 }
    };
    Plane { size: aov.size, pixels: pixels.iter().zip(&aov.pixels).map(coverage).collect() }
}

/// CIE 1976 lightness L*, 0 ..= 100, of a relative luminance, 0 ..= 1.
pub fn lightness(luminance: f64) -> f64 {
    let luminance = luminance.max(0.0);
    if luminance > (6.0_f64 / 29.0).powi(3) {
        116.0 * luminance.cbrt() - 16.0
    } else {
        luminance * (29.0_f64 / 3.0).powi(3)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn samples_meet_the_middles_of_pixels_and_go_straight_between_them() {
        let plane = Plane::from_fn([3, 2], |x, y| f64::from(x) + 10.0 * f64::from(y));
        assert_eq!(plane.at(DVec2::new(1.5, 1.5)), 11.0);
        assert_eq!(plane.at(DVec2::new(2.0, 1.0)), 6.5);
        assert_eq!(plane.at(DVec2::new(-4.0, 9.0)), 10.0);
    }

    #[test]
    fn ink_is_the_way_from_the_materials_paper_to_the_ink() {
        let mesh = crate::mesh::prepare(crate::mesh::sample::Sample::Quad.build(2)).expect("a quad").mesh;
        let mut scene = Scene { paper: [1.0, 0.9, 0.8], ink: [0.1, 0.1, 0.3], ..Scene::default() };
        scene.materials[0].colour = [0.5, 1.0, 0.5];
        let mut aov = super::super::testing::flat_aov([5, 1], 0.0, 0.5);
        aov.pixels[4] = None;
        let quarter = [0.4, 0.7, 0.375];
        let colours = [[0.5, 0.9, 0.4], quarter, [0.1, 0.1, 0.3], [f32::NAN; 3], quarter];
        let pixels = colours.map(|[r, g, b]| [r, g, b, 1.0]);
        let found = ink(&pixels, &aov, &mesh, &scene).pixels;
        for (found, wanted) in found.iter().zip([0.0, 0.25, 1.0, 0.0, 0.0]) {
            assert!((found - wanted).abs() < 1e-6, "{found}, not {wanted}");
        }
    }

    #[test]
    fn lightness_is_that_of_the_cie() {
        // CIE 15: L* of 18.418651851244416 % is 50; the straight part meets the curve at 8.
        assert!((lightness(0.184_186_518_512_444_16) - 50.0).abs() < 1e-9);
        assert!((lightness(1.0) - 100.0).abs() < 1e-12 && lightness(0.0) == 0.0);
        let knee = (6.0_f64 / 29.0).powi(3);
        assert!((lightness(knee - 1e-12) - 8.0).abs() < 1e-6 && (lightness(knee + 1e-12) - 8.0).abs() < 1e-6);
    }
}
