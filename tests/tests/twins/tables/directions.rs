//! Rows of `lib/directions.wgsl`.

use glam::{DVec2, DVec3, DVec4};
use tam_shaders::Pass;
use tam_shaders::cpu::debug::stripes_direction;
use tam_shaders::cpu::lib::directions::{
    OverlapSlopes, direction_across, frame_direction, lapped_direction, mapped_direction, overlapped_direction,
    painted_direction, patch_direction, patches_direction, pattern_direction, rotated, triplanar_direction,
};
use tam_shaders::cpu::lib::face_frame::fixed_tangent;
use tam_shaders::cpu::lib::octahedral::oct_decode;
use tam_shaders::cpu::lib::patched::Lapped;
use tam_shaders::cpu::lib::patches::{copies, seed_turn};
use tam_shaders::cpu::lib::striped::Phase;
use tam_shaders::cpu::lib::surface::Point;
use tam_shaders::cpu::{Bindings, Follow, Mapping, Options};

use super::{two, xy};
use crate::draw::{Case, Draw, OWN, single};
use crate::row::{Row, U, row};
use crate::setting::{Corner, FACES};

/// A gradient is a sum of a dozen products and left out where a hundredth of them remains; sine and cosine are off by
/// 1e-6 more.
const DIRECTION: f64 = 64.0 * U / 0.01 + 1e-4;

