//! The measures on rendered pictures: each method scores as it should, and the controls fail.

use glam::DVec3;
use tam_tests::gpu::{light_from, scene_with};
use tam_tests::measure::{PEN_LENGTH, Subject, pen_stage};
use tam_viewer::measure::{MeasureOptions, Track, direction, motion_coherence, run_length};
use tam_viewer::mesh::prepare;
use tam_viewer::mesh::sample::Sample;
use tam_viewer::surface::FieldSource;
use tam_viewer::{Form, Mapping, Method, RenderParams, Scene};

const SIZE: u32 = 256;

/// Towards the light of all scenes.
const TO_LIGHT: DVec3 = DVec3::new(1.0, 2.0, 1.0);

fn subject(sample: Sample, triangles: usize, source: FieldSource, method: Method, mapping: Mapping) -> Subject {
    let mesh = prepare(sample.build(triangles)).expect("a sample").mesh;
    let params = RenderParams { method, mapping, tiles_per_unit: 1.5, ..RenderParams::default() };
    let mut subject = Subject::new(mesh, source, params);
    // At this size strokes lie 5 to 10 px apart.
    subject.options = MeasureOptions { tone_sigma_px: 16.0, ..MeasureOptions::default() };
    subject
}

/// Lit from above, with darkness up to 0.7 only: solid ink has no strokes.
fn lit() -> Scene {
    let mut scene = scene_with(light_from(TO_LIGHT));
    scene.lights.ambient = 0.3;
    scene
}

/// The same darkness everywhere.
fn even(darkness: f64) -> Scene {
    let mut scene = lit();
    scene.lights.ambient = 1.0 - darkness;
    scene.lights.lights.clear();
    scene
}

#[test]
fn phong_has_the_tone_and_no_strokes() {
    let subject = subject(Sample::Torus, 3_000, FieldSource::Curvature, Method::Phong, Mapping::Uv);
    let found = subject.shoot(&mut pen_stage(SIZE), &lit()).measures;
    let tone = found.tone.expect("it is seen");
    // Single pixels on contours are seen by one rasteriser and not by the other.
    assert!(tone.lightness.rmse < 0.05 && tone.ink.rmse < 5e-4, "{found}");
    assert!(tone.wanted_ink[1] - tone.wanted_ink[0] > 0.4, "{found}");
    assert!(found.direction.unclear_share > 0.98 && found.width.samples < 50, "{found}");
    assert!(found.greyness.share > 0.99, "{found}");
}

#[test]
fn a_flat_quad_shows_the_strokes_of_the_map() {
    let subject = subject(Sample::Quad, 2, FieldSource::Uv, Method::FineTone, Mapping::Uv);
    let mut stage = pen_stage(SIZE);
    // Four tiles on two units, of which the picture shows 8 tan 15°.
    let tile_px = f64::from(SIZE) / (8.0 * 15.0_f64.to_radians().tan()) / 2.0;
    let light = subject.shoot(&mut stage, &even(0.1));
    let tone = light.measures.tone.expect("it is seen");
    assert!(tone.ink.bias.abs() < 2e-3 && tone.ink.rmse < 8e-3, "{tone}");
    let run = light.measures.run_length;
    let px = run.mean_px.expect("strokes");
    // Strokes that follow one another within a pixel or two read as one, the first and last tile cut theirs.
    assert!((px / (PEN_LENGTH * tile_px) - 1.0).abs() < 0.2, "{px:.1} px of {:.1}", PEN_LENGTH * tile_px);
    // Askew by up to 2° and bowed a little.
    let off = light.measures.direction.mean_deg.expect("strokes");
    assert!(off < 2.5, "{}", light.measures);
    for darkness in [0.3, 0.5] {
        let tone = subject.shoot(&mut stage, &even(darkness)).measures.tone.expect("it is seen");
        assert!(tone.ink.bias.abs() < 2e-3 && tone.ink.rmse < 0.012, "{darkness}: {tone}");
    }
    // The control: strokes should run across.
    let mut across = light.aov.clone();
    across.pixels.iter_mut().flatten().for_each(|surface| surface.stroke_rad = Some(std::f64::consts::FRAC_PI_2));
    let off = direction(&light.ink, &across, 2.0).mean_deg.expect("strokes");
    let px = run_length(&light.ink, &across).mean_px.expect("strokes");
    assert!(off > 85.0 && px < 6.0, "{off:.1}°, {px:.1} px");
}

#[test]
fn frames_on_faces_smaller_than_strokes_miss_the_direction_that_uv_has() {
    let mut stage = pen_stage(SIZE);
    let mut shoot = |triangles, source, method, mapping| {
        let shot = subject(Sample::Sphere, triangles, source, method, mapping).shoot(&mut stage, &lit());
        shot.measures.direction.mean_deg.unwrap_or_else(|| panic!("no strokes: {}", shot.measures))
    };
    let uv = shoot(20_000, FieldSource::Uv, Method::FineTone, Mapping::Uv);
    let frames = shoot(100_000, FieldSource::Light(TO_LIGHT), Method::FaceFrame, Mapping::Frames);
    assert!(uv < 6.0 && frames > 15.0, "uv {uv:.1}°, frames {frames:.1}°");
}

#[test]
fn strokes_that_nest_neither_swim_nor_pop_and_literal_frames_do() {
    let mut stage = pen_stage(128);
    let quad = subject(Sample::Quad, 2, FieldSource::Uv, Method::StrokeMap, Mapping::Uv);
    let nested = quad.film(&mut stage, |t| even(0.3 + 0.1 * t), 4);
    // The light crosses the normal of the face in front: as printed, its frame turns by half at once.
    let mut frames = subject(Sample::Cube, 12, FieldSource::Constant(DVec3::X), Method::FaceFrame, Mapping::Frames);
    frames.params.form = Form::Literal;
    let crossing = |t: f64| {
        let mut scene = lit();
        scene.lights.lights = vec![light_from(DVec3::new(0.3 - 0.67 * t, 0.0, 1.0))];
        scene.lights.lights[0].intensity = 0.5;
        scene
    };
    let frames = frames.film(&mut stage, crossing, 4);
    let both = format!("{nested:?}\n{frames:?}");
    let [of_nested, of_frames] = [&nested, &frames].map(|motion| motion.swimming.expect("ink").swimming);
    assert!(of_nested < 0.01 && of_frames > 0.3, "{both}");
    let [of_nested, of_frames] = [&nested, &frames].map(|motion| motion.popping.expect("changes").slope);
    assert!(of_nested > 0.7 && of_frames < 0.3, "{both}");
    assert!(frames.flicker > 10.0 * nested.flicker, "{both}");
}

#[test]
fn strokes_on_the_surface_move_with_it_and_a_shower_door_does_not() {
    let mut stage = pen_stage(SIZE);
    let torus = subject(Sample::Torus, 3_000, FieldSource::Uv, Method::FineTone, Mapping::Uv);
    let turned = |azimuth_deg| {
        let mut scene = lit();
        scene.camera.azimuth_deg = azimuth_deg;
        scene
    };
    let (before, after) = (torus.shoot(&mut stage, &turned(0.0)), torus.shoot(&mut stage, &turned(6.0)));
    let track = Track::new(&before.aov, &after.aov, &torus.mesh, &turned(6.0));
    let baked = motion_coherence(&before.ink, &after.ink, &track, 16.0).expect("ink");
    let door = motion_coherence(&before.ink, &before.ink, &track, 16.0).expect("ink");
    assert!(baked.pixels > 10_000 && baked.change < 0.2 && door.change > 3.0 * baked.change, "{baked}\n{door}");
}
