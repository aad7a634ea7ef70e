// A face's light-aligned frame. Suarez and others, "GPU real time hatching", 2013, algorithm 1:
// N from the corners, B the normalised projection of the light on the face, T = B x N.
//
// The hardened form keeps it and adds what the paper leaves open: which way strokes run under several lights, and what
// happens where a light stands on the normal and the projection vanishes. The projections p_i, squared as complex
// numbers in a tangent frame fixed to the face (so that opposite directions count alike), are summed with the lights'
// weights: half the argument is the dominant direction of the projected light tensor. Where the sum is short, the
// fixed frame fades in; where the axis is clear but lights from both sides cancel, the frame turned by half fades in.
// All three shares are continuous in the lights, so nothing jumps or spins.
//!include lib/light.wgsl
//!include lib/form.wgsl

// Below this sine of the angle between light and normal the fixed frame has a share.
const SINE_BAND: f32 = 0.2;

struct Frame {
    tangent: vec3f,
    bitangent: vec3f,
    // Shares of the frame, of the frame turned by half, and of the fixed frame; they sum to 1.
    shares: vec3f,
}

// The axis whose projection is the fixed tangent: up, where the face is not level, else forward; never degenerate.
fn fixed_tangent(n: vec3f) -> vec3f {
    let up = select(vec3f(0.0, 1.0, 0.0), vec3f(0.0, 0.0, 1.0), abs(n.y) > 0.9);
    return normalize(cross(up, n));
}

fn complex_square(z: vec2f) -> vec2f {
    return vec2f(z.x * z.x - z.y * z.y, 2.0 * z.x * z.y);
}

// Half the argument, as a unit vector with x >= 0.
fn half_angle(z: vec2f) -> vec2f {
    let r = length(z);
    if !(r > 1e-20) {
        return vec2f(1.0, 0.0);
    }
    let c = z.x / r;
    let x = sqrt(max(0.0, 0.5 * (1.0 + c)));
    let y = sqrt(max(0.0, 0.5 * (1.0 - c)));
    return vec2f(x, select(-y, y, z.y >= 0.0));
}

// Algorithm 1, as printed. n is unit, l any length.
fn frame_literal(n: vec3f, l: vec3f) -> Frame {
    let b = normalize(l - n * dot(l, n));
    return Frame(cross(b, n), b, vec3f(1.0, 0.0, 0.0));
}

fn frame_hardened(n: vec3f, g_world: vec3f) -> Frame {
    // The fixed frame: e, and f so that (e, f, n) is to (T, B, N) as T = B x N asks.
    let e = fixed_tangent(n);
    let f = cross(n, e);
    var tensor = vec2f(0.0);
    var sum = vec2f(0.0);
    var total = 0.0;
    for (var i = 0u; i < scene.light_count; i++) {
        let light = scene.lights[i];
        let l = to_light(light, g_world);
        let weight = light.intensity * max(1e-3, arriving(light, l) / max(light.intensity, 1e-6));
        let p = vec2f(dot(l, e), dot(l, f));
        tensor += weight * complex_square(p);
        sum += weight * p;
        total += weight;
    }
    let scale = 1.0 / max(total, 1e-6);
    let sine = sqrt(length(tensor) * scale);
    // Of the two ways along the axis the one towards the lights, as with a single light.
    var axis = half_angle(tensor);
    if dot(axis, sum) < 0.0 {
        axis = -axis;
    }
    let clear = smoothstep(0.25 * SINE_BAND, SINE_BAND, sine);
    let side = smoothstep(-1.0, 1.0, dot(axis, sum) * scale / (0.5 * max(sine, SINE_BAND)));
    let b = axis.x * e + axis.y * f;
    return Frame(cross(b, n), b, vec3f(clear * side, clear * (1.0 - side), 1.0 - clear));
}

fn pack_shares(shares: vec3f) -> u32 {
    let q = vec3u(round(clamp(shares, vec3f(0.0), vec3f(1.0)) * 1023.0));
    return q.x | (q.y << 10u) | (q.z << 20u);
}

fn unpack_shares(code: u32) -> vec3f {
    let q = vec3f(f32(code & 1023u), f32((code >> 10u) & 1023u), f32((code >> 20u) & 1023u));
    return q / max(q.x + q.y + q.z, 1.0);
}

// The frame at a face's centre g, in the space of the frames. The paper knows one light, taken in the mesh's own space.
fn light_frame(n: vec3f, g: vec3f) -> Frame {
    if FORM == FORM_LITERAL {
        let light = scene.lights[0];
        var l = -(scene.mesh_from_world * vec4f(light.direction, 0.0)).xyz;
        if light.kind != LIGHT_DIRECTIONAL {
            l = (scene.mesh_from_world * vec4f(light.position, 1.0)).xyz - g;
        }
        return frame_literal(n, l);
    }
    return frame_hardened(n, g);
}
