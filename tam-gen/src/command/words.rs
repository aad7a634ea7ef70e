//! Figures and paths in words.

use std::path::Path;
use std::time::Duration;

/// Time in words: `87 ms`, `2.4 s`.
pub fn duration(took: Duration) -> String {
    if took < Duration::from_secs(1) {
        format!("{:.0} ms", milliseconds(took))
    } else {
        format!("{:.1} s", took.as_secs_f64())
    }
}

/// Time in milliseconds, to a hundredth.
pub fn milliseconds(took: Duration) -> f64 {
    (took.as_secs_f64() * 1e5).round() / 100.0
}

/// A path as text; bytes that are no text are replaced.
pub fn path_text(path: &Path) -> String {
    path.display().to_string()
}

/// A number of bytes: `640 B`, `1.5 kB`, `12.0 MB`.
pub fn size(bytes: u64) -> String {
    match bytes {
        0..1_000 => format!("{bytes} B"),
        1_000..1_000_000 => format!("{:.1} kB", bytes as f64 / 1e3),
        _ => format!("{:.1} MB", bytes as f64 / 1e6),
    }
}

/// A number of things: `1 level`, `5 levels`.
pub fn counted(count: usize, noun: &str) -> String {
    format!("{count} {noun}{}", if count == 1 { "" } else { "s" })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn times_are_short_to_read() {
        assert_eq!(duration(Duration::from_micros(87_400)), "87 ms");
        assert_eq!(duration(Duration::from_millis(2_449)), "2.4 s");
    }
}
