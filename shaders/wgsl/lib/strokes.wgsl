// Lines cut by a burin: each is a row of strokes that swell and taper, with gaps between them, and wavers slightly.
// Rows are known on patches, where the phase is unwrapped; what a stroke looks like is drawn by lot from seed, row and
// cell. A stroke changes the darkness of its own line, which is then thresholded once: the mean is kept.
//!include lib/halftone.wgsl
//!include lib/patches.wgsl

// Length of a stroke of the coarsest lines, in tiles; lines that come with a doubling have strokes shorter by sqrt(2).
const STROKE_TILES: f32 = 1.6;
// At variety 1: share of a cell that is a gap, and how much strokes differ in strength.
const GREATEST_GAP: f32 = 0.2;
const GREATEST_DIFFERENCE: f32 = 0.3;
// Mean of a stroke's profile.
const PROFILE_MEAN: f32 = 0.75;
// Share of the free space beside a line that it wavers through, at variety 1.
const GREATEST_WAVER: f32 = 0.5;

// A stroke at a place of its line.
struct Stroke {
    // Its darkness over the mean, minus 1; 0 in the mean.
    swell: f32,
    // Its shift across, -1..=1.
    waver: f32,
}

// The finaliser of Wellons, "Prospecting for hash functions", 2018.
fn mixed_bits(bits: u32) -> u32 {
    var x = bits;
    x = (x ^ (x >> 16u)) * 0x7feb352du;
    x = (x ^ (x >> 15u)) * 0x846ca68bu;
    return x ^ (x >> 16u);
}

// A number 0..1 by lot.
fn lot(key: u32, counter: u32) -> f32 {
    return f32(mixed_bits(key + counter * 0x9e3779b9u) >> 8u) / 16777216.0;
}

// How often lines were doubled when the one in this row came, rows being counted after `octave` doublings.
fn row_octave(row: i32, octave: u32) -> u32 {
    return octave - min(firstTrailingBit(u32(row)), octave);
}

// The lot of the line in a row, counted when it came.
fn row_key(seed: u32, row: i32, born: u32) -> u32 {
    return mixed_bits(mixed_bits(u32(row) + 0x68e31da4u * born) + seed);
}

// Shift of a line's cells, 0..1. New lines are two rows apart: their shifts grow by the golden section, so that no two
// strokes side by side swell together.
fn row_shift(row: i32) -> f32 {
    return f32((u32(row) * 0x4f1bbcdcu) >> 8u) / 16777216.0;
}

// Where cell c of a line starts; cells are 0.5 to 1.5 long.
fn cell_start(key: u32, c: i32) -> f32 {
    return f32(c) + 0.5 * lot(key, 4u * u32(c) + 4u);
}

fn stroke_gap(variety: f32) -> f32 {
    return GREATEST_GAP * variety * variety;
}

// The greatest swell of any stroke.
fn greatest_swell(variety: f32) -> f32 {
    return (1.0 + GREATEST_DIFFERENCE * variety) / (PROFILE_MEAN * (1.0 - stroke_gap(variety))) - 1.0;
}

// Thickness of a stroke from its one end to the other, t in 0..=1, thickest at `peak`; its mean is PROFILE_MEAN.
fn stroke_profile(t: f32, peak: f32) -> f32 {
    let off = clamp(select((t - peak) / (1.0 - peak), (peak - t) / peak, t < peak), 0.0, 1.0);
    return 1.0 - off * off * off;
}

