//! An open right hand, its palm to the viewer, with a stump of the forearm.

use std::sync::LazyLock;

use glam::{Mat3, Quat, Vec2, Vec3, vec2, vec3};

use super::super::RawMesh;
use super::nets::Solid;
use super::sdf::{bump, capsule, ellipsoid, intersect, round_cone, sphere, subtract, unite};
use super::solid;

/// Centimetres: the wrist's crease is at y = 0, the palm looks to +z, the thumb to +x.
const CENTRE: Vec3 = vec3(1.2, 6.0, 0.0);
const HALF_EXTENT: Vec3 = vec3(8.2, 14.0, 4.2);
/// The narrowest gaps, those between the fingers, are three times as wide.
const COARSEST_CELL: f32 = 0.17;

pub(super) fn hand(triangles: usize) -> RawMesh {
    let fingers = FINGERS.map(|shape| Finger::new(&shape));
    let distance = |p| distance(p + CENTRE, &fingers);
    solid::mesh(&Solid { distance: &distance, half_extent: HALF_EXTENT }, COARSEST_CELL, triangles)
}

/// One of the four fingers, as designed.
struct Shape {
    /// The knuckle in the palm.
    root: Vec3,
    /// Lean towards the thumb, radians.
    fan: f32,
    /// Bend towards the palm at the three joints, radians.
    bends: [f32; 3],
    lengths: [f32; 3],
    /// Half the breadth at the knuckle, the two joints and the tip.
    radii: [f32; 4],
}

const FINGERS: [Shape; 4] = [
    Shape {
        root: vec3(2.75, 8.5, -0.1),
        fan: 0.15,
        bends: [0.04, 0.12, 0.10],
        lengths: [4.6, 2.6, 1.75],
        radii: [1.05, 0.97, 0.88, 0.72],
    },
    Shape {
        root: vec3(0.75, 8.9, -0.2),
        fan: 0.025,
        bends: [0.02, 0.10, 0.10],
        lengths: [5.1, 3.0, 1.85],
        radii: [1.08, 0.99, 0.90, 0.74],
    },
    Shape {
        root: vec3(-1.2, 8.4, -0.2),
        fan: -0.085,
        bends: [0.05, 0.13, 0.10],
        lengths: [4.8, 2.8, 1.85],
        radii: [1.04, 0.95, 0.86, 0.71],
    },
    Shape {
        root: vec3(-2.95, 7.4, -0.2),
        fan: -0.24,
        bends: [0.09, 0.17, 0.12],
        lengths: [3.9, 2.1, 1.65],
        radii: [0.95, 0.83, 0.75, 0.61],
    },
];

/// A finger, placed.
struct Finger {
    tip: Vec3,
    root: Vec3,
    bones: [Bone; 3],
}

/// From a joint to the next, in a frame with y along it and z to the palm.
struct Bone {
    joint: Vec3,
    end: Vec3,
    bone_from_hand: Mat3,
    length: f32,
    /// Half the breadth at joint and end.
    thick: f32,
    thin: f32,
}

impl Finger {
    fn new(shape: &Shape) -> Self {
        let mut joint = shape.root;
        let mut bend = 0.0;
        let bones = std::array::from_fn(|k| {
            bend += shape.bends[k];
            let turn = Mat3::from_rotation_z(-shape.fan) * Mat3::from_rotation_x(bend);
            let end = joint + turn * (Vec3::Y * shape.lengths[k]);
            let bone = Bone {
                joint,
                end,
                bone_from_hand: turn.transpose(),
                length: shape.lengths[k],
                thick: shape.radii[k],
                thin: shape.radii[k + 1],
            };
            joint = end;
            bone
        });
        Self { tip: joint, root: shape.root, bones }
    }
}

fn distance(p: Vec3, fingers: &[Finger; 4]) -> f32 {
    let mut hand = palm(p);
    hand = unite(hand, thumb(p), 0.9);
    // Fingers meet the palm in one soft web, but hardly each other.
    let fingers = fingers.iter().map(|one| finger(p, one)).reduce(|a, b| unite(a, b, 0.25));
    hand = fingers.map_or(hand, |fingers| unite(hand, fingers, 0.55));
    unite(creased(hand, p), forearm(p), 2.2)
}

