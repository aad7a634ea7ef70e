//! What every sample promises, on the triangles themselves.

use std::collections::HashMap;
use std::sync::{Arc, LazyLock, Mutex, PoisonError};

use glam::{Vec2, Vec3};

use super::super::{RawMesh, prepare};
use super::Sample;

const CLOSED: [Sample; 9] = [
    Sample::Cylinder,
    Sample::Sphere,
    Sample::Torus,
    Sample::TorusKnot,
    Sample::Cube,
    Sample::Chair,
    Sample::Gyroid,
    Sample::Hand,
    Sample::Head,
];
const IMPLICIT: [Sample; 3] = [Sample::Gyroid, Sample::Hand, Sample::Head];

/// Builds each mesh once for all tests.
fn built(sample: Sample, wanted: usize) -> Arc<RawMesh> {
    type Built = HashMap<(Sample, usize), Arc<RawMesh>>;
    static ALL: LazyLock<Mutex<Built>> = LazyLock::new(Mutex::default);
    // A test that failed while it held the map has left it whole.
    let mut all = ALL.lock().unwrap_or_else(PoisonError::into_inner);
    all.entry((sample, wanted)).or_insert_with(|| Arc::new(sample.build(wanted))).clone()
}

/// Triangles over welded positions: equal to the bit is the same point.
struct Welded {
    triangles: Vec<[u32; 3]>,
    points: usize,
    edges: HashMap<(u32, u32), i64>,
}

impl Welded {
    fn new(mesh: &RawMesh) -> Self {
        let mut numbers = HashMap::new();
        let mut triangles = Vec::new();
        for (index, part) in mesh.parts.iter().enumerate() {
            // Parts may touch: the teapot's handle ends on its body.
            let mut point = |corner: u32| {
                let next = numbers.len() as u32;
                *numbers.entry((bits(mesh.positions[corner as usize]), index)).or_insert(next)
            };
            triangles.extend(mesh.triangles[part.triangles.clone()].iter().map(|face| face.map(&mut point)));
        }
        let mut edges = HashMap::new();
        for &[a, b, c] in &triangles as &Vec<[u32; 3]> {
            for edge in [(a, b), (b, c), (c, a)] {
                *edges.entry(edge).or_insert(0) += 1;
            }
        }
        Self { triangles, points: numbers.len(), edges }
    }

    /// Vertices less edges plus faces, for a closed mesh.
    fn euler(&self) -> i64 {
        self.points as i64 - self.edges.len() as i64 / 2 + self.triangles.len() as i64
    }

    fn components(&self) -> usize {
        let mut parents: Vec<u32> = (0..self.points as u32).collect();
        fn root(parents: &mut [u32], mut v: u32) -> u32 {
            while parents[v as usize] != v {
                parents[v as usize] = parents[parents[v as usize] as usize];
                v = parents[v as usize];
            }
            v
        }
        for &(a, b) in self.edges.keys() {
            let (a, b) = (root(&mut parents, a), root(&mut parents, b));
            parents[a as usize] = b;
        }
        (0..self.points as u32).filter(|&v| root(&mut parents, v) == v).count()
    }
}

/// Equal for the same place; adding zero makes -0 and 0 the same.
fn bits(p: Vec3) -> [u32; 3] {
    (p + 0.0).to_array().map(f32::to_bits)
}

fn corners(mesh: &RawMesh, face: [u32; 3]) -> [Vec3; 3] {
    face.map(|i| mesh.positions[i as usize])
}

fn smallest_angle([a, b, c]: [Vec3; 3]) -> f32 {
    [(a, b, c), (b, c, a), (c, a, b)]
        .map(|(p, q, r)| (q - p).angle_between(r - p).to_degrees())
        .into_iter()
        .fold(180.0, f32::min)
}

