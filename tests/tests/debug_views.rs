//! Debug views show what the method works with: right where the answer is known, on every mesh, never failing; and the
//! wireframe shows the edges that are seen.

use glam::{DVec2, DVec3, Vec3, vec3};
use tam_shaders::cpu::debug::{adjacency_colour, direction_colour, level_hue, none_colour};
use tam_shaders::cpu::lib::colour::oklch;
use tam_tests::gpu::{Stage, difference, light_from, loaded, mappings, nan_count, scene_with};
use tam_viewer::gpu::PixelFormat;
use tam_viewer::mesh::sample::Sample;
use tam_viewer::mesh::{Mesh, prepare};
use tam_viewer::{DebugView, Follow, Form, Inspect, Light, Lights, Mapping, Method, RenderParams, Scene};

const SIDE: u32 = 128;
/// Shades of the form differ by less than this over a flat square seen from the front.
const SHADE: f64 = 0.04;

fn stage() -> Stage {
    Stage::new("fine-pen", SIDE)
}

fn showing(debug: DebugView, scene: &Scene) -> Scene {
    Scene { inspect: Inspect { debug: Some(debug), ..Inspect::default() }, ..scene.clone() }
}

fn bare() -> RenderParams {
    RenderParams { silhouettes: None, ..RenderParams::default() }
}

fn quad() -> Mesh {
    prepare(Sample::Quad.build(2)).expect("a square").mesh
}

/// A square seen from the front, in light that makes it this dark.
fn square_at(darkness: f64) -> Scene {
    let mut scene = scene_with(light_from(DVec3::Z));
    scene.lights = Lights { ambient: 1.0 - darkness, lights: Vec::new() };
    scene
}

fn colour(pixel: &[f32; 4]) -> DVec3 {
    DVec3::new(pixel[0].into(), pixel[1].into(), pixel[2].into())
}

fn middle(pixels: &[[f32; 4]]) -> DVec3 {
    colour(&pixels[(SIDE * SIDE / 2 + SIDE / 2) as usize])
}

#[track_caller]
fn assert_near(found: DVec3, expected: DVec3, tolerance: f64) {
    assert!((found - expected).abs().max_element() < tolerance, "{found} for {expected}");
}

#[test]
fn every_view_differs_from_the_picture_and_from_the_others() {
    let mut stage = stage();
    let mesh = prepare(Sample::TorusKnot.build(2_000)).expect("a knot").mesh;
    let scene = scene_with(light_from(DVec3::new(-1.0, 1.0, 1.0)));
    let views = DebugView::ALL.map(|view| showing(view, &scene));
    let pictures: Vec<_> =
        std::iter::once(scene).chain(views).map(|scene| stage.draw(&scene, &bare(), &mesh)).collect();
    for (i, a) in pictures.iter().enumerate() {
        for (k, b) in pictures[..i].iter().enumerate() {
            assert!(difference(a, b) > 0.02, "{k} and {i}: {}", difference(a, b));
        }
    }
}

#[test]
fn tone_is_the_wanted_darkness_with_lines_where_it_is_a_columns() {
    let mut stage = stage();
    for darkness in [0.0, 0.3, 0.85] {
        let pixels = stage.draw(&showing(DebugView::Tone, &square_at(darkness)), &bare(), &quad());
        assert_near(middle(&pixels), DVec3::splat(1.0 - darkness), 1e-5);
    }
    let mesh = prepare(Sample::Sphere.build(20_000)).expect("a sphere").mesh;
    let scene = scene_with(light_from(DVec3::new(-0.4, 0.5, 1.0)));
    let shown = stage.draw(&showing(DebugView::Tone, &scene), &bare(), &mesh);
    let wanted = RenderParams { method: Method::Phong, silhouettes: None, ..RenderParams::default() };
    let wanted = stage.draw(&scene, &wanted, &mesh);
    let tones = stage.map.source.grid.tones.clone();
    let mut met = vec![0; tones.len()];
    for (shown, wanted) in shown.iter().zip(&wanted) {
        let darkness = 1.0 - f64::from(wanted[0]);
        let apart = |tone: &f64| (darkness - tone).abs();
        let (k, nearest) = tones.iter().enumerate().min_by(|a, b| apart(a.1).total_cmp(&apart(b.1))).expect("tones");
        let is_line = shown[0] - shown[2] > 0.05;
        met[k] += usize::from(is_line);
        // The sphere is 60 px wide, and nowhere but at its rim does a tone change by more in two pixels.
        assert!(!is_line || apart(nearest) < 0.12, "a line at {darkness}, {tones:?}");
        assert!(is_line || (shown[0] - wanted[0]).abs() < 0.06, "{shown:?} for {wanted:?}");
    }
    assert!(met.iter().filter(|pixels| **pixels > 10).count() >= 3, "{met:?} pixels of lines");
}

