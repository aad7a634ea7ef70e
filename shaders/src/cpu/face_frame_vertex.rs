//! Twin of `face_frame_vertex.wgsl`: light-aligned frames per face with the work in the vertex stage. Suarez and
//! others, "GPU real time hatching", 2013, algorithms 1 to 3.

use glam::{DVec2, DVec3, DVec4};

use super::builtin::inverse_sqrt;
use super::lib::adjacency::contributed_ink;
use super::lib::columns::map_level;
use super::lib::face_frame::{frame_hardened, pack_shares, unpack_shares};
use super::lib::faced::{face_of, pulled_vertex};
use super::lib::mapping::{footprint, frame_patterns, frame_st};
use super::lib::mesh_types::{NO_FACE, NO_NORMAL};
use super::lib::octahedral::{oct_decode, oct_encode};
use super::lib::surface::{Point, VertexOut, drawn, surface_vertex};
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
    /// Normals of the four faces, as `FaceFrame` has them; the same at all corners, and not interpolated.
    pub normals_oct: [u32; 4],
    /// Shares of their frames, likewise.
    pub shares: [u32; 4],
}

/// A point in the frame of a face.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Hatch {
    /// Along the tangent and along the bitangent.
    pub st: DVec2,
    /// Normal of the face, or [`NO_NORMAL`] where it has no area.
    pub normal_oct: u32,
    /// Shares of the frame.
    pub shares: u32,
}

/// Place of a vertex in the world.
pub fn corner_world(b: &Bindings<'_>, index: u32) -> DVec3 {
    (b.scene.world_from_mesh * b.mesh.vertices[index as usize].position.extend(1.0)).truncate()
}

/// Hatching parameters of the point `p` for a face.
pub fn hatch(b: &Bindings<'_>, face: usize, p: DVec3) -> Hatch {
    if b.options.frames == Frames::Fetched {
        let frame = &b.mesh.face_frames[face];
        return Hatch { st: frame_st(frame, p), normal_oct: frame.normal_oct, shares: frame.shares };
    }
    let [v0, v1, v2] = std::array::from_fn(|k| corner_world(b, b.mesh.indices[3 * face + k]));
    let area = (v1 - v0).cross(v2 - v0);
    let n = area * inverse_sqrt(area.dot(area).max(1e-36));
    let frame = frame_hardened(b.scene, n, (v0 + v1 + v2) / 3.0);
    Hatch {
        st: DVec2::new(p.dot(frame.tangent), p.dot(frame.bitangent)),
        normal_oct: if area.dot(area) > 1e-36 { oct_encode(n) } else { NO_NORMAL },
        shares: pack_shares(frame.shares),
    }
}

/// A corner of a face on its way to the screen: three vertices per face, counted from the first face of the draw.
pub fn vertex(b: &Bindings<'_>, index: u32) -> HatchOut {
    let (face, corner) = (face_of(b.material, index) as usize, index as usize % 3);
    let VertexOut { clip, p_world, normal, .. } = surface_vertex(b.scene, &pulled_vertex(b, index), DVec2::ZERO);
    let own = hatch(b, face, p_world);
    let mut out = HatchOut { clip, p_world, normal, contributions: [-1.0; 3], ..HatchOut::default() };
    (out.st[0], out.normals_oct[0], out.shares[0]) = (own.st, own.normal_oct, own.shares);
    for k in 0..3 {
        let other = b.mesh.neighbours[3 * face + k];
        if other == NO_FACE {
            continue;
        }
        let theirs = hatch(b, other as usize, p_world);
        (out.st[k + 1], out.normals_oct[k + 1], out.shares[k + 1]) = (theirs.st, theirs.normal_oct, theirs.shares);
        if corner != (k + 2) % 3 && own.normal_oct != NO_NORMAL && theirs.normal_oct != NO_NORMAL {
            out.contributions[k] = oct_decode(own.normal_oct).dot(oct_decode(theirs.normal_oct));
        }
    }
    out
}

/// Ink of one face of the four.
pub fn hatch_ink(b: &Bindings<'_>, point: &Point, hatch: &Hatch, level: f64, front: bool) -> f64 {
    let n = oct_decode(hatch.normal_oct);
    let patterns = frame_patterns(b.material, point.p_world, hatch.st, n, unpack_shares(hatch.shares));
    contributed_ink(b, point, if front { n } else { -n }, &patterns, level)
}

/// Colour of a fragment, linear light; all but normals and shares interpolated.
pub fn fragment(b: &Bindings<'_>, input: &HatchOut, front: bool) -> DVec4 {
    let to_camera = b.scene.to_camera(input.p_world);
    let point = Point {
        p_world: input.p_world,
        normal: input.normal.normalize(),
        view: to_camera.normalize(),
        depth: -to_camera.dot(b.scene.camera_forward),
        uv: DVec2::ZERO,
        framing: [0; 2],
    };
    let hatch = |i: usize| Hatch { st: input.st[i], normal_oct: input.normals_oct[i], shares: input.shares[i] };
    let level = map_level(b.material, footprint(b.options.form, b.scene, b.material, &point));
    let mut sum = hatch_ink(b, &point, &hatch(0), level, front);
    let mut weight = 1.0;
    for k in 0..3 {
        let f = input.contributions[k].max(0.0);
        if f > 0.0 {
            sum += f * hatch_ink(b, &point, &hatch(k + 1), level, front);
            weight += f;
        }
    }
    drawn(b.scene, b.material, sum / weight)
}
