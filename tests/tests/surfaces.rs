//! What strokes on surfaces promise: they follow the field in whole strokes, keep the tone, leave no hole, and neither swim
//! nor pop.

use std::io::Write;

use glam::DVec3;
use tam_tests::gpu::{Stage, light_from, nan_count, surface_for};
use tam_tests::measure::{Shot, Subject, pen_stage};
use tam_viewer::measure::{Plane, run_length};
use tam_viewer::mesh::prepare;
use tam_viewer::mesh::sample::Sample;
use tam_viewer::surface::{FieldSource, LappedOptions, PatchOptions, StripeOptions, Surface, SurfaceOptions};
use tam_viewer::{Follow, Lights, Mapping, Method, RenderParams, Scene};

const SIZE: u32 = 1024;

fn subject(sample: Sample, triangles: usize, method: Method) -> Subject {
    let mesh = prepare(sample.build(triangles)).expect("a sample").mesh;
    let params = RenderParams { method, mapping: Mapping::Patches, cross_from: None, ..RenderParams::default() };
    let mesh = mesh.subdivided(PatchOptions::default().longest_edge() as f32);
    Subject::new(mesh, FieldSource::Curvature, params)
}

/// The whole mesh in the picture, lit from above, no darker than 0.7: solid ink has no strokes.
fn lit(subject: &Subject) -> Scene {
    let mut scene = Scene::of(&subject.mesh);
    let places: Vec<DVec3> = subject.mesh.positions.iter().map(|p| p.as_dvec3()).collect();
    scene.camera.frame_points(&places, 1.0, 0.07);
    scene.lights = Lights { ambient: 0.3, lights: vec![light_from(DVec3::new(-1.0, 1.5, 2.0))] };
    scene.transparent = true;
    scene
}

fn shot(stage: &mut Stage, sample: Sample, triangles: usize, method: Method) -> Shot {
    let subject = subject(sample, triangles, method);
    let scene = lit(&subject);
    subject.shoot(stage, &scene)
}

/// Greatest mean direction error in degrees.
fn most_deg(sample: Sample, method: Method) -> f64 {
    match (sample, method) {
        (Sample::Hand, Method::Stripes) => 3.0,
        (_, Method::Stripes) => 3.5,
        (Sample::Hand, _) => 5.0,
        _ => 5.5,
    }
}

/// Prints a row per picture, and says which are not as they should be.
fn check(counts: &[usize]) {
    let mut stage = pen_stage(SIZE);
    let (mut table, mut failures) = (String::new(), Vec::new());
    for sample in [Sample::Hand, Sample::Head] {
        for triangles in counts {
            // Lines that nothing breaks but form, light and contour: what the strokes of a map are compared with.
            let mut unbroken_px = 0.0;
            for method in [Method::Stripes, Method::FineTone] {
                let found = shot(&mut stage, sample, *triangles, method).measures;
                let deg = found.direction.mean_deg.expect("strokes");
                let run = found.run_length;
                let [px, merged_px] = [run.mean_px, run.merged_px].map(|px| px.expect("strokes"));
                let tone = found.tone.expect("it is seen").ink;
                let row = format!(
                    "{:<5} {triangles:>7} {:<10} {deg:>5.2}°  {px:>6.1} px, {merged_px:>6.1} through dark  bias {:>+7.4}  \
                     rmse {:.4}\n",
                    sample.name(),
                    method.name(),
                    tone.bias,
                    tone.rmse
                );
                if method == Method::Stripes {
                    unbroken_px = px;
                }
                // Lines have no grain of a map, whose tone is held to that of a flat square elsewhere.
                let uneven = method == Method::Stripes && tone.rmse > 0.005;
                if uneven || deg > most_deg(sample, method) || px < 0.59 * unbroken_px || tone.bias.abs() > 0.004 {
                    failures.push(row.clone());
                }
                table += &row;
            }
        }
    }
    let mut out = std::io::stdout();
    out.write_all(table.as_bytes()).expect("a table");
    assert!(failures.is_empty(), "\n{}", failures.concat());
}

#[test]
fn strokes_follow_the_form_in_whole_strokes() {
    check(&[5_000, 20_000]);
}

/// `cargo test -p tam-tests --test surfaces -- --ignored --nocapture` prints the table.
#[test]
#[ignore = "hands and heads of 200,000 and 800,000 triangles take minutes"]
fn strokes_follow_the_form_on_fine_meshes_too() {
    // The finer ones are laid out on clusters of their vertices.
    check(&[200_000, 800_000]);
}

