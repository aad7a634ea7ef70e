// What differs between the objects of a scene: their colour, their map, and how it lies on them.
// Suarez and others 2013, section 4: rotation, scale and shift of the hatching parameters, per object, on the fly.
//!include lib/light.wgsl

struct Material {
    // Linear light, under the strokes.
    colour: vec4f,
    ambient: f32,
    diffuse: f32,
    specular: f32,
    shininess: f32,
    // Rows of the 2x2 matrix that turns and scales surface coordinates into tiles.
    tile_from_surface: vec4f,
    shift_uv: vec2f,
    // Tiles per unit of the surface coordinates: the scale in tile_from_surface.
    tile_scale: f32,
    // Side of the finest level.
    size_px: f32,
    level_count: f32,
    level_bias: f32,
    column_count: u32,
    // First triangle of the draw: vertices that are pulled are counted from 0 in each draw.
    first_face: u32,
    // Literal slope of the stroke-map threshold.
    slope: f32,
    // Distance of halftone lines on the screen at their finest.
    line_period_px: f32,
    // Entries of a row of the distribution table; 0: there is none.
    distribution_entries: f32,
    // Darkness above which stripes are crossed by others; 1: never.
    cross_from: f32,
    // How much the strokes of stripes differ, 0..=1.
    variety: f32,
    // Columns to a darkness of 1 where they are evenly spaced; 0: they are not.
    columns_per_tone: f32,
    _pad_a: f32,
    _pad_b: f32,
    // Tones of the columns behind the implicit white, four to a vector, increasing.
    tones: array<vec4f, 17>,
}

@group(0) @binding(1) var<uniform> material: Material;
@group(2) @binding(0) var map: texture_2d_array<f32>;
@group(2) @binding(1) var map_sampler: sampler;
@group(2) @binding(2) var distribution: texture_2d<f32>;

// Tone of a column; 0 is the implicit white.
fn column_tone(k: u32) -> f32 {
    return material.tones[k / 4u][k % 4u];
}

fn tile_uv(st: vec2f) -> vec2f {
    let m = material.tile_from_surface;
    return vec2f(dot(m.xy, st), dot(m.zw, st)) + material.shift_uv;
}

fn reflectance() -> Reflectance {
    return Reflectance(material.ambient, material.diffuse, material.specular, material.shininess);
}
