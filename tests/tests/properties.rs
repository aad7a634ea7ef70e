//! What holds for every preset and seed: exact tones, nesting, and the same bytes on any number of threads.

use proptest::prelude::*;
use proptest::test_runner::RngSeed;
use tam_gen::checks::{Constraint, Verdict, check_map};
use tam_gen::preset::{FamilyOptions, PlacementMethod, StrokeOptions, TipOptions, Tones};
use tam_gen::{DeficitCause, Generator, Job, Map, Preset, generate};

/// Constraints that hold by construction, whatever the preset.
const BY_CONSTRUCTION: [Constraint; 4] = [
    Constraint::ToneAverage,
    Constraint::ToneNesting,
    Constraint::LevelNestingList,
    Constraint::LevelNestingCentreLines,
];

fn strokes() -> impl Strategy<Value = StrokeOptions> {
    let lengths = (0.05..=1.0, 0.05..=1.0);
    let shape = (0.5..6.0, 0.0..0.5, 0.0..15.0, 0.0..0.08, 0.0..0.05);
    let ink = (0.0..0.5, 0.0..0.5, 0.0..=1.0, 0.4..=1.0, 0.0..0.5);
    let tip = prop_oneof![8 => Just(None), 1 => Just(Some("M0 0H3V1H0Z")), 1 => Just(Some("M0 0L2 1L0 2Z"))];
    (lengths, shape, ink, tip).prop_map(|((a, b), (width_px, width_jitter, angle, bow, s_curve), ink, tip)| {
        let (taper_in, taper_out, taper_fade, opacity, grain) = ink;
        StrokeOptions {
            length_min: f64::min(a, b),
            length_max: f64::max(a, b),
            width_px,
            width_jitter,
            angle_jitter_deg: angle,
            bow,
            s_curve,
            taper_in,
            taper_out,
            taper_fade,
            opacity,
            grain,
            tip: tip.map(|path| TipOptions { path: Some(path.into()), ..TipOptions::default() }),
        }
    })
}

fn presets() -> impl Strategy<Value = Preset> {
    let size =
        prop_oneof![Just((64, 8)), Just((64, 16)), Just((64, 32)), Just((128, 8)), Just((128, 32)), Just((256, 64))];
    let schedule = proptest::sample::select(vec![
        vec!["a"],
        vec!["a", "a", "b"],
        vec!["a", "a", "a", "b", "b", "a b"],
        vec!["a b c"],
        vec!["dots"],
        vec!["a", "b dots", "c"],
    ]);
    let tones = prop_oneof![(1..12_u32).prop_map(Tones::Count), Just(Tones::List(vec![0.05, 0.5, 0.55, 0.9]))];
    let angles = (-180.0..180.0, -180.0..180.0, -180.0..180.0);
    (any::<u32>(), size, schedule, tones, strokes(), angles, 1..8_u32).prop_map(
        |(seed, (size, coarsest), schedule, tones, stroke, (a, b, c), effort)| {
            let family = |angle_deg| FamilyOptions { angle_deg, ..FamilyOptions::default() };
            let dots = FamilyOptions { length_min: Some(0.0), length_max: Some(0.0), ..FamilyOptions::default() };
            let mut preset = Preset { seed: u64::from(seed), stroke, ..Preset::default() };
            preset.schedule = schedule.into_iter().map(String::from).collect();
            preset.families = [("a", family(a)), ("b", family(b)), ("c", family(c)), ("dots", dots)]
                .map(|(n, f)| (n.into(), f))
                .into();
            (preset.map.size, preset.map.coarsest, preset.map.tones) = (size, coarsest, tones);
            preset.placement.effort = effort;
            preset
        },
    )
}

