//! Twin of `lib/colour.wgsl`: colours by hue that look equally light. Ottosson, "A perceptual color space for image
//! processing", 2020: Oklab in polar coordinates.

use glam::DVec3;

/// A full turn, as the shader has it.
pub const TAU: f64 = std::f32::consts::TAU as f64;

/// Linear light of a lightness 0 ..= 1, a chroma 0 ..= 0.4 and a hue in turns; what no screen shows is clamped.
pub fn oklch(lightness: f64, chroma: f64, hue: f64) -> DVec3 {
    let (sin, cos) = (TAU * hue).sin_cos();
    let (a, b) = (chroma * cos, chroma * sin);
    let root = DVec3::new(
        lightness + 0.396_337_777_4 * a + 0.215_803_757_3 * b,
        lightness - 0.105_561_345_8 * a - 0.063_854_172_8 * b,
        lightness - 0.089_484_177_5 * a - 1.291_485_548_0 * b,
    );
    let cones = root * root * root;
    let rgb = DVec3::new(
        DVec3::new(4.076_741_662_1, -3.307_711_591_3, 0.230_969_929_2).dot(cones),
        DVec3::new(-1.268_438_004_6, 2.609_757_401_1, -0.341_319_396_5).dot(cones),
        DVec3::new(-0.004_196_086_3, -0.703_418_614_7, 1.707_614_701_0).dot(cones),
    );
    rgb.clamp(DVec3::ZERO, DVec3::ONE)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn no_chroma_is_grey_and_red_has_its_published_coordinates() {
        for lightness in [0.0, 0.3, 1.0] {
            // The published matrices have ten digits.
            let grey = DVec3::splat(f64::powi(lightness, 3));
            assert!((oklch(lightness, 0.0, 0.7) - grey).abs().max_element() < 1e-6, "{lightness}");
        }
        // Red of sRGB in Oklch, as the CSS Color 4 specification prints it: 0.62796, 0.25768, 29.234 degrees.
        let red = oklch(0.62796, 0.25768, 29.234 / 360.0);
        assert!((red - DVec3::X).abs().max_element() < 1e-3, "{red}");
    }
}
