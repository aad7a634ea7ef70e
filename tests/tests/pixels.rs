//! What an adapter draws is what the twins draw: every method, mapping and form, on a flat square and on a sphere.

use glam::{DVec2, DVec3, DVec4, Vec2, Vec4};
use tam_shaders::cpu::lib::columns::columns_per_tone;
use tam_shaders::cpu::{self, MapImage, Options, Sampling};
use tam_shaders::{Feed, Pass, types};
use tam_tests::gpu::{Stage, front_camera, light_from, mappings, surface_for};
use tam_viewer::gpu::GpuMap;
use tam_viewer::gpu::PixelFormat;
use tam_viewer::maps::tone_table;
use tam_viewer::mesh::sample::Sample;
use tam_viewer::mesh::{Mesh, prepare};
use tam_viewer::reference::{Draw, How, Reference, column_pairs, six_columns, thresholds};
use tam_viewer::surface::Corners;
use tam_viewer::{
    Blend, DebugView, FaceFrameForm, Follow, Form, Inspect, Lights, Mapping, Method, Object, Projection, RenderParams,
    Scene,
};

const SIDE: u32 = 96;

/// A method's pass, what it samples, the tones of that, and whether it has a distribution table.
struct Drawn {
    pass: Pass,
    map: MapImage,
    tones: Vec<f64>,
    distribution: Vec<Vec<DVec2>>,
}

fn drawn(params: &RenderParams, inspect: &Inspect, map: &GpuMap) -> Drawn {
    let source = &map.source;
    let columns = |pass| Drawn {
        pass,
        map: column_pairs(&source.grid),
        tones: source.grid.tones.clone(),
        distribution: Vec::new(),
    };
    if inspect.debug.is_some() {
        // Level and columns are those of the method's map, and this one has the map's own.
        assert_eq!(params.method, Method::FaceFrame);
        return columns(Pass::Debug);
    }
    match params.method {
        Method::Phong => columns(Pass::Phong),
        Method::FaceFrame if params.frames_made() == FaceFrameForm::Fetched => columns(Pass::FaceFrame),
        Method::FaceFrame => columns(Pass::FaceFrameVertex),
        Method::Halftone => columns(Pass::StrokeMap),
        Method::Stripes => columns(Pass::Stripes),
        Method::SixWay => {
            let six = source.six_columns();
            let tones = six.iter().map(|column| source.grid.tones[*column]).collect();
            Drawn { map: six_columns(&source.grid, &six), tones, ..columns(Pass::SixWay) }
        }
        Method::FineTone => {
            let fine = source.fine().expect("fine tones are made");
            Drawn { map: column_pairs(fine), tones: fine.tones.clone(), ..columns(Pass::FineTone) }
        }
        Method::StrokeMap => {
            let strokes = source.stroke_map.as_ref().expect("presets have a stroke map");
            let row = |row: &Vec<[f32; 2]>| row.iter().map(|entry| Vec2::from(*entry).as_dvec2()).collect();
            Drawn {
                pass: Pass::StrokeMap,
                map: thresholds(strokes),
                tones: vec![1.0],
                distribution: tone_table(strokes).iter().map(row).collect(),
            }
        }
    }
}

/// What vertices carry.
fn feed(params: &RenderParams, shown: Option<DebugView>) -> Feed {
    match (params.method, shown) {
        (_, Some(DebugView::Adjacency | DebugView::Triangles)) => Feed::Faced,
        (Method::Phong, _) => Feed::Vertices,
        (Method::FaceFrame, None) if params.frames_made() == FaceFrameForm::Fetched => Feed::Faced,
        (Method::FaceFrame, _) => Feed::Faces,
        (Method::Stripes, _) if params.variety > 0.0 => Feed::Strokes,
        (Method::Stripes, _) => Feed::Lines,
        _ => match params.mapping {
            Mapping::Uv => Feed::Uvs,
            Mapping::Frames => Feed::Faces,
            Mapping::Triplanar => Feed::Vertices,
            Mapping::Patches if params.follow == Follow::Light => Feed::Turning,
            Mapping::Patches => Feed::Corners,
            Mapping::Lapped => Feed::Lapped,
        },
    }
}

