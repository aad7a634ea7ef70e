//! Twin of `face_frame_vertex.wgsl`: light-aligned frames per face with the work in the vertex stage. Suarez and
//! others, "GPU real time hatching", 2013, algorithms 1 to 3.

use glam::{DVec2, DVec3, DVec4};

use super::builtin::inverse_sqrt;
use super::lib::columns::{column_coordinate, column_ink, map_level};
use super::lib::face_frame::frame_hardened;
use super::lib::light::darkness;
use super::lib::mapping::footprint;
use super::lib::material::{reflectance, tile_uv};
use super::lib::mesh_types::NO_FACE;
use super::lib::octahedral::{oct_decode, oct_encode};
use super::lib::surface::{Point, drawn};
use super::{Bindings, Frames};

/// What the vertex stage hands on.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct HatchOut {
    /// Clip coordinates.
    pub clip: DVec4,
    /// Place in the world.
    pub p_world: DVec3,
    /// Smooth normal in the world, not unit.
    pub normal: DVec3,
    /// (s, t) in the frame of the face and of its three neighbours.
    pub st: [DVec2; 4],
    /// Contributions of the neighbours, before they are clamped.
    pub contributions: [f64; 3],
    /// Normals of the four faces; the same at all corners, and not interpolated.
    pub normals_oct: [u32; 4],
}

/// A point in the frame of a face.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Hatch {
    /// Along the tangent and along the bitangent.
    pub st: DVec2,
    /// Normal of the face; w is 0 where it has no area.
    pub normal: DVec4,
}

/// Place of a vertex in the world.
pub fn corner_world(b: &Bindings<'_>, index: u32) -> DVec3 {
    (b.scene.world_from_mesh * b.mesh.vertices[index as usize].position.extend(1.0)).truncate()
}

/// Hatching parameters of the point `p` for a face.
pub fn hatch(b: &Bindings<'_>, face: usize, p: DVec3) -> Hatch {
    if b.options.frames == Frames::Fetched {
        let frame = &b.mesh.face_frames[face];
        return Hatch {
            st: DVec2::new(p.dot(frame.tangent), p.dot(frame.bitangent)),
            normal: b.mesh.face_normals[face],
        };
    }
    let [v0, v1, v2] = std::array::from_fn(|k| corner_world(b, b.mesh.indices[3 * face + k]));
    let area = (v1 - v0).cross(v2 - v0);
    let n = area * inverse_sqrt(area.dot(area).max(1e-36));
    let frame = frame_hardened(b.scene, n, (v0 + v1 + v2) / 3.0);
    let valid = if area.dot(area) > 1e-36 { 1.0 } else { 0.0 };
    Hatch { st: DVec2::new(p.dot(frame.tangent), p.dot(frame.bitangent)), normal: n.extend(valid) }
}

/// A corner of a face on its way to the screen: three vertices per face, counted from the first face of the draw.
pub fn vertex(b: &Bindings<'_>, index: u32) -> HatchOut {
    let face = (index / 3 + b.material.first_face) as usize;
    let corner = index as usize % 3;
    let vertex = b.mesh.vertices[b.mesh.indices[3 * face + corner] as usize];
    let p = b.scene.world_from_mesh * vertex.position.extend(1.0);
    let own = hatch(b, face, p.truncate());
    let mut out = HatchOut {
        clip: b.scene.clip_from_world * p,
        p_world: p.truncate(),
        normal: (b.scene.world_from_mesh_normal * oct_decode(vertex.normal_oct).extend(0.0)).truncate(),
        contributions: [-1.0; 3],
        ..HatchOut::default()
    };
    out.normals_oct[0] = oct_encode(own.normal.truncate());
    out.st[0] = own.st;
    for k in 0..3 {
        let other = b.mesh.neighbours[3 * face + k];
        if other == NO_FACE {
            continue;
        }
        let theirs = hatch(b, other as usize, p.truncate());
        out.st[k + 1] = theirs.st;
        out.normals_oct[k + 1] = oct_encode(theirs.normal.truncate());
        if corner != (k + 2) % 3 && theirs.normal.w > 0.0 {
            out.contributions[k] = own.normal.truncate().dot(theirs.normal.truncate());
        }
    }
    out
}

/// Ink of one face of the four.
pub fn hatch_ink(b: &Bindings<'_>, point: &Point, normal_oct: u32, st: DVec2, level: f64, front: bool) -> f64 {
    let n = oct_decode(normal_oct);
    let d = darkness(b.scene, reflectance(b.material), point.p_world, if front { n } else { -n }, point.view);
    let x = column_coordinate(b.options.form, b.material, d);
    column_ink(b.material, b.map, tile_uv(b.material, st), level, x)
}

/// Colour of a fragment, linear light; all but `normals_oct` interpolated.
pub fn fragment(b: &Bindings<'_>, input: &HatchOut, front: bool) -> DVec4 {
    let to_camera = b.scene.to_camera(input.p_world);
    let point = Point {
        p_world: input.p_world,
        normal: input.normal.normalize(),
        view: to_camera.normalize(),
        depth: -to_camera.dot(b.scene.camera_forward),
        uv: DVec2::ZERO,
        face: 0,
    };
    let level = map_level(b.material, footprint(b.options.form, b.scene, b.material, &point));
    let mut sum = hatch_ink(b, &point, input.normals_oct[0], input.st[0], level, front);
    let mut weight = 1.0;
    for k in 0..3 {
        let f = input.contributions[k].max(0.0);
        if f > 0.0 {
            sum += f * hatch_ink(b, &point, input.normals_oct[k + 1], input.st[k + 1], level, front);
            weight += f;
        }
    }
    drawn(b.scene, b.material, sum / weight)
}
