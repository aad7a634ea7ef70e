//! Writing single files whole or not at all.

use std::io::Write;
use std::path::Path;

use image::codecs::png::{CompressionType, FilterType, PngEncoder};
use image::{ImageBuffer, PixelWithColorType};

use super::Failure;
use crate::files::{folder_of, temporary};

/// Writes a file so that it is there complete or not at all; replaces one only with `force`.
///
/// # Errors
/// It cannot be written, or is there already.
pub fn write(path: &Path, bytes: &[u8], force: bool) -> Result<(), Failure> {
    check_free(path, force)?;
    let folder = folder_of(path);
    let failed = |error: std::io::Error| Failure::write(path, &error);
    std::fs::create_dir_all(folder).map_err(failed)?;
    let mut file = temporary().tempfile_in(folder).map_err(failed)?;
    file.write_all(bytes).map_err(failed)?;
    if force {
        file.persist(path).map_err(|error| Failure::write(path, &error.error))?;
    } else {
        // What appeared in the meantime is not replaced either.
        file.persist_noclobber(path).map_err(|error| Failure::write(path, &error.error))?;
    }
    Ok(())
}

/// Writes a picture as PNG, as small as it gets.
///
/// # Errors
/// As [`write()`].
pub fn write_picture<P>(path: &Path, picture: &ImageBuffer<P, Vec<u8>>, force: bool) -> Result<(), Failure>
where
    P: PixelWithColorType<Subpixel = u8>,
{
    let mut png = Vec::new();
    let encoder = PngEncoder::new_with_quality(&mut png, CompressionType::Best, FilterType::Adaptive);
    picture.write_with_encoder(encoder).map_err(|error| Failure::Output {
        message: format!("cannot make the picture: {error}"),
        help: Some("show a smaller map".to_owned()),
    })?;
    write(path, &png, force)
}

/// Refuses a place that is taken, before work is put into what should go there.
///
/// # Errors
/// It is a folder, or is there already and not to be replaced.
pub fn check_free(path: &Path, force: bool) -> Result<(), Failure> {
    if path.is_dir() {
        return Err(Failure::Output {
            message: format!("{} is a folder", path.display()),
            help: Some("-o takes the file to write".to_owned()),
        });
    }
    if !force && path.symlink_metadata().is_ok() {
        return Err(Failure::Output {
            message: format!("{} is already there", path.display()),
            help: Some("--force replaces it; or name another place".to_owned()),
        });
    }
    Ok(())
}
