//! Twin of `face_frame.wgsl`: light-aligned frames per face, blended with the neighbours'. Suarez and others, "GPU real
//! time hatching", 2013, algorithms 1 to 3.

use glam::{DVec3, DVec4};

use super::lib::adjacency::{contributed_ink, contribution};
use super::lib::columns::map_level;
use super::lib::face_frame::unpack_shares;
use super::lib::mapping::{footprint, frame_patterns, frame_place, frame_st};
use super::lib::mesh_types::NO_FACE;
use super::lib::surface::{FragmentIn, Point, drawn, surface_point};
use super::{Bindings, Form};

/// Normal of a face in the world, towards the side that is seen.
pub fn lit_normal(b: &Bindings<'_>, face: usize, front: bool) -> DVec3 {
    let mut n = b.mesh.face_normals[face].truncate();
    if b.options.form == Form::Literal {
        n = (b.scene.world_from_mesh_normal * n.extend(0.0)).truncate().normalize();
    }
    if front { n } else { -n }
}

/// Ink of one face of the four at the place `p` in the space of the frames.
pub fn face_ink(b: &Bindings<'_>, point: &Point, p: DVec3, face: usize, front: bool, level: f64) -> f64 {
    let n = b.mesh.face_normals[face].truncate();
    let frame = &b.mesh.face_frames[face];
    let patterns = frame_patterns(b.material, p, frame_st(frame, p), n, unpack_shares(frame.shares));
    contributed_ink(b, point, lit_normal(b, face, front), &patterns, level)
}

/// Colour of a fragment, linear light.
pub fn fragment(b: &Bindings<'_>, input: &FragmentIn, front: bool) -> DVec4 {
    let form = b.options.form;
    let point = surface_point(b.scene, input, front);
    let p = frame_place(form, b.scene, point.p_world);
    let face = input.face as usize;
    let level = map_level(b.material, footprint(form, b.scene, b.material, &point));
    let own = b.mesh.face_normals[face];
    let plane = |k: usize| b.mesh.face_planes[2 * face + k].truncate().dot(p) + b.mesh.face_planes[2 * face + k].w;
    let (first, second) = (plane(0), plane(1));
    let opposite = [1.0 - first - second, first, second];
    let mut faces = vec![(face, 1.0)];
    for (k, opposite) in opposite.into_iter().enumerate() {
        let other = b.mesh.neighbours[3 * face + k];
        let mut f = 0.0;
        if other != NO_FACE {
            let theirs = b.mesh.face_normals[other as usize];
            f = contribution(form, own.truncate().dot(theirs.truncate()), opposite);
            if form == Form::Hardened && own.w * theirs.w <= 0.0 {
                f = 0.0;
            }
        } else if form == Form::Literal {
            // A triangle without area has no normal: 0 / 0.
            f = contribution(form, own.truncate().dot((own.truncate() * 0.0).normalize()), opposite);
        }
        if form == Form::Literal || f > 0.0 {
            faces.push((if other == NO_FACE { face } else { other as usize }, f));
        }
    }
    let (mut sum, mut weight) = (0.0, 0.0);
    for (face, f) in faces {
        sum += f * face_ink(b, &point, p, face, front, level);
        weight += f;
    }
    drawn(b.scene, b.material, sum / weight)
}
