//! Rows of `lib/strokes.wgsl`, and of the pass that draws lines made of strokes.

use glam::DVec4;
use tam_shaders::Pass;
use tam_shaders::cpu::lib::strokes::{
    Line, Stroke, cell_start, greatest_swell, lot, mixed_bits, patch_row, patch_stroke, patched_stroke, row_key,
    row_octave, row_shift, stroke_at, stroke_darkness, stroke_gap, stroke_ink, stroke_profile, stroke_reach,
};
use tam_shaders::cpu::stripes::varied_ink;
use tam_shaders::cpu::{Bindings, Mapping, Options};

use super::{one, three, two};
use crate::draw::{Case, Draw, OWN};
use crate::row::{Row, U, row};
use crate::setting::{Corner, FACES};

/// No strip is so narrow and no swell so great that a number is sharpened by more.
const SHARPENED: f64 = 64.0;

pub(crate) fn rows() -> Vec<Row> {
    let mut rows = lots();
    rows.extend(strokes());
    rows.extend(on_patches());
    rows
}

fn lots() -> Vec<Row> {
    let bits = |word: u32| DVec4::new(f64::from(word >> 16), f64::from(word & 0xffff), 0.0, 0.0);
    vec![
        row(
            "mixed_bits",
            Pass::Stripes,
            "vec4f(vec2f(vec2u(mixed_bits(u32(b.x)) >> 16u, mixed_bits(u32(b.x)) & 0xffffu)), 0.0, 0.0)",
            lines,
        )
        .twin(move |_, case| bits(mixed_bits(case[1].x as u32)))
        .within(1e-30, 0.0),
        row("lot", Pass::Stripes, "vec4f(lot(u32(b.x), u32(i32(b.z))), 0.0, 0.0, 0.0)", lines)
            .twin(|_, case| one(lot(case[1].x as u32, case[1].z as i32 as u32)))
            .within(1e-30, 0.0),
        row("row_octave", Pass::Stripes, "vec4f(f32(row_octave(i32(b.y), u32(b.w))), 0.0, 0.0, 0.0)", lines)
            .twin(|_, case| one(row_octave(case[1].y as i32, case[1].w as u32).into()))
            .within(1e-30, 0.0),
        row("row_key", Pass::Stripes, "vec4f(lot(row_key(u32(b.x), i32(b.y), u32(b.w)), 0u), 0.0, 0.0, 0.0)", lines)
            .twin(|_, case| one(lot(row_key(case[1].x as u32, case[1].y as i32, case[1].w as u32), 0)))
            .within(1e-30, 0.0),
        row("row_shift", Pass::Stripes, "vec4f(row_shift(i32(b.y)), 0.0, 0.0, 0.0)", lines)
            .twin(|_, case| one(row_shift(case[1].y as i32)))
            .within(1e-30, 0.0),
        // A sum of a number up to 40.
        row("cell_start", Pass::Stripes, "vec4f(cell_start(u32(b.x), i32(b.z)), 0.0, 0.0, 0.0)", lines)
            .twin(|_, case| one(cell_start(case[1].x as u32, case[1].z as i32)))
            .within(1e-30, 2.0 * U),
    ]
}

fn strokes() -> Vec<Row> {
    vec![
        row("stroke_gap", Pass::Stripes, "vec4f(stroke_gap(a.x), 0.0, 0.0, 0.0)", lines)
            .twin(|_, case| one(stroke_gap(case[0].x)))
            .within(1e-30, 4.0 * U),
        row("greatest_swell", Pass::Stripes, "vec4f(greatest_swell(a.x), 0.0, 0.0, 0.0)", lines)
            .twin(|_, case| one(greatest_swell(case[0].x)))
            .within(16.0 * U, 0.0),
        // A cube of a quotient of numbers below 1, by 0.3 at least.
        row("stroke_profile", Pass::Stripes, "vec4f(stroke_profile(a.w, 0.3 + 0.4 * a.x), 0.0, 0.0, 0.0)", lines)
            .twin(|_, case| one(stroke_profile(case[0].w, 0.3 + 0.4 * case[0].x)))
            .within(64.0 * U, 0.0),
        // Up to 40 cells, each as long as half and ending with a slope of 3 / 0.3; sines as at `turned_uv`.
        row("stroke_at", Pass::Stripes, "stroked(stroke_at(u32(b.x), i32(b.y), u32(b.w), c.x, a.x))", lines)
            .twin(|_, case| {
                let [_, key, at, _] = *case;
                stroked(stroke_at(key.x as u32, key.y as i32, key.w as u32, at.x, case[0].x))
            })
            .within(2e-5 + 40.0 * 4.0 * 20.0 * 4.0 * U, 0.0),
        row("stroke_darkness", Pass::Stripes, "vec4f(stroke_darkness(a.w, c.z, a.x), 0.0, 0.0, 0.0)", lines)
            .twin(|_, case| one(stroke_darkness(case[0].w, case[2].z, case[0].x)))
            .within(32.0 * U, 0.0),
        row("stroke_reach", Pass::Stripes, "vec4f(stroke_reach(a.z, a.w, a.x), 0.0, 0.0, 0.0)", lines)
            .twin(|_, case| one(stroke_reach(case[0].z, case[0].w, case[0].x)))
            .within(32.0 * U, 0.0),
        row(
            "stroke_ink",
            Pass::Stripes,
            "vec4f(stroke_ink(Stroke(c.z, c.y), c.w, a.z, 8.0, a.w, a.x), 0.0, 0.0, 0.0)",
            lines,
        )
        .twin(|_, case| {
            let stroke = Stroke { swell: case[2].z, waver: case[2].y };
            one(stroke_ink(stroke, case[2].w, case[0].z, 8.0, case[0].w, case[0].x))
        })
        .within(8.0 * SHARPENED * U, 0.0),
    ]
}