/// Every constraint of `BY_CONSTRUCTION` holds, apart from cells whose deficit the map itself reports.
fn holds_by_construction(map: &Map) -> Result<(), TestCaseError> {
    let report = check_map(map);
    for constraint in BY_CONSTRUCTION {
        let finding = report.get(constraint).expect("own maps are checked for everything");
        for cell in finding.cells.iter().filter(|cell| matches!(cell.verdict, Verdict::Fail)) {
            let reported = map.deficits.iter().any(|d| (d.level, d.column) == (cell.level, cell.column));
            prop_assert!(
                constraint == Constraint::ToneAverage && reported,
                "{}: {}\n{}",
                constraint.name(),
                finding.detail,
                map.preset.to_toml()
            );
        }
        prop_assert!(
            finding.cells.iter().any(|c| matches!(c.verdict, Verdict::Fail))
                || !matches!(finding.verdict, Verdict::Fail)
        );
    }
    Ok(())
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 96, failure_persistence: None, rng_seed: RngSeed::Fixed(2001), ..ProptestConfig::default() })]

    #[test]
    fn any_preset_and_seed_makes_a_nested_map_of_exact_tones(preset in presets()) {
        prop_assume!(preset.validate().is_empty());
        let map = generate(&preset, &Job::default()).expect("a valid preset");
        holds_by_construction(&map)?;
    }

    #[test]
    fn random_placement_nests_and_hits_its_tones_too(mut preset in presets()) {
        prop_assume!(preset.validate().is_empty());
        preset.placement.method = PlacementMethod::Random;
        holds_by_construction(&generate(&preset, &Job::default()).expect("a valid preset"))?;
    }
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 12, failure_persistence: None, rng_seed: RngSeed::Fixed(2001), ..ProptestConfig::default() })]

    #[test]
    fn prauns_placement_nests_and_overshoots_by_less_than_a_stroke(mut preset in presets()) {
        prop_assume!(preset.validate().is_empty());
        preset.placement.method = PlacementMethod::Praun;
        (preset.placement.candidates_first, preset.placement.candidates_last) = (20, 5);
        (preset.map.size, preset.map.coarsest) = (64, 16);
        let map = generate(&preset, &Job::default()).expect("a valid preset");
        let report = check_map(&map);
        for constraint in [Constraint::ToneNesting, Constraint::LevelNestingList, Constraint::LevelNestingCentreLines] {
            let finding = report.get(constraint).expect("own maps are checked for everything");
            prop_assert!(!matches!(finding.verdict, Verdict::Fail), "{}: {}", constraint.name(), finding.detail);
        }
        for deficit in map.deficits.iter().filter(|deficit| deficit.cause == DeficitCause::WholeStrokes) {
            prop_assert!(deficit.reached > deficit.wanted, "his rule stops above the tone: {deficit:?}");
        }
    }
}

#[test]
fn the_shipped_presets_hold_every_constraint_at_several_seeds_and_sizes() {
    for (name, _) in Preset::embedded() {
        for (seed, size, coarsest) in [(1, 256, 32), (2, 128, 32), (3, 512, 32), (4, 256, 32)] {
            let mut preset = Preset::named(name).expect("it is in the list").expect("a valid preset");
            preset.seed = seed;
            (preset.map.size, preset.map.coarsest) = (size, coarsest);
            let map = generate(&preset, &Job::default()).expect("a valid preset");
            let report = check_map(&map);
            assert!(map.deficits.is_empty(), "{name}, seed {seed}: {:?}", map.deficits);
            assert!(report.holds(), "{name}, seed {seed}, {size} px\n{}", report.table());
        }
    }
}

#[test]
fn twelve_tones_down_to_eight_texels_are_exact() {
    let mut preset = Preset::default();
    preset.map.tones = Tones::Count(12);
    preset.map.coarsest = 8;
    let map = generate(&preset, &Job::default()).expect("a valid preset");
    assert_eq!(map.deficits, []);
}

#[test]
fn sixty_four_tones_come_from_the_same_sequences() {
    let mut preset = Preset::default();
    preset.map.tones = Tones::Count(64);
    let fine = generate(&preset, &Job::default()).expect("a valid preset");
    assert_eq!(fine.deficits, []);
    assert!(holds_by_construction(&fine).is_ok());
    preset.map.tones = Tones::Count(6);
    let coarse = generate(&preset, &Job::default()).expect("a valid preset");
    let common = coarse.strokes.strokes.iter().take_while(|stroke| stroke.family == 0).count();
    let fine_h: Vec<_> = fine.strokes.strokes.iter().filter(|stroke| stroke.family == 0).collect();
    let same = coarse.strokes.strokes[..common].iter().zip(fine_h).all(|(a, b)| a == b);
    assert!(same, "a sequence does not depend on how many columns draw from it");
}

