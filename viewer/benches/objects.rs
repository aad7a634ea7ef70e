//! What many objects cost: a thousand of them in ten looks against one mesh of the same triangles at the same places,
//! drawn in each of the looks; both in turn, round by round.
//!
//! `cargo bench -p tam-viewer --bench objects`. Times are of the device where it has timestamps; what the processor does
//! before is told beside.
#![allow(missing_docs, clippy::print_stdout)]

use std::time::Instant;

use glam::{DMat4, DVec3};
use tam_gen::{Job, Preset};
use tam_viewer::gpu::{Gpu, GpuOptions, PixelFormat};
use tam_viewer::maps::HatchMap;
use tam_viewer::mesh::sample::Sample;
use tam_viewer::mesh::{Mesh, prepare};
use tam_viewer::{Form, FrameTimer, Mapping, Method, Object, RenderError, RenderParams, Renderer, Scene};

type Error = Box<dyn std::error::Error>;

const ACROSS: u32 = 10;
const ROUNDS: usize = 11;

fn looks() -> Vec<RenderParams> {
    let methods = [Method::Phong, Method::SixWay, Method::StrokeMap, Method::Halftone, Method::FineTone];
    let mapping = Mapping::Triplanar;
    let of = |form: Form| {
        methods.map(|method| RenderParams { method, mapping, form, silhouettes: None, ..RenderParams::default() })
    };
    [of(Form::Hardened), of(Form::Literal)].concat()
}

fn median(times: &mut [f64]) -> f64 {
    times.sort_by(f64::total_cmp);
    times[times.len() / 2]
}

fn main() -> Result<(), Error> {
    // `cargo test --benches` only asks whether it builds.
    if std::env::args().any(|arg| arg == "--test") {
        return Ok(());
    }
    let mut renderer = Renderer::new(Gpu::open(&GpuOptions::default())?);
    println!("{}", renderer.gpu.adapter);
    let preset = Preset::named("pencil").ok_or("it comes with the tool")??;
    let map = renderer.map(HatchMap::from_preset("pencil", &preset, &Job::default())?);
    let target = renderer.target([1024; 2], 1, PixelFormat::Srgb8)?;
    let ball = prepare(Sample::Sphere.build(100))?.mesh;
    let world = |k: u32| {
        let at = DVec3::new(f64::from(k % ACROSS), f64::from(k / ACROSS % ACROSS), f64::from(k / ACROSS / ACROSS));
        DMat4::from_translation((at - DVec3::splat(4.5)) * 1.1) * DMat4::from_scale(DVec3::splat(0.5))
    };
    let places: Vec<DMat4> = (0..ACROSS * ACROSS * ACROSS).map(world).collect();
    let placed: Vec<(&Mesh, DMat4)> = places.iter().map(|world| (&ball, *world)).collect();
    let whole = Mesh::joined("all", &placed);
    let (ball, whole) = (renderer.mesh(&ball)?, renderer.mesh(&whole)?);
    let mut scene = Scene::default();
    scene.camera.distance = 30.0;
    let looks = looks();
    let objects: Vec<Object<'_>> = places
        .iter()
        .enumerate()
        .map(|(k, world)| Object {
            mesh: &ball,
            world_from_mesh: *world,
            params: &looks[k % looks.len()],
            ink: scene.ink,
            materials: &[],
        })
        .collect();
    let timer = FrameTimer::new(&renderer.gpu);
    let mut frame = |objects: &[Object<'_>]| -> Result<[f64; 2], Error> {
        let start = Instant::now();
        let mut recorded = 0.0;
        let time = timer.time::<RenderError>(&mut renderer, |renderer, timer| {
            renderer.render_objects(&scene, objects, &[&map], &target, Some(timer))?;
            recorded = start.elapsed().as_secs_f64() * 1e3;
            Ok(())
        })?;
        Ok([time.as_secs_f64() * 1e3, recorded])
    };
    let (mut many, mut one, mut ratios, mut recorded) = (Vec::new(), Vec::new(), Vec::new(), Vec::new());
    for round in 0..ROUNDS + 2 {
        let [all, before] = frame(&objects)?;
        let mut sum = 0.0;
        for params in &looks {
            sum += frame(&[Object { mesh: &whole, world_from_mesh: DMat4::IDENTITY, params, ..objects[0] }])?[0];
        }
        // The first rounds make pipelines.
        if round >= 2 {
            let mean = sum / looks.len() as f64;
            many.push(all);
            one.push(mean);
            ratios.push(all / mean);
            recorded.push(before);
        }
    }
    println!(
        "{} objects in {} looks: {:.1} ms; one object of as many triangles, mean of the looks: {:.1} ms; ratio {:.2}; \
         recorded in {:.1} ms",
        places.len(),
        looks.len(),
        median(&mut many),
        median(&mut one),
        median(&mut ratios),
        median(&mut recorded)
    );
    Ok(())
}
