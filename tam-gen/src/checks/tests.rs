//! A sound map holds every constraint; a map broken in one way fails that one.
#![allow(clippy::unwrap_used)]

use super::synthetic::{Synthetic, draw};
use super::*;
use Constraint::*;

fn sound() -> (Grid, StrokeMap, StrokeList) {
    Synthetic::default().make()
}

fn own() -> CheckOptions {
    CheckOptions { own: true, ..CheckOptions::default() }
}

fn failing(map: &(Grid, StrokeMap, StrokeList)) -> Vec<Constraint> {
    let report = check_grid(&map.0, Some(&map.1), Some(&map.2), &own());
    report.failing()
}

fn rolled(ink: &[u8], size: u32, down: u32, right: u32) -> Vec<u8> {
    let from = |i: u32| (i / size + size - down) % size * size + (i % size + size - right) % size;
    (0..size * size).map(|i| ink[from(i) as usize]).collect()
}

#[test]
fn a_sound_map_holds_every_constraint() {
    let map = sound();
    let report = check_grid(&map.0, Some(&map.1), Some(&map.2), &own());
    assert!(report.holds(), "{report}");
    assert!(report.findings.iter().all(|finding| finding.verdict == Verdict::Pass), "{report}");
}

#[test]
fn sound_maps_of_other_strokes_hold_every_constraint() {
    for (width_px, slope, opacity) in
        [(0.8, 0.0, 1.0), (1.0, 0.9, 1.0), (2.5, 0.3, 1.0), (1.6, 0.06, 0.4), (1.3, 0.2, 0.8)]
    {
        let tones = if opacity < 0.5 { vec![0.1, 0.2, 0.3] } else { vec![0.15, 0.3, 0.5] };
        let map = Synthetic { width_px, slope, opacity, tones, ..Synthetic::default() }.make();
        let report = check_grid(&map.0, Some(&map.1), Some(&map.2), &own());
        let expected: &[Constraint] = &[];
        // The synthetic stroke map ranks texels of solid ink; soft ink has other tones.
        let unlike: &[Constraint] = if opacity < 1.0 { &[StrokeMapPattern] } else { expected };
        let failing: Vec<_> = report.failing().into_iter().filter(|constraint| !unlike.contains(constraint)).collect();
        assert_eq!(failing, expected, "width {width_px}, slope {slope}, opacity {opacity}\n{report}");
    }
}

#[test]
fn a_darker_cell_fails_the_tones_alone() {
    let mut map = sound();
    // Paper far from any stroke's middle, in the darkest column, so that no darker column can lack it.
    let cell = &mut map.0.levels[0].cells[3];
    cell.iter_mut().filter(|ink| **ink < 60).take(400).for_each(|ink| *ink += 60);
    assert_eq!(failing(&map), [ToneAverage, ToneSpread]);
}

#[test]
fn ink_that_a_darker_column_lacks_fails_tone_nesting() {
    let mut map = sound();
    // Moved, not removed: the tone stays. Off the middle of strokes, so that centre lines stay inked.
    let cells = &mut map.0.levels[1].cells;
    let lighter = cells[1].clone();
    let from = (0..lighter.len()).find(|&i| lighter[i] > 10 && lighter[i] < 60 && cells[2][i] == lighter[i]).unwrap();
    let to = (0..lighter.len()).find(|&i| cells[2][i] < 100 && cells[3][i] > cells[2][i].saturating_add(10)).unwrap();
    cells[2][from] -= 5;
    cells[2][to] += 5;
    assert_eq!(failing(&map), [ToneNesting]);
}

#[test]
fn a_shifted_level_fails_level_nesting() {
    let mut map = sound();
    let level = &mut map.0.levels[1];
    for ink in &mut level.cells {
        *ink = rolled(ink, level.size, level.size / 2 + 3, 5);
    }
    // The stroke map's level is left where it was: an unavoidable companion.
    assert_eq!(failing(&map), [LevelNestingCentreLines, LevelNestingPixels, StrokeMapPattern]);
    let report = check_grid(&map.0, None, None, &own());
    assert_eq!(report.failing(), [LevelNestingPixels], "{report}");
}

#[test]
fn a_cropped_map_fails_seams() {
    let (mut grid, ..) = sound();
    for level in &mut grid.levels {
        let size = level.size as usize;
        for ink in &mut level.cells {
            let whole = ink.clone();
            for (i, texel) in ink.iter_mut().enumerate() {
                *texel = whole[i / size * size + (i % size) * 4 / 5];
            }
        }
    }
    let options = CheckOptions { tone_spread_only: true, ..CheckOptions::default() };
    let failing = check_grid(&grid, None, None, &options).failing();
    // Cropping changes the tone of every level a little differently.
    assert!(failing == [ToneSpread, Seams] || failing == [Seams], "{failing:?}");
}

