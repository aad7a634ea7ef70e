//! What is wrong with a preset is said with its place, its cause and the way out.

use tam_gen::Preset;
use tam_gen::problems::{FileError, Problem};

fn refused(source: &str) -> FileError {
    match Preset::from_toml(source, "my.toml") {
        Ok(preset) => panic!("taken:\n{source}\nas {preset:?}"),
        Err(error) => error,
    }
}

/// The only problem of a source.
fn problem(source: &str) -> Problem {
    let error = refused(source);
    assert_eq!(error.problems.len(), 1, "{error}");
    error.problems[0].clone()
}

#[test]
fn an_unknown_key_is_placed_and_the_nearest_known_one_named() {
    let error = refused("seed = 1\n\n[map]\nsise = 256\n");
    let text = error.to_string();
    assert_eq!((error.problems[0].line, error.problems[0].column), (Some(4), Some(1)));
    for part in ["my.toml:4:1", "^^^^", "sise = 256", "did you mean `size`?", "[map] has no key \"sise\"", "coarsest"] {
        assert!(text.contains(part), "{part:?} is missing in:\n{text}");
    }
}

#[test]
fn a_key_in_the_wrong_table_is_sent_to_its_own() {
    assert!(problem("width_px = 2.0").expected.contains("belongs in [stroke]"));
    assert!(problem("[map]\nschedule = [\"h\"]").expected.contains("belongs at the top"));
}

#[test]
fn an_unknown_key_of_a_family_is_placed() {
    let problem = problem("[families]\nh = { angle_deg = 3 }\nv = { angel_deg = 90 }\n");
    assert_eq!((problem.line, problem.column), (Some(3), Some(7)));
    assert!(problem.expected.contains("`angle_deg`"), "{problem:?}");
}

#[test]
fn a_wrong_type_is_placed_and_the_right_one_named() {
    let cases = [
        ("[map]\nsize = \"big\"", 2, 8, "a whole number, 64 to 4096 px"),
        ("[map]\nsize = 256.5", 2, 8, "a whole number, 64 to 4096 px"),
        ("[map]\ntail = 1", 2, 8, "true or false"),
        ("[map]\ntones = \"many\"", 2, 9, "a whole number or a list"),
        ("[stroke]\nwidth_px = []", 2, 12, "a number, 0.3 to 128 px"),
        ("schedule = \"h\"", 1, 12, "a list"),
        ("schedule = [1]", 1, 13, "text in quotes"),
        ("families = 3", 1, 12, "a table"),
        ("[placement]\nmethod = 5", 2, 10, "one of \"progressive\""),
        ("seed = 1979-05-27", 1, 8, "a whole number"),
    ];
    for (source, line, column, expected) in cases {
        let problem = problem(source);
        assert_eq!((problem.line, problem.column), (Some(line), Some(column)), "{source}: {problem:?}");
        assert!(problem.expected.contains(expected), "{source}: {problem:?}");
    }
}

#[test]
fn an_unknown_choice_names_the_nearest() {
    let problem = problem("[placement]\nmethod = \"progresive\"");
    assert_eq!(problem.help.as_deref(), Some("did you mean \"progressive\"?"));
}

#[test]
fn a_number_out_of_range_says_the_range_with_its_unit() {
    let cases = [
        ("[map]\nsize = 300", "a power of two from 64 to 4096 px"),
        ("[map]\nsize = -1", "64 to 4096 px"),
        ("[map]\nsize = 99999999999", "64 to 4096 px"),
        ("[map]\ncoarsest = 4", "a power of two from 8 to 4096 px"),
        ("[map]\nsize = 64\ncoarsest = 128", "a power of two from 8 to 64 px"),
        ("[stroke]\nwidth_px = nan", "0.3 to 128 px"),
        ("[stroke]\nwidth_px = -inf", "0.3 to 128 px"),
        ("[stroke]\nopacity = 2", "0.05 to 1"),
        ("[placement]\neffort = 0", "1 to 256 candidates"),
        ("[families.h]\nangle_deg = 270\n[families.v]", "-180 to 180 degrees"),
        ("[families.h]\nwidth_px = 0.0\n[families.v]", "0.3 to 128 px"),
        ("seed = -5", "0 to 9223372036854775807"),
        ("seed = 99999999999999999999", "0 to 9223372036854775807"),
        ("[map]\ntones = 65", "1 to 64 tones"),
        ("[map]\ntones = 0", "1 to 64"),
    ];
    for (source, expected) in cases {
        let problem = problem(source);
        assert!(problem.expected.contains(expected), "{source}: {problem:?}");
        assert!(problem.line.is_some(), "{source}: {problem:?}");
    }
}

