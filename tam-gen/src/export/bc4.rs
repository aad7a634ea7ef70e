//! BC4: half a byte per texel, at the price of exact nesting.

use rayon::prelude::*;

use crate::map::Grid;

/// A grid as BC4 blocks, with what the compression cost.
#[derive(Debug)]
pub(super) struct Compressed {
    /// For each level, finest first, the blocks of all columns, one column after the other.
    pub(super) levels: Vec<Vec<u8>>,
    /// Texels that became lighter than in the column before, over all cells.
    pub(super) violations: u64,
    /// The worst of them, in 255ths of full ink.
    pub(super) worst: u8,
    /// All texels that were compared.
    pub(super) compared: u64,
}

/// Compresses the luminance of a grid; levels under 4 px fill one block by repeating their edge.
pub(super) fn compress(grid: &Grid) -> Compressed {
    let mut compressed = Compressed { levels: Vec::new(), violations: 0, worst: 0, compared: 0 };
    for level in &grid.levels {
        let size = level.size as usize;
        let columns: Vec<Vec<u8>> = level.cells.par_iter().map(|ink| encode(ink, size)).collect();
        let decoded: Vec<Vec<u8>> = columns.par_iter().map(|blocks| decode(blocks, size, size)).collect();
        for (lighter, darker) in decoded.iter().zip(decoded.iter().skip(1)) {
            for (&lighter, &darker) in lighter.iter().zip(darker) {
                let excess = darker.saturating_sub(lighter);
                compressed.violations += u64::from(excess > 0);
                compressed.worst = compressed.worst.max(excess);
            }
            compressed.compared += (size * size) as u64;
        }
        compressed.levels.push(columns.concat());
    }
    compressed
}

/// The blocks of one cell of ink, as luminance.
fn encode(ink: &[u8], size: usize) -> Vec<u8> {
    let across = size.div_ceil(4);
    (0..across * across)
        .flat_map(|index| {
            let (x0, y0) = (index % across * 4, index / across * 4);
            encode_block(std::array::from_fn(|i| {
                let (x, y) = ((x0 + i % 4).min(size - 1), (y0 + i / 4).min(size - 1));
                255 - ink[y * size + x]
            }))
        })
        .collect()
}

/// The better of the two codebooks of BC4: eight shades between the extremes, or six between those of the texels that
/// are neither 0 nor 255, and these two besides. Hatching is mostly 0 and 255, so the second wins nearly always.
///
/// The encoder of `texpresso` 2.0 fits the first codebook with the ends of the second and misses by up to 30/255.
fn encode_block(texels: [u8; 16]) -> [u8; 8] {
    let extremes = |of: &mut dyn Iterator<Item = u8>| of.fold((255, 0), |(low, high), t| (t.min(low), t.max(high)));
    let (low, high) = extremes(&mut texels.into_iter());
    let (inner_low, inner_high) = extremes(&mut texels.into_iter().filter(|&texel| texel != 0 && texel != 255));
    let six = if inner_low <= inner_high { (inner_low, inner_high) } else { (0, 255) };
    let eight = fit(&texels, high, low);
    let six = fit(&texels, six.0, six.1);
    if eight.0 < six.0 { eight.1 } else { six.1 }
}

/// Summed squared error and block for given ends; the order of the ends chooses the codebook.
fn fit(texels: &[u8; 16], end0: u8, end1: u8) -> (u32, [u8; 8]) {
    let (a, b) = (u32::from(end0), u32::from(end1));
    let codes: [u32; 8] = std::array::from_fn(|code| match code as u32 {
        0 => a,
        1 => b,
        i if a > b => ((8 - i) * a + (i - 1) * b) / 7,
        6 => 0,
        7 => 255,
        i => ((6 - i) * a + (i - 1) * b) / 5,
    });
    let (mut error, mut bits) = (0, 0_u64);
    for (i, &texel) in texels.iter().enumerate() {
        let squared = |code: usize| codes[code].abs_diff(u32::from(texel)).pow(2);
        let best = (0..8).min_by_key(|&code| squared(code)).unwrap_or(0);
        error += squared(best);
        bits |= (best as u64) << (3 * i);
    }
    let mut block = (bits << 16).to_le_bytes();
    block[..2].copy_from_slice(&[end0, end1]);
    (error, block)
}

/// The texels of BC4 blocks by rows: `width * height` bytes.
///
/// `blocks` must hold 8 bytes for each block begun, `width.div_ceil(4) * height.div_ceil(4)` of them.
pub(crate) fn decode(blocks: &[u8], width: usize, height: usize) -> Vec<u8> {
    let across = width.div_ceil(4);
    let mut texels = vec![0; width * height];
    for (index, block) in blocks.chunks_exact(8).enumerate() {
        let (x0, y0) = (index % across * 4, index / across * 4);
        let decoded = texpresso::Format::Bc4.decompress_block(block);
        for (i, texel) in decoded.iter().enumerate() {
            let (x, y) = (x0 + i % 4, y0 + i / 4);
            if x < width && y < height {
                texels[y * width + x] = texel[0];
            }
        }
    }
    texels
}