#[test]
fn counts_are_within_fifteen_percent() {
    for sample in Sample::ALL {
        for wanted in [1_000, 20_000, 200_000] {
            let wanted = sample.least_triangles().max(wanted);
            let got = built(sample, wanted).triangles.len() as f64;
            assert!((got / wanted as f64 - 1.0).abs() <= 0.15, "{}: {got} for {wanted}", sample.name());
        }
        let least = built(sample, 0).triangles.len();
        assert!(least <= sample.least_triangles() * 23 / 20, "{}: {least} at least", sample.name());
    }
    assert_eq!(built(Sample::Quad, 0).triangles.len(), 2);
    assert_eq!(built(Sample::Cube, 0).triangles.len(), 12);
}

#[test]
fn arrays_agree_and_values_are_finite() {
    for sample in Sample::ALL {
        let mesh = built(sample, 3_000);
        let count = mesh.positions.len();
        assert_eq!(mesh.normals.len(), count, "{}", sample.name());
        assert!(mesh.uvs.is_empty() || mesh.uvs.len() == count, "{}", sample.name());
        assert!(mesh.positions.iter().all(|p| p.is_finite()) && mesh.uvs.iter().all(|uv| uv.is_finite()));
        assert!(mesh.normals.iter().all(|n| (n.length() - 1.0).abs() < 1e-5), "{}", sample.name());
        let mut used = vec![false; count];
        mesh.triangles.iter().flatten().for_each(|&i| used[i as usize] = true);
        assert!(used.iter().all(|&u| u), "{} has vertices without triangles", sample.name());
        let mut end = 0;
        for part in &mesh.parts {
            assert_eq!(part.triangles.start, end);
            end = part.triangles.end;
        }
        assert_eq!(end, mesh.triangles.len());
    }
}

#[test]
fn the_box_is_about_the_origin_with_a_longest_side_of_two() {
    for sample in Sample::ALL {
        let mesh = built(sample, 20_000);
        let (low, high) = mesh.positions.iter().fold((Vec3::MAX, Vec3::MIN), |(l, h), &p| (l.min(p), h.max(p)));
        // Rings of corners fall short of round outlines by (π/n)²/2, and the knot is a little lower than high.
        assert!(((high - low).max_element() - 2.0).abs() < 0.1, "{}: {low} {high}", sample.name());
        assert!((high + low).abs().max_element() < 0.2, "{}: {low} {high}", sample.name());
    }
}

#[test]
fn closed_samples_are_manifold_and_oriented() {
    for sample in CLOSED {
        for wanted in [sample.least_triangles(), 1_000, 20_000] {
            let mesh = built(sample, wanted);
            let welded = Welded::new(&mesh);
            for (&(a, b), &count) in &welded.edges {
                let back = welded.edges.get(&(b, a));
                assert_eq!((count, back), (1, Some(&1)), "{} at {wanted}", sample.name());
            }
            let volume: f64 = mesh
                .triangles
                .iter()
                .map(|&face| corners(&mesh, face).map(Vec3::as_dvec3))
                .map(|[a, b, c]| a.dot(b.cross(c)) / 6.0)
                .sum();
            assert!(volume > 0.05, "{}: volume {volume}", sample.name());
        }
    }
}

#[test]
fn topology_is_what_the_form_says() {
    let cases = [
        (Sample::Sphere, 2, 1),
        (Sample::Cube, 2, 1),
        (Sample::Cylinder, 2, 1),
        (Sample::Torus, 0, 1),
        (Sample::TorusKnot, 0, 1),
        (Sample::Hand, 2, 1),
        (Sample::Head, 2, 1),
        (Sample::Chair, 26, 13),
    ];
    for (sample, euler, components) in cases {
        for wanted in [1_000, 20_000, 200_000] {
            let welded = Welded::new(&built(sample, wanted));
            assert_eq!((welded.euler(), welded.components()), (euler, components), "{} at {wanted}", sample.name());
        }
    }
    // The gyroid's handles depend on its cut, not on its resolution.
    let handles = [20_000, 200_000].map(|wanted| Welded::new(&built(Sample::Gyroid, wanted)));
    assert_eq!(handles[0].euler(), handles[1].euler());
    assert_eq!(handles.map(|welded| welded.components()), [1, 1]);
}

