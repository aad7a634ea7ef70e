//! Rows of `lib/patches.wgsl`, and of what blends patches.

use glam::{DVec2, DVec3, DVec4};
use tam_shaders::Pass;
use tam_shaders::cpu::lib::barycentric::corner_weights;
use tam_shaders::cpu::lib::blend::{lapped_ink, painted_ink, patch_ink, patches_ink, surface_ink};
use tam_shaders::cpu::lib::material::tile_uv;
use tam_shaders::cpu::lib::patched::{
    Lapped, lapped_of, lapped_vertex, no_overlap, patched, patched_corner, patched_face, patched_point,
    patched_turning, patched_uv, patched_vertex, stepped,
};
use tam_shaders::cpu::lib::patches::{
    NO_SEED, Overlap, heaviest, overlap_weights, place_of, seed_turn, turned_uv, without,
};
use tam_shaders::cpu::lib::surface::{FragmentIn, surface_vertex};
use tam_shaders::cpu::{Bindings, Blend, Follow, Form, Mapping, Options, Quad, fine_tone, six_way};

use super::light::grazing;
use super::maps::SAMPLED;
use super::{any_point, one, point, three, two, vertex_of, xy};
use crate::draw::{Case, Draw, OWN};
use crate::row::{Row, U, row};
use crate::setting::{CORNERS, Corner, FACES};