#[test]
fn thicker_strokes_at_the_coarsest_level_fail_stroke_width() {
    let thin = Synthetic::default();
    let thick = Synthetic { width_px: 2.2, ..thin.clone() };
    let mut map = thin.make();
    let (grid, ..) = thick.make();
    map.0.levels[2] = grid.levels[2].clone();
    let report = check_grid(&map.0, None, None, &own());
    assert_eq!(report.failing(), [StrokeWidth], "{report}");
}

#[test]
fn a_scrambled_stroke_map_fails_its_pattern_and_keeps_its_tone() {
    let mut map = sound();
    let thresholds = &mut map.1.levels[0].threshold;
    let count = thresholds.len();
    let before = thresholds.clone();
    thresholds.iter_mut().enumerate().for_each(|(i, threshold)| *threshold = before[i * 4099 % count]);
    assert_eq!(failing(&map), [StrokeMapPattern]);
}

#[test]
fn a_stroke_map_averaged_from_the_finer_level_fails_its_tone() {
    let mut map = sound();
    let fine = map.1.levels[0].threshold.clone();
    let coarse = &mut map.1.levels[1];
    let size = coarse.size as usize;
    for (i, threshold) in coarse.threshold.iter_mut().enumerate() {
        let (x, y) = (i % size * 2, i / size * 2);
        let sum: u32 =
            [(0, 0), (1, 0), (0, 1), (1, 1)].map(|(dx, dy)| u32::from(fine[(y + dy) * 2 * size + x + dx])).iter().sum();
        *threshold = (sum / 4) as u8;
    }
    assert!(failing(&map).contains(&StrokeMapTone), "{:?}", failing(&map));
}

#[test]
fn a_stroke_missing_from_a_finer_list_fails_the_list_alone() {
    let mut map = sound();
    map.2.first_column[0][2] = StrokeList::NEVER;
    assert_eq!(failing(&map), [LevelNestingList]);
}

#[test]
fn a_stroke_that_is_listed_and_not_drawn_fails_centre_lines() {
    let mut map = sound();
    let next = map.2.first_column[2].iter().position(|&first| first == StrokeList::NEVER).unwrap() + 3;
    for first in &mut map.2.first_column {
        first[next] = 0;
    }
    assert_eq!(failing(&map), [LevelNestingCentreLines]);
}

#[test]
fn faint_strokes_fail_centre_lines() {
    let mut map = sound();
    let (size, stroke) = (map.0.levels[0].size, map.2.strokes[0]);
    let mut erased = vec![0; (size * size) as usize];
    draw(&mut erased, size, &stroke, 1.0);
    for ink in &mut map.0.levels[0].cells {
        ink.iter_mut().zip(&erased).for_each(|(ink, erased)| *ink -= (*ink).min(erased / 2));
    }
    assert!(failing(&map).contains(&LevelNestingCentreLines));
}

#[test]
fn a_list_or_a_stroke_map_of_another_map_is_not_judged() {
    let map = sound();
    let other = Synthetic { sizes: vec![64, 32], ..Synthetic::default() }.make();
    let report = check_grid(&map.0, Some(&other.1), Some(&other.2), &own());
    assert!(report.holds());
    for constraint in [LevelNestingList, LevelNestingCentreLines, StrokeMapTone, StrokeMapPattern] {
        assert_eq!(report.get(constraint).unwrap().verdict.word(), "not judged");
    }
}

#[test]
fn images_that_form_no_grid_are_not_judged() {
    let (mut grid, ..) = sound();
    grid.levels[1].cells.pop();
    let report = check_grid(&grid, None, None, &own());
    assert!(report.findings.iter().all(|finding| finding.verdict.word() == "not judged"), "{report}");
    let report = check_grid(&Grid::default(), None, None, &own());
    assert!(report.findings.iter().all(|finding| finding.verdict.word() == "not judged"), "{report}");
}

#[test]
fn unknown_tones_leave_the_spread_to_judge() {
    let (mut grid, ..) = sound();
    grid.tones = vec![0.0; 4];
    let options = CheckOptions { tone_spread_only: true, ..CheckOptions::default() };
    let report = check_grid(&grid, None, None, &options);
    assert!(report.holds(), "{report}");
    assert_eq!(report.get(ToneSpread).unwrap().verdict, Verdict::Pass);
}

#[test]
fn json_and_page_hold_every_constraint() {
    let mut map = sound();
    map.0.levels[0].cells[3][9] = 0;
    map.0.levels[0].cells[2][9] = 255;
    let report = check_grid(&map.0, Some(&map.1), Some(&map.2), &own());
    let json = serde_json::to_value(&report).unwrap();
    assert_eq!(json["holds"], false);
    assert_eq!(json["findings"].as_array().unwrap().len(), Constraint::ALL.len());
    let page = html(&report, &map.0, Some(&map.1), "<b>hand & pen</b>");
    assert!(page.contains("&lt;b&gt;hand &amp; pen"));
    for constraint in Constraint::ALL {
        assert!(page.contains(constraint.title()));
    }
    assert!(!page.contains("http"), "the page must need nothing else");
}