fn options(params: &RenderParams, inspect: &Inspect) -> Options {
    Options {
        form: params.form.into(),
        mapping: params.mapping.into(),
        blend: params.blend.into(),
        pattern: if params.method == Method::Halftone { cpu::PatternKind::Lines } else { cpu::PatternKind::Strokes },
        follow: params.follow.into(),
        debug: inspect.debug.map_or(cpu::DebugView::None, |view| match view {
            DebugView::Tone => cpu::DebugView::Tone,
            DebugView::Level => cpu::DebugView::Level,
            DebugView::Columns => cpu::DebugView::Columns,
            DebugView::Frames => cpu::DebugView::Frames,
            DebugView::Adjacency => cpu::DebugView::Adjacency,
            DebugView::Triangles => cpu::DebugView::Triangles,
        }),
        frames: if params.face_frame == FaceFrameForm::Vertex { cpu::Frames::Here } else { cpu::Frames::Fetched },
    }
}

/// The material of the scene's defaults, made anew from what the parameters say.
fn material(params: &RenderParams, mesh: &Mesh, drawn: &Drawn) -> types::Material {
    let by_uv = params.mapping == Mapping::Uv && params.method != Method::FaceFrame;
    let scale = match mesh.uv_density() {
        Some(density) if by_uv => (params.tiles_per_unit / density).round().max(1.0),
        _ => params.tiles_per_unit,
    } as f32;
    // Patches are stored in tiles already.
    let in_tiles = if params.needed_mapping().is_some_and(Mapping::takes_surface) { 1.0 } else { scale };
    let mut tones = [[0.0; 4]; 17];
    for (k, tone) in drawn.tones.iter().enumerate() {
        tones.as_flattened_mut()[k + 1] = *tone as f32;
    }
    types::Material {
        colour: [1.0; 4],
        ambient: 1.0,
        diffuse: 1.0,
        specular: 0.0,
        shininess: 24.0,
        tile_from_surface: [in_tiles, 0.0, 0.0, in_tiles],
        shift_uv: [0.0; 2],
        tile_scale: scale,
        size_px: drawn.map.levels[0].size as f32,
        level_count: drawn.map.levels.len() as f32,
        level_bias: params.level_bias as f32,
        column_count: drawn.tones.len() as u32,
        first_face: 0,
        slope: params.slope as f32,
        line_period_px: params.line_period_px as f32,
        distribution_entries: drawn.distribution.first().map_or(0, Vec::len) as f32,
        cross_from: params.cross_from.unwrap_or(1.0) as f32,
        variety: params.variety as f32,
        columns_per_tone: columns_per_tone(&drawn.tones) as f32,
        _pad_a: 0.0,
        _pad_b: 0.0,
        tones,
    }
}

/// How two pictures differ.
#[derive(Clone, Copy, Debug)]
struct Difference {
    /// Share of the pixels drawn that differ by more than 3/255.
    share: f64,
    /// Mean difference over the pixels drawn.
    mean: f64,
    /// Share of pixels that only one of them covers.
    outline: f64,
}

/// The picture against the twins', with samplers of both kinds: whichever the adapter has, all of the picture is drawn with
/// it.
fn compare(stage: &mut Stage, scene: &Scene, params: &RenderParams, mesh: &Mesh) -> Difference {
    let found = stage.draw(scene, params, mesh);
    let mut drawn = drawn(params, &scene.inspect, &stage.map);
    let differences = [Sampling::Exact, Sampling::EightBits].map(|sampling| {
        drawn.map.sampling = sampling;
        difference(&found, &drawn, scene, params, mesh)
    });
    let [exact, rounded] = differences;
    if exact.mean < rounded.mean { exact } else { rounded }
}

