//! What placing strokes costs. CPU time is that of the whole process, so this test has a process of its own: beside others
//! it measured them as well.

use tam_gen::chart::placement::{PlacementFigures, Way, measure_placement};
use tam_gen::{Job, Preset};

fn figures(way: Way) -> PlacementFigures {
    let mut preset = Preset::default();
    preset.map.size = 128;
    measure_placement(&preset, way, 3, &Job::default()).expect("the default preset")
}

#[test]
fn ours_costs_less_than_the_search_and_lies_more_evenly_than_chance() {
    let [ours, search, chance] = [Way::Progressive(4), Way::Praun(100), Way::Random].map(figures);
    assert!(ours.cpu_ms * 4.0 < search.cpu_ms, "{ours:?}, {search:?}");
    assert!(ours.ratio() > 1.0 && ours.tone_max < 1e-3, "{ours:?}");
    for (ours, chance) in ours.evenness.iter().zip(&chance.evenness) {
        let (ours, chance) = (ours.expect("one family"), chance.expect("one family"));
        assert!(ours.box_cv < 0.8 * chance.box_cv && ours.gap_cv < 0.9 * chance.gap_cv, "{ours:?}, {chance:?}");
    }
}
