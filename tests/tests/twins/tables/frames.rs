//! Rows of the light-aligned frames: `lib/face_frame.wgsl`, `lib/corners.wgsl`, `lib/adjacency.wgsl` and the passes.

use glam::{DVec2, DVec3, DVec4};
use tam_shaders::Pass;
use tam_shaders::cpu::face_frame_vertex::Hatch;
use tam_shaders::cpu::lib::adjacency::{contributed_ink, contribution};
use tam_shaders::cpu::lib::columns::column_coordinate;
use tam_shaders::cpu::lib::corners::{area_vector, face_corners};
use tam_shaders::cpu::lib::face_frame::{
    Frame, complex_square, fixed_tangent, frame_hardened, frame_literal, half_angle, light_frame, pack_shares,
    unpack_shares,
};
use tam_shaders::cpu::lib::light::{darkness, to_light};
use tam_shaders::cpu::lib::mapping::frame_patterns;
use tam_shaders::cpu::lib::material::reflectance;
use tam_shaders::cpu::lib::mesh_types::FaceFrame;
use tam_shaders::cpu::lib::octahedral::oct_decode;
use tam_shaders::cpu::{Bindings, Form, Frames, Options, face_frame, face_frame_vertex, face_geometry};

use super::light::grazing;
use super::maps::SAMPLED;
use super::{any_point, one, point, three, two, xy};
use crate::draw::{Case, Draw, OWN};
use crate::row::{Row, U, row};
use crate::setting::FACES;

pub(crate) fn rows() -> Vec<Row> {
    let mut rows = frame_rows();
    rows.extend(face_rows());
    rows.extend(blend_rows());
    rows
}

fn frame_rows() -> Vec<Row> {
    vec![
        // The projection of an axis, 0.43 long at least.
        row("fixed_tangent", Pass::StrokeMap, "vec4f(fixed_tangent(a.xyz), 0.0)", directions)
            .twin(|_, case| three(fixed_tangent(case[0].truncate())))
            .within(16.0 * U, 0.0),
        row("complex_square", Pass::StrokeMap, "vec4f(complex_square(a.xy), 0.0, 0.0)", directions)
            .twin(|_, case| two(complex_square(xy(case[0]))))
            .within(4.0 * U, 0.0),
        // A square root of what is left of 1: off by the root of a round-off where it vanishes.
        row("half_angle", Pass::StrokeMap, "vec4f(half_angle(a.xy * c.x), 0.0, 0.0)", |draw| {
            let mut case = directions(draw);
            case[2] = one([0.0, 1e-3, 1.0][draw.pick(OWN + 40, 3)]);
            case
        })
        .twin(|_, case| two(half_angle(xy(case[0]) * case[2].x)))
        .within(2.0 * U.sqrt(), 0.0),
        // The projection of the light divided by its length, 0.02 at least.
        row("frame_literal", Pass::StrokeMap, "vec4f(frame_literal(a.xyz, b.xyz).bitangent, 0.0)", directions)
            .twin(|_, case| three(frame_literal(case[0].truncate(), case[1].truncate()).bitangent))
            .except_where(|_, case| case[0].truncate().cross(case[1].truncate()).length() < 0.02)
            .within(400.0 * U, 0.0),
        row("frame_literal", Pass::StrokeMap, "vec4f(frame_literal(a.xyz, b.xyz).tangent, 0.0)", directions)
            .twin(|_, case| three(frame_literal(case[0].truncate(), case[1].truncate()).tangent))
            .except_where(|_, case| case[0].truncate().cross(case[1].truncate()).length() < 0.02)
            .within(400.0 * U, 0.0),
        // The frame and its half turn are the same thing with their shares exchanged, and no matter where the fixed
        // frame has all: compared is what can be seen. Where the sine is 0.05, its square divides the round-offs of the
        // tensor, by 400, and the cubic of the shares is 10 steep.
        row(
            "frame_hardened",
            Pass::StrokeMap,
            "vec4f(frame_hardened(a.xyz, b.xyz).bitangent * (frame_hardened(a.xyz, b.xyz).shares.x - \
             frame_hardened(a.xyz, b.xyz).shares.y), frame_hardened(a.xyz, b.xyz).shares.z)",
            frame_inputs,
        )
        .twin(|b, case| {
            let frame = frame_hardened(b.scene, case[0].truncate(), case[1].truncate());
            (frame.bitangent * (frame.shares.x - frame.shares.y)).extend(frame.shares.z)
        })
        .except_where(spot_edge)
        .within(2e-3, 0.0),
        row(
            "frame_hardened",
            Pass::StrokeMap,
            "vec4f(frame_hardened(a.xyz, b.xyz).bitangent * frame_hardened(a.xyz, \
             b.xyz).bitangent.zxy * (1.0 - frame_hardened(a.xyz, b.xyz).shares.z), 0.0)",
            frame_inputs,
        )
        .twin(|b, case| {
            let Frame { bitangent, shares, .. } = frame_hardened(b.scene, case[0].truncate(), case[1].truncate());
            three(bitangent * DVec3::new(bitangent.z, bitangent.x, bitangent.y) * (1.0 - shares.z))
        })
        .except_where(spot_edge)
        .within(2e-3, 0.0),
        row("light_frame", Pass::StrokeMap, "vec4f(light_frame(a.xyz, b.xyz).bitangent, 0.0)", frame_inputs)
            .twin(|b, case| {
                three(light_frame(b.options.form, b.scene, case[0].truncate(), case[1].truncate()).bitangent)
            })
            .in_options([Options { form: Form::Literal, ..Options::default() }])
            // As at frame_literal; lights may be three units away.
            .except_where(|b, case| {
                let light = &b.scene.lights[0];
                let mut l = -(b.scene.mesh_from_world * light.direction.extend(0.0)).truncate();
                if light.kind != 0 {
                    l = (b.scene.mesh_from_world * light.position.extend(1.0)).truncate() - case[1].truncate();
                }
                case[0].truncate().cross(l).length() < 0.04 * l.length()
            })
            .within(400.0 * U, 0.0),
        // A step of ten bits, where rounding decides.
        row("pack_shares", Pass::StrokeMap, "vec4f(unpack_shares(pack_shares(c.xyz)), 0.0)", directions)
            .twin(|_, case| three(unpack_shares(pack_shares(case[2].truncate()))))
            .within(1.5 / 1023.0, 0.0),
        row(
            "unpack_shares",
            Pass::StrokeMap,
            "vec4f(unpack_shares(u32(d.x) | (u32(d.y) << 10u) | (u32(d.z) << 20u)), 0.0)",
            directions,
        )
        .twin(|_, case| {
            let [x, y, z] = case[3].truncate().to_array().map(|bits| bits as u32);
            three(unpack_shares(x | y << 10 | z << 20))
        })
        .within(4.0 * U, 0.0),
    ]
}