fn difference(found: &[[f32; 4]], drawn: &Drawn, scene: &Scene, params: &RenderParams, mesh: &Mesh) -> Difference {
    let material = material(params, mesh, drawn);
    let radius = mesh.positions.iter().map(|p| p.length()).fold(0.0, f32::max);
    let shared = scene.shared([SIDE; 2], radius.into());
    let triangles = 0..mesh.triangles.len() as u32;
    let surface = surface_for(params, mesh);
    let patches = surface.as_ref().and_then(|surface| surface.patches.as_ref().or(surface.lapped.as_ref()));
    let follows = surface.as_ref().filter(|_| params.follow == Follow::Light);
    let turns = follows.map_or(Vec::new(), |surface| surface.turns(&shared, scene.world_from_mesh));
    let turns: Vec<DVec4> = turns.iter().map(|turn| Vec4::from(*turn).as_dvec4()).collect();
    let stripes = surface.as_ref().and_then(|surface| surface.stripes.as_ref());
    let corners = match stripes {
        Some(stripes) => Some(Corners::of_stripes(&mesh.triangles, stripes, patches)),
        None => patches.map(|patches| Corners::of_patches(&mesh.triangles, patches)),
    };
    let (map, distribution, corners) = (&drawn.map, &drawn.distribution, corners.as_ref());
    let draws = [Draw { triangles, material: &material, map, distribution, corners, turns: &turns }];
    let (pass, feed) = (drawn.pass, feed(params, scene.inspect.debug));
    let how = How { pass, feed, options: options(params, &scene.inspect), samples: 1 };
    let twin = Reference::new(mesh).render(&shared, &draws, &how).expect("the reference draws");

    let (mut pixels, mut differing, mut sum, mut outline) = (0.0, 0.0, 0.0, 0.0);
    for (i, pixel) in found.iter().enumerate() {
        let covered = pixel[3] != 0.0;
        if covered != (twin.coverage[i] > 0.0) {
            outline += 1.0;
        } else if covered {
            let expected = twin.colours[i];
            pixels += 1.0;
            // Where the literal form divides by nothing, both do.
            if expected.is_nan() && pixel[0].is_nan() {
                continue;
            }
            let difference = (f64::from(pixel[0]) - expected.x).abs();
            let is_close = difference <= 3.0 / 255.0;
            differing += f64::from(!is_close);
            sum += if difference.is_nan() { 1.0 } else { difference };
        }
    }
    assert!(pixels > 0.1 * f64::from(SIDE * SIDE), "{pixels} pixels are drawn");
    Difference { share: differing / pixels, mean: sum / pixels, outline: outline / f64::from(SIDE * SIDE) }
}

/// Greatest share of pixels that differ, and greatest mean difference. Where a sampler rounds otherwise than the twins' it
/// is off by a step of 8 bits. A threshold makes of it up to 24 times as much at the edges of strokes, and only there.
fn bounds(params: &RenderParams) -> (f64, f64) {
    match params.method {
        Method::Phong => (0.0, 1e-6),
        Method::StrokeMap => (0.03, 0.002),
        _ => (0.004, 0.002),
    }
}

fn scene() -> Scene {
    let lights = Lights { ambient: 0.15, lights: vec![light_from(DVec3::new(-0.5, 0.6, 0.7))] };
    Scene { camera: front_camera(), lights, transparent: true, ..Scene::default() }
}

/// Every way to draw that differs: methods with their mappings, both forms, and `face-frame` in its three places.
fn ways(mesh: &Mesh) -> Vec<RenderParams> {
    let mut ways = Vec::new();
    for method in Method::ALL {
        for form in [Form::Hardened, Form::Literal] {
            let base = RenderParams { method, form, silhouettes: None, ..RenderParams::default() };
            match method {
                Method::Phong => ways.push(base),
                Method::Stripes => ways.extend([0.0, 0.7].map(|variety| RenderParams { variety, ..base })),
                Method::FaceFrame => {
                    ways.push(base);
                    if form == Form::Hardened {
                        ways.push(RenderParams { face_frame: FaceFrameForm::Vertex, ..base });
                        ways.push(RenderParams { face_frame: FaceFrameForm::Fetched, ..base });
                    }
                }
                _ => ways.extend(mappings(mesh).into_iter().map(|mapping| RenderParams { mapping, ..base })),
            }
        }
    }
    ways
}

