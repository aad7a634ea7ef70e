#![no_main]

use std::sync::LazyLock;

use tam_viewer::mesh::sample::Sample;
use tam_viewer::mesh::{Mesh, prepare};
use tam_viewer::surface::patches::MAX_ENTRIES;
use tam_viewer::surface::{Corners, LappedOptions, PatchOptions, Patches, StripeOptions, Surface, SurfaceOptions, store};

/// A mesh, and of the file of its surface what comes before the hash of the rest: without the right key and hash nothing
/// would be read.
static KEPT: LazyLock<(Mesh, SurfaceOptions, Vec<u8>)> = LazyLock::new(|| {
    let mesh = prepare(Sample::Cube.build(12)).expect("a cube").mesh;
    let options = SurfaceOptions {
        patches: Some(PatchOptions::default()),
        lapped: Some(LappedOptions::default()),
        stripes: Some(StripeOptions::default()),
        ..SurfaceOptions::default()
    };
    let surface = Surface::new(&mesh, &options).expect("a surface");
    let mut head = store::to_bytes(&mesh, &options, &surface).expect("a file");
    head.truncate(40);
    (mesh, options, head)
});

libfuzzer_sys::fuzz_target!(|body: &[u8]| {
    let (mesh, options, head) = &*KEPT;
    assert!(store::parse(body, mesh, options).ok().flatten().is_none(), "no one guesses a hash");
    let bytes = [head.as_slice(), blake3::hash(body).as_bytes().as_slice(), body].concat();
    let Ok(surface) = store::parse(&bytes, mesh, options) else { return };
    let surface = surface.expect("the key is that of the mesh");
    assert!(surface.field.angles_rad.iter().all(|angle| angle.is_finite()));
    for patches in [&surface.patches, &surface.lapped] {
        check(patches.as_ref().expect("it was asked for"), &surface, mesh);
    }
    let stripes = surface.stripes.as_ref().expect("they were asked for");
    assert_eq!(stripes.along.len(), mesh.triangles.len());
    let corners = Corners::of_stripes(&mesh.triangles, stripes, surface.patches.as_ref());
    assert!(corners.indices.iter().all(|index| (*index as usize) < corners.stands.len()));
});

/// What shaders rely on.
fn check(patches: &Patches, surface: &Surface, mesh: &Mesh) {
    let faces = mesh.triangles.len();
    assert!(patches.tiles_per_unit.is_finite() && patches.tiles_per_unit > 0.0);
    assert!(patches.seeds.iter().all(|seed| (seed.node as usize) < surface.graph.len()));
    for face in 0..faces {
        assert!((1..=MAX_ENTRIES).contains(&patches.of(face).len()));
    }
    let count = patches.entries.len();
    let corners = Corners::of_patches(&mesh.triangles, patches);
    assert_eq!(corners.patches.len(), corners.stands.len());
    assert_eq!(patches.starts[faces] as usize, count);
    assert!([0, count].contains(&patches.rows.len()));
    for entry in &patches.entries {
        assert!(entry.seed == u32::MAX || (entry.seed as usize) < patches.seeds.len());
        assert!(entry.uv.iter().all(|uv| uv.is_finite()));
    }
}
