//! Twin of `lib/light.wgsl`: tone from several lights. Suarez and others, "GPU real time hatching", 2013, sections 3.2
//! and 3.4; Phong 1975 for the highlight.

use glam::DVec3;

use super::scene::{LIGHT_DIRECTIONAL, LIGHT_SPOT, Light, Scene};
use crate::cpu::builtin::inverse_sqrt;

/// What a material does with light.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Reflectance {
    /// Share of the scene's ambient light that is seen.
    pub ambient: f64,
    /// Diffuse reflectance.
    pub diffuse: f64,
    /// Strength of the highlight.
    pub specular: f64,
    /// Its exponent.
    pub shininess: f64,
}

/// Unit vector from a point to a light.
pub fn to_light(light: &Light, p_world: DVec3) -> DVec3 {
    if light.kind == LIGHT_DIRECTIONAL {
        return -light.direction;
    }
    let v = light.position - p_world;
    v * inverse_sqrt(v.dot(v).max(1e-20))
}

/// Intensity that arrives at a point: 0 outside a spot's cut-off.
pub fn arriving(light: &Light, l: DVec3) -> f64 {
    if light.kind != LIGHT_SPOT {
        return light.intensity;
    }
    let c = (-l).dot(light.direction);
    if c < light.cos_cutoff {
        return 0.0;
    }
    light.intensity * c.max(0.0).powf(light.exponent)
}

/// Luminance of a surface point, not clamped. `n` and `v` (towards the camera) are unit.
pub fn luminance(scene: &Scene, r: Reflectance, p_world: DVec3, n: DVec3, v: DVec3) -> f64 {
    let mut y = scene.ambient * r.ambient;
    for light in &scene.lights {
        let l = to_light(light, p_world);
        let e = arriving(light, l);
        let n_l = n.dot(l);
        if n_l > 0.0 && e > 0.0 {
            let r_v = (2.0 * n_l * n - l).dot(v).max(0.0);
            y += e * (r.diffuse * n_l + r.specular * r_v.max(1e-6).powf(r.shininess));
        }
    }
    y
}

/// Wanted darkness, 0 paper ..= 1 ink.
pub fn darkness(scene: &Scene, r: Reflectance, p_world: DVec3, n: DVec3, v: DVec3) -> f64 {
    1.0 - luminance(scene, r, p_world, n, v).clamp(0.0, 1.0)
}