fn failures(sample: Sample, triangles: usize) -> Vec<String> {
    let mesh = prepare(sample.build(triangles)).expect("a mesh").mesh;
    let mut stage = Stage::new("pencil", SIDE);
    let mut failures = Vec::new();
    for params in ways(&mesh) {
        let difference = compare(&mut stage, &scene(), &params, &mesh);
        let (share, mean) = bounds(&params);
        // Places on the screen are rounded to 1/256 of a pixel, so an outline may pass a pixel's middle on either side.
        if difference.share > share || difference.mean > mean || difference.outline > 0.001 {
            failures.push(format!(
                "{} {:?} {:?} {:?}: {difference:?}",
                params.method.name(),
                params.mapping,
                params.form,
                params.face_frame
            ));
        }
    }
    failures
}

#[test]
fn a_flat_square_is_drawn_as_the_twins_draw_it() {
    let failures = failures(Sample::Quad, 2);
    assert!(failures.is_empty(), "{}", failures.join("\n"));
}

#[test]
fn a_sphere_is_drawn_as_the_twins_draw_it() {
    let failures = failures(Sample::Sphere, 800);
    assert!(failures.is_empty(), "{}", failures.join("\n"));
}

#[test]
fn patterns_that_fade_into_each_other_are_drawn_as_the_twins_draw_them() {
    let mesh = prepare(Sample::Sphere.build(800)).expect("a mesh").mesh;
    let mut stage = Stage::new("pencil", SIDE);
    for method in Method::ALL.into_iter().filter(|method| method.takes_mapping()) {
        for mapping in [Mapping::Triplanar, Mapping::Patches] {
            let joined = RenderParams { method, mapping, silhouettes: None, ..RenderParams::default() };
            let params = RenderParams { blend: Blend::Linear, ..joined };
            let what = format!("{} {mapping:?}", method.name());
            check(&mut stage, &scene(), &params, &mesh);
            let [faded, joined] = [params, joined].map(|params| stage.draw(&scene(), &params, &mesh));
            let differing = faded.iter().zip(&joined).filter(|(a, b)| (a[0] - b[0]).abs() > 3.0 / 255.0).count();
            // Six columns on three planes always fade; elsewhere a union is another picture.
            let fades = method == Method::SixWay && mapping == Mapping::Triplanar;
            assert!(fades || differing as f64 > 0.1 * f64::from(SIDE * SIDE), "{what}: {differing}");
        }
    }
}

/// Whether a picture is the twins', but for what rounding makes of it.
fn check(stage: &mut Stage, scene: &Scene, params: &RenderParams, mesh: &Mesh) {
    let difference = compare(stage, scene, params, mesh);
    let (share, mean) = bounds(params);
    let close = difference.share <= share && difference.mean <= mean && difference.outline <= 0.001;
    assert!(close, "{params:?}: {difference:?}");
}

#[test]
fn parallel_lines_of_sight_and_a_roll_are_drawn_as_the_twins_draw_them() {
    let mesh = prepare(Sample::Sphere.build(800)).expect("a mesh").mesh;
    let mut stage = Stage::new("pencil", SIDE);
    let mut scene = scene();
    (scene.camera.projection, scene.camera.roll_deg) = (Projection::Orthographic, 35.0);
    let plain = RenderParams { silhouettes: None, ..RenderParams::default() };
    for form in [Form::Hardened, Form::Literal] {
        for (method, mapping, face_frame) in [
            (Method::SixWay, Mapping::Patches, FaceFrameForm::Fetched),
            (Method::FineTone, Mapping::Triplanar, FaceFrameForm::Fetched),
            (Method::FaceFrame, Mapping::Frames, FaceFrameForm::Vertex),
            (Method::Halftone, Mapping::Uv, FaceFrameForm::Fetched),
        ] {
            check(&mut stage, &scene, &RenderParams { method, mapping, form, face_frame, ..plain }, &mesh);
        }
    }
    // The outline of a ball of radius 1 is a circle as large as the opening says, and its strokes are as fine near as far.
    let picture = stage.draw(&scene, &plain, &mesh);
    let covered = picture.iter().filter(|pixel| pixel[3] != 0.0).count() as f64;
    let pixel = scene.camera.pixel_at_1(SIDE) * scene.camera.distance;
    assert!((covered * pixel * pixel / std::f64::consts::PI - 1.0).abs() < 0.02, "{covered} pixels of {pixel}");
}

