//! Rows of `lib/barycentric.wgsl`, `lib/stripes.wgsl` and the pass that draws stripes.

use glam::{DVec3, DVec4};
use tam_shaders::Pass;
use tam_shaders::cpu::lib::barycentric::{Place, corner_slopes, place_in_face};
use tam_shaders::cpu::lib::stripes::{
    crossed_darkness, doubled_ink, nearest_side, round_share, round_slope, side_weights, stripe_phase, stripe_slope,
    unfolded_corners, windings,
};
use tam_shaders::cpu::stripes::{ALONG, crossed_ink, stripes_ink};
use tam_shaders::cpu::{Bindings, Options};
use tam_shaders::types::StripePhases;

use super::{any_point, one, three, two};
use crate::draw::{Case, Draw, OWN, single};
use crate::row::{Row, U, row};

pub(crate) fn rows() -> Vec<Row> {
    let mut rows = phase_rows();
    rows.extend(ink_rows());
    rows
}

fn phase_rows() -> Vec<Row> {
    vec![
        // Dot products of numbers up to 1.5.
        row("corner_slopes", Pass::Stripes, "vec4f(corner_slopes(u32(d.z), a.xyz), 0.0)", any_point)
            .twin(|b, case| three(corner_slopes(&b.mesh, case[3].z as usize, case[0].truncate())))
            .within(32.0 * U, 0.0),
        row("nearest_side", Pass::Stripes, "vec4f(f32(nearest_side(a.xyz)), 0.0, 0.0, 0.0)", places)
            .twin(|_, case| one(nearest_side(case[0].truncate()).into()))
            .within(1e-30, 0.0),
        // Sums of a few numbers up to 12.
        row("unfolded_corners", Pass::Stripes, "vec4f(unfolded_corners(stripe(d), a.xyz), 0.0)", places)
            .twin(|_, case| three(unfolded_corners(&stripe(case), case[0].truncate())))
            .within(64.0 * U, 0.0),
        row("windings", Pass::Stripes, "vec4f(windings(stripe(d)), 0.0, 0.0, 0.0)", places)
            .twin(|_, case| one(windings(&stripe(case))))
            .within(1e-30, 0.0),
        row("side_weights", Pass::Stripes, "vec4f(side_weights(a.xyz), 0.0, 0.0)", places)
            .twin(|_, case| two(side_weights(case[0].truncate())))
            .within(2.0 * U, 0.0),
        // Divided by 0.02 at least.
        row("round_share", Pass::Stripes, "vec4f(round_share(a.xyz), 0.0, 0.0, 0.0)", places)
            .twin(|_, case| one(round_share(case[0].truncate())))
            .except_where(|_, case| in_the_middle(case))
            .within(200.0 * U, 0.0),
        // And by that squared; changes of the weights are below 0.2.
        row("round_slope", Pass::Stripes, "vec4f(round_slope(a.xyz, b.xyz), 0.0, 0.0, 0.0)", places)
            .twin(|_, case| one(round_slope(case[0].truncate(), case[1].truncate())))
            .except_where(|_, case| in_the_middle(case))
            .within(2e3 * U, 0.0),
        // Two windings at most.
        row("stripe_phase", Pass::Stripes, "vec4f(stripe_phase(stripe(d), a.xyz), 0.0, 0.0, 0.0)", places)
            .twin(|_, case| one(stripe_phase(&stripe(case), case[0].truncate())))
            .except_where(|_, case| in_the_middle(case))
            .within(500.0 * U, 0.0),
        row("stripe_slope", Pass::Stripes, "vec4f(stripe_slope(stripe(d), a.xyz, b.xyz), 0.0, 0.0, 0.0)", places)
            .twin(|_, case| one(stripe_slope(&stripe(case), case[0].truncate(), case[1].truncate())))
            .except_where(|_, case| in_the_middle(case))
            .within(5e3 * U, 0.0),
        row(
            "place_in_face",
            Pass::Stripes,
            "vec4f(place_in_face(u32(d.z), a.xyz, b.xyz, c.xyz).weights, 0.0)",
            any_point,
        )
        .twin(|b, case| three(place(b, case).weights))
        .within(32.0 * U, 0.0),
        row("place_in_face", Pass::Stripes, "vec4f(place_in_face(u32(d.z), a.xyz, b.xyz, c.xyz).dx, 0.0)", any_point)
            .twin(|b, case| three(place(b, case).dx))
            .within(32.0 * U, 0.0),
        row("place_in_face", Pass::Stripes, "vec4f(place_in_face(u32(d.z), a.xyz, b.xyz, c.xyz).dy, 0.0)", any_point)
            .twin(|b, case| three(place(b, case).dy))
            .within(32.0 * U, 0.0),
    ]
}

