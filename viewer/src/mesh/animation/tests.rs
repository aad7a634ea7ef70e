use glam::Vec3;

use crate::mesh::test_files::{blob, glb, scene};
use crate::mesh::{Kind, Loaded, MeshError, invariants, prepare, read_raw};

fn animated(json: &str, added: &[f32]) -> Result<Loaded, MeshError> {
    let raw = read_raw(&glb(json, &blob(added)), Kind::Gltf, &|_| Err(std::io::ErrorKind::NotFound.into()))?;
    let loaded = prepare(raw)?;
    invariants::check(&loaded.mesh);
    Ok(loaded)
}

fn positions(loaded: &Loaded, time_s: f64) -> Vec<Vec3> {
    let mut out = Vec::new();
    loaded.mesh.animation.as_ref().expect("an animation").positions_at(time_s, &mut out);
    out
}

/// A view of `floats` numbers after `before` others, and an accessor of it.
fn more(before: usize, floats: usize, count: usize, kind: &str) -> (String, String) {
    let at = 72 + before * 4;
    (
        format!(r#",{{"buffer":0,"byteOffset":{at},"byteLength":{}}}"#, floats * 4),
        format!(r#",{{"bufferView":VIEW,"componentType":5126,"count":{count},"type":"{kind}"}}"#),
    )
}

/// JSON with accessors 2, 3, … of the given numbers, and the numbers.
fn scene_with(nodes: &str, primitive: &str, data: &[(&[f32], usize, &str)], rest: &str) -> (String, Vec<f32>) {
    let (mut views, mut accessors, mut numbers) = (String::new(), String::new(), Vec::new());
    for (at, &(values, count, kind)) in data.iter().enumerate() {
        let (view, accessor) = more(numbers.len(), values.len(), count, kind);
        views += &view;
        accessors += &accessor.replace("VIEW", &(at + 2).to_string());
        numbers.extend_from_slice(values);
    }
    (scene(72 + numbers.len() * 4, nodes, primitive, &views, &accessors, rest), numbers)
}

#[test]
fn a_node_moves_its_mesh_and_the_clip_repeats() {
    let rest = r#","animations":[{"name":"rise","channels":[{"sampler":0,"target":{"node":0,"path":"translation"}}],
        "samplers":[{"input":2,"output":3}]},{"channels":[],"samplers":[]}]"#;
    let (json, numbers) =
        scene_with(r#"{"mesh":0}"#, "", &[(&[0., 2.], 2, "SCALAR"), (&[0., 0., 0., 0., 0., 8.], 2, "VEC3")], rest);
    let loaded = animated(&json, &numbers).expect("an animation");
    let animation = loaded.mesh.animation.as_ref().expect("an animation");
    assert_eq!((animation.name(), animation.duration_s()), ("rise", 2.0));
    assert_eq!(positions(&loaded, 0.5)[0], Vec3::new(0.0, 0.0, 2.0));
    assert_eq!(positions(&loaded, 4.5), positions(&loaded, 0.5));
    assert_eq!(positions(&loaded, -1.5), positions(&loaded, 0.5));
    assert_eq!(positions(&loaded, f64::NAN), positions(&loaded, 0.0));
    assert_eq!(loaded.report.reader_notes.len(), 1, "the second clip is mentioned");
    // Mesh coordinates: the rest pose's box of side 1 has side 2.
    let mut posed = Vec::new();
    loaded.mesh.pose(0.5, &mut posed);
    for (posed, rest) in posed.iter().zip(&loaded.mesh.positions) {
        assert!(posed.distance(*rest + Vec3::Z * 4.0) < 1e-6);
    }
}

#[test]
fn morph_targets_add_up_by_their_weights() {
    let rest = r#","animations":[{"channels":[{"sampler":0,"target":{"node":0,"path":"weights"}}],
        "samplers":[{"input":3,"output":4,"interpolation":"STEP"}]}]"#;
    let offsets: Vec<f32> = (0..4).flat_map(|_| [1.0, 0.0, 0.0]).collect();
    let data: [(&[f32], usize, &str); 3] =
        [(&offsets, 4, "VEC3"), (&[0., 1.], 2, "SCALAR"), (&[0., 0.25, 1.0, 0.5], 4, "SCALAR")];
    let (json, numbers) = scene_with(r#"{"mesh":0,"weights":[0.5,0]}"#, "", &data, rest);
    let json = json.replace(r#""indices":1"#, r#""indices":1,"targets":[{"POSITION":2},{"POSITION":2}]"#);
    let loaded = animated(&json, &numbers).expect("an animation");
    // At rest by the node's weights, at time 0 by the first key's.
    assert_eq!(loaded.mesh.placement.centre.x, 1.0);
    assert_eq!(positions(&loaded, 0.9)[0], Vec3::X * 0.25);
}

/// The vertices hang on joint 1, but the first, which hangs on joint 0.
fn skinned(rotation: &[f32; 4]) -> Result<Loaded, MeshError> {
    let rest = r#","skins":[{"joints":[1,2],"inverseBindMatrices":4}],"animations":[{"channels":[
        {"sampler":0,"target":{"node":2,"path":"rotation"}}],"samplers":[{"input":5,"output":6}]}]"#;
    let nodes = r#"{"mesh":0,"skin":0,"children":[1],"translation":[50,0,0]},{"children":[2],"translation":[-50,0,0]},
        {"translation":[1,0,0]}"#;
    let joints: Vec<f32> = [[0_u8, 1, 0, 0], [1, 0, 0, 0], [1, 0, 0, 0], [1, 0, 0, 0]].map(f32::from_le_bytes).to_vec();
    // Weights that do not sum to one are brought to it.
    let weights: Vec<f32> = (0..4).flat_map(|_| [0.5, 0.0, 0.0, 0.0]).collect();
    let bind = |x: f32| glam::Mat4::from_translation(Vec3::new(x, 0.0, 0.0)).to_cols_array();
    let matrices = [bind(0.0), bind(-1.0)].concat();
    let turn = [[0.0, 0.0, 0.0, 1.0], *rotation].concat();
    let data: [(&[f32], usize, &str); 5] = [
        (&joints, 4, "VEC4"),
        (&weights, 4, "VEC4"),
        (&matrices, 2, "MAT4"),
        (&[0., 1.], 2, "SCALAR"),
        (&turn, 2, "VEC4"),
    ];
    let (json, numbers) = scene_with(nodes, r#","JOINTS_0":2,"WEIGHTS_0":3"#, &data, rest);
    let bytes_of_joints =
        json.replace(r#""bufferView":2,"componentType":5126"#, r#""bufferView":2,"componentType":5121"#);
    animated(&bytes_of_joints, &numbers)
}

#[test]
fn joints_take_their_vertices_along() {
    let loaded = skinned(&glam::Quat::from_rotation_z(std::f32::consts::FRAC_PI_2).to_array()).expect("a skin");
    // The node's own place does not count; at rest the mesh lies where it was bound.
    assert_eq!(loaded.mesh.placement.centre, glam::DVec3::splat(0.5));
    // Halfway, the joint at (1, 0, 0) has turned by 45 degrees.
    let turned = positions(&loaded, 0.5);
    let half = std::f32::consts::FRAC_1_SQRT_2;
    let expected = [Vec3::ZERO, Vec3::X, Vec3::new(1.0 - 2.0 * half, 0.0, 0.0), Vec3::new(1.0 - half, -half, 1.0)];
    for (turned, expected) in turned.iter().zip(expected) {
        assert!(turned.distance(expected) < 1e-5, "{turned} {expected}");
    }
}

#[test]
fn keys_that_make_no_sense_are_an_error() {
    let error = skinned(&[f32::NAN, 0.0, 0.0, 1.0]).expect_err("a key that is no number");
    assert!(error.to_string().contains("node 2"), "{error}");
}

#[test]
fn an_animated_mesh_keeps_vertices_that_may_part() {
    let rest = r#","animations":[{"channels":[{"sampler":0,"target":{"node":1,"path":"translation"}}],
        "samplers":[{"input":2,"output":3}]}]"#;
    let nodes = r#"{"mesh":0,"children":[1]},{"mesh":0,"scale":[-1,1,1]}"#;
    let (json, numbers) =
        scene_with(nodes, "", &[(&[0., 1.], 2, "SCALAR"), (&[0., 0., 0., -1., 0., 0.], 2, "VEC3")], rest);
    let loaded = animated(&json, &numbers).expect("an animation");
    let mut posed = Vec::new();
    loaded.mesh.pose(0.999, &mut posed);
    let apart = |a: u32, b: u32| {
        let at = |source| loaded.mesh.sources.iter().position(|&found| found == source).expect("kept");
        posed[at(a)].distance(posed[at(b)])
    };
    // The two tetrahedra share a corner at rest; one has moved by one unit, which is one in a box of side 2.
    assert!((apart(0, 4) - 0.999).abs() < 1e-5);
}
