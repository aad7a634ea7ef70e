//! Where methods might fail by geometry and light, and no form does: beside the pairs of literal and hardened form in
//! `stability.rs`.

use glam::{DVec3, Vec3, dvec3, vec3};
use tam_tests::gpu::{Stage, light_from, loaded, mappings, nan_count, scene_with};
use tam_viewer::mesh::prepare;
use tam_viewer::mesh::sample::Sample;
use tam_viewer::{Form, Light, Mapping, Method, RenderParams, Scene};

const SIDE: u32 = 96;

fn face_frame() -> RenderParams {
    RenderParams { method: Method::FaceFrame, form: Form::Hardened, silhouettes: None, ..RenderParams::default() }
}

fn square() -> (Vec<Vec3>, Vec<[u32; 3]>) {
    let corners = vec![vec3(-1.0, -1.0, 0.0), vec3(1.0, -1.0, 0.0), vec3(1.0, 1.0, 0.0), vec3(-1.0, 1.0, 0.0)];
    (corners, vec![[0, 1, 2], [0, 2, 3]])
}

/// A light in front of the square, a little from the side so that its faces are inked.
fn dim(light: Light) -> Scene {
    let mut scene = scene_with(light);
    scene.materials[0].diffuse = 0.6;
    scene
}

#[test]
fn positional_light_in_the_centre_of_a_face_leaves_numbers() {
    let mut stage = Stage::new("fine-pen", SIDE);
    let mesh = prepare(Sample::Cube.build(12)).expect("a cube").mesh;
    let corners = mesh.triangles.iter().map(|t| t.map(|v| mesh.positions[v as usize]));
    let front = corners.map(|[a, b, c]| (a + b + c) / 3.0).find(|centre| centre.z > 0.9).expect("a front face");
    let inside = stage.draw(&dim(Light::at(front.as_dvec3())), &face_frame(), &mesh);
    assert_eq!(nan_count(&inside), 0);
}

#[test]
fn three_faces_on_an_edge_are_boundaries() {
    let (mut positions, mut triangles) = square();
    positions.push(vec3(0.3, 0.4, 0.9));
    triangles.push([0, 2, 4]);
    let mesh = loaded(&positions, &triangles);
    assert!(mesh.neighbours.as_flattened().iter().all(|n| *n == tam_viewer::mesh::NONE));
}

#[test]
fn tones_at_and_beside_paper_and_ink_are_what_they_say() {
    let mut stage = Stage::new("fine-pen", SIDE);
    let mesh = prepare(Sample::Quad.build(2)).expect("a square").mesh;
    let mean = |stage: &mut Stage, method, darkness: f64| {
        let mut scene = scene_with(light_from(DVec3::Z));
        scene.materials[0].diffuse = 1.0 - darkness;
        let params = RenderParams { method, mapping: Mapping::Triplanar, silhouettes: None, ..RenderParams::default() };
        let pixels = stage.draw(&scene, &params, &mesh);
        assert_eq!(nan_count(&pixels), 0);
        let middle = SIDE as usize / 2;
        let inside: Vec<f64> = pixels
            .chunks(SIDE as usize)
            .skip(middle - 16)
            .take(32)
            .flat_map(|row| &row[middle - 16..middle + 16])
            .map(|pixel| f64::from(pixel[0]))
            .collect();
        1.0 - inside.iter().sum::<f64>() / inside.len() as f64
    };
    for method in [Method::SixWay, Method::FaceFrame, Method::FineTone, Method::StrokeMap, Method::Halftone] {
        assert_eq!(mean(&mut stage, method, 0.0), 0.0, "{method:?}");
        let faint = mean(&mut stage, method, 1e-4);
        assert!(faint < 0.01, "{method:?}: {faint}");
    }
    for method in [Method::StrokeMap, Method::Halftone] {
        let black = mean(&mut stage, method, 1.0);
        assert!((1.0 - black).abs() < 1e-5, "{method:?}: {black}");
        let dark = mean(&mut stage, method, 1.0 - 1e-4);
        assert!(dark > 0.99, "{method:?}: {dark}");
    }
}

#[test]
fn poles_of_a_uv_sphere_draw_without_holes() {
    let mut stage = Stage::new("fine-pen", SIDE);
    let mesh = prepare(Sample::Sphere.build(2000)).expect("a sphere").mesh;
    for elevation_deg in [-90.0, 90.0] {
        let mut scene = dim(light_from(dvec3(0.5, 0.3, 1.0)));
        scene.camera.elevation_deg = elevation_deg;
        for method in [Method::SixWay, Method::FineTone, Method::StrokeMap, Method::Halftone, Method::FaceFrame] {
            for mapping in mappings(&mesh) {
                let params = RenderParams { method, mapping, silhouettes: None, ..RenderParams::default() };
                assert_eq!(nan_count(&stage.draw(&scene, &params, &mesh)), 0, "{method:?} {mapping:?}");
            }
        }
    }
}

#[test]
fn vertices_that_are_no_numbers_are_dropped_at_loading() {
    let mut stage = Stage::new("fine-pen", SIDE);
    let (mut positions, mut triangles) = square();
    positions.extend([vec3(f32::NAN, 0.0, 0.0), vec3(f32::INFINITY, 1.0, 0.0)]);
    triangles.extend([[0, 1, 4], [1, 2, 5]]);
    let mesh = loaded(&positions, &triangles);
    assert_eq!(mesh.triangles.len(), 2);
    let pixels = stage.draw(&dim(light_from(dvec3(0.5, 0.3, 1.0))), &face_frame(), &mesh);
    assert_eq!(nan_count(&pixels), 0);
    assert!(pixels.iter().filter(|pixel| pixel[0] < 0.5).count() > 100, "the rest is drawn");
}
