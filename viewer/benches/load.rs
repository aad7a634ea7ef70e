//! What it costs to load half a million triangles, by kind of file, and to prepare them alone, with criterion.

#![allow(missing_docs)]

use std::fmt::Write;
use std::hint::black_box;

use criterion::{BatchSize, Criterion, Throughput, criterion_group, criterion_main};
use tam_viewer::mesh::{Kind, load, prepare, read_raw};

const STEPS: u32 = 500;

/// A torus of 2 · 500 · 500 triangles.
fn torus() -> (Vec<[f32; 3]>, Vec<[u32; 3]>) {
    let (mut points, mut faces) = (Vec::new(), Vec::new());
    for i in 0..STEPS {
        for j in 0..STEPS {
            let angle = |at: u32| (at as f32 / STEPS as f32 * std::f32::consts::TAU).sin_cos();
            let ((su, cu), (sv, cv)) = (angle(i), angle(j));
            points.push([(3.0 + cv) * cu, (3.0 + cv) * su, sv]);
            let at = |i: u32, j: u32| (i % STEPS) * STEPS + j % STEPS;
            let [a, b, c, d] = [at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)];
            faces.extend([[a, b, c], [a, c, d]]);
        }
    }
    (points, faces)
}

fn bytes(numbers: impl IntoIterator<Item = f32>) -> Vec<u8> {
    numbers.into_iter().flat_map(f32::to_le_bytes).collect()
}

fn obj(points: &[[f32; 3]], faces: &[[u32; 3]]) -> Vec<u8> {
    let mut text = String::new();
    for [x, y, z] in points {
        let _ = writeln!(text, "v {x:.6} {y:.6} {z:.6}\nvn {x:.4} {y:.4} {z:.4}\nvt {x:.6} {y:.6}");
    }
    for face in faces {
        let [a, b, c] = face.map(|vertex| vertex + 1);
        let _ = writeln!(text, "f {a}/{a}/{a} {b}/{b}/{b} {c}/{c}/{c}");
    }
    text.into_bytes()
}

fn ply(points: &[[f32; 3]], faces: &[[u32; 3]], text: bool) -> Vec<u8> {
    let format = if text { "ascii" } else { "binary_little_endian" };
    let mut file = format!(
        "ply\nformat {format} 1.0\nelement vertex {}\nproperty float x\nproperty float y\nproperty float z\n\
         element face {}\nproperty list uchar int vertex_indices\nend_header\n",
        points.len(),
        faces.len()
    )
    .into_bytes();
    if text {
        points.iter().for_each(|[x, y, z]| file.extend(format!("{x} {y} {z}\n").into_bytes()));
        faces.iter().for_each(|[a, b, c]| file.extend(format!("3 {a} {b} {c}\n").into_bytes()));
        return file;
    }
    file.extend(bytes(points.iter().flatten().copied()));
    for face in faces {
        file.push(3);
        file.extend(face.iter().flat_map(|vertex| vertex.to_le_bytes()));
    }
    file
}

fn stl(points: &[[f32; 3]], faces: &[[u32; 3]], text: bool) -> Vec<u8> {
    if text {
        let mut file = String::from("solid torus\n");
        for face in faces {
            file += "facet normal 0 0 0\nouter loop\n";
            for [x, y, z] in face.map(|vertex| points[vertex as usize]) {
                let _ = writeln!(file, "vertex {x:e} {y:e} {z:e}");
            }
            file += "endloop\nendfacet\n";
        }
        return (file + "endsolid torus\n").into_bytes();
    }
    let mut file = vec![b' '; 80];
    file.extend((faces.len() as u32).to_le_bytes());
    for face in faces {
        file.extend([0; 12]);
        file.extend(bytes(face.iter().flat_map(|&vertex| points[vertex as usize])));
        file.extend([0; 2]);
    }
    file
}

fn glb(points: &[[f32; 3]], faces: &[[u32; 3]]) -> Vec<u8> {
    let mut blob = bytes(points.iter().flatten().copied());
    let split = blob.len();
    blob.extend(faces.iter().flatten().flat_map(|vertex| vertex.to_le_bytes()));
    let mut json = format!(
        r#"{{"asset":{{"version":"2.0"}},"nodes":[{{"mesh":0}}],
        "meshes":[{{"primitives":[{{"attributes":{{"POSITION":0}},"indices":1}}]}}],
        "buffers":[{{"byteLength":{}}}],
        "bufferViews":[{{"buffer":0,"byteLength":{split}}},{{"buffer":0,"byteOffset":{split},"byteLength":{}}}],
        "accessors":[{{"bufferView":0,"componentType":5126,"count":{},"type":"VEC3"}},
                     {{"bufferView":1,"componentType":5125,"count":{},"type":"SCALAR"}}]}}"#,
        blob.len(),
        blob.len() - split,
        points.len(),
        faces.len() * 3
    )
    .into_bytes();
    json.resize(json.len().next_multiple_of(4), b' ');
    let mut file = b"glTF".to_vec();
    file.extend([2, 28 + json.len() as u32 + blob.len() as u32, json.len() as u32].map(u32::to_le_bytes).concat());
    file.extend(b"JSON");
    file.extend(json);
    file.extend((blob.len() as u32).to_le_bytes());
    file.extend(b"BIN\0");
    file.extend(blob);
    file
}

/// File to mesh, and the two halves of it.
fn loading(criterion: &mut Criterion) {
    let (points, faces) = torus();
    let folder = std::env::temp_dir().join(format!("tam-viewer-bench-{}", std::process::id()));
    std::fs::create_dir_all(&folder).expect("a temporary folder");
    let mut group = criterion.benchmark_group("load");
    group.sample_size(10).throughput(Throughput::Elements(faces.len() as u64));
    for (name, kind, file) in [
        ("obj", Kind::Obj, obj(&points, &faces)),
        ("binary.ply", Kind::Ply, ply(&points, &faces, false)),
        ("text.ply", Kind::Ply, ply(&points, &faces, true)),
        ("binary.stl", Kind::Stl, stl(&points, &faces, false)),
        ("text.stl", Kind::Stl, stl(&points, &faces, true)),
        ("glb", Kind::Gltf, glb(&points, &faces)),
    ] {
        let extension = name.rsplit('.').next().unwrap_or(name);
        let path = folder.join(format!("{}.{extension}", name.replace('.', "-")));
        std::fs::write(&path, &file).expect("a temporary file");
        group.bench_function(name, |bencher| bencher.iter(|| load(black_box(&path)).expect("a mesh")));
        let nothing = |_: &str| Err(std::io::ErrorKind::NotFound.into());
        let raw = read_raw(&file, kind, &nothing).expect("a mesh");
        group.bench_function(format!("prepare {name}"), |bencher| {
            bencher.iter_batched(|| raw.clone(), |raw| prepare(raw).expect("a mesh"), BatchSize::LargeInput);
        });
    }
    group.finish();
    std::fs::remove_dir_all(&folder).expect("the temporary folder");
}

criterion_group!(benches, loading);
criterion_main!(benches);
