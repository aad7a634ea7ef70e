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

/// Endings that name a file: a new folder is hardly meant by them.
const FILE_ENDINGS: [&str; 9] = ["ktx2", "dds", "png", "svg", "json", "toml", "csv", "html", "zip"];

/// Refuses what cannot be a folder to write to, before work is put into its files; `option` is what named it.
///
/// # Errors
/// It or a folder above is a file, or it is not there and is named like a file.
pub fn check_folder(folder: &Path, option: &str) -> Result<(), Failure> {
    let refused = |what: &str| Failure::Output {
        message: format!("{} is {what}", folder.display()),
        help: Some(format!("{option} takes the folder to write to")),
    };
    if folder.is_file() {
        return Err(refused("a file"));
    }
    if folder.ancestors().find(|above| above.exists()).is_some_and(Path::is_file) {
        return Err(Failure::write(folder, &std::io::ErrorKind::NotADirectory.into()));
    }
    let ending = folder.extension().map(|ending| ending.to_ascii_lowercase());
    if !folder.exists() && ending.is_some_and(|ending| FILE_ENDINGS.iter().any(|of_file| ending == *of_file)) {
        return Err(refused("named like a file"));
    }
    Ok(())
}
