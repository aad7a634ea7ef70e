//! Rows of `lib/patches.wgsl`, and of what blends patches.

use glam::{DVec3, DVec4};
use tam_shaders::Pass;
use tam_shaders::cpu::lib::barycentric::corner_weights;
use tam_shaders::cpu::lib::blend::{lapped_ink, patch_ink, patches_ink, surface_ink};
use tam_shaders::cpu::lib::patched::{patched_point, patched_vertex};
use tam_shaders::cpu::lib::patches::{
    NO_SEED, Overlap, corner_overlap, corner_vertex, overlap_weights, patch_behind, patch_place, patch_weight,
    patches_at, seed_turn, turned_uv, unpack_tens,
};
use tam_shaders::cpu::lib::surface::FragmentIn;
use tam_shaders::cpu::{Blend, Follow, Form, Mapping, Options, Quad, fine_tone, six_way};

use super::maps::SAMPLED;
use super::{any_point, one, point, three, two};
use crate::draw::{Case, Draw, OWN};
use crate::row::{Row, U, row};
use crate::setting::{CORNERS, FACES};

pub(crate) fn rows() -> Vec<Row> {
    let with = |mapping, blend| Options { mapping, blend, ..Options::default() };
    vec![
        row("unpack_tens", Pass::FineTone, "vec4f(unpack_tens(u32(b.x) * 1024u + u32(b.y)), 0.0)", codes)
            .twin(|_, case| three(unpack_tens(case[1].x as u32 * 1024 + case[1].y as u32)))
            .within(2.0 * U, 0.0),
        // Planes within 1, places within 1.5: sums of four products.
        row("corner_weights", Pass::FineTone, "vec4f(corner_weights(u32(d.z), a.xyz), 0.0)", any_point)
            .twin(|b, case| three(corner_weights(&b.mesh, case[3].z as usize, case[0].truncate())))
            .within(64.0 * U, 0.0),
        // Places within 4 tiles of codes that are exact, times weights within 1.
        row(
            "patch_place",
            Pass::FineTone,
            "vec4f(patch_place(patch_entries[u32(d.z)].places, b.xyz), 0.0, 0.0)",
            in_a_face,
        )
        .twin(|b, case| two(patch_place(b.patches.entries[case[3].z as usize].places, case[1].truncate())))
        .within(16.0 * U, 0.0),
        row(
            "seed_turn",
            Pass::FineTone,
            "seed_turn(select(u32(d.z) % 20u, NO_SEED, d.w > 6.5), u32(d.w) % 3u)",
            in_a_face,
        )
        .twin(|b, case| {
            let seed = if case[3].w > 6.5 { NO_SEED } else { case[3].z as u32 % 20 };
            seed_turn(b.options.follow, b.patches, seed, case[3].w as usize % 3)
        })
        .in_options([Follow::Surface, Follow::Light].map(|follow| Options { follow, ..Options::default() }))
        .within(1e-30, 0.0),
        // Sine and cosine of drivers are off by 2^-11 at most (WGSL); Mesa's by 1e-6. Places within 2, scaled by 1.3.
        row("turned_uv", Pass::FineTone, "vec4f(turned_uv(c.xy, vec4f(b.xy, 3.0 * b.z, 1.0)), 0.0, 0.0)", in_a_face)
            .twin(|b, case| {
                let turn = DVec4::new(case[1].x, case[1].y, 3.0 * case[1].z, 1.0);
                two(turned_uv(b.material, super::xy(case[2]), turn))
            })
            .within(2e-5, 0.0),
        // A number up to 4.
        row("patch_behind", Pass::FineTone, "vec4f(patch_behind(u32(d.z), b.xyz), 0.0, 0.0, 0.0)", in_a_face)
            .twin(|b, case| one(patch_behind(&b.patches.entries[case[3].z as usize], case[1].truncate())))
            .within(32.0 * U, 0.0),
        row(
            "patch_weight",
            Pass::FineTone,
            // Some faces here have no patches.
            "vec4f(select(patch_weight(patches_at(u32(d.z), b.xyz), u32(d.w)), 0.0, \
             u32(d.w) >= patches_at(u32(d.z), b.xyz).count), 0.0, 0.0, 0.0)",
            in_a_face,
        )
        .twin(|b, case| {
            let patches = patches_at(b.patches, case[3].z as usize, case[1].truncate());
            let i = case[3].w as usize;
            one(if i < patches.count { patch_weight(b.patches, &patches, i) } else { 0.0 })
        })
        .within(64.0 * U, 0.0),
        // Differences of numbers up to 4, each a few round-offs, of eight of them.
        row(
            "patches_at",
            Pass::FineTone,
            "vec4f(patches_at(u32(d.z), b.xyz).least + 8.0 * patches_at(u32(d.z), b.xyz).sum, \
             f32(patches_at(u32(d.z), b.xyz).first), f32(patches_at(u32(d.z), b.xyz).count), \
             patches_at(u32(d.z), b.xyz).corners.x)",
            in_a_face,
        )
        .twin(|b, case| {
            let patches = patches_at(b.patches, case[3].z as usize, case[1].truncate());
            DVec4::new(patches.least + 8.0 * patches.sum, patches.first as f64, patches.count as f64, patches.corners.x)
        })
        .within(512.0 * U, 0.0),
        // Read as they are.
        row("corner_vertex", Pass::FineTone, "vec4f(f32(corner_vertex(u32(d.z))), 0.0, 0.0, 0.0)", at_a_corner)
            .twin(|b, case| one(corner_vertex(b.patches, case[3].z as u32).into()))
            .within(1e-30, 0.0),
        // A product with 4.
        row("corner_overlap", Pass::FineTone, "corner_overlap(u32(d.z)).places_ab", at_a_corner)
            .twin(|b, case| {
                let [a, b, ..] = corner_overlap(b.options.follow, b.patches, case[3].z as u32).places;
                DVec4::new(a.x, a.y, b.x, b.y)
            })
            .within(4.0 * U, 0.0),
        row("corner_overlap", Pass::FineTone, "corner_overlap(u32(d.z)).places_cd", at_a_corner)
            .twin(|b, case| {
                let [.., a, b] = corner_overlap(b.options.follow, b.patches, case[3].z as u32).places;
                DVec4::new(a.x, a.y, b.x, b.y)
            })
            .within(4.0 * U, 0.0),
        row("corner_overlap", Pass::FineTone, "corner_overlap(u32(d.z)).behind", at_a_corner)
            .twin(|b, case| corner_overlap(b.options.follow, b.patches, case[3].z as u32).behind)
            .within(4.0 * U, 0.0),
        row("corner_overlap", Pass::FineTone, "vec4f(corner_overlap(u32(d.z)).seeds % vec4u(1000003u))", at_a_corner)
            .twin(|b, case| {
                DVec4::from(
                    corner_overlap(b.options.follow, b.patches, case[3].z as u32)
                        .seeds
                        .map(|seed| (seed % 1_000_003).into()),
                )
            })
            .in_options([Follow::Surface, Follow::Light].map(|follow| Options { follow, ..Options::default() }))
            .within(1e-30, 0.0),
        row(
            "patched_point",
            Pass::FineTone,
            "vec4f(patched_point(FragmentIn(a.xyz, b.xyz, a.xy, 1u), PatchedIn(vec4f(0.0), vec4f(0.0), vec4f(0.0), \
             vec4u(u32(d.z), u32(d.w), 1u, 2u)), true).normal, f32(patched_point(FragmentIn(a.xyz, b.xyz, a.xy, 1u), \
             PatchedIn(vec4f(0.0), vec4f(0.0), vec4f(0.0), vec4u(u32(d.z), u32(d.w), 1u, 2u)), true).framing.y))",
            at_a_corner,
        )
        .twin(|b, case| {
            let overlap = Overlap { seeds: [case[3].z as u32, case[3].w as u32, 1, 2], ..Overlap::default() };
            let input = FragmentIn {
                p_world: case[0].truncate(),
                normal: case[1].truncate(),
                overlap,
                ..FragmentIn::default()
            };
            let point = patched_point(b.scene, b.material, &input, true);
            point.normal.extend(f64::from(point.framing[1]))
        })
        .within(32.0 * U, 0.0),
        row(
            "overlap_of",
            Pass::FineTone,
            "overlap_of(PatchedIn(vec4f(0.0), vec4f(0.0), corner_overlap(u32(d.z)).behind, vec4u(1u))).behind",
            at_a_corner,
        )
        .twin(|b, case| corner_overlap(b.options.follow, b.patches, case[3].z as u32).behind)
        .within(4.0 * U, 0.0),
        // Differences of numbers up to 4, each a few round-offs, and a quotient by 1 at least.
        row("overlap_weights", Pass::FineTone, "overlap_weights(corner_overlap(u32(d.z)).behind)", at_a_corner)
            .twin(|b, case| overlap_weights(corner_overlap(b.options.follow, b.patches, case[3].z as u32).behind))
            .within(64.0 * U, 0.0),
        // Two matrices times a point; clip coordinates are below 10.
        row(
            "patched_vertex",
            Pass::FineTone,
            "vec4f(patched_vertex(u32(d.w)).uv, vec2f(patched_vertex(u32(d.w)).seeds.xy >> vec2u(8u)))",
            at_a_corner,
        )
        .twin(|b, case| {
            let (surface, overlap) = patched_vertex(b, case[3].w as u32);
            let [shares, normal, ..] = overlap.seeds.map(|code| f64::from(code >> 8));
            surface.uv.extend(shares).extend(normal)
        })
        .in_options([Options { mapping: Mapping::Frames, ..Options::default() }])
        .within(64.0 * U, 0.0),
        row("patched_vertex", Pass::FineTone, "patched_vertex(u32(d.w)).clip", at_a_corner)
            .twin(|b, case| patched_vertex(b, case[3].w as u32).0.clip)
            .in_options([Mapping::Uv, Mapping::Patches].map(|mapping| with(mapping, Blend::Union)))
            .within(64.0 * U, 0.0),
        row("patched_vertex", Pass::FineTone, "patched_vertex(u32(d.w)).behind", at_a_corner)
            .twin(|b, case| patched_vertex(b, case[3].w as u32).1.behind)
            .in_options([Mapping::Uv, Mapping::Patches].map(|mapping| with(mapping, Blend::Union)))
            .within(4.0 * U, 0.0),
        // Each pattern is one sample, and up to three make a union.
        row(
            "patch_ink",
            Pass::FineTone,
            "vec4f(patch_ink(c.xy, u32(d.z) % 20u, b.x, map_scale(c.z), a.w, log2_light(a.w)), 0.0, 0.0, 0.0)",
            at_a_corner,
        )
        .twin(|b, case| {
            let ink = |uv, tiles_per_px, d| fine_tone::pattern_ink(b, uv, tiles_per_px, d);
            let seed = case[3].z as u32 % 20;
            one(patch_ink(b, super::xy(case[2]), seed, case[1].x, case[2].z, case[0].w, &ink))
        })
        .in_options([
            with(Mapping::Patches, Blend::Union),
            with(Mapping::Patches, Blend::Linear),
            Options { follow: Follow::Light, ..with(Mapping::Patches, Blend::Union) },
        ])
        .within(3.0 * SAMPLED, 0.0),
        // Each pattern is one sample; weights sum to 1, and no union is more sensitive than its patterns together.
        row(
            "patches_ink",
            Pass::FineTone,
            "vec4f(patches_ink(corner_overlap(u32(d.z)), map_scale(c.z), a.w), 0.0, 0.0, 0.0)",
            at_a_corner,
        )
        .twin(|b, case| {
            let ink = |uv, tiles_per_px, d| fine_tone::pattern_ink(b, uv, tiles_per_px, d);
            one(patches_ink(
                b,
                &corner_overlap(b.options.follow, b.patches, case[3].z as u32),
                case[2].z,
                case[0].w,
                &ink,
            ))
        })
        .in_options([
            with(Mapping::Patches, Blend::Union),
            with(Mapping::Patches, Blend::Linear),
            Options { follow: Follow::Light, ..with(Mapping::Patches, Blend::Union) },
        ])
        .within(4.0 * SAMPLED, 0.0),
        row(
            "lapped_ink",
            Pass::FineTone,
            "vec4f(lapped_ink(u32(d.z), b.xyz, map_scale(c.z), a.w), 0.0, 0.0, 0.0)",
            in_a_face,
        )
        .twin(|b, case| {
            let ink = |uv, tiles_per_px, d| fine_tone::pattern_ink(b, uv, tiles_per_px, d);
            one(lapped_ink(b, case[3].z as usize, case[1].truncate(), case[2].z, case[0].w, &ink))
        })
        .in_options([with(Mapping::Lapped, Blend::Union)])
        .within(2.0 * SAMPLED, 0.0),
        // Planes are anything here, so places are far outside the faces: weights up to 3 stretch the errors. So far off
        // that pixels are as large as texels and the level counts.
        row(
            "surface_ink",
            Pass::FineTone,
            "vec4f(surface_ink(case_point(a, b, c, d), corner_overlap(u32(d.z)), d.w), 0.0, 0.0, 0.0)",
            far_point,
        )
        .twin(|b, case| {
            let points = Quad::from_fn(|_| point(case));
            let ink = |uv, tiles_per_px, d| fine_tone::pattern_ink(b, uv, tiles_per_px, d);
            let overlap = corner_overlap(b.options.follow, b.patches, case[3].z as u32);
            one(surface_ink(b, &points, &overlap, 0, case[3].w, |_, _, _| f64::NAN, &ink))
        })
        .in_options([
            with(Mapping::Patches, Blend::Linear),
            with(Mapping::Lapped, Blend::Union),
            Options { form: Form::Literal, ..with(Mapping::Lapped, Blend::Union) },
        ])
        .within(8.0 * SAMPLED, 0.0),
        // A sum of six products.
        row(
            "weighted_tone",
            Pass::SixWay,
            "vec4f(weighted_tone(Weights(abs(b.xyz), abs(c.xyz))), 0.0, 0.0, 0.0)",
            any_point,
        )
        .twin(|b, case| {
            let weights = six_way::Weights { light: case[1].truncate().abs(), dark: case[2].truncate().abs() };
            one(six_way::weighted_tone(b.material, &weights))
        })
        .within(16.0 * U, 0.0),
        row("pattern_ink", Pass::SixWay, "vec4f(pattern_ink(c.xy, map_scale(c.z), a.w), 0.0, 0.0, 0.0)", in_a_face)
            .twin(|b, case| one(six_way::pattern_ink(b, super::xy(case[2]), case[2].z, case[0].w)))
            .within(SAMPLED + 1e-4, 0.0),
    ]
}

