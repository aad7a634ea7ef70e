//! Long edges cut at their middles, so that what is stored at vertices is fine enough. The surface stays where it was.

use std::collections::HashMap;

use rayon::prelude::*;

use super::prepare::adjacency::neighbours;
use super::{Mesh, MeshReport, NONE, Part};

/// Triangles that cutting adds at most, about.
pub(crate) const PIECES_MAX: usize = 500_000;

/// Rounds at most: each halves the longest edges.
const ROUNDS: usize = 24;

/// A mesh whose long edges were cut.
#[derive(Clone, Debug)]
pub struct Cut {
    /// The same surface.
    pub mesh: Mesh,
    /// The longest edge asked for, in mesh units.
    pub asked: f32,
    /// The longest that may have stayed: more than what was asked for where that took too many pieces.
    pub longest: f32,
}

impl Cut {
    /// What to know of it where edges stayed longer than was asked for.
    pub fn note(&self) -> Option<String> {
        (self.longest > self.asked).then(|| {
            format!(
                "patches bend less than tiles as small as these ask for: edges are {:.1} times as long, or there would be \
                 too many triangles; fewer tiles, or a part of the mesh, have all they need",
                self.longest / self.asked
            )
        })
    }
}

impl Mesh {
    /// The same surface without edges longer than `longest`, in mesh units; where that takes over half a million more
    /// triangles, with longer ones, told before any is cut. Triangles that share an edge are cut at the same place, so
    /// nothing opens. `None` where no edge is longer.
    pub fn cut(&self, longest: f32) -> Option<Cut> {
        if longest.is_nan() || longest <= 0.0 || self.pieces(longest) <= self.triangles.len() as f64 {
            return None;
        }
        let most = (self.triangles.len() + PIECES_MAX) as f64;
        // In steps of half an octave: the first that is few enough.
        let coarser = |step: i32| longest * f32::powi(2.0, step).sqrt();
        let within = (0..).map(coarser).find(|longest| self.pieces(*longest) <= most)?;
        Some(Cut { mesh: self.halved(within), asked: longest, longest: within })
    }

    /// About how many triangles there are once no edge is longer.
    fn pieces(&self, longest: f32) -> f64 {
        let inverse_squared = 1.0 / f64::from(longest * longest);
        let of_triangle = |corners: &[u32; 3]| {
            let p = corners.map(|vertex| self.positions[vertex as usize]);
            // Each edge in halves, so many as make it short enough.
            let [a, b, c] = [0, 1, 2].map(|k| {
                let squared = f64::from(p[k].distance_squared(p[(k + 1) % 3])) * inverse_squared;
                if squared > 1.0 { (squared.log2() / 2.0).ceil().exp2() } else { 1.0 }
            });
            // Exact where all are cut as often, and where one or two are cut once.
            (a * b + b * c + c * a) / 3.0
        };
        self.triangles.par_iter().map(of_triangle).sum()
    }

    /// What [`Mesh::cut`] gives, or the mesh as it is.
    pub fn subdivided(&self, longest: f32) -> Mesh {
        self.cut(longest).map_or_else(|| self.clone(), |cut| cut.mesh)
    }

    /// All edges halved until none is longer, however many triangles that takes.
    fn halved(&self, longest: f32) -> Mesh {
        let mut mesh = self.clone();
        for _ in 0..ROUNDS {
            if !Cuts::new(&mut mesh, longest).cut() {
                break;
            }
        }
        if mesh.triangles.len() > self.triangles.len() {
            let points: Vec<[u32; 3]> =
                mesh.triangles.iter().map(|corners| corners.map(|vertex| mesh.points[vertex as usize])).collect();
            mesh.neighbours = neighbours(&points, mesh.point_count, &mut MeshReport::default());
            part_turned(&mut mesh.neighbours, &points);
        }
        mesh
    }
}

/// Neighbours that run along their edge in the same way, as on a Möbius strip, are none.
fn part_turned(neighbours: &mut [[u32; 3]], points: &[[u32; 3]]) {
    for (face, corners) in points.iter().enumerate() {
        for k in 0..3 {
            let other = neighbours[face][k];
            let back = [corners[(k + 1) % 3], corners[k]];
            if other != NONE && !(0..3).any(|j| [0, 1].map(|i| points[other as usize][(j + i) % 3]) == back) {
                neighbours[face][k] = NONE;
            }
        }
    }
}

