//! The table of cases, in one file.

use std::io::Cursor;

use base64::Engine;
use base64::prelude::BASE64_STANDARD;
use image::codecs::png::{CompressionType, FilterType, PngEncoder};
use image::{DynamicImage, RgbImage};
use maud::{DOCTYPE, Markup, PreEscaped, html as markup};
use tam_gen::chart::PAGE_CSS;
use tam_gen::command::Failure;
use tam_viewer::gpu::AdapterSummary;
use tam_viewer::stability::{CAUSES, Hardened, Literal, Outcome, Side, Verdict};

use super::shown;

/// The page, which refers to nothing outside itself.
pub(super) fn html(outcomes: &[Outcome], adapter: &AdapterSummary, summary: &str) -> Result<String, Failure> {
    let mut sections = Vec::new();
    for cause in &CAUSES {
        let own = |outcome: &&Outcome| cause.cases.iter().any(|case| case.name == outcome.case.name);
        let rows = outcomes.iter().filter(own).map(row).collect::<Result<Vec<_>, _>>()?;
        sections.push((cause.name, rows));
    }
    let whole = markup! {
        (DOCTYPE)
        html lang="en" {
            head {
                meta charset="utf-8";
                meta name="viewport" content="width=device-width, initial-scale=1";
                title { "Where methods fail" }
                style { (PreEscaped(PAGE_CSS)) (PreEscaped(include_str!("page.css"))) }
            }
            body {
                main {
                    h1 { "Where methods fail" }
                    p { (summary) "." }
                    p {
                        "Each case is drawn as its source prints the method, and in the hardened form. The literal form \
                         must show the failure, else the case would prove nothing; the hardened one must not."
                    }
                    p {
                        "Colours:" span.key style="background:#d60093" {} "no number,"
                        span.key style="background:#f08200" {} "whiter than paper or blacker than ink. Two frames are \
                         those that are compared, or the ends of a motion; maps are shown by two of their columns, the \
                         finest level above, the coarsest below."
                    }
                    p.soft { "Meshes of two million triangles are drawn by the tests: tests/tests/frames.rs." }
                    dl {
                        dt { "adapter" } dd { (adapter.to_string()) }
                        dt { "driver" } dd { (adapter.driver) }
                        dt { "versions" }
                        dd { "tam-viewer " (env!("CARGO_PKG_VERSION")) ", tam-gen " (tam_gen::export::VERSION) }
                        dt { "command" } dd { "tam-viewer stability --report FILE.html" }
                    }
                    @for (name, rows) in &sections {
                        section id=(name) {
                            h2 { (capitalised(name)) }
                            table {
                                thead {
                                    tr {
                                        th.case { "Case" }
                                        th.form { "As printed" }
                                        th.form { "Hardened" }
                                        th { "Bounds, and why" }
                                        th.verdict { "Verdict" }
                                    }
                                }
                                tbody { @for row in rows { (row) } }
                            }
                        }
                    }
                }
            }
        }
    };
    Ok(whole.into_string())
}

fn row(outcome: &Outcome) -> Result<Markup, Failure> {
    let case = outcome.case;
    let [literal, hardened] = [cell(&outcome.literal, "as printed")?, cell(&outcome.hardened, "hardened")?];
    let verdict = outcome.verdict();
    let class = match verdict {
        Verdict::Held => "badge",
        Verdict::NothingToMend => "badge nothing",
        Verdict::StillFailing => "badge still",
        Verdict::Unexpected => "badge unexpected",
    };
    Ok(markup! {
        tr {
            td { b { (case.name) } span.soft { (case.method) } p { (case.failure) } p.soft { "Measured: " (case.figure) "." } }
            td { (literal) }
            td { (hardened) }
            td {
                @match case.literal {
                    Literal::Fails(limit) => { "Fails: " (limit) "; holds: " (case.holds) "." }
                    Literal::Holds(why) => { "Holds: " (case.holds) "." p { "As printed: " (why) "." } }
                }
                p { (case.reason) }
                @if let Hardened::StillFails(why) = case.hardened { p { "Still fails: " (why) } }
            }
            td { span class=(class) { (verdict.words()) } }
        }
    })
}

fn cell(side: &Side, alt: &str) -> Result<Markup, Failure> {
    let source = format!("data:image/png;base64,{}", BASE64_STANDARD.encode(png(&side.picture)?));
    Ok(markup! { img alt=(alt) src=(source); span.value { (shown(side.figure)) } })
}

/// As small as it gets: most pictures are grey.
fn png(picture: &RgbImage) -> Result<Vec<u8>, Failure> {
    let grey = picture.pixels().all(|pixel| pixel.0[0] == pixel.0[1] && pixel.0[1] == pixel.0[2]);
    let whole = DynamicImage::from(picture.clone());
    let whole = if grey { DynamicImage::from(whole.into_luma8()) } else { whole };
    let mut png = Cursor::new(Vec::new());
    let encoder = PngEncoder::new_with_quality(&mut png, CompressionType::Best, FilterType::Adaptive);
    whole.write_with_encoder(encoder).map_err(|error| Failure::Output {
        message: format!("cannot make a picture: {error}"),
        help: Some("leave out --report".to_owned()),
    })?;
    Ok(png.into_inner())
}

fn capitalised(word: &str) -> String {
    let mut letters = word.chars();
    letters.next().map_or(String::new(), |first| first.to_uppercase().chain(letters).collect())
}
