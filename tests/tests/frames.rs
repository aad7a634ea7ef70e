//! Frames: no pixel without a number, the same frame twice, a mesh in parts as in one, and small
//! golden pictures.

use std::path::Path;

use glam::{DVec3, dvec3};
use tam_gen::sequence::Draw;
use tam_tests::gpu::{Stage, difference, mappings, nan_count, surface_for, surface_options};
use tam_viewer::gpu::PixelFormat;
use tam_viewer::mesh::sample::Sample;
use tam_viewer::mesh::{Mesh, NONE, Part, prepare};
use tam_viewer::surface::{Surface, SurfaceOptions};
use tam_viewer::{
    Blend, DebugView, FaceFrameForm, Inspect, Light, LightKind, Lights, Mapping, Material, Method, RenderParams, Scene,
    Silhouettes,
};

/// Lights of all kinds, some of them where methods break: in the mesh, on an axis, out of their own cone.
fn random_lights(draw: &mut Draw) -> Lights {
    let place = |draw: &mut Draw| {
        let p = DVec3::from_array(std::array::from_fn(|_| draw.signed()));
        if draw.unit() < 0.2 { p.round() } else { 2.0 * p }
    };
    let count = 1 + (draw.unit() * 7.99) as usize;
    let lights = (0..count)
        .map(|_| {
            let (position, direction) = (place(draw), place(draw));
            let kind = match (draw.unit() * 3.0) as u32 {
                0 => LightKind::Directional { direction },
                1 => LightKind::Positional { position },
                _ => {
                    LightKind::Spot { position, direction, cutoff_deg: draw.unit() * 90.0, exponent: draw.unit() * 8.0 }
                }
            };
            Light { kind, intensity: draw.unit() * 1.5 }
        })
        .collect();
    Lights { ambient: draw.unit() * 0.3, lights }
}

#[test]
fn no_pixel_is_without_a_number_on_any_sample_method_mapping_and_light() {
    let mut stage = Stage::new("fine-pen", 24);
    let target = stage.renderer.target([24, 24], 1, PixelFormat::Linear32).expect("a small target");
    for sample in Sample::ALL {
        let mesh = prepare(sample.build(600)).expect("a sample").mesh;
        let mut gpu_mesh = stage.renderer.mesh(&mesh).expect("a mesh that fits");
        let of = |mapping| surface_options(&RenderParams { mapping, ..RenderParams::default() });
        let stripes = surface_options(&RenderParams { method: Method::Stripes, ..RenderParams::default() }).stripes;
        let options = SurfaceOptions { lapped: of(Mapping::Lapped).lapped, stripes, ..of(Mapping::Patches) };
        let surface = Surface::new(&mesh, &options).expect("a field");
        stage.renderer.attach(&mut gpu_mesh, &surface).expect("a surface that fits");
        for method in Method::ALL {
            for (k, mapping) in mappings(&mesh).into_iter().enumerate() {
                if !method.takes_mapping() && k > 0 {
                    continue;
                }
                let mut draw = Draw::new(7, sample.name());
                for i in 0..100 {
                    let mut scene = Scene { lights: random_lights(&mut draw), ..Scene::default() };
                    scene.camera.azimuth_deg = f64::from(i) * 37.0;
                    scene.camera.elevation_deg = draw.signed() * 90.0;
                    scene.materials[0].specular = draw.unit();
                    let mapping = if method.takes_mapping() { mapping } else { Mapping::Triplanar };
                    let blend = if i % 2 == 0 { Blend::Union } else { Blend::Linear };
                    let params = RenderParams { method, mapping, blend, silhouettes: None, ..RenderParams::default() };
                    stage.renderer.render(&scene, &params, &gpu_mesh, &[&stage.map], &target).expect("a frame");
                    let pixels = target.read(&stage.renderer.gpu).expect("pixels").linear();
                    let what = format!("{} {} {} light {i}", sample.name(), method.name(), mapping.name());
                    assert_eq!(nan_count(&pixels), 0, "{what}");
                    let beyond = pixels.iter().map(|p| p[0]).find(|ink| !(-1e-4..=1.0001).contains(ink));
                    assert_eq!(beyond, None, "beyond paper and ink: {what}");
                }
            }
        }
    }
}

