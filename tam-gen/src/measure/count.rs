//! Counting texels, whole registers at a time.

/// The number of pairs of texels of two images of equal size for which something holds.
pub(super) fn count_pairs(a: &[u8], b: &[u8], holds: impl Fn(u8, u8) -> bool) -> usize {
    // As many at a time as a byte counts, so that the compiler keeps sixteen counts side by side.
    let in_byte = |(a, b): (&[u8], &[u8])| a.iter().zip(b).map(|(a, b)| u8::from(holds(*a, *b))).sum::<u8>();
    a.chunks(255).zip(b.chunks(255)).map(|some| usize::from(in_byte(some))).sum()
}

/// The number of texels for which something holds.
pub(super) fn count(texels: &[u8], holds: impl Fn(u8) -> bool) -> usize {
    let in_byte = |some: &[u8]| some.iter().map(|texel| u8::from(holds(*texel))).sum::<u8>();
    texels.chunks(255).map(|some| usize::from(in_byte(some))).sum()
}

/// How many texels have each value.
pub(super) fn histogram(texels: &[u8]) -> [usize; 256] {
    // Four counts by turns: one would wait for itself where neighbours are alike, and most are.
    let mut counts = [[0_u32; 256]; 4];
    let (fours, rest) = texels.as_chunks::<4>();
    for four in fours {
        for (counts, texel) in counts.iter_mut().zip(four) {
            counts[usize::from(*texel)] += 1;
        }
    }
    for texel in rest {
        counts[0][usize::from(*texel)] += 1;
    }
    std::array::from_fn(|value| counts.iter().map(|counts| counts[value] as usize).sum())
}
