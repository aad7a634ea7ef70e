//! What every report with charts must be.

use std::collections::BTreeMap;
use std::path::Path;

/// Heading and rows of a table; every row has as many cells as the heading.
///
/// # Panics
/// If it is no such table.
pub fn columns(path: &Path) -> (Vec<String>, Vec<Vec<String>>) {
    let mut reader = csv::Reader::from_path(path).expect("a table");
    let cells = |record: &csv::StringRecord| record.iter().map(str::to_owned).collect::<Vec<_>>();
    let heading = cells(reader.headers().expect("a heading"));
    let rows = reader.records().map(|record| cells(&record.expect("as many cells as columns"))).collect();
    (heading, rows)
}

/// Checks that a picture is no empty one: paper, text, and dots in colour.
///
/// # Panics
/// If it is.
pub fn check_png(path: &Path) {
    let picture = image::open(path).expect("a picture").into_rgb8();
    assert!(picture.width() >= 960 && picture.height() >= 480, "{:?}", picture.dimensions());
    let mut colours: BTreeMap<[u8; 3], usize> = BTreeMap::new();
    // Left of the legend, which shows the colours too.
    let shown = picture.enumerate_pixels().filter(|(x, _, _)| 5 * x < 4 * picture.width());
    shown.for_each(|(_, _, pixel)| *colours.entry(pixel.0).or_default() += 1);
    let of = |wanted: fn(&[u8; 3]) -> bool| -> usize {
        colours.iter().filter(|(colour, _)| wanted(colour)).map(|(_, count)| count).sum()
    };
    assert!(of(|colour| *colour == [255; 3]) > 100_000, "no paper in {}", path.display());
    assert!(of(|colour| *colour == [0; 3]) > 300, "no text in {}", path.display());
    let vivid = |colour: &[u8; 3]| colour.iter().max().zip(colour.iter().min()).is_some_and(|(a, b)| a - b > 60);
    assert!(of(vivid) > 60, "no dots in {}", path.display());
}

/// Checks that a page holds so many charts, and refers to nothing outside itself.
///
/// # Panics
/// If it does not.
pub fn check_page(page: &str, charts: usize) {
    assert!(page.starts_with("<!DOCTYPE html>") && page.ends_with("</html>"), "no whole page");
    assert_eq!(page.matches("<svg").count(), charts, "charts on the page");
    assert!(page.contains("<table"), "no table");
    for reference in ["href=", "src=", "url("] {
        for (at, _) in page.match_indices(reference) {
            let target = page[at + reference.len()..].trim_start_matches('"');
            let own = target.starts_with('#') || target.starts_with("data:");
            assert!(own, "refers to {:?}", target.chars().take(60).collect::<String>());
        }
    }
    for outside in ["@import", "<script", "<link", "<iframe"] {
        assert!(!page.contains(outside), "{outside} on the page");
    }
    // What a part of one chart refers to is in that chart.
    let mut ids: Vec<&str> = page.split(" id=\"").skip(1).filter_map(|rest| rest.split('"').next()).collect();
    let count = ids.len();
    ids.sort_unstable();
    ids.dedup();
    assert_eq!(ids.len(), count, "an id is there twice");
}
