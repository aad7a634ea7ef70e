#![no_main]

use tam_viewer::scene_file::SceneFile;

libfuzzer_sys::fuzz_target!(|bytes: &[u8]| {
    let Ok(text) = std::str::from_utf8(bytes) else { return };
    match SceneFile::from_toml(text, "scene.toml") {
        Ok(mut file) => {
            let written = file.to_toml();
            let again = SceneFile::from_toml(&written, "again").expect("what was written is read");
            assert_eq!(again, file, "{written}");
            file.name_objects();
            file.to_options();
        }
        // Every message can be made.
        Err(error) => assert!(!error.report(false).is_empty()),
    }
});
