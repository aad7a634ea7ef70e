//! Every measure beside a control that must score badly.
#![allow(clippy::unwrap_used)]

use super::*;
use crate::checks::synthetic::{Synthetic, draw};
use crate::preset::ToneMeasure;
use crate::stroke::{Axis, Stroke};

const SIZE: u32 = 128;

/// A stroke through the whole tile in any direction.
fn line(across_uv: f32, slope: f32, axis: Axis, width_px: f32) -> Stroke {
    Stroke { family: 0, axis, start_uv: 0.0, along_uv: 1.0, across_uv: [across_uv, slope, 0.0, 0.0], width_px }
}

fn image_of(strokes: &[Stroke], size: u32) -> Vec<u8> {
    let mut ink = vec![0; (size * size) as usize];
    strokes.iter().for_each(|stroke| draw(&mut ink, size, stroke, 1.0));
    ink
}

/// Numbers without pattern, by integer hashing.
fn noise(i: u32) -> u32 {
    let i = (i ^ 61 ^ (i >> 16)).wrapping_mul(9);
    let i = (i ^ (i >> 4)).wrapping_mul(0x27d4_eb2d);
    i ^ (i >> 15)
}

fn grating(count: u16) -> Vec<u8> {
    let strokes: Vec<Stroke> =
        (0..count).map(|i| line((f32::from(i) + 0.3) / f32::from(count), 0.0, Axis::X, 1.6)).collect();
    image_of(&strokes, SIZE)
}

fn random_lines(count: u32) -> Vec<u8> {
    let strokes: Vec<Stroke> = (0..count).map(|i| line((noise(i) % 1024) as f32 / 1024.0, 0.0, Axis::X, 1.6)).collect();
    image_of(&strokes, SIZE)
}

#[test]
fn tone_errors_see_one_darker_cell() {
    let (mut grid, ..) = Synthetic::default().make();
    let measure = ToneMeasure::default();
    let sound = tone_errors(&grid, &measure);
    assert!(sound.max < 1e-4 && sound.rms <= sound.max && sound.spread < 2e-4, "{sound:?}");
    grid.levels[1].cells[0].iter_mut().for_each(|ink| *ink = ink.saturating_add(26));
    let broken = tone_errors(&grid, &measure);
    assert!(broken.max > 0.05 && broken.spread > 0.05 && broken.rms < broken.max, "{broken:?}");
}

#[test]
fn tone_nesting_counts_texels_that_grow_lighter() {
    let nesting = tone_nesting(&[0, 100, 255, 30], &[0, 99, 200, 40]);
    assert_eq!((nesting.any, nesting.visible, nesting.worst), (0.5, 0.25, 55));
    assert_eq!(lighter_than_before(&[0, 100, 255, 30], &[0, 99, 200, 40]), [false, true, true, false]);
    assert_eq!(tone_nesting(&[1, 2], &[1, 3]), ToneNesting::default());
}

#[test]
fn level_nesting_tells_nested_images_from_unrelated_ones() {
    let (grid, ..) = Synthetic::default().make();
    let (fine, coarse) = (&grid.levels[0], &grid.levels[1]);
    let nested = level_nesting(&coarse.cells[0], coarse.size, &fine.cells[0], 128, 2);
    assert!(nested.control() > 0.2 && nested.share() < 0.01, "{nested:?}");
    let mut rolled = fine.cells[0].clone();
    rolled.rotate_left((fine.size * (fine.size / 2 + 7) + 11) as usize);
    let unrelated = level_nesting(&coarse.cells[0], coarse.size, &rolled, 128, 2);
    assert!(unrelated.share() > 0.5 * unrelated.control(), "{unrelated:?}");
    let marked = lost_texels(&coarse.cells[0], coarse.size, &rolled, 128, 2);
    assert_eq!(marked.iter().filter(|lost| **lost).count(), unrelated.lost);
}

#[test]
fn seams_of_a_tile_are_like_its_inside_and_those_of_a_ramp_are_not() {
    let tile = image_of(&[line(0.3, 0.0, Axis::X, 3.0), line(0.8, 0.0, Axis::Y, 2.0)], SIZE);
    let ramp: Vec<u8> = (0..SIZE * SIZE).map(|i| (i % SIZE) as u8).collect();
    for axis in [Axis::X, Axis::Y] {
        let sound = seam(&[&tile], SIZE, axis);
        assert!((sound.low..=sound.high.max(1.25)).contains(&sound.ratio), "{sound:?}");
    }
    let broken = seam(&[&ramp], SIZE, Axis::X);
    assert!(broken.ratio > 20.0 && broken.high < 1.25, "{broken:?}");
    assert_eq!(seam(&[&ramp], SIZE, Axis::Y).ratio, 1.0);
}

#[test]
fn dashes_of_random_phase_show_a_seam_unless_their_period_divides_the_tile() {
    let dashes = |period: u32| -> Vec<u8> {
        (0..SIZE * SIZE).map(|i| if (i % SIZE + noise(i / SIZE)) % period < 20 { 255 } else { 0 }).collect()
    };
    let (cut, whole) = (dashes(37), dashes(32));
    let broken = seam(&[&cut], SIZE, Axis::X);
    assert!(broken.ratio > broken.high.max(1.25), "{broken:?}");
    let sound = seam(&[&whole], SIZE, Axis::X);
    assert!((sound.low..=sound.high).contains(&sound.ratio), "{sound:?}");
}

