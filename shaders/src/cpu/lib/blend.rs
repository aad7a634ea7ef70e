//! Twin of `lib/blend.wgsl`: patterns that overlap, by union or linearly.

use super::mapping::{Mapped, pattern_count};
use crate::cpu::{Blend, Mapping, Options};

/// The darkness at which a pattern of this weight takes part, so that the union of all has darkness `d`.
pub fn union_darkness(d: f64, weight: f64) -> f64 {
    1.0 - (1.0 - d).max(1e-6).powf(weight)
}

/// Ink of all patterns; `pattern_ink(i, darkness)` is that of pattern `i` at a darkness.
pub fn blended_ink(options: Options, mapped: &Mapped, d: f64, pattern_ink: impl Fn(usize, f64) -> f64) -> f64 {
    let linear = options.blend == Blend::Linear || options.mapping == Mapping::Frames;
    let mut sum = 0.0;
    let mut clear = 1.0;
    let count = pattern_count(options.mapping, mapped);
    for (i, pattern) in mapped.patterns[..count].iter().enumerate() {
        if linear {
            sum += pattern.weight * pattern_ink(i, d);
        } else {
            let reduced = union_darkness(d, pattern.weight);
            clear *= 1.0 - pattern_ink(i, reduced);
        }
    }
    if linear { sum } else { 1.0 - clear }
}
