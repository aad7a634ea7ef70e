//! Maps made here hold every constraint; broken in one way, they fail that one.
#![allow(clippy::unwrap_used)]

use Constraint::*;
use tam_gen::checks::{CheckOptions, Constraint, Report, Verdict, check_grid, check_map};
use tam_gen::preset::{PlacementMethod, StrokeOptions};
use tam_gen::{Job, Map, Preset, StrokeList, generate};

fn make(preset: &Preset) -> Map {
    generate(preset, &Job::default()).unwrap()
}

fn default_at(size: u32, seed: u64) -> Preset {
    let mut preset = Preset { seed, ..Preset::default() };
    preset.map.size = size;
    preset
}

fn sound() -> Map {
    make(&default_at(128, 3))
}

fn failing(map: &Map) -> Vec<Constraint> {
    check_map(map).failing()
}

/// The report on pixels alone, as for images of unknown origin.
fn foreign(map: &Map) -> Report {
    check_grid(&map.grid, None, None, &CheckOptions::default())
}

fn rolled(ink: &[u8], size: u32, by: u32) -> Vec<u8> {
    let from = |i: u32| (i / size + size - by) % size * size + (i % size + size - by) % size;
    (0..size * size).map(|i| ink[from(i) as usize]).collect()
}

#[test]
fn default_maps_of_any_seed_and_size_hold_every_constraint() {
    for size in [64, 128, 256, 512] {
        for seed in 0..20 {
            let map = make(&default_at(size, seed));
            let report = check_map(&map);
            assert!(report.holds(), "{size} px, seed {seed}\n{report}");
            let report = foreign(&map);
            assert!(report.holds(), "pixels alone, {size} px, seed {seed}\n{report}");
        }
    }
}

#[test]
fn every_constraint_is_judged_on_the_default_map() {
    let report = check_map(&make(&Preset::default()));
    assert!(report.findings.iter().all(|finding| finding.verdict == Verdict::Pass), "{report}");
}

#[test]
fn soft_grainy_curved_wide_and_thin_strokes_hold_every_constraint() {
    let strokes = [
        StrokeOptions {
            opacity: 0.6,
            grain: 0.5,
            taper_out: 0.2,
            taper_fade: 1.0,
            width_px: 2.2,
            ..Default::default()
        },
        StrokeOptions { bow: 0.1, s_curve: 0.05, angle_jitter_deg: 8.0, taper_in: 0.2, ..Default::default() },
        StrokeOptions { width_px: 6.0, width_jitter: 0.2, taper_in: 0.4, taper_out: 0.6, ..Default::default() },
        StrokeOptions { width_px: 0.6, angle_jitter_deg: 4.0, ..Default::default() },
        StrokeOptions { width_px: 2.4, length_min: 0.0, length_max: 0.0, ..Default::default() },
    ];
    for stroke in strokes {
        for seed in 0..4 {
            let mut preset = Preset { stroke: stroke.clone(), ..default_at(256, seed) };
            preset.families.get_mut("h").unwrap().angle_deg = 25.0;
            let report = check_map(&make(&preset));
            assert!(report.holds(), "seed {seed}, {stroke:?}\n{report}");
        }
    }
}

#[test]
fn shipped_presets_hold_every_constraint_at_any_seed_and_size() {
    let presets = concat!(env!("CARGO_MANIFEST_DIR"), "/../presets");
    let mut broken = String::new();
    for entry in std::fs::read_dir(presets).unwrap() {
        let path = entry.unwrap().path();
        if path.extension().is_none_or(|extension| extension != "toml") {
            continue;
        }
        let shipped = Preset::load(&path).unwrap();
        let sizes = [128, 256, 512].map(|size| size.max(shipped.map.coarsest));
        for (size, seed) in sizes.into_iter().flat_map(|size| [1, 2, 3].map(|seed| (size, seed))) {
            let mut preset = Preset { seed, ..shipped.clone() };
            preset.map.size = size;
            let report = check_map(&make(&preset));
            if !report.holds() {
                broken += &format!("{}, {size} px, seed {seed}\n{report}\n", path.display());
            }
        }
    }
    assert!(broken.is_empty(), "{broken}");
}

#[test]
fn a_darker_cell_fails_the_tones() {
    let mut map = sound();
    map.grid.levels[0].cells[5].iter_mut().for_each(|ink| *ink = ink.saturating_add(20));
    assert_eq!(failing(&map), [ToneAverage, ToneSpread]);
}

