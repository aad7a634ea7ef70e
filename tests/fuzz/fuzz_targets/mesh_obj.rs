#![no_main]

#[path = "../../../viewer/src/mesh/invariants.rs"]
mod invariants;

use tam_viewer::mesh::{Kind, Mesh, NONE, prepare, read_raw};

libfuzzer_sys::fuzz_target!(|bytes: &[u8]| {
    let nothing = |_: &str| Err(std::io::ErrorKind::NotFound.into());
    let Ok(raw) = read_raw(bytes, Kind::Obj, &nothing) else { return };
    if let Ok(loaded) = prepare(raw) {
        invariants::check(&loaded.mesh);
        loaded.report.notes();
    }
});
