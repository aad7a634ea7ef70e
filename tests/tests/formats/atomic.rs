//! All files or none, and older ones untouched.

use std::sync::atomic::AtomicBool;

use tam_gen::Job;
use tam_gen::export::{ExportError, ExportOptions, Format, export};

use crate::{contents, sample, write};

fn all() -> ExportOptions {
    ExportOptions { formats: Format::ALL.to_vec(), ..ExportOptions::default() }
}

#[test]
fn existing_files_are_named_and_kept_unless_overwriting() {
    let (map, dir) = (sample::map(2, 64, 32, false), tempfile::tempdir().unwrap());
    std::fs::write(dir.path().join("lines.ktx2"), "older").unwrap();
    let error = export(&map, "lines", dir.path(), &all(), &Job::default()).unwrap_err();
    assert!(matches!(&error, ExportError::Exists(paths) if *paths == [dir.path().join("lines.ktx2")]), "{error}");
    assert!(error.to_string().contains("lines.ktx2 is already there"), "{error}");
    assert_eq!(contents(dir.path()), [("lines.ktx2".into(), b"older".to_vec())]);

    let options = ExportOptions { overwrite: true, ..all() };
    let written = export(&map, "lines", dir.path(), &options, &Job::default()).unwrap();
    assert_ne!(std::fs::read(dir.path().join("lines.ktx2")).unwrap(), b"older");
    assert_eq!(contents(dir.path()).iter().filter(|(_, bytes)| !bytes.is_empty()).count(), written.len());
}

#[test]
fn a_folder_in_the_way_stops_everything() {
    let (map, dir) = (sample::map(2, 64, 32, false), tempfile::tempdir().unwrap());
    write(&map, dir.path(), &[Format::Ktx2]);
    std::fs::create_dir(dir.path().join("lines.dds")).unwrap();
    let before = contents(dir.path());
    let options = ExportOptions { overwrite: true, ..all() };
    let error = export(&map, "lines", dir.path(), &options, &Job::default()).unwrap_err();
    assert!(matches!(error, ExportError::Blocked(_)), "{error}");
    assert!(contents(dir.path()) == before);
}

#[test]
fn a_folder_that_cannot_be_written_leaves_no_trace() {
    let (map, dir) = (sample::map(1, 64, 64, false), tempfile::tempdir().unwrap());
    std::fs::write(dir.path().join("file"), "").unwrap();
    let before = contents(dir.path());
    let error = export(&map, "lines", &dir.path().join("file/below"), &all(), &Job::default()).unwrap_err();
    assert!(matches!(error, ExportError::Folder { .. }), "{error}");
    let error = export(&map, "lines", &dir.path().join("file"), &all(), &Job::default()).unwrap_err();
    assert!(matches!(error, ExportError::Folder { .. }), "{error}");
    // `cells` is a file, so the new folder above it must go again.
    std::fs::write(dir.path().join("cells"), "").unwrap();
    let error = export(&map, "lines", dir.path(), &all(), &Job::default()).unwrap_err();
    assert!(matches!(error, ExportError::Folder { .. }), "{error}");
    std::fs::remove_file(dir.path().join("cells")).unwrap();
    assert!(contents(dir.path()) == before);
    // Permissions do not bind the administrator; the system's own folders do.
    #[cfg(target_os = "linux")]
    for folder in ["/proc", "/proc/tam-gen-export"] {
        let error = export(&map, "lines", folder.as_ref(), &ExportOptions::default(), &Job::default()).unwrap_err();
        assert!(matches!(error, ExportError::Folder { .. } | ExportError::Write { .. }), "{error}");
    }
}

#[test]
fn cancelling_leaves_nothing_not_even_the_folder() {
    let (map, dir) = (sample::map(2, 64, 32, false), tempfile::tempdir().unwrap());
    let cancel = AtomicBool::new(true);
    let job = Job { cancel: Some(&cancel), ..Job::default() };
    let error = export(&map, "lines", &dir.path().join("new/deep"), &all(), &job).unwrap_err();
    assert!(matches!(error, ExportError::Cancelled), "{error}");
    assert!(contents(dir.path()).is_empty());
}

#[test]
fn cancelling_at_any_moment_leaves_all_or_nothing() {
    let map = sample::map(6, 256, 32, true);
    for micros in (0..20_000).step_by(1_000) {
        let dir = tempfile::tempdir().unwrap();
        let cancel = AtomicBool::new(false);
        let result = std::thread::scope(|scope| {
            scope.spawn(|| {
                std::thread::sleep(std::time::Duration::from_micros(micros));
                cancel.store(true, std::sync::atomic::Ordering::Relaxed);
            });
            let job = Job { cancel: Some(&cancel), ..Job::default() };
            export(&map, "lines", &dir.path().join("new"), &all(), &job)
        });
        match result {
            Ok(written) => assert!(written.iter().all(|file| file.path.is_file())),
            Err(error) => {
                assert!(matches!(error, ExportError::Cancelled), "{error}");
                assert!(contents(dir.path()).is_empty(), "after {micros} µs");
            }
        }
    }
}

#[test]
fn names_that_leave_the_folder_are_refused() {
    let (map, dir) = (sample::map(1, 64, 64, false), tempfile::tempdir().unwrap());
    for name in ["", ".", "..", "a/b", "a\\b", ".hidden", "a\0b", "a{tone}", " a"] {
        let error = export(&map, name, dir.path(), &all(), &Job::default()).unwrap_err();
        assert!(matches!(error, ExportError::Name { .. }), "{name:?}: {error}");
    }
    assert!(contents(dir.path()).is_empty());
}

#[test]
fn maps_that_contradict_themselves_are_refused() {
    let dir = tempfile::tempdir().unwrap();
    let sound = sample::map(2, 64, 16, false);
    let broken: [fn(&mut tam_gen::Map); 5] = [
        |map| map.grid.levels[1].size = 64,
        |map| map.grid.levels[1].cells.truncate(1),
        |map| map.grid.levels[0].cells[1].truncate(9),
        |map| map.grid.hand_built = 9,
        |map| map.stroke_map.levels[1].threshold.truncate(9),
    ];
    for break_it in broken {
        let mut map = sound.clone();
        break_it(&mut map);
        let error = export(&map, "lines", dir.path(), &all(), &Job::default()).unwrap_err();
        assert!(matches!(error, ExportError::Map(_)), "{error}");
    }
    assert!(contents(dir.path()).is_empty());
}

#[cfg(unix)]
#[test]
fn files_have_the_permissions_of_any_new_file() {
    use std::os::unix::fs::PermissionsExt;
    let (map, dir) = (sample::map(1, 64, 64, false), tempfile::tempdir().unwrap());
    let written = write(&map, dir.path(), &[Format::Ktx2]);
    std::fs::write(dir.path().join("any"), "").unwrap();
    let mode = |path: &std::path::Path| std::fs::metadata(path).unwrap().permissions().mode();
    assert_eq!(mode(&written[0].path), mode(&dir.path().join("any")));
}