/// In one tone, so that nothing but form and contour ends a line; the flat square below has the same tone and scale. As
/// much as there is to run on comes with the figures: lines around a finger are no longer than it is wide.
#[test]
fn strokes_in_one_tone_run_far() {
    let mut stage = pen_stage(SIZE);
    let (mut table, mut failures) = (String::new(), Vec::new());
    for (sample, patches_px) in [(Sample::Hand, 75.0), (Sample::Head, 110.0)] {
        for (method, least_px) in [(Method::FineTone, patches_px), (Method::Stripes, 180.0)] {
            let subject = subject(sample, 20_000, method);
            let mut scene = lit(&subject);
            scene.lights = Lights { ambient: 0.7, lights: Vec::new() };
            let Shot { aov, measures, .. } = subject.shoot(&mut stage, &scene);
            let solid = Plane::from_fn(aov.size, |_, _| 1.0);
            let [px, possible_px] =
                [measures.run_length, run_length(&solid, &aov)].map(|run| run.mean_px.expect("strokes"));
            let row = format!("{:<5} {:<10} {px:>6.1} px of {possible_px:>6.1} px\n", sample.name(), method.name());
            if px < least_px {
                failures.push(row.clone());
            }
            table += &row;
        }
    }
    std::io::stdout().write_all(table.as_bytes()).expect("a table");
    assert!(failures.is_empty(), "\n{}", failures.concat());
}

#[test]
fn every_pixel_of_every_sample_is_painted() {
    paint_all(&[1_000, 20_000]);
}

#[test]
#[ignore = "surfaces of eleven meshes of 200,000 triangles take minutes"]
fn every_pixel_of_every_fine_sample_is_painted_too() {
    paint_all(&[200_000]);
}

/// Draws all samples in the dark, in every way that needs a surface.
fn paint_all(counts: &[usize]) {
    let base = RenderParams { mapping: Mapping::Patches, silhouettes: None, ..RenderParams::default() };
    let on = |mapping, method| RenderParams { mapping, method, ..base };
    let ways = [
        on(Mapping::Patches, Method::FineTone),
        on(Mapping::Patches, Method::SixWay),
        on(Mapping::Patches, Method::StrokeMap),
        on(Mapping::Lapped, Method::FineTone),
        on(Mapping::Patches, Method::Stripes),
        RenderParams { variety: 0.6, ..on(Mapping::Patches, Method::Stripes) },
    ];
    let options = SurfaceOptions {
        patches: Some(PatchOptions::default()),
        lapped: Some(LappedOptions::default()),
        stripes: Some(StripeOptions::default()),
        ..SurfaceOptions::default()
    };
    let mut stage = Stage::new("fine-pen", 128);
    for sample in Sample::ALL {
        for &triangles in counts {
            let mesh = prepare(sample.build(triangles)).expect("a sample").mesh;
            let surface = Surface::new(&mesh, &options).expect("a surface");
            let uploaded = stage.upload(&ways[0], &mesh, Some(&surface));
            let mut scene = Scene::of(&mesh);
            // All dark: paper that shows is a hole.
            scene.lights = Lights { ambient: 0.0, lights: Vec::new() };
            scene.transparent = true;
            for params in &ways {
                let pixels = stage.draw_uploaded(&scene, params, &uploaded);
                let what = format!(
                    "{} {triangles} {} {} {}",
                    sample.name(),
                    params.method.name(),
                    params.mapping.name(),
                    params.variety
                );
                assert_eq!(nan_count(&pixels), 0, "{what}");
                let shown: Vec<f32> = pixels.iter().filter(|p| p[3] > 0.0).map(|p| p[0]).collect();
                let paper = shown.iter().filter(|ink| **ink > 0.9).count();
                // The darkest column of the pen leaves a little paper between its strokes.
                assert!(!shown.is_empty() && paper * 8 < shown.len(), "{what}: {paper} of {} are paper", shown.len());
            }
        }
    }
}

