// Overlapping parametrisations of a surface. Praun and others, "Real-Time Hatching", 2001, section 6. The corners of a
// triangle carry the patches that it sees, and all of it is interpolated.
// As patches: the nearest has weight 1, others fade out with the distance they stand behind it. As lapped textures:
// in the order of painting, each with its alpha.
//!include lib/form.wgsl
//!include lib/mapping.wgsl

// TURNS texels per seed: place of the seed on the tile, angle, share.
@group(3) @binding(2) var seed_turns: texture_2d<f32>;

// Whether patches lie still on the surface, or turn about their seeds with the light.
const FOLLOW_SURFACE: u32 = 0u;
const FOLLOW_LIGHT: u32 = 1u;
override FOLLOW: u32 = 0u;
const TURNS: u32 = 3u;
const NO_SEED: u32 = 0xffffffffu;

const MAPPING_PATCHES: u32 = 3u;
const MAPPING_LAPPED: u32 = 4u;
const PLACE_RANGE: f32 = 4.0;
const BEHIND_RANGE: f32 = 4.0;

// The patches that overlap at a fragment, interpolated between the corners; those that are not there stand far behind, or
// have no alpha.
struct Overlap {
    // Places on the tile, of two patches each.
    places_ab: vec4f,
    places_cd: vec4f,
    // Distances behind the nearest, in feathers; of lapped textures the alphas.
    behind: vec4f,
    seeds: vec4u,
}

// What a corner sees, from what it carries.
fn carried_overlap(places_ab: vec4f, places_cd: vec4f, behind: vec4f, seeds: vec4u) -> Overlap {
    let range = select(BEHIND_RANGE, 1.0, MAPPING == MAPPING_LAPPED);
    return Overlap(PLACE_RANGE * places_ab, PLACE_RANGE * places_cd, range * behind, seeds);
}

// How a seed's patch lies on the tile, in one of the copies that are drawn of it: two at the quantised angles on
// both sides of the wanted one, and one along the fixed direction where the light gives none.
fn seed_turn(seed: u32, copy: u32) -> vec4f {
    let alone = vec4f(0.0, 0.0, 0.0, select(0.0, 1.0, copy == 0u));
    if FOLLOW == FOLLOW_SURFACE || seed == NO_SEED {
        return alone;
    }
    let texel = seed * TURNS + copy;
    let width = textureDimensions(seed_turns).x;
    return textureLoad(seed_turns, vec2u(texel % width, texel / width), 0);
}

fn turned_uv(place: vec2f, turn: vec4f) -> vec2f {
    let c = cos(turn.z);
    let s = sin(turn.z);
    return tile_uv(turn.xy + vec2f(c * place.x - s * place.y, s * place.x + c * place.y));
}

// The weights of the patches that overlap: the nearest has 1, before all are made to sum to 1.
fn overlap_weights(behind: vec4f) -> vec4f {
    let least = min(min(behind.x, behind.y), min(behind.z, behind.w));
    let weights = max(vec4f(0.0), vec4f(1.0) - (behind - least));
    return weights / dot(weights, vec4f(1.0));
}

// Which of four weights is the greatest, the first of equals.
fn heaviest(weights: vec4f) -> u32 {
    var i = select(0u, 1u, weights.y > weights.x);
    var most = max(weights.x, weights.y);
    i = select(i, 2u, weights.z > most);
    most = max(most, weights.z);
    return select(i, 3u, weights.w > most);
}

// Four weights but for one, which becomes 0.
fn without(weights: vec4f, i: u32) -> vec4f {
    return select(weights, vec4f(0.0), vec4u(0u, 1u, 2u, 3u) == vec4u(i));
}

// The place of one of the patches.
fn place_of(overlap: Overlap, i: u32) -> vec2f {
    let pair = select(overlap.places_cd, overlap.places_ab, i < 2u);
    return select(pair.zw, pair.xy, (i & 1u) == 0u);
}
