//! Rows of what reads maps and thresholds: `lib/threshold.wgsl`, `lib/halftone.wgsl`, `lib/blend.wgsl` and the passes.

use glam::{DVec3, DVec4};
use tam_shaders::Pass;
use tam_shaders::cpu::lib::blend::{blended_ink, log2_light, union_darkness};
use tam_shaders::cpu::lib::columns::{column_ink, map_level};
use tam_shaders::cpu::lib::halftone::{halftone_ink, halftone_threshold, line_coverage, line_ink, line_widths};
use tam_shaders::cpu::lib::mapping::{Mapped, Pattern};
use tam_shaders::cpu::lib::threshold::{
    ROWS_PER_LEVEL, distribution_entry, equalised, fract_of, share_above, threshold_centred, threshold_one_sided,
};
use tam_shaders::cpu::stroke_map::Sampled;
use tam_shaders::cpu::{Bindings, Blend, Form, Mapping, Options, PatternKind, fine_tone, six_way, stroke_map};

use super::{one, two, xy};
use crate::draw::{Case, Draw, OWN};
use crate::row::{Row, U, row};

/// Samplers weigh texels, and levels, in steps of 1/256: three weights of a map that runs from 0 to 1 between texels;
/// and each of the three mixes may round to 8 bits.
pub(crate) const SAMPLED: f64 = 3.0 / 256.0 + 3.0 / 510.0;

