//! BC4: half a byte per texel, with nesting kept.
//!
//! A BC4 block holds two ends and an index of 3 bits per texel, into eight shades between the ends, or into six and 0
//! and 255 besides. An encoder that looks at one image at a time breaks nesting by tens of 255ths. Here a block is
//! encoded for all columns together, lightest first, and no texel may become lighter than the column before left it.
//! The second codebook holds 0, so that can always be had.

use rayon::prelude::*;

use crate::map::{Grid, Level};

/// A grid as BC4 blocks, with what the compression cost.
#[derive(Debug)]
pub(super) struct Compressed {
    /// For each level, finest first, the blocks of all columns, one column after the other.
    pub(super) levels: Vec<Vec<u8>>,
    /// Texels that are lighter than in the column before when decoded.
    pub(super) violations: u64,
    /// The largest change of a cell's mean luminance.
    pub(super) tone_error: f64,
}

/// Compresses the luminance of a grid; levels under 4 px fill one block by repeating their edge.
pub(super) fn compress(grid: &Grid) -> Compressed {
    let mut compressed = Compressed { levels: Vec::new(), violations: 0, tone_error: 0.0 };
    for level in &grid.levels {
        let columns = encode(level);
        let size = level.size as usize;
        let decoded: Vec<Vec<u8>> = columns.par_iter().map(|blocks| decode(blocks, size, size)).collect();
        for (lighter, darker) in decoded.iter().zip(decoded.iter().skip(1)) {
            compressed.violations +=
                lighter.iter().zip(darker).filter(|(lighter, darker)| darker > lighter).count() as u64;
        }
        for (luminance, ink) in decoded.iter().zip(&level.cells) {
            let sum = |texels: &[u8]| texels.iter().map(|&x| u64::from(x)).sum::<u64>();
            let full = 255 * ink.len() as u64;
            let error = (full - sum(ink)).abs_diff(sum(luminance)) as f64 / full as f64;
            compressed.tone_error = compressed.tone_error.max(error);
        }
        compressed.levels.push(columns.concat());
    }
    compressed
}

/// The blocks of every column of a level.
fn encode(level: &Level) -> Vec<Vec<u8>> {
    let size = level.size as usize;
    let across = size.div_ceil(4);
    let blocks: Vec<Vec<[u8; 8]>> = (0..across * across)
        .into_par_iter()
        .map(|index| {
            let (x0, y0) = (index % across * 4, index / across * 4);
            let mut before = Block::paper();
            let encode = |ink: &Vec<u8>| {
                let texels = std::array::from_fn(|i| {
                    let (x, y) = ((x0 + i % 4).min(size - 1), (y0 + i / 4).min(size - 1));
                    255 - ink[y * size + x]
                });
                before = encode_block(&texels, &before);
                before.bytes
            };
            level.cells.iter().map(encode).collect()
        })
        .collect();
    (0..level.cells.len()).map(|column| blocks.iter().flat_map(|columns| columns[column]).collect()).collect()
}

/// One block, and what it decodes to.
#[derive(Clone, Copy)]
struct Block {
    cost: u32,
    bytes: [u8; 8],
    decoded: [u8; 16],
}

impl Block {
    /// What lies below the lightest column.
    fn paper() -> Self {
        Self { cost: 0, bytes: [255, 255, 0, 0, 0, 0, 0, 0], decoded: [255; 16] }
    }
}