#[test]
fn one_two_and_eight_threads_make_the_same_bytes() {
    for method in PlacementMethod::ALL {
        let mut preset = Preset::named("pencil").expect("it ships").expect("a valid preset");
        preset.placement.method = method;
        (preset.placement.candidates_first, preset.placement.candidates_last) = (60, 20);
        let make = |threads| {
            let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("a thread pool");
            pool.install(|| generate(&preset, &Job::default()).expect("a valid preset"))
        };
        let one = make(1);
        for threads in [2, 8] {
            assert!(make(threads) == one, "{} on {threads} threads", method.name());
        }
    }
}

#[test]
fn a_generator_reused_over_different_presets_remembers_nothing() {
    let (mut generator, mut map) = (Generator::new(), Map::default());
    for name in ["stipple", "woodcut", "pencil"] {
        let mut preset = Preset::named(name).expect("it ships").expect("a valid preset");
        preset.map.tones = Tones::Count(if name == "woodcut" { 9 } else { 4 });
        preset.map.size = if name == "stipple" { 128 } else { 256 };
        preset.map.tail = name == "woodcut";
        generator.generate_into(&preset, &Job::default(), &mut map).expect("a valid preset");
        assert!(map == generate(&preset, &Job::default()).expect("a valid preset"), "{name}");
    }
}

#[test]
fn a_preset_built_in_code_is_checked_like_a_file() {
    let spoil: [fn(&mut Preset); 8] = [
        |preset| preset.map.size = 100,
        |preset| preset.map.size = 0,
        |preset| preset.map.coarsest = 1024,
        |preset| preset.map.tones = Tones::List(vec![0.5, f64::NAN]),
        |preset| preset.map.tones = Tones::List(vec![]),
        |preset| preset.stroke.width_px = f64::INFINITY,
        |preset| preset.schedule = vec!["nobody".into()],
        |preset| preset.families.clear(),
    ];
    for (i, spoil) in spoil.iter().enumerate() {
        let mut preset = Preset::default();
        spoil(&mut preset);
        let result = generate(&preset, &Job::default());
        assert!(matches!(result, Err(tam_gen::GenerateError::Preset { .. })), "case {i}");
    }
}

#[test]
fn cancelling_stops_every_placement() {
    use std::sync::atomic::AtomicBool;
    let cancel = AtomicBool::new(true);
    let job = Job { cancel: Some(&cancel), ..Job::default() };
    for method in PlacementMethod::ALL {
        let mut preset = Preset::default();
        preset.map.size = 1024;
        preset.placement.method = method;
        assert_eq!(generate(&preset, &job), Err(tam_gen::GenerateError::Cancelled), "{}", method.name());
    }
}

#[test]
fn the_bytes_of_a_preset_are_the_same_on_every_machine() {
    // A change here is a change of every user's maps and belongs into the changelog; UPDATE_GOLDEN=1 blesses it.
    let map = generate(&Preset::default(), &Job::default()).expect("a valid preset");
    let ink = map.grid.levels.iter().flat_map(|level| level.cells.iter().flatten());
    let hash = ink.fold(0xcbf2_9ce4_8422_2325_u64, |h, ink| (h ^ u64::from(*ink)).wrapping_mul(0x0000_0100_0000_01b3));
    let golden = concat!(env!("CARGO_MANIFEST_DIR"), "/tests/golden/default_map.fnv");
    if std::env::var_os("UPDATE_GOLDEN").is_some() {
        std::fs::write(golden, format!("{hash:016x}\n")).expect("a writable checkout");
    }
    let blessed = std::fs::read_to_string(golden).expect("the golden file");
    assert_eq!(format!("{hash:016x}"), blessed.trim());
}
