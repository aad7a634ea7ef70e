//! The wanted tone against formulas written anew from the light model's words: planes and balls under each kind of light.
//! Shaders, twins and measures share one function; none of it is used here.

use glam::{DVec2, DVec3, Vec3};
use tam_tests::gpu::{Stage, loaded};
use tam_viewer::measure::Aov;
use tam_viewer::mesh::sample::Sample;
use tam_viewer::mesh::{Mesh, prepare};
use tam_viewer::{Camera, Light, LightKind, Lights, Mapping, Material, Method, RenderParams, Scene};

const SIDE: u32 = 128;

/// Of single floats, through two dozen operations and a square root.
const ROUNDING: f64 = 2e-5;

/// What the facets of a ball of some hundred thousand triangles change in its tone, highlights of exponent 24 included.
const FACETS: f64 = 4e-3;

/// A surface without an own luminance: all of it comes from the lights.
fn scene(lights: &[Light], ambient: f64, material: Material) -> Scene {
    Scene {
        camera: Camera { azimuth_deg: 0.0, elevation_deg: 0.0, distance: 4.0, ..Camera::default() },
        lights: Lights { ambient, lights: lights.to_vec() },
        materials: vec![material],
        ..Scene::default()
    }
}

/// Through the middle of a pixel, from a camera on the z axis that looks at the origin.
fn ray(scene: &Scene, x: u32, y: u32) -> (DVec3, DVec3) {
    let half = (scene.camera.field_of_view_deg / 2.0).to_radians().tan();
    let at = (DVec2::new(f64::from(x), f64::from(y)) + 0.5) / f64::from(SIDE) * 2.0 - 1.0;
    (DVec3::new(0.0, 0.0, scene.camera.distance), DVec3::new(at.x * half, -at.y * half, -1.0).normalize())
}

/// A point of the square in the plane z = 0, and its normal.
fn on_plane(from: DVec3, along: DVec3) -> Option<(DVec3, DVec3)> {
    let p = from - along * (from.z / along.z);
    (p.abs().max_element() < 0.99).then_some((p, DVec3::Z))
}

/// A point of the ball of radius 1, and its normal, away from its contour.
fn on_ball(from: DVec3, along: DVec3) -> Option<(DVec3, DVec3)> {
    let b = from.dot(along);
    let inside = b * b - (from.length_squared() - 1.0);
    let p = from + along * (-b - inside.max(0.0).sqrt());
    (inside > 0.05).then_some((p, p.normalize()))
}

/// Luminance as the light model is told in words: Lambert's cosine, Phong's highlight, a spot's power of the cosine from
/// its axis up to the cut-off; all add up, and are clamped.
fn told(scene: &Scene, p: DVec3, n: DVec3) -> f64 {
    let material = &scene.materials[0];
    let view = (DVec3::new(0.0, 0.0, scene.camera.distance) - p).normalize();
    let mut sum = scene.lights.ambient * material.ambient;
    for Light { kind, intensity } in &scene.lights.lights {
        let (towards, share) = match *kind {
            LightKind::Directional { direction } => (-direction.normalize(), 1.0),
            LightKind::Positional { position } => ((position - p).normalize(), 1.0),
            LightKind::Spot { position, direction, cutoff_deg, exponent } => {
                let from_axis = direction.normalize().angle_between(p - position);
                let lit = from_axis <= cutoff_deg.to_radians();
                ((position - p).normalize(), if lit { from_axis.cos().powf(exponent) } else { 0.0 })
            }
        };
        let angle = n.angle_between(towards);
        if angle < std::f64::consts::FRAC_PI_2 {
            // The mirrored ray, by a half turn about the normal.
            let mirrored = glam::DQuat::from_axis_angle(n, std::f64::consts::PI) * towards;
            let highlight = mirrored.dot(view).max(0.0).powf(material.shininess);
            sum += intensity * share * (material.diffuse * angle.cos() + material.specular * highlight);
        }
    }
    sum.min(1.0)
}

/// Greatest difference of the picture of `phong`, and of the measures' wanted tone, from what is told; pixels beside the
/// border of a spot are left out, as its border runs through them.
fn error(stage: &mut Stage, scene: &Scene, mesh: &Mesh, point: Point, told_by: &Scene) -> (f64, f64) {
    let params =
        RenderParams { method: Method::Phong, mapping: Mapping::Triplanar, silhouettes: None, ..Default::default() };
    let drawn = stage.draw(scene, &params, mesh);
    let wanted = Aov::new(mesh, scene, [SIDE; 2], None).expect("a view");
    let (mut of_drawn, mut of_wanted, mut seen) = (0.0f64, 0.0f64, 0);
    for (i, pixel) in drawn.iter().enumerate() {
        let (from, along) = ray(scene, i as u32 % SIDE, i as u32 / SIDE);
        let Some((p, n)) = point(from, along) else { continue };
        if scene.lights.lights.iter().any(|light| beside_cutoff(light, p)) {
            continue;
        }
        let luminance = told(told_by, p, n);
        seen += 1;
        of_drawn = of_drawn.max((f64::from(pixel[0]) - luminance).abs());
        let surface = wanted.pixels[i].as_ref().expect("the measures see it too");
        of_wanted = of_wanted.max((1.0 - surface.darkness - luminance).abs());
    }
    assert!(seen > 3000, "{seen} pixels");
    (of_drawn, of_wanted)
}

type Point = fn(DVec3, DVec3) -> Option<(DVec3, DVec3)>;

fn beside_cutoff(light: &Light, p: DVec3) -> bool {
    let LightKind::Spot { position, direction, cutoff_deg, .. } = light.kind else { return false };
    (direction.angle_between(p - position).to_degrees() - cutoff_deg).abs() < 1.0
}

