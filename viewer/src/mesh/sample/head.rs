//! A human head on its neck.

use std::sync::LazyLock;

use glam::{Mat3, Vec2, Vec3, vec2, vec3};

use super::super::RawMesh;
use super::nets::Solid;
use super::sdf::{capsule, ellipsoid, intersect, round_cone, sphere, subtract, unite};
use super::solid;

/// Centimetres: the eyes are at y = 0, the face looks to +z.
const CENTRE: Vec3 = vec3(0.0, -3.0, 0.0);
const HALF_EXTENT: Vec3 = vec3(10.0, 15.5, 13.0);
const COARSEST_CELL: f32 = 0.2;

pub(super) fn head(triangles: usize) -> RawMesh {
    let solid = Solid { distance: &|p| distance(p + CENTRE), half_extent: HALF_EXTENT };
    solid::mesh(&solid, COARSEST_CELL, triangles)
}

/// Stands off the head, and leans back.
static EAR_FROM_HEAD: LazyLock<Mat3> =
    LazyLock::new(|| (Mat3::from_rotation_y(0.45) * Mat3::from_rotation_x(-0.2)).transpose());

fn distance(p: Vec3) -> f32 {
    // One half is modelled; the middle plane mirrors it.
    let p = vec3(p.x.abs(), p.y, p.z);
    let mut head = skull(p);
    head = unite(head, neck(p), 1.4);
    head = face(head, p);
    head = nose(head, p);
    head = mouth(head, p);
    head = eye(head, p);
    ear(head, p)
}

fn skull(p: Vec3) -> f32 {
    let cranium = ellipsoid(p, vec3(0.0, 3.2, -1.3), vec3(7.4, 8.3, 9.3));
    let forehead = ellipsoid(p, vec3(0.0, 3.9, 2.3), vec3(6.4, 6.2, 6.3));
    let mut head = unite(cranium, forehead, 2.0);
    // The face's mass between cheekbones and jaw.
    let mass = ellipsoid(p, vec3(0.0, -3.6, 2.3), vec3(6.1, 7.3, 6.4));
    head = unite(head, mass, 2.0);
    let cheek = ellipsoid(p, vec3(3.2, -5.6, 4.4), vec3(2.5, 3.2, 3.0));
    head = unite(head, cheek, 1.8);
    let jaw = round_cone(p, vec3(4.7, -5.9, -0.2), vec3(1.2, -9.7, 6.3), 1.6, 1.6);
    let ramus = round_cone(p, vec3(5.5, -0.5, -0.4), vec3(4.7, -5.9, -0.2), 1.5, 1.6);
    head = unite(head, unite(jaw, ramus, 1.2), 2.0);
    // Floor of the mouth.
    let floor = round_cone(p, vec3(0.0, -8.6, 4.6), vec3(0.0, -10.2, -0.5), 2.0, 3.2);
    unite(head, floor, 1.6)
}

fn face(mut head: f32, p: Vec3) -> f32 {
    // Temples are flat.
    head = subtract(head, ellipsoid(p, vec3(9.6, 2.0, 4.6), vec3(2.6, 3.2, 3.4)), 1.8);
    let cheekbone = round_cone(p, vec3(4.2, -2.9, 5.6), vec3(6.2, -1.4, 0.8), 1.2, 0.7);
    head = unite(head, cheekbone, 2.0);
    let inner_brow = round_cone(p, vec3(0.9, 1.35, 8.1), vec3(3.2, 2.0, 7.55), 0.7, 0.75);
    let outer_brow = round_cone(p, vec3(3.2, 2.0, 7.55), vec3(5.5, 1.0, 5.4), 0.75, 0.65);
    head = unite(head, unite(inner_brow, outer_brow, 0.6), 1.3);
    // Sockets, deepest beside the nose.
    head = subtract(head, ellipsoid(p, vec3(2.9, -0.35, 8.9), vec3(2.0, 1.35, 2.0)), 1.3);
    let chin = ellipsoid(p, vec3(0.0, -10.3, 7.2), vec3(1.7, 1.25, 1.2));
    unite(head, chin, 1.4)
}

fn nose(mut head: f32, p: Vec3) -> f32 {
    if p.distance(vec3(0.0, -2.5, 9.5)) > 7.0 {
        return head;
    }
    let bridge = round_cone(p, vec3(0.0, 1.0, 8.0), vec3(0.0, -3.2, 10.25), 0.62, 0.72);
    let flank = round_cone(p, vec3(0.35, 0.3, 7.3), vec3(0.75, -4.0, 8.95), 0.75, 1.0);
    head = unite(head, flank, 1.6);
    head = unite(head, bridge, 1.0);
    let tip = ellipsoid(p, vec3(0.0, -3.95, 10.65), vec3(0.98, 0.88, 0.95));
    head = unite(head, tip, 0.5);
    let wing = ellipsoid(p, vec3(1.25, -4.45, 9.35), vec3(0.72, 0.78, 1.05));
    head = unite(head, wing, 0.45);
    let septum = capsule(p, vec3(0.0, -4.6, 10.4), vec3(0.0, -5.0, 9.0), 0.4);
    head = unite(head, septum, 0.35);
    let nostril = capsule(p, vec3(0.62, -5.25, 10.0), vec3(0.85, -5.15, 9.2), 0.3);
    subtract(head, nostril, 0.3)
}