#[test]
fn a_texel_as_large_as_a_pixel_is_level_0_and_one_half_as_large_level_1() {
    let mut stage = stage();
    let mesh = quad();
    for mapping in [Mapping::Uv, Mapping::Triplanar] {
        // The square has 2 uv per unit, and uv are repeated a whole number of times.
        let params = RenderParams { mapping, tiles_per_unit: 2.0, ..bare() };
        let mut scene = showing(DebugView::Level, &square_at(0.5));
        // The map has 128 px.
        let one_to_one = 1.0 / (128.0 * params.tiles_per_unit * scene.camera.pixel_at_1(SIDE));
        let mut at = |distance: f64, level_bias| {
            scene.camera.distance = distance * one_to_one;
            stage.draw(&scene, &RenderParams { level_bias, ..params }, &mesh)
        };
        // A hair beyond, so that rounding does not hatch it.
        let near = 1.0 + 1e-4;
        assert_near(middle(&at(near, 0.0)), level_hue(0.0), SHADE);
        assert_near(middle(&at(2.0, 0.0)), level_hue(1.0), SHADE);
        assert_near(middle(&at(2.0_f64.sqrt(), 0.0)), level_hue(0.0).midpoint(level_hue(1.0)), SHADE);
        assert_near(middle(&at(near, 1.0)), level_hue(1.0), SHADE);
        let magnified = at(0.25, 0.0);
        let white = magnified.iter().filter(|pixel| colour(pixel).min_element() > 0.8).count();
        // 0.85 - 0.65 / 4.
        let share = white as f64 / f64::from(SIDE * SIDE);
        assert!((0.5..0.8).contains(&share), "{share} is white");
        // From 128 px to 1, the last is level 7: here 9 is wanted.
        let tiny = middle(&at(32.0, 4.0));
        assert!(tiny.max_element() < 0.1, "{tiny}");
    }
}

#[test]
fn columns_are_those_beside_the_tone_by_their_shares() {
    let mut stage = stage();
    let tones = stage.map.source.grid.tones.clone();
    // The view of a method that samples the map's own columns.
    let params = RenderParams { method: Method::FaceFrame, ..bare() };
    let shown = |darkness: f64| showing(DebugView::Columns, &square_at(darkness));
    let mut at = |darkness: f64| middle(&stage.draw(&shown(darkness), &params, &quad()));
    let white = at(0.0);
    let [first, second, third] = [0, 1, 2].map(|k| at(tones[k]));
    assert_near(white, DVec3::splat(white.x), 1e-5);
    for (a, b) in [(white, first), (first, second), (second, third), (first, third)] {
        assert!((a - b).abs().max_element() > 0.1, "{a} and {b} are told apart");
    }
    // A third of the way.
    assert_near(at(tones[1] + (tones[2] - tones[1]) / 3.0), second.lerp(third, 1.0 / 3.0), 2e-3);
    assert_near(at(tones[0] / 2.0), white.midpoint(first), 2e-3);
}

#[test]
fn directions_are_those_in_which_the_ink_runs() {
    let mut stage = stage();
    let mesh = quad();
    for (method, mapping) in [
        (Method::Halftone, Mapping::Uv),
        (Method::Halftone, Mapping::Triplanar),
        (Method::Halftone, Mapping::Frames),
        (Method::Halftone, Mapping::Patches),
        (Method::Stripes, Mapping::Uv),
    ] {
        for rotation_deg in [0.0, 30.0, 90.0, -50.0] {
            let mut scene = scene_with(light_from(DVec3::new(-1.0, 0.7, 0.8)));
            scene.materials[0].rotation_deg = rotation_deg;
            scene.camera.distance = 3.0;
            let ink =
                RenderParams { method, mapping, silhouettes: None, line_period_px: 8.0, ..RenderParams::default() };
            let drawn = stage.draw(&scene, &ink, &mesh);
            // The surface is the ink's.
            let surface = tam_tests::gpu::surface_for(&ink, &mesh);
            let uploaded = stage.upload(&ink, &mesh, surface.as_ref());
            let shown = stage.draw_uploaded(&showing(DebugView::Frames, &scene), &ink, &uploaded);
            let turned = (across(&drawn) - decoded(&shown) + 270.0) % 180.0 - 90.0;
            let what = format!("{} {} turned by {rotation_deg}", method.name(), mapping.name());
            // Edges of lines are a pixel wide, where differences over two pixels are off by 6 degrees at most.
            assert!(turned.abs() < 8.0, "{what}: {} shown, {} drawn", decoded(&shown), across(&drawn));
        }
    }
}

