//! What each stage of a generation costs, with criterion.

#![allow(missing_docs)]

use std::hint::black_box;

use criterion::{BenchmarkId, Criterion, Throughput, criterion_group, criterion_main};
use tam_gen::preset::PlacementMethod;
use tam_gen::raster::{Footprint, Grain, Nib, over};
use tam_gen::sequence::Sequence;
use tam_gen::{Generator, Job, Map, Preset, generate};

fn pencil(size: u32) -> Preset {
    let mut preset = Preset::named("pencil").expect("ships with the tool").expect("a valid preset");
    preset.map.size = size;
    preset
}

/// One stroke onto a level: our scan and tiny-skia's fill of the same outline.
fn raster(criterion: &mut Criterion) {
    let map = generate(&pencil(256), &Job::default()).expect("a valid preset");
    let stroke = map.strokes.strokes[0];
    let nib = Nib::new(&map.strokes.families[0]).expect("no tip");
    let mut group = criterion.benchmark_group("raster");
    for size in [32_u32, 256, 1024] {
        let mut footprint = Footprint::default();
        let mut ink = vec![0_u8; (size * size) as usize];
        group.bench_function(BenchmarkId::new("scan", size), |bencher| {
            bencher.iter(|| {
                nib.footprint(black_box(&stroke), size, &Grain::default(), &mut footprint);
                for (texel, above) in footprint.iter() {
                    ink[texel] = over(ink[texel], above);
                }
            });
        });
        let mut pixmap = tiny_skia::Pixmap::new(size, size).expect("a valid size");
        let path = {
            let mut path = tiny_skia::PathBuilder::new();
            for part in 0..=16_u8 {
                let t = f32::from(part) / 16.0;
                let (x, y) = ((stroke.start_uv + t * stroke.along_uv) * size as f32, stroke.across_at(t) * size as f32);
                if part == 0 { path.move_to(x, y) } else { path.line_to(x, y) }
            }
            path.finish().expect("a path")
        };
        let pen = tiny_skia::Stroke { width: stroke.width_px, ..Default::default() };
        group.bench_function(BenchmarkId::new("tiny-skia", size), |bencher| {
            bencher.iter(|| {
                pixmap.stroke_path(&path, &tiny_skia::Paint::default(), &pen, tiny_skia::Transform::identity(), None);
            });
        });
    }
    group.finish();
}

/// A hundred strokes of a sequence, lines and dots, by effort.
fn sequence(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("sequence");
    group.throughput(Throughput::Elements(100));
    let map = generate(&pencil(256), &Job::default()).expect("a valid preset");
    for effort in [1, 4, 16] {
        let mut preset = pencil(256);
        preset.placement.effort = effort;
        group.bench_function(BenchmarkId::new("lines", effort), |bencher| {
            bencher.iter(|| Sequence::new(&preset, 0, &map.strokes.families[0]).extend_to(100));
        });
    }
    let mut dots = map.strokes.families[0].clone();
    (dots.stroke.length_min, dots.stroke.length_max) = (0.0, 0.0);
    let preset = pencil(256);
    group.bench_function("dots", |bencher| {
        bencher.iter(|| Sequence::new(&preset, 0, &dots).extend_to(100));
    });
    group.finish();
}

/// Whole maps, stroke map included, with buffers kept.
fn map(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("map");
    group.sample_size(10);
    for size in [256_u32, 512, 1024] {
        for method in [PlacementMethod::Progressive, PlacementMethod::Random] {
            let mut preset = pencil(size);
            preset.placement.method = method;
            let (mut generator, mut map) = (Generator::new(), Map::default());
            group.bench_function(BenchmarkId::new(method.name(), size), |bencher| {
                bencher.iter(|| generator.generate_into(&preset, &Job::default(), &mut map).expect("a valid preset"));
            });
        }
    }
    group.finish();
}

/// Checking a finished map, and writing it.
fn after(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("after");
    group.sample_size(10);
    let map = generate(&pencil(256), &Job::default()).expect("a valid preset");
    group.bench_function("check", |bencher| bencher.iter(|| tam_gen::checks::check_map(black_box(&map))));
    let folder = tempfile::tempdir().expect("a temporary folder");
    let options = tam_gen::export::ExportOptions { overwrite: true, ..Default::default() };
    group.bench_function("export", |bencher| {
        bencher.iter(|| {
            tam_gen::export::export(&map, "pencil", folder.path(), &options, &Job::default())
                .expect("a writable folder")
        });
    });
    group.finish();
}

criterion_group!(stages, raster, sequence, map, after);
criterion_main!(stages);