fn face_rows() -> Vec<Row> {
    vec![
        // A matrix times a point: three products and sums of numbers below 2.
        row("face_corners", Pass::FaceGeometry, "vec4f(face_corners(u32(a.x))[u32(a.y)], 0.0)", faces)
            .twin(|b, case| {
                let corners =
                    face_corners(b.options.form, b.scene, b.mesh.vertices, b.mesh.indices, case[0].x as usize);
                three(corners[case[0].y as usize])
            })
            .in_both_forms()
            .within(16.0 * U, 0.0),
        // Differences below 3, products below 9.
        row(
            "area_vector",
            Pass::FaceGeometry,
            "vec4f(area_vector(array<vec3f, 3>(a.xyz, b.xyz, c.xyz)), 0.0)",
            triangles,
        )
        .twin(|_, case| three(area_vector(&corners(case))))
        .within(64.0 * U, 0.0),
        // The areas are 0.01 of the products or more, or nothing.
        row(
            "face_normal",
            Pass::FaceGeometry,
            "face_normal(array<vec3f, 3>(a.xyz, b.xyz, c.xyz), area_vector(array<vec3f, 3>(a.xyz, \
             b.xyz, c.xyz)))",
            triangles,
        )
        .twin(|b, case| face_geometry::face_normal(b.options.form, &corners(case), area_vector(&corners(case))))
        .in_both_forms()
        .except_where(|b, case| {
            let area = area_vector(&corners(case)).length();
            area < 0.05 && (area > 0.0 || b.options.form == Form::Literal)
        })
        .within(4e3 * U, 0.0),
        // The area as above, squared below the line.
        row(
            "barycentric_planes",
            Pass::FaceGeometry,
            "barycentric_planes(array<vec3f, 3>(a.xyz, b.xyz, c.xyz), area_vector(array<vec3f, \
             3>(a.xyz, b.xyz, c.xyz)))[u32(d.x)]",
            triangles,
        )
        .twin(|_, case| {
            face_geometry::barycentric_planes(&corners(case), area_vector(&corners(case)))[case[3].x as usize]
        })
        .except_where(|_, case| area_vector(&corners(case)).length() < 0.1)
        .within(8e3 * U, 8e3 * U),
        row("lit_normal", Pass::FaceFrame, "vec4f(lit_normal(u32(a.x), a.y > 0.0), 0.0)", faces)
            .twin(|b, case| three(face_frame::lit_normal(b, case[0].x as usize, case[0].y > 0.0)))
            .in_both_forms()
            .within(8.0 * U, 0.0),
        row("corner_world", Pass::FaceFrameVertex, "vec4f(corner_world(u32(a.z)), 0.0)", faces)
            .twin(|b, case| three(face_frame_vertex::corner_world(b, case[0].z as u32)))
            .within(16.0 * U, 0.0),
        row(
            "hatch",
            Pass::FaceFrameVertex,
            "vec4f(hatch(u32(a.x), b.xyz).st, f32(hatch(u32(a.x), b.xyz).shares >> 8u), \
             f32(hatch(u32(a.x), b.xyz).normal_oct >> 8u))",
            faces,
        )
        .twin(|b, case| {
            let hatch = face_frame_vertex::hatch(b, case[0].x as usize, case[1].truncate());
            hatch.st.extend(f64::from(hatch.shares >> 8)).extend(f64::from(hatch.normal_oct >> 8))
        })
        .in_options([Options { frames: Frames::Fetched, ..Options::default() }])
        .within(16.0 * U, 0.0),
        row("hatch", Pass::FaceFrameVertex, "vec4f(oct_decode(hatch(u32(a.x), b.xyz).normal_oct), 0.0)", faces)
            .twin(|b, case| {
                three(oct_decode(face_frame_vertex::hatch(b, case[0].x as usize, case[1].truncate()).normal_oct))
            })
            .in_options([Frames::Here, Frames::Fetched].map(|frames| Options { frames, ..Options::default() }))
            // A step of the code.
            .within(1e-4, 0.0),
        // Either sign, see frame_hardened; where the light stands on the normal the direction is anyone's.
        row("hatch", Pass::FaceFrameVertex, "vec4f(abs(hatch(u32(a.x), b.xyz).st), 0.0, 0.0)", faces)
            .twin(|b, case| two(face_frame_vertex::hatch(b, case[0].x as usize, case[1].truncate()).st.abs()))
            .except_where(|b, case| {
                let face = case[0].x as usize;
                let corners: [DVec3; 3] =
                    std::array::from_fn(|k| face_frame_vertex::corner_world(b, b.mesh.indices[3 * face + k]));
                let n = area_vector(&corners).normalize_or_zero();
                n == DVec3::ZERO
                    || frame_hardened(b.scene, n, corners.into_iter().sum::<DVec3>() / 3.0).shares.z > 0.999
            })
            .within(2e-3, 0.0),
    ]
}

