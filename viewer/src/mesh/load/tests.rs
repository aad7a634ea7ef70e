use std::io;

use glam::Vec3;

use super::{Kind, load, read_raw};
use crate::mesh::test_files::{self, FACES, POINTS, blob, glb, scene};
use crate::mesh::{MeshError, RawMesh, invariants, prepare};

fn nothing(_: &str) -> io::Result<Vec<u8>> {
    Err(io::ErrorKind::NotFound.into())
}

fn read(bytes: &[u8], kind: Kind) -> Result<RawMesh, MeshError> {
    read_raw(bytes, kind, &nothing)
}

fn text(kind: Kind, text: &str) -> RawMesh {
    read(text.as_bytes(), kind).expect("a readable file")
}

/// The corners of all triangles, whatever the vertices' order.
fn corners(raw: &RawMesh) -> Vec<[[f32; 3]; 3]> {
    raw.triangles.iter().map(|face| face.map(|vertex| raw.positions[vertex as usize].to_array())).collect()
}

#[test]
fn all_kinds_give_the_same_tetrahedron() {
    for (kind, bytes) in test_files::all() {
        assert_eq!(Kind::from_content(&bytes), Some(kind));
        let raw = read(&bytes, kind).expect("a readable file");
        let lifted = if kind == Kind::Gltf { 1.0 } else { 0.0 };
        let expected =
            FACES.map(|face| face.map(|vertex| (Vec3::from(POINTS[vertex as usize]) + Vec3::Z * lifted).to_array()));
        assert_eq!(corners(&raw), expected, "{kind}");
        let loaded = prepare(raw).expect("a usable mesh");
        invariants::check(&loaded.mesh);
        assert!(loaded.report.closed && loaded.report.flipped == 0 && loaded.report.euler == 2, "{kind}");
    }
}

#[test]
fn every_truncation_is_an_error_or_a_mesh() {
    for (kind, bytes) in test_files::all() {
        for length in 0..bytes.len() {
            if let Ok(loaded) = read(&bytes[..length], kind).and_then(prepare) {
                invariants::check(&loaded.mesh);
            }
        }
        // OBJ has no end and cannot know that lines are missing; the others must.
        let cut = read(&bytes[..bytes.len() * 3 / 4], kind);
        assert!(kind == Kind::Obj || cut.is_err(), "{kind}");
    }
}

#[test]
fn any_changed_bytes_are_an_error_or_a_mesh() {
    let mut state = 1_u64;
    let mut random = move |below: usize| {
        state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (state >> 33) as usize % below
    };
    let mut meshes = 0;
    for (kind, bytes) in test_files::all() {
        for _ in 0..3000 {
            let mut changed = bytes.clone();
            for _ in 0..=random(4) {
                let at = random(changed.len());
                // Half the time a digit, which keeps texts readable and makes their numbers wrong.
                changed[at] = if random(2) == 0 { b'0' + random(10) as u8 } else { random(256) as u8 };
            }
            if let Ok(loaded) = read(&changed, kind).and_then(prepare) {
                invariants::check(&loaded.mesh);
                meshes += 1;
            }
        }
    }
    assert!((1000..20_000).contains(&meshes), "{meshes} of 21000 are still meshes");
}

#[test]
fn obj_counts_from_the_end_cuts_polygons_and_joins_lines() {
    let raw = text(Kind::Obj, "v 0 0 0\nv 1 0 0\r\nv 1 1 0 1.0\nv 0 1 0\nf -4 -3 \\\n-2 -1 # a quad\n\nf 1 2 9\n");
    assert_eq!(raw.triangles[..2], [[0, 1, 2], [0, 2, 3]]);
    assert!(raw.triangles[2].iter().any(|&vertex| vertex as usize >= raw.positions.len()));
    assert_eq!(prepare(raw).expect("a usable mesh").report.dropped_out_of_range, 1);
}