/// A flat square of many tiles, seen from the front and filling the picture: its mean ink is the tone.
fn flat(method: Method, mapping: Mapping, tiles_per_unit: f64) -> (Subject, Scene) {
    let mesh = prepare(Sample::Quad.build(5_000)).expect("a quad").mesh;
    let params = RenderParams { method, mapping, tiles_per_unit, cross_from: None, ..RenderParams::default() };
    let subject = Subject::new(mesh, FieldSource::Curvature, params);
    let mut scene = Scene::of(&subject.mesh);
    scene.camera.azimuth_deg = 0.0;
    scene.camera.elevation_deg = 0.0;
    let places: Vec<DVec3> = subject.mesh.positions.iter().map(|p| p.as_dvec3()).collect();
    scene.camera.frame_points(&places, 1.0, 0.02);
    scene.transparent = true;
    (subject, scene)
}

/// Means over a thousand patches and more: what a patch shows of its tile is off by some hundredths. Where a stroke map is
/// not cut up, pixels meet the same places of every tile, and stand for all others.
#[test]
fn the_mean_ink_of_a_flat_square_is_the_tone_that_was_wanted() {
    let mut stage = pen_stage(1024);
    let (mut table, mut failures) = (String::new(), Vec::new());
    for method in [Method::SixWay, Method::FineTone, Method::StrokeMap] {
        for mapping in [Mapping::Uv, Mapping::Patches, Mapping::Lapped] {
            let most = if method == Method::StrokeMap && mapping != Mapping::Patches { 0.007 } else { 0.003 };
            let (subject, mut scene) = flat(method, mapping, 6.0);
            let mut row = format!("{:<10} {:<8}", method.name(), mapping.name());
            let mut worst: f64 = 0.0;
            for darkness in [0.1, 0.4, 0.7] {
                scene.lights = Lights { ambient: 1.0 - darkness, lights: Vec::new() };
                let bias = subject.shoot(&mut stage, &scene).measures.tone.expect("it is seen").ink.bias;
                worst = worst.max(bias.abs());
                row += &format!(" {bias:>+8.4}");
            }
            row += "\n";
            if worst > most {
                failures.push(row.clone());
            }
            table += &row;
        }
    }
    let mut out = std::io::stdout();
    out.write_all(format!("bias at darkness 0.1, 0.4, 0.7\n{table}").as_bytes()).expect("a table");
    assert!(failures.is_empty(), "\n{}", failures.concat());
}

/// What the strokes on a form are compared with: the same map at the same scale, whole, and in patches.
#[test]
fn strokes_in_patches_on_a_flat_square_are_nearly_as_long_as_those_of_the_map() {
    let mut stage = pen_stage(SIZE);
    let mut run_px = |mapping| {
        let (subject, mut scene) = flat(Method::FineTone, mapping, RenderParams::default().tiles_per_unit);
        scene.lights = Lights { ambient: 0.7, lights: Vec::new() };
        subject.shoot(&mut stage, &scene).measures.run_length.mean_px.expect("strokes")
    };
    let [whole_px, patches_px, lapped_px] = [Mapping::Uv, Mapping::Patches, Mapping::Lapped].map(&mut run_px);
    let row = format!("flat square: map {whole_px:.0} px, patches {patches_px:.0} px, lapped {lapped_px:.0} px\n");
    std::io::stdout().write_all(row.as_bytes()).expect("a row");
    assert!(patches_px > 0.7 * whole_px, "{row}");
}

/// Pixels per unit in the middle of a square picture.
fn px_per_unit(scene: &Scene, size: u32) -> f64 {
    let camera = &scene.camera;
    f64::from(size) / (2.0 * camera.distance * (camera.field_of_view_deg.to_radians() / 2.0).tan())
}

/// Most of the error of tone is the grain of the map itself: what it has on a flat square, drawn as large and as dark as the
/// mesh shows it, in as many tones.
#[test]
fn the_tone_on_a_form_is_nearly_as_even_as_on_a_flat_square() {
    let mut stage = pen_stage(SIZE);
    let (mut table, mut failures) = (String::new(), Vec::new());
    for sample in [Sample::Hand, Sample::Head] {
        let curved = subject(sample, 20_000, Method::FineTone);
        let scene = lit(&curved);
        let on_form = curved.shoot(&mut stage, &scene);
        let mut darkness: Vec<f64> = on_form.aov.pixels.iter().flatten().map(|at| at.darkness).collect();
        darkness.sort_by(f64::total_cmp);
        let tile_px = px_per_unit(&scene, SIZE) / curved.params.tiles_per_unit;
        let (_, square) = flat(Method::FineTone, Mapping::Uv, 1.0);
        let (subject, mut square) =
            (flat(Method::FineTone, Mapping::Uv, px_per_unit(&square, SIZE) / tile_px).0, square);
        let mut squares = Vec::new();
        for fifth in 0..5 {
            square.lights =
                Lights { ambient: 1.0 - darkness[darkness.len() * (2 * fifth + 1) / 10], lights: Vec::new() };
            let tone = subject.shoot(&mut stage, &square).measures.tone.expect("it is seen");
            squares.push(tone.ink.rmse.powi(2));
        }
        let on_square = (squares.iter().sum::<f64>() / squares.len() as f64).sqrt();
        let on_form = on_form.measures.tone.expect("it is seen").ink.rmse;
        let row = format!(
            "{:<5} patches {on_form:.4}, flat square {on_square:.4}: {:.2} times\n",
            sample.name(),
            on_form / on_square
        );
        if on_form > 1.5 * on_square {
            failures.push(row.clone());
        }
        table += &row;
    }
    std::io::stdout().write_all(table.as_bytes()).expect("a table");
    assert!(failures.is_empty(), "\n{}", failures.concat());
}