/// One round.
struct Cuts<'a> {
    mesh: &'a mut Mesh,
    longest_squared: f32,
    /// New vertex by the vertices of its edge, new point by points, new normal group by groups; the lesser first.
    vertices: HashMap<[u32; 2], u32>,
    points: HashMap<[u32; 2], u32>,
    groups: HashMap<[u32; 2], u32>,
    group_count: u32,
}

fn ordered(a: u32, b: u32) -> [u32; 2] {
    [a.min(b), a.max(b)]
}

impl<'a> Cuts<'a> {
    fn new(mesh: &'a mut Mesh, longest: f32) -> Self {
        let group_count = mesh.normal_groups.iter().max().map_or(0, |group| group + 1);
        Self {
            mesh,
            longest_squared: longest * longest,
            vertices: HashMap::new(),
            points: HashMap::new(),
            groups: HashMap::new(),
            group_count,
        }
    }

    /// Whether anything was cut.
    fn cut(&mut self) -> bool {
        let before = std::mem::take(&mut self.mesh.triangles);
        let mut triangles = Vec::with_capacity(before.len());
        let mut parts: Vec<Part> = self.mesh.parts.clone();
        for part in &mut parts {
            let start = triangles.len() as u32;
            for corners in &before[part.triangles.start as usize..part.triangles.end as usize] {
                let middles = std::array::from_fn(|k| self.middle(corners[k], corners[(k + 1) % 3]));
                self.split(*corners, middles, &mut triangles);
            }
            part.triangles = start..triangles.len() as u32;
        }
        let cut = triangles.len() > before.len();
        self.mesh.triangles = triangles;
        self.mesh.parts = parts;
        cut
    }

    fn is_long(&self, a: u32, b: u32) -> bool {
        let [a, b] = [a, b].map(|vertex| self.mesh.positions[vertex as usize]);
        // The same for both triangles of an edge, whichever way it runs.
        a.distance_squared(b) > self.longest_squared
    }

    /// The vertex in the middle of an edge that is too long.
    fn middle(&mut self, a: u32, b: u32) -> Option<u32> {
        if !self.is_long(a, b) {
            return None;
        }
        let key = ordered(a, b);
        if let Some(vertex) = self.vertices.get(&key) {
            return Some(*vertex);
        }
        let mesh = &mut *self.mesh;
        let vertex = mesh.positions.len() as u32;
        let [i, j] = key.map(|vertex| vertex as usize);
        mesh.positions.push((mesh.positions[i] + mesh.positions[j]) * 0.5);
        let normal = (mesh.normals[i] + mesh.normals[j]).try_normalize().unwrap_or(mesh.normals[i]);
        mesh.normals.push(normal);
        if !mesh.uvs.is_empty() {
            mesh.uvs.push((mesh.uvs[i] + mesh.uvs[j]) * 0.5);
        }
        let point = *self.points.entry(ordered(mesh.points[i], mesh.points[j])).or_insert_with(|| {
            mesh.point_count += 1;
            mesh.point_count as u32 - 1
        });
        mesh.points.push(point);
        let group = *self.groups.entry(ordered(mesh.normal_groups[i], mesh.normal_groups[j])).or_insert_with(|| {
            self.group_count += 1;
            self.group_count - 1
        });
        mesh.normal_groups.push(group);
        mesh.sources.push(u32::MAX);
        mesh.midpoints.push(key);
        self.vertices.insert(key, vertex);
        Some(vertex)
    }

    fn split(&self, [a, b, c]: [u32; 3], middles: [Option<u32>; 3], triangles: &mut Vec<[u32; 3]>) {
        match middles {
            [None, None, None] => triangles.push([a, b, c]),
            [Some(ab), Some(bc), Some(ca)] => {
                triangles.extend([[a, ab, ca], [ab, b, bc], [ca, bc, c], [ab, bc, ca]]);
            }
            [Some(ab), None, None] => triangles.extend([[a, ab, c], [ab, b, c]]),
            [None, Some(bc), None] => triangles.extend([[b, bc, a], [bc, c, a]]),
            [None, None, Some(ca)] => triangles.extend([[c, ca, b], [ca, a, b]]),
            [Some(ab), Some(bc), None] => self.split_two([a, b, c], ab, bc, triangles),
            [None, Some(bc), Some(ca)] => self.split_two([b, c, a], bc, ca, triangles),
            [Some(ab), None, Some(ca)] => self.split_two([c, a, b], ca, ab, triangles),
        }
    }

