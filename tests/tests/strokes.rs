//! Stripes made of strokes: they keep the tone, change nothing where there is no variety, and hold still.

use glam::DVec3;
use tam_shaders::cpu::{self, MapImage, Options};
use tam_shaders::{Feed, Pass, types};
use tam_tests::gpu::{Stage, front_camera, light_from, nan_count, surface_for};
use tam_viewer::mesh::sample::Sample;
use tam_viewer::mesh::{Mesh, prepare};
use tam_viewer::reference::{Draw, How, Reference};
use tam_viewer::surface::{Corners, Surface};
use tam_viewer::{Lights, Method, RenderError, RenderParams, Scene};

fn params(variety: f64) -> RenderParams {
    RenderParams { method: Method::Stripes, variety, silhouettes: None, ..RenderParams::default() }
}

fn sample(sample: Sample, triangles: usize) -> Mesh {
    prepare(sample.build(triangles)).expect("a sample").mesh
}

/// A flat square, cut finely enough for patches, and all that is drawn on it.
struct Swatch {
    mesh: Mesh,
    surface: Surface,
}

impl Swatch {
    fn new() -> Self {
        let mesh = sample(Sample::Quad, 2).subdivided(0.08);
        let surface = surface_for(&params(1.0), &mesh).expect("stripes need one");
        Self { mesh, surface }
    }

    /// Ink by pixel, where the square covers all of it.
    fn ink(&self, d: f64, line_period_px: f64, cross_from: f64, variety: f64) -> Vec<Option<f64>> {
        let (patches, stripes) = (self.surface.patches.as_ref(), self.surface.stripes.as_ref());
        let (patches, stripes) = (patches.expect("patches"), stripes.expect("stripes"));
        let corners = Corners::of_stripes(&self.mesh.triangles, stripes, (variety > 0.0).then_some(patches));
        let material = types::Material {
            colour: [1.0; 4],
            ambient: 1.0,
            tile_from_surface: [1.0, 0.0, 0.0, 1.0],
            line_period_px: line_period_px as f32,
            cross_from: cross_from as f32,
            variety: variety as f32,
            ..bytemuck::Zeroable::zeroed()
        };
        let (triangles, map) = (0..self.mesh.triangles.len() as u32, MapImage::default());
        let draws = [Draw {
            triangles,
            material: &material,
            map: &map,
            distribution: &[],
            corners: Some(&corners),
            turns: &[],
        }];
        let lights = Lights { ambient: 1.0 - d, lights: Vec::new() };
        let scene = Scene { camera: front_camera(), lights, paper: [1.0; 3], ink: [0.0; 3], ..Scene::default() };
        let feed = if variety > 0.0 { Feed::Strokes } else { Feed::Lines };
        let options = Options { mapping: cpu::Mapping::Patches, ..Options::default() };
        let how = How { pass: Pass::Stripes, feed, options, samples: 1 };
        let shared = scene.shared([320; 2], 2.0);
        let picture = Reference::new(&self.mesh).render(&shared, &draws, &how).expect("the reference draws");
        let ink = |(colour, share): (&glam::DVec4, &f64)| (*share == 1.0).then_some(1.0 - colour.x);
        picture.colours.iter().zip(&picture.coverage).map(ink).collect()
    }
}

fn mean(ink: &[Option<f64>]) -> f64 {
    let drawn: Vec<f64> = ink.iter().flatten().copied().collect();
    assert!(drawn.len() > 20_000, "{} pixels", drawn.len());
    drawn.iter().sum::<f64>() / drawn.len() as f64
}

#[test]
fn tone_holds_at_any_variety() {
    let swatch = Swatch::new();
    for variety in [0.3, 0.7, 1.0] {
        for (d, cross_from) in [(0.1, 1.0), (0.35, 1.0), (0.6, 1.0), (0.85, 1.0), (0.5, 0.3), (0.8, 0.3)] {
            let ink = mean(&swatch.ink(d, 4.0, cross_from, variety));
            // 500 strokes or so, each off by half its darkness: 0.5 d / sqrt(500), and what the pixels lose.
            assert!((ink - d).abs() < 0.015, "{ink} for {d} at variety {variety}, crossed from {cross_from}");
        }
    }
}

#[test]
fn strokes_differ_more_with_variety_and_not_at_all_without() {
    let swatch = Swatch::new();
    let spread = |variety: f64| {
        let plain = swatch.ink(0.4, 8.0, 1.0, 0.0);
        let varied = swatch.ink(0.4, 8.0, 1.0, variety);
        let both = plain.iter().flatten().zip(varied.iter().flatten());
        both.map(|(plain, varied)| (plain - varied).abs())
            .fold((0.0_f64, 0.0_f64), |(greatest, sum), difference| (greatest.max(difference), sum + difference))
    };
    // The pass that knows strokes, given none, draws what the plain one draws.
    assert!(spread(1e-9).0 < 1e-6);
    let sums = [0.2, 0.5, 1.0].map(|variety| spread(variety).1);
    assert!(sums[0] > 0.0 && sums.is_sorted(), "{sums:?}");
}

#[test]
fn nothing_pops_while_lines_double() {
    let swatch = Swatch::new();
    // As many lines as a camera sees that comes twice as close, in steps; one of them holds the doubling.
    let steps: Vec<Vec<Option<f64>>> =
        (0..=24).map(|i| swatch.ink(0.4, 12.0 * (f64::from(-i) / 24.0).exp2(), 1.0, 1.0)).collect();
    let change = |pair: &[Vec<Option<f64>>]| {
        let both = pair[0].iter().zip(&pair[1]).filter_map(|(here, next)| Some(((*here)? - (*next)?).abs()));
        let differences: Vec<f64> = both.collect();
        differences.iter().sum::<f64>() / differences.len() as f64
    };
    let worst = steps.windows(2).map(change).fold(0.0, f64::max);
    // Half of the ink, 0.2, goes from old lines to new ones in 24 steps, out and in.
    assert!(worst < 1.5 * 0.4 / 24.0, "{worst}");
}

#[test]
fn all_samples_are_drawn_with_numbers() {
    let lights = Lights { ambient: 0.1, lights: vec![light_from(DVec3::new(-0.5, 0.6, 0.7))] };
    let scene = Scene { camera: front_camera(), lights, ..Scene::default() };
    let mut stage = Stage::new("engraving", 96);
    for of in Sample::ALL {
        let pixels = stage.draw(&scene, &params(1.0), &sample(of, 2_000));
        assert_eq!(nan_count(&pixels), 0, "{}", of.name());
    }
}

#[test]
fn strokes_without_patches_are_refused() {
    let mut stage = Stage::new("engraving", 32);
    let mesh = sample(Sample::Sphere, 800);
    let plain = surface_for(&params(0.0), &mesh).expect("stripes need one");
    assert!(plain.patches.is_none());
    let mut uploaded = stage.renderer.mesh(&mesh).expect("a mesh that fits");
    stage.renderer.attach(&mut uploaded, &plain).expect("a surface that fits");
    let target = stage.renderer.target([32; 2], 1, tam_viewer::gpu::PixelFormat::Linear32).expect("a picture");
    let scene = Scene::default();
    let mut draw = |variety| stage.renderer.render(&scene, &params(variety), &uploaded, &[&stage.map], &target);
    assert!(matches!(draw(0.5), Err(RenderError::NoSurface(_))));
    draw(0.0).expect("plain lines need no patches");
}
