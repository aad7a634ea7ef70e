//! Functions that WGSL has and Rust lacks, as the WGSL specification (section 17) defines them.

use glam::DVec2;

/// `a` at 0, `b` at 1.
pub fn mix(a: f64, b: f64, t: f64) -> f64 {
    a * (1.0 - t) + b * t
}

/// 1 where `x` is at least `edge`, else 0.
pub fn step(edge: f64, x: f64) -> f64 {
    if edge <= x { 1.0 } else { 0.0 }
}

/// Cubic from 0 at `low` to 1 at `high`.
pub fn smoothstep(low: f64, high: f64, x: f64) -> f64 {
    let t = ((x - low) / (high - low)).clamp(0.0, 1.0);
    t * t * (3.0 - 2.0 * t)
}

/// `1 / sqrt(x)`.
pub fn inverse_sqrt(x: f64) -> f64 {
    x.sqrt().recip()
}

/// Two numbers in `-1.0 ..= 1.0` as 16-bit snorm, `x` in the low bits.
pub fn pack2x16snorm(e: DVec2) -> u32 {
    let half = |e: f64| u32::from((0.5 + 32767.0 * e.clamp(-1.0, 1.0)).floor() as i16 as u16);
    half(e.x) | half(e.y) << 16
}

/// The numbers that [`pack2x16snorm`] packed; -32768 counts as -32767.
pub fn unpack2x16snorm(code: u32) -> DVec2 {
    let half = |bits: u32| (f64::from(bits as u16 as i16) / 32767.0).max(-1.0);
    DVec2::new(half(code), half(code >> 16))
}

/// Two numbers in `0.0 ..= 1.0` as 16-bit unorm, `x` in the low bits.
pub fn pack2x16unorm(e: DVec2) -> u32 {
    let half = |e: f64| u32::from((0.5 + 65535.0 * e.clamp(0.0, 1.0)).floor() as u16);
    half(e.x) | half(e.y) << 16
}

/// The numbers that [`pack2x16unorm`] packed.
pub fn unpack2x16unorm(code: u32) -> DVec2 {
    DVec2::new(f64::from(code & 0xffff), f64::from(code >> 16)) / 65535.0
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn snorm_codes_hold_both_ends_zero_and_the_sign() {
        let e = DVec2::new(-1.0, 1.0);
        assert_eq!(pack2x16snorm(e), 0x7fff_8001);
        assert_eq!(unpack2x16snorm(pack2x16snorm(e)), e);
        assert_eq!(pack2x16snorm(DVec2::ZERO), 0);
        assert_eq!(unpack2x16snorm(0x8000_8000), DVec2::splat(-1.0));
        assert_eq!(pack2x16snorm(DVec2::new(3.0, -0.25)), 0xe000_7fff);
    }

    #[test]
    fn unorm_codes_hold_both_ends() {
        assert_eq!(pack2x16unorm(DVec2::new(2.0, -1.0)), 0x0000_ffff);
        assert_eq!(unpack2x16unorm(0xffff_0000), DVec2::new(0.0, 1.0));
        assert_eq!(pack2x16unorm(unpack2x16unorm(0x1234_5678)), 0x1234_5678);
    }

    #[test]
    fn a_step_has_its_edge_on_the_upper_side() {
        assert_eq!([step(0.5, 0.4), step(0.5, 0.5), step(0.5, 0.6)], [0.0, 1.0, 1.0]);
    }
}
