//! Contact sheets and tilings. With `TAM_LOOK=folder` the pictures are kept there to be looked at.

use tam_gen::export::sheet::{SheetOptions, contact_sheet, tiling};

use crate::sample;

fn keep(name: &str, picture: &image::RgbImage) {
    if let Some(folder) = std::env::var_os("TAM_LOOK") {
        picture.save(std::path::Path::new(&folder).join(name)).unwrap();
    }
}

#[test]
fn every_cell_is_on_the_sheet_texel_by_texel_with_ground_around_it() {
    for (columns, size, coarsest, tail) in
        [(6, 256, 32, false), (1, 64, 8, true), (64, 128, 8, true), (3, 1024, 64, false), (12, 64, 8, false)]
    {
        let map = sample::map(columns, size, coarsest, tail);
        let options = SheetOptions {
            title: "Nested lines".into(),
            description: "Parallel lines in bit-reversed order, so that every tone holds all lighter ones; drawn for \
                          tests, to show how a description that is longer than the sheet is wide breaks"
                .into(),
            paper: [250, 246, 235],
            ink: [30, 34, 60],
            ..SheetOptions::default()
        };
        let sheet = contact_sheet(&map.grid, &options);
        keep(&format!("sheet-{columns}x{size}.png"), &sheet);
        assert!(sheet.width() <= 4000, "{columns} x {size}: {} px wide", sheet.width());
        let (paper, ink) = (image::Rgb(options.paper), image::Rgb(options.ink));
        let count = |colour| sheet.pixels().filter(|&&pixel| pixel == colour).count();
        let shown = |size: u32| if columns == 64 { size.min(32) } else { size.min(1024) };
        if columns != 64 {
            let texels = |wanted: u8| {
                let cells = map.grid.levels.iter().flat_map(|level| &level.cells);
                cells.flatten().filter(|&&ink| ink == wanted).count()
            };
            assert_eq!((count(paper), count(ink)), (texels(0), texels(255)), "{columns} x {size}");
        }
        assert!(sheet.height() >= map.grid.levels.iter().map(|level| shown(level.size)).sum());
        let ground = sheet.get_pixel(0, 0);
        let (w, h) = sheet.dimensions();
        let edge = |x: u32, y: u32| x < 20 || y < 20 || x >= w - 20 || y >= h - 20;
        assert!(sheet.enumerate_pixels().all(|(x, y, pixel)| !edge(x, y) || pixel == ground), "{columns} x {size}");
    }
}

#[test]
fn wide_maps_are_reduced_in_linear_light() {
    let map = sample::map(6, 1024, 512, false);
    let sheet = contact_sheet(&map.grid, &SheetOptions::default());
    keep("sheet-6x1024.png", &sheet);
    assert!(sheet.width() <= 4000);
}

#[test]
fn a_tiling_repeats_the_cell() {
    let map = sample::map(2, 64, 32, false);
    let picture = tiling(&map.grid.levels[0], 1, 3);
    keep("tiling.png", &picture);
    assert_eq!(picture.dimensions(), (192, 192));
    for (x, y, pixel) in picture.enumerate_pixels() {
        let ink = map.grid.levels[0].cells[1][(y % 64 * 64 + x % 64) as usize];
        assert_eq!(pixel.0, [255 - ink; 3]);
    }
}