fn on_patches() -> Vec<Row> {
    vec![
        row("patch_row", Pass::Stripes, "vec4f(vec2f(patch_row(case_rows(u32(d.z)).x, u32(d.y))), 0.0, 0.0)", lines)
            .twin(|_, case| {
                let [sign, number] = patch_row(corner(case).rows[0], case[3].y as u32);
                DVec4::new(sign.into(), number.into(), 0.0, 0.0)
            })
            .within(1e-30, 0.0),
        // A stroke at a place within 4 tiles, which are cut into up to 40 cells.
        row(
            "patch_stroke",
            Pass::Stripes,
            "vec4f(patch_stroke(a.y, case_overlap(u32(d.z)).seeds.x, case_rows(u32(d.z)).x, c.x, u32(d.y), i32(b.y), \
             u32(b.w), a.x), 0.0)",
            lines,
        )
        .twin(|_, case| {
            let corner = corner(case);
            three(patch_stroke(case[0].y, [corner.seeds[0], corner.rows[0]], case[2].x, line(case), case[0].x))
        })
        .within(2e-4 + 64.0 * 4.0 * 20.0 * U, 0.0),
        // Means of strokes, weighted by fourth powers; places within 4 tiles are cut into up to 40 cells.
        row(
            "patched_stroke",
            Pass::Stripes,
            "stroked(patched_stroke(case_overlap(u32(d.z)), case_rows(u32(d.z)), u32(d.y), i32(b.y), u32(b.w), a.x))",
            lines,
        )
        .twin(|b, case| {
            let corner = corner(case);
            stroked(patched_stroke(b.material, &corner.overlap(b.options), corner.rows, line(case), case[0].x))
        })
        .in_options([Options { mapping: Mapping::Patches, ..Options::default() }])
        .within(2e-4 + 64.0 * 4.0 * 20.0 * 4.0 * U, 0.0),
        // Two strokes at most, sharpened by pixels down to a hundredth of a line.
        row(
            "varied_ink",
            Pass::Stripes,
            "vec4f(varied_ink(case_overlap(u32(d.z)), case_rows(u32(d.z)), u32(d.y), c.x, d.w, 5.0, a.w), 0.0, 0.0, 0.0)",
            lines,
        )
        .twin(|b, case| one(ink(b, case)))
        .in_options([Options { mapping: Mapping::Patches, ..Options::default() }])
        .except_where(|b, case| {
            // Half-way between two lines the nearer one changes.
            let nearby = [-1e-4, 1e-4].map(|step| {
                let mut moved = *case;
                moved[2].x += step * case[3].w;
                ink(b, &moved)
            });
            (nearby[0] - nearby[1]).abs() > 0.02
        })
        .within(0.02, 0.0),
    ]
}

fn ink(b: &Bindings<'_>, case: &Case) -> f64 {
    let corner = corner(case);
    let counted = (&corner.overlap(b.options), corner.rows);
    varied_ink(b.material, counted, case[3].y as u32, case[2].x, case[3].w, case[0].w)
}

fn corner(case: &Case) -> Corner {
    Corner::new(case[3].z as usize)
}

fn line(case: &Case) -> Line {
    Line { field: case[3].y as u32, row: case[1].y as i32, octave: case[1].w as u32 }
}

fn stroked(stroke: Stroke) -> DVec4 {
    two(glam::DVec2::new(stroke.swell, stroke.waver))
}

/// Variety, two weights of corners, a tone; a key, a row, a cell, an octave; a place along or a phase, a waver, a swell,
/// a place across; none, a field, a corner, and a slope of the phase.
fn lines(draw: &Draw) -> Case {
    let row = draw.pick(OWN + 11, 2001) as f64 - 1000.0;
    let weight = |slot| draw.between(OWN + slot, 0.05, 0.45);
    [
        DVec4::new(draw.tone(OWN), weight(3), weight(4), draw.tone(OWN + 5)),
        DVec4::new(
            draw.pick(OWN + 10, 1 << 24) as f64,
            row,
            draw.pick(OWN + 12, 81) as f64 - 40.0,
            draw.pick(OWN + 13, 6) as f64,
        ),
        DVec4::new(
            draw.between(OWN + 20, -4.0, 4.0),
            draw.between(OWN + 21, -1.0, 1.0),
            draw.between(OWN + 22, -1.0, 0.7),
            draw.between(OWN + 23, -1.0, 1.0),
        ),
        DVec4::new(
            draw.pick(OWN + 30, 200) as f64,
            draw.pick(OWN + 31, 2) as f64,
            draw.pick(OWN + 32, FACES) as f64,
            draw.scale(OWN + 33, 1e-3, 1.0),
        ),
    ]
}
