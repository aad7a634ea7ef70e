// Patterns that overlap. Union draws each at a reduced darkness, so that strokes thin out in the order of their
// sequence and end whole; it needs patterns that are independent of each other. Linear greys strokes, as pencil does.
// The pass that includes this defines pattern_ink(uv, tiles_per_px, darkness).
//!include lib/mapping.wgsl

const BLEND_UNION: u32 = 0u;
const BLEND_LINEAR: u32 = 1u;
override BLEND: u32 = 0u;

// The darkness at which a pattern of this weight takes part, so that the union of all has darkness d.
fn union_darkness(d: f32, weight: f32) -> f32 {
    return 1.0 - pow(max(1.0 - d, 1e-6), weight);
}

fn blended_ink(mapped: Mapped, d: f32) -> f32 {
    // The frames of one face share their offset, so their patterns are not independent.
    let linear = BLEND == BLEND_LINEAR || MAPPING == MAPPING_FRAMES;
    let patterns = array<Pattern, 3>(mapped.a, mapped.b, mapped.c);
    let count = pattern_count(mapped);
    var sum = 0.0;
    var clear = 1.0;
    for (var i = 0u; i < count; i++) {
        let pattern = patterns[i];
        if linear {
            sum += pattern.weight * pattern_ink(pattern.uv, mapped.tiles_per_px, d);
        } else {
            let reduced = union_darkness(d, pattern.weight);
            clear *= 1.0 - pattern_ink(pattern.uv, mapped.tiles_per_px, reduced);
        }
    }
    return select(1.0 - clear, sum, linear);
}