#[test]
fn a_darker_column_that_lost_ink_fails_tone_nesting() {
    let mut map = sound();
    let cells = &mut map.grid.levels[0].cells;
    let lost = (0..cells[1].len()).find(|&i| (10..60).contains(&cells[1][i]) && cells[2][i] == cells[1][i]).unwrap();
    let gained = (0..cells[2].len()).find(|&i| cells[2][i] < 100 && cells[3][i] > cells[2][i] + 20).unwrap();
    cells[2][lost] -= 6;
    cells[2][gained] += 6;
    assert_eq!(failing(&map), [ToneNesting]);
}

#[test]
fn a_level_that_is_shifted_fails_level_nesting() {
    let mut map = sound();
    let level = &mut map.grid.levels[1];
    level.cells.iter_mut().for_each(|ink| *ink = rolled(ink, level.size, level.size / 2 + 3));
    let thresholds = &mut map.stroke_map.levels[1];
    thresholds.threshold = rolled(&thresholds.threshold, thresholds.size, thresholds.size / 2 + 3);
    let failing = failing(&map);
    assert!(failing.starts_with(&[LevelNestingCentreLines, LevelNestingPixels]), "{failing:?}");
    // Widths are read on the centre lines, where strokes no longer are.
    assert!(failing[2..].iter().all(|constraint| *constraint == StrokeWidth), "{failing:?}");
    assert_eq!(foreign(&map).failing(), [LevelNestingPixels]);
}

#[test]
fn a_level_of_another_seed_fails_level_nesting_on_pixels_alone() {
    let (mut map, other) = (sound(), make(&default_at(128, 4)));
    map.grid.levels[2] = other.grid.levels[2].clone();
    assert_eq!(foreign(&map).failing(), [LevelNestingPixels]);
}

#[test]
fn a_map_cut_from_a_larger_picture_fails_seams() {
    let mut map = sound();
    for level in &mut map.grid.levels {
        let size = level.size as usize;
        for ink in &mut level.cells {
            let whole = ink.clone();
            ink.iter_mut().enumerate().for_each(|(i, ink)| *ink = whole[i / size * size + i % size * 4 / 5]);
        }
    }
    let report = foreign(&map);
    assert!(report.failing().contains(&Seams), "{report}");
    assert!(!report.failing().contains(&ToneNesting), "{report}");
}

#[test]
fn thicker_strokes_at_the_coarsest_level_fail_stroke_width() {
    let mut thick = default_at(128, 3);
    thick.stroke.width_px = 2.2;
    let (mut map, thick) = (sound(), make(&thick));
    map.grid.levels[2] = thick.grid.levels[2].clone();
    let report = foreign(&map);
    assert!(report.failing().contains(&StrokeWidth), "{report}");
}

#[test]
fn a_scrambled_stroke_map_fails_its_pattern() {
    let mut map = sound();
    let thresholds = &mut map.stroke_map.levels[0].threshold;
    let (before, count) = (thresholds.clone(), thresholds.len());
    thresholds.iter_mut().enumerate().for_each(|(i, threshold)| *threshold = before[i * 4099 % count]);
    assert_eq!(failing(&map), [StrokeMapPattern]);
}

#[test]
fn a_stroke_map_filtered_from_the_finest_level_fails() {
    let mut map = sound();
    let fine = map.stroke_map.levels[0].threshold.clone();
    let coarse = &mut map.stroke_map.levels[2];
    let (size, step) = (coarse.size as usize, 4);
    for (i, threshold) in coarse.threshold.iter_mut().enumerate() {
        let texel = |j: usize| (i / size * step + j / step) * size * step + i % size * step + j % step;
        *threshold = ((0..step * step).map(|j| u32::from(fine[texel(j)])).sum::<u32>() / 16) as u8;
    }
    assert!(failing(&map).contains(&StrokeMapTone));
}

#[test]
fn a_stroke_missing_from_a_finer_list_fails_the_list_alone() {
    let mut map = sound();
    map.strokes.first_column[0][2] = StrokeList::NEVER;
    assert_eq!(failing(&map), [LevelNestingList]);
}

#[test]
fn a_stroke_that_is_listed_too_early_fails_centre_lines() {
    let mut map = sound();
    let late = map.strokes.first_column[0].iter().position(|&first| first == 4).unwrap();
    map.strokes.first_column[0][late] = 0;
    assert_eq!(failing(&map), [LevelNestingCentreLines]);
}

#[test]
fn prauns_whole_strokes_fail_the_tone_and_say_what_helps() {
    let mut preset = default_at(64, 1);
    preset.placement.method = PlacementMethod::Praun;
    (preset.placement.candidates_first, preset.placement.candidates_last) = (30, 10);
    let report = check_map(&make(&preset));
    assert_eq!(report.failing(), [ToneAverage, ToneSpread], "{report}");
    assert!(report.get(ToneAverage).unwrap().detail.contains("placement.method"), "{report}");
}