/// As [`any_point`], at depths of 10 to 400.
fn far_point(draw: &Draw) -> Case {
    let mut case = any_point(draw);
    case[0].w = draw.scale(OWN + 50, 10.0, 400.0);
    case
}

/// Two numbers of ten and more bits.
fn codes(draw: &Draw) -> Case {
    let codes = DVec4::new(draw.pick(OWN, 1 << 20) as f64, draw.pick(OWN + 1, 1024) as f64, 0.0, 0.0);
    [DVec4::ZERO, codes, DVec4::ZERO, DVec4::ZERO]
}

/// As [`in_a_face`], at a corner that sees patches, which is told twice.
fn at_a_corner(draw: &Draw) -> Case {
    let mut case = in_a_face(draw);
    let corner = draw.pick(OWN + 12, CORNERS) as f64;
    (case[3].z, case[3].w) = (corner, corner % 48.0);
    case
}

/// A place in a face by its barycentric weights, a footprint, a tone, and one of the face's patches.
fn in_a_face(draw: &Draw) -> Case {
    let weights = DVec3::from([0, 1, 2].map(|i| draw.unit(OWN + i)));
    let weights = weights / weights.element_sum().max(1e-3);
    let weights = DVec3::from(weights.to_array().map(crate::draw::single));
    let uv = draw.tile(OWN + 20, 2.0);
    let face = draw.pick(OWN + 10, FACES) as f64;
    [
        DVec4::new(0.0, 0.0, 0.0, draw.tone(OWN + 30)),
        weights.extend(0.0),
        DVec4::new(uv.x, uv.y, draw.scale(OWN + 40, 2e-3, 1.0), 0.0),
        DVec4::new(0.0, 0.0, face, draw.pick(OWN + 11, 8) as f64),
    ]
}
