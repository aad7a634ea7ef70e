//! Twin of `lib/mapping.wgsl`: how the tile reaches the surface: the mesh's own uv, the light-aligned frame of the
//! face, or three planes. Each gives up to three patterns with weights that sum to 1, and the footprint of a pixel.

use glam::{DVec2, DVec3};

use super::face_frame::{fixed_tangent, unpack_shares};
use super::material::{Material, tile_uv};
use super::mesh_types::FaceFrame;
use super::octahedral::oct_decode;
use super::scene::Scene;
use super::surface::Point;
use crate::cpu::{Bindings, Form, Mapping, Quad};

/// A frame of more than this share is drawn alone. The shader compares with the nearest 32-bit number.
pub(super) const LONE_WEIGHT: f64 = 0.999_f32 as f64;

/// One layer of the map on the surface.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Pattern {
    /// Place on the tile.
    pub uv: DVec2,
    /// Its share.
    pub weight: f64,
}

/// All layers at a surface point.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Mapped {
    /// `a`, `b` and `c` of the shader.
    pub patterns: [Pattern; 3],
    /// Footprint of a pixel.
    pub tiles_per_px: f64,
}

/// Tiles across a pixel for surface coordinates that are true to length. Suarez 2013, end of section 3.4.
pub fn footprint(form: Form, scene: &Scene, material: &Material, point: &Point) -> f64 {
    let flat_on = material.tile_scale * scene.pixel_world_at_1 * point.depth;
    match form {
        Form::Literal => flat_on,
        Form::Hardened => flat_on / point.normal.dot(point.view).abs().clamp(0.1, 1.0),
    }
}

/// The mean of the longer and the shorter side of a pixel on a slanted surface, in tiles: strokes that follow the form run
/// both ways.
pub fn mean_footprint(form: Form, scene: &Scene, material: &Material, point: &Point) -> f64 {
    let flat_on = material.tile_scale * scene.pixel_world_at_1 * point.depth;
    (footprint(form, scene, material, point) * flat_on).sqrt()
}

/// The place of a point in the space of the frames: the world, or in the literal form the mesh's own.
pub fn frame_place(form: Form, scene: &Scene, p_world: DVec3) -> DVec3 {
    match form {
        Form::Literal => (scene.mesh_from_world * p_world.extend(1.0)).truncate(),
        Form::Hardened => p_world,
    }
}

/// The mesh's own uv; the footprint is that of the quad.
pub fn map_uv(material: &Material, points: &Quad<Point>, lane: usize) -> Mapped {
    let uvs = points.map(|point| tile_uv(material, point.uv));
    let (dx, dy) = (uvs.dpdx(lane), uvs.dpdy(lane));
    let none = Pattern::default();
    Mapped {
        patterns: [Pattern { uv: uvs[lane], weight: 1.0 }, none, none],
        tiles_per_px: dx.dot(dx).max(dy.dot(dy)).sqrt(),
    }
}

/// Surface coordinates of a place in the space of the frames.
pub fn frame_st(frame: &FaceFrame, p: DVec3) -> DVec2 {
    DVec2::new(p.dot(frame.tangent), p.dot(frame.bitangent))
}

/// The frame of a face with this normal, its half turn, and the fixed frame, at a place `p` that has `st` in the first.
pub fn frame_patterns(material: &Material, p: DVec3, st: DVec2, n: DVec3, shares: DVec3) -> [Pattern; 3] {
    let e = fixed_tangent(n);
    let fixed_st = DVec2::new(p.dot(e), p.dot(n.cross(e)));
    [
        Pattern { uv: tile_uv(material, st), weight: shares.x },
        Pattern { uv: tile_uv(material, -st), weight: shares.y },
        Pattern { uv: tile_uv(material, fixed_st), weight: shares.z },
    ]
}

/// The light-aligned frame of the face; vertices hand on the place in it, in place of the mesh's uv.
pub fn map_frames(b: &Bindings<'_>, point: &Point) -> Mapped {
    let form = b.options.form;
    let p = frame_place(form, b.scene, point.p_world);
    let [shares, normal_oct] = point.framing;
    Mapped {
        patterns: frame_patterns(b.material, p, point.uv, oct_decode(normal_oct), unpack_shares(shares)),
        tiles_per_px: footprint(form, b.scene, b.material, point),
    }
}

/// Weights of the three planes: a plane takes part where the normal leans towards its axis.
pub fn triplanar_weights(n: DVec3) -> DVec3 {
    let w = (n.abs() - 0.2).max(DVec3::ZERO);
    let w = w * w * w;
    w / w.element_sum()
}

/// Three planes across the axes.
pub fn map_triplanar(form: Form, scene: &Scene, material: &Material, point: &Point) -> Mapped {
    let p = frame_place(form, scene, point.p_world);
    let w = triplanar_weights(point.normal);
    let at = |s: f64, t: f64| tile_uv(material, DVec2::new(s, t));
    Mapped {
        patterns: [
            Pattern { uv: at(p.z, p.y) + DVec2::new(0.37, 0.11), weight: w.x },
            Pattern { uv: at(p.x, p.z) + DVec2::new(0.71, 0.53), weight: w.y },
            Pattern { uv: at(p.x, p.y), weight: w.z },
        ],
        tiles_per_px: footprint(form, scene, material, point),
    }
}

/// The mapping of the pipeline.
pub fn map_surface(b: &Bindings<'_>, points: &Quad<Point>, lane: usize) -> Mapped {
    match b.options.mapping {
        Mapping::Frames => map_frames(b, &points[lane]),
        Mapping::Triplanar => map_triplanar(b.options.form, b.scene, b.material, &points[lane]),
        // Patches and lapped textures are blended on their own.
        Mapping::Uv | Mapping::Patches | Mapping::Lapped => map_uv(b.material, points, lane),
    }
}

/// How many of the patterns take part; the rest have no weight.
pub fn pattern_count(mapping: Mapping, mapped: &Mapped) -> usize {
    match mapping {
        Mapping::Uv => 1,
        Mapping::Frames if mapped.patterns[0].weight > LONE_WEIGHT => 1,
        _ => 3,
    }
}
