//! Rows of `debug.wgsl` and `lib/colour.wgsl`.

use glam::DVec4;
use tam_shaders::Pass;
use tam_shaders::cpu::debug::{
    LEAST_SLOPE, adjacency_colour, column_colour, columns_colour, direction_colour, form_shade, hatching, isolines,
    level_colour, level_hue, neighbour_share, none_colour, tick, tone_colour, triangle_colour,
};
use tam_shaders::cpu::lib::colour::oklch;
use tam_shaders::cpu::lib::columns::wanted_level;

use super::{any_point, one, point, three, xy};
use crate::draw::{Case, Draw, OWN};
use crate::row::{Row, U, row};

/// Sine and cosine of drivers are off by 1e-6 (2^-11 at most, says WGSL); the cube of their cones, times 4, by 12 times
/// that, and hues of 24 turns by 150 round-offs before.
const COLOUR: f64 = 1e-4;

pub(crate) fn rows() -> Vec<Row> {
    let mut rows = colours();
    rows.extend(tones());
    rows.extend(fragments());
    rows
}

fn colours() -> Vec<Row> {
    vec![
        row("oklch", Pass::Debug, "vec4f(oklch(a.x, 0.3 * a.y, b.x), 0.0)", numbers)
            .twin(|_, case| three(oklch(case[0].x, f64::from(0.3_f32) * case[0].y, case[1].x)))
            .within(COLOUR, 0.0),
        row("level_hue", Pass::Debug, "vec4f(level_hue(floor(b.y)), 0.0)", numbers)
            .twin(|_, case| three(level_hue(case[1].y.floor())))
            .within(COLOUR, 0.0),
        row("column_colour", Pass::Debug, "vec4f(column_colour(b.z), 0.0)", numbers)
            .twin(|b, case| three(column_colour(b.material, case[1].z)))
            .within(COLOUR, 0.0),
        // The place among columns is mixed.
        row("columns_colour", Pass::Debug, "vec4f(columns_colour(a.x * f32(material.column_count)), 0.0)", numbers)
            .twin(|b, case| three(columns_colour(b.material, case[0].x * f64::from(b.material.column_count))))
            .within(COLOUR, 0.0),
        row("adjacency_colour", Pass::Debug, "vec4f(adjacency_colour(a.x), 0.0)", numbers)
            .twin(|_, case| three(adjacency_colour(case[0].x)))
            .within(COLOUR, 0.0),
        row("triangle_colour", Pass::Debug, "vec4f(triangle_colour(u32(b.w)), 0.0)", numbers)
            .twin(|_, case| three(triangle_colour(case[1].w as u32)))
            .within(COLOUR, 0.0),
        row("none_colour", Pass::Debug, "vec4f(none_colour(), a.x)", numbers)
            .twin(|_, case| none_colour().extend(case[0].x))
            .within(1e-30, 0.0),
    ]
}

