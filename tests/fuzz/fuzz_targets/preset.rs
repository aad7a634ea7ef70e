#![no_main]

libfuzzer_sys::fuzz_target!(|source: &str| {
    if let Ok(preset) = tam_gen::Preset::from_toml(source, "fuzz.toml") {
        let again = tam_gen::Preset::from_toml(&preset.to_toml(), "again.toml");
        assert_eq!(again.as_ref().ok(), Some(&preset));
    }
});
