// Patterns that overlap. Union draws each at a reduced darkness, so that strokes thin out in the order of their
// sequence and end whole; it needs patterns that are independent of each other. Linear greys strokes, as pencil does.
// The pass that includes this defines pattern_ink(uv, tiles_per_px, darkness).
//!include lib/mapping.wgsl
//!include lib/patches.wgsl

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

// Patches are independent of each other: each lies on the tile by chance.
fn patches_ink(face: u32, corners: vec3f, tiles_per_px: f32, d: f32) -> f32 {
    let patches = patches_at(face, corners);
    var sum = 0.0;
    var clear = 1.0;
    for (var i = 0u; i < patches.count; i++) {
        let share = patch_weight(patches, i);
        if share == 0.0 {
            continue;
        }
        let entry = patches.first + i;
        let place = patch_place(patch_entries[entry].places, corners);
        for (var copy = 0u; copy < select(1u, TURNS, FOLLOW == FOLLOW_LIGHT); copy++) {
            let turn = entry_turn(entry, copy);
            let weight = share * turn.w;
            if weight > 0.0 {
                let uv = turned_uv(place, turn);
                if BLEND == BLEND_LINEAR {
                    sum += weight * pattern_ink(uv, tiles_per_px, d);
                } else {
                    clear *= 1.0 - pattern_ink(uv, tiles_per_px, union_darkness(d, weight));
                }
            }
        }
    }
    return select(1.0 - clear, sum, BLEND == BLEND_LINEAR);
}

// Painted one over the other, as Praun and others do: later ones hide earlier ones by their alpha.
fn lapped_ink(face: u32, corners: vec3f, tiles_per_px: f32, d: f32) -> f32 {
    let first = patch_starts[face];
    let count = min(patch_starts[face + 1u] - first, MAX_PATCHES);
    var ink = 0.0;
    for (var i = 0u; i < count; i++) {
        let entry = patch_entries[first + i];
        let alpha = clamp(dot(unpack_tens(entry.shares), corners), 0.0, 1.0);
        if alpha > 0.0 {
            ink = mix(ink, pattern_ink(tile_uv(patch_place(entry.places, corners)), tiles_per_px, d), alpha);
        }
    }
    return ink;
}

fn surface_ink(point: Point, d: f32) -> f32 {
    if MAPPING == MAPPING_PATCHES || MAPPING == MAPPING_LAPPED {
        let corners = corner_weights(point.face, frame_place(point.p_world));
        if MAPPING == MAPPING_LAPPED {
            return lapped_ink(point.face, corners, mean_footprint(point), d);
        }
        return patches_ink(point.face, corners, mean_footprint(point), d);
    }
    return blended_ink(map_surface(point), d);
}
