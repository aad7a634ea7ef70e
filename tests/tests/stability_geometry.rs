//! Where methods fail, by geometry and light: each case shows the failure in the form that the paper prints, and that
//! the hardened form has none.

use glam::{DMat4, DVec3, Vec3, dvec3, vec3};
use tam_tests::gpu::{Stage, difference, front_camera, light_from, loaded, mappings, nan_count, scene_with, unmended};
use tam_viewer::mesh::sample::Sample;
use tam_viewer::mesh::{Mesh, prepare};
use tam_viewer::{Form, Light, Mapping, Method, RenderParams, Scene};

const SIDE: u32 = 96;

fn face_frame(form: Form) -> RenderParams {
    RenderParams { method: Method::FaceFrame, form, silhouettes: None, ..RenderParams::default() }
}

fn square() -> (Vec<Vec3>, Vec<[u32; 3]>) {
    let corners = vec![vec3(-1.0, -1.0, 0.0), vec3(1.0, -1.0, 0.0), vec3(1.0, 1.0, 0.0), vec3(-1.0, 1.0, 0.0)];
    (corners, vec![[0, 1, 2], [0, 2, 3]])
}

/// NaN pixels of a mesh drawn in both forms: literal, hardened.
fn nan_in_both(stage: &mut Stage, scene: &Scene, literal: &Mesh, hardened: &Mesh) -> [usize; 2] {
    [
        nan_count(&stage.draw(scene, &face_frame(Form::Literal), literal)),
        nan_count(&stage.draw(scene, &face_frame(Form::Hardened), hardened)),
    ]
}

/// A light in front of the square, a little from the side so that its faces are inked.
fn dim(light: Light) -> Scene {
    let mut scene = scene_with(light);
    scene.materials[0].diffuse = 0.6;
    scene
}

/// How much the picture of a light that leaves a face no direction differs from one with the light a hair beside.
fn beside(stage: &mut Stage, mesh: &Mesh, form: Form, lights: [Light; 2]) -> f64 {
    let [at, beside] = lights.map(|light| stage.draw(&dim(light), &face_frame(form), mesh));
    difference(&at, &beside)
}

#[test]
fn light_on_a_face_normal_leaves_no_direction_to_the_literal_form() {
    let mut stage = Stage::new("fine-pen", SIDE);
    // Closed, so that every face has three neighbours and only the light is at fault: the direction is 0/0.
    let mesh = prepare(Sample::Cube.build(12)).expect("a cube").mesh;
    let lights = [light_from(DVec3::Z), light_from(dvec3(1e-4, 0.0, 1.0))];
    let [literal, hardened] = [Form::Literal, Form::Hardened].map(|form| beside(&mut stage, &mesh, form, lights));
    assert!(literal > 0.05, "the literal picture differs by {literal:.5}");
    assert!(hardened < 1e-3, "the hardened picture differs by {hardened:.5}");
}

#[test]
fn light_that_crosses_a_face_normal_turns_the_literal_strokes_by_half() {
    let mut stage = Stage::new("fine-pen", SIDE);
    let mesh = prepare(Sample::Cube.build(12)).expect("a cube").mesh;
    let jump = |stage: &mut Stage, form, step: f64| {
        let draw =
            |stage: &mut Stage, x: f64| stage.draw(&dim(light_from(dvec3(x, 0.0, 1.0))), &face_frame(form), &mesh);
        let before = draw(stage, -step);
        difference(&before, &draw(stage, step))
    };
    let literal = [1e-2, 1e-3].map(|step| jump(&mut stage, Form::Literal, step));
    let hardened = [1e-2, 1e-3].map(|step| jump(&mut stage, Form::Hardened, step));
    // A pop stays as large however small the step; a continuous change shrinks with it.
    assert!(literal[1] > 0.05 && literal[1] > 0.8 * literal[0], "literal {literal:?}");
    assert!(hardened[1] < 2e-3, "hardened {hardened:?}, literal {literal:?}");
}