    /// Edges ab and bc are cut: the corner at b, and the rest by its shorter diagonal.
    fn split_two(&self, [a, b, c]: [u32; 3], ab: u32, bc: u32, triangles: &mut Vec<[u32; 3]>) {
        let length = |i: u32, j: u32| self.mesh.positions[i as usize].distance_squared(self.mesh.positions[j as usize]);
        triangles.push([ab, b, bc]);
        if length(a, bc) < length(ab, c) {
            triangles.extend([[a, ab, bc], [a, bc, c]]);
        } else {
            triangles.extend([[a, ab, c], [ab, bc, c]]);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::super::sample::Sample;
    use super::super::{NONE, invariants, prepare};

    #[test]
    fn subdivided_meshes_keep_their_promises_area_and_boundary() {
        for sample in [Sample::Cube, Sample::Chair, Sample::Quad, Sample::Sphere, Sample::Teapot] {
            let mesh = prepare(sample.build(200)).expect("a sample").mesh;
            let fine = mesh.subdivided(0.1);
            assert!(fine.triangles.len() > mesh.triangles.len(), "{}", sample.name());
            invariants::check(&fine);
            let area = |mesh: &super::Mesh| {
                let corners =
                    mesh.triangles.iter().map(|corners| corners.map(|v| mesh.positions[v as usize].as_dvec3()));
                corners.map(|[a, b, c]| (b - a).cross(c - a).length()).sum::<f64>()
            };
            assert!((area(&fine) / area(&mesh) - 1.0).abs() < 1e-4, "{}", sample.name());
            let open = |mesh: &super::Mesh| mesh.neighbours.as_flattened().iter().filter(|n| **n == NONE).count();
            assert_eq!(open(&mesh) == 0, open(&fine) == 0, "{}: nothing opens", sample.name());
            for corners in &fine.triangles {
                let p = corners.map(|vertex| fine.positions[vertex as usize]);
                assert!((0..3).all(|k| p[k].distance(p[(k + 1) % 3]) <= 0.1));
            }
        }
    }

    #[test]
    fn cuts_have_a_budget_and_say_so() {
        for (sample, triangles) in [(Sample::TorusKnot, 20_000), (Sample::Cube, 12), (Sample::Chair, 3_000)] {
            let mesh = prepare(sample.build(triangles)).expect("a sample").mesh;
            let cut = mesh.cut(0.04).expect("long edges");
            assert!(cut.longest == cut.asked && cut.note().is_none(), "{}", sample.name());
            assert_eq!(cut.mesh.triangles, mesh.halved(0.04).triangles);
            let fine = mesh.cut(1e-30).expect("long edges");
            assert!(fine.longest > fine.asked && fine.mesh.triangles.len() >= mesh.triangles.len());
            // As many as were foreseen, within half.
            let ratio = cut.mesh.triangles.len() as f64 / mesh.pieces(0.04);
            assert!((0.5..1.5).contains(&ratio), "{}: {ratio}", sample.name());
            let cut = mesh.cut(2e-4).expect("long edges");
            assert!(cut.mesh.triangles.len() < mesh.triangles.len() + super::PIECES_MAX * 3 / 2, "{}", sample.name());
            assert!(cut.mesh.triangles.len() > mesh.triangles.len() && cut.longest > cut.asked);
            assert!(cut.note().expect("a note").contains("times as long"));
        }
    }

    #[test]
    fn what_is_fine_enough_stays_as_it_is() {
        let mesh = prepare(Sample::Sphere.build(2_000)).expect("a sphere").mesh;
        assert!(mesh.cut(3.0).is_none() && mesh.cut(0.0).is_none());
        assert_eq!(mesh.subdivided(3.0).triangles, mesh.triangles);
        assert_eq!(mesh.subdivided(f32::NAN).triangles, mesh.triangles);
    }

    #[test]
    fn new_vertices_follow_a_deformed_mesh() {
        let mesh = prepare(Sample::Cube.build(12)).expect("a cube").mesh;
        let fine = mesh.subdivided(0.4);
        let first = fine.positions.len() - fine.midpoints.len();
        assert_eq!(first, mesh.positions.len());
        for (k, pair) in fine.midpoints.iter().enumerate() {
            let [a, b] = pair.map(|vertex| fine.positions[vertex as usize]);
            assert!(pair.iter().all(|vertex| (*vertex as usize) < first + k));
            assert_eq!(fine.positions[first + k], (a + b) * 0.5);
        }
    }
}