pub(crate) fn rows() -> Vec<Row> {
    let mapped = |mapping| Options { mapping, ..Options::default() };
    let following = Options { follow: Follow::Light, ..mapped(Mapping::Patches) };
    vec![
        row("direction_across", Pass::Debug, "vec4f(direction_across(b.xy * b.w), 0.0, 0.0)", steps)
            .twin(|_, case| two(direction_across(xy(case[1]) * case[1].w)))
            .within(32.0 * U, 0.0),
        row("pattern_direction", Pass::Debug, "vec4f(pattern_direction(b.xy, c.xy), 0.0, 0.0)", steps)
            .twin(|b, case| two(pattern_direction(b.material, xy(case[1]), xy(case[2]))))
            .except_where(|b, case| is_short(b, case, 1.0, DVec3::X, DVec3::Y))
            .within(DIRECTION, 0.0),
        row(
            "frame_direction",
            Pass::Debug,
            "vec4f(frame_direction(vec2u(face_frames[u32(d.w)].shares, face_frames[u32(d.w)].normal_oct), b.xy, c.xy, b.xyz, \
             c.xyz), 0.0, 0.0)",
            steps,
        )
        .twin(|b, case| {
            let frame = &b.mesh.face_frames[case[3].w as usize];
            let framing = [frame.shares, frame.normal_oct];
            let steps = [case[1], case[2]].map(DVec4::truncate);
            two(frame_direction(b.material, framing, [xy(case[1]), xy(case[2])], steps))
        })
        .except_where(frame_is_short)
        .within(DIRECTION, 0.0),
        // Weights by logarithms that drivers have to 1e-5.
        row("triplanar_direction", Pass::Debug, "vec4f(triplanar_direction(d.xyz, b.xyz, c.xyz), 0.0, 0.0)", steps)
            .twin(|b, case| {
                let [n, dx, dy] = [case[3], case[1], case[2]].map(DVec4::truncate);
                two(triplanar_direction(b.material, n, dx, dy))
            })
            .except_where(planes_are_short)
            .within(DIRECTION + 2e-4, 0.0),
        row("rotated", Pass::Debug, "vec4f(rotated(b.xy, 30.0 * a.x), 0.0, 0.0)", steps)
            .twin(|_, case| two(rotated(xy(case[1]), 30.0 * case[0].x)))
            .within(2e-5, 0.0),
        row("patch_direction", Pass::Debug, "vec4f(patch_direction(b.xy, c.xy, u32(d.w) % 20u, a.x), 0.0, 0.0)", steps)
            .twin(|b, case| two(patch_direction(b, xy(case[1]), xy(case[2]), case[3].w as u32 % 20, case[0].x)))
            .in_options([mapped(Mapping::Patches), following])
            .except_where(|b, case| seeds_are_short(b, case, &[case[3].w as u32 % 20]))
            .within(DIRECTION, 0.0),
        row(
            "patches_direction",
            Pass::Debug,
            "vec4f(patches_direction(case_overlap(u32(d.w)), OverlapSlopes(b.xyxy, b.yzzx, c.xyxy, c.yzzx)), 0.0, 0.0)",
            steps,
        )
            .twin(|b, case| two(patches_direction(b, &Corner::new(case[3].w as usize).overlap(b.options), &slopes(case))))
            .in_options([mapped(Mapping::Patches), following])
            .except_where(corner_is_short)
            .within(DIRECTION, 0.0),
        row("painted_direction", Pass::Debug, "vec4f(painted_direction(d.xy, b.xy, c.xy, 1.4 * a.w - 0.2), 0.0, 0.0)", steps)
            .twin(|b, case| {
                let alpha = 1.4 * case[0].w - 0.2;
                two(painted_direction(b.material, xy(case[3]), xy(case[1]), xy(case[2]), alpha))
            })
            .except_where(|b, case| is_short(b, case, 1.0, DVec3::X, DVec3::Y))
            .within(DIRECTION, 0.0),
        row(
            "overlapped_direction",
            Pass::Debug,
            "vec4f(overlapped_direction(d.xy, case_overlap(u32(d.w)), OverlapSlopes(b.xyxy, b.yzzx, c.xyxy, c.yzzx)), 0.0, 0.0)",
            steps,
        )
        .twin(|b, case| {
            let overlap = Corner::new(case[3].w as usize).overlap(b.options);
            two(overlapped_direction(b.material, xy(case[3]), &overlap, &slopes(case)))
        })
        .in_options([mapped(Mapping::Lapped)])
        .except_where(corner_is_short)
        .within(DIRECTION, 0.0),
        row(
            "lapped_direction",
            Pass::Debug,
            "vec4f(lapped_direction(Lapped(case_overlap(u32(d.w)), case_overlap(u32(d.w) + 1u)), OverlapSlopes(b.xyxy, b.yzzx, \
             c.xyxy, c.yzzx), OverlapSlopes(b.xyxy, b.yzzx, c.xyxy, c.yzzx)), 0.0, 0.0)",
            steps,
        )
        .twin(|b, case| {
            let corner = |next| Corner::new(case[3].w as usize + next).overlap(b.options);
            let lapped = Lapped { first: corner(0), then: corner(1) };
            two(lapped_direction(b.material, &lapped, &slopes(case), &slopes(case)))
        })
        .in_options([mapped(Mapping::Lapped)])
        .except_where(corner_is_short)
        .within(DIRECTION, 0.0),
        row("stripes_direction", Pass::Debug, "vec4f(stripes_direction(Phase(a.x, b.xy * b.w)), 0.0, 0.0)", steps)
            .twin(|_, case| two(stripes_direction(&Phase { at: case[0].x, slope: xy(case[1]) * case[1].w })))
            .within(32.0 * U, 0.0),
        row(
            "mapped_direction",
            Pass::Debug,
            "vec4f(mapped_direction(Point(a.xyz, d.xyz, d.xyz, 1.0, a.xy, \
             vec2u(face_frames[u32(d.w)].shares, face_frames[u32(d.w)].normal_oct)), case_overlap(u32(d.w)), OverlapSlopes(b.xyxy, b.yzzx, c.xyxy, c.yzzx), b.xyz, c.xyz, b.xy, c.xy), 0.0, 0.0)",
            steps,
        )
        .twin(|b, case| {
            let [p, dx, dy, n] = [0, 1, 2, 3].map(|i: usize| case[i].truncate());
            let face = case[3].w as usize;
            let framing = [b.mesh.face_frames[face].shares, b.mesh.face_frames[face].normal_oct];
            let point = Point { p_world: p, normal: n, view: n, depth: 1.0, uv: xy(case[0]), framing };
            let overlap = (&Corner::new(case[3].w as usize).overlap(b.options), &slopes(case));
            two(mapped_direction(b, &point, overlap, [dx, dy], [xy(case[1]), xy(case[2])]))
        })
        .in_options(
            [Mapping::Uv, Mapping::Frames, Mapping::Triplanar, Mapping::Patches].map(mapped),
        )
        .except_where(|b, case| match b.options.mapping {
            Mapping::Uv => is_short(b, case, 1.0, DVec3::X, DVec3::Y),
            Mapping::Frames => frame_is_short(b, case),
            Mapping::Triplanar => planes_are_short(b, case),
            Mapping::Patches | Mapping::Lapped => corner_is_short(b, case),
        })
        .within(DIRECTION + 2e-4, 0.0),
    ]
}