#[test]
fn the_teapot_is_open_only_where_its_patches_are() {
    let welded = Welded::new(&built(Sample::Teapot, 20_000));
    let mut next = HashMap::new();
    for (&(a, b), &count) in &welded.edges {
        assert_eq!(count, 1);
        if !welded.edges.contains_key(&(b, a)) {
            assert_eq!(next.insert(b, a), None, "a border passes a point twice");
        }
    }
    let mut borders = 0;
    while let Some((&start, _)) = next.iter().next() {
        let mut at = start;
        while let Some(to) = next.remove(&at) {
            at = to;
        }
        assert_eq!(at, start);
        borders += 1;
    }
    // Rim, lid, both ends of the handle, both of the spout.
    assert_eq!((borders, welded.components()), (6, 4));
}

#[test]
fn triangles_have_area_and_face_with_their_normals() {
    for sample in Sample::ALL {
        for wanted in [1_000, 20_000] {
            let mesh = built(sample, wanted);
            let mean = 1.0 / mesh.triangles.len() as f32;
            let mut against = 0;
            for &face in &mesh.triangles {
                let [a, b, c] = corners(&mesh, face);
                let double_area = (b - a).cross(c - a);
                assert!(double_area.length() > 1e-4 * mean, "{}: {a} {b} {c}", sample.name());
                against += usize::from(face.iter().any(|&i| mesh.normals[i as usize].dot(double_area) <= 0.0));
            }
            // Creases of hand and head, and the lips of the teapot's rim and spout, turn by more than a right angle
            // within a triangle.
            let allowed = match sample {
                Sample::Teapot => mesh.triangles.len() / if wanted < 20_000 { 8 } else { 100 },
                _ if IMPLICIT.contains(&sample) => mesh.triangles.len() / 200,
                _ => 0,
            };
            assert!(against <= allowed, "{} at {wanted}: {against} against their normals", sample.name());
        }
    }
}

#[test]
fn implicit_samples_have_no_slivers() {
    for sample in IMPLICIT {
        for wanted in [3_000, 20_000, 200_000] {
            let mesh = built(sample, wanted);
            let mut angles: Vec<f32> =
                mesh.triangles.iter().map(|&face| smallest_angle(corners(&mesh, face))).collect();
            angles.sort_by(f32::total_cmp);
            let percentile = angles[angles.len() / 100];
            // Marching cubes leaves 1° to 3° here; a half square has 45°.
            assert!(percentile > 12.0, "{} at {wanted}: {percentile}°", sample.name());
            let median = angles[angles.len() / 2];
            assert!(median > 32.0, "{} at {wanted}: {median}°", sample.name());
        }
    }
}

#[test]
fn the_sphere_is_round_and_the_torus_is_a_torus() {
    let sphere = built(Sample::Sphere, 20_000);
    // Rounding of unit vectors in single precision.
    assert!(sphere.positions.iter().all(|p| (p.length() - 1.0).abs() < 3e-7));
    for p in built(Sample::Torus, 20_000).positions.clone() {
        let off = (p.truncate().length() - 0.7).hypot(p.z) - 0.3;
        assert!(off.abs() < 2e-6, "{p}: {off}");
    }
}

/// Per triangle whose uv area is not tiny: lengths on the surface of one unit of u and of v, and the handedness.
fn unit_lengths(mesh: &RawMesh) -> Vec<(f32, f32, f32)> {
    let mut all = Vec::new();
    for &face in &mesh.triangles {
        let [a, b, c] = corners(mesh, face);
        let [ua, ub, uc] = face.map(|i| mesh.uvs[i as usize]);
        let (e, f) = (b - a, c - a);
        let (ue, uf) = (ub - ua, uc - ua);
        let area = ue.perp_dot(uf);
        if area.abs() > 1e-8 {
            let along_u = (e * uf.y - f * ue.y) / area;
            let along_v = (f * ue.x - e * uf.x) / area;
            all.push((along_u.length(), along_v.length(), area.signum()));
        }
    }
    all
}

