//! Rows of `lines.wgsl`, `line_edges.wgsl` and `lib/edges.wgsl`.

use glam::{DVec3, DVec4};
use tam_shaders::Pass;
use tam_shaders::cpu::Bindings;
use tam_shaders::cpu::lib::edges::{end_world, faces_camera, line_kind};
use tam_shaders::cpu::line_edges::is_line;
use tam_shaders::cpu::lines::{line_coverage, pulled_clip, px_from_clip, ramp, share_below};

use super::{one, three, two, xy};
use crate::draw::{Case, Draw, OWN};
use crate::row::{Row, U, row};
use crate::setting::{FACES, Setting};

pub(crate) fn rows() -> Vec<Row> {
    // Settings are the same whenever they are made; bindings have no place for the style and the edges.
    let all = std::sync::Arc::new(Setting::all());
    let of = move |b: &Bindings<'_>| {
        let i = all.iter().position(|setting| setting.map == *b.map).expect("bindings are of a setting");
        let setting = &all[i];
        (setting.twin.style, setting.edges.clone())
    };
    let (style_of, listed_of) = (of.clone(), of.clone());
    vec![
        row("end_world", Pass::Lines, "vec4f(end_world(u32(a.x)), 0.0)", edges)
            .twin(|b, case| three(end_world(b.scene, &b.mesh, case[0].x as u32)))
            .within(16.0 * U, 0.0),
        row(
            "faces_camera",
            Pass::Lines,
            "vec4f(select(0.0, 1.0, faces_camera(u32(a.y), b.xyz)), 0.0, 0.0, 0.0)",
            edges,
        )
        .twin(|b, case| one(f64::from(faces_camera(b.scene, &b.mesh, case[0].y as u32, case[1].truncate()))))
        .except_where(|b, case| edge_on(b, case[0].y as usize, case))
        .within(1e-30, 0.0),
        row("line_kind", Pass::Lines, "vec4f(f32(line_kind(edges[u32(a.z)], b.xyz)), 0.0, 0.0, 0.0)", edges)
            .twin(move |b, case| {
                let (style, edges) = of(b);
                one(f64::from(
                    line_kind(b.scene, &b.mesh, &style, &edges[case[0].z as usize], case[1].truncate()) as u32
                ))
            })
            .except_where(|b, case| (0..FACES).any(|face| edge_on(b, face, case)))
            .within(1e-30, 0.0),
        row("is_line", Pass::LineEdges, "vec4f(select(0.0, 1.0, is_line(edges[u32(a.z)])), 0.0, 0.0, 0.0)", edges)
            .twin(move |b, case| {
                let (style, edges) = listed_of(b);
                one(f64::from(is_line(b.scene, &b.mesh, &style, &edges[case[0].z as usize])))
            })
            .within(1e-30, 0.0),
        // Two projections of points five units away, divided.
        row("pulled_clip", Pass::Lines, "pulled_clip(b.xyz)", edges)
            .twin(move |b, case| pulled_clip(b.scene, &style_of(b).0, case[1].truncate()))
            .within(128.0 * U, 0.0),
        // 600 pixels, over a w of 0.5 at least.
        row("px_from_clip", Pass::Lines, "vec4f(px_from_clip(c), 0.0, 0.0)", edges)
            .twin(|b, case| two(px_from_clip(b.scene, case[2])))
            .within(600.0 * 8.0 * U, 8.0 * U),
        // Places of tens of pixels, the root of a sum of squares of them.
        row("ramp", Pass::Lines, "vec4f(ramp(d.x), 0.0, 0.0, 0.0)", edges)
            .twin(|_, case| one(ramp(case[3].x)))
            .within(300.0 * U, 0.0),
        // Differences of squares of some pixels, over a hundredth at least.
        row("share_below", Pass::Lines, "vec4f(share_below(0.1 * d.x, normalize(d.zw + 0.01)), 0.0, 0.0, 0.0)", edges)
            .twin(|_, case| {
                let normal = (glam::DVec2::new(case[3].z, case[3].w) + 0.01).normalize();
                one(share_below(0.1 * case[3].x, normal))
            })
            .within(1e-3, 0.0),
        // Where a line ends rounding decides between its two forms.
        row("line_coverage", Pass::Lines, "vec4f(line_coverage(d.xy, d.zw, c.xy, b.w), 0.0, 0.0, 0.0)", edges)
            .twin(|_, case| {
                one(line_coverage(xy(case[3]), glam::DVec2::new(case[3].z, case[3].w), xy(case[2]), case[1].w))
            })
            .except_where(|_, case| {
                let (from, to) = (glam::DVec2::new(case[3].z, case[3].w), xy(case[2]));
                let along = (to - from).normalize_or(glam::DVec2::X);
                let at = (xy(case[3]) - from).dot(along);
                at.abs() < 1e-4 || (at - from.distance(to)).abs() < 1e-4
            })
            .within(1e-3, 0.0),
    ]
}

/// Whether rounding decides which side of a face is seen.
fn edge_on(b: &Bindings<'_>, face: usize, case: &Case) -> bool {
    b.mesh.face_normals[face].truncate().dot(b.scene.camera_world - case[1].truncate()).abs() < 32.0 * U
}

/// A vertex, a face and an edge; a place and a width; a clip place; a place and an end on the screen.
fn edges(draw: &Draw) -> Case {
    let numbers =
        DVec3::new(draw.pick(OWN, 48) as f64, draw.pick(OWN + 1, FACES) as f64, draw.pick(OWN + 2, FACES) as f64);
    let w = draw.between(OWN + 20, 0.5, 8.0);
    let clip = DVec4::new(draw.between(OWN + 21, -8.0, 8.0), draw.between(OWN + 22, -8.0, 8.0), 0.5, w);
    let screen = |slot| draw.tile(slot, 12.0);
    let (place, mut end) = (screen(OWN + 30), screen(OWN + 40));
    // A line without length, at times.
    if draw.pick(OWN + 50, 10) == 0 {
        end = xy(clip);
    }
    [
        three(numbers),
        draw.place_within(OWN + 10, 1.5).extend(draw.between(OWN + 13, 0.2, 6.0)),
        clip,
        DVec4::new(place.x, place.y, end.x, end.y),
    ]
}