fn view(sample: Sample, triangles: usize) -> (tam_viewer::mesh::Mesh, Scene) {
    let mesh = prepare(sample.build(triangles)).expect("a sample").mesh;
    let mut scene = Scene::of(&mesh);
    scene.camera.distance = 5.0;
    (mesh, scene)
}

#[test]
fn a_frame_is_the_same_twice() {
    for method in Method::ALL {
        let params = RenderParams { method, ..RenderParams::default() };
        let picture = || {
            let mut stage = Stage::new("pencil", 96);
            let (mesh, scene) = view(Sample::TorusKnot, 3000);
            let mesh = stage.upload(&params, &mesh, surface_for(&params, &mesh).as_ref());
            let target = stage.renderer.target([96, 96], 4, PixelFormat::Srgb8).expect("a target");
            stage.renderer.render(&scene, &params, &mesh, &[&stage.map], &target).expect("a frame");
            target.read(&stage.renderer.gpu).expect("pixels")
        };
        assert_eq!(picture(), picture(), "{}", method.name());
    }
}

#[test]
fn a_mesh_in_parts_is_drawn_as_the_same_mesh_in_one() {
    let (mesh, scene) = view(Sample::Chair, 2000);
    let whole = Mesh {
        parts: vec![Part { triangles: 0..mesh.triangles.len() as u32, ..mesh.parts[0].clone() }],
        ..mesh.clone()
    };
    assert!(mesh.parts.len() > 2, "{} parts", mesh.parts.len());
    let scene = Scene { materials: vec![Material::default()], ..scene };
    let mut stage = Stage::new("fine-pen", 96);
    for (method, mapping, face_frame, variety) in [
        (Method::FaceFrame, Mapping::Frames, FaceFrameForm::VertexFetched, 0.0),
        (Method::FaceFrame, Mapping::Frames, FaceFrameForm::Fetched, 0.0),
        (Method::FineTone, Mapping::Frames, FaceFrameForm::Fetched, 0.0),
        (Method::SixWay, Mapping::Patches, FaceFrameForm::Fetched, 0.0),
        (Method::FineTone, Mapping::Lapped, FaceFrameForm::Fetched, 0.0),
        (Method::Stripes, Mapping::Uv, FaceFrameForm::Fetched, 0.0),
        (Method::Stripes, Mapping::Uv, FaceFrameForm::Fetched, 0.7),
    ] {
        let params =
            RenderParams { method, mapping, face_frame, variety, silhouettes: None, ..RenderParams::default() };
        let [parts, one] = [&mesh, &whole].map(|mesh| stage.draw(&scene, &params, mesh));
        assert!(difference(&parts, &one) < 1e-6, "{} {face_frame:?} {variety}", method.name());
    }
    // Faces are counted on from part to part.
    let inspect = Inspect { debug: Some(DebugView::Triangles), ..Inspect::default() };
    let (scene, bare) = (Scene { inspect, ..scene }, RenderParams { silhouettes: None, ..RenderParams::default() });
    let [parts, one] = [&mesh, &whole].map(|mesh| stage.draw(&scene, &bare, mesh));
    assert!(difference(&parts, &one) < 1e-6);
}

#[test]
fn every_place_for_the_frames_draws_the_same_picture() {
    let (mesh, scene) = view(Sample::Cube, 12);
    let mut stage = Stage::new("fine-pen", 128);
    let mut draw = |face_frame| {
        let params =
            RenderParams { method: Method::FaceFrame, face_frame, silhouettes: None, ..RenderParams::default() };
        stage.draw(&scene, &params, &mesh)
    };
    let fetched = draw(FaceFrameForm::Fetched);
    for form in [FaceFrameForm::Vertex, FaceFrameForm::VertexFetched] {
        let drawn = draw(form);
        let differing = difference(&fetched, &drawn);
        // The normals of the vertex forms are rounded to 32 bits.
        assert!(differing < 2e-3, "{form:?}: {differing}");
    }
}