#[test]
fn tones_must_rise_and_leave_room_at_the_coarsest_level() {
    let unsorted = problem("[map]\ntones = [0.1, 0.5, 0.3]");
    assert_eq!((unsorted.line, unsorted.column), (Some(2), Some(20)));
    assert!(unsorted.expected.contains("above 0.5"), "{unsorted:?}");
    let dense = problem("[map]\nsize = 64\ncoarsest = 8\ntones = [0.1, 0.102]");
    assert!(dense.message.contains("too near"), "{dense:?}");
    assert!(dense.help.is_some_and(|help| help.contains("raise map.coarsest")));
    assert!(problem("[map]\ntones = [0.5, nan]").message.contains("no darkness"));
    assert!(problem("[map]\ntones = [1.5]").expected.contains("solid ink"));
    assert!(problem("[map]\ntones = []").expected.contains("1 to 64"));
}

#[test]
fn a_schedule_names_families_that_exist() {
    let problem = problem("schedule = [\"h\", \"hh v\"]");
    assert_eq!((problem.line, problem.column), (Some(1), Some(18)));
    assert!(problem.message.contains("\"hh\"") && problem.expected.contains("\"h\""), "{problem:?}");
    assert!(refused("schedule = []").to_string().contains("1 to 64 entries"));
    assert!(refused("schedule = [\" \"]").to_string().contains("names no family"));
    assert!(refused("[families]").to_string().contains("1 to 64 families"));
    assert!(refused("schedule = [\"a b\"]\n[families.\"a b\"]").to_string().contains("no name for a family"));
}

#[test]
fn parts_of_a_stroke_fit_together() {
    let lengths = refused("[stroke]\nlength_min = 0.8\nlength_max = 0.2");
    assert!(lengths.to_string().contains("length_min must not be above length_max"), "{lengths}");
    let tapers = problem("[stroke]\ntaper_in = 0.3\n[families.h]\ntaper_out = 0.8\n[families.v]");
    assert_eq!((tapers.at.as_str(), tapers.line), ("families.h.taper_out", Some(4)));
    let wide = problem("[map]\ncoarsest = 16\n[stroke]\nwidth_px = 15\nwidth_jitter = 0.2");
    assert!(wide.help.is_some_and(|help| help.contains("raise map.coarsest")));
    assert!(wide.expected.contains("13.3 px"), "{}", wide.expected);
}

#[test]
fn a_tip_has_one_shape_that_parses() {
    assert!(problem("[stroke.tip]\nspacing = 1").message.contains("no shape"));
    let both = refused("[stroke.tip]\npath = \"M0 0 L1 0 L1 1\"\nimage = \"data:image/png;base64,\"");
    assert!(both.to_string().contains("not both"));
    assert!(problem("[stroke.tip]\npath = \"M0 0 L1 oops\"").message.contains("does not parse"));
    assert!(problem("[stroke.tip]\nimage = \"tip.png\"").help.is_some_and(|help| help.contains("load")));
    assert!(Preset::from_toml("[stroke.tip]\npath = \"M0 0 L1 0 L1 1 Z\"", "my.toml").is_ok());
}

#[test]
fn colours_are_css() {
    assert!(problem("[colours]\nink = \"blackish\"").expected.contains("CSS colour"));
    assert!(Preset::from_toml("[colours]\nink = \"rebeccapurple\"", "my.toml").is_ok());
}

#[test]
fn syntax_errors_are_placed_and_an_empty_preset_is_one() {
    let broken = refused("[map]\nsize = \n");
    assert_eq!(broken.problems[0].line, Some(2), "{broken}");
    assert!(refused("[map\n").to_string().contains("my.toml:1"));
    assert!(refused("a = 1\na = 2\n").to_string().contains("my.toml:2"));
    for empty in ["", " \n\n", "# only a remark\n"] {
        assert!(refused(empty).to_string().contains("the preset is empty"));
    }
}

#[test]
fn all_errors_are_reported_at_once_in_the_order_of_the_file() {
    let error = refused(
        "sede = 1\nschedule = [\"x\"]\n[map]\nsize = 300\ntail = \"no\"\n[stroke]\nwidth_px = 900\nlengthmin = 0.1\n",
    );
    let places: Vec<&str> = error.problems.iter().map(|problem| problem.at.as_str()).collect();
    assert_eq!(places, ["sede", "schedule[0]", "map.size", "map.tail", "stroke.width_px", "stroke.lengthmin"]);
}

#[test]
fn a_coloured_report_says_what_the_plain_one_says() {
    let error = refused("[map]\nsise = 256\n");
    assert!(error.report(true).contains("\u{1b}["));
    assert!(!error.report(false).contains('\u{1b}'));
}
