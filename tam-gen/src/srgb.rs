//! The curve of sRGB (IEC 61966-2-1).

/// Linear light, 0..=1, of an encoded channel.
pub fn linear(byte: u8) -> f32 {
    let x = f32::from(byte) / 255.0;
    if x <= 0.04045 { x / 12.92 } else { libm::powf((x + 0.055) / 1.055, 2.4) }
}

/// An encoded channel of linear light; what is darker than 0 is 0, and what is lighter than 1 is 255.
pub fn byte(linear: f32) -> u8 {
    let encoded = if linear <= 0.003_130_8 { 12.92 * linear } else { 1.055 * libm::powf(linear, 1.0 / 2.4) - 0.055 };
    (encoded * 255.0).round().clamp(0.0, 255.0) as u8
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_byte_comes_back_and_light_grows_with_it() {
        assert!((0..=255).all(|encoded| byte(linear(encoded)) == encoded));
        assert!((0..255).all(|encoded| linear(encoded) < linear(encoded + 1)));
        assert_eq!((linear(0), linear(255)), (0.0, 1.0));
        // The standard's own figures for a middle grey.
        assert!((linear(188) - 0.5029).abs() < 1e-4 && byte(0.2140) == 127);
        assert_eq!([-1.0, 2.0, f32::NAN].map(byte), [0, 255, 0]);
    }
}