#[test]
fn what_corners_carry_moves_with_the_mesh() {
    let (mesh, scene) = view(Sample::Teapot, 2000);
    let mut moved = mesh.clone();
    tam_viewer::mesh::deform::Deform::Twist.apply(0.3, &mesh.positions, &mut moved.positions);
    let mut normals = Vec::new();
    moved.normals_of(&moved.positions, &mut normals);
    moved.normals = normals;
    let mut stage = Stage::new("fine-pen", 96);
    let plain = RenderParams { silhouettes: None, ..RenderParams::default() };
    for params in [
        RenderParams { mapping: Mapping::Patches, ..plain },
        RenderParams { mapping: Mapping::Lapped, ..plain },
        RenderParams { method: Method::Stripes, ..plain },
        RenderParams { method: Method::Stripes, variety: 0.7, ..plain },
    ] {
        let surface = surface_for(&params, &mesh);
        let mut updated = stage.upload(&params, &mesh, surface.as_ref());
        let rest = stage.draw_uploaded(&scene, &params, &updated);
        updated.update(&stage.renderer.gpu, &moved.positions, &moved.normals);
        let drawn = stage.draw_uploaded(&scene, &params, &updated);
        let uploaded = stage.upload(&params, &moved, surface.as_ref());
        let expected = stage.draw_uploaded(&scene, &params, &uploaded);
        let what = format!("{} {} {}", params.method.name(), params.mapping.name(), params.variety);
        assert!(difference(&drawn, &expected) < 1e-6, "{what}");
        assert!(difference(&drawn, &rest) > 0.01, "{what} does not move");
    }
}

#[test]
fn face_frames_follow_a_mesh_that_moves_and_a_light_that_turns() {
    let (mesh, mut scene) = view(Sample::TorusKnot, 2000);
    let mut moved = mesh.clone();
    tam_viewer::mesh::deform::Deform::Twist.apply(0.3, &mesh.positions, &mut moved.positions);
    let mut normals = Vec::new();
    moved.normals_of(&moved.positions, &mut normals);
    moved.normals = normals;
    let params = RenderParams { method: Method::FaceFrame, silhouettes: None, ..RenderParams::default() };
    let mut stage = Stage::new("fine-pen", 96);
    let target = stage.renderer.target([96, 96], 1, PixelFormat::Linear32).expect("a target");
    let mut gpu_mesh = stage.renderer.mesh(&mesh).expect("a mesh that fits");
    let frame = |stage: &mut Stage, scene: &Scene, mesh: &tam_viewer::gpu::GpuMesh| {
        stage.renderer.render(scene, &params, mesh, &[&stage.map], &target).expect("a frame");
        target.read(&stage.renderer.gpu).expect("pixels").linear()
    };
    let rest = frame(&mut stage, &scene, &gpu_mesh);
    gpu_mesh.update(&stage.renderer.gpu, &moved.positions, &moved.normals);
    let after = frame(&mut stage, &scene, &gpu_mesh);
    assert!(difference(&rest, &after) > 0.05, "the mesh moved");
    assert_eq!(after, stage.draw(&scene, &params, &moved), "as if it had been uploaded so");
    scene.lights.lights[0] = Light::from_angles(60.0, 10.0);
    let lit = frame(&mut stage, &scene, &gpu_mesh);
    assert_eq!(lit, stage.draw(&scene, &params, &moved), "as if the light had always been there");
}

