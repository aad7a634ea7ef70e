//! Rows of `lib/stripes.wgsl`, `lib/striped.wgsl` and the pass that draws stripes.

use glam::{DVec2, DVec4};
use tam_shaders::Pass;
use tam_shaders::cpu::lib::striped::{Phase, line_vertex, phase_of, stroke_vertex};
use tam_shaders::cpu::lib::stripes::{
    crossed_darkness, doubled_ink, round_share, round_slope, wound_phase, wound_slope,
};
use tam_shaders::cpu::stripes::{plain_ink, stroked_ink};
use tam_shaders::cpu::{Bindings, Mapping, Options};
use tam_shaders::types::LineCorner;

use super::{any_point, one, two, vertex_of, xy};
use crate::draw::{Case, Draw, OWN};
use crate::row::{Row, U, row};
use crate::setting::{CORNERS, Corner};

pub(crate) fn rows() -> Vec<Row> {
    let mut rows = phase_rows();
    rows.extend(vertex_rows());
    rows.extend(ink_rows());
    rows
}

fn phase_rows() -> Vec<Row> {
    vec![
        // Divided by 0.02 at least.
        row("round_share", Pass::Stripes, "vec4f(round_share(a.xy), 0.0, 0.0, 0.0)", phases)
            .twin(|_, case| one(round_share(xy(case[0]))))
            .within(200.0 * U, 0.0),
        // And by that squared; changes of the weights are below 0.2.
        row("round_slope", Pass::Stripes, "vec4f(round_slope(a.xy, b.xy), 0.0, 0.0, 0.0)", phases)
            .twin(|_, case| one(round_slope(xy(case[0]), xy(case[1]))))
            .within(2e3 * U, 0.0),
        // Two windings at most, of a phase up to 16.
        row("wound_phase", Pass::Stripes, "vec4f(wound_phase(c.x, a.xy, a.z), 0.0, 0.0, 0.0)", phases)
            .twin(|_, case| one(wound_phase(case[2].x, xy(case[0]), case[0].z)))
            .within(500.0 * U, 0.0),
        row("wound_slope", Pass::Stripes, "vec4f(wound_slope(c.y, a.xy, b.xy, a.z), 0.0, 0.0, 0.0)", phases)
            .twin(|_, case| one(wound_slope(case[2].y, xy(case[0]), xy(case[1]), case[0].z)))
            .within(5e3 * U, 0.0),
        // Differences of such phases between fragments.
        row(
            "phase_of",
            Pass::Stripes,
            "vec4f(phase_of(c.x, vec4f(a.xy, 0.0, 0.0), d.z).at, phase_of(c.x, vec4f(a.xy, 0.0, 0.0), d.z).slope, 0.0)",
            smooth_phases,
        )
        .quad_twin(|_, quad, lane| {
            let rings = quad.map(|case| xy(case[0]).extend(0.0).extend(0.0));
            let phase = phase_of(&quad.map(|case| case[2].x), &rings, quad[lane][3].z, lane);
            DVec4::new(phase.at, phase.slope.x, phase.slope.y, 0.0)
        })
        .within(2e4 * U, 0.0),
    ]
}

fn vertex_rows() -> Vec<Row> {
    let ring = "vec4i(1, 0, -2, i32(d.z))";
    let line = format!("line_vertex(LineIn(a.xyz, oct_encode(b.xyz), d.xy, {ring}))");
    let stroke = format!(
        "stroke_vertex(StrokeIn(a.xyz, oct_encode(b.xyz), 0.25 * case_overlap(u32(d.z)).places_ab, vec4f(0.0), \
         0.25 * case_overlap(u32(d.z)).behind, case_overlap(u32(d.z)).seeds, d.xy, {ring}, case_rows(u32(d.z))))"
    );
    let lines =
        |case: &Case| LineCorner { phases: [case[3].x as f32, case[3].y as f32], ring: [1, 0, -2, case[3].z as i8] };
    let patches = Options { mapping: Mapping::Patches, ..Options::default() };
    vec![
        row("line_vertex", Pass::Stripes, format!("vec4f({line}.uv, {line}.ring.zw)").leak(), at_a_corner)
            .twin(move |b, case| {
                let (surface, ring) = line_vertex(b, &vertex_of(case), &lines(case));
                surface.uv.extend(ring.z).extend(ring.w)
            })
            .within(1e-30, 0.0),
        row("stroke_vertex", Pass::Stripes, format!("{stroke}.behind + {stroke}.ring").leak(), at_a_corner)
            .twin(move |b, case| {
                let corner = Corner::new(case[3].z as usize);
                let patches = (&corner.patches, corner.seeds);
                let (_, overlap, ring) = stroke_vertex(b, &vertex_of(case), patches, &lines(case));
                overlap.behind + ring
            })
            .in_options([patches])
            .within(1e-5, 0.0),
    ]
}