#[test]
fn obj_parts_are_groups_and_materials_with_their_colours() {
    let file = b"mtllib a b.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\no one\nusemtl red\nf 2 3 1\nusemtl blue\nf 3 1 2\nf 1 3 2";
    let resolve = |uri: &str| {
        assert_eq!(uri, "a b.mtl");
        Ok(b"newmtl red\nKd 1 0.5 0\nillum 2\nnewmtl blue\nKd 0 0 7\n".to_vec())
    };
    let raw = read_raw(file, Kind::Obj, &resolve).expect("a readable file");
    let parts: Vec<_> =
        raw.parts.iter().map(|part| (part.name.as_str(), part.colour, part.triangles.clone())).collect();
    assert_eq!(parts, [("", None, 0..1), ("one", Some([1.0, 0.5, 0.0]), 1..2), ("one", Some([0.0, 0.0, 1.0]), 2..4)]);
    let missing = read(file, Kind::Obj).expect("a missing material is no error");
    assert_eq!(missing.notes.len(), 1);
    assert!(missing.notes[0].contains("a b.mtl"), "{}", missing.notes[0]);
}

#[test]
fn obj_corners_without_a_normal_or_uv_have_none() {
    let raw = text(Kind::Obj, "v 0 0 0\nv 1 0 0\nv 0 1 0\nvn 0 0 1\nf 1//1 2//1 3\n");
    assert_eq!(raw.normals, [Vec3::Z, Vec3::Z, Vec3::ZERO]);
    assert!(raw.uvs.is_empty());
}

#[test]
fn ply_reads_strips_and_polygons_and_passes_over_the_rest() {
    let raw = text(
        Kind::Ply,
        "ply\nformat ascii 1.0\nelement camera 1\nproperty list uchar float what\nelement vertex 5\nproperty float x\n\
         property float y\nproperty float z\nelement face 2\nproperty list uchar int vertex_index\nelement tristrips 1\n\
         property list int int vertex_indices\nend_header\n2 0.5 0.5\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n0 0 1\n5 0 1 2 3 4\n\
         2 0 1\n8 0 1 2 3 -1 2 3 4\n",
    );
    assert_eq!(raw.triangles, [[0, 1, 2], [0, 2, 3], [0, 3, 4], [0, 1, 2], [2, 1, 3], [2, 3, 4]]);
    assert_eq!(raw.notes.len(), 1);
}

#[test]
fn ply_counts_that_the_file_cannot_hold_are_refused_at_once() {
    for element in ["vertex 4000000000000", "vertex 99999999999999999999"] {
        let file = format!(
            "ply\nformat binary_little_endian 1.0\nelement {element}\nproperty float x\nproperty float y\n\
             property float z\nend_header\n0123456789ab"
        );
        let error = read(file.as_bytes(), Kind::Ply).expect_err("too few bytes");
        assert!(matches!(error, MeshError::Truncated { .. } | MeshError::Damaged { .. }), "{error}");
    }
}

#[test]
fn stl_of_several_solids_has_a_part_each() {
    let two = [test_files::stl_text(), test_files::stl_text()].concat();
    let raw = read(&two, Kind::Stl).expect("a readable file");
    assert_eq!(raw.parts.iter().map(|part| part.triangles.clone()).collect::<Vec<_>>(), [0..4, 4..8]);
    assert_eq!(raw.parts[0].name, "tetra");
}

#[test]
fn gltf_places_instances_and_mirrors_turn_their_triangles() {
    let nodes = r#"{"mesh":0,"children":[1]},{"mesh":0,"name":"mirror","translation":[5,0,0],"scale":[-1,1,1]}"#;
    let raw = read(&glb(&scene(72, nodes, "", "", "", ""), &blob(&[])), Kind::Gltf).expect("a readable file");
    assert_eq!((raw.positions.len(), raw.triangles.len()), (8, 8));
    assert_eq!(raw.positions[5], Vec3::new(4.0, 0.0, 0.0));
    assert_eq!(raw.triangles[4], [4, 5, 6], "[0, 2, 1] turned, and after the first four vertices");
    assert_eq!((raw.parts[0].name.as_str(), raw.parts[1].name.as_str()), ("red", "mirror"));
    assert_eq!(raw.parts[1].colour, Some([1.0, 0.5, 0.0]));
    assert_eq!(prepare(raw).expect("a usable mesh").report.flipped, 0);
}

