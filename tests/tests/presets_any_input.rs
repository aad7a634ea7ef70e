//! No text whatever makes the reading of presets panic, and what it takes is valid.

use proptest::prelude::*;
use tam_gen::Preset;

fn read(source: &str) {
    match Preset::from_toml(source, "any.toml") {
        Ok(preset) => {
            assert!(preset.validate().is_empty());
            assert_eq!(Preset::from_toml(&preset.to_toml(), "again").as_ref(), Ok(&preset));
        }
        Err(error) => {
            assert!(!error.problems.is_empty());
            assert!(!error.report(true).is_empty() && !error.report(false).is_empty());
        }
    }
}

const SPLINTERS: &[&str] = &[
    "nan",
    "-inf",
    "0",
    "-1",
    "1e309",
    "9223372036854775808",
    "[",
    "]",
    "{",
    "}",
    "\"",
    "'''",
    "\u{feff}",
    "ä",
    "\u{202e}",
    "\t",
    "\r",
    "\n",
    "=",
    "#",
    ".",
    ",",
    "[map]",
    "[families.x]",
    "tip = { path = \"M0 0\" }",
    "[[stroke]]",
    "tones = [0.5, 0.4]",
    "size = 8",
    "true",
    "1979-05-27",
    "\u{0}",
    "schedule = []",
    "\\u0000",
    "angle_deg = 720",
];

proptest! {
    #![proptest_config(ProptestConfig::with_cases(256))]

    #[test]
    fn random_text_is_read_or_refused(source in "\\PC{0,80}") {
        read(&source);
    }

    #[test]
    fn altered_presets_are_read_or_refused(
        preset in 0_usize..9,
        cuts in prop::collection::vec((any::<prop::sample::Index>(), 0_usize..12, prop::sample::select(SPLINTERS)), 1..4),
    ) {
        let mut source = Preset::embedded()[preset].1.to_owned();
        for (place, length, splinter) in cuts {
            let start = source.floor_char_boundary(place.index(source.len() + 1));
            let end = source.ceil_char_boundary((start + length).min(source.len()));
            source.replace_range(start..end, splinter);
        }
        read(&source);
    }

    #[test]
    fn a_truncated_preset_is_read_or_refused(preset in 0_usize..9, end in any::<prop::sample::Index>()) {
        let source = Preset::embedded()[preset].1;
        read(&source[..source.floor_char_boundary(end.index(source.len()))]);
    }
}

#[test]
fn deep_nesting_and_long_lines_are_refused() {
    read(&format!("seed = {}", "[".repeat(100_000)));
    read(&format!("a = {}1{}", "{ a = ".repeat(5_000), " }".repeat(5_000)));
    read(&format!("[{}]", "a.".repeat(50_000) + "a"));
    read(&"x".repeat(1 << 20));
    read(&format!("{} = 1", "x".repeat(1 << 20)));
    read(&"k = 1\n".repeat(100_000));
    read(&(0..80_000).map(|index| format!("k{index} = 1\n")).collect::<String>());
    read(&(0..40_000).map(|index| format!("[families.k{index}]\n")).collect::<String>());
    read(&format!("schedule = [{}]", "\"x\", ".repeat(100_000)));
}