fn ink_rows() -> Vec<Row> {
    vec![
        // Doubling is exact; ten pixels from line to line sharpen a phase below 4 by 10 at most, doubled up to 128 times.
        row("doubled_ink", Pass::Stripes, "vec4f(doubled_ink(b.z, b.w, 5.0, a.w), 0.0, 0.0, 0.0)", phases)
            .twin(|_, case| one(doubled_ink(case[1].z, case[1].w, 5.0, case[0].w)))
            .within(6e3 * U, 0.0),
        // A square root of a quotient.
        row("crossed_darkness", Pass::Stripes, "vec4f(crossed_darkness(a.w, a.x), 0.0, 0.0)", phases)
            .twin(|_, case| two(crossed_darkness(case[0].w, case[0].x)))
            .within(16.0 * U, 0.0),
        row(
            "plain_ink",
            Pass::Stripes,
            "vec4f(plain_ink(Phase(b.z, vec2f(b.w, 0.0)), Phase(c.z, vec2f(0.0, c.w)), a.w), 0.0, 0.0, 0.0)",
            phases,
        )
        .twin(|b, case| {
            let [along, across] = both(case);
            one(plain_ink(b.material, &along, &across, case[0].w))
        })
        .within(2.0 * 6e3 * U, 0.0),
        // As `varied_ink`, of both fields.
        row(
            "stroked_ink",
            Pass::Stripes,
            "vec4f(stroked_ink(case_overlap(u32(d.w)), case_rows(u32(d.w)), Phase(b.z, vec2f(b.w, 0.0)), \
             Phase(c.z, vec2f(0.0, c.w)), a.w), 0.0, 0.0, 0.0)",
            phases,
        )
        .twin(|b, case| one(stroked(b, case)))
        .in_options([Options { mapping: Mapping::Patches, ..Options::default() }])
        .except_where(|b, case| {
            // Where the nearer line changes, or the stroke.
            let nearby = [-1e-5, 1e-5].map(|step| {
                let mut moved = *case;
                (moved[1].z, moved[2].z) = (case[1].z + step * case[1].w, case[2].z + step * case[2].w);
                stroked(b, &moved)
            });
            (nearby[0] - nearby[1]).abs() > 0.01
        })
        .within(0.02, 0.0),
    ]
}

fn both(case: &Case) -> [Phase; 2] {
    [
        Phase { at: case[1].z, slope: DVec2::new(case[1].w, 0.0) },
        Phase { at: case[2].z, slope: DVec2::new(0.0, case[2].w) },
    ]
}

fn stroked(b: &Bindings<'_>, case: &Case) -> f64 {
    let (corner, [along, across]) = (Corner::new(case[3].w as usize), both(case));
    stroked_ink(b.material, (&corner.overlap(b.options), corner.rows), &along, &across, case[0].w)
}

/// Weights of a side's corners, windings and a tone; changes of the weights, a phase and its slope; a linear phase and its
/// change, another phase and its slope; the windings of a quad, and a corner.
fn phases(draw: &Draw) -> Case {
    let ends = draw.between(OWN, 0.02, 1.0);
    let share = draw.unit(OWN + 1);
    let step = draw.scale(OWN + 3, 1e-3, 0.1);
    [
        DVec4::new(ends * share, ends * (1.0 - share), draw.pick(OWN + 2, 5) as f64 - 2.0, draw.tone(OWN + 4)),
        DVec4::new(
            draw.between(OWN + 8, -step, step),
            draw.between(OWN + 9, -step, step),
            draw.between(OWN + 10, -4.0, 4.0),
            draw.scale(OWN + 11, 1e-3, 1.0),
        ),
        DVec4::new(
            draw.between(OWN + 12, -16.0, 16.0),
            draw.between(OWN + 13, -1.0, 1.0),
            draw.between(OWN + 14, -4.0, 4.0),
            draw.scale(OWN + 15, 1e-3, 1.0),
        ),
        DVec4::new(0.0, 0.0, draw.pick(16, 5) as f64 - 2.0, draw.pick(OWN + 17, CORNERS) as f64),
    ]
}

/// The same, its weights and its linear phase changing from fragment to fragment as in a triangle.
fn smooth_phases(draw: &Draw) -> Case {
    let mut case = phases(draw);
    let lane = draw.lane() as f64;
    let (x, y) = (lane % 2.0, (lane / 2.0).floor());
    let ends = DVec2::new(draw.between(100, 0.1, 0.5), draw.between(101, 0.1, 0.5));
    let ends = ends + draw.tile(102, 0.02) * x + draw.tile(104, 0.02) * y;
    let slope = draw.tile(106, 0.2);
    (case[0].x, case[0].y) = (ends.x, ends.y);
    case[2].x = draw.between(108, -16.0, 16.0) + slope.x * x + slope.y * y;
    case
}

/// A point, and a corner.
fn at_a_corner(draw: &Draw) -> Case {
    let mut case = any_point(draw);
    case[3].z = draw.pick(OWN + 60, CORNERS) as f64;
    case
}
