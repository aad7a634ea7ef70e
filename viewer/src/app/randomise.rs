//! Strokes by chance, within what shipped presets show to be pleasant.

use std::sync::LazyLock;

use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;
use tam_gen::Preset;
use tam_gen::preset::{Range, StrokeOptions};

/// By stroke number: least and greatest of the presets that come with the tool.
static PLEASANT: LazyLock<Vec<(&'static str, f64, f64)>> = LazyLock::new(|| {
    let presets: Vec<Preset> = Preset::embedded().iter().filter_map(|(name, _)| Preset::named(name)?.ok()).collect();
    let numbers = StrokeOptions::default().numbers();
    let of = |key: &'static str| {
        let found = presets.iter().flat_map(|preset| preset.stroke.numbers()).filter(|(other, _)| *other == key);
        let (low, high) =
            found.fold((f64::MAX, f64::MIN), |(low, high), (_, number)| (low.min(number), high.max(number)));
        (key, low, high)
    };
    numbers.into_iter().map(|(key, _)| of(key)).collect()
});

/// The preset with every stroke number that is not locked set by chance, and another seed; `turn` counts the times, so that
/// every time is another.
pub(super) fn randomised(preset: &Preset, locked: &[String], turn: u64) -> Preset {
    let mut random = ChaCha8Rng::seed_from_u64(preset.seed);
    random.set_stream(turn);
    let mut changed = preset.clone();
    for (key, low, high) in PLEASANT.iter() {
        let part: f64 = random.random();
        let is_locked = locked.iter().any(|known| known == key);
        let Some(range) = Range::find("stroke", key).filter(|_| !is_locked && low < high) else { continue };
        let number = low + (high - low) * part;
        // Slider steps: nobody wants 1.734926 px.
        let step = 10_f64.powf(((range.max - range.min) / 300.0).log10().floor());
        changed.stroke.set_number(key, ((number / step).round() * step).clamp(range.min, range.max));
    }
    let stroke = &mut changed.stroke;
    if stroke.length_min > stroke.length_max {
        std::mem::swap(&mut stroke.length_min, &mut stroke.length_max);
    }
    changed.seed = random.random_range(1..10_000);
    if changed.validate().is_empty() { changed } else { preset.clone() }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_turn_is_another_valid_preset_and_locked_numbers_stay() {
        let preset = Preset::default();
        let locked = vec!["width_px".to_owned()];
        let made: Vec<Preset> = (1..40).map(|turn| randomised(&preset, &locked, turn)).collect();
        for (i, changed) in made.iter().enumerate() {
            assert!(changed.validate().is_empty());
            assert_eq!(changed.stroke.width_px, preset.stroke.width_px);
            assert!(made[..i].iter().all(|before| before.stroke != changed.stroke), "turn {i}");
        }
        let changed = made.iter().filter(|changed| changed.stroke != preset.stroke).count();
        assert!(changed > 30, "few combinations make no sense: {changed}");
        assert_eq!(randomised(&preset, &locked, 1), made[0]);
    }
}
