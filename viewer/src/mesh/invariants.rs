//! What every mesh promises, checked; for the tests here and for the fuzz targets, which include this file.

use super::{Mesh, NONE};

/// Panics where a mesh breaks a promise.
pub(super) fn check(mesh: &Mesh) {
    let vertices = mesh.positions.len();
    assert!(!mesh.triangles.is_empty());
    for length in [mesh.normals.len(), mesh.points.len(), mesh.normal_groups.len(), mesh.sources.len()] {
        assert_eq!(length, vertices);
    }
    assert!(mesh.uvs.is_empty() || mesh.uvs.len() == vertices);
    assert_eq!(mesh.neighbours.len(), mesh.triangles.len());
    assert!(mesh.uvs.iter().all(|uv| uv.is_finite()));
    assert!(mesh.positions.iter().all(|position| position.is_finite() && position.abs().max_element() <= 1.0));
    // A unit vector of f32: its length is off by some 1e-7.
    assert!(mesh.normals.iter().all(|normal| (normal.length() - 1.0).abs() < 1e-5));
    assert!(mesh.points.iter().all(|&point| (point as usize) < mesh.point_count));
    assert!(mesh.sources.is_sorted());

    let mut used = vec![false; vertices];
    for triangle in &mesh.triangles {
        triangle.iter().for_each(|&vertex| used[vertex as usize] = true);
        let [a, b, c] = triangle.map(|vertex| mesh.points[vertex as usize]);
        assert!(a != b && b != c && c != a);
    }
    assert!(used.iter().all(|used| *used));

    let edge =
        |face: usize, k: usize| [k, (k + 1) % 3].map(|corner| mesh.points[mesh.triangles[face][corner] as usize]);
    for (face, neighbours) in mesh.neighbours.iter().enumerate() {
        for (k, &other) in neighbours.iter().enumerate().filter(|(_, other)| **other != NONE) {
            let [from, to] = edge(face, k);
            let back = (0..3).find(|&j| mesh.neighbours[other as usize][j] == face as u32);
            let back = back.expect("neighbours are mutual");
            assert_eq!(edge(other as usize, back), [to, from], "neighbours run along their edge in opposite ways");
        }
    }

    let mut next = 0;
    for part in &mesh.parts {
        assert!(part.triangles.start == next && part.triangles.end > next);
        next = part.triangles.end;
    }
    assert_eq!(next as usize, mesh.triangles.len());

    let mut normals = Vec::new();
    mesh.normals_of(&mesh.positions, &mut normals);
    assert!(normals.iter().all(|normal| (normal.length() - 1.0).abs() < 1e-5));
    let mut posed = Vec::new();
    for time_s in [0.0, 0.37, 1e9] {
        mesh.pose(time_s, &mut posed);
        assert!(posed.len() == vertices && posed.iter().all(|position| position.is_finite()));
    }
    assert!(mesh.uv_density().is_none_or(|density| density.is_finite()));
    let mut edges: Vec<[u32; 2]> = mesh
        .edges()
        .iter()
        .map(|edge| {
            let mut points = edge.vertices.map(|vertex| mesh.points[vertex as usize]);
            points.sort_unstable();
            points
        })
        .collect();
    let all = edges.len();
    edges.sort_unstable();
    edges.dedup();
    assert_eq!(edges.len(), all, "each edge once");
}