#[test]
fn light_in_the_plane_of_a_face_draws_in_both_forms() {
    // The projection is the light itself: nothing to mend, and nothing may break.
    let mut stage = Stage::new("fine-pen", SIDE);
    let mesh = prepare(Sample::Cube.build(12)).expect("a cube").mesh;
    let mut scene = scene_with(light_from(dvec3(1.0, 0.0, 0.0)));
    scene.camera.azimuth_deg = 30.0;
    let hardened = stage.draw(&scene, &face_frame(Form::Hardened), &mesh);
    assert_eq!(nan_count(&hardened), 0);
    assert!(hardened.iter().filter(|pixel| pixel[0] < 0.5).count() > 500, "the dark face is inked");
}

#[test]
fn positional_light_at_the_centre_of_a_face_leaves_no_direction_to_the_literal_form() {
    let mut stage = Stage::new("fine-pen", SIDE);
    let mesh = prepare(Sample::Cube.build(12)).expect("a cube").mesh;
    let corners = mesh.triangles.iter().map(|t| t.map(|v| mesh.positions[v as usize]));
    let front = corners.map(|[a, b, c]| (a + b + c) / 3.0).find(|centre| centre.z > 0.9).expect("a front face");
    let lights = [Light::at(front.as_dvec3()), Light::at(front.as_dvec3() + dvec3(1e-4, 0.0, 0.0))];
    let literal = beside(&mut stage, &mesh, Form::Literal, lights);
    assert!(literal > 0.05, "the literal picture differs by {literal:.5}");
    // A light in the face itself has a direction as soon as it leaves the centre; approached from outside, along the
    // normal, the strokes must not move.
    let above = |x: f64| Light::at(front.as_dvec3() + dvec3(x, 0.0, 0.01));
    let hardened = beside(&mut stage, &mesh, Form::Hardened, [above(0.0), above(1e-5)]);
    assert!(hardened < 1e-3, "the hardened picture differs by {hardened:.5}");
    let inside = stage.draw(&dim(lights[0]), &face_frame(Form::Hardened), &mesh);
    assert_eq!(nan_count(&inside), 0);
}

#[test]
fn faces_without_neighbours_need_the_validity_of_neighbours() {
    let mut stage = Stage::new("fine-pen", SIDE);
    let (positions, triangles) = square();
    let mesh = loaded(&positions, &triangles);
    let [literal, hardened] = nan_in_both(&mut stage, &dim(light_from(dvec3(0.5, 0.3, 1.0))), &mesh, &mesh);
    assert!(literal > 100, "the literal form drew {literal} NaN pixels");
    assert_eq!(hardened, 0);
}

#[test]
fn one_triangle_draws() {
    let mut stage = Stage::new("fine-pen", SIDE);
    let (positions, _) = square();
    let mesh = loaded(&positions[..3], &[[0, 1, 2]]);
    let [literal, hardened] = nan_in_both(&mut stage, &dim(light_from(dvec3(0.5, 0.3, 1.0))), &mesh, &mesh);
    assert!(literal > 100, "the literal form drew {literal} NaN pixels");
    assert_eq!(hardened, 0);
}

#[test]
fn three_faces_on_an_edge_are_boundaries() {
    let mut stage = Stage::new("fine-pen", SIDE);
    let (mut positions, mut triangles) = square();
    positions.push(vec3(0.3, 0.4, 0.9));
    triangles.push([0, 2, 4]);
    let mesh = loaded(&positions, &triangles);
    assert!(mesh.neighbours.as_flattened().iter().all(|n| *n == tam_viewer::mesh::NONE));
    let [literal, hardened] = nan_in_both(&mut stage, &dim(light_from(dvec3(0.5, 0.3, 1.0))), &mesh, &mesh);
    assert!(literal > 100, "the literal form drew {literal} NaN pixels");
    assert_eq!(hardened, 0);
}

#[test]
fn a_face_that_collapses_while_it_moves_takes_no_part() {
    let mut stage = Stage::new("fine-pen", SIDE);
    let mesh = prepare(Sample::Torus.build(400)).expect("a torus").mesh;
    // Corners of one face fall together: its own area is gone, and three neighbours read it.
    let mut collapsed = mesh.clone();
    let [a, b, c] = collapsed.triangles[200];
    for vertex in [b, c] {
        collapsed.positions[vertex as usize] = collapsed.positions[a as usize];
    }
    let mut scene = dim(light_from(dvec3(0.5, 0.3, 1.0)));
    scene.camera.elevation_deg = 60.0;
    for azimuth in 0..8 {
        scene.camera.azimuth_deg = f64::from(azimuth) * 45.0;
        let [_, hardened] = nan_in_both(&mut stage, &scene, &collapsed, &collapsed);
        assert_eq!(hardened, 0);
    }
    // Somewhere on the way around, the literal form shows it.
    let literal: usize = (0..8)
        .map(|azimuth| {
            scene.camera.azimuth_deg = f64::from(azimuth) * 45.0;
            nan_count(&stage.draw(&scene, &face_frame(Form::Literal), &collapsed))
        })
        .sum();
    assert!(literal > 10, "the literal form drew {literal} NaN pixels");
}

