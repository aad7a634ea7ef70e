//! `tam-gen chart`: every file is there and says what was measured, and nothing is written where that fails.

use std::fs;

use tam_tests::charts::{check_page, check_png, columns};
use tam_tests::command::{listing, tam_gen};
use tempfile::tempdir;

#[test]
fn a_quick_chart_has_all_files_and_all_figures() {
    let folder = tempdir().expect("a folder");
    let run =
        tam_gen(folder.path(), &["chart", "engraving", "pencil", "--quick", "--size", "128", "-o", "out", "--json"]);
    assert_eq!(run.status, 0, "{run:?}");
    let (heading, rows) = columns(&folder.path().join("out/points.csv"));
    assert_eq!(rows.len(), 14, "{rows:?}");
    let number = |row: &Vec<String>, name: &str| {
        let column = heading.iter().position(|column| column == name);
        let cell = &row[column.unwrap_or_else(|| panic!("{name} is not in {heading:?}"))];
        cell.parse::<f64>().unwrap_or_else(|_| panic!("{name} of {row:?} is no number"))
    };
    for row in &rows {
        for name in ["cpu_ms", "raster_ms", "cost_ratio", "box_cv_1", "gap_cv_1", "low_frequency_1", "box_cv_3"] {
            assert!(number(row, name) > 0.0, "{name} of {row:?}");
        }
        assert!((0.0..0.1).contains(&number(row, "tone_max")), "{row:?}");
    }
    let of = |way: &str| rows.iter().rfind(|row| row[0] == way && row[1] == "pencil").expect("it was measured");
    let (ours, search, chance) = (of("progressive, effort 8"), of("praun, 30 candidates"), of("random"));
    assert!(number(ours, "cost_ratio") < number(search, "cost_ratio"), "{ours:?}, {search:?}");
    assert!(number(ours, "box_cv_1") < number(chance, "box_cv_1"), "{ours:?}, {chance:?}");

    let files = listing(&folder.path().join("out"));
    for name in ["pencil-tone", "engraving-box-cv-1", "pencil-gap-cv-3", "engraving-low-frequency-1"] {
        assert!(files.contains(&format!("{name}.svg")), "{name} is not in {files:?}");
        check_png(&folder.path().join("out").join(format!("{name}.png")));
    }
    let charts = files.iter().filter(|name| name.ends_with(".svg")).count();
    let page = fs::read_to_string(folder.path().join("out/index.html")).expect("a page");
    check_page(&page, charts);
    for text in ["tam-gen chart engraving pencil --size 128 --quick", "tam-gen 0.", "praun, 10 candidates"] {
        assert!(page.contains(text), "{text} is not on the page");
    }
}

#[test]
fn what_cannot_be_charted_is_told_and_nothing_is_written() {
    let folder = tempdir().expect("a folder");
    fs::write(folder.path().join("taken"), "mine").expect("a file");
    fs::create_dir(folder.path().join("full")).expect("a folder");
    fs::write(folder.path().join("full/index.html"), "mine").expect("a file");
    let before = listing(folder.path());
    for (more, expected) in [
        (&["-o", "taken"][..], &["taken is a file", "-o takes the folder"][..]),
        (&["-o", "full"], &["index.html is already there", "--force"]),
        (&["-o", "taken/below"], &["taken/below", "choose another place"]),
        (&["pencl"], &["no preset is called `pencl`", "did you mean `pencil`"]),
        (&["--size", "100", "-o", "odd"], &["map.size", "power of two"]),
    ] {
        let run = tam_gen(folder.path(), &[&["chart", "--quick"][..], more].concat());
        assert_eq!(run.status, 2, "{more:?}: {run:?}");
        for part in expected {
            assert!(run.stderr.contains(part), "{more:?}: {part:?} is missing in\n{}", run.stderr);
        }
        assert_eq!(listing(folder.path()), before, "{more:?} wrote something");
    }
}
