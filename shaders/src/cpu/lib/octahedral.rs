//! Twin of `lib/octahedral.wgsl`: unit vectors in 32 bits. Cigolla and others, "A Survey of Efficient Representations for
//! Independent Unit Vectors", JCGT 2014, section 3: the octahedral map. Off by 6.5e-5 rad at most.

use glam::{DVec2, DVec3};

use crate::cpu::builtin::{pack2x16snorm, unpack2x16snorm};

/// The lower half of the octahedron, folded outwards over the upper; its own inverse.
pub fn oct_fold(v: DVec2) -> DVec2 {
    let sign = |x: f64| if x >= 0.0 { 1.0 } else { -1.0 };
    DVec2::new((1.0 - v.y.abs()) * sign(v.x), (1.0 - v.x.abs()) * sign(v.y))
}

/// Code of a direction of any length; 0, which decodes to +z, where it has none.
pub fn oct_encode(n: DVec3) -> u32 {
    let sum = n.x.abs() + n.y.abs() + n.z.abs();
    if sum.is_nan() || sum <= 0.0 {
        return 0;
    }
    let mut p = n.truncate() / sum;
    if n.z < 0.0 {
        p = oct_fold(p);
    }
    pack2x16snorm(p)
}

/// Unit vector of a code.
pub fn oct_decode(code: u32) -> DVec3 {
    let p = unpack2x16snorm(code);
    let z = 1.0 - p.x.abs() - p.y.abs();
    let xy = if z < 0.0 { oct_fold(p) } else { p };
    xy.extend(z).normalize()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn decoded_directions_are_within_the_stated_angle() {
        let mut worst = 0.0_f64;
        for i in 0..20_000_u32 {
            // Fibonacci's spiral visits the sphere evenly.
            let z = 1.0 - (2.0 * f64::from(i) + 1.0) / 20_000.0;
            let (sin, cos) = (2.399_963_229_728_653 * f64::from(i)).sin_cos();
            let r = (1.0 - z * z).sqrt();
            let n = DVec3::new(r * cos, r * sin, z);
            worst = worst.max(oct_decode(oct_encode(n)).cross(n).length());
        }
        // Half a step of 1/32767 in x and y, hence their sum in z: sqrt(6) / 65534 along a face whose middle is 1/sqrt(3)
        // from the centre.
        assert!(worst < 18_f64.sqrt() / 65534.0, "{worst} rad");
        assert!(worst > 3e-5, "{worst} rad: too good for 16 bits");
    }

    #[test]
    fn axes_are_exact_and_no_direction_is_up() {
        for n in [DVec3::X, DVec3::Y, DVec3::Z, DVec3::NEG_X, DVec3::NEG_Y, DVec3::NEG_Z] {
            assert_eq!(oct_decode(oct_encode(n)), n);
        }
        assert_eq!(oct_decode(oct_encode(DVec3::ZERO)), DVec3::Z);
        assert_eq!(oct_encode(DVec3::NAN), 0);
    }
}
