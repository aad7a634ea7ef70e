// Tone from several lights: luminances add, then clamp; darkness is what is missing to 1.
// Suarez and others, "GPU real time hatching", 2013, section 3.4 (dot product of the fragment-light vector and the
// normal); spot cut-off and exponent after section 3.2; Phong 1975 for the highlight.
//!include lib/scene.wgsl

struct Reflectance {
    ambient: f32,
    diffuse: f32,
    specular: f32,
    shininess: f32,
}

// Unit vector from a point to a light.
fn to_light(light: Light, p_world: vec3f) -> vec3f {
    if light.kind == LIGHT_DIRECTIONAL {
        return -light.direction;
    }
    let v = light.position - p_world;
    return v * inverseSqrt(max(dot(v, v), 1e-20));
}

// Intensity that arrives at a point: 0 outside a spot's cut-off.
fn arriving(light: Light, l: vec3f) -> f32 {
    if light.kind != LIGHT_SPOT {
        return light.intensity;
    }
    let c = dot(-l, light.direction);
    if c < light.cos_cutoff {
        return 0.0;
    }
    return light.intensity * pow(max(c, 0.0), light.exponent);
}

// Luminance of a surface point, not clamped. n and v (towards the camera) are unit.
fn luminance(r: Reflectance, p_world: vec3f, n: vec3f, v: vec3f) -> f32 {
    var y = scene.ambient * r.ambient;
    // Tested at its end: adapters that run fragments in groups run a loop that is tested first once more than they need.
    var i = 0u;
    loop {
        let light = scene.lights[i];
        let l = to_light(light, p_world);
        let e = arriving(light, l);
        let n_l = dot(n, l);
        if i < scene.light_count && n_l > 0.0 && e > 0.0 {
            let r_v = max(dot(2.0 * n_l * n - l, v), 0.0);
            y += e * (r.diffuse * n_l + r.specular * pow(max(r_v, 1e-6), r.shininess));
        }
        i++;
        if i >= scene.light_count {
            break;
        }
    }
    return y;
}

// Wanted darkness, 0 paper ..= 1 ink.
fn darkness(r: Reflectance, p_world: vec3f, n: vec3f, v: vec3f) -> f32 {
    return 1.0 - clamp(luminance(r, p_world, n, v), 0.0, 1.0);
}
