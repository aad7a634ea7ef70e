//! Numbers as people read them.

use std::time::Duration;

/// A size in bytes: `340 KB`, `1.6 MB`.
pub(crate) fn bytes(bytes: u64) -> String {
    match bytes {
        0..1_000 => format!("{bytes} B"),
        1_000..1_000_000 => format!("{:.0} KB", bytes as f64 / 1e3),
        1_000_000..1_000_000_000 => format!("{:.1} MB", bytes as f64 / 1e6),
        _ => format!("{:.1} GB", bytes as f64 / 1e9),
    }
}

/// A time: `6.3 ms`, `140 ms`, `2.1 s`.
pub(crate) fn duration(duration: Duration) -> String {
    let milliseconds = duration.as_secs_f64() * 1e3;
    match milliseconds {
        ..10.0 => format!("{milliseconds:.1} ms"),
        ..1000.0 => format!("{milliseconds:.0} ms"),
        _ => format!("{:.1} s", milliseconds / 1e3),
    }
}

/// A key of an option as a name: `width_px` is `Width`.
pub(crate) fn option_name(key: &str) -> String {
    let stem = key.strip_suffix("_px").or_else(|| key.strip_suffix("_deg")).unwrap_or(key);
    let mut words = stem.replace('_', " ");
    if let Some(first) = words.get_mut(..1) {
        first.make_ascii_uppercase();
    }
    words
}

/// `1 triangle`, `20 000 triangles`.
pub(crate) fn counted(count: usize, what: &str) -> String {
    let plural = if count == 1 { "" } else { "s" };
    format!("{} {what}{plural}", grouped(count))
}

/// A whole number in groups of three digits.
pub(crate) fn grouped(count: usize) -> String {
    let digits = count.to_string();
    let mut grouped = String::new();
    for (i, digit) in digits.chars().enumerate() {
        if i > 0 && (digits.len() - i).is_multiple_of(3) {
            grouped.push('\u{a0}');
        }
        grouped.push(digit);
    }
    grouped
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_short() {
        assert_eq!(
            [bytes(999), bytes(340_400), bytes(1_600_000), bytes(2_100_000_000)],
            ["999 B", "340 KB", "1.6 MB", "2.1 GB"]
        );
        assert_eq!(
            [6.34e-3, 0.1402, 2.1].map(|seconds| duration(Duration::from_secs_f64(seconds))),
            ["6.3 ms", "140 ms", "2.1 s"]
        );
        assert_eq!(
            ["width_px", "angle_jitter_deg", "bow", "s_curve"].map(option_name),
            ["Width", "Angle jitter", "Bow", "S curve"]
        );
        assert_eq!(
            [counted(1, "triangle"), counted(1_234_567, "triangle")],
            ["1 triangle", "1\u{a0}234\u{a0}567 triangles"]
        );
    }
}
