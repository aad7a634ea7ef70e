//! Tip pictures: from a file beside the preset into the preset itself, and out again.

use std::io::Read;
use std::path::Path;

use base64::Engine;
use base64::engine::general_purpose::STANDARD;
use resvg::usvg;

use super::TipOptions;
use crate::raster::TipMask;

/// Largest picture file of a tip, in bytes.
pub(crate) const TIP_BYTES_MAX: u64 = 4 << 20;

const PNG_MAGIC: &[u8] = b"\x89PNG\r\n\x1a\n";
const PNG_ADDRESS: &str = "data:image/png;base64,";
const SVG_ADDRESS: &str = "data:image/svg+xml;base64,";

/// Reads a picture file and gives the `data:` address that holds it.
pub(crate) fn embed(path: &Path) -> Result<String, String> {
    let shown = path.display();
    let file = std::fs::File::open(path).map_err(|error| format!("cannot open {shown}: {error}"))?;
    let mut bytes = Vec::new();
    file.take(TIP_BYTES_MAX + 1).read_to_end(&mut bytes).map_err(|error| format!("cannot read {shown}: {error}"))?;
    if bytes.len() as u64 > TIP_BYTES_MAX {
        return Err(format!("{shown} is larger than {} MiB", TIP_BYTES_MAX >> 20));
    }
    let address = if bytes.starts_with(PNG_MAGIC) { PNG_ADDRESS } else { SVG_ADDRESS };
    let address = format!("{address}{}", STANDARD.encode(bytes));
    match TipMask::new(&TipOptions { image: Some(address.clone()), ..TipOptions::default() }) {
        Ok(_) => Ok(address),
        Err(error) => Err(format!("{shown}: {error}")),
    }
}

/// Checks the shape of a tip, however it is given.
pub(crate) fn check_shape(tip: &TipOptions) -> Result<(), String> {
    if let Some(path) = &tip.path {
        check_path(path)?;
    }
    if tip.image.as_ref().is_some_and(|address| address.len() as u64 > TIP_BYTES_MAX / 3 * 4 + 64) {
        return Err(format!("the tip's picture is larger than {} MiB", TIP_BYTES_MAX >> 20));
    }
    TipMask::new(tip).map(|_| ()).map_err(|error| error.to_string())
}

/// Reading of SVG that never follows a link to another file.
pub(crate) fn svg_options<'a>() -> usvg::Options<'a> {
    usvg::Options {
        image_href_resolver: usvg::ImageHrefResolver {
            resolve_data: Box::new(|_, _, _| None),
            resolve_string: Box::new(|_, _| None),
        },
        ..usvg::Options::default()
    }
}

/// Checks SVG path data to its end; drawing takes what comes before an error, as browsers do.
fn check_path(data: &str) -> Result<(), String> {
    match svgtypes::PathParser::from(data).find_map(Result::err) {
        Some(error) => Err(format!("the path does not parse: {error}")),
        None => Ok(()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn path(data: &str) -> TipOptions {
        TipOptions { path: Some(data.to_owned()), ..TipOptions::default() }
    }

    fn picture(address: &str) -> TipOptions {
        TipOptions { image: Some(address.to_owned()), ..TipOptions::default() }
    }

    #[test]
    fn a_path_must_parse_to_its_end() {
        assert_eq!(check_shape(&path("M0 0 L1 0 L1 1 Z")), Ok(()));
        for wrong in ["", "L1 0", "M0 0", "M0 0 L1 0 L1 1 L", "M0 0 L1 0 L1 1 oops", "M0 0\"/>"] {
            assert!(check_shape(&path(wrong)).is_err(), "{wrong:?} was taken");
        }
    }

    #[test]
    fn a_picture_survives_the_way_into_a_preset() {
        let folder = tempfile::tempdir().expect("a temporary folder");
        let png = folder.path().join("tip.png");
        image::GrayImage::new(4, 3).save(&png).expect("a written picture");
        assert_eq!(check_shape(&picture(&embed(&png).expect("an address"))), Ok(()));

        let svg = folder.path().join("tip.svg");
        let drawing = r#"<svg xmlns="http://www.w3.org/2000/svg" width="4" height="4"><path d="M0 0H4V4Z"/></svg>"#;
        std::fs::write(&svg, drawing).expect("a written drawing");
        assert_eq!(check_shape(&picture(&embed(&svg).expect("an address"))), Ok(()));
    }

    #[test]
    fn corrupt_pictures_are_refused() {
        let folder = tempfile::tempdir().expect("a temporary folder");
        let file = folder.path().join("tip.png");
        image::GrayImage::new(32, 32).save(&file).expect("a written picture");
        let whole = std::fs::read(&file).expect("the picture");
        std::fs::write(&file, &whole[..whole.len() / 2]).expect("a cut picture");
        assert!(embed(&file).is_err());
        std::fs::write(&file, "<svg><path d=").expect("a broken drawing");
        assert!(embed(&file).is_err());
        assert!(embed(folder.path()).is_err());
        assert!(embed(&folder.path().join("none.png")).is_err());
        assert!(check_shape(&picture("data:image/png;base64,????")).is_err());
    }

    #[test]
    fn a_drawing_does_not_pull_in_other_files() {
        let folder = tempfile::tempdir().expect("a temporary folder");
        let inner = folder.path().join("inner.svg");
        let drawing = r#"<svg xmlns="http://www.w3.org/2000/svg" width="4" height="4"><path d="M0 0H4V4Z"/></svg>"#;
        std::fs::write(&inner, drawing).expect("a written drawing");
        let outer = folder.path().join("outer.svg");
        let linked = format!(
            r#"<svg xmlns="http://www.w3.org/2000/svg" width="4" height="4"><image width="4" height="4" href="{}"/></svg>"#,
            inner.display()
        );
        std::fs::write(&outer, linked).expect("a written drawing");
        assert!(embed(&outer).is_err());
    }
}