pub(crate) fn rows() -> Vec<Row> {
    let with = |form, blend, pattern| Options { form, blend, pattern, ..Options::default() };
    vec![
        row("distribution_entry", Pass::StrokeMap, "vec4f(distribution_entry(i32(a.x), i32(a.y)), 0.0, 0.0)", |draw| {
            let entry =
                DVec4::new(draw.pick(OWN, 2 * ROWS_PER_LEVEL + 1) as f64, draw.pick(OWN + 1, 9) as f64, 0.0, 0.0);
            [entry, DVec4::ZERO, DVec4::ZERO, DVec4::ZERO]
        })
        .twin(|b, case| two(distribution_entry(b.distribution, case[0].x as usize, case[0].y as usize)))
        .within(1e-30, 0.0),
        // A place among eight intervals is off by 8 round-offs, and rows rise by less than 8 per unit.
        row("equalised", Pass::StrokeMap, "vec4f(equalised(a.x, a.y).share, 0.0, 0.0, 0.0)", tone_and_level)
            .twin(|b, case| one(equalised(b.material, b.distribution, case[0].x, case[0].y).share))
            .within(16.0 * U, 0.0),
        // Rates change by up to 8 from entry to entry.
        row("equalised", Pass::StrokeMap, "vec4f(equalised(a.x, a.y).rate, 0.0, 0.0, 0.0)", tone_and_level)
            .twin(|b, case| one(equalised(b.material, b.distribution, case[0].x, case[0].y).rate))
            .within(128.0 * U, 0.0),
        row("fract_of", Pass::StrokeMap, "vec4f(fract_of(a.x, i32(a.y)), 0.0, 0.0, 0.0)", tone_and_level)
            .twin(|_, case| one(fract_of(case[0].x, case[0].y as usize)))
            .within(2.0 * U, 0.0),
        row(
            "share_above",
            Pass::StrokeMap,
            "vec4f(share_above(a.x - a.z, 0.5 * max(a.w, 0.01)), 0.0, 0.0, 0.0)",
            tone_and_level,
        )
        .twin(|_, case| one(share_above(case[0].x - case[0].z, 0.5 * case[0].w.max(0.01))))
        .within(200.0 * U, 0.0),
        // At the steepest slope a round-off of the difference counts 24 times, in each of three terms.
        row(
            "threshold_centred",
            Pass::StrokeMap,
            "vec4f(threshold_centred(a.x, a.z, a.w), 0.0, 0.0, 0.0)",
            tone_and_level,
        )
        .twin(|_, case| one(threshold_centred(case[0].x, case[0].z, case[0].w)))
        .within(100.0 * U, 0.0),
        row(
            "threshold_one_sided",
            Pass::StrokeMap,
            "vec4f(threshold_one_sided(a.x, a.z, b.x), 0.0, 0.0, 0.0)",
            tone_and_level,
        )
        .twin(|_, case| one(threshold_one_sided(case[0].x, case[0].z, case[1].x)))
        .within(16.0 * U, 2.0 * U),
        row("line_widths", Pass::StrokeMap, "vec4f(line_widths(a.x, a.z), 0.0, 0.0)", tone_and_level)
            .twin(|_, case| two(line_widths(case[0].x, case[0].z)))
            .within(4.0 * U, 0.0),
        // Up to 20 pixels between lines, a few round-offs each.
        row("line_coverage", Pass::StrokeMap, "vec4f(line_coverage(a.x, a.z, b.x), 0.0, 0.0, 0.0)", tone_and_level)
            .twin(|_, case| one(line_coverage(case[0].x, case[0].z, case[1].x)))
            .within(100.0 * U, 0.0),
        // Phases below 4, sharpened by 500 at most.
        row("line_ink", Pass::StrokeMap, "vec4f(line_ink(b.y, b.z, a.x, a.z), 0.0, 0.0, 0.0)", tone_and_level)
            .twin(|_, case| one(line_ink(case[1].y, case[1].z, case[0].x, case[0].z)))
            .within(4e3 * U, 0.0),
        // A hundred lines in four tiles: phases below 400; ten pixels from line to line sharpen them by 10.
        row("halftone_ink", Pass::StrokeMap, "vec4f(halftone_ink(b.y, b.w, 5.0, a.x), 0.0, 0.0, 0.0)", tone_and_level)
            .twin(|_, case| one(halftone_ink(case[1].y, case[1].w, 5.0, case[0].x)))
            .within(6e3 * U, 0.0),
        row(
            "halftone_threshold",
            Pass::StrokeMap,
            "vec4f(halftone_threshold(b.y, 100.0), 0.0, 0.0, 0.0)",
            tone_and_level,
        )
        .twin(|_, case| one(halftone_threshold(case[1].y, 100.0)))
        // Twice the round-off of a phase of 400.
        .within(800.0 * U, 0.0),
        // The darker of the two columns weighs x: the sampler's error and two round-offs.
        row(
            "column_ink",
            Pass::FineTone,
            "vec4f(column_ink(c.xy, a.y, min(c.z, f32(material.column_count))), 0.0, 0.0, 0.0)",
            tone_and_level,
        )
        .twin(|b, case| {
            one(column_ink(b.material, b.map, xy(case[2]), case[0].y, case[2].z.min(b.material.column_count.into())))
        })
        .within(SAMPLED, 0.0),
        row(
            "column_weights",
            Pass::SixWay,
            "vec4f(column_weights(c.z).light, column_weights(c.z).dark.x)",
            tone_and_level,
        )
        .twin(|_, case| {
            let weights = six_way::column_weights(case[2].z);
            weights.light.extend(weights.dark.x)
        })
        .within(8.0 * U, 0.0),
        row("column_weights", Pass::SixWay, "vec4f(column_weights(c.z).dark, 0.0)", tone_and_level)
            .twin(|_, case| six_way::column_weights(case[2].z).dark.extend(0.0))
            .within(8.0 * U, 0.0),
        // The weights sum to 1 at most.
        row("six_ink", Pass::SixWay, "vec4f(six_ink(c.xy, a.y, column_weights(c.z)), 0.0, 0.0, 0.0)", tone_and_level)
            .twin(|b, case| one(six_way::six_ink(b.map, xy(case[2]), case[0].y, &six_way::column_weights(case[2].z))))
            .within(SAMPLED, 0.0),
        // Drivers' logarithms are good to 1e-5.
        row("log2_light", Pass::FineTone, "vec4f(log2_light(a.x), 0.0, 0.0, 0.0)", tone_and_level)
            .twin(|_, case| one(log2_light(case[0].x)))
            .within(2e-5, 4.0 * U),
        // A power of 1e-6 at least.
        row(
            "union_darkness",
            Pass::FineTone,
            "vec4f(union_darkness(log2_light(a.x), a.z), 0.0, 0.0, 0.0)",
            tone_and_level,
        )
        .twin(|_, case| one(union_darkness(log2_light(case[0].x), case[0].z)))
        .within(2e-5, 0.0),
        // One sample, at a level and a place among columns that are off by little.
        row(
            "pattern_ink",
            Pass::FineTone,
            "vec4f(pattern_ink(c.xy, map_scale(b.w), a.z), 0.0, 0.0, 0.0)",
            tone_and_level,
        )
        .twin(|b, case| one(fine_tone::pattern_ink(b, xy(case[2]), case[1].w, case[0].z)))
        .in_both_forms()
        .within(SAMPLED + 1e-4, 0.0),
        // As the sketch prints it, a slope of 4 stretches the sampler's error.
        stroke_map_row()
            .in_options([with(Form::Literal, Blend::Union, PatternKind::Strokes)])
            .within(4.0 * SAMPLED, 0.0),
        // No sampler: phases below 10, sharpened by the change from pixel to pixel, of which the round-off of places
        // leaves four digits at the smallest steps.
        stroke_map_row().in_options([with(Form::Hardened, Blend::Union, PatternKind::Lines)]).within(5e-3, 0.0),
        // The sampler's error, stretched as the table and the slope do it at this very threshold.
        stroke_map_row().within(1e-3, 0.0).stretched(stretched_threshold),
        // Three samples, one inside the other's rest: their errors add up; the sum of weights is 1.
        row(
            "blended_ink",
            Pass::FineTone,
            "vec4f(blended_ink(Mapped(Pattern(a.xy, d.x), Pattern(b.xy, d.y), Pattern(c.xy, d.z), \
             a.z), a.w), 0.0, 0.0, 0.0)",
            patterns,
        )
        .twin(|b, case| {
            let pattern = |k: usize| Pattern { uv: xy(case[k]), weight: case[3][k] };
            let mapped = Mapped { patterns: [pattern(0), pattern(1), pattern(2)], tiles_per_px: case[0].z };
            one(blended_ink(b.options, &mapped, case[0].w, |i, d| {
                fine_tone::pattern_ink(b, mapped.patterns[i].uv, mapped.tiles_per_px, d)
            }))
        })
        .in_options([
            Options::default(),
            Options { mapping: Mapping::Triplanar, ..Options::default() },
            Options { mapping: Mapping::Triplanar, blend: Blend::Linear, ..Options::default() },
            Options { mapping: Mapping::Frames, ..Options::default() },
        ])
        .within(3.0 * SAMPLED + 1e-4, 0.0),
    ]
}