#[test]
fn inconsistent_winding_is_mended_at_loading() {
    let mut stage = Stage::new("fine-pen", SIDE);
    let sphere = prepare(Sample::Sphere.build(600)).expect("a sphere").mesh;
    let flipped: Vec<[u32; 3]> = sphere
        .triangles
        .iter()
        .enumerate()
        .map(|(i, [a, b, c])| if i % 3 == 0 { [*a, *c, *b] } else { [*a, *b, *c] })
        .collect();
    // Points instead of vertices: the uv seam is no boundary here.
    let mut points = vec![Vec3::ZERO; sphere.point_count];
    for (vertex, point) in sphere.points.iter().enumerate() {
        points[*point as usize] = sphere.positions[vertex];
    }
    let by_point = |triangles: &[[u32; 3]]| -> Vec<[u32; 3]> {
        triangles.iter().map(|corners| corners.map(|vertex| sphere.points[vertex as usize])).collect()
    };
    let scene = dim(light_from(dvec3(0.5, 0.3, 1.0)));
    let whole = loaded(&points, &by_point(&sphere.triangles));
    let mended = loaded(&points, &by_point(&flipped));
    let unmended = unmended(&points, &by_point(&flipped));
    let right = stage.draw(&scene, &face_frame(Form::Hardened), &whole);
    let hardened = stage.draw(&scene, &face_frame(Form::Hardened), &mended);
    let literal = stage.draw(&scene, &face_frame(Form::Literal), &unmended);
    let [literal, hardened] = [difference(&right, &literal), difference(&right, &hardened)];
    assert!(literal > 0.1, "literal differs by {literal:.4}");
    // Turned faces start at another corner: rounding, nothing else.
    assert!(hardened < 2e-3, "hardened differs by {hardened:.4}, literal by {literal:.4}");
}

#[test]
fn doubled_vertices_are_welded_at_loading() {
    let mut stage = Stage::new("fine-pen", SIDE);
    let mesh = prepare(Sample::Torus.build(800)).expect("a torus").mesh;
    let positions: Vec<Vec3> = mesh.triangles.iter().flatten().map(|vertex| mesh.positions[*vertex as usize]).collect();
    let soup: Vec<[u32; 3]> =
        (0..mesh.triangles.len() as u32).map(|face| [3 * face, 3 * face + 1, 3 * face + 2]).collect();
    let scene = dim(light_from(dvec3(0.5, 0.3, 1.0)));
    let [literal, hardened] = nan_in_both(&mut stage, &scene, &unmended(&positions, &soup), &loaded(&positions, &soup));
    assert!(literal > 100, "the literal form drew {literal} NaN pixels");
    assert_eq!(hardened, 0);
}

#[test]
fn opposed_neighbours_count_against_each_other_in_the_literal_form() {
    let mut stage = Stage::new("fine-pen", SIDE);
    // A regular tetrahedron: the cosine between its normals is -1/3, and the literal weights sum to 2c < 0.
    let positions = [vec3(1.0, 1.0, 1.0), vec3(-1.0, -1.0, 1.0), vec3(-1.0, 1.0, -1.0), vec3(1.0, -1.0, -1.0)];
    let mesh = loaded(&positions, &[[0, 1, 3], [0, 2, 1], [0, 3, 2], [1, 2, 3]]);
    let scene = dim(light_from(dvec3(0.2, 0.5, 0.4)));
    let outside = |pixels: &[[f32; 4]]| pixels.iter().filter(|p| !(-0.001..=1.001).contains(&p[0])).count();
    let literal = outside(&stage.draw(&scene, &face_frame(Form::Literal), &mesh));
    let hardened = outside(&stage.draw(&scene, &face_frame(Form::Hardened), &mesh));
    assert!(literal > 100, "the literal form drew {literal} pixels beyond paper and ink");
    assert_eq!(hardened, 0);
}

