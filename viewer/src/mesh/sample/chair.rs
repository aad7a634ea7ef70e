//! A wooden chair of separate, rounded parts, each closed and with a colour of its own.

use glam::{Affine3A, Quat, Vec2, Vec3, vec2, vec3};

use super::super::RawMesh;
use super::place_in_box;
use super::rounded_box::RoundedBox;
use super::sheet::{add_part, density_for};
use super::turned::Turned;

const OAK: [f32; 3] = [0.50, 0.27, 0.11];
const DARK_OAK: [f32; 3] = [0.32, 0.15, 0.055];
const WALNUT: [f32; 3] = [0.20, 0.085, 0.035];

/// Top and bottom of each leg, (x, y, z); mirrored for the other side.
const FRONT_LEG: [Vec3; 2] = [vec3(0.36, -0.02, 0.32), vec3(0.44, -1.0, 0.41)];
const BACK_LEG: [Vec3; 2] = [vec3(0.31, -0.02, -0.30), vec3(0.38, -1.0, -0.46)];
const POST: [Vec3; 2] = [vec3(0.34, 0.0, -0.36), vec3(0.40, 1.08, -0.58)];

enum Shape {
    Turned(Turned, Affine3A),
    Box(RoundedBox),
}

struct Piece {
    name: String,
    colour: [f32; 3],
    shape: Shape,
}

/// The chair: seat, four turned legs with three stretchers, two back posts with three slats. u runs around each rod and
/// around each board, v along it; boards' end faces and the rods' lines at +z are seams. At least 900 triangles.
pub(super) fn chair(triangles: usize) -> RawMesh {
    let pieces = pieces();
    let density = density_for(triangles, |density| {
        pieces
            .iter()
            .map(|piece| match &piece.shape {
                Shape::Turned(turned, _) => turned.sheet(density).triangles(),
                Shape::Box(board) => board.triangles(density),
            })
            .sum()
    });
    let mut mesh = RawMesh::default();
    for piece in &pieces {
        add_part(&mut mesh, &piece.name, Some(piece.colour), |mesh| match &piece.shape {
            Shape::Turned(turned, place) => turned.add_to(mesh, density, *place),
            Shape::Box(board) => board.add_to(mesh, density),
        });
    }
    place_in_box(&mut mesh);
    mesh
}

fn pieces() -> Vec<Piece> {
    let mut pieces = vec![Piece { name: "seat".into(), colour: OAK, shape: Shape::Box(seat()) }];
    for (side, sign) in [("right", 1.0), ("left", -1.0)] {
        let mirror = |p: Vec3| vec3(p.x * sign, p.y, p.z);
        for (name, [top, bottom]) in [("front", FRONT_LEG), ("back", BACK_LEG)] {
            let shape = rod(&leg_profile(top.distance(bottom)), mirror(bottom), mirror(top));
            pieces.push(Piece { name: format!("{name} {side} leg"), colour: DARK_OAK, shape });
        }
        let [foot, top] = POST;
        let shape = rod(&post_profile(foot.distance(top)), mirror(foot), mirror(top));
        pieces.push(Piece { name: format!("{side} post"), colour: DARK_OAK, shape });
        let ends = [FRONT_LEG, BACK_LEG].map(|[top, bottom]| mirror(top.lerp(bottom, 0.52)));
        let shape = rod(&stretcher_profile(ends[0].distance(ends[1])), ends[0], ends[1]);
        pieces.push(Piece { name: format!("{side} stretcher"), colour: WALNUT, shape });
    }
    let middle = FRONT_LEG[0].lerp(FRONT_LEG[1], 0.52).lerp(BACK_LEG[0].lerp(BACK_LEG[1], 0.52), 0.4);
    let shape = rod(&stretcher_profile(2.0 * middle.x), vec3(-middle.x, middle.y, middle.z), middle);
    pieces.push(Piece { name: "cross stretcher".into(), colour: WALNUT, shape });
    for (name, height, half) in [("lower slat", 0.32, 0.055), ("middle slat", 0.58, 0.06), ("top rail", 0.90, 0.105)] {
        pieces.push(Piece { name: name.into(), colour: OAK, shape: Shape::Box(slat(height, half)) });
    }
    pieces
}

