//! Tip pictures: from a file beside the preset into the preset itself, and out again.

use std::io::Read;
use std::path::Path;

use base64::Engine;
use base64::engine::general_purpose::STANDARD;
use resvg::usvg;

/// Largest picture file of a tip, in bytes.
pub(crate) const TIP_BYTES_MAX: u64 = 4 << 20;

/// Largest side of a tip's picture, in texels.
pub(crate) const TIP_SIDE_MAX: u32 = 2048;

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
    decode(&bytes, address == PNG_ADDRESS).map_err(|problem| format!("{shown} {problem}"))?;
    Ok(format!("{address}{}", STANDARD.encode(bytes)))
}

/// Checks the picture that a `data:` address holds.
pub(crate) fn check_picture(address: &str) -> Result<(), String> {
    let (text, is_png) = if let Some(text) = address.strip_prefix(PNG_ADDRESS) {
        (text, true)
    } else if let Some(text) = address.strip_prefix(SVG_ADDRESS) {
        (text, false)
    } else {
        return Err(format!("is no address that starts with {PNG_ADDRESS} or {SVG_ADDRESS}"));
    };
    if text.len() as u64 > TIP_BYTES_MAX / 3 * 4 + 8 {
        return Err(format!("holds more than {} MiB", TIP_BYTES_MAX >> 20));
    }
    let bytes = STANDARD.decode(text).map_err(|error| format!("does not hold valid base64: {error}"))?;
    decode(&bytes, is_png)
}

fn decode(bytes: &[u8], is_png: bool) -> Result<(), String> {
    if is_png {
        let mut reader = image::ImageReader::with_format(std::io::Cursor::new(bytes), image::ImageFormat::Png);
        let mut limits = image::Limits::default();
        limits.max_image_width = Some(TIP_SIDE_MAX);
        limits.max_image_height = Some(TIP_SIDE_MAX);
        reader.limits(limits);
        reader.decode().map_err(|error| format!("is not a usable PNG file: {error}"))?;
        return Ok(());
    }
    let tree = usvg::Tree::from_data(bytes, &svg_options())
        .map_err(|error| format!("is neither a PNG nor a usable SVG file: {error}"))?;
    if !tree.root().has_children() {
        return Err("is an SVG file without anything to draw".to_owned());
    }
    Ok(())
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

/// Checks SVG path data: every command must parse, and the first must be a move.
pub(crate) fn check_path(data: &str) -> Result<(), String> {
    let mut commands = 0_usize;
    for command in svgtypes::PathParser::from(data) {
        command.map_err(|error| error.to_string())?;
        commands += 1;
    }
    if commands < 2 {
        return Err("nothing is drawn".to_owned());
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_path_must_parse_to_its_end() {
        assert!(check_path("M0 0 L1 0 L1 1 Z").is_ok());
        for wrong in ["", "L1 0", "M0 0", "M0 0 L1", "M0 0 L1 0 oops"] {
            assert!(check_path(wrong).is_err(), "{wrong:?} was taken");
        }
    }

    #[test]
    fn a_picture_survives_the_way_into_a_preset() {
        let folder = tempfile::tempdir().expect("a temporary folder");
        let png = folder.path().join("tip.png");
        image::GrayImage::new(4, 3).save(&png).expect("a written picture");
        let address = embed(&png).expect("an address");
        assert_eq!(check_picture(&address), Ok(()));

        let svg = folder.path().join("tip.svg");
        std::fs::write(
            &svg,
            r#"<svg xmlns="http://www.w3.org/2000/svg" width="4" height="4"><path d="M0 0H4V4Z"/></svg>"#,
        )
        .expect("a written drawing");
        let address = embed(&svg).expect("an address");
        assert_eq!(check_picture(&address), Ok(()));
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
        assert!(check_picture("data:image/png;base64,????").is_err());
        assert!(check_picture("tip.png").is_err());
    }
}