fn square() -> Mesh {
    let corners = [(-1.0, -1.0), (1.0, -1.0), (1.0, 1.0), (-1.0, 1.0)];
    loaded(&corners.map(|(x, y)| Vec3::new(x, y, 0.0)), &[[0, 1, 2], [0, 2, 3]])
}

/// A light of each kind, from places where it falls aslant, and what takes it.
fn cases() -> Vec<(&'static str, Scene)> {
    let matte = Material::default();
    let half = Material { diffuse: 0.5, ambient: 0.4, ..Material::default() };
    let shiny = Material { diffuse: 0.3, specular: 0.6, shininess: 24.0, ..Material::default() };
    let at = DVec3::new(0.7, 0.4, 1.5);
    let point = Light { intensity: 0.8, ..Light::at(at) };
    let spot = |cutoff_deg, exponent| Light {
        kind: LightKind::Spot { position: at, direction: DVec3::new(-0.5, -0.3, -1.4), cutoff_deg, exponent },
        intensity: 0.9,
    };
    let far = |direction, intensity| Light { kind: LightKind::Directional { direction }, intensity };
    let aslant = DVec3::new(-0.6, -0.5, -1.1);
    vec![
        ("far", scene(&[far(aslant, 0.9)], 0.0, matte.clone())),
        ("far and from everywhere", scene(&[far(aslant, 0.7)], 0.25, half.clone())),
        ("from behind", scene(&[far(DVec3::new(0.2, 0.1, 1.0), 1.0)], 0.1, matte.clone())),
        ("at a point", scene(&[point], 0.05, matte.clone())),
        ("spot, even", scene(&[spot(30.0, 0.0)], 0.0, matte.clone())),
        ("spot, falling off", scene(&[spot(50.0, 7.0)], 0.1, half)),
        ("highlight", scene(&[far(aslant, 0.9), point], 0.0, shiny)),
        ("more than white", scene(&[far(aslant, 0.8), far(DVec3::NEG_Z, 0.7)], 0.2, matte)),
    ]
}

#[test]
fn tones_of_planes_and_balls_are_those_of_the_light_model_in_words() {
    let mut stage = Stage::new("fine-pen", SIDE);
    let ball = prepare(Sample::Sphere.build(120_000)).expect("a ball").mesh;
    let square = square();
    for (name, scene) in cases() {
        for (mesh, point, bound) in [(&square, on_plane as Point, ROUNDING), (&ball, on_ball as Point, FACETS)] {
            let (drawn, wanted) = error(&mut stage, &scene, mesh, point, &scene);
            assert!(drawn <= bound && wanted <= bound, "{name} on {}: {drawn:.1e}, {wanted:.1e}", mesh.name);
        }
    }
}

#[test]
fn another_light_model_is_noticed() {
    let mut stage = Stage::new("fine-pen", SIDE);
    let square = square();
    let named = |name: &str| cases().into_iter().find(|(case, _)| *case == name).expect("a case").1;
    let mut weaker = named("spot, falling off");
    if let LightKind::Spot { exponent, .. } = &mut weaker.lights.lights[0].kind {
        *exponent -= 0.1;
    }
    let mut wider = named("highlight");
    wider.materials[0].shininess -= 0.5;
    let mut moved = named("at a point");
    moved.lights.lights[0] = Light { intensity: 0.8, ..Light::at(DVec3::new(0.7, 0.4, 1.51)) };
    for (name, other) in [("spot, falling off", weaker), ("highlight", wider), ("at a point", moved)] {
        let scene = named(name);
        let (drawn, wanted) = error(&mut stage, &scene, &square, on_plane, &other);
        assert!(drawn > 10.0 * ROUNDING && wanted > 10.0 * ROUNDING, "{name}: {drawn:.1e}, {wanted:.1e}");
    }
}

#[test]
fn the_mean_tone_of_a_ball_is_that_of_the_integral_over_its_disc() {
    let mut stage = Stage::new("fine-pen", 256);
    let ball = prepare(Sample::Sphere.build(120_000)).expect("a ball").mesh;
    let params =
        RenderParams { method: Method::Phong, mapping: Mapping::Triplanar, silhouettes: None, ..Default::default() };
    // From far away through a narrow opening all of the half that is lit is seen, as without perspective.
    let far =
        Camera { field_of_view_deg: 1.0, distance: 130.0, azimuth_deg: 0.0, elevation_deg: 0.0, ..Camera::default() };
    let lights = |direction| Lights {
        ambient: 0.0,
        lights: vec![Light { kind: LightKind::Directional { direction }, intensity: 1.0 }],
    };
    // Over the unit disc: the mean of √(1 - r²) is 2/3, that of max(x, 0) is 2/3π.
    let pi = std::f64::consts::PI;
    for (direction, mean) in [(DVec3::NEG_Z, 2.0 / 3.0), (DVec3::NEG_X, 2.0 / (3.0 * pi)), (DVec3::Z, 0.0)] {
        let scene =
            Scene { camera: far, lights: lights(direction), paper: [1.0; 3], ink: [0.0; 3], ..Scene::default() };
        let drawn = stage.draw(&scene, &params, &ball);
        let covered = Aov::new(&ball, &scene, [256; 2], None).expect("a view").covered();
        let sum: f64 =
            drawn.iter().zip(&covered).filter(|(_, covered)| **covered).map(|(pixel, _)| f64::from(pixel[0])).sum();
        let count = covered.iter().filter(|covered| **covered).count();
        // From here the outermost 1/130 of the half is not seen, and its border is counted in whole pixels.
        let error = sum / count as f64 - mean;
        assert!(error.abs() < 6e-3, "{direction}: {error:.1e}");
    }
}