fn mouth(mut head: f32, p: Vec3) -> f32 {
    if p.distance(vec3(0.0, -7.0, 8.5)) > 6.0 {
        return head;
    }
    let muzzle = ellipsoid(p, vec3(0.0, -6.9, 5.9), vec3(3.2, 2.3, 2.9));
    head = unite(head, muzzle, 1.2);
    let bow = round_cone(p, vec3(0.0, -6.95, 8.75), vec3(0.6, -6.75, 8.7), 0.45, 0.5);
    let upper = round_cone(p, vec3(0.6, -6.75, 8.7), vec3(2.35, -7.2, 7.35), 0.5, 0.25);
    head = unite(head, unite(bow, upper, 0.2), 0.45);
    let lower = round_cone(p, vec3(0.35, -7.82, 8.5), vec3(1.95, -7.45, 7.4), 0.62, 0.3);
    head = unite(head, lower, 0.5);
    let line = capsule(p, vec3(0.0, -7.3, 9.3), vec3(0.8, -7.2, 9.1), 0.16).min(round_cone(
        p,
        vec3(0.8, -7.2, 9.1),
        vec3(2.55, -7.3, 7.75),
        0.16,
        0.08,
    ));
    head = subtract(head, line, 0.45);
    let philtrum = capsule(p, vec3(0.0, -5.6, 9.35), vec3(0.0, -6.4, 9.45), 0.25);
    head = subtract(head, philtrum, 0.5);
    let fold = ellipsoid(p, vec3(0.0, -8.85, 9.3), vec3(1.6, 0.5, 0.9));
    subtract(head, fold, 0.8)
}

fn eye(head: f32, p: Vec3) -> f32 {
    const BALL: Vec3 = vec3(3.1, -0.3, 6.2);
    const RADIUS: f32 = 1.5;
    let q = p - BALL;
    if q.length() > 4.5 {
        return head;
    }
    let ball = ellipsoid(q, Vec3::ZERO, RADIUS * vec3(1.12, 1.0, 1.0));
    let lids = q.length() - (RADIUS + 0.36);
    let lidded = unite(head, lids, 0.5);
    // The opening is where two cylinders overlap: an almond whose outer corner is higher.
    let tilt = Vec2::from_angle(-0.09).rotate(q.truncate());
    let upper = tilt.distance(vec2(0.0, -0.95)) - 1.6;
    let lower = tilt.distance(vec2(0.0, 1.6)) - 2.1;
    let opening = intersect(intersect(upper, lower, 0.1), -q.z, 0.1);
    let open = subtract(lidded, opening, 0.2);
    // The fold above the upper lid.
    let fold = (tilt.distance(vec2(0.0, -0.95)) - 2.15).hypot(q.length() - RADIUS - 0.5)
        - 0.16 * (tilt.y * 1.5).clamp(0.0, 1.0) * (2.0 * tilt.x + 3.0).clamp(0.0, 1.0)
        + (1.0 - q.z).max(0.0);
    unite(subtract(open, fold, 0.3), ball, 0.06)
}

fn ear(head: f32, p: Vec3) -> f32 {
    const PLACE: Vec3 = vec3(7.0, -1.4, -1.6);
    if p.distance(PLACE) > 6.0 {
        return head;
    }
    // In the ear's frame x points away from the head, y up along it, z to the face.
    let q = *EAR_FROM_HEAD * (p - PLACE);
    let mut shell = ellipsoid(q, vec3(0.2, 0.5, -0.3), vec3(0.55, 2.9, 1.75));
    let around = {
        // Helix: a ring about an ellipse, open towards the face.
        let flat = vec2((q.z + 0.3) / 1.6, (q.y - 0.75) / 2.5);
        let nearest = flat.normalize_or(Vec2::Y);
        let ring = vec3(0.55, 0.75 + nearest.y * 2.5, -0.3 + nearest.x * 1.6);
        q.distance(ring) - 0.4
    };
    shell = unite(shell, around, 0.3);
    let concha = ellipsoid(q, vec3(0.95, -0.2, 0.0), vec3(0.75, 1.35, 0.95));
    shell = subtract(shell, concha, 0.3);
    let lobe = ellipsoid(q, vec3(0.3, -2.3, 0.1), vec3(0.5, 0.95, 0.8));
    shell = unite(shell, lobe, 0.4);
    let tragus = sphere(q, vec3(0.35, -0.55, 1.15), 0.5);
    // The root behind it leaves no slit.
    let root = ellipsoid(q, vec3(-0.9, -0.4, 0.2), vec3(1.2, 2.3, 1.1));
    shell = unite(unite(shell, tragus, 0.3), root, 0.5);
    unite(head, shell, 0.6)
}

fn neck(p: Vec3) -> f32 {
    let column = round_cone(p, vec3(0.0, -5.0, -2.2), vec3(0.0, -20.0, -3.8), 4.7, 5.6);
    let muscle = round_cone(p, vec3(5.0, -4.0, -2.8), vec3(1.5, -17.5, 1.6), 1.0, 0.9);
    let larynx = ellipsoid(p, vec3(0.0, -12.8, 2.0), vec3(1.0, 1.5, 1.2));
    let nape = round_cone(p, vec3(0.0, -4.0, -4.9), vec3(0.0, -20.0, -5.4), 3.3, 4.6);
    let neck = unite(unite(unite(column, muscle, 1.3), larynx, 1.6), nape, 2.0);
    intersect(neck, -17.5 - p.y, 1.2)
}
