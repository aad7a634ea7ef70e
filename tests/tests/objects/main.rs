//! Frames of several objects, in anyone's encoder, views and device: each object as if it were alone, instances of one
//! upload, any number of parts.

mod limits;

use glam::{DMat4, DVec3, Vec3};
use tam_gen::srgb;
use tam_tests::gpu::{Stage, device_with, front_camera, mappings, renderer, scene_with, surface_for};
use tam_viewer::gpu::{PixelFormat, TargetFormats, TargetViews};
use tam_viewer::mesh::sample::Sample;
use tam_viewer::mesh::{Mesh, Part, prepare};
use tam_viewer::{
    Follow, Form, Inspect, Light, Mapping, Material, Method, Object, RenderError, RenderParams, Renderer, Scene,
};

const SIDE: u32 = 96;

fn sample(sample: Sample, triangles: usize) -> Mesh {
    prepare(sample.build(triangles)).expect("a sample").mesh
}

fn plain(method: Method, mapping: Mapping) -> RenderParams {
    RenderParams { method, mapping, silhouettes: None, ..RenderParams::default() }
}

fn lit() -> Scene {
    let mut scene = scene_with(Light::from_angles(-40.0, 45.0));
    scene.camera.distance = 9.0;
    scene
}

fn drawn(stage: &mut Stage, scene: &Scene, objects: &[Object<'_>], format: PixelFormat) -> Vec<[f32; 4]> {
    let target = stage.renderer.target([SIDE; 2], 1, format).expect("a target");
    stage.renderer.render_objects(scene, objects, &[&stage.map], &target, None).expect("a frame");
    target.read(&stage.renderer.gpu).expect("pixels").linear()
}

/// Pixels that differ by more than the last bits that a depth of another range leaves in interpolated places.
fn differing(a: &[[f32; 4]], b: &[[f32; 4]]) -> usize {
    let differs = |(a, b): &(&[f32; 4], &[f32; 4])| (0..4).any(|k| (a[k] - b[k]).abs() > 2e-3);
    a.iter().zip(b).filter(differs).count()
}

#[test]
fn objects_beside_each_other_look_as_if_each_were_alone() {
    let mut stage = Stage::new("fine-pen", SIDE);
    let scene = lit();
    let cube = sample(Sample::Cube, 300);
    let ball = sample(Sample::Sphere, 800);
    let looks = [
        plain(Method::FaceFrame, Mapping::Triplanar),
        RenderParams { follow: Follow::Light, ..plain(Method::SixWay, Mapping::Patches) },
        plain(Method::Stripes, Mapping::Triplanar),
        RenderParams { form: Form::Literal, ..plain(Method::StrokeMap, Mapping::Frames) },
    ];
    let meshes = [&cube, &ball, &ball, &cube];
    let uploaded: Vec<_> = looks
        .iter()
        .zip(meshes)
        .map(|(params, mesh)| stage.upload(params, mesh, surface_for(params, mesh).as_ref()))
        .collect();
    let materials = [Material { colour: [0.9, 0.7, 0.4], ..Material::default() }];
    let objects: Vec<_> = looks
        .iter()
        .zip(&uploaded)
        .zip([(-1.2, 1.2), (1.2, 1.2), (-1.2, -1.2), (1.2, -1.2)])
        .zip([[0.0; 3], [0.5, 0.0, 0.0], [0.0, 0.2, 0.5], [0.1, 0.3, 0.0]])
        .map(|(((params, mesh), (x, y)), ink)| {
            let world_from_mesh = DMat4::from_translation(DVec3::new(x, y, 0.0))
                * DMat4::from_rotation_y(x)
                * DMat4::from_scale(DVec3::splat(0.8));
            Object { mesh, world_from_mesh, params, ink, materials: &materials }
        })
        .collect();
    let together = drawn(&mut stage, &scene, &objects, PixelFormat::Linear16);
    let paper = drawn(&mut stage, &scene, &[], PixelFormat::Linear16);
    let mut joined = paper.clone();
    for object in &objects {
        let alone = drawn(&mut stage, &scene, &[*object], PixelFormat::Linear16);
        assert!(differing(&alone, &paper) > 300, "it is seen");
        for ((pixel, alone), paper) in joined.iter_mut().zip(&alone).zip(&paper) {
            if alone != paper {
                *pixel = *alone;
            }
        }
    }
    assert_eq!(differing(&together, &joined), 0);
    // Sorting by pipeline does not depend on the order in which objects are named.
    let reversed: Vec<_> = objects.iter().rev().copied().collect();
    assert_eq!(drawn(&mut stage, &scene, &reversed, PixelFormat::Linear16), together);
}

#[test]
fn a_nearer_object_hides_a_farther_one_whichever_is_named_first() {
    let mut stage = Stage::new("fine-pen", SIDE);
    let scene = lit();
    let params = plain(Method::Phong, Mapping::Triplanar);
    let cube = stage.renderer.mesh(&sample(Sample::Cube, 300)).expect("a mesh that fits");
    let coloured = |colour| [Material { colour, ..Material::default() }];
    let (red, blue) = (coloured([1.0, 0.0, 0.0]), coloured([0.0, 0.0, 1.0]));
    let object = |z, materials| Object {
        mesh: &cube,
        world_from_mesh: DMat4::from_translation(DVec3::new(0.0, 0.0, z)),
        params: &params,
        ink: [0.0; 3],
        materials,
    };
    let (near, far) = (object(2.0, &red[..]), object(-2.0, &blue[..]));
    for objects in [[near, far], [far, near]] {
        let pixels = drawn(&mut stage, &scene, &objects, PixelFormat::Linear32);
        let middle = pixels[(SIDE / 2 * SIDE + SIDE / 2) as usize];
        assert!(middle[0] > 0.1 && middle[2] == 0.0, "{middle:?}");
    }
}

#[test]
fn instances_share_an_upload_and_have_lines_and_frames_of_their_own() {
    let mut stage = Stage::new("fine-pen", SIDE);
    let scene = lit();
    let mesh = sample(Sample::TorusKnot, 4000);
    let gpu_mesh = stage.renderer.mesh(&mesh).expect("a mesh that fits");
    let once = gpu_mesh.bytes();
    let params = RenderParams { method: Method::FaceFrame, ..RenderParams::default() };
    let turned: Vec<_> = (0..10)
        .map(|k| {
            let turn = DMat4::from_rotation_y(f64::from(k) * 0.7) * DMat4::from_scale(DVec3::splat(0.3));
            DMat4::from_translation(DVec3::new(f64::from(k % 4) - 1.5, f64::from(k / 4) - 1.0, 0.0)) * turn
        })
        .map(|world_from_mesh| Object {
            mesh: &gpu_mesh,
            world_from_mesh,
            params: &params,
            ink: [0.0; 3],
            materials: &[],
        })
        .collect();
    let together = drawn(&mut stage, &scene, &turned, PixelFormat::Linear16);
    // What is computed where they stand: 48 bytes a triangle, and the lists of lines. The upload is some 60 more.
    let each = (gpu_mesh.bytes() - once) / 10;
    let triangles = u64::from(gpu_mesh.triangle_count());
    assert!((48 * triangles..68 * triangles).contains(&each), "{each} bytes for {triangles} triangles");
    let after_ten = gpu_mesh.bytes();
    let mut joined = drawn(&mut stage, &scene, &[], PixelFormat::Linear16);
    let paper = joined.clone();
    for object in &turned {
        let alone = drawn(&mut stage, &scene, &[*object], PixelFormat::Linear16);
        for ((pixel, alone), paper) in joined.iter_mut().zip(&alone).zip(&paper) {
            if alone != paper {
                *pixel = *alone;
            }
        }
    }
    // Soft edges of lines of neighbours that touch are blended twice.
    let wrong = differing(&together, &joined);
    assert!(wrong <= joined.len() / 200, "{wrong}");
    assert_eq!(gpu_mesh.bytes(), after_ten, "what was made stays");
}

#[test]
fn hundreds_of_parts_have_materials_of_their_own() {
    // A wall of flat squares, one part each, in as many colours.
    const ROWS: usize = 20;
    let (mut positions, mut triangles, mut parts, mut colours) = (Vec::new(), Vec::new(), Vec::new(), Vec::new());
    for k in 0..ROWS * ROWS {
        let (x, y) = ((k % ROWS) as f32, (k / ROWS) as f32);
        let corner = |dx: f32, dy: f32| Vec3::new(x + dx, y + dy, 0.0);
        let first = positions.len() as u32;
        positions.extend([corner(0.0, 0.0), corner(0.9, 0.0), corner(0.9, 0.9), corner(0.0, 0.9)]);
        triangles.extend([[first, first + 1, first + 2], [first, first + 2, first + 3]]);
        parts.push(Part { name: k.to_string(), colour: [1.0; 3], triangles: 2 * k as u32..2 * k as u32 + 2 });
        colours.push([k as f32 / 500.0, 1.0 - k as f32 / 500.0, 0.5]);
    }
    let mut mesh = tam_tests::gpu::loaded(&positions, &triangles);
    mesh.parts = parts;
    let mut stage = Stage::new("fine-pen", 400);
    let mut scene = Scene { camera: front_camera(), ..Scene::default() };
    scene.lights.ambient = 1.0;
    scene.lights.lights.clear();
    scene.materials = colours.iter().map(|colour| Material { colour: *colour, ..Material::default() }).collect();
    let pixels = stage.draw(&scene, &plain(Method::Phong, Mapping::Triplanar), &mesh);
    let clip_from_world = scene.camera.clip_from_world([400, 400], 3.0);
    for (k, colour) in colours.iter().enumerate() {
        let middle = mesh.triangles[2 * k].map(|vertex| mesh.positions[vertex as usize].as_dvec3());
        let placed = clip_from_world.project_point3((middle[0] + middle[1] + middle[2]) / 3.0);
        let [x, y] = [0.5 + 0.5 * placed.x, 0.5 - 0.5 * placed.y].map(|side| (side * 400.0) as usize);
        let pixel = pixels[y * 400 + x];
        assert!((0..3).all(|c| (pixel[c] - colour[c]).abs() < 1e-3), "part {k}: {pixel:?} for {colour:?}");
    }
}

#[test]
fn every_method_draws_on_a_device_with_default_limits_and_without_features() {
    let mut renderer = Renderer::new(device_with(wgpu::Limits::default()));
    let stage = Stage::new("fine-pen", SIDE);
    let map = renderer.map(std::sync::Arc::clone(&stage.map.source));
    let mesh = sample(Sample::Torus, 1500);
    let target = renderer.target([SIDE; 2], 4, PixelFormat::Srgb8).expect("a target");
    let wired = Scene { inspect: Inspect { wireframe: Some(1.0), ..Inspect::default() }, ..lit() };
    for method in Method::ALL {
        for mapping in mappings(&mesh).into_iter().filter(|mapping| *mapping == Mapping::Uv || method.takes_mapping()) {
            let params = RenderParams { method, mapping, ..RenderParams::default() };
            let mut uploaded = renderer.mesh(&mesh).expect("a mesh that fits");
            if let Some(surface) = surface_for(&params, &mesh) {
                renderer.attach(&mut uploaded, &surface).expect("a surface that fits");
            }
            // Errors of a device without a handler are panics.
            renderer.render(&wired, &params, &uploaded, &[&map], &target).expect("a frame");
            let picture = target.read(&renderer.gpu).expect("pixels").linear();
            let inked = picture.iter().filter(|pixel| pixel[0] < 0.5).count();
            assert!(inked > 200, "{method:?} {mapping:?}: {inked} pixels");
        }
    }
}

#[test]
fn a_frame_is_recorded_into_anyones_views_and_formats_that_take_none_are_named() {
    let mut stage = Stage::new("fine-pen", SIDE);
    let mesh = stage.renderer.mesh(&sample(Sample::Cube, 300)).expect("a mesh that fits");
    let scene = Scene::default();
    let params = plain(Method::SixWay, Mapping::Triplanar);
    let lined = RenderParams::default();
    let wanted = drawn(&mut stage, &scene, &[Object::of(&scene, &params, &mesh)], PixelFormat::Srgb8);
    let device = stage.renderer.gpu.device.clone();
    let texture = |format| {
        device.create_texture(&wgpu::TextureDescriptor {
            label: None,
            size: wgpu::Extent3d { width: SIDE, height: SIDE, depth_or_array_layers: 1 },
            mip_level_count: 1,
            sample_count: 1,
            dimension: wgpu::TextureDimension::D2,
            format,
            usage: wgpu::TextureUsages::RENDER_ATTACHMENT | wgpu::TextureUsages::COPY_SRC,
            view_formats: &[],
        })
    };
    let mut record = |params: &RenderParams, colour, depth| {
        let formats = TargetFormats { colour, depth, samples: 1 };
        let texture = texture(colour);
        let colours = texture.create_view(&wgpu::TextureViewDescriptor::default());
        let depths = formats.depth_view(&stage.renderer.gpu, [SIDE; 2]);
        let into = TargetViews::new(&colours, &depths, [SIDE; 2], formats);
        let mut encoder = device.create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
        let objects = [Object::of(&scene, params, &mesh)];
        stage.renderer.record(&mut encoder, &scene, &objects, &[&stage.map], &into)?;
        let bytes = copied(&mut encoder, &texture, &device);
        stage.renderer.gpu.queue.submit([encoder.finish()]);
        bytes.map_async(wgpu::MapMode::Read, .., |_| ());
        stage.renderer.gpu.wait()?;
        let mapped = bytes.get_mapped_range(..).expect("it was waited for").to_vec();
        Ok::<_, RenderError>(mapped)
    };
    let depths =
        [wgpu::TextureFormat::Depth32Float, wgpu::TextureFormat::Depth24Plus, wgpu::TextureFormat::Depth16Unorm];
    for depth in depths {
        let got = record(&params, wgpu::TextureFormat::Bgra8UnormSrgb, depth).expect("a frame");
        let same = |(got, wanted): &(&[u8], &[f32; 4])| {
            // Their colours come in another order; sRGB in eight bits is some thousandths of linear light apart.
            (0..3).all(|k| (srgb::linear(got[2 - k]) - wanted[k]).abs() < 5e-3)
        };
        let rows = got.chunks_exact(ROW_BYTES as usize).flat_map(|row| row[..4 * SIDE as usize].chunks_exact(4));
        let differ = rows.zip(&wanted).filter(|pair| !same(pair)).count();
        assert_eq!(differ, 0, "{depth:?}");
    }
    for (params, colour, depth, named) in [
        (&lined, wgpu::TextureFormat::Rgba32Float, depths[0], "blends no lines"),
        (&params, wgpu::TextureFormat::Rgba8Uint, depths[0], "whole numbers"),
    ] {
        let problem = record(params, colour, depth).expect_err("no such picture").to_string();
        assert!(problem.contains(named) && problem.contains(&format!("{colour:?}")), "{problem}");
    }
    assert!(record(&params, wgpu::TextureFormat::Rgba16Float, depths[0]).is_ok(), "errors do not stay");
}

/// Bytes of a row of pixels of up to eight bytes, padded as copies want it.
const ROW_BYTES: u32 = 768;

fn copied(encoder: &mut wgpu::CommandEncoder, texture: &wgpu::Texture, device: &wgpu::Device) -> wgpu::Buffer {
    let buffer = device.create_buffer(&wgpu::BufferDescriptor {
        label: None,
        size: u64::from(ROW_BYTES * SIDE),
        usage: wgpu::BufferUsages::COPY_DST | wgpu::BufferUsages::MAP_READ,
        mapped_at_creation: false,
    });
    let layout = wgpu::TexelCopyBufferLayout { offset: 0, bytes_per_row: Some(ROW_BYTES), rows_per_image: None };
    let to = wgpu::TexelCopyBufferInfo { buffer: &buffer, layout };
    encoder.copy_texture_to_buffer(texture.as_image_copy(), to, texture.size());
    buffer
}

#[test]
fn an_error_of_the_device_is_told_once() {
    let renderer = renderer();
    let size = 4 * renderer.gpu.device.limits().max_buffer_size;
    let _refused = renderer.gpu.device.create_buffer(&wgpu::BufferDescriptor {
        label: None,
        size,
        usage: wgpu::BufferUsages::COPY_DST,
        mapped_at_creation: false,
    });
    assert!(renderer.gpu.check().is_err());
    assert!(renderer.gpu.check().is_ok(), "what is drawn next may well succeed");
}
