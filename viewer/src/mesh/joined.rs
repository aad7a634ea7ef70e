//! Meshes taken apart and put together: what is drawn otherwise than the rest of its mesh is cut out of it, and what is
//! measured as one becomes one.

use std::collections::HashMap;

use glam::{DMat3, DMat4, DVec3};

use super::{Mesh, NONE, Part, Placement};

impl Mesh {
    /// Some of its parts alone, by their numbers in rising order. Where they hung together with the others there are
    /// boundaries; everything stays where it was.
    pub fn only(&self, parts: &[usize]) -> Self {
        let mut mesh = Self { animation: self.animation.clone(), ..Self::empty(&self.name, self.placement) };
        let mut kept: Vec<u32> = Vec::new();
        for part in parts.iter().filter_map(|part| self.parts.get(*part)) {
            let from = kept.len() as u32;
            kept.extend(part.triangles.clone());
            mesh.parts.push(Part { triangles: from..kept.len() as u32, ..part.clone() });
        }
        let mut faces = vec![NONE; self.triangles.len()];
        kept.iter().zip(0..).for_each(|(old, new)| faces[*old as usize] = new);
        let mut used = vec![false; self.positions.len()];
        kept.iter().flat_map(|face| self.triangles[*face as usize]).for_each(|vertex| used[vertex as usize] = true);
        let mut vertices = vec![NONE; used.len()];
        let (mut points, mut groups) = (Numbers::default(), Numbers::default());
        for old in (0..used.len()).filter(|vertex| used[*vertex]) {
            vertices[old] = mesh.positions.len() as u32;
            mesh.positions.push(self.positions[old]);
            mesh.normals.push(self.normals[old]);
            mesh.uvs.extend(self.uvs.get(old));
            mesh.points.push(points.of(self.points[old]));
            mesh.normal_groups.push(groups.of(self.normal_groups[old]));
            mesh.sources.push(self.sources[old]);
        }
        mesh.point_count = points.0.len();
        for face in kept {
            mesh.triangles.push(self.triangles[face as usize].map(|vertex| vertices[vertex as usize]));
            let neighbours = self.neighbours[face as usize];
            mesh.neighbours.push(neighbours.map(|face| faces.get(face as usize).copied().unwrap_or(NONE)));
        }
        mesh
    }

    /// A mesh of nothing yet.
    fn empty(name: &str, placement: Placement) -> Self {
        Self {
            name: name.to_owned(),
            positions: Vec::new(),
            normals: Vec::new(),
            uvs: Vec::new(),
            points: Vec::new(),
            point_count: 0,
            normal_groups: Vec::new(),
            sources: Vec::new(),
            midpoints: Vec::new(),
            triangles: Vec::new(),
            neighbours: Vec::new(),
            parts: Vec::new(),
            placement,
            animation: None,
        }
    }

    /// Meshes at their places as one, at rest. It has uv where all have.
    pub fn joined(name: &str, placed: &[(&Self, DMat4)]) -> Self {
        if let [(only, world)] = placed
            && *world == DMat4::IDENTITY
        {
            return (*only).clone();
        }
        let with_uv = placed.iter().all(|(mesh, _)| !mesh.uvs.is_empty());
        let mut whole = Self::empty(name, Placement { centre: DVec3::ZERO, scale: 1.0 });
        let mut groups = 0;
        for (mesh, world) in placed {
            let (vertex, face) = (whole.positions.len() as u32, whole.triangles.len() as u32);
            let turned = DMat3::from_mat4(*world).inverse().transpose();
            let place = |at: &glam::Vec3| world.transform_point3(at.as_dvec3()).as_vec3();
            whole.positions.extend(mesh.positions.iter().map(place));
            let turn = |normal: &glam::Vec3| (turned * normal.as_dvec3()).normalize_or(DVec3::Y).as_vec3();
            whole.normals.extend(mesh.normals.iter().map(turn));
            if with_uv {
                whole.uvs.extend(&mesh.uvs);
            }
            let point = whole.point_count as u32;
            whole.points.extend(mesh.points.iter().map(|at| at + point));
            whole.point_count += mesh.point_count;
            whole.normal_groups.extend(mesh.normal_groups.iter().map(|group| group + groups));
            groups = whole.normal_groups.iter().max().map_or(0, |most| most + 1);
            whole.sources.extend(std::iter::repeat_n(u32::MAX, mesh.positions.len()));
            let other = |neighbour: u32| if neighbour == NONE { NONE } else { neighbour + face };
            for (triangle, neighbours) in mesh.triangles.iter().zip(&mesh.neighbours) {
                let [a, b, c] = triangle.map(|corner| corner + vertex);
                let [ab, bc, ca] = neighbours.map(other);
                // What is mirrored is seen from its other side.
                let mirrored = world.determinant() < 0.0;
                whole.triangles.push(if mirrored { [a, c, b] } else { [a, b, c] });
                whole.neighbours.push(if mirrored { [ca, bc, ab] } else { [ab, bc, ca] });
            }
            let moved = |part: &Part| Part {
                triangles: part.triangles.start + face..part.triangles.end + face,
                ..part.clone()
            };
            whole.parts.extend(mesh.parts.iter().map(moved));
        }
        whole
    }
}

/// New numbers, in the order in which old ones are met.
#[derive(Default)]
struct Numbers(HashMap<u32, u32>);

impl Numbers {
    fn of(&mut self, old: u32) -> u32 {
        let next = self.0.len() as u32;
        *self.0.entry(old).or_insert(next)
    }
}

#[cfg(test)]
mod tests {
    use super::super::invariants::check;
    use super::super::prepare;
    use super::super::sample::Sample;
    use super::*;

    #[test]
    fn a_part_alone_is_a_whole_mesh_where_it_was() {
        let chair = prepare(Sample::Chair.build(4000)).expect("a chair").mesh;
        for part in 0..chair.parts.len() {
            let alone = chair.only(&[part]);
            check(&alone);
            let range = chair.parts[part].triangles.clone();
            assert_eq!(alone.triangles.len(), range.len());
            for (new, old) in alone.triangles.iter().zip(&chair.triangles[range.start as usize..]) {
                assert_eq!(
                    new.map(|corner| alone.positions[corner as usize]),
                    old.map(|corner| chair.positions[corner as usize])
                );
            }
        }
        let all: Vec<usize> = (0..chair.parts.len()).collect();
        let whole = chair.only(&all);
        assert_eq!((whole.triangles, whole.neighbours), (chair.triangles.clone(), chair.neighbours.clone()));
    }

    #[test]
    fn meshes_put_together_keep_their_places_and_their_outsides() {
        let cube = prepare(Sample::Cube.build(300)).expect("a cube").mesh;
        let beside = DMat4::from_translation(DVec3::X * 0.7)
            * DMat4::from_rotation_y(0.4)
            * DMat4::from_scale(DVec3::splat(0.2));
        let mirrored = DMat4::from_scale(DVec3::new(0.3, -0.5, 0.3));
        let both = Mesh::joined("both", &[(&cube, beside), (&cube, mirrored)]);
        check(&both);
        assert_eq!(both.triangles.len(), 2 * cube.triangles.len());
        let outward = |triangle: &[u32; 3]| {
            let [a, b, c] = triangle.map(|corner| both.positions[corner as usize]);
            (b - a).cross(c - a).dot(both.normals[triangle[0] as usize]) > 0.0
        };
        assert!(both.triangles.iter().all(outward));
        let alone = Mesh::joined("cube", &[(&cube, DMat4::IDENTITY)]);
        assert_eq!((alone.name, alone.positions), (cube.name, cube.positions));
    }
}
