// Overlapping parametrisations of a surface. Praun and others, "Real-Time Hatching", 2001, section 6. The corners of a
// triangle carry the patches that it sees; stripes and lapped textures find them by face.
// As patches: the nearest has weight 1, others fade out with the distance they stand behind it. As lapped textures:
// in the order of painting, each with its alpha.
//!include lib/form.wgsl
//!include lib/mapping.wgsl
//!include lib/barycentric.wgsl

struct PatchEntry {
    // Place of each corner on the tile, two 16-bit snorm, in units of PLACE_RANGE tiles.
    places: vec3u,
    // Per corner a 10-bit unorm, low bits first: distance behind the nearest patch in units of BEHIND_RANGE feathers;
    // of lapped textures the alpha.
    shares: u32,
}

// Two records per corner: four places on the tile, as those of an entry; then four distances behind the nearest patch, two
// 16-bit unorm to the word, in units of BEHIND_RANGE feathers, the vertex that stands there, and where the record of its
// patches' seeds is. All corners of a triangle have the same patches in the same order.
@group(3) @binding(6) var<storage, read> patch_corners: array<vec4u>;
// Per face its first entry, then the number of entries, then per entry its rows where there are stripes, then its seed.
@group(3) @binding(0) var<storage, read> patch_starts: array<u32>;
@group(3) @binding(1) var<storage, read> patch_entries: array<PatchEntry>;
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
const MAX_PATCHES: u32 = 8u;
const PLACE_RANGE: f32 = 4.0;
const BEHIND_RANGE: f32 = 4.0;

// The patches that overlap at a fragment, interpolated between the corners; those that are not there stand far behind.
struct Overlap {
    // Places on the tile, of two patches each.
    places_ab: vec4f,
    places_cd: vec4f,
    // Distances behind the nearest, in feathers.
    behind: vec4f,
    seeds: vec4u,
}

// The patches of a face as a fragment sees them.
struct Patches {
    first: u32,
    count: u32,
    // Barycentric weights of the corners.
    corners: vec3f,
    // How far the nearest stands behind, and the sum of all weights before they are made to sum to 1.
    least: f32,
    sum: f32,
}

fn unpack_tens(code: u32) -> vec3f {
    return vec3f(f32(code & 1023u), f32((code >> 10u) & 1023u), f32((code >> 20u) & 1023u)) / 1023.0;
}

fn patch_place(places: vec3u, corners: vec3f) -> vec2f {
    let place = corners.x * unpack2x16snorm(places.x) + corners.y * unpack2x16snorm(places.y)
        + corners.z * unpack2x16snorm(places.z);
    return PLACE_RANGE * place;
}

fn entry_seed(entry: u32) -> u32 {
    return patch_starts[arrayLength(&patch_starts) - arrayLength(&patch_entries) + entry];
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

// The vertex of a corner.
fn corner_vertex(corner: u32) -> u32 {
    return patch_corners[2u * corner + 1u].z;
}

// What a corner sees.
fn corner_overlap(corner: u32) -> Overlap {
    let places = patch_corners[2u * corner];
    let rest = patch_corners[2u * corner + 1u];
    var seeds = vec4u(NO_SEED);
    if FOLLOW == FOLLOW_LIGHT {
        seeds = patch_corners[rest.w];
    }
    return Overlap(
        PLACE_RANGE * vec4f(unpack2x16snorm(places.x), unpack2x16snorm(places.y)),
        PLACE_RANGE * vec4f(unpack2x16snorm(places.z), unpack2x16snorm(places.w)),
        BEHIND_RANGE * vec4f(unpack2x16unorm(rest.x), unpack2x16unorm(rest.y)),
        seeds,
    );
}

// The weights of the patches that overlap: the nearest has 1, before all are made to sum to 1.
fn overlap_weights(behind: vec4f) -> vec4f {
    let least = min(min(behind.x, behind.y), min(behind.z, behind.w));
    let weights = max(vec4f(0.0), vec4f(1.0) - (behind - least));
    return weights / dot(weights, vec4f(1.0));
}

// How far a fragment stands behind the nearest patch in an entry's.
fn patch_behind(entry: u32, corners: vec3f) -> f32 {
    return BEHIND_RANGE * dot(unpack_tens(patch_entries[entry].shares), corners);
}

fn patches_at(face: u32, corners: vec3f) -> Patches {
    let first = patch_starts[face];
    let count = min(patch_starts[face + 1u] - first, MAX_PATCHES);
    var least = 1e9;
    for (var i = 0u; i < count; i++) {
        least = min(least, patch_behind(first + i, corners));
    }
    var sum = 0.0;
    for (var i = 0u; i < count; i++) {
        sum += max(0.0, 1.0 - (patch_behind(first + i, corners) - least));
    }
    return Patches(first, count, corners, least, sum);
}

// The weight of one of the patches; read again rather than kept, as arrays cost more than loads.
fn patch_weight(patches: Patches, i: u32) -> f32 {
    return max(0.0, 1.0 - (patch_behind(patches.first + i, patches.corners) - patches.least)) / patches.sum;
}
