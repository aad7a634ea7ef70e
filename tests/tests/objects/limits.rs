//! What devices with few limits draw: every pipeline within WebGPU's default limits, and within those of WebGL 2 all that look
//! at no faces.

use std::collections::BTreeSet;

use tam_shaders::{Feed, Pass};
use tam_tests::gpu::{Stage, device_with, difference, surface_for};
use tam_viewer::gpu::PixelFormat;
use tam_viewer::mesh::prepare;
use tam_viewer::mesh::sample::Sample;
use tam_viewer::{
    Follow, Mapping, Method, RenderError, RenderParams, Renderer, Scene, Silhouettes, Tried, try_pipelines,
};

fn tried(limits: wgpu::Limits) -> Vec<Tried> {
    let gpu = device_with(limits);
    let target = tam_viewer::gpu::Target::new(&gpu, [8, 8], 1, PixelFormat::Srgb8).expect("a target");
    try_pipelines(&gpu, target.views().formats)
}

#[test]
fn every_pipeline_is_made_within_the_default_limits_of_webgpu() {
    let tried = tried(wgpu::Limits::default());
    let failed: Vec<&Tried> = tried.iter().filter(|tried| tried.error.is_some()).collect();
    assert!(failed.is_empty(), "{failed:#?}");
    let passes: BTreeSet<Pass> = tried.iter().map(|tried| tried.pass).collect();
    let feeds: BTreeSet<Feed> = tried.iter().filter_map(|tried| tried.feed).collect();
    assert_eq!(feeds, BTreeSet::from(Feed::ALL));
    // Both compute passes of faces are made at once, as are the lines and the list of them.
    let with_others = [Pass::FaceGeometry, Pass::LineEdges];
    assert_eq!(passes, Pass::ALL.into_iter().filter(|pass| !with_others.contains(pass)).collect());
}

#[test]
fn within_the_limits_of_webgl_2_all_is_made_that_looks_at_no_faces() {
    let all = tried(wgpu::Limits::downlevel_webgl2_defaults());
    let (mut made, mut refused) = (BTreeSet::new(), BTreeSet::new());
    for Tried { pass, feed, constants, error } in &all {
        match error {
            None => made.insert((*pass, *feed)),
            Some(error) => {
                // Without storage buffers and compute passes: nothing else is lacking.
                let lacks = ["storage", "Storage", "compute", "Compute"];
                assert!(lacks.iter().any(|word| error.contains(word)), "{} {constants:?}: {error}", pass.name());
                refused.insert((*pass, *feed))
            }
        };
    }
    let vertices = [Feed::Vertices, Feed::Uvs, Feed::Corners, Feed::Turning, Feed::Lapped];
    let mapped = [Pass::SixWay, Pass::StrokeMap, Pass::FineTone, Pass::Debug];
    let mut can: BTreeSet<_> = mapped.iter().flat_map(|pass| vertices.map(|feed| (*pass, Some(feed)))).collect();
    can.extend([(Pass::Phong, Some(Feed::Vertices)), (Pass::Debug, Some(Feed::Lines))]);
    can.extend([Feed::Lines, Feed::Strokes].map(|feed| (Pass::Stripes, Some(feed))));
    // Frames of faces are found by a compute pass, neighbours and faces are looked up in storage buffers, and so are lines.
    let mut cannot: BTreeSet<_> = mapped.iter().map(|pass| (*pass, Some(Feed::Faces))).collect();
    cannot.extend([(Pass::FaceFrame, Some(Feed::Faced)), (Pass::FaceFrameVertex, Some(Feed::Faces))]);
    cannot.extend([(Pass::Debug, Some(Feed::Faced)), (Pass::FaceFrames, None), (Pass::Lines, None)]);
    assert_eq!((made, refused), (can, cannot));
}

#[test]
fn a_device_without_storage_buffers_draws_the_same_picture_and_says_what_it_cannot() {
    let mesh = prepare(Sample::TorusKnot.build(2_000)).expect("a sample").mesh;
    let mut stage = Stage::new("fine-pen", 96);
    let mut renderer = Renderer::new(device_with(wgpu::Limits::downlevel_webgl2_defaults()));
    let map = renderer.map(std::sync::Arc::clone(&stage.map.source));
    let target = renderer.target([96, 96], 1, PixelFormat::Linear32).expect("a target");
    let mut scene = Scene::of(&mesh);
    scene.camera.distance = 5.0;
    let plain = RenderParams { silhouettes: None, ..RenderParams::default() };
    for params in [
        RenderParams { method: Method::Phong, ..plain },
        RenderParams { mapping: Mapping::Uv, method: Method::SixWay, ..plain },
        RenderParams { mapping: Mapping::Triplanar, method: Method::StrokeMap, ..plain },
        RenderParams { mapping: Mapping::Patches, ..plain },
        RenderParams { mapping: Mapping::Patches, follow: Follow::Light, ..plain },
        RenderParams { mapping: Mapping::Lapped, ..plain },
        RenderParams { method: Method::Stripes, ..plain },
        RenderParams { method: Method::Stripes, variety: 0.7, ..plain },
    ] {
        let expected = stage.draw(&scene, &params, &mesh);
        let mut uploaded = renderer.mesh(&mesh).expect("a mesh that fits");
        if let Some(surface) = surface_for(&params, &mesh) {
            renderer.attach(&mut uploaded, &surface).expect("a surface that fits");
        }
        renderer.render(&scene, &params, &uploaded, &[&map], &target).expect("a frame");
        let found = target.read(&renderer.gpu).expect("pixels").linear();
        let what = format!("{} {} {}", params.method.name(), params.mapping.name(), params.variety);
        assert!(difference(&found, &expected) < 1e-6, "{what}");
    }
    let uploaded = renderer.mesh(&mesh).expect("a mesh that fits");
    let target = renderer.target([96, 96], 1, PixelFormat::Srgb8).expect("a target");
    for params in [
        RenderParams { silhouettes: Some(Silhouettes::default()), ..plain },
        RenderParams { method: Method::FaceFrame, ..plain },
        RenderParams { mapping: Mapping::Frames, ..plain },
    ] {
        let error = renderer.render(&scene, &params, &uploaded, &[&map], &target).expect_err("there is no way to");
        assert!(matches!(error, RenderError::NoStorage { .. }), "{error}");
    }
}
