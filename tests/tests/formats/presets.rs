//! The materials that come with the program, exported whole.

use tam_gen::export::{Format, strokes_svg};
use tam_gen::import::{ImportOptions, read};

#[test]
fn every_preset_comes_back_and_its_vector_strokes_lie_where_its_raster_has_ink() {
    let look = std::env::var_os("TAM_LOOK").map(std::path::PathBuf::from);
    for (name, text) in tam_gen::Preset::embedded() {
        let preset = tam_gen::Preset::from_toml(text, name).unwrap();
        let map = tam_gen::generate(&preset, &tam_gen::Job::default()).unwrap();
        let dir = tempfile::tempdir().unwrap();
        let written = crate::write(&map, dir.path(), &Format::ALL);
        let imported = read(&dir.path().join("lines.ktx2"), &ImportOptions::default()).unwrap();
        assert!(imported.grid == map.grid && imported.stroke_map.as_ref() == Some(&map.stroke_map), "{name}");
        assert_eq!(imported.preset_toml.as_deref(), Some(preset.to_toml().as_str()));

        let tree = resvg::usvg::Tree::from_str(&strokes_svg(&map, "#ffffff", "#000000"), &Default::default()).unwrap();
        let size = map.grid.levels[0].size;
        let mut pixmap = resvg::tiny_skia::Pixmap::new(size, size).unwrap();
        resvg::render(&tree, Default::default(), &mut pixmap.as_mut());
        let drawn: Vec<f64> = pixmap.pixels().iter().map(|pixel| f64::from(255 - pixel.red())).collect();
        let raster: Vec<f64> = map.grid.levels[0].cells[map.grid.columns() - 1].iter().map(|&ink| ink.into()).collect();
        let alike = correlation(&drawn, &raster);
        if let Some(look) = &look {
            std::fs::copy(dir.path().join("lines.sheet.png"), look.join(format!("{name}.png"))).unwrap();
            std::fs::copy(dir.path().join("lines.strokes.svg"), look.join(format!("{name}.svg"))).unwrap();
            pixmap.save_png(look.join(format!("{name}-strokes.png"))).unwrap();
        }
        // Grain is not drawn as vectors; strokes laid anywhere else give 0.1 at most.
        let least = if map.preset.stroke.grain > 0.4 { 0.6 } else { 0.9 };
        assert!(alike > least, "{name}: {alike}");
        let bc4 = written.iter().find(|file| file.path.ends_with("lines.bc4.ktx2")).unwrap();
        assert!(bc4.what.contains("nesting holds"), "{name}: {}", bc4.what);
    }
}

/// Pearson's coefficient.
fn correlation(a: &[f64], b: &[f64]) -> f64 {
    let mean = |x: &[f64]| x.iter().sum::<f64>() / x.len() as f64;
    let (mean_a, mean_b) = (mean(a), mean(b));
    let covariance =
        |x: &[f64], mx: f64, y: &[f64], my: f64| x.iter().zip(y).map(|(x, y)| (x - mx) * (y - my)).sum::<f64>();
    covariance(a, mean_a, b, mean_b) / (covariance(a, mean_a, a, mean_a) * covariance(b, mean_b, b, mean_b)).sqrt()
}
