//! `tam-viewer chart`: every file is there and says what was measured, and nothing is written where that fails.

use std::fs;
use std::path::Path;

use tam_tests::charts::{check_page, check_png, columns};
use tam_tests::command::{listing, tam_viewer};
use tempfile::tempdir;

/// The smallest chart with methods of every kind.
const TINY: [&str; 13] = [
    "chart",
    "--mesh",
    "cube",
    "--triangles",
    "12",
    "--mappings",
    "triplanar,frames",
    "--methods",
    "six-way,face-frame,halftone",
    "--size",
    "96x80",
    "--sizes",
    "64",
];

fn tiny(folder: &Path, more: &[&str]) -> tam_tests::command::Run {
    tam_viewer(folder, &[&TINY[..], &["--quick"], more].concat())
}

#[test]
fn a_quick_chart_has_all_files_and_all_figures() {
    let folder = tempdir().expect("a folder");
    let run = tiny(folder.path(), &["-o", "out", "--json"]);
    assert_eq!(run.status, 0, "{run:?}");
    let json = run.json();
    let files = listing(&folder.path().join("out"));
    for name in ["tone", "direction", "edges", "orbit", "zoom", "light", "popping"] {
        assert!(files.contains(&format!("{name}.svg")), "{files:?}");
        check_png(&folder.path().join("out").join(format!("{name}.png")));
        let front = json["fronts"][name].as_array().expect("a front");
        assert!(!front.is_empty(), "{name}: {json}");
        let svg = fs::read_to_string(folder.path().join("out").join(format!("{name}.svg"))).expect("an SVG");
        let first = front[0].as_str().expect("a name");
        assert!(svg.contains(&format!(">{first}</text>")), "{first} is on the front and not in {name}");
    }

    let (heading, rows) = columns(&folder.path().join("out/points.csv"));
    // phong, face-frame, and two methods on two mappings.
    assert_eq!(rows.len(), 6, "{rows:?}");
    let of = |row: &Vec<String>, name: &str| {
        let column = heading.iter().position(|column| column == name);
        row[column.unwrap_or_else(|| panic!("{name} is not in {heading:?}"))].clone()
    };
    let number = |row: &Vec<String>, name: &str| {
        of(row, name).parse::<f64>().unwrap_or_else(|_| panic!("{name} of {row:?} is no number"))
    };
    assert_eq!(of(&rows[0], "method"), "phong");
    // Both of the pair are phong.
    assert!((0.3..3.0).contains(&number(&rows[0], "cost_ratio")), "{:?}", rows[0]);
    for row in &rows[1..] {
        for name in [
            "cost_ratio",
            "frame_ms",
            "phong_ms",
            "bytes",
            "tone_rmse_lightness",
            "direction_error_deg",
            "run_length_px",
            "edge_continuity_ratio",
            "orbit_change",
            "zoom_change",
            "light_popping_rest",
            "zoom_births",
        ] {
            assert!(number(row, name) >= 0.0, "{name} of {row:?}");
        }
        for name in ["zoom_deaths", "zoom_deaths_by_chance"] {
            assert!((0.0..=1.0).contains(&number(row, name)), "{name} of {row:?}");
        }
        assert!(number(row, "direction_error_deg") <= 90.0 && number(row, "light_swimming") < 2.0, "{row:?}");
    }
    let of_method = |method: &str| rows.iter().find(|row| of(row, "method") == method).expect("it was measured");
    // Lines of halftone need no map.
    assert!(number(of_method("six-way"), "bytes") > number(of_method("halftone"), "bytes") + 64.0 * 64.0);

    let page = fs::read_to_string(folder.path().join("out/index.html")).expect("a page");
    check_page(&page, 7);
    for text in ["--mesh cube", "--quick", "tam-viewer 0.", "six-way, triplanar", "llvmpipe"] {
        assert!(page.contains(text), "{text} is not on the page");
    }
}

#[test]
fn what_cannot_be_charted_is_told_and_nothing_is_written() {
    let folder = tempdir().expect("a folder");
    fs::write(folder.path().join("taken"), "mine").expect("a file");
    fs::create_dir(folder.path().join("full")).expect("a folder");
    fs::write(folder.path().join("full/points.csv"), "mine").expect("a file");
    let before = listing(folder.path());
    for (more, status, expected) in [
        (&["-o", "taken"][..], 1, &["taken is a file", "-o takes the folder"][..]),
        (&["-o", "full"], 1, &["points.csv is already there", "--force"]),
        (&["-o", "taken/below"], 1, &["taken/below", "choose another place"]),
        (&["--pairs", "2"], 2, &["--pairs", "5..=1000"]),
    ] {
        let run = tiny(folder.path(), more);
        assert_eq!(run.status, status, "{more:?}: {run:?}");
        for part in expected {
            assert!(run.stderr.contains(part), "{more:?}: {part:?} is missing in\n{}", run.stderr);
        }
        assert_eq!(listing(folder.path()), before, "{more:?} wrote something");
    }
    let run = tam_viewer(folder.path(), &["chart", "--mesh", "head", "--mappings", "uv", "-o", "out"]);
    assert!(run.status == 2 && run.stderr.contains("has no uv"), "{run:?}");
}
