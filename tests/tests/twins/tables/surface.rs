//! Rows of `lib/surface.wgsl` and `lib/mapping.wgsl`.

use glam::{DVec2, DVec3, DVec4};
use tam_shaders::Pass;
use tam_shaders::cpu::lib::face_frame::unpack_shares;
use tam_shaders::cpu::lib::faced::{face_of, faced_vertex, pulled_vertex};
use tam_shaders::cpu::lib::mapping::{
    Mapped, footprint, frame_patterns, frame_place, frame_st, map_frames, map_surface, map_triplanar, map_uv,
    mean_footprint, pattern_count, triplanar_weights,
};
use tam_shaders::cpu::lib::surface::{FragmentIn, drawn, surface_point, surface_vertex};
use tam_shaders::cpu::{Bindings, Mapping, Options};

use super::{any_point, framed_point, one, point, three, two, vertex_of, xy};
use crate::draw::{Case, Draw, OWN};
use crate::row::{Row, U, row};

pub(crate) fn rows() -> Vec<Row> {
    let mut rows = surface_rows();
    rows.extend(mapping_rows());
    rows
}

fn surface_rows() -> Vec<Row> {
    let vertex = "VertexIn(a.xyz, oct_encode(b.xyz))";
    let of_vertex =
        |name: &'static str, call: &str| row(name, Pass::Phong, call.replace("VERTEX", vertex).leak(), any_point);
    let twin = |b: &Bindings<'_>, case: &Case| surface_vertex(b.scene, &vertex_of(case), xy(case[3]));
    vec![
        // Two matrices times a point; clip coordinates are below 10.
        of_vertex("surface_vertex", "surface_vertex(VERTEX, d.xy).clip")
            .twin(move |b, case| twin(b, case).clip)
            .within(64.0 * U, 0.0),
        of_vertex("surface_vertex", "vec4f(surface_vertex(VERTEX, d.xy).p_world, 0.0)")
            .twin(move |b, case| three(twin(b, case).p_world))
            .within(16.0 * U, 0.0),
        // A step of the code turns the normal by 6e-5 where rounding decides.
        of_vertex("surface_vertex", "vec4f(surface_vertex(VERTEX, d.xy).normal, 0.0)")
            .twin(move |b, case| three(twin(b, case).normal))
            .within(2e-4, 0.0),
        of_vertex("surface_vertex", "vec4f(surface_vertex(VERTEX, d.xy).uv, 0.0, 0.0)")
            .twin(move |b, case| two(twin(b, case).uv))
            .within(1e-30, 0.0),
        row("face_of", Pass::FaceFrame, "vec4f(f32(face_of(u32(d.z))), 0.0, 0.0, 0.0)", any_point)
            .twin(|b, case| one(face_of(b.material, case[3].z as u32).into()))
            .within(1e-30, 0.0),
        row(
            "pulled_vertex",
            Pass::FaceFrame,
            "vec4f(pulled_vertex(u32(d.z)).position, f32(pulled_vertex(u32(d.z)).normal_oct >> 8u))",
            any_point,
        )
        .twin(|b, case| {
            let vertex = pulled_vertex(b, case[3].z as u32);
            vertex.position.extend(f64::from(vertex.normal_oct >> 8))
        })
        .within(1e-30, 0.0),
        row(
            "faced_vertex",
            Pass::FaceFrame,
            "vec4f(faced_vertex(u32(d.z)).p_world, f32(faced_vertex(u32(d.z)).face))",
            any_point,
        )
        .twin(|b, case| {
            let (surface, face) = faced_vertex(b, case[3].z as u32);
            surface.p_world.extend(face.into())
        })
        .within(16.0 * U, 0.0),
        row("to_camera", Pass::Phong, "vec4f(to_camera(a.xyz), 0.0)", fragments)
            .twin(|b, case| three(b.scene.to_camera(case[0].truncate())))
            .within(16.0 * U, 0.0),
        // A distance of 6, then unit vectors.
        row(
            "surface_point",
            Pass::Phong,
            "vec4f(surface_point(FragmentIn(a.xyz, b.xyz * b.w, d.xy), d.w > 0.5).normal, \
             surface_point(FragmentIn(a.xyz, b.xyz, d.xy), true).depth)",
            fragments,
        )
        .twin(|b, case| {
            let of = |scale: f64, front| surface_point(b.scene, &input(case, scale), front);
            of(case[1].w, case[3].w > 0.5).normal.extend(of(1.0, true).depth)
        })
        .within(32.0 * U, 0.0),
        row(
            "surface_point",
            Pass::Phong,
            "vec4f(surface_point(FragmentIn(a.xyz, b.xyz, d.xy), true).view, \
             surface_point(FragmentIn(a.xyz, b.xyz, d.xy), true).uv.y)",
            fragments,
        )
        .twin(|b, case| {
            let point = surface_point(b.scene, &input(case, 1.0), true);
            point.view.extend(point.uv.y)
        })
        .within(16.0 * U, 0.0),
        row("drawn", Pass::Phong, "drawn(d.w)", fragments)
            .twin(|b, case| drawn(b.scene, b.material, case[3].w))
            .within(4.0 * U, 0.0),
    ]
}