/// Weights of the corners and a tone; changes to the right, and a scale that may be none; changes below; a normal and a
/// face.
fn steps(draw: &Draw) -> Case {
    let weights = DVec3::from([0, 1, 2].map(|i| draw.unit(OWN + i)));
    let weights = weights / weights.element_sum().max(1e-3);
    let weights = DVec3::from(weights.to_array().map(single));
    let step = draw.scale(OWN + 3, 1e-3, 0.1);
    let scale = [0.0, 1e-3, 1.0][draw.pick(OWN + 4, 3)];
    [
        weights.extend(draw.tone(OWN + 5)),
        draw.place_within(OWN + 10, step).extend(scale),
        draw.place_within(OWN + 20, step).extend(0.0),
        draw.direction(OWN + 30).extend(draw.pick(OWN + 40, FACES) as f64),
    ]
}

/// Whether a gradient is short beside the terms it is a sum of, which are `scale` times the steps.
fn short(case: &Case, scale: f64, gradient: DVec2) -> bool {
    gradient.length() < 0.01 * scale * (case[1].truncate().length() + case[2].truncate().length())
}

/// The same of v, where surface coordinates are places along two axes.
fn is_short(b: &Bindings<'_>, case: &Case, scale: f64, s: DVec3, t: DVec3) -> bool {
    let m = b.material.tile_from_surface;
    let v = m.z * s + m.w * t;
    short(case, scale, DVec2::new(v.dot(case[1].truncate()), v.dot(case[2].truncate())))
}

fn frame_is_short(b: &Bindings<'_>, case: &Case) -> bool {
    let n = oct_decode(b.mesh.face_frames[case[3].w as usize].normal_oct);
    let e = fixed_tangent(n);
    is_short(b, case, 1.0, DVec3::X, DVec3::Y) || is_short(b, case, 1.0, e, n.cross(e))
}

fn planes_are_short(b: &Bindings<'_>, case: &Case) -> bool {
    [(DVec3::Z, DVec3::Y), (DVec3::X, DVec3::Z), (DVec3::X, DVec3::Y)]
        .iter()
        .any(|(s, t)| is_short(b, case, 1.0, *s, *t))
}

/// Changes of the places of four patches.
fn slopes(case: &Case) -> OverlapSlopes {
    let of = |v: DVec4| [DVec2::new(v.x, v.y), DVec2::new(v.x, v.y), DVec2::new(v.y, v.z), DVec2::new(v.z, v.x)];
    OverlapSlopes { dx: of(case[1]), dy: of(case[2]) }
}

fn corner_is_short(b: &Bindings<'_>, case: &Case) -> bool {
    seeds_are_short(b, case, &Corner::new(case[3].w as usize).overlap(b.options).seeds)
}

/// Any of the changes of [`slopes`], turned as any copy of these seeds' patches.
fn seeds_are_short(b: &Bindings<'_>, case: &Case, seeds: &[u32]) -> bool {
    let (m, slopes) = (b.material.tile_from_surface, slopes(case));
    seeds.iter().flat_map(|seed| (0..copies(b.options.follow)).map(move |copy| (*seed, copy))).any(|(seed, copy)| {
        let angle = seed_turn(b.options.follow, b.turns, seed, copy).z;
        let v = |st: DVec2| DVec2::new(m.z, m.w).dot(rotated(st, angle));
        (0..4).any(|i| short(case, 1.0, DVec2::new(v(slopes.dx[i]), v(slopes.dy[i]))))
    })
}
