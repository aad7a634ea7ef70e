//! Twin of `debug.wgsl`: what a method works with, in its ink's place.

use glam::{DVec2, DVec3, DVec4};

use super::builtin::{mix, smoothstep};
use super::lib::adjacency::contribution;
use super::lib::barycentric::corner_weights;
use super::lib::colour::{TAU, oklch};
use super::lib::columns::{column_coordinate, wanted_level};
use super::lib::directions::{OverlapSlopes, direction_across, lapped_direction, mapped_direction};
use super::lib::face_frame::half_angle;
use super::lib::light::darkness;
use super::lib::mapping::{footprint, frame_place, map_uv};
use super::lib::material::{Material, column_tone, reflectance};
use super::lib::mesh_types::NO_FACE;
use super::lib::patched::{lapped_of, overlap_of, patched_point};
use super::lib::striped::Phase;
use super::lib::strokes::lot;
use super::lib::surface::{FragmentIn, Point, surface_point};
use super::stripes::phases;
use super::{Bindings, DebugView, Mapping, Quad};

/// Width of isolines.
pub const ISOLINE_PX: f64 = 1.2_f32 as f64;
/// Tones that change less from pixel to pixel have no isolines: rounding would draw them.
pub const LEAST_SLOPE: f64 = 1e-4_f32 as f64;
/// Distance of the lines that mark a magnified map.
pub const HATCH_PX: f64 = 7.0;
/// Side of the cells of the ticks that show directions.
pub const TICK_PX: f64 = 16.0;
/// Half the length of a tick.
pub const TICK_REACH_PX: f64 = 5.0;
/// Luminance where there is nothing to show.
pub const NONE_GREY: f64 = 0.42_f32 as f64;

/// Coverage of the isolines at the columns' tones; `slope` is the change of the darkness across a pixel.
pub fn isolines(material: &Material, d: f64, slope: f64) -> f64 {
    if slope <= LEAST_SLOPE {
        return 0.0;
    }
    let line = |k: u32| {
        let gap_px = (column_tone(material, k) - column_tone(material, k - 1)) / slope;
        let distance_px = (d - column_tone(material, k)).abs() / slope;
        (0.5 * ISOLINE_PX + 0.5 - distance_px).clamp(0.0, 1.0) * smoothstep(2.0, 6.0, gap_px)
    };
    (1..=material.column_count).map(line).fold(0.0, f64::max)
}

/// The wanted darkness in grey, with its isolines.
pub fn tone_colour(material: &Material, d: f64, slope: f64) -> DVec3 {
    DVec3::splat(1.0 - d).lerp(oklch(0.65, 0.2, 0.11), isolines(material, d, slope))
}

/// Colour of a whole level: from green over yellow, red and violet to blue; level 8 is green again.
pub fn level_hue(level: f64) -> DVec3 {
    oklch(0.76, 0.15, 0.4 - 0.125 * level)
}

/// Coverage of white lines across the screen, which take up this share of it.
pub fn hatching(place_px: DVec2, share: f64) -> f64 {
    let x = place_px.dot(DVec2::splat(std::f64::consts::FRAC_1_SQRT_2)) / HATCH_PX;
    let distance_px = (x - x.round_ties_even()).abs() * HATCH_PX;
    (0.5 * share * HATCH_PX + 0.5 - distance_px).clamp(0.0, 1.0)
}

/// The levels that are mixed, by their shares; hatched where the map is magnified, dark beyond the coarsest level.
pub fn level_colour(material: &Material, level: f64, place_px: DVec2) -> DVec3 {
    let last = material.level_count - 1.0;
    let within = level.clamp(0.0, last);
    let low = within.floor();
    let colour = level_hue(low).lerp(level_hue(low + 1.0), within - low);
    if level < 0.0 {
        return colour.lerp(DVec3::ONE, hatching(place_px, 0.85 - 0.65 * level.exp2()));
    }
    if level > last { colour * 0.3 * (last - level).exp2() } else { colour }
}

/// Colour of a whole column: white is light grey; the darker the column, the darker its colour.
pub fn column_colour(material: &Material, column: f64) -> DVec3 {
    let n = f64::from(material.column_count);
    let hue = 0.75 - (4.5 / n).min(0.38) * (n - column);
    oklch(mix(0.93, 0.45, column / n), if column < 0.5 { 0.0 } else { 0.14 }, hue)
}

/// The two columns that bracket a tone, by their shares; `x` is its place among them.
pub fn columns_colour(material: &Material, x: f64) -> DVec3 {
    let low = x.floor().min(f64::from(material.column_count) - 1.0);
    column_colour(material, low).lerp(column_colour(material, low + 1.0), x - low)
}

/// Coverage of a short line through the middle of the fragment's cell of the screen.
pub fn tick(direction: DVec2, place_px: DVec2) -> f64 {
    let along = half_angle(direction) * DVec2::new(1.0, -1.0);
    let offset = place_px - ((place_px / TICK_PX).floor() + 0.5) * TICK_PX;
    let t = offset.dot(along).clamp(-TICK_REACH_PX, TICK_REACH_PX);
    (1.3 - (offset - t * along).length()).clamp(0.0, 1.0)
}

/// Where there is nothing to show.
pub fn none_colour() -> DVec3 {
    DVec3::splat(NONE_GREY)
}

