use super::*;
use crate::mesh::prepare;
use crate::mesh::sample::Sample;
use crate::surface::{FieldOptions, curvatures, field};

#[test]
fn stats() {
    for sample in [Sample::Head, Sample::Hand] {
        let mesh = prepare(sample.build(20_000)).expect("mesh").mesh.subdivided(0.08);
        let graph = Graph::new(&mesh);
        let field = field(&graph, &mesh, &curvatures(&graph), &FieldOptions::default()).expect("field");
        let started = std::time::Instant::now();
        let options = LappedOptions::default();
        let faces = faces::faces(&graph, &field);
        let mut cover = Cover::new(faces.len());
        let mut grower = Grower::new(&graph, &faces, options.tiles_per_unit);
        let mut n = 0;
        for seed in by_chance(faces.len()) {
            if cover.is_covered(seed as usize) {
                continue;
            }
            let mut draw = Draw::new(n, "lapped patch");
            let offset_uv = [draw.unit(), draw.unit()];
            let outline = Outline::new(options.radius_tiles, options.irregularity, &mut draw);
            let patch = grower.grow(seed, &outline).unwrap();
            let alphas = fade::alphas(&faces, &patch, &outline, options.feather_tiles, options.tiles_per_unit);
            let uns =
                patch.members.iter().filter(|m| !fade::is_sound(&faces, &patch, m, options.tiles_per_unit)).count();
            let rim =
                patch.rim.iter().filter(|e| e.iter().any(|n| outline.depth(patch.places[*n as usize]) > 0.0)).count();
            cover.paste(n as u32, &patch, &alphas, DVec2::from(offset_uv));
            let left = (0..faces.len()).filter(|f| !cover.is_covered(*f)).count();
            if n < 40 || n % 20 == 0 {
                println!(
                    "{n} seed {seed} members {} unsound {uns} rim {}/{rim} opaque {} left {left}",
                    patch.members.len(),
                    patch.rim.len(),
                    alphas.iter().filter(|a| **a >= 1.0).count()
                );
            }
            n += 1;
        }
        println!("{} patches {n} {:?}", sample.name(), started.elapsed());
    }
}
