//! Strokes that nest are born and do not die while the view comes nearer; levels of unrelated strokes are the control.

use tam_gen::preset::PlacementMethod;
use tam_gen::{Job, Map, Preset, generate};
use tam_tests::gpu::Stage;
use tam_viewer::gpu::PixelFormat;
use tam_viewer::maps::HatchMap;
use tam_viewer::measure::{Aov, Track, Zoom, ink, zoom};
use tam_viewer::mesh::prepare;
use tam_viewer::mesh::sample::Sample;
use tam_viewer::{Camera, Lights, Mapping, Method, RenderParams, Scene};

/// Short strokes of full ink, so that many are born and each is clear.
const PEN: &str = r#"
schedule = ["a"]

[map]
size = 256
coarsest = 16
tones = 8

[stroke]
length_min = 0.15
length_max = 0.3
width_px = 2.0

[families]
a = { angle_deg = 0 }
"#;

/// Of paper with the strokes of the lightest column.
const LUMINANCE: f64 = 0.875;

const SIZE: [u32; 2] = [256, 256];

fn pen(change: impl FnOnce(&mut Preset)) -> Map {
    let mut preset = Preset::from_toml(PEN, "the pen").expect("a valid preset");
    change(&mut preset);
    generate(&preset, &Job::default()).expect("it generates")
}

/// A flat quad in one tone, from afar, where coarse levels are drawn, to twice as near, where finer ones are.
fn zoomed(map: &Map) -> Zoom {
    let mut stage = Stage::new("pencil", SIZE[0]);
    let map = stage.renderer.map(HatchMap::from_map("pen", map));
    let mesh = prepare(Sample::Quad.build(2)).expect("a quad").mesh;
    let gpu_mesh = stage.renderer.mesh(&mesh).expect("a mesh that fits");
    let target = stage.renderer.target(SIZE, 1, PixelFormat::Linear32).expect("a picture that fits");
    let params = RenderParams {
        method: Method::SixWay,
        mapping: Mapping::Uv,
        tiles_per_unit: 2.0,
        silhouettes: None,
        ..RenderParams::default()
    };
    let mut draw = |distance: f64| {
        let camera = Camera { azimuth_deg: 0.0, elevation_deg: 0.0, distance, ..Camera::default() };
        let lights = Lights { ambient: LUMINANCE, lights: Vec::new() };
        let scene = Scene { camera, lights, ..Scene::of(&mesh) };
        let aov = Aov::new(&mesh, &scene, SIZE, None).expect("a view");
        stage.renderer.render(&scene, &params, &gpu_mesh, &[&map], &target).expect("a frame");
        let pixels = target.read(&stage.renderer.gpu).expect("pixels").linear();
        let ink = ink(&pixels, &aov, &mesh, &scene);
        (scene, aov, ink)
    };
    let (far, near) = (draw(8.0), draw(4.0));
    let [forth, back] = [(&far, &near), (&near, &far)].map(|(from, to)| Track::new(&from.1, &to.1, &mesh, &to.0));
    zoom([&far.2, &near.2], [&far.1, &near.1], [&forth, &back], [3.0, 1.0], 16.0).expect("strokes")
}

#[test]
fn strokes_of_nested_levels_are_born_and_none_dies() {
    let found = zoomed(&pen(|_| ()));
    assert_eq!(found.deaths, 0.0, "{found}");
    assert!(found.births > 0.1 && found.pixels > 500, "{found:?}");
    assert!(found.deaths_by_chance > 0.1, "deaths would hardly be seen: {found}");
}

#[test]
fn levels_of_unrelated_random_strokes_die() {
    let mut map = pen(|preset| preset.placement.method = PlacementMethod::Random);
    for level in 1..map.grid.levels.len() {
        let other = pen(|preset| {
            preset.placement.method = PlacementMethod::Random;
            preset.seed = 100 + level as u64;
        });
        map.grid.levels[level] = other.grid.levels[level].clone();
    }
    let found = zoomed(&map);
    assert!(found.deaths > 0.1, "{found}");
    assert!(found.deaths > 0.5 * found.deaths_by_chance, "{found}");
}
