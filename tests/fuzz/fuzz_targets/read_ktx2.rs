#![no_main]

libfuzzer_sys::fuzz_target!(|bytes: &[u8]| {
    let Ok(texture) = tam_gen::import::ktx2::decode(bytes) else { return };
    for level in &texture.levels {
        let texels = level.width as usize * level.height as usize * texture.channels;
        assert!(level.layers.iter().all(|layer| layer.len() == texels));
    }
});
