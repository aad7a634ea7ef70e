//! Twin of `lib/face_frame.wgsl`: a face's light-aligned frame. Suarez and others, "GPU real time hatching", 2013,
//! algorithm 1; the hardened form is explained there.

use glam::{DVec2, DVec3};

use super::light::{arriving, to_light};
use super::scene::{LIGHT_DIRECTIONAL, Scene};
use crate::cpu::Form;
use crate::cpu::builtin::smoothstep;

/// Below this sine of the angle between light and normal the fixed frame has a share.
pub const SINE_BAND: f64 = 0.2;

/// A frame with what it is mixed with.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Frame {
    /// Along the strokes.
    pub tangent: DVec3,
    /// Across them, towards the light.
    pub bitangent: DVec3,
    /// Shares of the frame, of the frame turned by half, and of the fixed frame; they sum to 1.
    pub shares: DVec3,
}

/// The axis whose projection is the fixed tangent: up, where the face is not level, else forward; never degenerate.
pub fn fixed_tangent(n: DVec3) -> DVec3 {
    // The shader compares with the nearest 32-bit number.
    let up = if n.y.abs() > f64::from(0.9_f32) { DVec3::Z } else { DVec3::Y };
    up.cross(n).normalize()
}

/// Square of a complex number.
pub fn complex_square(z: DVec2) -> DVec2 {
    DVec2::new(z.x * z.x - z.y * z.y, 2.0 * z.x * z.y)
}

/// Half the argument, as a unit vector with x >= 0.
pub fn half_angle(z: DVec2) -> DVec2 {
    let r = z.length();
    if r.is_nan() || r <= 1e-20 {
        return DVec2::X;
    }
    let c = z.x / r;
    let x = (0.5 * (1.0 + c)).max(0.0).sqrt();
    let y = (0.5 * (1.0 - c)).max(0.0).sqrt();
    DVec2::new(x, if z.y >= 0.0 { y } else { -y })
}

/// Algorithm 1, as printed. `n` is unit, `l` any length.
pub fn frame_literal(n: DVec3, l: DVec3) -> Frame {
    let b = (l - n * l.dot(n)).normalize();
    Frame { tangent: b.cross(n), bitangent: b, shares: DVec3::X }
}

/// The frame along the dominant direction of the projected lights at a face's centre.
pub fn frame_hardened(scene: &Scene, n: DVec3, g_world: DVec3) -> Frame {
    let e = fixed_tangent(n);
    let f = n.cross(e);
    let mut tensor = DVec2::ZERO;
    let mut sum = DVec2::ZERO;
    let mut total = 0.0;
    for light in &scene.lights {
        let l = to_light(light, g_world);
        let weight = light.intensity * (arriving(light, l) / light.intensity.max(1e-6)).max(1e-3);
        let p = DVec2::new(l.dot(e), l.dot(f));
        tensor += weight * complex_square(p);
        sum += weight * p;
        total += weight;
    }
    let scale = 1.0 / total.max(1e-6);
    let sine = (tensor.length() * scale).sqrt();
    let mut axis = half_angle(tensor);
    if axis.dot(sum) < 0.0 {
        axis = -axis;
    }
    let clear = smoothstep(0.25 * SINE_BAND, SINE_BAND, sine);
    let side = smoothstep(-1.0, 1.0, axis.dot(sum) * scale / (0.5 * sine.max(SINE_BAND)));
    let b = axis.x * e + axis.y * f;
    Frame { tangent: b.cross(n), bitangent: b, shares: DVec3::new(clear * side, clear * (1.0 - side), 1.0 - clear) }
}

/// Three shares of 0 ..= 1 in ten bits each.
pub fn pack_shares(shares: DVec3) -> u32 {
    let q = shares.to_array().map(|share| (share.clamp(0.0, 1.0) * 1023.0).round_ties_even() as u32);
    q[0] | q[1] << 10 | q[2] << 20
}

/// The shares of a code, brought to the sum 1.
pub fn unpack_shares(code: u32) -> DVec3 {
    let q = DVec3::from([code, code >> 10, code >> 20].map(|bits| f64::from(bits & 1023)));
    q / q.element_sum().max(1.0)
}

/// The frame at a face's centre `g`, in the space of the frames.
pub fn light_frame(form: Form, scene: &Scene, n: DVec3, g: DVec3) -> Frame {
    match form {
        Form::Literal => {
            let light = &scene.lights[0];
            let mut l = -(scene.mesh_from_world * light.direction.extend(0.0)).truncate();
            if light.kind != LIGHT_DIRECTIONAL {
                l = (scene.mesh_from_world * light.position.extend(1.0)).truncate() - g;
            }
            frame_literal(n, l)
        }
        Form::Hardened => frame_hardened(scene, n, g),
    }
}