pub(crate) fn rows() -> Vec<Row> {
    let with = |mapping, blend| Options { mapping, blend, ..Options::default() };
    vec![
        // Planes within 1, places within 1.5: sums of four products.
        row("corner_weights", Pass::Debug, "vec4f(corner_weights(u32(d.z), a.xyz), 0.0)", any_point)
            .twin(|b, case| three(corner_weights(&b.mesh, case[3].z as usize, case[0].truncate())))
            .within(64.0 * U, 0.0),
        row(
            "seed_turn",
            Pass::FineTone,
            "seed_turn(select(u32(d.z) % 20u, NO_SEED, d.w > 6.5), u32(d.w) % 3u)",
            in_a_face,
        )
        .twin(|b, case| {
            let seed = if case[3].w > 6.5 { NO_SEED } else { case[3].z as u32 % 20 };
            seed_turn(b.options.follow, b.turns, seed, case[3].w as usize % 3)
        })
        .in_options([Follow::Surface, Follow::Light].map(|follow| Options { follow, ..Options::default() }))
        .within(1e-30, 0.0),
        // Sine and cosine of drivers are off by 2^-11 at most (WGSL); Mesa's by 1e-6. Places within 2, scaled by 1.3.
        row("turned_uv", Pass::FineTone, "vec4f(turned_uv(c.xy, vec4f(b.xy, 3.0 * b.z, 1.0)), 0.0, 0.0)", in_a_face)
            .twin(|b, case| {
                let turn = DVec4::new(case[1].x, case[1].y, 3.0 * case[1].z, 1.0);
                two(turned_uv(b.material, xy(case[2]), turn))
            })
            .within(2e-5, 0.0),
        // A product with 4.
        row("carried_overlap", Pass::FineTone, "case_overlap(u32(d.z)).places_ab", at_a_corner)
            .twin(|b, case| {
                let [a, b, ..] = overlap(b, case).places;
                DVec4::new(a.x, a.y, b.x, b.y)
            })
            .within(4.0 * U, 0.0),
        row("carried_overlap", Pass::FineTone, "case_overlap(u32(d.z)).places_cd", at_a_corner)
            .twin(|b, case| {
                let [.., a, b] = overlap(b, case).places;
                DVec4::new(a.x, a.y, b.x, b.y)
            })
            .within(4.0 * U, 0.0),
        row("carried_overlap", Pass::FineTone, "case_overlap(u32(d.z)).behind", at_a_corner)
            .twin(|b, case| overlap(b, case).behind)
            .in_options([Mapping::Patches, Mapping::Lapped].map(|mapping| with(mapping, Blend::Union)))
            .within(4.0 * U, 0.0),
        row("no_overlap", Pass::FineTone, "vec4f(no_overlap().seeds >> vec4u(8u)) + no_overlap().behind", at_a_corner)
            .twin(|_, _| DVec4::from(no_overlap().seeds.map(|seed| f64::from(seed >> 8))))
            .within(1e-30, 0.0),
        row(
            "patched_point",
            Pass::FineTone,
            "vec4f(patched_point(FragmentIn(a.xyz, b.xyz, a.xy), PatchedIn(vec4f(0.0), vec4f(0.0), vec4f(0.0), \
             vec4u(u32(d.z), u32(d.w), 1u, 2u)), true).normal, f32(patched_point(FragmentIn(a.xyz, b.xyz, a.xy), \
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
            let point = patched_point(b.scene, &input, true);
            point.normal.extend(f64::from(point.framing[1]))
        })
        .within(32.0 * U, 0.0),
        row(
            "overlap_of",
            Pass::FineTone,
            "overlap_of(PatchedIn(vec4f(0.0), vec4f(0.0), case_overlap(u32(d.z)).behind, vec4u(1u))).behind",
            at_a_corner,
        )
        .twin(|b, case| overlap(b, case).behind)
        .within(4.0 * U, 0.0),
        // Differences of numbers up to 4, each a few round-offs, and a quotient by 1 at least.
        row("overlap_weights", Pass::FineTone, "overlap_weights(case_overlap(u32(d.z)).behind)", at_a_corner)
            .twin(|b, case| overlap_weights(overlap(b, case).behind))
            .within(64.0 * U, 0.0),
        // Two matrices times a point; clip coordinates are below 10.
        row("patched_vertex", Pass::FineTone, "patched_vertex(VertexIn(a.xyz, oct_encode(b.xyz))).clip", any_point)
            .twin(|b, case| patched_vertex(b, &vertex_of(case)).0.clip)
            .within(64.0 * U, 0.0),
        row("patched_uv", Pass::FineTone, "vec4f(patched_uv(UvIn(a.xyz, oct_encode(b.xyz), d.xy)).uv, 0.0, 0.0)", any_point)
            .twin(|b, case| two(patched_uv(b, &vertex_of(case), xy(case[3])).0.uv))
            .within(1e-30, 0.0),
        row(
            "patched_corner",
            Pass::FineTone,
            "patched_corner(CornerIn(a.xyz, oct_encode(b.xyz), 0.25 * case_overlap(u32(d.z)).places_ab, 0.25 * case_overlap(u32(d.z)).places_cd, \
             0.25 * case_overlap(u32(d.z)).behind)).behind",
            at_a_corner,
        )
        .twin(|b, case| patched_corner(b, &vertex_of(case), &corner(case).patches).1.behind)
        .in_options([with(Mapping::Patches, Blend::Union)])
        .within(8.0 * U, 0.0),
        row(
            "patched_turning",
            Pass::FineTone,
            "vec4f(patched_turning(TurningIn(a.xyz, oct_encode(b.xyz), 0.25 * case_overlap(u32(d.z)).places_ab, 0.25 * case_overlap(u32(d.z)).places_cd, \
             0.25 * case_overlap(u32(d.z)).behind, \
             case_overlap(u32(d.z)).seeds)).seeds >> vec4u(8u)) + patched_turning(TurningIn(a.xyz, oct_encode(b.xyz), 0.25 * case_overlap(u32(d.z)).places_ab, 0.25 * case_overlap(u32(d.z)).places_cd, \
             0.25 * case_overlap(u32(d.z)).behind, vec4u(1u))).places_cd",
            at_a_corner,
        )
        .twin(|b, case| {
            let corner = corner(case);
            let overlap = patched_turning(b, &vertex_of(case), &corner.patches, corner.seeds).1;
            let [.., c, d] = overlap.places;
            DVec4::from(overlap.seeds.map(|seed| f64::from(seed >> 8))) + DVec4::new(c.x, c.y, d.x, d.y)
        })
        .in_options([with(Mapping::Patches, Blend::Union)])
        .within(8.0 * U, 2.0 * U),
        row(
            "patched",
            Pass::FineTone,
            "patched(surface_vertex(VertexIn(a.xyz, oct_encode(b.xyz)), d.xy), case_overlap(u32(d.z))).places_ab",
            at_a_corner,
        )
        .twin(|b, case| {
            let (_, overlap) = patched(surface_vertex(b.scene, &vertex_of(case), xy(case[3])), overlap(b, case));
            let [a, b, ..] = overlap.places;
            DVec4::new(a.x, a.y, b.x, b.y)
        })
        .within(4.0 * U, 0.0),
        row(
            "patched_face",
            Pass::FineTone,
            "vec4f(patched_face(u32(d.z)).uv, vec2f(patched_face(u32(d.z)).seeds.xy >> vec2u(8u)))",
            at_a_corner,
        )
        .twin(|b, case| {
            let (surface, overlap) = patched_face(b, case[3].z as u32);
            let [shares, normal, ..] = overlap.seeds.map(|code| f64::from(code >> 8));
            surface.uv.extend(shares).extend(normal)
        })
        .in_both_forms()
        .within(64.0 * U, 0.0),
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
            one(patch_ink(b, xy(case[2]), seed, case[1].x, case[2].z, case[0].w, &ink))
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
            "vec4f(patches_ink(case_overlap(u32(d.z)), map_scale(c.z), a.w), 0.0, 0.0, 0.0)",
            at_a_corner,
        )
        .twin(|b, case| {
            let ink = |uv, tiles_per_px, d| fine_tone::pattern_ink(b, uv, tiles_per_px, d);
            one(patches_ink(
                b,
                &overlap(b, case),
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
        row("painted_ink", Pass::FineTone, "vec4f(painted_ink(b.y, c.xy, 1.4 * b.x - 0.2, map_scale(c.z), a.w), 0.0, 0.0, 0.0)", in_a_face)
            .twin(|b, case| {
                let at = tile_uv(b.material, xy(case[2]));
                let ink = || fine_tone::pattern_ink(b, at, case[2].z, case[0].w);
                one(painted_ink(case[1].y, 1.4 * case[1].x - 0.2, ink))
            })
            .within(2.0 * SAMPLED, 0.0),
        row("heaviest", Pass::FineTone, "vec4f(f32(heaviest(case_overlap(u32(d.z)).behind)), 0.0, 0.0, 0.0)", at_a_corner)
            .twin(|b, case| one(heaviest(overlap(b, case).behind) as f64))
            .within(1e-30, 0.0),
        row("without", Pass::FineTone, "without(case_overlap(u32(d.z)).behind, u32(d.w) % 4u)", at_a_corner)
            .twin(|b, case| without(overlap(b, case).behind, case[3].w as usize % 4))
            .within(4.0 * U, 0.0),
        row(
            "place_of",
            Pass::FineTone,
            "vec4f(place_of(case_overlap(u32(d.z)), u32(d.w) % 4u), 0.0, 0.0)",
            at_a_corner,
        )
        .twin(|b, case| two(place_of(&overlap(b, case), case[3].w as usize % 4)))
        .within(4.0 * U, 0.0),
        row(
            "stepped",
            Pass::FineTone,
            "stepped(Lapped(case_overlap(u32(d.z)), case_overlap(u32(d.w)))).first.places_cd + \
             stepped(Lapped(case_overlap(u32(d.z)), case_overlap(u32(d.w)))).then.behind",
            at_a_corner,
        )
        .twin(|b, case| {
            let then = Corner::new(case[3].w as usize).overlap(b.options);
            let Lapped { first, then } = stepped(&Lapped { first: overlap(b, case), then });
            let [.., c, d] = first.places;
            DVec4::new(c.x, c.y, d.x, d.y) + then.behind
        })
        .within(8.0 * U, 0.0),
        row(
            "lapped_ink",
            Pass::FineTone,
            "vec4f(lapped_ink(Lapped(case_overlap(u32(d.z)), case_overlap(u32(d.w))), map_scale(c.z), a.w), 0.0, 0.0, 0.0)",
            at_a_corner,
        )
        .twin(|b, case| {
            let ink = |uv, tiles_per_px, d| fine_tone::pattern_ink(b, uv, tiles_per_px, d);
            let lapped = Lapped { first: overlap(b, case), then: Corner::new(case[3].w as usize).overlap(b.options) };
            one(lapped_ink(b, &lapped, case[2].z, case[0].w, &ink))
        })
        .in_options([with(Mapping::Lapped, Blend::Union)])
        .within(2.0 * SAMPLED, 0.0),
        row(
            "lapped_vertex",
            Pass::FineTone,
            "lapped_vertex(LappedIn(a.xyz, oct_encode(b.xyz), vec4f(0.0), vec4f(0.0), vec4f(0.5), 0.25 * \
             case_overlap(u32(d.z)).places_ab, vec4f(0.25), case_overlap(u32(d.z)).behind)).places_ef + \
             lapped_vertex(LappedIn(a.xyz, oct_encode(b.xyz), vec4f(0.0), vec4f(0.0), vec4f(0.5), vec4f(0.0), vec4f(0.25), \
             case_overlap(u32(d.z)).behind)).alphas_efgh",
            at_a_corner,
        )
        .twin(|b, case| {
            let corner = corner(case);
            let (_, Lapped { then, .. }) = lapped_vertex(b, &vertex_of(case), [&corner.patches, &corner.patches]);
            let [a, b, ..] = then.places;
            DVec4::new(a.x, a.y, b.x, b.y) + then.behind
        })
        .in_options([with(Mapping::Lapped, Blend::Union)])
        .within(16.0 * U, 0.0),
        row(
            "lapped_of",
            Pass::FineTone,
            "lapped_of(LappedFragment(0.0, a, a, a, b, b, c)).first.places_cd + lapped_of(LappedFragment(0.0, a, a, a, b, b, \
             c)).then.behind",
            at_a_corner,
        )
        .twin(|_, case| {
            let places = [DVec4::ZERO, case[0]].map(|v| [xy(v), DVec2::new(v.z, v.w)]).concat();
            let first = Overlap { places: [places[0], places[1], places[2], places[3]], ..Overlap::default() };
            let input = FragmentIn {
                overlap: first,
                over: Overlap { behind: case[2], ..Overlap::default() },
                ..FragmentIn::default()
            };
            let Lapped { first, then } = lapped_of(&input);
            let [.., c, d] = first.places;
            DVec4::new(c.x, c.y, d.x, d.y) + then.behind
        })
        .within(4.0 * U, 0.0),
        // So far off that pixels are as large as texels and the level counts.
        row(
            "surface_ink",
            Pass::FineTone,
            "vec4f(surface_ink(case_point(a, b, c, d), case_overlap(u32(d.z)), d.w), 0.0, 0.0, 0.0)",
            far_point,
        )
        .twin(|b, case| {
            let points = Quad::from_fn(|_| point(case));
            let ink = |uv, tiles_per_px, d| fine_tone::pattern_ink(b, uv, tiles_per_px, d);
            one(surface_ink(b, &points, &overlap(b, case), 0, case[3].w, |_, _, _| f64::NAN, &ink))
        })
        .in_options([
            with(Mapping::Patches, Blend::Linear),
            Options { form: Form::Literal, ..with(Mapping::Patches, Blend::Union) },
        ])
        .within(8.0 * SAMPLED, 0.0),
        // A tone off by a power's error (see darkness) among 64 columns.
        row(
            "vertex_weights",
            Pass::SixWay,
            "vec4f(vertex_weights(patched_vertex(VertexIn(a.xyz, oct_encode(b.xyz)))).light, 0.0)",
            any_point,
        )
        .twin(|b, case| three(six_way::vertex_weights(b, &patched_vertex(b, &vertex_of(case)).0).light))
        .except_where(shaded_at_an_edge)
        .within(64.0 * 1e-3, 0.0),
        row("weighted", Pass::SixWay, "vec4f(weighted(patched_vertex(VertexIn(a.xyz, oct_encode(b.xyz)))).dark, 0.0)", any_point)
            .twin(|b, case| {
                let (surface, overlap) = patched_vertex(b, &vertex_of(case));
                three(six_way::weighted(b, surface, overlap).2.dark)
            })
            .except_where(shaded_at_an_edge)
            .within(64.0 * 1e-3, 0.0),
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
            .twin(|b, case| one(six_way::pattern_ink(b, xy(case[2]), case[2].z, case[0].w)))
            .within(SAMPLED + 1e-4, 0.0),
    ]
}

/// As [`any_point`], at depths of 10 to 400.
fn far_point(draw: &Draw) -> Case {
    let mut case = any_point(draw);
    case[0].w = draw.scale(OWN + 50, 10.0, 400.0);
    case
}

fn corner(case: &Case) -> Corner {
    Corner::new(case[3].z as usize)
}

fn overlap(b: &Bindings<'_>, case: &Case) -> Overlap {
    corner(case).overlap(b.options)
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

/// Whether the vertex of a case is lit so that rounding decides.
fn shaded_at_an_edge(b: &Bindings<'_>, case: &Case) -> bool {
    let surface = patched_vertex(b, &vertex_of(case)).0;
    let view = b.scene.to_camera(surface.p_world).normalize();
    grazing(b, &[surface.p_world.extend(0.0), surface.normal.normalize().extend(0.0), view.extend(0.0), case[3]])
}