// The stroke of a line at a place along it, in tiles; `row` is counted when the line came.
fn stroke_at(key: u32, row: i32, born: u32, along: f32, variety: f32) -> Stroke {
    let x = along * exp2(0.5 * f32(born)) / STROKE_TILES + row_shift(row);
    var c = i32(floor(x));
    c -= select(0, 1, x < cell_start(key, c));
    let start = cell_start(key, c);
    let gap = stroke_gap(variety);
    let t = (x - start) / ((cell_start(key, c + 1) - start) * (1.0 - gap));
    let strength = 1.0 + GREATEST_DIFFERENCE * variety * (2.0 * lot(key, 4u * u32(c) + 5u) - 1.0);
    let profile = stroke_profile(t, mix(0.3, 0.7, lot(key, 4u * u32(c) + 6u)));
    let wave = sin(6.2831853 * fract(0.8 * x + lot(key, 1u)));
    return Stroke(strength * profile / (PROFILE_MEAN * (1.0 - gap)) - 1.0, wave);
}

// Darkness of a stroke where all together have d: in 0..=1, and d in the mean. In the dark it differs less.
fn stroke_darkness(d: f32, swell: f32, variety: f32) -> f32 {
    let most = min(d, (1.0 - d) / greatest_swell(variety));
    return d + min(1.0, 1.6 * variety) * most * swell;
}

// How far from the middle of its strip any stroke has ink: the thickest one, wavering as far as it may.
fn stroke_reach(strip: f32, d: f32, variety: f32) -> f32 {
    let most = stroke_darkness(d, greatest_swell(variety), variety);
    return 0.5 * strip * (most + GREATEST_WAVER * variety * (1.0 - most));
}

// Ink of one line: x from its middle, in a strip of its own as wide as `strip`, in units of line_ink.
fn stroke_ink(stroke: Stroke, x: f32, strip: f32, k: f32, d: f32, variety: f32) -> f32 {
    let own = stroke_darkness(d, stroke.swell, variety);
    // It never leaves its strip, so that lines do not meet.
    let shift = 0.5 * GREATEST_WAVER * variety * stroke.waver * (1.0 - own) * strip;
    return line_coverage(abs(x - shift), own * strip, k);
}

// Sign and number that make a row of a patch out of a phase, from what a corner carries of it; field 0 along, 1 across.
fn patch_row(code: u32, field: u32) -> vec2i {
    let half = i32(code << (16u - 16u * field)) >> 16u;
    return vec2i(1 - 2 * (half & 1), half >> 1u);
}

// What one patch gives to the stroke of a line: swell and waver by its weight, and the weight of the swell. `along` is its
// place, in tiles; `row` counts from the triangle's own phase 0, after `octave` doublings.
fn patch_stroke(
    weight: f32,
    seed: u32,
    code: u32,
    along: f32,
    field: u32,
    row: i32,
    octave: u32,
    variety: f32,
) -> vec3f {
    if weight == 0.0 {
        return vec3f(0.0);
    }
    if seed == NO_SEED {
        // A face alone has no rows.
        return vec3f(0.0, 0.0, 0.25 * weight * weight);
    }
    let own = patch_row(code, field);
    let own_row = own.x * row + (own.y << octave);
    let born = row_octave(own_row, octave);
    let line = own_row >> (octave - born);
    let key = row_key(2u * seed + field, line, born);
    // Patches pass into each other line by line, each at another place.
    let pull = weight * (0.1 + 0.9 * lot(key, 2u));
    let share = pull * pull;
    let stroke = stroke_at(key, line, born, along, variety);
    return vec3f(share * stroke.swell, weight * f32(own.x) * stroke.waver, share);
}

// The stroke of a line at a fragment, patch by patch as in patches_ink.
fn patched_stroke(overlap: Overlap, rows: vec4u, field: u32, row: i32, octave: u32, variety: f32) -> Stroke {
    let tiles = length(material.tile_from_surface.xy);
    var left = overlap_weights(overlap.behind);
    var sum = vec3f(0.0);
    loop {
        let i = heaviest(left);
        let place = place_of(overlap, i);
        let along = tiles * select(place.x, place.y, field == 1u);
        sum += patch_stroke(left[i], overlap.seeds[i], rows[i], along, field, row, octave, variety);
        left = without(left, i);
        if all(left <= vec4f(0.0)) {
            break;
        }
    }
    return Stroke(sum.x / max(sum.z, 1e-12), sum.y);
}