fn blend_rows() -> Vec<Row> {
    vec![
        row("contribution", Pass::FaceFrame, "vec4f(contribution(a.x, c.x), 0.0, 0.0, 0.0)", directions)
            .twin(|b, case| one(contribution(b.options.form, case[0].x, case[2].x)))
            .in_both_forms()
            .within(4.0 * U, 0.0),
        // Three samples at most, weights of the sum 1; a tone off by a power's error (see darkness) among 64 columns.
        row(
            "contributed_ink",
            Pass::FaceFrame,
            "vec4f(contributed_ink(case_point(a, b, c, d), b.xyz, frame_patterns(a.xyz, d.xy, \
             b.xyz, unpack_shares(face_frames[u32(d.z)].shares)), c.w), 0.0, 0.0, 0.0)",
            any_point,
        )
        .twin(|b, case| {
            let point = point(case);
            let shares = unpack_shares(b.mesh.face_frames[case[3].z as usize].shares);
            let patterns = frame_patterns(b.material, point.p_world, point.uv, point.normal, shares);
            one(contributed_ink(b, &point, point.normal, &patterns, case[2].w))
        })
        .in_both_forms()
        .except_where(|b, case| grazing(b, case) || between_columns(b, case, case[1].truncate()))
        .within(SAMPLED + 64.0 * 1e-4, 0.0),
        row(
            "face_ink",
            Pass::FaceFrame,
            "vec4f(face_ink(case_point(a, b, c, d), a.xyz, u32(d.z), d.w > 0.5, c.w), 0.0, 0.0, 0.0)",
            any_point,
        )
        .twin(|b, case| {
            let point = point(case);
            one(face_frame::face_ink(b, &point, point.p_world, case[3].z as usize, case[3].w > 0.5, case[2].w))
        })
        .in_both_forms()
        .except_where(|b, case| {
            let n = face_frame::lit_normal(b, case[3].z as usize, case[3].w > 0.5);
            grazing(b, &[case[0], n.extend(0.0), case[2], case[3]]) || between_columns(b, case, n)
        })
        .within(SAMPLED + 64.0 * 1e-4, 0.0),
        row(
            "hatch_ink",
            Pass::FaceFrameVertex,
            "vec4f(hatch_ink(case_point(a, b, c, d), Hatch(d.xy, face_frames[u32(d.z)].normal_oct, \
             face_frames[u32(d.z)].shares), c.w, d.w > 0.5), 0.0, 0.0, 0.0)",
            any_point,
        )
        .twin(|b, case| {
            let FaceFrame { normal_oct, shares, .. } = b.mesh.face_frames[case[3].z as usize];
            let hatch = Hatch { st: xy(case[3]), normal_oct, shares };
            one(face_frame_vertex::hatch_ink(b, &point(case), &hatch, case[2].w, case[3].w > 0.5))
        })
        .except_where(|b, case| {
            let n = oct_decode(b.mesh.face_frames[case[3].z as usize].normal_oct);
            let n = if case[3].w > 0.5 { n } else { -n };
            grazing(b, &[case[0], n.extend(0.0), case[2], case[3]])
        })
        .within(SAMPLED + 64.0 * 3e-4, 0.0),
    ]
}

