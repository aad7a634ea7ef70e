//! Where methods fail: the literal form shows each failure, and the hardened one has none but those that are known.

use std::collections::BTreeSet;

use tam_gen::preset::Tones;
use tam_gen::{Job, Preset, generate};
use tam_tests::gpu::renderer;
use tam_viewer::stability::{CAUSES, Hardened, Literal, Outcome, Stand, Verdict, cases};

/// Runs the cases of a cause, and asserts that each is as it says.
fn check(name: &str) {
    let cause = CAUSES.iter().find(|cause| cause.name == name).expect("a cause of this name");
    let mut stand = Stand::new(renderer());
    let run = |case: &'static tam_viewer::stability::Case| -> Outcome {
        case.outcome(&mut stand).unwrap_or_else(|error| panic!("{}: {error}", case.name))
    };
    let outcomes: Vec<Outcome> = cause.cases.iter().map(run).collect();
    for outcome in &outcomes {
        let case = outcome.case;
        let figures = format!("literal {}, hardened {}", outcome.literal.figure, outcome.hardened.figure);
        assert_eq!(outcome.literal_fails(), matches!(case.literal, Literal::Fails(_)), "{}: {figures}", case.name);
        assert_eq!(outcome.hardened_holds(), case.hardened == Hardened::Holds, "{}: {figures}", case.name);
        assert_ne!(outcome.verdict(), Verdict::Unexpected, "{}: {figures}", case.name);
        assert_eq!(outcome.literal.picture.dimensions(), outcome.hardened.picture.dimensions(), "{}", case.name);
    }
}

#[test]
fn lights_that_leave_no_direction() {
    check("lights");
}

#[test]
fn meshes_that_are_not_closed_smooth_and_centred() {
    check("meshes");
}

#[test]
fn tones_between_columns_and_at_both_ends() {
    check("tones");
}

#[test]
fn levels_of_slanted_surfaces_and_zooms() {
    check("levels");
}

#[test]
fn motion_of_light_and_camera_does_not_pop() {
    check("motion");
}

#[test]
fn frames_anchored_in_one_place_fail_still() {
    check("surfaces");
}

#[test]
fn maps_of_coarse_levels_dense_tones_and_wide_strokes() {
    check("maps");
}

#[test]
fn every_case_is_told_once_and_in_full() {
    let names: BTreeSet<&str> = cases().map(|case| case.name).collect();
    assert_eq!(names.len(), cases().count(), "{names:?}");
    for case in cases() {
        for text in [case.method, case.failure, case.figure, case.reason] {
            assert!(!text.is_empty(), "{}", case.name);
        }
        // Figures between the limits would be neither failed nor held.
        if let Literal::Fails(fails) = case.literal {
            assert_ne!(fails, case.holds, "{}", case.name);
        }
    }
}

#[test]
fn tones_that_the_coarsest_level_misses_are_reported() {
    let mut preset = Preset::named("fine-pen").expect("an embedded preset").expect("a valid preset");
    preset.map.size = 64;
    preset.map.coarsest = 8;
    preset.map.tones = Tones::Count(64);
    let map = generate(&preset, &Job::default()).expect("it generates");
    let level = map.grid.drawn().len() - 1;
    let mut missed = 0;
    for (column, (cell, tone)) in map.grid.levels[level].cells.iter().zip(&map.grid.tones).enumerate() {
        let ink = cell.iter().map(|texel| f64::from(*texel)).sum::<f64>() / (255.0 * cell.len() as f64);
        // The generator promises 5e-4 at 8 px.
        if (ink - tone).abs() > 5e-4 {
            missed += 1;
            let reported = map.deficits.iter().any(|deficit| deficit.level == level && deficit.column == column);
            assert!(reported, "column {column} has {ink:.4} for {tone:.4}, and nothing is said");
        }
    }
    assert!(missed > 0, "some column misses its tone, else nothing is tested");
}