/// The best of a few pairs of ends; no texel decodes lighter than in the block before.
fn encode_block(texels: &[u8; 16], before: &Block) -> Block {
    let limits = &before.decoded;
    let targets: [u8; 16] = std::array::from_fn(|i| texels[i].min(limits[i]));
    let extremes = |of: &mut dyn Iterator<Item = u8>| of.fold((255, 0), |(low, high), x| (x.min(low), x.max(high)));
    let (low, high) = extremes(&mut targets.into_iter());
    let (inner_low, inner_high) = extremes(&mut targets.into_iter().filter(|&x| x != 0 && x != 255));
    let (inner_low, inner_high) = if inner_low <= inner_high { (inner_low, inner_high) } else { (0, 255) };
    let [end0, end1, ..] = before.bytes;
    // Ends that are kept keep the texels that do not change; others would round them down once more.
    let candidates = [
        (inner_low, inner_high),
        (high, low),
        (end0, end1),
        (inner_low.min(end1), end1),
        (end0.min(inner_high), inner_high),
        (inner_low, inner_high.max(end1)),
        (inner_low, 255),
    ];
    let fits = candidates.into_iter().filter_map(|(end0, end1)| fit(texels, limits, end0, end1));
    // The first always fits: it holds 0.
    fits.min_by_key(|block| block.cost).unwrap_or(*before)
}

/// The best indices for given ends, whose order chooses the codebook; `None` where a texel has no code at or below its
/// limit. A block is judged by the squared errors of its texels and of its sum, lest tones drift.
fn fit(texels: &[u8; 16], limits: &[u8; 16], end0: u8, end1: u8) -> Option<Block> {
    let (a, b) = (u32::from(end0), u32::from(end1));
    let codes: [u8; 8] = std::array::from_fn(|code| {
        let code = match code as u32 {
            0 => a,
            1 => b,
            i if a > b => ((8 - i) * a + (i - 1) * b) / 7,
            6 => 0,
            7 => 255,
            i => ((6 - i) * a + (i - 1) * b) / 5,
        };
        code as u8
    });
    let mut block = Block { cost: 0, bytes: [0; 8], decoded: [0; 16] };
    let (mut bits, mut drift) = (0_u64, 0_i32);
    for (i, (&texel, &limit)) in texels.iter().zip(limits).enumerate() {
        let allowed = (0..8).filter(|&code| codes[code] <= limit);
        let best = allowed.min_by_key(|&code| codes[code].abs_diff(texel))?;
        block.cost += u32::from(codes[best].abs_diff(texel)).pow(2);
        drift += i32::from(codes[best]) - i32::from(texel);
        block.decoded[i] = codes[best];
        bits |= (best as u64) << (3 * i);
    }
    block.cost += drift.unsigned_abs().pow(2);
    block.bytes = (bits << 16).to_le_bytes();
    block.bytes[..2].copy_from_slice(&[end0, end1]);
    Some(block)
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

#[cfg(test)]
mod tests {
    use super::*;

    /// Columns of noise, each lighter than the one before by an amount of noise: the worst that a block can meet.
    #[test]
    fn nesting_survives_compression_whatever_the_texels() {
        let mut state = 1_u32;
        let mut random = || {
            state = state.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
            (state >> 24) as u8
        };
        let size = 64;
        let mut cells: Vec<Vec<u8>> = vec![vec![0; size * size]];
        for _ in 0..8 {
            let last = cells[cells.len() - 1].clone();
            cells.push(
                last.iter().map(|&ink| if random() < 160 { ink } else { ink.saturating_add(random() / 3) }).collect(),
            );
        }
        let tones = vec![0.5; cells.len()];
        let grid = Grid { tones, levels: vec![Level { size: size as u32, cells }], hand_built: 1 };
        let compressed = compress(&grid);
        assert_eq!(compressed.violations, 0);
        assert!(compressed.tone_error < 0.03, "noise of this kind costs 0.02: {}", compressed.tone_error);
    }

    #[test]
    fn blocks_decode_as_the_encoder_expects() {
        for (low, high) in [(0, 255), (10, 90), (90, 10), (7, 7), (255, 0)] {
            let texels = std::array::from_fn(|i| (i * 17) as u8);
            let block = fit(&texels, &[255; 16], low, high).expect("without limits every texel has a code");
            assert_eq!(decode(&block.bytes, 4, 4), block.decoded);
        }
    }
}
