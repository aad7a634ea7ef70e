//! Every function of the shaders, run on an adapter with thousands of inputs, agrees with its twin in `f64`.
//!
//! A row of a table names the function, how WGSL calls it, and its twin; one harness draws a square of pixels, each of
//! which is a case. Pixels stand in quads, so functions that take derivatives are compared like all others.

mod draw;
mod gpu;
mod row;
mod setting;
mod tables;

use std::collections::BTreeSet;

use glam::DVec4;
use tam_shaders::cpu::lib::mesh_types::FaceFrame;
use tam_shaders::cpu::{Form, Options, face_frames, face_geometry, line_edges};
use tam_shaders::{Feed, Pass, compose};

use gpu::Gpu;
use row::Row;
use setting::{FACES, Setting, Uploaded};

#[test]
fn every_shader_function_agrees_with_its_twin() {
    let gpu = Gpu::new();
    let settings = Setting::all();
    let failures: Vec<String> = tables::all().iter().flat_map(|row| row.failures(&gpu, &settings)).collect();
    assert!(failures.is_empty(), "{}", failures.join("\n"));
}

#[test]
fn a_wrong_twin_is_noticed() {
    let gpu = Gpu::new();
    let settings = Setting::all();
    let mut rows = tables::all();
    rows.retain(|row| ["tile_uv", "half_angle", "map_uv"].contains(&row.name));
    assert_eq!(rows.len(), 3);
    for row in &mut rows {
        let twin = row.twin.clone();
        // Off by a thousandth.
        row.twin = std::sync::Arc::new(move |b, quad, lane| twin(b, quad, lane) * 1.001);
        assert!(!row.failures(&gpu, &settings).is_empty(), "{}", row.name);
    }
}

#[test]
fn every_shader_function_has_a_row() {
    let mut functions = BTreeSet::new();
    for pass in Pass::ALL {
        let source = compose(pass);
        let names = source.lines().filter_map(|line| line.strip_prefix("fn ")?.split('(').next());
        let others = [
            "fragment",
            "fragment_lapped",
            "fragment_lines",
            "fragment_strokes",
            "fragment_faces",
            "main",
            "mark",
            "sum",
            "list",
        ];
        let is_entry = |name: &str| others.contains(&name) || Feed::ALL.iter().any(|feed| feed.vertex_entry() == name);
        functions.extend(names.filter(|name| !is_entry(name)).map(str::to_owned));
    }
    let rows: BTreeSet<String> = tables::all().iter().map(|row| row.name.to_owned()).collect();
    assert_eq!(functions.difference(&rows).collect::<Vec<_>>(), Vec::<&String>::new(), "functions without a row");
    assert_eq!(rows.difference(&functions).collect::<Vec<_>>(), Vec::<&String>::new(), "rows without a function");
}

/// The greatest difference of two buffers in one component.
fn worst(found: &[[f32; 4]], expected: &[DVec4]) -> f64 {
    assert_eq!(found.len(), expected.len());
    let difference =
        |(found, expected): (&[f32; 4], &DVec4)| (DVec4::from(found.map(f64::from)) - *expected).abs().max_element();
    found.iter().zip(expected).map(difference).fold(0.0, f64::max)
}