#[test]
fn uv_units_are_about_as_long_both_ways_and_not_mirrored() {
    for sample in Sample::ALL {
        let mesh = built(sample, 20_000);
        if mesh.uvs.is_empty() {
            assert!(IMPLICIT.contains(&sample));
            continue;
        }
        let units = unit_lengths(&mesh);
        assert!(units.len() > mesh.triangles.len() * 9 / 10, "{}", sample.name());
        assert!(units.iter().all(|&(.., hand)| hand > 0.0), "{} mirrors its tile", sample.name());
        let median = |mut lengths: Vec<f32>| {
            lengths.sort_by(f32::total_cmp);
            lengths[lengths.len() / 2]
        };
        let u = median(units.iter().map(|unit| unit.0).collect());
        let v = median(units.iter().map(|unit| unit.1).collect());
        // The chair's rods are thinner than a unit is around.
        let lengths = if sample == Sample::Chair { 0.1..0.65 } else { 0.35..0.65 };
        assert!(lengths.contains(&u) && lengths.contains(&v), "{}: {u} {v}", sample.name());
        assert!((u / v - 1.0).abs() < 0.45, "{}: {u} by {v}", sample.name());
    }
}

#[test]
fn uv_is_continuous_or_jumps_by_whole_tiles() {
    // Caps, the cube's faces and the boards' ends are islands: seams there are stated.
    for sample in [Sample::Quad, Sample::Sphere, Sample::Torus, Sample::TorusKnot, Sample::Teapot] {
        let mesh = built(sample, 10_000);
        let mut at: HashMap<([u32; 3], usize), Vec<Vec2>> = HashMap::new();
        for (index, part) in mesh.parts.iter().enumerate() {
            for &corner in mesh.triangles[part.triangles.clone()].iter().flatten() {
                let (p, uv) = (mesh.positions[corner as usize], mesh.uvs[corner as usize]);
                at.entry((bits(p), index)).or_default().push(uv);
            }
        }
        for uvs in at.values() {
            // Poles have many: their v agrees.
            let pole = uvs.len() > 8;
            for uv in uvs {
                let jump = *uv - uvs[0];
                let off = (jump - jump.round()).abs();
                assert!(off.y < 1e-4 && (pole || off.x < 1e-4), "{}: {uvs:?}", sample.name());
            }
        }
        let longest = mesh
            .triangles
            .iter()
            .flat_map(|&[a, b, c]| [(a, b), (b, c), (c, a)])
            .map(|(a, b)| mesh.uvs[a as usize].distance(mesh.uvs[b as usize]));
        let longest = longest.fold(0.0, f32::max);
        assert!(longest < 0.5, "{}: an edge spans {longest} tiles", sample.name());
    }
}

#[test]
fn meshes_are_the_same_on_any_number_of_threads() {
    for sample in Sample::ALL {
        let pool = |threads| rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("threads start");
        let [one, three] = [1, 3].map(|threads| pool(threads).install(|| sample.build(5_000)));
        assert_eq!(one.positions, three.positions, "{}", sample.name());
        assert_eq!(one.triangles, three.triangles, "{}", sample.name());
        assert_eq!(one.uvs, three.uvs, "{}", sample.name());
    }
}

#[test]
fn the_chair_has_named_parts_with_wood_colours() {
    let chair = built(Sample::Chair, 20_000);
    assert_eq!(chair.parts.len(), 13);
    let mut names: Vec<&str> = chair.parts.iter().map(|part| part.name.as_str()).collect();
    names.sort_unstable();
    names.dedup();
    assert_eq!(names.len(), 13);
    for part in &chair.parts {
        let [r, g, b] = part.colour.expect("wood has a colour");
        assert!(r > g && g > b && b > 0.0, "{} is not brown", part.name);
    }
}

#[test]
fn names_find_their_sample() {
    for sample in Sample::ALL {
        assert_eq!(Sample::named(sample.name()), Some(sample));
        assert_eq!(built(sample, sample.least_triangles()).name, sample.name());
        assert!(!sample.description().is_empty());
    }
    assert_eq!(Sample::named("bunny"), None);
}

#[test]
fn samples_have_nothing_to_note() {
    for sample in Sample::ALL {
        let raw = built(sample, sample.default_triangles());
        let report = prepare(RawMesh::clone(&raw)).expect("a mesh").report;
        assert!(report.notes().is_empty(), "{}: {:?}", sample.name(), report.notes());
    }
}