/// A turned rod from `foot` to `top`.
fn rod(profile: &[Vec2], foot: Vec3, top: Vec3) -> Shape {
    let turn = Quat::from_rotation_arc(Vec3::Y, (top - foot).normalize());
    Shape::Turned(Turned::new(profile), Affine3A::from_rotation_translation(turn, foot))
}

/// (radius, fraction of the length) of the stations along a rod, stretched to `length`.
fn stretched(stations: &[(f32, f32)], length: f32) -> Vec<Vec2> {
    stations.iter().map(|&(radius, at)| vec2(radius, at * length)).collect()
}

fn leg_profile(length: f32) -> Vec<Vec2> {
    let stations = [
        (0.0, 0.0),
        (0.030, 0.002),
        (0.036, 0.02),
        (0.040, 0.09),
        (0.046, 0.17),
        (0.034, 0.20),
        (0.033, 0.215),
        (0.048, 0.235),
        (0.035, 0.255),
        (0.036, 0.28),
        (0.054, 0.40),
        (0.062, 0.50),
        (0.057, 0.60),
        (0.040, 0.70),
        (0.037, 0.72),
        (0.056, 0.745),
        (0.038, 0.77),
        (0.038, 0.79),
        (0.050, 0.86),
        (0.050, 0.94),
        (0.044, 0.995),
        (0.0, 1.0),
    ];
    stretched(&stations, length)
}

fn post_profile(length: f32) -> Vec<Vec2> {
    let stations = [
        (0.0, 0.0),
        (0.036, 0.005),
        (0.038, 0.05),
        (0.040, 0.12),
        (0.032, 0.15),
        (0.046, 0.17),
        (0.032, 0.19),
        (0.040, 0.26),
        (0.043, 0.50),
        (0.041, 0.74),
        (0.040, 0.90),
        (0.028, 0.925),
        (0.027, 0.935),
        (0.042, 0.96),
        (0.036, 0.985),
        (0.016, 0.999),
        (0.0, 1.0),
    ];
    stretched(&stations, length)
}

fn stretcher_profile(length: f32) -> Vec<Vec2> {
    let stations = [
        (0.0, 0.0),
        (0.020, 0.005),
        (0.021, 0.05),
        (0.024, 0.25),
        (0.027, 0.42),
        (0.036, 0.5),
        (0.027, 0.58),
        (0.024, 0.75),
        (0.021, 0.95),
        (0.020, 0.995),
        (0.0, 1.0),
    ];
    stretched(&stations, length)
}

/// Wider in front, and hollowed for sitting.
fn seat() -> RoundedBox {
    RoundedBox {
        half: vec3(0.52, 0.055, 0.48),
        radius: 0.05,
        bend: |p| {
            let taper = 0.93 + 0.10 * p.z / 0.48;
            let hollow = (1.0 - (p.x / 0.5).powi(2)).max(0.0) * (1.0 - ((p.z + 0.06) / 0.46).powi(2)).max(0.0);
            vec3(p.x * taper, p.y - 0.045 * hollow * (p.y / 0.055 + 1.0) * 0.5, p.z)
        },
    }
}

/// Bent backwards between the posts and leaning as they do.
fn slat(height: f32, half_height: f32) -> RoundedBox {
    let bend: fn(Vec3) -> Vec3 = match height {
        h if h < 0.4 => |p| bent(p, 0.32, 0.0),
        h if h < 0.7 => |p| bent(p, 0.58, 0.0),
        _ => |p| bent(p, 0.90, 0.05),
    };
    let [foot, top] = POST;
    let reach = foot.lerp(top, height / (top.y - foot.y)).x - 0.005;
    RoundedBox { half: vec3(reach, half_height, 0.022), radius: 0.02, bend }
}

/// A slat's place at `height`; `crest` is how far its middle rises.
fn bent(p: Vec3, height: f32, crest: f32) -> Vec3 {
    let [foot, top] = POST;
    let lean = (top.z - foot.z) / (top.y - foot.y);
    let arch = 1.0 - (p.x / 0.4).powi(2);
    let y = p.y + height + crest * arch * (p.y / 0.1 + 1.0) * 0.5;
    vec3(p.x, y, p.z + foot.z + lean * y - 0.07 * arch)
}
