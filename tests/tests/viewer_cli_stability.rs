//! `tam-viewer stability`: the page holds every case with both pictures, and refers to nothing outside itself.

use std::fs;

use tam_tests::charts::check_page;
use tam_tests::command::{listing, tam_viewer};
use tam_viewer::stability::cases;
use tempfile::tempdir;

#[test]
fn the_report_has_every_case_with_both_pictures() {
    let folder = tempdir().expect("a folder");
    let run = tam_viewer(folder.path(), &["stability", "--report", "out.html", "--json"]);
    assert_eq!(run.status, 0, "{run:?}");
    let json = run.json();
    let told = json["cases"].as_array().expect("cases");
    assert_eq!(told.len(), cases().count());
    let page = fs::read_to_string(folder.path().join("out.html")).expect("a page");
    check_page(&page, 0);
    for (case, told) in cases().zip(told) {
        assert_eq!(told["name"], case.name);
        assert!(told["literal"].is_number() && told["hardened"].is_number(), "{told}");
        assert_ne!(told["verdict"], "unexpected", "{told}");
        let escaped = case.name.replace('&', "&amp;");
        assert!(page.contains(&format!("<b>{escaped}</b>")), "{} is not on the page", case.name);
    }
    let still = told.iter().filter(|case| case["verdict"] == "still-failing").count();
    assert_eq!(page.matches("class=\"badge still\"").count(), still);
    assert_eq!(page.matches("data:image/png;base64,").count(), 2 * cases().count());
    assert!(page.contains("llvmpipe"), "the adapter is not on the page");
    assert_eq!(listing(folder.path()), ["out.html"]);
}

#[test]
fn a_place_that_takes_no_report_is_told_before_anything_is_drawn() {
    let folder = tempdir().expect("a folder");
    fs::write(folder.path().join("taken.html"), "mine").expect("a file");
    fs::create_dir(folder.path().join("folder")).expect("a folder");
    let before = listing(folder.path());
    for (place, expected) in [
        ("taken.html", ["taken.html is already there", "--force"]),
        ("folder", ["folder is a folder", "the file to write"]),
    ] {
        let run = tam_viewer(folder.path(), &["stability", "--report", place]);
        assert_eq!(run.status, 1, "{run:?}");
        for part in expected {
            assert!(run.stderr.contains(part), "{place}: {part:?} is missing in\n{}", run.stderr);
        }
        assert_eq!(listing(folder.path()), before, "{place}: something was written");
    }
    assert_eq!(fs::read_to_string(folder.path().join("taken.html")).expect("a file"), "mine");
}