fn mapping_rows() -> Vec<Row> {
    let all_mappings =
        || [Mapping::Uv, Mapping::Frames, Mapping::Triplanar].map(|mapping| Options { mapping, ..Options::default() });
    vec![
        // A quotient by 0.1 at least.
        row("footprint", Pass::StrokeMap, "vec4f(footprint(case_point(a, b, c, d)), 0.0, 0.0, 0.0)", any_point)
            .twin(|b, case| one(footprint(b.options.form, b.scene, b.material, &point(case))))
            .in_both_forms()
            .within(1e-9, 100.0 * U),
        row(
            "mean_footprint",
            Pass::FineTone,
            "vec4f(mean_footprint(case_point(a, b, c, d)), 0.0, 0.0, 0.0)",
            any_point,
        )
        .twin(|b, case| one(mean_footprint(b.options.form, b.scene, b.material, &point(case))))
        .in_both_forms()
        .within(1e-9, 100.0 * U),
        // A matrix that stretches to 2 at most.
        row("frame_place", Pass::StrokeMap, "vec4f(frame_place(a.xyz), 0.0)", any_point)
            .twin(|b, case| three(frame_place(b.options.form, b.scene, case[0].truncate())))
            .in_both_forms()
            .within(64.0 * U, 0.0),
        // Round-offs of uv, below 4; a difference of them.
        row(
            "map_uv",
            Pass::StrokeMap,
            "vec4f(map_uv(case_point(a, b, c, d)).a.uv, map_uv(case_point(a, b, c, d)).a.weight, \
             map_uv(case_point(a, b, c, d)).tiles_per_px)",
            smooth_point,
        )
        .quad_twin(|b, quad, lane| {
            let mapped = map_uv(b.material, &quad.map(point), lane);
            patterned(&mapped, 0).with_w(mapped.tiles_per_px)
        })
        .within(32.0 * U, 0.0),
        row(
            "frame_patterns",
            Pass::StrokeMap,
            "patterned(frame_patterns(a.xyz, d.xy, b.xyz, unpack_shares(face_frames[u32(d.z)].shares))[u32(d.w * 2.99)])",
            any_point,
        )
        .twin(|b, case| {
            let shares = unpack_shares(b.mesh.face_frames[case[3].z as usize].shares);
            let patterns = frame_patterns(b.material, case[0].truncate(), xy(case[3]), case[1].truncate(), shares);
            patterned(&Mapped { patterns, tiles_per_px: 0.0 }, (case[3].w * 2.99) as usize)
        })
        .except_where(|_, case| (case[3].w * 2.99).fract() < 1e-5)
        // As at map_uv.
        .within(64.0 * U, 0.0),
        row("frame_st", Pass::StrokeMap, "vec4f(frame_st(face_frames[u32(d.z)], a.xyz), 0.0, 0.0)", any_point)
            .twin(|b, case| two(frame_st(&b.mesh.face_frames[case[3].z as usize], case[0].truncate())))
            .within(16.0 * U, 0.0),
        row("map_frames", Pass::StrokeMap, "patterned(map_frames(framed_point(a, b, c, d)).a)", any_point)
            .twin(|b, case| patterned(&map_frames(b, &framed_point(b, case)), 0))
            .in_both_forms()
            .within(128.0 * U, 0.0),
        row("map_frames", Pass::StrokeMap, "patterned(map_frames(framed_point(a, b, c, d)).c)", any_point)
            .twin(|b, case| patterned(&map_frames(b, &framed_point(b, case)), 2))
            .in_both_forms()
            .within(128.0 * U, 0.0),
        // A cube of small numbers by logarithms that drivers have to 1e-5, over the sum of such.
        row("triplanar_weights", Pass::StrokeMap, "vec4f(triplanar_weights(b.xyz), 0.0)", any_point)
            .twin(|_, case| three(triplanar_weights(case[1].truncate())))
            .within(1e-4, 0.0),
        row("map_triplanar", Pass::StrokeMap, "patterned(map_triplanar(case_point(a, b, c, d)).a)", any_point)
            .twin(|b, case| patterned(&map_triplanar(b.options.form, b.scene, b.material, &point(case)), 0))
            .in_both_forms()
            .within(1e-4, 0.0),
        row("map_triplanar", Pass::StrokeMap, "patterned(map_triplanar(case_point(a, b, c, d)).b)", any_point)
            .twin(|b, case| patterned(&map_triplanar(b.options.form, b.scene, b.material, &point(case)), 1))
            .within(1e-4, 0.0),
        row("map_triplanar", Pass::StrokeMap, "patterned(map_triplanar(case_point(a, b, c, d)).c)", any_point)
            .twin(|b, case| patterned(&map_triplanar(b.options.form, b.scene, b.material, &point(case)), 2))
            .within(1e-4, 0.0),
        row(
            "map_surface",
            Pass::StrokeMap,
            "vec4f(map_surface(framed_point(a, b, c, d)).a.uv, map_surface(framed_point(a, b, c, \
             d)).a.weight, map_surface(framed_point(a, b, c, d)).tiles_per_px)",
            smooth_point,
        )
        .quad_twin(|b, quad, lane| {
            let mapped = map_surface(b, &quad.map(|case| framed_point(b, case)), lane);
            patterned(&mapped, 0).with_w(mapped.tiles_per_px)
        })
        .in_options(all_mappings())
        .within(1e-4, 0.0),
        row(
            "pattern_count",
            Pass::StrokeMap,
            "vec4f(f32(pattern_count(map_frames(framed_point(a, b, c, d)))), 0.0, 0.0, 0.0)",
            any_point,
        )
        .twin(|b, case| one(pattern_count(b.options.mapping, &map_frames(b, &framed_point(b, case))) as f64))
        .in_options(all_mappings())
        .within(1e-30, 0.0),
    ]
}