/// Whether the literal form may round the column either way.
fn between_columns(b: &Bindings<'_>, case: &Case, n: DVec3) -> bool {
    let d = darkness(b.scene, reflectance(b.material), case[0].truncate(), n, case[2].truncate());
    let x = column_coordinate(b.options.form, b.material, d);
    b.options.form == Form::Literal && (x.fract() - 0.5).abs() < 1e-4 * f64::from(b.material.column_count)
}

/// Whether rounding decides on which side of a spot's edge the centre lies.
fn spot_edge(b: &Bindings<'_>, case: &Case) -> bool {
    b.scene.lights.iter().any(|light| {
        let l = to_light(light, case[1].truncate());
        light.kind == 2 && ((-l).dot(light.direction) - light.cos_cutoff).abs() < 8.0 * U
    })
}

/// Two directions, three numbers in 0..=1, three codes of ten bits.
fn directions(draw: &Draw) -> Case {
    [
        three(draw.direction(OWN)),
        three(draw.direction(OWN + 10)),
        three(DVec3::from([0, 1, 2].map(|i| draw.tone(OWN + 20 + 3 * i)))),
        three(DVec3::from([0, 1, 2].map(|i| draw.pick(OWN + 30 + i, 1024) as f64))),
    ]
}

/// A normal and the centre of a face.
fn frame_inputs(draw: &Draw) -> Case {
    [three(draw.direction(OWN)), three(draw.place_within(OWN + 10, 1.0)), DVec4::ZERO, DVec4::ZERO]
}

/// A face, a corner and a vertex; a place.
fn faces(draw: &Draw) -> Case {
    let numbers = DVec3::new(draw.pick(OWN, FACES) as f64, draw.pick(OWN + 1, 3) as f64, draw.pick(OWN + 2, 48) as f64);
    [three(numbers), three(draw.place_within(OWN + 10, 1.0)), DVec4::ZERO, DVec4::ZERO]
}

/// Three corners, two of which may be one; the number of a plane.
fn triangles(draw: &Draw) -> Case {
    let first = three(draw.place_within(OWN, 1.0));
    let second = three(draw.place_within(OWN + 10, 1.0));
    let third = if draw.pick(OWN + 25, 16) == 0 { first } else { three(draw.place_within(OWN + 20, 1.0)) };
    [first, second, third, two(DVec2::new(draw.pick(OWN + 30, 2) as f64, 0.0))]
}

fn corners(case: &Case) -> [DVec3; 3] {
    [case[0].truncate(), case[1].truncate(), case[2].truncate()]
}
