//! Small files of every kind, made for the tests.

use std::fmt::Write;

use super::Kind;

/// A tetrahedron.
pub(super) const POINTS: [[f32; 3]; 4] = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
pub(super) const FACES: [[u32; 3]; 4] = [[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]];

pub(super) fn obj() -> Vec<u8> {
    let mut text = String::from("# tetrahedron\nmtllib none.mtl\no tetra\nusemtl red\n");
    for [x, y, z] in POINTS {
        let _ = writeln!(text, "v {x} {y} {z}\nvt {x} {y}\nvn {x} {y} {z}");
    }
    for face in FACES {
        let corners: Vec<String> = face.iter().map(|vertex| vertex + 1).map(|i| format!("{i}/{i}/{i}")).collect();
        let _ = writeln!(text, "f {}", corners.join(" "));
    }
    text.into_bytes()
}

pub(super) fn ply(encoding: &str) -> Vec<u8> {
    let mut bytes = format!(
        "ply\nformat {encoding} 1.0\ncomment tetrahedron\nelement vertex 4\nproperty float x\nproperty float y\n\
         property float z\nproperty double s\nproperty double t\nelement face 4\nproperty uchar quality\n\
         property list uchar int vertex_indices\nend_header\n"
    )
    .into_bytes();
    let big = encoding == "binary_big_endian";
    for [x, y, z] in POINTS {
        if encoding == "ascii" {
            bytes.extend_from_slice(format!("{x} {y} {z} {x} {y}\n").as_bytes());
            continue;
        }
        for value in [x, y, z] {
            bytes.extend_from_slice(&if big { value.to_be_bytes() } else { value.to_le_bytes() });
        }
        for value in [x, y].map(f64::from) {
            bytes.extend_from_slice(&if big { value.to_be_bytes() } else { value.to_le_bytes() });
        }
    }
    for face in FACES {
        if encoding == "ascii" {
            bytes.extend_from_slice(format!("7 3 {} {} {}\n", face[0], face[1], face[2]).as_bytes());
            continue;
        }
        bytes.extend_from_slice(&[7, 3]);
        for value in face.map(|vertex| vertex as i32) {
            bytes.extend_from_slice(&if big { value.to_be_bytes() } else { value.to_le_bytes() });
        }
    }
    bytes
}

pub(super) fn stl_text() -> Vec<u8> {
    let mut text = String::from("solid tetra\n");
    for face in FACES {
        text += " facet normal 0 0 0\n  outer loop\n";
        for [x, y, z] in face.map(|vertex| POINTS[vertex as usize]) {
            let _ = writeln!(text, "   vertex {x:e} {y:e} {z:e}");
        }
        text += "  endloop\n endfacet\n";
    }
    (text + "endsolid tetra\n").into_bytes()
}

/// Its comment begins with "solid", as some programs write it.
pub(super) fn stl_binary() -> Vec<u8> {
    let mut bytes = b"solid but binary".to_vec();
    bytes.resize(80, b' ');
    bytes.extend_from_slice(&4_u32.to_le_bytes());
    for face in FACES {
        bytes.extend_from_slice(&[0; 12]);
        for value in face.iter().flat_map(|&vertex| POINTS[vertex as usize]) {
            bytes.extend_from_slice(&value.to_le_bytes());
        }
        bytes.extend_from_slice(&[0; 2]);
    }
    bytes
}

/// A GLB of this JSON and binary chunk.
pub(super) fn glb(json: &str, blob: &[u8]) -> Vec<u8> {
    let mut json = json.as_bytes().to_vec();
    json.resize(json.len().next_multiple_of(4), b' ');
    let mut bytes = b"glTF".to_vec();
    for word in [2, 28 + json.len() as u32 + blob.len() as u32, json.len() as u32] {
        bytes.extend_from_slice(&word.to_le_bytes());
    }
    bytes.extend_from_slice(b"JSON");
    bytes.extend_from_slice(&json);
    bytes.extend_from_slice(&(blob.len() as u32).to_le_bytes());
    bytes.extend_from_slice(b"BIN\0");
    bytes.extend_from_slice(blob);
    bytes
}

/// Positions (48 bytes), then indices (24 bytes), then what is added.
pub(super) fn blob(added: &[f32]) -> Vec<u8> {
    let mut blob: Vec<u8> = POINTS.iter().flatten().flat_map(|value| value.to_le_bytes()).collect();
    blob.extend(FACES.iter().flatten().flat_map(|&vertex| (vertex as u16).to_le_bytes()));
    blob.extend(added.iter().flat_map(|value| value.to_le_bytes()));
    blob
}

/// JSON of a scene of the tetrahedron; `views` and `accessors` follow the first two, `rest` closes the object.
pub(super) fn scene(bytes: usize, nodes: &str, primitive: &str, views: &str, accessors: &str, rest: &str) -> String {
    format!(
        r#"{{"asset":{{"version":"2.0"}},"scene":0,"scenes":[{{"nodes":[0]}}],"nodes":[{nodes}],
        "meshes":[{{"primitives":[{{"attributes":{{"POSITION":0{primitive}}},"indices":1,"material":0}}]}}],
        "materials":[{{"name":"red","pbrMetallicRoughness":{{"baseColorFactor":[1,0.5,0,1]}}}}],
        "buffers":[{{"byteLength":{bytes}}}],
        "bufferViews":[{{"buffer":0,"byteLength":48}},{{"buffer":0,"byteOffset":48,"byteLength":24}}{views}],
        "accessors":[{{"bufferView":0,"componentType":5126,"count":4,"type":"VEC3"}},
                     {{"bufferView":1,"componentType":5123,"count":12,"type":"SCALAR"}}{accessors}]{rest}}}"#
    )
}

pub(super) fn gltf_binary() -> Vec<u8> {
    let json = scene(
        72,
        r#"{"name":"tetra","mesh":0,"children":[1],"translation":[0,0,1]},{"scale":[2,2,2]}"#,
        "",
        "",
        "",
        "",
    );
    glb(&json, &blob(&[]))
}

/// One of each.
pub(super) fn all() -> Vec<(Kind, Vec<u8>)> {
    vec![
        (Kind::Obj, obj()),
        (Kind::Ply, ply("ascii")),
        (Kind::Ply, ply("binary_little_endian")),
        (Kind::Ply, ply("binary_big_endian")),
        (Kind::Stl, stl_text()),
        (Kind::Stl, stl_binary()),
        (Kind::Gltf, gltf_binary()),
    ]
}