/// The three lines of the palm.
fn creased(hand: f32, p: Vec3) -> f32 {
    /// Centre and radius of each line's circle, and the range of its angle from +x, counter-clockwise, radians.
    const LINES: [(Vec2, f32, f32, f32); 3] =
        [(vec2(4.1, 2.4), 3.9, 1.75, 3.55), (vec2(1.2, 11.8), 5.6, 3.75, 4.75), (vec2(-0.2, 13.0), 5.0, 3.95, 4.95)];
    let side = smooth_step(p.z - 0.2);
    if side == 0.0 || p.y > 10.0 {
        return hand;
    }
    let depth = LINES.map(|(centre, radius, from, to)| {
        let arm = p.truncate() - centre;
        let depth = bump(arm.length() - radius, 0.28);
        if depth == 0.0 {
            return 0.0;
        }
        let angle = arm.to_angle().rem_euclid(std::f32::consts::TAU);
        depth * smooth_step((angle - from) / 0.25) * smooth_step((to - angle) / 0.25)
    });
    hand + 0.14 * side * depth[0].max(depth[1]).max(depth[2])
}

/// From 0 to 1 as `x` does, level at both ends.
fn smooth_step(x: f32) -> f32 {
    let x = x.clamp(0.0, 1.0);
    x * x * (3.0 - 2.0 * x)
}

fn finger(p: Vec3, finger: &Finger) -> f32 {
    // Far away the hull is enough: its error stays out of every blend.
    let rough = capsule(p, finger.root, finger.tip, 1.5);
    if rough > 1.2 {
        return rough;
    }
    let mut all = f32::INFINITY;
    for (k, bone) in finger.bones.iter().enumerate() {
        let Bone { thick, thin, length, .. } = *bone;
        let core = round_cone(p, bone.joint, bone.end, thick * 0.94, thin * 0.94);
        all = if k == 0 { core } else { unite(all, core, 0.3) };
        // A soft pad between the joints, on the side of the palm.
        let local = bone.bone_from_hand * (p - bone.joint.lerp(bone.end, 0.52));
        let width = (thick + thin) * 0.5;
        let pad = ellipsoid(local, vec3(0.0, 0.0, width * 0.30), vec3(width * 0.84, length * 0.44, width * 0.78));
        all = unite(all, pad, 0.35);
        let at = bone.bone_from_hand * (p - bone.end);
        if k < 2 {
            // The joint is a little broader, and its skin gathers on the back.
            all = unite(all, ellipsoid(at, vec3(0.0, 0.0, -0.10), thin * vec3(0.93, 1.3, 0.92)), 0.4);
            // Creases across the inner side.
            all += 0.09 * bump(at.y - 0.05, 0.22) * smooth_step(at.z / (0.6 * thin));
        } else {
            all = nail(all, at, thin);
        }
    }
    all
}

/// Sets a nail into the back of a finger's tip; `p` in the tip's frame, y to the tip, -z to the back.
fn nail(finger: f32, p: Vec3, radius: f32) -> f32 {
    let bed = ellipsoid(p, vec3(0.0, -0.30 * radius, -radius * 1.22), radius * vec3(0.72, 0.85, 0.50));
    let plate = ellipsoid(p, vec3(0.0, -0.15 * radius, -radius * 0.42), radius * vec3(0.62, 0.95, 0.50));
    unite(subtract(finger, bed, 0.08), plate, 0.05)
}

fn palm(p: Vec3) -> f32 {
    // As for the fingers: too far for any blend.
    let rough = capsule(p, vec3(0.0, 2.2, 0.0), vec3(0.0, 6.8, 0.0), 5.4);
    if rough > 3.0 {
        return rough;
    }
    let mut palm = f32::INFINITY;
    let wrist = [1.25, 0.4, -0.5, -1.35];
    for (digit, x) in FINGERS.iter().zip(wrist) {
        let bone = round_cone(p, vec3(x, -0.3, -0.15), digit.root, 1.2, digit.radii[0] * 1.06);
        palm = if palm.is_finite() { unite(palm, bone, 1.5) } else { bone };
        // Knuckles on the back.
        palm = unite(palm, sphere(p, digit.root + vec3(0.0, -0.1, -0.34), digit.radii[0] * 0.84), 0.6);
        // The pad below each finger.
        palm = unite(palm, sphere(p, digit.root + vec3(0.0, 0.1, 0.36), digit.radii[0] * 0.84), 1.1);
    }
    let ball_of_little = turned_ellipsoid(p, vec3(-2.1, 3.2, 0.55), LITTLE_LEAN, vec3(1.45, 3.1, 1.35));
    palm = unite(palm, ball_of_little, 0.9);
    let ball_of_thumb = turned_ellipsoid(p, vec3(2.35, 3.1, 0.95), THUMB_LEAN, vec3(1.6, 2.9, 1.5));
    palm = unite(palm, ball_of_thumb, 0.8);
    let hollow = ellipsoid(p, vec3(0.1, 5.4, 2.35), vec3(1.5, 2.3, 1.2));
    subtract(palm, hollow, 0.9)
}

