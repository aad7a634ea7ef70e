// From a wanted darkness to the two columns that bracket it. Praun and others, "Real-Time Hatching", 2001, section 5;
// Webb and others, "Fine tone control in hardware hatching", 2002, for many columns.
//!include lib/form.wgsl
//!include lib/material.wgsl

// Place of a darkness among the columns: 0 is white, column_count the darkest column, piecewise linear in the columns'
// own tones. The literal form takes the columns to be evenly spaced up to black, as the student implementation does.
fn column_coordinate(d: f32) -> f32 {
    let n = material.column_count;
    if FORM == FORM_LITERAL {
        return clamp(d, 0.0, 1.0) * f32(n);
    }
    if material.columns_per_tone > 0.0 {
        return clamp(d * material.columns_per_tone, 0.0, f32(n));
    }
    // The first guess is mostly right; else they are searched.
    let guess = min(u32(max(d, 0.0) / max(column_tone(n), 1e-6) * f32(n)), n - 1u);
    let above = column_tone(guess) > d;
    let below = column_tone(guess + 1u) <= d;
    var low = select(min(guess + u32(below), n - 1u), 0u, above);
    var high = select(select(guess + 1u, n, below), guess, above);
    while high - low > 1u {
        let middle = (low + high) / 2u;
        if column_tone(middle) <= d {
            low = middle;
        } else {
            high = middle;
        }
    }
    let a = column_tone(low);
    let b = column_tone(high);
    return f32(low) + clamp((d - a) / max(b - a, 1e-6), 0.0, 1.0);
}

// Level of detail for a footprint in tiles per pixel, as if there were levels without end.
fn wanted_level(tiles_per_px: f32) -> f32 {
    return log2(max(tiles_per_px * material.size_px, 1e-6)) + material.level_bias;
}

// The same among those there are. Below the finest level strokes grow, as in any texture.
fn map_level(tiles_per_px: f32) -> f32 {
    return clamp(wanted_level(tiles_per_px), 0.0, material.level_count - 1.0);
}

// The scale at which a map is sampled: the footprint of a pixel, and the level that fits it.
struct Scale {
    tiles_per_px: f32,
    level: f32,
}

fn map_scale(tiles_per_px: f32) -> Scale {
    return Scale(tiles_per_px, map_level(tiles_per_px));
}

// Ink of an array whose layer k holds column k and column k + 1 in its two channels (column 0 is white): one sample
// gives both columns.
fn column_ink(uv: vec2f, level: f32, x: f32) -> f32 {
    let layer = min(floor(x), f32(material.column_count) - 1.0);
    let pair = textureSampleLevel(map, map_sampler, uv, i32(layer), level).rg;
    return mix(pair.x, pair.y, x - layer);
}
