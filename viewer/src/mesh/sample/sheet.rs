//! Parametrised surfaces: grids of columns (u) by rows (v), and how many of each make a wanted number of triangles.

use glam::{Vec2, Vec3};
use rayon::prelude::*;

use super::super::{RawMesh, RawPart};

/// Length of one uv unit on the samples' surfaces, about; closed directions round it so that it goes in a whole
/// number of times.
pub(super) const UV_UNIT: f32 = 0.5;

/// A point of a surface.
#[derive(Clone, Copy)]
pub(super) struct Vertex {
    pub(super) position: Vec3,
    pub(super) normal: Vec3,
    pub(super) uv: Vec2,
}

/// A grid of `columns` by `rows` quads, u across v pointing outwards. At a pole all of a row is one point, and each
/// column there is one triangle.
#[derive(Clone, Copy, Default)]
pub(super) struct Sheet {
    pub(super) columns: usize,
    pub(super) rows: usize,
    pub(super) first_row_is_pole: bool,
    pub(super) last_row_is_pole: bool,
}

impl Sheet {
    pub(super) fn open(columns: usize, rows: usize) -> Self {
        Self { columns, rows, ..Self::default() }
    }

    pub(super) fn between_poles(columns: usize, rows: usize) -> Self {
        Self { columns, rows, first_row_is_pole: true, last_row_is_pole: true }
    }

    pub(super) fn triangles(&self) -> usize {
        let poles = usize::from(self.first_row_is_pole) + usize::from(self.last_row_is_pole);
        self.columns * (2 * self.rows - poles)
    }

    fn is_pole(&self, row: usize) -> bool {
        row == 0 && self.first_row_is_pole || row == self.rows && self.last_row_is_pole
    }

    /// Adds the grid. `vertex(i, j)` is asked for column lines 0..=columns and row lines 0..=rows; at a pole i is the
    /// middle of a column, so that each triangle's tip has a uv of its own.
    pub(super) fn add_to(&self, mesh: &mut RawMesh, vertex: impl Fn(f32, usize) -> Vertex + Sync) {
        let base = mesh.positions.len();
        let first_of = |row: usize| base + row * (self.columns + 1) - usize::from(row > 0 && self.first_row_is_pole);
        let vertices: Vec<Vertex> = (0..=self.rows)
            .into_par_iter()
            .flat_map_iter(|row| {
                let pole = self.is_pole(row);
                let vertex = &vertex;
                (0..self.columns + usize::from(!pole))
                    .map(move |column| vertex(column as f32 + if pole { 0.5 } else { 0.0 }, row))
            })
            .collect();
        mesh.positions.extend(vertices.iter().map(|v| v.position));
        mesh.normals.extend(vertices.iter().map(|v| v.normal));
        mesh.uvs.extend(vertices.iter().map(|v| v.uv));
        for row in 0..self.rows {
            let (low, high) = (first_of(row), first_of(row + 1));
            for column in 0..self.columns {
                let [a, b, c, d] = [low + column, low + column + 1, high + column + 1, high + column];
                if self.is_pole(row) {
                    mesh.triangles.push([a, c, d].map(|i| i as u32));
                } else if self.is_pole(row + 1) {
                    mesh.triangles.push([a, b, d].map(|i| i as u32));
                } else {
                    let across = |i: usize, k: usize| mesh.positions[i].distance_squared(mesh.positions[k]);
                    // A hair's preference decides squares alike on every machine.
                    let cut = if across(a, c) <= across(b, d) * 1.0001 {
                        [[a, b, c], [a, c, d]]
                    } else {
                        [[a, b, d], [b, c, d]]
                    };
                    mesh.triangles.extend(cut.map(|face| face.map(|i| i as u32)));
                }
            }
        }
    }
}

/// How many segments of length `1 / density` a line of `length` is cut into, at least `least`.
pub(super) fn segments(length: f32, density: f64, least: usize) -> usize {
    ((f64::from(length) * density).round() as usize).max(least)
}

/// The density at which `count` comes nearest to `wanted` triangles; `count` must not fall as density grows.
pub(super) fn density_for(wanted: usize, count: impl Fn(f64) -> usize) -> f64 {
    let (mut low, mut high) = (1e-3, 1e5);
    for _ in 0..80 {
        let middle = f64::sqrt(low * high);
        if count(middle) < wanted {
            low = middle;
        } else {
            high = middle;
        }
    }
    if wanted.abs_diff(count(low)) <= wanted.abs_diff(count(high)) { low } else { high }
}

/// Whole repeats of the unit around a closed line of `length`.
pub(super) fn repeats(length: f32) -> f32 {
    (length / UV_UNIT).round().max(1.0)
}

/// Adds what `build` adds as one part.
pub(super) fn add_part(mesh: &mut RawMesh, name: &str, colour: Option<[f32; 3]>, build: impl FnOnce(&mut RawMesh)) {
    let start = mesh.triangles.len();
    build(mesh);
    let triangles = start..mesh.triangles.len();
    mesh.parts.push(RawPart { name: name.to_owned(), colour, triangles });
}
