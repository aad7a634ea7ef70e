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
    short_number(word).map(|number| number as f32).or_else(|| std::str::from_utf8(word).ok()?.parse().ok())
}

/// A number of at most 15 digits and a small power of ten, which f64 holds exactly each, so that their quotient or
/// product is the nearest f64 (Clinger, "How to read floating point numbers accurately", 1990); `None` for others.
pub(super) fn short_number(word: &[u8]) -> Option<f64> {
    let (negative, mut rest) = match word.split_first()? {
        (b'-', rest) => (true, rest),
        (b'+', rest) => (false, rest),
        _ => (false, word),
    };
    let (mut mantissa, mut digits, mut point, mut power) = (0_u64, 0, false, 0_i32);
    while let Some((&byte, after)) = rest.split_first() {
        match byte {
            b'0'..=b'9' => {
                if digits == 15 {
                    return None;
                }
                mantissa = mantissa * 10 + u64::from(byte - b'0');
                digits += 1;
                power -= i32::from(point);
            }
            b'.' if !point => point = true,
            b'e' | b'E' if after.len() <= 4 => {
                power += i32::try_from(integer(after)?).ok()?;
                break;
            }
            _ => return None,
        }
        rest = after;
    }
    if digits == 0 || power.unsigned_abs() > 22 {
        return None;
    }
    let scale = POWERS[power.unsigned_abs() as usize];
    let value = if power < 0 { mantissa as f64 / scale } else { mantissa as f64 * scale };
    Some(if negative { -value } else { value })
}

/// The powers of ten that f64 holds exactly.
const POWERS: [f64; 23] = [
    1e0, 1e1, 1e2, 1e3, 1e4, 1e5, 1e6, 1e7, 1e8, 1e9, 1e10, 1e11, 1e12, 1e13, 1e14, 1e15, 1e16, 1e17, 1e18, 1e19, 1e20,
    1e21, 1e22,
];

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
    fn numbers_are_those_of_the_standard_library() {
        let words = [
            "0",
            "-0",
            "+1.5",
            "-.25",
            "7.",
            "1e3",
            "1.25E-7",
            "-9.999999e+37",
            "0.1",
            "123456.789",
            "1e-46",
            "16777217",
            "340282350000000000000000000000000000000",
            "0.30000001192092896",
            "2.2250738585072014e-308",
            "inf",
            "nan",
        ];
        for word in words {
            let theirs: f32 = word.parse().expect("a number");
            let ours = number(word.as_bytes()).expect("a number");
            assert!(ours.to_bits() == theirs.to_bits() || ours.is_nan() && theirs.is_nan(), "{word}: {ours} {theirs}");
        }
        for word in ["", "-", ".", "e5", "1e", "1e+", "1.2.3", "1,5", "0x10", "1e5e5", "--1"] {
            assert_eq!(number(word.as_bytes()), None, "{word}");
        }
    }

    #[test]
    fn words_are_split_at_any_white_space() {
        let words: Vec<&[u8]> = Words::new(b" \t v 1\r\n").collect();
        assert_eq!(words, [b"v", b"1"]);
    }
}