#[test]
fn rotation_scale_and_shift_move_the_strokes_of_one_object_only() {
    let (mesh, scene) = view(Sample::Chair, 2000);
    assert!(mesh.parts.len() > 1, "the chair has parts");
    let params = RenderParams { method: Method::FaceFrame, silhouettes: None, ..RenderParams::default() };
    let mut stage = Stage::new("fine-pen", 128);
    let before = stage.draw(&scene, &params, &mesh);
    // Draw the parts in colours, to know whose pixels are whose.
    let mut coloured = scene.clone();
    for (part, material) in coloured.materials.iter_mut().enumerate() {
        material.colour = [if part == 0 { 1.0 } else { 0.0 }, 0.0, 0.0];
        material.diffuse = 0.0;
        material.ambient = 0.0;
    }
    coloured.lights = Lights { ambient: 1.0, lights: Vec::new() };
    coloured.materials.iter_mut().for_each(|material| material.ambient = 1.0);
    let owner = stage.draw(&coloured, &RenderParams { method: Method::Phong, ..params }, &mesh);
    for change in 0..3 {
        let mut scene = scene.clone();
        let material = &mut scene.materials[0];
        match change {
            0 => material.rotation_deg = 90.0,
            1 => material.scale = 1.7,
            _ => material.shift.x = 0.5,
        }
        let after = stage.draw(&scene, &params, &mesh);
        let (mut own, mut others) = (0.0, 0.0_f64);
        for ((a, b), owner) in before.iter().zip(&after).zip(&owner) {
            let change = f64::from((a[0] - b[0]).abs());
            if owner[0] > 0.9 && owner[1] < 0.1 { own += change } else { others += change }
        }
        assert!(own > 5.0 && others == 0.0, "change {change}: own {own}, others {others}");
    }
}

#[test]
fn two_lights_that_cross_turn_the_strokes_without_a_jump() {
    // As one light fades and the other grows, the direction follows the stronger one; no step of the way is large.
    let (mesh, mut scene) = view(Sample::Cube, 12);
    let params = RenderParams { method: Method::FaceFrame, silhouettes: None, ..RenderParams::default() };
    let mut stage = Stage::new("fine-pen", 64);
    let mut largest = |steps: u32| {
        let mut before = None;
        let mut largest = 0.0_f64;
        for step in 0..=steps {
            let t = f64::from(step) / f64::from(steps);
            let mut lights = [Light::from_angles(-60.0, 20.0), Light::from_angles(100.0, 50.0)];
            lights[0].intensity = 1.0 - t;
            lights[1].intensity = t;
            scene.lights.lights = lights.to_vec();
            let picture = stage.draw(&scene, &params, &mesh);
            if let Some(before) = before.replace(picture.clone()) {
                largest = largest.max(difference(&before, &picture));
            }
        }
        largest
    };
    let (coarse, fine) = (largest(32), largest(256));
    // A jump would stay as large with eight times finer steps.
    assert!(fine < 0.35 * coarse, "steps of 1/32 change up to {coarse:.4}, of 1/256 up to {fine:.4}");
}

#[test]
fn golden_frames() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/golden/frames");
    let size = 96;
    for (method, mapping, sample) in [
        (Method::Phong, Mapping::Uv, Sample::Teapot),
        (Method::SixWay, Mapping::Uv, Sample::Sphere),
        (Method::FaceFrame, Mapping::Frames, Sample::Cube),
        (Method::StrokeMap, Mapping::Uv, Sample::Torus),
        (Method::Halftone, Mapping::Uv, Sample::TorusKnot),
        (Method::FineTone, Mapping::Triplanar, Sample::Head),
    ] {
        let mut stage = Stage::new("fine-pen", size);
        let (mesh, mut scene) = view(sample, 4000);
        let params = RenderParams {
            method,
            mapping,
            silhouettes: Some(Silhouettes { width_px: 1.5, ..Silhouettes::default() }),
            ..RenderParams::default()
        };
        let mesh = stage.renderer.mesh(&mesh).expect("a mesh that fits");
        scene.camera.distance = scene.camera.fit_distance(mesh.radius(), 1.0);
        let target = stage.renderer.target([size, size], 4, PixelFormat::Srgb8).expect("a target");
        stage.renderer.render(&scene, &params, &mesh, &[&stage.map], &target).expect("a frame");
        let image =
            image::DynamicImage::from(target.read(&stage.renderer.gpu).expect("pixels").into_image()).into_luma8();
        let path = folder.join(format!("{}-{}.png", sample.name(), method.name()));
        if std::env::var_os("UPDATE_GOLDEN").is_some() {
            std::fs::create_dir_all(&folder).expect("a folder");
            image.save(&path).expect("a picture");
            continue;
        }
        let golden = image::open(&path).expect("a golden picture; UPDATE_GOLDEN=1 makes it").into_luma8();
        assert_eq!(golden.dimensions(), image.dimensions());
        let differences: Vec<u8> = golden.iter().zip(image.iter()).map(|(a, b)| a.abs_diff(*b)).collect();
        let mean = differences.iter().map(|d| f64::from(*d)).sum::<f64>() / differences.len() as f64;
        // Classes of processors differ by a step or two in places, and meshes at edges; strokes that move differ by tens.
        let far = differences.iter().filter(|d| **d > 24).count();
        if mean > 0.5 || far > 60 {
            let folder = Path::new(env!("CARGO_TARGET_TMPDIR"));
            let actual = folder.join(path.file_name().expect("a name"));
            image.save(&actual).expect("a picture");
            let shown = image::GrayImage::from_raw(size, size, differences).expect("as many pixels");
            shown.save(actual.with_extension("difference.png")).expect("a picture");
            panic!(
                "{} differs by {mean:.2} in the mean, {far} pixels by more than 24: see {}",
                path.display(),
                actual.display()
            );
        }
    }
}

