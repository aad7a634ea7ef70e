// Patterns that overlap. Union draws each at a reduced darkness, so that strokes thin out in the order of their
// sequence and end whole; it needs patterns that are independent of each other. Linear greys strokes, as pencil does.
// The pass that includes this defines pattern_ink(uv, scale, darkness).
//!include lib/mapping.wgsl
//!include lib/patched.wgsl
//!include lib/columns.wgsl

const BLEND_UNION: u32 = 0u;
const BLEND_LINEAR: u32 = 1u;
override BLEND: u32 = 0u;

// What is left of the light at a darkness, as an exponent of 2: what the patterns of a union have in common.
fn log2_light(d: f32) -> f32 {
    return log2(max(1.0 - d, 1e-6));
}

// The darkness at which a pattern of this weight takes part, so that the union of all has the darkness of that light.
fn union_darkness(light: f32, weight: f32) -> f32 {
    return 1.0 - exp2(weight * light);
}

fn blended_ink(mapped: Mapped, d: f32) -> f32 {
    // The frames of one face share their offset, so their patterns are not independent.
    let linear = BLEND == BLEND_LINEAR || MAPPING == MAPPING_FRAMES;
    let patterns = array<Pattern, 3>(mapped.a, mapped.b, mapped.c);
    let count = pattern_count(mapped);
    let scale = map_scale(mapped.tiles_per_px);
    let light = log2_light(d);
    var sum = 0.0;
    var clear = 1.0;
    for (var i = 0u; i < count; i++) {
        let pattern = patterns[i];
        if linear {
            sum += pattern.weight * pattern_ink(pattern.uv, scale, d);
        } else {
            clear *= 1.0 - pattern_ink(pattern.uv, scale, union_darkness(light, pattern.weight));
        }
    }
    return select(1.0 - clear, sum, linear);
}

// What the strokes of one patch leave of the paper, 1 where it has no share; of a linear blend the ink that they add.
// `light` is log2_light(d).
fn patch_ink(place: vec2f, seed: u32, share: f32, scale: Scale, d: f32, light: f32) -> f32 {
    var ink = select(1.0, 0.0, BLEND == BLEND_LINEAR);
    if share <= 0.0 {
        return ink;
    }
    for (var copy = 0u; copy < select(1u, TURNS, FOLLOW == FOLLOW_LIGHT); copy++) {
        let turn = seed_turn(seed, copy);
        let weight = share * turn.w;
        if weight > 0.0 {
            let uv = turned_uv(place, turn);
            if BLEND == BLEND_LINEAR {
                ink += weight * pattern_ink(uv, scale, d);
            } else {
                ink *= 1.0 - pattern_ink(uv, scale, union_darkness(light, weight));
            }
        }
    }
    return ink;
}

// Patches are independent of each other: each lies on the tile by chance. The heaviest comes first, until none is left that
// has a weight: mostly two or three do. The loop is tested at its end, as that of the lights.
fn patches_ink(overlap: Overlap, scale: Scale, d: f32) -> f32 {
    let linear = BLEND == BLEND_LINEAR;
    let light = log2_light(d);
    var left = overlap_weights(overlap.behind);
    var ink = select(1.0, 0.0, linear);
    loop {
        let i = heaviest(left);
        let own = patch_ink(place_of(overlap, i), overlap.seeds[i], left[i], scale, d, light);
        ink = select(ink * own, ink + own, linear);
        left = without(left, i);
        if all(left <= vec4f(0.0)) {
            break;
        }
    }
    return select(1.0 - ink, ink, linear);
}

// One lapped texture painted over what lies under it.
fn painted_ink(under: f32, place: vec2f, alpha: f32, scale: Scale, d: f32) -> f32 {
    if alpha <= 0.0 {
        return under;
    }
    return mix(under, pattern_ink(tile_uv(place), scale, d), min(alpha, 1.0));
}

// Painted one over the other, as Praun and others do: later ones hide earlier ones by their alpha. What is painted steps
// forward in a row of eight, until none is left.
fn lapped_ink(lapped: Lapped, scale: Scale, d: f32) -> f32 {
    var row = lapped;
    var ink = 0.0;
    loop {
        ink = painted_ink(ink, row.first.places_ab.xy, row.first.behind.x, scale, d);
        row = stepped(row);
        if all(max(row.first.behind, row.then.behind) <= vec4f(0.0)) {
            break;
        }
    }
    return ink;
}

fn surface_ink(point: Point, overlap: Overlap, d: f32) -> f32 {
    if MAPPING == MAPPING_PATCHES {
        return patches_ink(overlap, map_scale(mean_footprint(point)), d);
    }
    return blended_ink(map_surface(point), d);
}