#[test]
fn face_passes_fill_the_buffers_that_their_twins_fill() {
    let gpu = Gpu::new();
    let groups = (FACES as u32).div_ceil(64);
    for (setting, form) in
        Setting::all().iter().flat_map(|setting| [(setting, Form::Hardened), (setting, Form::Literal)])
    {
        let options = Options { form, ..Options::default() };
        let b = setting.bindings(options);
        let uploaded = Uploaded::new(&gpu, setting, &[]);
        let buffer = |name| uploaded.buffer(name).expect("it was uploaded");
        let (normals, planes, frames) = (buffer("face_normals"), buffer("face_planes"), buffer("face_frames"));

        let source = compose(Pass::FaceGeometry);
        let resource = |name: &str| uploaded.resource(name);
        let [found_normals, found_planes] =
            gpu.compute::<[f32; 4], 2>((&source, "main"), options, groups, &resource, [normals, planes]);
        let mut twin_normals = vec![DVec4::ZERO; FACES];
        let mut twin_planes = vec![DVec4::ZERO; 2 * FACES];
        let (vertices, indices) = (b.mesh.vertices, b.mesh.indices);
        face_geometry::main(form, b.scene, vertices, indices, &mut twin_normals, &mut twin_planes);
        // The last faces have no area; the literal form divides by it.
        let whole = FACES - 3;
        let counted = if form == Form::Literal { whole } else { FACES };
        // Random triangles of unit size have areas of 0.01 and more: the cross product loses a factor of 100.
        let error = worst(&found_normals[..counted], &twin_normals[..counted]);
        assert!(error < 1e-5, "normals, {form:?}: {error}");
        let scale = twin_planes[..2 * whole].iter().map(|plane| plane.abs().max_element()).fold(0.0, f64::max);
        let error = worst(&found_planes[..2 * whole], &twin_planes[..2 * whole]) / scale;
        assert!(error < 1e-5, "planes, {form:?}: {error} of the greatest");

        let source = compose(Pass::FaceFrames);
        let [found] = gpu.compute::<[f32; 4], 1>((&source, "main"), options, groups, &resource, [frames]);
        let mut twin_frames = vec![FaceFrame::default(); FACES];
        face_frames::main(form, b.scene, vertices, indices, &twin_normals, &mut twin_frames);
        for (face, twin) in twin_frames[..whole].iter().enumerate() {
            let [tangent, bitangent] = [found[2 * face], found[2 * face + 1]].map(|half| half.map(f64::from));
            let shares = tam_shaders::cpu::lib::face_frame::unpack_shares(found[2 * face + 1][2].to_bits());
            let expected = tam_shaders::cpu::lib::face_frame::unpack_shares(twin.shares);
            // One step of ten bits; and as said at the normals, the light is projected on them.
            assert!((shares - expected).abs().max_element() < 1.5 / 1023.0, "{face}: {shares} for {expected}");
            // Where the fixed frame has all, nothing else is seen.
            if expected.z < 0.999 {
                let t = glam::DVec3::new(tangent[0], tangent[1], tangent[2]);
                let b = glam::DVec3::new(tangent[3], bitangent[0], bitangent[1]);
                let error = (t - twin.tangent).length().max((b - twin.bitangent).length());
                assert!(error < 1e-3, "frame of face {face}, {form:?}: {error}");
            }
        }
    }
}

/// More edges than one lane of the sum has blocks for, and a block that is not full.
const MANY_EDGES: usize = 2 * line_edges::SUMMING_LANES * line_edges::BLOCK_EDGES + 777;

#[test]
fn edges_that_are_lines_are_listed_as_their_twins_list_them() {
    let gpu = Gpu::new();
    let source = compose(Pass::LineEdges);
    let mut listed_somewhere = false;
    for setting in Setting::all() {
        let options = Options::default();
        let b = setting.bindings(options);
        let uploaded = Uploaded::new(&gpu, &setting, &[]);
        // Neither a period of the blocks nor of the lanes.
        let edges: Vec<_> = (0..MANY_EDGES).map(|i| setting.edges[i * i % 1009 % FACES]).collect();
        let blocks = MANY_EDGES.div_ceil(line_edges::BLOCK_EDGES);
        let buffer = |words: usize| gpu.storage(&vec![u32::MAX; words]);
        let own = [
            ("edges", gpu.storage(bytemuck::cast_slice(&edges))),
            ("listed", buffer(MANY_EDGES)),
            ("marks", buffer(blocks)),
            ("before", buffer(blocks)),
            ("arguments", buffer(4)),
        ];
        let [_, listed, marks, before, arguments] = own.each_ref().map(|(_, buffer)| buffer);
        let resource = |name: &str| {
            let own = own.iter().find(|(of, _)| *of == name).map(|(_, buffer)| buffer.as_entire_binding());
            own.or_else(|| uploaded.resource(name))
        };
        let groups = blocks.div_ceil(line_edges::BLOCK_LANES) as u32;
        let run = |entry, groups| {
            gpu.compute::<u32, 4>((&source, entry), options, groups, &resource, [listed, marks, before, arguments])
        };
        run("mark", groups);
        run("sum", 1);
        let [listed, marks, before, arguments] = run("list", groups);

        let twin = line_edges::mark(b.scene, &b.mesh, &setting.twin.style, &edges);
        assert_eq!(marks, twin);
        let sums = line_edges::sum(&twin);
        assert_eq!((&before, &arguments), (&sums.0, &vec![4, sums.1, 0, 0]));
        assert_eq!(listed[..sums.1 as usize], line_edges::list(&twin, &sums));
        assert!(listed[sums.1 as usize..].iter().all(|entry| *entry == u32::MAX), "more was listed");
        listed_somewhere |= (1..MANY_EDGES as u32).contains(&sums.1);
    }
    assert!(listed_somewhere, "no setting has some edges that are lines and some that are none");
}

/// Only so that the harness cannot pass by comparing nothing.
#[test]
fn rows_compare_thousands_of_cases() {
    assert!(gpu::CASES * Setting::all().len() >= 10_000);
    assert!(tables::all().iter().all(|row: &Row| !row.options.is_empty()));
}