#[test]
fn a_directional_light_is_one_that_is_far() {
    let (mesh, mut scene) = view(Sample::Torus, 1000);
    let params = RenderParams { method: Method::FaceFrame, silhouettes: None, ..RenderParams::default() };
    let mut stage = Stage::new("fine-pen", 96);
    let towards = dvec3(0.4, 0.7, 0.5);
    scene.lights.lights = vec![tam_tests::gpu::light_from(towards)];
    let directional = stage.draw(&scene, &params, &mesh);
    scene.lights.lights = vec![Light::at(towards * 1e5)];
    let positional = stage.draw(&scene, &params, &mesh);
    assert!(difference(&directional, &positional) < 2e-3);
    // A spot with its cone wide open and no fall-off is a positional light.
    let position = towards * 3.0;
    scene.lights.lights = vec![Light::at(position)];
    let near = stage.draw(&scene, &params, &mesh);
    let kind = LightKind::Spot { position, direction: -towards, cutoff_deg: 89.0, exponent: 0.0 };
    scene.lights.lights = vec![Light { kind, intensity: 1.0 }];
    assert!(difference(&near, &stage.draw(&scene, &params, &mesh)) < 1e-6);
    assert!(difference(&near, &directional) > 0.01, "near and far differ");
}

/// The same mesh with its triangles in the opposite order.
fn reversed(mesh: &Mesh) -> Mesh {
    let last = mesh.triangles.len() as u32 - 1;
    let mut back = mesh.clone();
    back.triangles.reverse();
    back.neighbours.reverse();
    for neighbour in back.neighbours.iter_mut().flatten().filter(|n| **n != NONE) {
        *neighbour = last - *neighbour;
    }
    assert_eq!(mesh.parts.len(), 1);
    back
}

#[test]
fn more_than_two_million_triangles_all_get_their_frames() {
    // Beyond 2^21 faces the compute passes run in more than one row of groups. Faces that they missed would be other
    // ones when the order is turned round.
    let (mesh, mut scene) = view(Sample::Torus, 2_400_000);
    assert!(mesh.triangles.len() > 1 << 21);
    let mut stage = Stage::new("fine-pen", 96);
    scene.lights = Lights { ambient: 0.3, lights: vec![Light::from_angles(60.0, 30.0)] };
    let params = RenderParams { method: Method::FaceFrame, silhouettes: None, ..RenderParams::default() };
    let forth = stage.draw(&scene, &params, &mesh);
    let back = stage.draw(&scene, &params, &reversed(&mesh));
    assert_eq!(nan_count(&forth), 0);
    let difference = difference(&forth, &back);
    assert!(difference < 1e-3, "the order of the triangles shows: {difference:.4}");
}
