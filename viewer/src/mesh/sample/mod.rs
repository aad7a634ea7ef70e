//! Sample meshes, made at any number of triangles.
//!
//! All are oriented outwards, without degenerate or doubled triangles; y is up, the front faces +z, and the box is
//! about the origin with a longest side of 2. Vertices have normals. Where a surface has a natural parametrisation it
//! has uvs: u runs around the form, v along it, u across v points outwards, one unit is about half a mesh unit long in
//! both directions, and closed directions have a whole number of repeats, so that a tile meets itself at the seam.
//!
//! The same sample and number give the same mesh whatever the number of threads.

mod chair;
mod decimate;
mod flat;
mod gyroid;
mod hand;
mod head;
mod nets;
mod rounded_box;
mod sdf;
mod sheet;
mod solid;
mod teapot;
#[cfg(test)]
mod tests;
mod tube;
mod turned;

use glam::Vec3;

use super::{RawMesh, RawPart};

/// A mesh that can be had without a file.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, serde::Serialize, serde::Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Sample {
    /// A flat square that faces the front.
    Quad,
    /// A closed cylinder with hard rims.
    Cylinder,
    /// A sphere of meridians and parallels.
    Sphere,
    /// A ring.
    Torus,
    /// The (2, 3) torus knot.
    TorusKnot,
    /// A cube with hard edges.
    Cube,
    /// A wooden chair of thirteen parts.
    Chair,
    /// The Utah teapot.
    Teapot,
    /// A ball cut from the gyroid.
    Gyroid,
    /// An open hand.
    Hand,
    /// A head on its neck.
    Head,
}

impl Sample {
    /// Every sample, simple ones first.
    pub const ALL: [Self; 11] = [
        Self::Quad,
        Self::Cylinder,
        Self::Sphere,
        Self::Torus,
        Self::TorusKnot,
        Self::Cube,
        Self::Chair,
        Self::Teapot,
        Self::Gyroid,
        Self::Hand,
        Self::Head,
    ];

    /// Its name in commands and files.
    pub fn name(self) -> &'static str {
        match self {
            Self::Quad => "quad",
            Self::Cylinder => "cylinder",
            Self::Sphere => "sphere",
            Self::Torus => "torus",
            Self::TorusKnot => "torus-knot",
            Self::Cube => "cube",
            Self::Chair => "chair",
            Self::Teapot => "teapot",
            Self::Gyroid => "gyroid",
            Self::Hand => "hand",
            Self::Head => "head",
        }
    }

    /// What it is and what it shows, in one line.
    pub fn description(self) -> &'static str {
        match self {
            Self::Quad => "flat square: the material itself",
            Self::Cylinder => "closed cylinder: one curved direction, hard rims",
            Self::Sphere => "sphere of meridians and parallels: every tone, two poles",
            Self::Torus => "ring: curvature of both signs, no poles",
            Self::TorusKnot => "knotted tube: long strokes around a winding form",
            Self::Cube => "cube: flat faces and hard edges",
            Self::Chair => "wooden chair: thirteen rounded parts with colours",
            Self::Teapot => "Utah teapot: the classic, from its Bézier patches",
            Self::Gyroid => "ball cut from the gyroid: saddles everywhere, no uv",
            Self::Hand => "open hand: organic form, no uv",
            Self::Head => "head and neck: fine features beside broad ones, no uv",
        }
    }

    /// The sample of that name.
    pub fn named(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|sample| sample.name() == name)
    }

    /// The number of triangles at which it looks right.
    pub fn default_triangles(self) -> usize {
        match self {
            Self::Quad | Self::Cube => 5_000,
            Self::Cylinder | Self::Sphere | Self::Torus => 10_000,
            Self::TorusKnot | Self::Chair | Self::Teapot | Self::Gyroid | Self::Hand | Self::Head => 20_000,
        }
    }

    /// The fewest triangles it can have; fewer wanted give this many.
    pub fn least_triangles(self) -> usize {
        match self {
            Self::Quad => 2,
            Self::Cylinder | Self::Sphere | Self::Cube => 12,
            Self::Torus => 24,
            Self::TorusKnot => 144,
            Self::Chair => 900,
            Self::Teapot => 250,
            Self::Gyroid => 2_500,
            Self::Hand | Self::Head => 500,
        }
    }

    /// Makes the mesh with about `triangles` triangles: within 15 % from [`least_triangles`](Self::least_triangles) to
    /// 5 million, except below 100, where quad, cylinder, sphere, torus and cube have the nearest number that their
    /// grids allow.
    pub fn build(self, triangles: usize) -> RawMesh {
        let triangles = triangles.max(self.least_triangles());
        let mut mesh = match self {
            Self::Quad => flat::quad(triangles),
            Self::Cylinder => turned::cylinder(triangles),
            Self::Sphere => turned::sphere(triangles),
            Self::Torus => tube::torus(triangles),
            Self::TorusKnot => tube::torus_knot(triangles),
            Self::Cube => flat::cube(triangles),
            Self::Chair => chair::chair(triangles),
            Self::Teapot => teapot::teapot(triangles),
            Self::Gyroid => gyroid::gyroid(triangles),
            Self::Hand => hand::hand(triangles),
            Self::Head => head::head(triangles),
        };
        self.name().clone_into(&mut mesh.name);
        mesh.made = true;
        if mesh.parts.is_empty() {
            let triangles = 0..mesh.triangles.len();
            mesh.parts.push(RawPart { name: mesh.name.clone(), colour: None, triangles });
        }
        mesh
    }
}

/// Moves and scales a mesh so that its box is about the origin with a longest side of 2.
fn place_in_box(mesh: &mut RawMesh) {
    let (low, high) = mesh.positions.iter().fold((Vec3::MAX, Vec3::MIN), |(l, h), &p| (l.min(p), h.max(p)));
    let (centre, scale) = ((low + high) * 0.5, 2.0 / (high - low).max_element());
    for p in &mut mesh.positions {
        *p = (*p - centre) * scale;
    }
}