#[test]
fn gltf_mirrored_normals_stay_outside() {
    let nodes = r#"{"mesh":0,"scale":[-1,1.1,1]}"#;
    // Normals of the tetrahedron's corners, away from its middle.
    let added: Vec<f32> = POINTS.iter().flat_map(|point| point.map(|value| value - 0.25)).collect();
    let views = r#",{"buffer":0,"byteOffset":72,"byteLength":48}"#;
    let accessors = r#",{"bufferView":2,"componentType":5126,"count":4,"type":"VEC3"}"#;
    let json = scene(120, nodes, r#","NORMAL":2"#, views, accessors, "");
    let raw = read(&glb(&json, &blob(&added)), Kind::Gltf).expect("a readable file");
    let loaded = prepare(raw).expect("a usable mesh");
    assert_eq!((loaded.report.normals_refused, loaded.report.flipped, loaded.report.vertices), (0, 0, 4));
}

#[test]
fn gltf_strips_fans_data_uris_and_sparse_accessors() {
    for (mode, expected) in [(5, vec![[0, 1, 2], [1, 3, 2]]), (6, vec![[1, 2, 0], [2, 3, 0]])] {
        let json = format!(
            r#"{{"asset":{{"version":"2.0"}},"nodes":[{{"mesh":0}}],
            "meshes":[{{"primitives":[{{"attributes":{{"POSITION":0}},"mode":{mode}}}]}}],
            "buffers":[{{"byteLength":16,"uri":"data:application/octet-stream;base64,AQAAAAAAgD8AAAAAAAAAAA=="}}],
            "bufferViews":[{{"buffer":0,"byteLength":1}},{{"buffer":0,"byteOffset":4,"byteLength":12}}],
            "accessors":[{{"componentType":5126,"count":4,"type":"VEC3","sparse":{{"count":1,
              "indices":{{"bufferView":0,"componentType":5121}},"values":{{"bufferView":1}}}}}}]}}"#
        );
        let raw = text(Kind::Gltf, &json);
        assert_eq!(raw.positions, [Vec3::ZERO, Vec3::X, Vec3::ZERO, Vec3::ZERO]);
        assert_eq!(raw.triangles, expected);
    }
}