fn ink_rows() -> Vec<Row> {
    vec![
        // Doubling is exact; ten pixels from line to line sharpen a phase below 4 by 10 at most, doubled up to 128 times.
        row("doubled_ink", Pass::Stripes, "vec4f(doubled_ink(b.w, c.w, 5.0, a.w), 0.0, 0.0, 0.0)", places)
            .twin(|_, case| one(doubled_ink(case[1].w, case[2].w, 5.0, case[0].w)))
            .within(6e3 * U, 0.0),
        // A square root of a quotient.
        row("crossed_darkness", Pass::Stripes, "vec4f(crossed_darkness(a.w, a.x), 0.0, 0.0)", places)
            .twin(|_, case| two(crossed_darkness(case[0].w, case[0].x)))
            .within(16.0 * U, 0.0),
        // A phase off by 500 round-offs, sharpened by ten and doubled up to 128 times.
        row(
            "stripes_ink",
            Pass::Stripes,
            "vec4f(stripes_ink(patches_at(0u, a.xyz), ALONG, stripe(d), Place(a.xyz, b.xyz, c.xyz), a.w), 0.0, 0.0, 0.0)",
            places,
        )
        .twin(|b, case| one(stripes_ink(b, None, ALONG, &stripe(case), &at(case), case[0].w)))
        .except_where(|_, case| in_the_middle(case))
        .within(500.0 * 10.0 * 128.0 * U, 0.0),
        row(
            "crossed_ink",
            Pass::Stripes,
            "vec4f(crossed_ink(u32(d.x * 8.0) + 20u, Place(a.xyz, b.xyz, c.xyz), a.w), 0.0, 0.0, 0.0)",
            places,
        )
        .twin(|b, case| one(crossed(b, case)))
        .except_where(|_, case| in_the_middle(case))
        .within(2.0 * 500.0 * 10.0 * 128.0 * U, 0.0),
        // As `varied_ink`, of both fields.
        row(
            "crossed_ink",
            Pass::Stripes,
            "vec4f(crossed_ink(u32(d.x * 8.0) + 20u, Place(a.xyz, b.xyz, c.xyz), a.w), 0.0, 0.0, 0.0)",
            places,
        )
        .twin(|b, case| one(crossed(b, case)))
        .in_options([Options { varied: true, ..Options::default() }])
        .except_where(|b, case| {
            // Where the nearer line changes, or the stroke.
            let nearby = [-1e-5, 1e-5].map(|step| {
                let mut moved = *case;
                (moved[0].x, moved[0].z) = (case[0].x + step, case[0].z - step);
                crossed(b, &moved)
            });
            in_the_middle(case) || (nearby[0] - nearby[1]).abs() > 0.01
        })
        .within(0.02, 0.0),
    ]
}

fn crossed(b: &Bindings<'_>, case: &Case) -> f64 {
    crossed_ink(b, (case[3].x * 8.0) as u32 as usize + 20, &at(case), case[0].w)
}

/// Weights of the corners and a tone; their change to the right and a phase; downwards, and a change of phase; phases
/// of the corners and a code.
fn places(draw: &Draw) -> Case {
    let sums_to = |sum: f64, [x, y]: [f64; 2]| {
        let (x, y) = (single(x), single(y));
        DVec3::new(x, y, single(sum - x - y))
    };
    let mut weights = [draw.unit(OWN), draw.unit(OWN + 1)];
    if weights[0] + weights[1] > 1.0 {
        weights = weights.map(|weight| 1.0 - weight);
    }
    if draw.pick(OWN + 2, 8) == 0 {
        weights[0] = 0.0;
    }
    let step = draw.scale(OWN + 3, 1e-3, 0.1);
    let change = |slot| sums_to(0.0, [draw.between(slot, -step, step), draw.between(slot + 1, -step, step)]);
    let code = draw.pick(OWN + 20, 11) as f64 - 5.0;
    let corners = [21, 22, 23].map(|slot| draw.between(OWN + slot, 0.0, 4.0));
    [
        sums_to(1.0, weights).extend(draw.tone(OWN + 4)),
        change(OWN + 8).extend(draw.between(OWN + 10, -4.0, 4.0)),
        change(OWN + 12).extend(draw.scale(OWN + 14, 1e-3, 1.0)),
        DVec3::from(corners).extend(code),
    ]
}

/// So near to the middle that a winding phase is not defined.
fn in_the_middle(case: &Case) -> bool {
    case[0].truncate().min_element() > 1.0 / 3.0 - 0.02
}

fn stripe(case: &Case) -> StripePhases {
    StripePhases { corners: case[3].truncate().as_vec3().into(), code: case[3].w as i32 }
}

fn at(case: &Case) -> Place {
    Place { weights: case[0].truncate(), dx: case[1].truncate(), dy: case[2].truncate() }
}

fn place(b: &Bindings<'_>, case: &Case) -> Place {
    let [p, dx, dy]: [DVec3; 3] = [case[0], case[1], case[2]].map(DVec4::truncate);
    place_in_face(&b.mesh, case[3].z as usize, p, dx, dy)
}
