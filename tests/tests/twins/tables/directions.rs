//! Rows of `lib/directions.wgsl`.

use glam::{DVec2, DVec3, DVec4};
use tam_shaders::Pass;
use tam_shaders::cpu::lib::barycentric::Place;
use tam_shaders::cpu::lib::directions::{
    OverlapSlopes, direction_across, frame_direction, lapped_direction, mapped_direction, patch_direction,
    patches_direction, pattern_direction, rotated, stripes_direction, triplanar_direction,
};
use tam_shaders::cpu::lib::face_frame::fixed_tangent;
use tam_shaders::cpu::lib::octahedral::oct_decode;
use tam_shaders::cpu::lib::patches::{MAX_PATCHES, copies, corner_overlap, patch_place, seed_turn};
use tam_shaders::cpu::lib::stripes::stripe_slope;
use tam_shaders::cpu::lib::surface::Point;
use tam_shaders::cpu::{Bindings, Follow, Mapping, Options};

use super::{two, xy};
use crate::draw::{Case, Draw, OWN, single};
use crate::row::{Row, U, row};
use crate::setting::FACES;

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
            "vec4f(patches_direction(corner_overlap(u32(d.w)), OverlapSlopes(b.xyxy, b.yzzx, c.xyxy, c.yzzx)), 0.0, 0.0)",
            steps,
        )
            .twin(|b, case| two(patches_direction(b, &corner_overlap(b.options.follow, b.patches, case[3].w as u32), &slopes(case))))
            .in_options([mapped(Mapping::Patches), following])
            .except_where(corner_is_short)
            .within(DIRECTION, 0.0),
        row("lapped_direction", Pass::Debug, "vec4f(lapped_direction(u32(d.w), Place(a.xyz, b.xyz, c.xyz)), 0.0, 0.0)", steps)
            .twin(|b, case| two(lapped_direction(b, case[3].w as usize, &place(case))))
            .except_where(patches_are_short)
            .within(DIRECTION, 0.0),
        row("stripes_direction", Pass::Debug, "vec4f(stripes_direction(u32(d.w), Place(a.xyz, b.xyz, c.xyz)), 0.0, 0.0)", steps)
            .twin(|b, case| two(stripes_direction(b, case[3].w as usize, &place(case))))
            .except_where(stripes_are_short)
            // Slopes of a winding are off by 5e3 round-offs, as said there, and 0.05 of the steps long at least.
            .within(5e3 * U / 0.05, 0.0),
        row(
            "mapped_direction",
            Pass::Debug,
            "vec4f(mapped_direction(Point(a.xyz, d.xyz, d.xyz, 1.0, a.xy, u32(d.w), \
             vec2u(face_frames[u32(d.w)].shares, face_frames[u32(d.w)].normal_oct)), Place(a.xyz, b.xyz, c.xyz), \
             corner_overlap(u32(d.w)), OverlapSlopes(b.xyxy, b.yzzx, c.xyxy, c.yzzx), b.xyz, c.xyz, b.xy, c.xy), 0.0, 0.0)",
            steps,
        )
        .twin(|b, case| {
            let [p, dx, dy, n] = [0, 1, 2, 3].map(|i: usize| case[i].truncate());
            let face = case[3].w as usize;
            let framing = [b.mesh.face_frames[face].shares, b.mesh.face_frames[face].normal_oct];
            let point = Point { p_world: p, normal: n, view: n, depth: 1.0, uv: xy(case[0]), face, framing };
            let overlap = (&corner_overlap(b.options.follow, b.patches, case[3].w as u32), &slopes(case));
            two(mapped_direction(b, &point, &place(case), overlap, [dx, dy], [xy(case[1]), xy(case[2])]))
        })
        .in_options(
            [Mapping::Uv, Mapping::Frames, Mapping::Triplanar, Mapping::Patches, Mapping::Lapped].map(mapped),
        )
        .except_where(|b, case| match b.options.mapping {
            Mapping::Uv => is_short(b, case, 1.0, DVec3::X, DVec3::Y),
            Mapping::Frames => frame_is_short(b, case),
            Mapping::Triplanar => planes_are_short(b, case),
            Mapping::Patches => corner_is_short(b, case),
            Mapping::Lapped => patches_are_short(b, case),
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

fn place(case: &Case) -> Place {
    Place { weights: case[0].truncate(), dx: case[1].truncate(), dy: case[2].truncate() }
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
    seeds_are_short(b, case, &corner_overlap(b.options.follow, b.patches, case[3].w as u32).seeds)
}

/// Any of the changes of [`slopes`], turned as any copy of these seeds' patches.
fn seeds_are_short(b: &Bindings<'_>, case: &Case, seeds: &[u32]) -> bool {
    let (m, slopes) = (b.material.tile_from_surface, slopes(case));
    seeds.iter().flat_map(|seed| (0..copies(b.options.follow)).map(move |copy| (*seed, copy))).any(|(seed, copy)| {
        let angle = seed_turn(b.options.follow, b.patches, seed, copy).z;
        let v = |st: DVec2| DVec2::new(m.z, m.w).dot(rotated(st, angle));
        (0..4).any(|i| short(case, 1.0, DVec2::new(v(slopes.dx[i]), v(slopes.dy[i]))))
    })
}

/// Any patch of the face. Places are within 2 tiles.
fn patches_are_short(b: &Bindings<'_>, case: &Case) -> bool {
    let face = case[3].w as usize;
    let (first, end) = (b.patches.starts[face] as usize, b.patches.starts[face + 1] as usize);
    let m = b.material.tile_from_surface;
    (first..end.min(first + MAX_PATCHES)).any(|entry| {
        let st = |change: DVec4| patch_place(b.patches.entries[entry].places, change.truncate());
        let v = |change: DVec4| DVec2::new(m.z, m.w).dot(st(change));
        short(case, 2.0, DVec2::new(v(case[1]), v(case[2])))
    })
}

fn stripes_are_short(b: &Bindings<'_>, case: &Case) -> bool {
    let s = &b.stripes.along[case[3].w as usize];
    let slope = |change: DVec4| stripe_slope(s, case[0].truncate(), change.truncate());
    short(case, 5.0, DVec2::new(slope(case[1]), slope(case[2]))) || case[0].truncate().min_element() > 1.0 / 3.0 - 0.02
}