#[test]
fn patches_that_follow_the_light_are_drawn_as_the_twins_draw_them() {
    let mesh = prepare(Sample::Sphere.build(800)).expect("a mesh").mesh;
    let mut stage = Stage::new("pencil", SIDE);
    for method in [Method::SixWay, Method::StrokeMap, Method::FineTone] {
        let params = RenderParams { method, mapping: Mapping::Patches, silhouettes: None, ..RenderParams::default() };
        check(&mut stage, &scene(), &RenderParams { follow: Follow::Light, ..params }, &mesh);
    }
}

#[test]
fn four_samples_differ_from_one_at_outlines_alone() {
    let mesh = prepare(Sample::Sphere.build(800)).expect("a mesh").mesh;
    let mut stage = Stage::new("pencil", SIDE);
    let side = SIDE as usize;
    for method in [Method::SixWay, Method::FineTone, Method::Halftone, Method::Stripes] {
        let params = RenderParams { method, mapping: Mapping::Triplanar, silhouettes: None, ..RenderParams::default() };
        let uploaded = stage.upload(&params, &mesh, surface_for(&params, &mesh).as_ref());
        let scene = scene();
        let mut drawn = |samples| {
            let target = stage.renderer.target([SIDE; 2], samples, PixelFormat::Linear16).expect("a target");
            let objects = [Object::of(&scene, &params, &uploaded)];
            stage.renderer.render_objects(&scene, &objects, &[&stage.map], &target, None).expect("a frame");
            target.read(&stage.renderer.gpu).expect("pixels").linear()
        };
        let [one, four] = [1, 4].map(&mut drawn);
        let (mut inside, mut soft) = (0, 0);
        for (i, pixel) in four.iter().enumerate() {
            let (x, y) = (i % side, i / side);
            let around = (y.saturating_sub(1)..(y + 2).min(side))
                .flat_map(|y| (x.saturating_sub(1)..(x + 2).min(side)).map(move |x| y * side + x));
            // Where triangles meet, samples of one pixel are shaded as different ones.
            if around.clone().all(|at| one[at][3] == 1.0) {
                inside += usize::from((pixel[0] - one[i][0]).abs() > 0.02);
            }
            soft += usize::from(pixel[3] > 0.0 && pixel[3] < 1.0);
        }
        assert!(inside < side * side / 50 && soft > side, "{method:?}: {inside} inside, {soft} at the outline");
    }
}

#[test]
fn debug_views_are_drawn_as_the_twins_draw_them() {
    let mesh = prepare(Sample::Sphere.build(800)).expect("a mesh").mesh;
    let mut stage = Stage::new("pencil", SIDE);
    for debug in DebugView::ALL {
        // What `face-frame` lies by, whatever the mapping.
        let method = Method::FaceFrame;
        let params = RenderParams { method, mapping: Mapping::Frames, silhouettes: None, ..RenderParams::default() };
        let scene = Scene { inspect: Inspect { debug: Some(debug), ..Inspect::default() }, ..scene() };
        let difference = compare(&mut stage, &scene, &params, &mesh);
        // Derivatives at a triangle's edge may be those of its row's or its column's other pixels: lines and ticks are
        // a little different there.
        assert!(difference.share < 0.01 && difference.mean < 0.001, "{debug:?}: {difference:?}");
    }
}

#[test]
fn a_picture_of_another_scene_is_noticed() {
    let mesh = prepare(Sample::Sphere.build(800)).expect("a mesh").mesh;
    let mut stage = Stage::new("pencil", SIDE);
    let params = RenderParams { silhouettes: None, ..RenderParams::default() };
    let finer = RenderParams { tiles_per_unit: 1.01 * params.tiles_per_unit, ..params };
    let lit = scene();
    let found = stage.draw(&lit, &finer, &mesh);
    let right = stage.draw(&lit, &params, &mesh);
    // Tiles that are a hundredth smaller are more than the bounds allow.
    let differing = found.iter().zip(&right).filter(|(a, b)| (a[0] - b[0]).abs() > 3.0 / 255.0).count();
    assert!(differing as f64 > 0.06 * f64::from(SIDE * SIDE), "{differing}");
}