/// Angle in degrees across the gradients in the middle of a picture: that of its lines, counter-clockwise.
fn across(pixels: &[[f32; 4]]) -> f64 {
    let at = |x: usize, y: usize| f64::from(pixels[y * SIDE as usize + x][0]);
    let mut sum = DVec2::ZERO;
    for (x, y) in inside() {
        let g = DVec2::new(at(x + 1, y) - at(x - 1, y), at(x, y - 1) - at(x, y + 1));
        sum += DVec2::new(g.x * g.x - g.y * g.y, 2.0 * g.x * g.y);
    }
    sum.to_angle().to_degrees() / 2.0 + 90.0
}

/// Mean of the angles that colours stand for.
fn decoded(pixels: &[[f32; 4]]) -> f64 {
    let colours: Vec<(DVec2, DVec3)> = (0..180)
        .map(|deg| DVec2::from_angle(f64::from(2 * deg).to_radians()))
        // In the corner of a cell, where no tick is.
        .map(|direction| (direction, direction_colour(direction, DVec2::ZERO)))
        .collect();
    let mut sum = DVec2::ZERO;
    for (x, y) in inside() {
        let found = colour(&pixels[y * SIDE as usize + x]);
        // Ticks and shades darken alike.
        let hue = |colour: DVec3| colour / colour.element_sum();
        let apart = |c: &&(DVec2, DVec3)| (hue(c.1) - hue(found)).length();
        sum += colours.iter().min_by(|a, b| apart(a).total_cmp(&apart(b))).expect("colours").0;
    }
    sum.to_angle().to_degrees() / 2.0
}

/// Pixels in the middle.
fn inside() -> impl Iterator<Item = (usize, usize)> {
    let range = SIDE as usize / 4..SIDE as usize * 3 / 4;
    range.clone().flat_map(move |y| range.clone().map(move |x| (x, y)))
}

#[test]
fn neighbours_share_along_the_edge_they_have_in_common_and_nowhere_else() {
    let mut stage = stage();
    let scene = showing(DebugView::Adjacency, &square_at(0.5));
    let alone = loaded(&[vec3(-1.0, -1.0, 0.0), vec3(1.0, -1.0, 0.0), vec3(-1.0, 1.0, 0.0)], &[[0, 1, 2]]);
    let pixels = stage.draw(&scene, &bare(), &alone);
    assert!(pixels.iter().all(|pixel| colour(pixel).min_element() > 0.9), "one triangle has no neighbours");

    let corners = [[-1.0, -1.0], [1.0, -1.0], [1.0, 1.0], [-1.0, 1.0]].map(|[x, y]: [f32; 2]| Vec3::new(x, y, 0.0));
    let square = loaded(&corners, &[[0, 1, 2], [0, 2, 3]]);
    let pixels = stage.draw(&scene, &bare(), &square);
    // On the diagonal both weigh the same.
    assert_near(middle(&pixels), adjacency_colour(0.5), SHADE);
    // The camera is 4 away: the square fills the middle. A corner that is not on the diagonal is its own triangle's.
    let far = 20;
    let inner = |x: u32, y: u32| colour(&pixels[(y * SIDE + x) as usize]);
    assert!(inner(SIDE / 2 - far, SIDE / 2 - far).min_element() > inner(SIDE / 2 - 4, SIDE / 2 - 4).min_element());
    let seen = |p: &DVec3| (*p - DVec3::ONE).abs().max_element() > 1e-6;
    let shown: Vec<DVec3> = pixels.iter().map(colour).filter(seen).collect();
    let palest = shown.iter().map(|c| c.y).fold(0.0, f64::max);
    assert!(palest > 0.85, "{palest}");

    // Around the edge of a cube the cosine is 0.
    let cube = prepare(Sample::Cube.build(12)).expect("a cube").mesh;
    let mut scene = scene;
    (scene.camera.azimuth_deg, scene.camera.distance) = (0.0, 4.0);
    let folded = stage.draw(&scene, &bare(), &cube);
    let strongest = oklch(0.55, 0.22, 0.02);
    assert!(folded.iter().any(|pixel| (colour(pixel) - strongest).length() < 0.8), "diagonals are flat");
}

