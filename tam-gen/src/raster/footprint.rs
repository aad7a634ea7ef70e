//! The texels of one stroke.

/// The texels that one stroke inks at one level, with the ink it would leave there on empty paper.
///
/// Texels come in order along the stroke. Buffers are kept between strokes.
#[derive(Debug, Clone, Default)]
pub struct Footprint {
    /// Index of each texel in its level (row · size + column).
    pub texel: Vec<u32>,
    /// Ink there, `0 ..= 255`.
    pub ink: Vec<u8>,
}

impl Footprint {
    /// Forgets the texels and keeps the memory.
    pub fn clear(&mut self) {
        self.texel.clear();
        self.ink.clear();
    }

    /// Number of texels.
    pub fn len(&self) -> usize {
        self.texel.len()
    }

    /// Whether the stroke inks nothing at this level.
    pub fn is_empty(&self) -> bool {
        self.texel.is_empty()
    }

    /// The texels and their ink.
    pub fn iter(&self) -> impl Iterator<Item = (usize, u8)> + '_ {
        self.texel.iter().zip(&self.ink).map(|(&texel, &ink)| (texel as usize, ink))
    }

    /// Adds the first `lanes` texels of a column's next rows. All `N` are copied, which is cheaper than a copy of just as
    /// many as are wanted.
    #[inline]
    pub(super) fn extend<const N: usize>(&mut self, texel: &[u32; N], ink: &[u8; N], lanes: usize) {
        let end = self.texel.len() + lanes;
        self.texel.extend_from_slice(texel);
        self.ink.extend_from_slice(ink);
        self.texel.truncate(end);
        self.ink.truncate(end);
    }

    #[inline]
    pub(super) fn push(&mut self, texel: u32, ink: u8) {
        self.texel.push(texel);
        self.ink.push(ink);
    }
}