#[test]
fn right_angles_of_a_cube_do_not_mix() {
    let mut stage = Stage::new("fine-pen", SIDE);
    let mesh = prepare(Sample::Cube.build(12)).expect("a cube").mesh;
    let mut scene = dim(light_from(dvec3(0.5, 0.3, 1.0)));
    scene.camera.azimuth_deg = 35.0;
    scene.camera.elevation_deg = 30.0;
    let outside = |pixels: &[[f32; 4]]| pixels.iter().filter(|p| !(-0.001..=1.001).contains(&p[0])).count();
    let literal = outside(&stage.draw(&scene, &face_frame(Form::Literal), &mesh));
    let hardened = outside(&stage.draw(&scene, &face_frame(Form::Hardened), &mesh));
    assert!(literal > 20, "the literal form drew {literal} pixels beyond paper and ink");
    assert_eq!(hardened, 0);
}

#[test]
fn vertices_far_from_the_origin_are_brought_back_at_loading() {
    let mut stage = Stage::new("fine-pen", SIDE);
    let torus = prepare(Sample::Torus.build(800)).expect("a torus").mesh;
    // Steps of f32 at 1e6 are 1/16: a mesh of the usual size would be rubble, so this one is larger.
    let far: Vec<Vec3> = torus.positions.iter().map(|p| *p * 1000.0 + 1e6).collect();
    let rounded: Vec<Vec3> = far.iter().map(|p| (*p - 1e6) / 1000.0).collect();
    let scene = dim(light_from(dvec3(0.5, 0.3, 1.0)));
    let near = loaded(&rounded, &torus.triangles);
    let brought_back = loaded(&far, &torus.triangles);
    let mut as_it_is = unmended(&far, &torus.triangles);
    as_it_is.neighbours.clone_from(&near.neighbours);
    let mut far_scene = scene.clone();
    far_scene.camera.target = DVec3::splat(1e6);
    far_scene.camera.distance *= 1000.0;
    let params = |form| RenderParams { tiles_per_unit: 1.5, ..face_frame(form) };
    let far_params = RenderParams { tiles_per_unit: 1.5e-3, ..params(Form::Literal) };
    let literal_near = stage.draw(&scene, &params(Form::Literal), &near);
    let literal_far = stage.draw(&far_scene, &far_params, &as_it_is);
    let hardened_near = stage.draw(&scene, &params(Form::Hardened), &near);
    let hardened_far = stage.draw(&scene, &params(Form::Hardened), &brought_back);
    let [literal, hardened] = [difference(&literal_near, &literal_far), difference(&hardened_near, &hardened_far)];
    assert!(literal > 0.1, "literal differs by {literal:.4}");
    assert!(hardened < 5e-3, "hardened differs by {hardened:.4}, literal by {literal:.4}");
}

#[test]
fn non_uniform_scale_keeps_strokes_square_in_the_world() {
    let mut stage = Stage::new("fine-pen", SIDE);
    let torus = prepare(Sample::Torus.build(800)).expect("a torus").mesh;
    let stretch = dvec3(0.5, 1.0, 1.4);
    let mut stretched = torus.clone();
    for position in &mut stretched.positions {
        *position *= stretch.as_vec3();
    }
    let positions = stretched.positions.clone();
    let mut normals = Vec::new();
    stretched.normals_of(&positions, &mut normals);
    stretched.normals = normals;
    let by_vertex = dim(light_from(dvec3(0.5, 0.3, 1.0)));
    let mut by_matrix = by_vertex.clone();
    by_matrix.world_from_mesh = DMat4::from_scale(stretch);
    let compare = |stage: &mut Stage, form| {
        let wanted = stage.draw(&by_vertex, &face_frame(form), &stretched);
        difference(&wanted, &stage.draw(&by_matrix, &face_frame(form), &torus))
    };
    let [literal, hardened] = [compare(&mut stage, Form::Literal), compare(&mut stage, Form::Hardened)];
    assert!(literal > 0.05, "literal differs by {literal:.4}");
    // Smooth normals come from the stretched matrix in one and from the unstretched mesh in the other, and decide the
    // level only.
    assert!(hardened < 0.02, "hardened differs by {hardened:.4}, literal by {literal:.4}");
}