/// Directions of long axes in the plane of the palm, of length 1 to three digits.
const LITTLE_LEAN: Vec2 = vec2(-0.218, 0.976);
const THUMB_LEAN: Vec2 = vec2(0.523, 0.853);
const WEB_LEAN: Vec2 = vec2(0.479, 0.878);

/// To an ellipsoid whose y axis is turned to `lean` about z.
fn turned_ellipsoid(p: Vec3, centre: Vec3, lean: Vec2, radii: Vec3) -> f32 {
    let q = p - centre;
    let flat = q.truncate();
    ellipsoid(vec3(flat.dot(vec2(lean.y, -lean.x)), flat.dot(lean), q.z), Vec3::ZERO, radii)
}

const THUMB_JOINTS: [Vec3; 4] = [vec3(1.9, 1.6, 0.5), vec3(4.35, 4.7, 1.0), vec3(6.0, 7.0, 1.05), vec3(7.0, 8.75, 0.8)];

/// The thumb is seen from its side: its pad looks towards the fingers, its nail away from them.
static TIP_FROM_HAND: LazyLock<Mat3> = LazyLock::new(|| {
    let along = (THUMB_JOINTS[3] - THUMB_JOINTS[2]).normalize();
    (Mat3::from_quat(Quat::from_rotation_arc(Vec3::Y, along)) * Mat3::from_rotation_y(-0.95)).transpose()
});

fn thumb(p: Vec3) -> f32 {
    const JOINTS: [Vec3; 4] = THUMB_JOINTS;
    let rough = capsule(p, JOINTS[0], JOINTS[3], 2.2);
    if rough > 2.0 {
        return rough;
    }
    let mut thumb = round_cone(p, JOINTS[0], JOINTS[1], 1.5, 1.15);
    thumb = unite(thumb, round_cone(p, JOINTS[1], JOINTS[2], 1.13, 0.98), 0.4);
    thumb = unite(thumb, round_cone(p, JOINTS[2], JOINTS[3], 0.98, 0.76), 0.3);
    thumb = unite(thumb, sphere(p, JOINTS[1] + vec3(0.15, -0.1, -0.1), 1.16), 0.6);
    thumb = unite(thumb, sphere(p, JOINTS[2] + vec3(0.1, 0.0, -0.05), 1.0), 0.5);
    let pad = *TIP_FROM_HAND * (p - JOINTS[2].lerp(JOINTS[3], 0.55));
    thumb = unite(thumb, ellipsoid(pad, vec3(0.0, 0.0, 0.3), vec3(0.85, 1.2, 0.78)), 0.4);
    thumb = nail(thumb, *TIP_FROM_HAND * (p - JOINTS[3]), 0.78);
    // Skin from the thumb to the index finger.
    unite(thumb, turned_ellipsoid(p, vec3(3.3, 5.6, 0.1), WEB_LEAN, vec3(1.3, 1.5, 0.62)), 0.8)
}

fn forearm(p: Vec3) -> f32 {
    // Flatter than broad, wider towards the elbow.
    let q = p * vec3(0.78, 1.0, 1.12);
    let arm = round_cone(q, vec3(-0.1, 1.0, -0.1), vec3(-0.1, -12.0, -0.1), 2.05, 2.95);
    let ulna = sphere(p, vec3(-2.1, -1.5, -1.0), 0.7);
    intersect(unite(arm, ulna, 0.9), -6.2 - p.y, 0.9)
}
