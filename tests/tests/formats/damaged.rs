//! Cut-off and altered files: an error or a sound map, never a panic.

use std::path::Path;

use tam_gen::export::Format;
use tam_gen::import::{DecodeError, ImportOptions, Imported, Texture, dds, image, ktx2, read};

use crate::{sample, write};

type Decode = fn(&[u8]) -> Result<Texture, DecodeError>;

/// The smallest files of every kind, with the reader of each. With `TAM_LOOK=folder` they are kept there, as seeds for
/// the fuzz targets.
fn files() -> Vec<(String, Vec<u8>, Decode)> {
    let (map, dir) = (sample::map(2, 16, 8, true), tempfile::tempdir().unwrap());
    write(&map, dir.path(), &Format::ALL);
    let grey = ::image::DynamicImage::from(::image::GrayImage::from_fn(16, 16, |x, y| ::image::Luma([(x * y) as u8])));
    for (name, format) in [
        ("a.jpg", ::image::ImageFormat::Jpeg),
        ("a.tga", ::image::ImageFormat::Tga),
        ("a.bmp", ::image::ImageFormat::Bmp),
    ] {
        grey.save_with_format(dir.path().join(name), format).unwrap();
    }
    let decoders: [(&str, Decode); 11] = [
        ("lines.ktx2", ktx2::decode),
        ("lines.bc4.ktx2", ktx2::decode),
        ("lines.packed0.ktx2", ktx2::decode),
        ("lines.strokemap.ktx2", ktx2::decode),
        ("lines.dds", dds::decode),
        ("lines.tone1.dds", dds::decode),
        ("cells/tone0_level0.png", image::decode),
        ("cells/strokemap_level0.png", image::decode),
        ("a.jpg", image::decode),
        ("a.tga", image::decode),
        ("a.bmp", image::decode),
    ];
    let read = |(name, decode): (&str, Decode)| {
        let bytes = std::fs::read(dir.path().join(name)).unwrap();
        if let Some(folder) = std::env::var_os("TAM_LOOK") {
            std::fs::write(Path::new(&folder).join(name.replace('/', "-")), &bytes).unwrap();
        }
        (name.into(), bytes, decode)
    };
    decoders.map(read).into()
}

fn check(texture: &Texture) {
    for level in &texture.levels {
        let texels = level.width as usize * level.height as usize * texture.channels;
        assert!(level.layers.iter().all(|layer| layer.len() == texels));
    }
}

/// A linear congruential generator (Knuth, MMIX).
fn random(state: &mut u64) -> usize {
    *state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
    (*state >> 33) as usize
}

#[test]
fn files_cut_off_anywhere_give_an_error_or_a_sound_texture() {
    for (name, bytes, decode) in files() {
        decode(&bytes).unwrap_or_else(|error| panic!("{name}: {error}"));
        for length in 0..bytes.len() {
            match decode(&bytes[..length]) {
                // A picture's end may be missing without loss; a texture's may not.
                Ok(texture) if !name.contains("lines") => check(&texture),
                Ok(_) => panic!("{name} cut off at {length} of {} was read", bytes.len()),
                Err(error) => assert!(!error.to_string().is_empty()),
            }
        }
    }
}

#[test]
fn files_with_altered_bytes_give_an_error_or_a_sound_texture() {
    let mut state = 7;
    let (mut sound, mut refused) = (0, 0);
    for (name, bytes, decode) in files() {
        let headers = bytes.len().min(256);
        for case in 0..1_000 {
            let mut altered = bytes.clone();
            for _ in 0..=random(&mut state) % 4 {
                // Mostly in the headers, where it matters.
                let within = if case % 3 == 0 { altered.len() } else { headers };
                let at = random(&mut state) % within;
                altered[at] = match random(&mut state) % 4 {
                    0 => 0,
                    1 => 255,
                    2 => altered[at] ^ (1 << (random(&mut state) % 8)),
                    _ => random(&mut state) as u8,
                };
            }
            match decode(&altered) {
                Ok(texture) => {
                    check(&texture);
                    sound += 1;
                }
                Err(error) => {
                    assert!(!error.to_string().is_empty(), "{name}");
                    refused += 1;
                }
            }
        }
    }
    assert!(sound > 500 && refused > 2_000, "both must happen often: {sound} read, {refused} refused");
}

#[test]
fn altered_files_on_disk_give_an_error_or_a_sound_grid() {
    let (map, dir) = (sample::map(2, 16, 8, true), tempfile::tempdir().unwrap());
    write(&map, dir.path(), &[Format::Ktx2]);
    let path = dir.path().join("lines.ktx2");
    let bytes = std::fs::read(&path).unwrap();
    let mut state = 11;
    for _ in 0..1_500 {
        let mut altered = bytes.clone();
        for _ in 0..=random(&mut state) % 3 {
            let at = random(&mut state) % altered.len();
            altered[at] = random(&mut state) as u8;
        }
        std::fs::write(&path, &altered).unwrap();
        if let Ok(imported) = read(&path, &ImportOptions::default()) {
            check_grid(&imported);
        }
    }
}

fn check_grid(imported: &Imported) {
    let grid = &imported.grid;
    assert!((1..=grid.levels.len()).contains(&grid.hand_built) && !grid.tones.is_empty());
    assert!(grid.tones.iter().all(|tone| (0.0..=1.0).contains(tone)));
    for level in &grid.levels {
        assert!(level.size.is_power_of_two() && level.cells.len() == grid.columns());
        assert!(level.cells.iter().all(|cell| cell.len() == (level.size * level.size) as usize));
    }
}

#[test]
fn sizes_beyond_reason_are_refused_before_anything_is_allocated() {
    let (map, dir) = (sample::map(2, 16, 8, false), tempfile::tempdir().unwrap());
    write(&map, dir.path(), &[Format::Ktx2, Format::DdsArray]);
    let patched = |file: &str, patches: &[(usize, u32)]| {
        let mut bytes = std::fs::read(Path::new(dir.path()).join(file)).unwrap();
        for &(at, word) in patches {
            bytes[at..at + 4].copy_from_slice(&word.to_le_bytes());
        }
        bytes
    };
    let too_large = |result: Result<Texture, DecodeError>| matches!(result, Err(DecodeError::TooLarge { .. }));
    assert!(too_large(ktx2::decode(&patched("lines.ktx2", &[(20, 32_768)]))));
    assert!(too_large(ktx2::decode(&patched("lines.ktx2", &[(32, u32::MAX)]))));
    assert!(too_large(ktx2::decode(&patched("lines.ktx2", &[(40, 60)]))));
    // 16384² texels in 64 layers are 16 GiB.
    assert!(too_large(ktx2::decode(&patched("lines.ktx2", &[(20, 16_384), (24, 16_384), (32, 64)]))));
    assert!(too_large(dds::decode(&patched("lines.dds", &[(16, u32::MAX)]))));
    assert!(too_large(dds::decode(&patched("lines.dds", &[(140, 5_000)]))));
    let truncated = dds::decode(&patched("lines.dds", &[(12, 8_192), (16, 8_192)]));
    assert!(matches!(truncated, Err(DecodeError::Truncated { .. })), "{truncated:?}");
    // A level that claims a size that Zstandard could never reach.
    let bomb = ktx2::decode(&patched("lines.ktx2", &[(20, 16_384), (24, 16_384), (40, 1), (96, 2 * 16_384 * 16_384)]));
    assert!(matches!(bomb, Err(DecodeError::Damaged(_))), "{bomb:?}");
}
