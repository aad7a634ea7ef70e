// What a method works with, in its ink's place: tone, level of detail, columns, direction, adjacency, triangles. Each is a
// constant of the pipeline and binds no more than the methods do.
//!include lib/surface.wgsl
//!include lib/stages.wgsl
//!include lib/striped.wgsl
//!include lib/barycentric.wgsl
//!include lib/adjacency.wgsl
//!include lib/colour.wgsl
//!include lib/strokes.wgsl
//!include lib/directions.wgsl

// The method has nothing of what is asked for.
const DEBUG_NONE: u32 = 0u;
const DEBUG_TONE: u32 = 1u;
const DEBUG_LEVEL: u32 = 2u;
const DEBUG_COLUMNS: u32 = 3u;
// Directions of the mapping's strokes, and of stripes.
const DEBUG_FRAMES: u32 = 4u;
const DEBUG_STRIPES: u32 = 5u;
const DEBUG_ADJACENCY: u32 = 6u;
const DEBUG_TRIANGLES: u32 = 7u;
override DEBUG: u32 = 0u;

const ISOLINE_PX: f32 = 1.2;
// Tones that change less from pixel to pixel have no isolines: rounding would draw them.
const LEAST_SLOPE: f32 = 1e-4;
const HATCH_PX: f32 = 7.0;
// Cells of the ticks that show directions, and half a tick.
const TICK_PX: f32 = 16.0;
const TICK_REACH_PX: f32 = 5.0;
const NONE_GREY: f32 = 0.42;

// Coverage of the isolines at the columns' tones; `slope` is the change of the darkness across a pixel. Where columns
// are so many that their isolines would fill the surface, they fade.
fn isolines(d: f32, slope: f32) -> f32 {
    var coverage = 0.0;
    for (var k = 1u; k <= material.column_count; k++) {
        let gap_px = (column_tone(k) - column_tone(k - 1u)) / max(slope, LEAST_SLOPE);
        let distance_px = abs(d - column_tone(k)) / max(slope, LEAST_SLOPE);
        let line = clamp(0.5 * ISOLINE_PX + 0.5 - distance_px, 0.0, 1.0);
        coverage = max(coverage, line * smoothstep(2.0, 6.0, gap_px));
    }
    return select(0.0, coverage, slope > LEAST_SLOPE);
}

fn tone_colour(d: f32, slope: f32) -> vec3f {
    return mix(vec3f(1.0 - d), oklch(0.65, 0.2, 0.11), isolines(d, slope));
}

// From green over yellow, red and violet to blue; level 8 is green again.
fn level_hue(level: f32) -> vec3f {
    return oklch(0.76, 0.15, 0.4 - 0.125 * level);
}

// Coverage of white lines across the screen, which take up this share of it.
fn hatching(place_px: vec2f, share: f32) -> f32 {
    let x = dot(place_px, vec2f(0.70710678)) / HATCH_PX;
    let distance_px = abs(x - round(x)) * HATCH_PX;
    return clamp(0.5 * share * HATCH_PX + 0.5 - distance_px, 0.0, 1.0);
}

// The levels that are mixed, by their shares. Magnified, that is below 0, hatched in white, the more the further; beyond
// the coarsest level, where strokes close up, dark, the more the further.
fn level_colour(level: f32, place_px: vec2f) -> vec3f {
    let last = material.level_count - 1.0;
    let within = clamp(level, 0.0, last);
    let low = floor(within);
    let colour = mix(level_hue(low), level_hue(low + 1.0), within - low);
    if level < 0.0 {
        return mix(colour, vec3f(1.0), hatching(place_px, 0.85 - 0.65 * exp2(level)));
    }
    return colour * select(1.0, 0.3 * exp2(last - level), level > last);
}

// White is light grey; the darker the column, the darker its colour. A few columns have hues far apart; many, which would
// mingle to grey, go a few times round.
fn column_colour(column: f32) -> vec3f {
    let n = f32(material.column_count);
    let hue = 0.75 - min(0.38, 4.5 / n) * (n - column);
    return oklch(mix(0.93, 0.45, column / n), select(0.14, 0.0, column < 0.5), hue);
}

// The two columns that bracket a tone, by their shares; `x` is its place among them.
fn columns_colour(x: f32) -> vec3f {
    let low = min(floor(x), f32(material.column_count) - 1.0);
    return mix(column_colour(low), column_colour(low + 1.0), x - low);
}

// Coverage of a short line through the middle of the fragment's cell of the screen.
fn tick(direction: vec2f, place_px: vec2f) -> f32 {
    let along = half_angle(direction) * vec2f(1.0, -1.0);
    let offset = place_px - (floor(place_px / TICK_PX) + 0.5) * TICK_PX;
    let t = clamp(dot(offset, along), -TICK_REACH_PX, TICK_REACH_PX);
    return clamp(1.3 - length(offset - t * along), 0.0, 1.0);
}

fn none_colour() -> vec3f {
    return vec3f(NONE_GREY);
}

// Hue by direction, paler where patterns disagree; a tick runs along it.
fn direction_colour(direction: vec2f, place_px: vec2f) -> vec3f {
    let agreement = min(length(direction), 1.0);
    if !(agreement > 1e-3) {
        return none_colour();
    }
    let colour = oklch(0.8, 0.15 * agreement, atan2(direction.y, direction.x) / TAU + 0.08);
    return colour * (1.0 - 0.85 * tick(direction, place_px));
}

