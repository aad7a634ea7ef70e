// Unit vectors in 32 bits. Cigolla and others, "A Survey of Efficient Representations for Independent Unit Vectors",
// JCGT 2014, section 3: the octahedral map. Off by 6.5e-5 rad at most.

fn oct_fold(v: vec2f) -> vec2f {
    let s = vec2f(select(-1.0, 1.0, v.x >= 0.0), select(-1.0, 1.0, v.y >= 0.0));
    return (1.0 - abs(v.yx)) * s;
}

fn oct_encode(n: vec3f) -> u32 {
    let sum = abs(n.x) + abs(n.y) + abs(n.z);
    if !(sum > 0.0) {
        return 0u;
    }
    var p = n.xy / sum;
    if n.z < 0.0 {
        p = oct_fold(p);
    }
    return pack2x16snorm(p);
}

fn oct_decode(code: u32) -> vec3f {
    let p = unpack2x16snorm(code);
    let z = 1.0 - abs(p.x) - abs(p.y);
    var xy = p;
    if z < 0.0 {
        xy = oct_fold(p);
    }
    return normalize(vec3f(xy, z));
}