/// Hue by direction, paler where patterns disagree; a tick runs along it.
pub fn direction_colour(direction: DVec2, place_px: DVec2) -> DVec3 {
    let agreement = direction.length().min(1.0);
    if agreement.is_nan() || agreement <= 1e-3 {
        return none_colour();
    }
    let colour = oklch(0.8, 0.15 * agreement, direction.y.atan2(direction.x) / TAU + 0.08);
    colour * (1.0 - 0.85 * tick(direction, place_px))
}

/// Share of the neighbours' patterns at a place of a face: 0 where it is alone, half inside a flat surface, two thirds at
/// its corners.
pub fn neighbour_share(b: &Bindings<'_>, face: usize, p: DVec3) -> f64 {
    let weights = corner_weights(&b.mesh, face, p);
    let opposite = [weights.z, weights.x, weights.y];
    let own = b.mesh.face_normals[face];
    let mut sum = 0.0;
    for (k, opposite) in opposite.into_iter().enumerate() {
        let other = b.mesh.neighbours[3 * face + k];
        if other == NO_FACE {
            continue;
        }
        let theirs = b.mesh.face_normals[other as usize];
        let f = contribution(b.options.form, own.truncate().dot(theirs.truncate()), opposite);
        if f > 0.0 && own.w * theirs.w > 0.0 {
            sum += f;
        }
    }
    sum / (1.0 + sum)
}

/// White where a face is alone.
pub fn adjacency_colour(share: f64) -> DVec3 {
    DVec3::ONE.lerp(oklch(0.55, 0.22, 0.02), (1.5 * share).clamp(0.0, 1.0))
}

/// A pastel by lot.
pub fn triangle_colour(face: u32) -> DVec3 {
    oklch(mix(0.78, 0.92, lot(face, 0)), 0.11, lot(face, 1))
}

/// Darker where the surface turns away from the camera, so that the form is read under any light.
pub fn form_shade(point: &Point) -> f64 {
    mix(0.55, 1.0, point.normal.dot(point.view).abs())
}

/// Directions of the lines along the field.
pub fn stripes_direction(along: &Phase) -> DVec2 {
    direction_across(along.slope)
}

/// Colour of one fragment of a quad, linear light; `place_px` is its middle on the screen.
pub fn fragment(b: &Bindings<'_>, quad: &Quad<FragmentIn>, place_px: DVec2, lane: usize, front: bool) -> DVec4 {
    let points = quad.map(|input| patched_point(b.scene, input, front));
    let point = &points[lane];
    let tones = points.map(|point| darkness(b.scene, reflectance(b.material), point.p_world, point.normal, point.view));
    let d = tones[lane];
    let colour = match b.options.debug {
        DebugView::Tone => {
            return tone_colour(b.material, d, tones.dpdx(lane).hypot(tones.dpdy(lane))).extend(1.0);
        }
        DebugView::Level => {
            let tiles_per_px = match b.options.mapping {
                Mapping::Uv => map_uv(b.material, &points, lane).tiles_per_px,
                _ => footprint(b.options.form, b.scene, b.material, point),
            };
            level_colour(b.material, wanted_level(b.material, tiles_per_px), place_px)
        }
        DebugView::Columns => {
            return columns_colour(b.material, column_coordinate(b.options.form, b.material, d)).extend(1.0);
        }
        DebugView::Frames => {
            let p = quad.map(|input| frame_place(b.options.form, b.scene, input.p_world));
            let uvs = quad.map(|input| input.uv);
            let slopes = OverlapSlopes::of(&quad.map(|input| *overlap_of(input)), lane);
            let overlap = (overlap_of(&quad[lane]), &slopes);
            let (steps, uv_steps) = ([p.dpdx(lane), p.dpdy(lane)], [uvs.dpdx(lane), uvs.dpdy(lane)]);
            direction_colour(mapped_direction(b, point, overlap, steps, uv_steps), place_px)
        }
        DebugView::None | DebugView::Stripes | DebugView::Adjacency | DebugView::Triangles => none_colour(),
    };
    (colour * form_shade(point)).extend(1.0)
}

/// The same where directions are those of lines.
pub fn fragment_lines(b: &Bindings<'_>, quad: &Quad<FragmentIn>, place_px: DVec2, lane: usize, front: bool) -> DVec4 {
    let point = surface_point(b.scene, &quad[lane], front);
    let [along, _] = phases(quad, lane);
    (direction_colour(stripes_direction(&along), place_px) * form_shade(&point)).extend(1.0)
}

/// The same where directions are those of lapped textures.
pub fn fragment_lapped(b: &Bindings<'_>, quad: &Quad<FragmentIn>, place_px: DVec2, lane: usize, front: bool) -> DVec4 {
    let point = surface_point(b.scene, &quad[lane], front);
    let [first, then] =
        [quad.map(|input| input.overlap), quad.map(|input| input.over)].map(|quad| OverlapSlopes::of(&quad, lane));
    let direction = lapped_direction(b.material, &lapped_of(&quad[lane]), &first, &then);
    (direction_colour(direction, place_px) * form_shade(&point)).extend(1.0)
}

/// The same where faces are shown.
pub fn fragment_faces(b: &Bindings<'_>, input: &FragmentIn, front: bool) -> DVec4 {
    let point = surface_point(b.scene, input, front);
    let colour = if b.options.debug == DebugView::Triangles {
        let d = darkness(b.scene, reflectance(b.material), point.p_world, point.normal, point.view);
        triangle_colour(input.face) * (1.0 - 0.35 * d)
    } else {
        let p = frame_place(b.options.form, b.scene, point.p_world);
        adjacency_colour(neighbour_share(b, input.face as usize, p))
    };
    (colour * form_shade(&point)).extend(1.0)
}
