//! Words, numbers and lines of text formats, from bytes that need not be text.

/// The words of a text, between white space.
pub(super) struct Words<'a> {
    rest: &'a [u8],
}

impl<'a> Words<'a> {
    pub(super) fn new(text: &'a [u8]) -> Self {
        Self { rest: text }
    }

    /// What comes after the words taken so far.
    pub(super) fn rest(&self) -> &'a [u8] {
        self.rest
    }

    /// The next word as a number.
    pub(super) fn number(&mut self) -> Option<f32> {
        number(self.next()?)
    }
}

impl<'a> Iterator for Words<'a> {
    type Item = &'a [u8];

    fn next(&mut self) -> Option<&'a [u8]> {
        let begin = self.rest.iter().position(|byte| !byte.is_ascii_whitespace())?;
        let word = &self.rest[begin..];
        let length = word.iter().position(u8::is_ascii_whitespace).unwrap_or(word.len());
        self.rest = &word[length..];
        Some(&word[..length])
    }
}

/// A decimal number; `nan` and `inf` too, which preparation drops and counts.
pub(super) fn number(word: &[u8]) -> Option<f32> {
    std::str::from_utf8(word).ok()?.parse().ok()
}

/// A whole number.
pub(super) fn integer(word: &[u8]) -> Option<i64> {
    let (negative, digits) = match word.split_first()? {
        (b'-', digits) => (true, digits),
        (b'+', digits) => (false, digits),
        _ => (false, word),
    };
    // 18 digits are below the range's end.
    if digits.is_empty() || digits.len() > 18 || !digits.iter().all(u8::is_ascii_digit) {
        return None;
    }
    let value = digits.iter().fold(0, |value, digit| value * 10 + i64::from(digit - b'0'));
    Some(if negative { -value } else { value })
}

/// Bytes as text for a message: at most 40 of them, with a mark for what is no text.
pub(super) fn shown(bytes: &[u8]) -> String {
    let text = String::from_utf8_lossy(bytes.get(..40).unwrap_or(bytes));
    text.trim().chars().map(|character| if character.is_control() { '\u{fffd}' } else { character }).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn whole_numbers_have_signs_and_an_end() {
        assert_eq!(integer(b"-12"), Some(-12));
        assert_eq!(integer(b"+7"), Some(7));
        assert_eq!(integer(b"1e3"), None);
        assert_eq!(integer(b"-"), None);
        assert_eq!(integer(&[b'9'; 40]), None);
    }

    #[test]
    fn words_are_split_at_any_white_space() {
        let words: Vec<&[u8]> = Words::new(b" \t v 1\r\n").collect();
        assert_eq!(words, [b"v", b"1"]);
    }
}
