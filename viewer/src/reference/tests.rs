//! The reference draws the tones that it is asked for.
#![allow(clippy::unwrap_used)]

use glam::{DMat4, DVec2, DVec3, Vec2, Vec3};
use tam_gen::{Job, Map, Preset, generate};
use tam_shaders::cpu::{MapImage, Options};
use tam_shaders::{Feed, Pass, types};

use super::{Draw, How, Reference, ReferenceError, column_pairs, thresholds};
use crate::maps::tone_table;
use crate::mesh::{Mesh, NONE, Part, Placement};
use crate::surface::stripes::StripePhases;
use crate::surface::{Corners, Stripes};

const SIDE: u32 = 128;

/// A square of 2 by 2 units that faces +z, one tile in uv.
fn square() -> Mesh {
    let corners = [(-1.0, -1.0), (1.0, -1.0), (1.0, 1.0), (-1.0, 1.0)];
    Mesh {
        name: "square".into(),
        positions: corners.iter().map(|(x, y)| Vec3::new(*x, *y, 0.0)).collect(),
        normals: vec![Vec3::Z; 4],
        uvs: corners.iter().map(|(x, y)| Vec2::new(0.5 + 0.5 * x, 0.5 - 0.5 * y)).collect(),
        points: vec![0, 1, 2, 3],
        point_count: 4,
        normal_groups: vec![0, 1, 2, 3],
        midpoints: Vec::new(),
        sources: vec![0, 1, 2, 3],
        triangles: vec![[0, 1, 2], [0, 2, 3]],
        neighbours: vec![[NONE, NONE, 1], [0, NONE, NONE]],
        parts: vec![Part { name: String::new(), colour: [1.0; 3], triangles: 0..2 }],
        placement: Placement { centre: DVec3::ZERO, scale: 1.0 },
        animation: None,
    }
}

/// The square fills the picture; all light is ambient, so its darkness is the same everywhere.
fn scene(darkness: f64) -> types::Scene {
    let identity = DMat4::IDENTITY.as_mat4().to_cols_array_2d();
    // Orthographic, near at z = 1, far at z = -1.
    let clip =
        DMat4::from_cols_array(&[1.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, -0.5, 0.0, 0.0, 0.0, 0.5, 1.0]);
    types::Scene {
        clip_from_world: clip.as_mat4().to_cols_array_2d(),
        world_from_mesh: identity,
        mesh_from_world: identity,
        world_from_mesh_normal: identity,
        camera_world: [0.0, 0.0, 4.0],
        pixel_world_at_1: 0.01,
        camera_forward: [0.0, 0.0, -1.0],
        light_count: 0,
        viewport_px: [SIDE as f32; 2],
        ambient: 1.0 - darkness as f32,
        paper: [1.0; 4],
        ink: [0.0, 0.0, 0.0, 1.0],
        ..types::Scene::default()
    }
}

fn material(tones: &[f64], size: u32, levels: usize, distribution_entries: usize) -> types::Material {
    let mut all = [[0.0; 4]; 17];
    for (k, tone) in tones.iter().enumerate() {
        all.as_flattened_mut()[k + 1] = *tone as f32;
    }
    types::Material {
        colour: [1.0; 4],
        ambient: 1.0,
        diffuse: 1.0,
        specular: 0.0,
        shininess: 1.0,
        tile_from_surface: [1.0, 0.0, 0.0, 1.0],
        shift_uv: [0.0; 2],
        tile_scale: 1.0,
        size_px: size as f32,
        level_count: levels as f32,
        level_bias: 0.0,
        column_count: tones.len() as u32,
        first_face: 0,
        slope: 6.0,
        line_period_px: 6.0,
        distribution_entries: distribution_entries as f32,
        cross_from: 1.0,
        variety: 0.0,
        columns_per_tone: 0.0,
        _pad_a: 0.0,
        _pad_b: 0.0,
        tones: all,
    }
}

fn pencil() -> Map {
    let mut preset = Preset::named("pencil").unwrap().unwrap();
    preset.map.size = SIDE;
    generate(&preset, &Job::default()).unwrap()
}

fn mean_ink(pass: Pass, d: f64, material: &types::Material, map: &MapImage, distribution: &[Vec<DVec2>]) -> f64 {
    let reference = Reference::new(&square());
    let draws = [Draw { triangles: 0..2, material, map, distribution, corners: None, turns: &[] }];
    let how = How { pass, feed: Feed::Uvs, options: Options::default(), samples: 8 };
    let picture = reference.render(&scene(d), &draws, &how).unwrap();
    assert!(picture.coverage.iter().all(|share| *share == 1.0), "the square fills the picture");
    picture.colours.iter().map(|colour| 1.0 - colour.x).sum::<f64>() / picture.colours.len() as f64
}

#[test]
fn fine_tone_draws_the_mean_ink_that_is_wanted() {
    let map = pencil();
    let image = column_pairs(&map.grid);
    let material = material(&map.grid.tones, SIDE, map.grid.levels.len(), 0);
    let darkest = map.grid.tones[map.grid.columns() - 1];
    for d in [0.0, 0.04, 0.1, 0.2, 0.33, 0.5, 0.6, 0.75, darkest] {
        let ink = mean_ink(Pass::FineTone, d, &material, &image, &[]);
        // Filtering keeps the mean of a cell, which the map has within 1e-4.
        assert!((ink - d).abs() < 0.002 + 1e-4, "{ink} for {d}");
    }
    let ink = mean_ink(Pass::FineTone, 1.0, &material, &image, &[]);
    assert!((ink - darkest).abs() < 0.002 + 1e-4, "no darker than the darkest column: {ink} for {darkest}");
}