fn patterned(mapped: &Mapped, k: usize) -> DVec4 {
    let pattern = mapped.patterns[k];
    DVec4::new(pattern.uv.x, pattern.uv.y, pattern.weight, 0.0)
}

fn input(case: &Case, scale: f64) -> FragmentIn {
    let normal = case[1].truncate() * scale;
    let (p_world, uv) = (case[0].truncate(), xy(case[3]));
    FragmentIn { p_world, normal, uv, ..FragmentIn::default() }
}

/// A point with a normal of some length, or none; in one case of twenty at the camera.
fn fragments(draw: &Draw) -> Case {
    let mut case = any_point(draw);
    case[1].w = if draw.pick(OWN + 90, 20) == 0 { 0.0 } else { draw.scale(OWN + 91, 0.1, 3.0) };
    if draw.pick(OWN + 92, 20) == 0 {
        case[0] = DVec3::new(f64::from(0.7_f32), f64::from(0.9_f32), 4.0).extend(case[0].w);
    }
    case
}

/// Neighbouring places on the tile within a quad.
fn smooth_point(draw: &Draw) -> Case {
    let mut case = any_point(draw);
    let lane = draw.lane() as f64;
    let (x, y) = (lane % 2.0, (lane / 2.0).floor());
    let (right, down) = (draw.tile(10, 0.05), draw.tile(20, 0.05));
    let twist = DVec2::splat(draw.between(30, -0.01, 0.01));
    let uv = draw.tile(0, 2.0) + right * x + down * y + twist * x * y;
    (case[3].x, case[3].y) = (uv.x, uv.y);
    case
}
