//! Reading the colours of an OBJ's material file.

use super::text::{Words, shown};

/// Names and diffuse colours (`Kd`), in linear light as the common exporters write them, clamped to 0..=1.
pub(super) fn colours(bytes: &[u8]) -> Vec<(String, [f32; 3])> {
    let mut colours = Vec::new();
    let mut name = None;
    for line in bytes.split(|&byte| byte == b'\n') {
        let mut words = Words::new(line);
        match words.next() {
            Some(b"newmtl") => name = Some(shown_name(words.rest())),
            Some(b"Kd") => {
                if let (Some(name), [Some(r), Some(g), Some(b)]) =
                    (&name, [words.number(), words.number(), words.number()])
                    && [r, g, b].iter().all(|channel| channel.is_finite())
                {
                    colours.push((name.clone(), [r, g, b].map(|channel| channel.clamp(0.0, 1.0))));
                }
            }
            _ => {}
        }
    }
    colours
}

/// A material's or object's name as text.
pub(super) fn shown_name(bytes: &[u8]) -> String {
    match std::str::from_utf8(bytes.trim_ascii()) {
        Ok(name) => name.to_owned(),
        Err(_) => shown(bytes),
    }
}
