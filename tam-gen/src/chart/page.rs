//! The page that shows charts, figures and pictures, in one file.

use base64::Engine;
use base64::prelude::BASE64_STANDARD;
use maud::{DOCTYPE, Markup, PreEscaped, html as markup};

use super::drawing::{Chart, Drawn};
use super::table::Table;

/// A picture of a way of doing the work.
#[derive(Clone, Debug, PartialEq)]
pub struct Thumbnail {
    /// What it is.
    pub title: String,
    /// Its figures, in a few words.
    pub remark: String,
    /// PNG.
    pub png: Vec<u8>,
}

/// What a page says beside its charts.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Page {
    /// What was measured.
    pub title: String,
    /// How to read it, by paragraphs.
    pub lead: Vec<String>,
    /// With what it was measured: adapter, versions, the command.
    pub facts: Vec<(String, String)>,
    /// A picture of each way.
    pub thumbnails: Vec<Thumbnail>,
}

/// How pages with figures look.
pub const PAGE_CSS: &str = include_str!("page.css");

/// The page, which refers to nothing outside itself.
pub fn html(page: &Page, charts: &[(Chart, Drawn)], table: &Table) -> String {
    let whole = markup! {
        (DOCTYPE)
        html lang="en" {
            head {
                meta charset="utf-8";
                meta name="viewport" content="width=device-width, initial-scale=1";
                title { (page.title) }
                style { (PreEscaped(PAGE_CSS)) }
            }
            body {
                main {
                    h1 { (page.title) }
                    @for paragraph in &page.lead { p { (paragraph) } }
                    dl { @for (what, value) in &page.facts { dt { (what) } dd { (value) } } }
                    @for (number, (chart, drawn)) in charts.iter().enumerate() {
                        section.chart id=(chart.name) { (PreEscaped(inline(&drawn.svg, number))) }
                    }
                    @if !page.thumbnails.is_empty() { (pictures(&page.thumbnails)) }
                    (figures(table))
                }
            }
        }
    };
    whole.into_string()
}

/// An SVG as a part of a page: without the declaration, and with names of its own for what it refers to.
fn inline(svg: &str, number: usize) -> String {
    let start = svg.find("<svg").unwrap_or(0);
    let mut own = svg[start..].to_owned();
    for (mark, end) in [("id=\"", '"'), ("url(#", ')')] {
        let parts: Vec<&str> = own.split(mark).collect();
        let mut named = parts[0].to_owned();
        for part in &parts[1..] {
            debug_assert!(part.contains(end), "every name has an end");
            named += &format!("{mark}chart{number}-{part}");
        }
        own = named;
    }
    own
}

fn pictures(thumbnails: &[Thumbnail]) -> Markup {
    markup! {
        section {
            h2 { "Pictures" }
            div.pictures {
                @for thumbnail in thumbnails {
                    figure {
                        img alt=(thumbnail.title) src=(format!("data:image/png;base64,{}", BASE64_STANDARD.encode(&thumbnail.png)));
                        figcaption { (thumbnail.title) br; span { (thumbnail.remark) } }
                    }
                }
            }
        }
    }
}

fn figures(table: &Table) -> Markup {
    markup! {
        section {
            h2 { "Figures" }
            div.scroll {
                table {
                    thead { tr { @for name in &table.heading { th { (name.replace('_', " ")) } } } }
                    tbody { @for row in &table.rows { tr { @for cell in row { td { (cell) } } } } }
                }
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_inside_a_drawing_become_its_own() {
        let svg = r##"<?xml version="1.0"?><svg><clipPath id="c0"/><g clip-path="url(#c0)"/></svg>"##;
        let own = inline(svg, 3);
        assert_eq!(own, r##"<svg><clipPath id="chart3-c0"/><g clip-path="url(#chart3-c0)"/></svg>"##);
    }

    #[test]
    fn the_page_escapes_what_it_is_told() {
        let page = Page { title: "a <b> & c".into(), ..Page::default() };
        let text = html(&page, &[], &Table::default());
        assert!(text.contains("a &lt;b&gt; &amp; c") && !text.contains("<b>"), "{text}");
    }
}