fn stroke_map_row() -> Row {
    row(
        "pattern_ink",
        Pass::StrokeMap,
        "vec4f(pattern_ink(c.xy, map_scale(b.w), a.x), 0.0, 0.0, 0.0)",
        smooth_thresholds,
    )
    .quad_twin(|b, quad, lane| {
        let at = quad.map(|case| Sampled { uv: xy(case[2]), tiles_per_px: case[1].w });
        one(stroke_map::pattern_ink(b, &at, lane, quad[lane][0].x))
    })
}

/// How much the ink of a stroke map changes where threshold and change per texel are off by the sampler's error.
fn stretched_threshold(b: &Bindings<'_>, case: &Case) -> f64 {
    let (uv, tiles_per_px, d) = (xy(case[2]), case[1].w, case[0].x);
    let level = map_level(b.material, tiles_per_px);
    let sampled = b.map.sample_level(uv, 0, level);
    let texels_per_px = tiles_per_px * b.material.size_px * (-level).exp2();
    let ink = |off: f64, off_slope: f64| {
        let theta = equalised(b.material, b.distribution, sampled.x + off, level);
        threshold_centred(d, theta.share, theta.rate * (sampled.y + off_slope).max(0.0) * texels_per_px)
    };
    let exact = ink(0.0, 0.0);
    // Between them lies an entry of the table at most, so the ends and their halves show the greatest change.
    let offs = [-1.0, -0.5, 0.0, 0.5, 1.0].map(|share| share * SAMPLED);
    let inks = offs.into_iter().flat_map(|off| offs.map(|off_slope| ink(off, off_slope)));
    inks.map(|ink| (ink - exact).abs()).fold(0.0, f64::max)
}

/// Tone, level, threshold and its change per pixel; slope, phase and its change; place on the tile and among six
/// columns.
fn tone_and_level(draw: &Draw) -> Case {
    let per_px = if draw.pick(OWN + 9, 8) == 0 { 0.0 } else { draw.scale(OWN + 10, 1e-3, 2.0) };
    let level =
        if draw.pick(OWN + 11, 8) == 0 { draw.pick(OWN + 12, 3) as f64 } else { draw.between(OWN + 13, 0.0, 2.0) };
    let column =
        if draw.pick(OWN + 14, 8) == 0 { draw.pick(OWN + 15, 7) as f64 } else { draw.between(OWN + 16, 0.0, 6.0) };
    let uv = draw.tile(OWN + 40, 3.0);
    [
        DVec4::new(draw.tone(OWN), level, draw.tone(OWN + 20), per_px),
        DVec4::new(
            draw.between(OWN + 30, 0.5, 20.0),
            draw.between(OWN + 31, -4.0, 4.0),
            draw.scale(OWN + 32, 1e-3, 1.0),
            draw.scale(OWN + 33, 2e-3, 0.5),
        ),
        DVec4::new(uv.x, uv.y, column, 0.0),
        DVec4::ZERO,
    ]
}

/// Places a fraction of a texel apart within a quad.
fn smooth_thresholds(draw: &Draw) -> Case {
    let mut case = tone_and_level(draw);
    let step = draw.between(50, 0.001, 0.03);
    let lane = draw.lane() as u32;
    let uv = draw.tile(40, 2.0) + step * glam::DVec2::new(f64::from(lane % 2), f64::from(lane / 2));
    (case[2].x, case[2].y) = (crate::draw::single(uv.x), crate::draw::single(uv.y));
    case[1].w = draw.scale(51, 2e-3, 0.5);
    case
}

/// Three places with weights of the sum 1, a footprint and a tone.
fn patterns(draw: &Draw) -> Case {
    let mut weights = DVec3::from([0, 1, 2].map(|i| draw.unit(OWN + 70 + i)));
    if draw.pick(OWN + 75, 3) == 0 {
        weights.z = 0.0;
    }
    if draw.pick(OWN + 76, 4) == 0 {
        weights.y = 0.0;
    }
    weights /= weights.element_sum().max(1e-3);
    let place = |slot, z, w| {
        let uv = draw.tile(slot, 2.0);
        DVec4::new(uv.x, uv.y, z, w)
    };
    [
        place(OWN, draw.scale(OWN + 81, 2e-3, 1.0), draw.tone(OWN + 80)),
        place(OWN + 10, 0.0, 0.0),
        place(OWN + 20, 0.0, 0.0),
        DVec3::from(weights.to_array().map(crate::draw::single)).extend(0.0),
    ]
}