#[test]
fn gltf_ranges_and_references_are_checked_before_reading() {
    let good = scene(72, r#"{"mesh":0}"#, "", "", "", "");
    assert!(read(&glb(&good, &blob(&[])), Kind::Gltf).is_ok());
    for (from, to) in [
        (r#""count":4"#, r#""count":5"#),
        (r#""count":4"#, r#""count":18446744073709551615"#),
        (r#""byteLength":48"#, r#""byteLength":47"#),
        (r#""byteOffset":48"#, r#""byteOffset":18446744073709551600"#),
        (r#""byteLength":48"#, r#""byteLength":48,"byteStride":4"#),
        (r#""byteLength":48"#, r#""byteLength":48,"byteStride":16"#),
        (r#""bufferView":1"#, r#""bufferView":9"#),
        (r#""indices":1"#, r#""indices":0"#),
        (r#""POSITION":0"#, r#""POSITION":1"#),
        (r#""mesh":0"#, r#""mesh":1"#),
        (r#""mesh":0"#, r#""children":[0]"#),
        (r#""material":0"#, r#""material":3"#),
        (r#""scene":0"#, r#""scene":4"#),
        (r#""byteLength":72"#, r#""byteLength":73"#),
        (r#""mesh":0"#, r#""mesh":0,"skin":0"#),
    ] {
        let json = good.replacen(from, to, 1);
        assert_ne!(json, good, "{from} is there");
        assert!(read(&glb(&json, &blob(&[])), Kind::Gltf).is_err(), "{to}");
    }
}

#[test]
fn gltf_extensions_that_cannot_be_read_are_named() {
    let rest = r#","extensionsRequired":["KHR_materials_unlit","KHR_draco_mesh_compression"]"#;
    let error = read(&glb(&scene(72, r#"{"mesh":0}"#, "", "", "", rest), &blob(&[])), Kind::Gltf).expect_err("draco");
    assert!(error.to_string().contains("KHR_draco_mesh_compression"), "{error}");
}

#[test]
fn a_file_cannot_unfold_without_limit() {
    let nodes: Vec<String> = (0..60_000).map(|_| r#"{"mesh":0}"#.to_owned()).collect();
    let roots: Vec<String> = (0..60_000).map(|at| at.to_string()).collect();
    let json = scene(72, &nodes.join(","), "", "", "", "")
        .replace(r#""nodes":[0]"#, &format!(r#""nodes":[{}]"#, roots.join(",")))
        .replace(r#""count":4"#, r#""count":2000000"#)
        .replace(r#"{"bufferView":0,"#, "{");
    let error = read(&glb(&json, &blob(&[])), Kind::Gltf).expect_err("two million vertices, sixty thousand times");
    assert!(matches!(error, MeshError::TooMany { .. }), "{error}");
}

#[test]
fn files_are_found_by_extension_or_content_and_errors_name_them() {
    let folder = std::env::temp_dir().join(format!("tam-viewer-load-{}", std::process::id()));
    std::fs::create_dir_all(&folder).expect("a temporary folder");
    let write = |name: &str, bytes: &[u8]| {
        let path = folder.join(name);
        std::fs::write(&path, bytes).expect("a temporary file");
        path
    };
    for (at, (_, bytes)) in test_files::all().into_iter().enumerate() {
        let loaded = load(&write(&format!("tetra.{at}"), &bytes)).expect("known by its content");
        assert_eq!((loaded.mesh.name.as_str(), loaded.mesh.triangles.len()), ("tetra", 4));
    }
    let json = scene(72, r#"{"mesh":0}"#, "", "", "", "")
        .replace(r#""byteLength":72"#, r#""byteLength":72,"uri":"a%20b.bin""#);
    let gltf = write("tetra.GLTF", json.as_bytes());
    assert!(matches!(inner(load(&gltf)), MeshError::Resolve { .. }));
    write("a b.bin", &blob(&[]));
    assert!(load(&gltf).expect("with its buffer").report.closed);

    assert!(matches!(inner(load(&folder)), MeshError::Folder));
    assert!(matches!(inner(load(&folder.join("none.obj"))), MeshError::Read(_)));
    assert!(matches!(inner(load(&write("empty.stl", b""))), MeshError::Empty));
    assert!(matches!(inner(load(&write("notes.txt", b"hello"))), MeshError::UnknownKind { .. }));
    for kind in ["obj", "gltf", "glb", "ply", "stl"] {
        let error = load(&write(&format!("photo.{kind}"), b"\x89PNG\r\n\x1a\n")).expect_err("no mesh");
        assert!(error.to_string().contains("photo."), "{error}");
        assert!(matches!(inner(Err(error)), MeshError::WrongKind { .. }));
    }
    std::fs::remove_dir_all(&folder).expect("the temporary folder");
}

fn inner(result: Result<crate::mesh::Loaded, MeshError>) -> MeshError {
    match result.expect_err("an error") {
        MeshError::InFile { source, .. } => *source,
        other => other,
    }
}

#[test]
fn paths_that_lead_anywhere_are_not_followed() {
    assert!(super::relative("/etc/passwd").is_err());
    assert!(super::relative("https://example.org/a.bin").is_err());
    assert_eq!(super::relative(r"textures\a%20b%zz.mtl").expect("relative").to_str(), Some("textures/a b%zz.mtl"));
}

#[test]
fn other_readers_read_the_same() {
    let (models, _) = tobj::load_obj_buf(&mut &test_files::obj()[..], &tobj::GPU_LOAD_OPTIONS, |_| {
        Err(tobj::LoadError::OpenFileFailed)
    })
    .expect("readable for tobj");
    let ours = read(&test_files::obj(), Kind::Obj).expect("readable");
    assert_eq!(models[0].mesh.indices, ours.triangles.as_flattened());
    let flat: Vec<f32> = ours.positions.iter().flat_map(|position| position.to_array()).collect();
    assert_eq!(models[0].mesh.positions, flat);

    let theirs = stl_io::read_stl(&mut io::Cursor::new(test_files::stl_text())).expect("readable for stl_io");
    let theirs: Vec<[[f32; 3]; 3]> =
        theirs.faces.iter().map(|face| face.vertices.map(|vertex| theirs.vertices[vertex].0)).collect();
    assert_eq!(theirs, corners(&read(&test_files::stl_text(), Kind::Stl).expect("readable")));

    use ply_rs_bw::{
        parser::Parser,
        ply::{DefaultElement, Property},
    };
    for encoding in ["ascii", "binary_little_endian", "binary_big_endian"] {
        let file = test_files::ply(encoding);
        let theirs = Parser::<DefaultElement>::new().read_ply(&mut &file[..]).expect("readable for ply-rs-bw");
        let ours = read(&file, Kind::Ply).expect("readable");
        for (vertex, position) in theirs.payload["vertex"].iter().zip(&ours.positions) {
            assert!(matches!(vertex["z"], Property::Float(z) if z == position.z));
        }
        for (face, triangle) in theirs.payload["face"].iter().zip(&ours.triangles) {
            assert!(
                matches!(&face["vertex_indices"], Property::ListInt(list) if *list == triangle.map(|at| at as i32))
            );
        }
    }
}