// Share of the neighbours' patterns at a place of a face: 0 where it is alone, half inside a flat surface, two thirds at
// its corners.
fn neighbour_share(face: u32, p: vec3f) -> f32 {
    let opposite = corner_weights(face, p).zxy;
    let own = face_normals[face];
    var sum = 0.0;
    for (var k = 0u; k < 3u; k++) {
        let other = neighbours[3u * face + k];
        if other == NO_FACE {
            continue;
        }
        let theirs = face_normals[other];
        let f = contribution(dot(own.xyz, theirs.xyz), opposite[k]);
        if f > 0.0 && own.w * theirs.w > 0.0 {
            sum += f;
        }
    }
    return sum / (1.0 + sum);
}

fn adjacency_colour(share: f32) -> vec3f {
    return mix(vec3f(1.0), oklch(0.55, 0.22, 0.02), clamp(1.5 * share, 0.0, 1.0));
}

fn triangle_colour(face: u32) -> vec3f {
    return oklch(mix(0.78, 0.92, lot(face, 0u)), 0.11, lot(face, 1u));
}

// Darker where the surface turns away from the camera, so that the form is read under any light.
fn form_shade(point: Point) -> f32 {
    return mix(0.55, 1.0, abs(dot(point.normal, point.view)));
}

// Directions of the lines along the field.
fn stripes_direction(along: Phase) -> vec2f {
    return direction_across(along.slope);
}

@vertex
fn vertex_lines(in: LineIn) -> LineOut {
    return line_vertex(in);
}

@vertex
fn vertex_faced(@builtin(vertex_index) index: u32) -> FacedOut {
    return faced_vertex(index);
}

@fragment
fn fragment(
    in: FragmentIn,
    patched: PatchedIn,
    @builtin(position) place_px: vec4f,
    @builtin(front_facing) front: bool,
) -> @location(0) vec4f {
    let point = patched_point(in, patched, front);
    let p = frame_place(point.p_world);
    let dx = dpdx(p);
    let dy = dpdy(p);
    let d = darkness(reflectance(), point.p_world, point.normal, point.view);
    let slope = length(vec2f(dpdx(d), dpdy(d)));
    var colour = none_colour();
    if DEBUG == DEBUG_TONE {
        return vec4f(tone_colour(d, slope), 1.0);
    }
    if DEBUG == DEBUG_LEVEL {
        let tiles_per_px = select(footprint(point), map_uv(point).tiles_per_px, MAPPING == MAPPING_UV);
        colour = level_colour(wanted_level(tiles_per_px), place_px.xy);
    }
    if DEBUG == DEBUG_COLUMNS {
        return vec4f(columns_colour(column_coordinate(d)), 1.0);
    }
    if DEBUG == DEBUG_FRAMES {
        let overlap = overlap_of(patched);
        let slopes = OverlapSlopes(
            dpdx(patched.places_ab), dpdx(patched.places_cd), dpdy(patched.places_ab), dpdy(patched.places_cd));
        let uv_dx = dpdx(in.uv);
        let uv_dy = dpdy(in.uv);
        colour = direction_colour(mapped_direction(point, overlap, slopes, dx, dy, uv_dx, uv_dy), place_px.xy);
    }
    return vec4f(colour * form_shade(point), 1.0);
}

@fragment
fn fragment_lines(
    in: FragmentIn,
    lines: LineFragment,
    @builtin(position) place_px: vec4f,
    @builtin(front_facing) front: bool,
) -> @location(0) vec4f {
    let point = surface_point(in, front);
    let along = phase_of(in.uv.x, lines.ring, lines.ring.z);
    return vec4f(direction_colour(stripes_direction(along), place_px.xy) * form_shade(point), 1.0);
}

@fragment
fn fragment_lapped(
    in: FragmentIn,
    lapped: LappedFragment,
    @builtin(position) place_px: vec4f,
    @builtin(front_facing) front: bool,
) -> @location(0) vec4f {
    let point = surface_point(in, front);
    let first =
        OverlapSlopes(dpdx(lapped.places_ab), dpdx(lapped.places_cd), dpdy(lapped.places_ab), dpdy(lapped.places_cd));
    let then =
        OverlapSlopes(dpdx(lapped.places_ef), dpdx(lapped.places_gh), dpdy(lapped.places_ef), dpdy(lapped.places_gh));
    let direction = lapped_direction(lapped_of(lapped), first, then);
    return vec4f(direction_colour(direction, place_px.xy) * form_shade(point), 1.0);
}

@fragment
fn fragment_faces(in: FragmentIn, faced: FacedIn, @builtin(front_facing) front: bool) -> @location(0) vec4f {
    let point = surface_point(in, front);
    var colour = adjacency_colour(neighbour_share(faced.face, frame_place(point.p_world)));
    if DEBUG == DEBUG_TRIANGLES {
        let d = darkness(reflectance(), point.p_world, point.normal, point.view);
        colour = triangle_colour(faced.face) * (1.0 - 0.35 * d);
    }
    return vec4f(colour * form_shade(point), 1.0);
}