#[test]
fn stroke_width_is_that_of_lines_of_known_width_at_any_angle() {
    for width_px in [0.8_f32, 1.0, 1.3, 1.6, 2.0, 3.0, 4.5, 6.0] {
        for slope in [0.0_f32, 0.1, 0.35, 0.7, 1.0] {
            for axis in [Axis::X, Axis::Y] {
                let ink = image_of(&[line(0.37, slope, axis, width_px), line(0.87, slope, axis, width_px)], SIZE);
                let found = stroke_width(&ink, SIZE, full_ink(&ink), |_, _| true);
                // Strokes of less than a texel and a half never or seldom cover one; see the function's own accuracy.
                let tolerance = if width_px < 1.5 { 0.45 } else { 0.15 };
                let error = found.width_px - f64::from(width_px);
                assert!(error.abs() < tolerance, "width {width_px}, slope {slope}, {axis:?}: {found:?}");
            }
        }
    }
}

#[test]
fn stroke_width_grows_with_the_strokes() {
    let median = |width_px| {
        let ink = image_of(&[line(0.2, 0.2, Axis::X, width_px), line(0.7, 0.2, Axis::X, width_px)], SIZE);
        stroke_width(&ink, SIZE, full_ink(&ink), |_, _| true).width_px
    };
    for width_px in [1.6, 2.0, 3.0] {
        assert!(median(1.25 * width_px) > 1.12 * median(width_px), "{width_px}");
    }
}

#[test]
fn uniformity_ranks_a_grating_before_random_lines() {
    let (even, random) = (grating(16), random_lines(16));
    for window in [SIZE / 4, SIZE / 8, SIZE / 16] {
        assert!(box_cv(&even, SIZE, window) < 0.5 * box_cv(&random, SIZE, window), "{window}");
    }
    assert!(gap_cv(&even, SIZE, Axis::X, 128) < 0.1);
    assert!(gap_cv(&random, SIZE, Axis::X, 128) > 0.5);
    assert!(low_frequency_share(&even, SIZE, Axis::X, 128) < 0.01);
    assert!(low_frequency_share(&random, SIZE, Axis::X, 128) > 0.05);
}

#[test]
fn uniformity_reads_across_the_family_it_is_told() {
    let lines = random_lines(16);
    let size = SIZE as usize;
    let turned: Vec<u8> = (0..size * size).map(|i| lines[i % size * size + i / size]).collect();
    assert_eq!(gap_cv(&lines, SIZE, Axis::X, 128), gap_cv(&turned, SIZE, Axis::Y, 128));
    let (a, b) = (low_frequency_share(&lines, SIZE, Axis::X, 128), low_frequency_share(&turned, SIZE, Axis::Y, 128));
    assert!((a - b).abs() < 1e-12);
}

#[test]
fn length_bias_sees_a_search_that_favours_short_strokes() {
    let (.., mut strokes) = Synthetic::default().make();
    let sound = length_bias(&strokes).unwrap().ratio();
    assert!((0.95..=1.05).contains(&sound), "{sound}");
    strokes.strokes.retain(|stroke| stroke.along_uv < 0.6);
    assert!(length_bias(&strokes).unwrap().ratio() < 0.8);
}

#[test]
fn centre_lines_find_a_stroke_that_a_finer_level_lost() {
    let (mut grid, _, strokes) = Synthetic::default().make();
    assert_eq!(centre_lines(&grid, &strokes, 0).missing, 0);
    assert!(centre_lines(&grid, &strokes, 0).samples > 1000);
    grid.levels[0].cells[3].rotate_right(SIZE as usize * 3);
    let found = centre_lines(&grid, &strokes, 0);
    assert!(found.missing > 100 && found.missing_of_column[..3] == [0, 0, 0], "{found:?}");
    let marked = missing_centre_lines(&grid, &strokes, 0, 3);
    assert!(marked.iter().any(|missing| *missing));
}

#[test]
fn a_stroke_map_matches_its_own_column_and_not_another_map() {
    let (grid, map, _) = Synthetic::default().make();
    let found = pattern_match(&map.levels[0].threshold, &grid.levels[0].cells[1], SIZE, 128);
    assert!(found.differing < 0.2 * found.differing_by_chance, "{found:?}");
    assert!((threshold_share(&map.levels[0].threshold, 0.3) - 0.3).abs() < 0.01);
    let mut rolled = map.levels[0].threshold.clone();
    rolled.rotate_left(SIZE as usize * 20 + 9);
    let unlike = pattern_match(&rolled, &grid.levels[0].cells[1], SIZE, 128);
    assert!(unlike.differing > 0.5 * unlike.differing_by_chance, "{unlike:?}");
    let inverted: Vec<u8> = map.levels[0].threshold.iter().map(|at| (255 - at) / 2).collect();
    assert!((threshold_share(&inverted, 0.3) - 0.3).abs() > 0.1);
}

#[test]
fn full_ink_is_that_of_a_covered_texel() {
    assert_eq!(full_ink(&[0; 16]), 0);
    assert_eq!(full_ink(&[0, 0, 255, 255, 120]), 255);
    assert_eq!(full_ink(&[0, 102, 102, 40, 102]), 102);
    assert_eq!(share_at_least(&[0, 128, 200, 127], 128), 0.5);
}
