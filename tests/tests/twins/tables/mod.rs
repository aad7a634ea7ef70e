//! The rows, by what they are about, with the reason of each tolerance beside it.

mod debug;
mod directions;
mod frames;
mod light;
mod lines;
mod maps;
mod patches;
mod stripes;
mod strokes;
mod surface;

use glam::{DVec2, DVec3, DVec4};
use tam_shaders::cpu::Bindings;
use tam_shaders::cpu::lib::mesh_types::Vertex;
use tam_shaders::cpu::lib::octahedral::oct_encode;
use tam_shaders::cpu::lib::surface::Point;

use crate::draw::{Case, Draw, OWN};
use crate::row::Row;

/// All rows.
pub(crate) fn all() -> Vec<Row> {
    let tables = [light::rows(), maps::rows(), patches::rows(), stripes::rows(), frames::rows(), surface::rows()];
    tables
        .into_iter()
        .flatten()
        .chain(lines::rows())
        .chain(strokes::rows())
        .chain(debug::rows())
        .chain(directions::rows())
        .collect()
}

/// A surface point: place and depth, normal, view, uv and face.
pub(crate) fn any_point(draw: &Draw) -> Case {
    let place = draw.place_within(OWN, 1.5).extend(draw.between(OWN + 3, 1.0, 6.0));
    let uv = draw.tile(OWN + 30, 2.0);
    let face = draw.pick(OWN + 32, crate::setting::FACES) as f64;
    [
        place,
        draw.direction(OWN + 10).extend(draw.tone(OWN + 14)),
        draw.direction(OWN + 20).extend(draw.between(OWN + 24, 0.0, 2.0)),
        DVec4::new(uv.x, uv.y, face, draw.tone(OWN + 40)),
    ]
}

/// The point of [`any_point`].
pub(crate) fn point(case: &Case) -> Point {
    Point {
        p_world: case[0].truncate(),
        normal: case[1].truncate(),
        view: case[2].truncate(),
        depth: case[0].w,
        uv: xy(case[3]),
        framing: [0; 2],
    }
}

/// The same with the frame of its face.
pub(crate) fn framed_point(b: &Bindings<'_>, case: &Case) -> Point {
    let frame = &b.mesh.face_frames[case[3].z as usize];
    Point { framing: [frame.shares, frame.normal_oct], ..point(case) }
}

/// A vertex at the place of [`any_point`], with its normal.
pub(crate) fn vertex_of(case: &Case) -> Vertex {
    Vertex { position: case[0].truncate(), normal_oct: oct_encode(case[1].truncate()) }
}

/// The first two components.
pub(crate) fn xy(v: DVec4) -> DVec2 {
    v.truncate().truncate()
}

/// Three components and 0.
pub(crate) fn three(v: DVec3) -> DVec4 {
    v.extend(0.0)
}

/// Two components and zeros.
pub(crate) fn two(v: DVec2) -> DVec4 {
    v.extend(0.0).extend(0.0)
}

/// One component and zeros.
pub(crate) fn one(x: f64) -> DVec4 {
    DVec4::new(x, 0.0, 0.0, 0.0)
}