#[test]
fn stroke_map_draws_the_mean_ink_that_is_wanted() {
    let map = pencil();
    let image = thresholds(&map.stroke_map);
    let table = tone_table(&map.stroke_map);
    let table: Vec<Vec<DVec2>> =
        table.iter().map(|row| row.iter().map(|entry| Vec2::from(*entry).as_dvec2()).collect()).collect();
    let material = material(&map.grid.tones, SIDE, map.stroke_map.levels.len(), table[0].len());
    for d in [0.0, 0.05, 0.1, 0.25, 0.4, 0.5, 0.65, 0.8, 0.95, 1.0] {
        let ink = mean_ink(Pass::StrokeMap, d, &material, &image, &table);
        assert!((ink - d).abs() < 0.002, "{ink} for {d}");
    }
}

#[test]
fn phong_draws_the_darkness_itself_and_leaves_the_rest_uncovered() {
    let reference = Reference::new(&square());
    let map = MapImage::default();
    let material = material(&[1.0], 1, 1, 0);
    let draws =
        [Draw { triangles: 0..1, material: &material, map: &map, distribution: &[], corners: None, turns: &[] }];
    let how = How { pass: Pass::Phong, feed: Feed::Vertices, options: Options::default(), samples: 4 };
    let picture = reference.render(&scene(0.3), &draws, &how).unwrap();
    // One triangle of the two; the diagonal belongs to it.
    let covered = picture.coverage.iter().sum::<f64>() / picture.coverage.len() as f64;
    assert!((covered - 0.5).abs() < 0.5 / f64::from(SIDE), "{covered}");
    for (colour, coverage) in picture.colours.iter().zip(&picture.coverage) {
        let expected = if *coverage > 0.0 { 0.7 } else { 0.0 };
        assert!((colour.x - expected).abs() < 1e-7, "{colour} where {coverage} is covered");
    }
}

#[test]
fn a_pass_without_surfaces_missing_triangles_and_no_pixels_are_told() {
    let reference = Reference::new(&square());
    let map = MapImage::default();
    let material = material(&[1.0], 1, 1, 0);
    let draw =
        |triangles| [Draw { triangles, material: &material, map: &map, distribution: &[], corners: None, turns: &[] }];
    let how = How { pass: Pass::Phong, feed: Feed::Vertices, options: Options::default(), samples: 1 };
    let lines = How { pass: Pass::Lines, ..how };
    assert_eq!(reference.render(&scene(0.5), &draw(0..2), &lines), Err(ReferenceError::NoSurface(Pass::Lines)));
    let missing = reference.render(&scene(0.5), &draw(0..3), &how);
    assert_eq!(missing, Err(ReferenceError::NoSuchTriangles { wanted: 0..3, count: 2 }));
    let empty = types::Scene { viewport_px: [0.0, 5.0], ..scene(0.5) };
    let none = reference.render(&empty, &draw(0..2), &how);
    assert_eq!(none, Err(ReferenceError::Size { size: [0.0, 5.0], samples: 1 }));
}

/// A square whose phase grows by `lines` to the right and by a third of it upwards; for the second field, across it.
fn square_of_stripes(lines: f32) -> Stripes {
    let phases = |x: f32, y: f32| {
        let at = |corner: [f32; 2]| x * corner[0] + y * corner[1];
        let corners = [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]].map(at);
        [[0, 1, 2], [0, 2, 3]].map(|triangle| StripePhases::wound(triangle.map(|k: usize| corners[k]), 0)).to_vec()
    };
    Stripes { along: phases(lines, lines / 3.0), across: phases(-lines / 3.0, lines) }
}

#[test]
fn stripes_draw_the_mean_ink_that_is_wanted_at_any_level() {
    let reference = Reference::new(&square());
    let map = MapImage::default();
    let distribution: &[Vec<DVec2>] = &[];
    let mut square_sum = 0.0;
    let mut count = 0.0;
    // Whole lines in both directions, so that the mean is that of a period. Five places between one doubling and the
    // next; lines nearly too dense for pixels, and some that are.
    for (lines, line_period_px) in
        [(3.0, 6.0), (3.0, 7.0), (3.0, 8.2), (3.0, 9.4), (3.0, 10.6), (36.0, 2.0), (90.0, 6.0)]
    {
        let stripes = square_of_stripes(lines);
        let corners = Corners::of_stripes(&square().triangles, &stripes, None);
        for (cross_from, d) in [(1.0, 0.1), (1.0, 0.37), (1.0, 0.5), (1.0, 0.8), (0.4, 0.55), (0.4, 0.9), (0.0, 0.3)] {
            let material = types::Material { cross_from, line_period_px, ..material(&[1.0], 1, 1, 0) };
            let corners = Some(&corners);
            let draws = [Draw { triangles: 0..2, material: &material, map: &map, distribution, corners, turns: &[] }];
            let how = How { pass: Pass::Stripes, feed: Feed::Lines, options: Options::default(), samples: 2 };
            let picture = reference.render(&scene(d), &draws, &how).unwrap();
            let ink = picture.colours.iter().map(|colour| 1.0 - colour.x).sum::<f64>() / picture.colours.len() as f64;
            // Lines that cross are averaged by the pixel before they are multiplied.
            assert!((ink - d).abs() < 0.01, "{ink} for {d} at {lines} lines {line_period_px} px, from {cross_from}");
            square_sum += (ink - d) * (ink - d);
            count += 1.0;
        }
    }
    let rmse = f64::sqrt(square_sum / count);
    assert!(rmse < 0.005, "{rmse}");
}