#[test]
fn a_triangle_has_one_colour_and_its_neighbour_another() {
    let mut stage = stage();
    let pixels = stage.draw(&showing(DebugView::Triangles, &square_at(0.2)), &bare(), &quad());
    let hue = |pixel: &[f32; 4]| colour(pixel) / colour(pixel).element_sum();
    let at = |x: u32, y: u32| hue(&pixels[(y * SIDE + x) as usize]);
    let (half, step) = (SIDE / 2, 12);
    // One of the two diagonals parts them.
    let sides = [[at(half - step, half), at(half, half - step)], [at(half + step, half), at(half, half + step)]];
    let crossed = [[sides[0][0], sides[1][1]], [sides[0][1], sides[1][0]]];
    let is_whole = |sides: &[[DVec3; 2]; 2]| {
        sides.iter().all(|[a, b]| (*a - *b).length() < 1e-4) && (sides[0][0] - sides[1][0]).length() > 0.01
    };
    assert!(is_whole(&sides) || is_whole(&crossed), "{sides:?}");
    assert_ne!(is_whole(&sides), is_whole(&crossed));
    // The same in the next frame.
    let again = stage.draw(&showing(DebugView::Triangles, &square_at(0.2)), &bare(), &quad());
    assert!(difference(&pixels, &again) < 1e-6);
}

#[test]
fn no_view_fails_or_has_pixels_without_a_number_whatever_the_mesh_lacks() {
    let mut stage = Stage { size: 32, ..Stage::new("fine-pen", 32) };
    for sample in [Sample::Quad, Sample::Cube, Sample::Hand] {
        let mut mesh = prepare(sample.build(300)).expect("a sample").mesh;
        mesh.uvs.clear();
        let uploaded = stage.renderer.mesh(&mesh).expect("a mesh that fits");
        let scene = scene_with(light_from(DVec3::new(0.3, 0.8, 0.5)));
        for method in Method::ALL {
            for (view, mapping) in DebugView::ALL.into_iter().flat_map(|view| Mapping::ALL.map(|m| (view, m))) {
                let form = if sample == Sample::Cube { Form::Literal } else { Form::Hardened };
                let params = RenderParams { method, mapping, form, variety: 0.5, ..bare() };
                let params = RenderParams { follow: Follow::Light, ..params };
                let pixels = stage.draw_uploaded(&showing(view, &scene), &params, &uploaded);
                let what = format!("{} {} {}", sample.name(), method.name(), view.name());
                assert_eq!(nan_count(&pixels), 0, "{what}");
                let lacks = match view {
                    DebugView::Frames => match method {
                        Method::Phong | Method::Stripes => true,
                        Method::FaceFrame => false,
                        _ => mapping == Mapping::Uv || mapping.takes_surface(),
                    },
                    DebugView::Level => match method {
                        Method::Phong | Method::Stripes | Method::Halftone => true,
                        Method::FaceFrame => false,
                        _ => mapping == Mapping::Uv,
                    },
                    _ => continue,
                };
                let grey = |p: &[f32; 4]| p[0] == p[1] && p[1] == p[2];
                assert_eq!(pixels.iter().all(grey), lacks, "{what} {}", mapping.name());
                if lacks {
                    let darkest = pixels.iter().map(|p| f64::from(p[0])).fold(1.0, f64::min);
                    assert!((0.5..1.01).contains(&(darkest / none_colour().x)), "{what}: {darkest}");
                }
            }
        }
    }
}