#[test]
fn tone_that_passes_a_column_pops_in_the_literal_form() {
    let mut stage = Stage::new("fine-pen", SIDE);
    let mesh = prepare(Sample::Cube.build(12)).expect("a cube").mesh;
    let columns = stage.map.source.grid.columns() as f64;
    let at = |stage: &mut Stage, form, darkness: f64| {
        // The front face of a cube, lit from the front at a slant: its luminance is the diffuse reflectance times 0.8.
        let mut scene = scene_with(light_from(dvec3(0.6, 0.0, 0.8)));
        scene.materials[0].diffuse = (1.0 - darkness) / 0.8;
        stage.draw(&scene, &face_frame(form), &mesh)
    };
    let jump = |stage: &mut Stage, form, step: f64| {
        let middle = 2.5 / columns;
        let before = at(stage, form, middle - step);
        difference(&before, &at(stage, form, middle + step))
    };
    let [literal, hardened] = [jump(&mut stage, Form::Literal, 1e-5), jump(&mut stage, Form::Hardened, 1e-5)];
    assert!(literal > 0.03, "literal jumps by {literal:.4}");
    assert!(hardened < 1e-3, "hardened jumps by {hardened:.5}, literal by {literal:.4}");
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
fn threshold_of_the_literal_stroke_map_is_too_light() {
    // The one-sided ramp lies wholly above the threshold: mid-tones lose half a ramp, 1 / (2c).
    let mut stage = Stage::new("engraving", 256);
    let mesh = prepare(Sample::Quad.build(2)).expect("a square").mesh;
    let mut error = |form| {
        let mut scene = scene_with(light_from(DVec3::Z));
        scene.materials[0].diffuse = 0.5;
        let params = RenderParams {
            method: Method::StrokeMap,
            mapping: Mapping::Triplanar,
            form,
            slope: 6.0,
            silhouettes: None,
            ..RenderParams::default()
        };
        let pixels = stage.draw(&scene, &params, &mesh);
        let inside: Vec<f64> =
            pixels.chunks(256).skip(80).take(96).flat_map(|row| &row[80..176]).map(|p| f64::from(p[0])).collect();
        0.5 - inside.iter().sum::<f64>() / inside.len() as f64
    };
    let [literal, hardened] = [error(Form::Literal), error(Form::Hardened)];
    assert!(literal < -0.05, "literal is off by {literal:.4}");
    assert!(hardened.abs() < 0.03, "hardened is off by {hardened:.4}, literal by {literal:.4}");
}

#[test]
fn grazing_views_are_sampled_at_a_coarser_level_than_the_depth_alone_asks_for() {
    // A square seen at 4 degrees: the literal level ignores the slant, so neighbouring pixels skip texels, and a small
    // move of the camera changes them at random. The hardened level follows the slant of the surface.
    let mut stage = Stage::new("fine-pen", SIDE);
    let mesh = prepare(Sample::Cube.build(12)).expect("a cube").mesh;
    let flicker = |stage: &mut Stage, form| {
        let draw = |stage: &mut Stage, azimuth: f64| {
            let mut scene = dim(light_from(dvec3(0.9, 0.1, 0.4)));
            scene.camera = front_camera();
            scene.camera.distance = 3.0;
            scene.camera.azimuth_deg = azimuth;
            scene.camera.elevation_deg = 24.0;
            stage.draw(&scene, &RenderParams { tiles_per_unit: 6.0, ..face_frame(form) }, &mesh)
        };
        let before = draw(stage, 0.0);
        difference(&before, &draw(stage, 0.3))
    };
    let [literal, hardened] = [flicker(&mut stage, Form::Literal), flicker(&mut stage, Form::Hardened)];
    assert!(hardened < 0.75 * literal, "hardened changes by {hardened:.4}, literal by {literal:.4}");
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
    let pixels = stage.draw(&dim(light_from(dvec3(0.5, 0.3, 1.0))), &face_frame(Form::Hardened), &mesh);
    assert_eq!(nan_count(&pixels), 0);
    assert!(pixels.iter().filter(|pixel| pixel[0] < 0.5).count() > 100, "the rest is drawn");
}
