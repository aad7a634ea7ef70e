//! Counter-based randomness: every number is a function of seed, family, stroke and candidate, never of what was drawn
//! before, of threads or of time.

use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::{Rng, SeedableRng};

/// Words of the random stream set aside for one stroke: enough for a hundred thousand candidates.
const WORDS_PER_STROKE_LOG2: u32 = 20;

/// The random stream of one family.
///
/// A stroke's numbers begin at a place of its own ([`Draw::seek`]); its candidates follow, each taking the same count, so
/// that a candidate's numbers do not depend on how many candidates there are.
#[derive(Debug, Clone)]
pub struct Draw {
    stream: ChaCha8Rng,
}

impl Draw {
    /// The stream of a family, keyed by its name, so that adding a family changes no other.
    pub fn new(seed: u64, family: &str) -> Self {
        let mut stream = ChaCha8Rng::seed_from_u64(seed);
        // FNV-1a.
        let key = family
            .bytes()
            .fold(0xcbf2_9ce4_8422_2325_u64, |hash, byte| (hash ^ u64::from(byte)).wrapping_mul(0x0000_0100_0000_01b3));
        stream.set_stream(key);
        Self { stream }
    }

    /// Goes to the numbers of a stroke; `u32::MAX` is the family as a whole.
    pub fn seek(&mut self, index: u32) {
        self.stream.set_word_pos(u128::from(index) << WORDS_PER_STROKE_LOG2);
    }

    /// The next number, `0.0 .. 1.0`, in steps of 2⁻³².
    #[inline]
    pub fn unit(&mut self) -> f64 {
        f64::from(self.stream.next_u32()) / (f64::from(u32::MAX) + 1.0)
    }

    /// The next number, `-1.0 .. 1.0`.
    #[inline]
    pub fn signed(&mut self) -> f64 {
        2.0 * self.unit() - 1.0
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_strokes_numbers_do_not_depend_on_what_was_drawn_before() {
        let mut draw = Draw::new(7, "h");
        draw.seek(5);
        let first: Vec<f64> = (0..20).map(|_| draw.unit()).collect();
        draw.seek(0);
        draw.unit();
        draw.seek(5);
        assert_eq!(first, (0..20).map(|_| draw.unit()).collect::<Vec<_>>());
    }

    #[test]
    fn families_and_seeds_have_streams_of_their_own() {
        let first = |seed, family| Draw::new(seed, family).unit();
        assert_ne!(first(1, "h"), first(1, "v"));
        assert_ne!(first(1, "h"), first(2, "h"));
    }
}