fn tones() -> Vec<Row> {
    vec![
        // Drivers' logarithms are good to 1e-5.
        row("wanted_level", Pass::Debug, "vec4f(wanted_level(c.z), 0.0, 0.0, 0.0)", numbers)
            .twin(|b, case| one(wanted_level(b.material, case[2].z)))
            .within(2e-5, 0.0),
        // A round-off of a tone is divided by the least slope, 1e-4.
        row("isolines", Pass::Debug, "vec4f(isolines(a.x, c.w), 0.0, 0.0, 0.0)", numbers)
            .twin(|b, case| one(isolines(b.material, case[0].x, case[2].w)))
            .except_where(|_, case| (case[2].w / LEAST_SLOPE - 1.0).abs() < 1e-4)
            .within(4.0 * U / LEAST_SLOPE, 0.0),
        row("tone_colour", Pass::Debug, "vec4f(tone_colour(a.x, c.w), 0.0)", numbers)
            .twin(|b, case| three(tone_colour(b.material, case[0].x, case[2].w)))
            .except_where(|_, case| (case[2].w / LEAST_SLOPE - 1.0).abs() < 1e-4)
            .within(COLOUR + 4.0 * U / LEAST_SLOPE, 0.0),
        // Places of a thousand pixels.
        row("hatching", Pass::Debug, "vec4f(hatching(c.xy, a.x), 0.0, 0.0, 0.0)", numbers)
            .twin(|_, case| one(hatching(xy(case[2]), case[0].x)))
            .within(4e3 * U, 0.0),
        row("level_colour", Pass::Debug, "vec4f(level_colour(b.y, c.xy), 0.0)", numbers)
            .twin(|b, case| three(level_colour(b.material, case[1].y, xy(case[2]))))
            .within(COLOUR + 4e3 * U, 0.0),
        // Half an angle is off by the root of a round-off where it vanishes, at five pixels from the middle.
        row("tick", Pass::Debug, "vec4f(tick(d.xy, c.xy), 0.0, 0.0, 0.0)", numbers)
            .twin(|_, case| one(tick(xy(case[3]), xy(case[2]))))
            .within(20.0 * U.sqrt(), 0.0),
        // The same, and an angle that drivers have to 1e-4.
        row("direction_colour", Pass::Debug, "vec4f(direction_colour(d.xy, c.xy), 0.0)", numbers)
            .twin(|_, case| three(direction_colour(xy(case[3]), xy(case[2]))))
            .except_where(|_, case| (xy(case[3]).length() - 1e-3).abs() < 1e-6)
            .within(20.0 * U.sqrt() + 10.0 * COLOUR, 0.0),
    ]
}

fn fragments() -> Vec<Row> {
    vec![
        // Weights of planes that are anything, each a few round-offs; the share of their sum is no steeper.
        row("neighbour_share", Pass::Debug, "vec4f(neighbour_share(u32(d.z), a.xyz), 0.0, 0.0, 0.0)", any_point)
            .twin(|b, case| one(neighbour_share(b, case[3].z as usize, case[0].truncate())))
            .in_both_forms()
            .within(400.0 * U, 0.0),
        row("form_shade", Pass::Debug, "vec4f(form_shade(case_point(a, b, c, d)), 0.0, 0.0, 0.0)", any_point)
            .twin(|_, case| one(form_shade(&point(case))))
            .within(16.0 * U, 0.0),
    ]
}

/// Two shares, 0..=1; a hue, a level, a column, a face; a place on the screen, a footprint, a slope of the tone; and a
/// direction, a fourth of them unit, some 0.
fn numbers(draw: &Draw) -> Case {
    let level =
        if draw.pick(OWN + 9, 4) == 0 { draw.pick(OWN + 10, 5) as f64 } else { draw.between(OWN + 11, -4.0, 6.0) };
    let slope = if draw.pick(OWN + 12, 8) == 0 { 0.0 } else { draw.scale(OWN + 13, 1e-5, 1.0) };
    let direction = draw.tile(OWN + 14, 0.7);
    let direction = match draw.pick(OWN + 16, 8) {
        0 => glam::DVec2::ZERO,
        1 => [glam::DVec2::X, glam::DVec2::NEG_X, glam::DVec2::Y, glam::DVec2::NEG_Y][draw.pick(OWN + 17, 4)],
        _ => direction,
    };
    [
        DVec4::new(draw.tone(OWN), draw.tone(OWN + 3), 0.0, 0.0),
        DVec4::new(
            draw.between(OWN + 6, -2.0, 2.0),
            level,
            draw.pick(OWN + 7, 65) as f64,
            draw.pick(OWN + 8, 1 << 20) as f64,
        ),
        DVec4::new(
            draw.between(OWN + 20, 0.0, 1000.0),
            draw.between(OWN + 21, 0.0, 1000.0),
            draw.scale(OWN + 22, 1e-4, 10.0),
            slope,
        ),
        DVec4::new(direction.x, direction.y, 0.0, 0.0),
    ]
}