#[test]
fn views_of_surfaces_have_a_number_everywhere_under_any_light() {
    let mut stage = Stage::new("fine-pen", 48);
    let lights = [DVec3::Z, DVec3::NEG_Y, DVec3::new(0.3, 0.8, 0.5)].map(light_from);
    for sample in [Sample::Quad, Sample::Sphere, Sample::Hand] {
        let mesh = prepare(sample.build(1_500)).expect("a sample").mesh;
        let mut ways: Vec<RenderParams> =
            mappings(&mesh).into_iter().map(|mapping| RenderParams { mapping, ..RenderParams::default() }).collect();
        let mapping = Mapping::Patches;
        ways.push(RenderParams { mapping, follow: Follow::Light, ..RenderParams::default() });
        ways.push(RenderParams { method: Method::Stripes, ..RenderParams::default() });
        for params in ways {
            let surface = tam_tests::gpu::surface_for(&params, &mesh);
            let uploaded = stage.upload(&params, &mesh, surface.as_ref());
            for (light, view) in lights.iter().flat_map(|light: &Light| DebugView::ALL.map(|view| (*light, view))) {
                // The literal frame of a face that looks at the light is 0/0.
                let form = if sample == Sample::Quad { Form::Literal } else { Form::Hardened };
                let params = RenderParams { form, silhouettes: None, ..params };
                let pixels = stage.draw_uploaded(&showing(view, &scene_with(light)), &params, &uploaded);
                assert_eq!(nan_count(&pixels), 0, "{} {view:?} {params:?}", sample.name());
                let has_no_frame = form == Form::Literal && params.mapping == Mapping::Frames && light == lights[0];
                if has_no_frame && view == DebugView::Frames && params.method == Method::FineTone {
                    let shown = colour(&pixels[48 * 24 + 24]);
                    assert!((shown - none_colour()).abs().max_element() < SHADE, "{shown}");
                }
            }
        }
    }
}

#[test]
fn the_wireframe_is_drawn_on_seen_edges_and_nowhere_else() {
    let mut stage = stage();
    let cube = prepare(Sample::Cube.build(12)).expect("a cube").mesh;
    let mut scene = square_at(0.4);
    scene.camera.distance = 5.0;
    scene.transparent = true;
    let plain = RenderParams { method: Method::Phong, silhouettes: None, ..RenderParams::default() };
    let cube = stage.renderer.mesh(&cube).expect("a mesh that fits");
    // Targets of 32 bits take no lines.
    let target = stage.renderer.target([SIDE; 2], 1, PixelFormat::Linear16).expect("a small target");
    let mut draw = |scene: &Scene, wireframe: Option<f64>| {
        let scene = Scene { inspect: Inspect { wireframe, ..Inspect::default() }, ..scene.clone() };
        stage.renderer.render(&scene, &plain, &cube, &[&stage.map], &target).expect("a frame");
        target.read(&stage.renderer.gpu).expect("pixels").linear()
    };
    let without = draw(&scene, None);
    let with = draw(&scene, Some(1.5));
    let blue = |p: &[f32; 4]| p[3] > 0.0 && p[2] > p[0] + 0.1;
    assert_eq!(without.iter().filter(|p| blue(p)).count(), 0);
    let mut count = 0;
    let at =
        |i: usize| DVec2::new((i % SIDE as usize) as f64 + 0.5, (i / SIDE as usize) as f64 + 0.5) - f64::from(SIDE / 2);
    let front = without.iter().enumerate().filter(|(_, p)| p[3] > 0.0).map(|(i, _)| at(i).abs().max_element());
    let reach = front.fold(0.0, f64::max);
    for (i, pixel) in with.iter().enumerate().filter(|(_, p)| blue(p)) {
        count += 1;
        let p = at(i);
        // Seen from the front: the outline of the front face and one of its diagonals; the back face's outline, hidden,
        // would be within it.
        let outline = (p.abs().max_element() - reach).abs();
        let diagonal = (p.x.abs() - p.y.abs()).abs();
        assert!(outline < 2.5 || diagonal < 2.5, "{pixel:?} at {p}, the face reaches to {reach}");
    }
    let expected = 8.0 * reach + 2.0 * reach;
    assert!(f64::from(count) > expected, "{count} pixels of lines of {expected}");
    // On ink it is seen as well.
    let mut dark = scene;
    dark.lights.ambient = 0.0;
    let on_ink = draw(&dark, Some(1.5));
    let seen = on_ink.iter().filter(|p| p[3] > 0.0 && p[2] > 0.3).count();
    assert!(seen as f64 > expected, "{seen}");
}