#[test]
fn patches_keep_the_tone_of_the_map() {
    let mut stage = pen_stage(512);
    for method in [Method::FineTone, Method::SixWay] {
        let subject = subject(Sample::Sphere, 20_000, method);
        for darkness in [0.15, 0.4, 0.65] {
            let mut scene = lit(&subject);
            scene.lights = Lights { ambient: 1.0 - darkness, lights: Vec::new() };
            let tone = subject.shoot(&mut stage, &scene).measures.tone.expect("it is seen");
            assert!(tone.ink.bias.abs() < 0.006, "{} at {darkness}: {tone}", method.name());
        }
    }
}

#[test]
fn strokes_on_the_surface_do_not_swim_and_those_that_follow_the_light_do_not_pop() {
    let mut stage = pen_stage(384);
    let at = |subject: &Subject, deg: f64| {
        let mut scene = lit(subject);
        let (sin, cos) = deg.to_radians().sin_cos();
        scene.lights.lights = vec![light_from(DVec3::new(sin, 0.6, cos))];
        scene
    };
    let mut still = subject(Sample::Hand, 8_000, Method::FineTone);
    let one_degree = still.film(&mut stage, |t| at(&still, 20.0 + t), 2);
    let swimming = one_degree.swimming.expect("ink").swimming;
    // Ink comes only where it grows darker, and goes only where it grows lighter, but for rounding to eight bits.
    assert!(swimming < 0.001, "{one_degree:?}");

    let surface = {
        still.params.follow = Follow::Light;
        surface_for(&still.params, &still.mesh).expect("patches")
    };
    let following = Subject { surface, ..still };
    let (mut worst, mut table): (f64, String) = (0.0, String::new());
    for start in [-40.0, 0.0, 35.0] {
        let motion = following.film(&mut stage, |t| at(&following, start + t), 3);
        let swimming = motion.swimming.expect("ink").swimming;
        worst = worst.max(swimming);
        assert!(motion.popping.expect("changes").slope > 0.7, "{motion:?}");
        table += &format!("light at {start}°: swimming {swimming:.4} per degree\n");
    }
    let figures = format!("fixed to the surface: swimming {swimming:.4} per degree\n{table}");
    std::io::stdout().write_all(figures.as_bytes()).expect("a table");
    assert!(worst < 0.05, "{table}");
}

#[test]
fn strokes_stay_as_wide_under_zoom() {
    let mut stage = pen_stage(384);
    for method in [Method::FineTone, Method::StrokeMap] {
        let subject = subject(Sample::Hand, 8_000, method);
        // Six steps through a factor of four, between levels of detail and on them; nearer than the finest level strokes
        // grow.
        let samples: Vec<(f64, f64)> = (0..6)
            .map(|step| {
                let zoom = 0.5 * 4.0_f64.powf(f64::from(step) / 5.0);
                let mut scene = lit(&subject);
                scene.lights = Lights { ambient: 0.85, lights: Vec::new() };
                scene.camera.distance /= zoom;
                let width = subject.shoot(&mut stage, &scene).measures.width.median_px.expect("strokes");
                (zoom, width)
            })
            .collect();
        let widths = || samples.iter().map(|(_, width)| *width);
        let (least, most) = (widths().fold(f64::INFINITY, f64::min), widths().fold(0.0, f64::max));
        assert!(most < 1.2 * least, "{}: {samples:.2?}: more than 10 % to both sides", method.name());
    }
}
