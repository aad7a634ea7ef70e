//! Maps with coarse levels, dense tones and wide strokes: what the placement of Praun and others (2001, section 4) makes of
//! them, and the progressive one.

use image::{Rgb, RgbImage, imageops};
use tam_gen::preset::{PlacementMethod, Tones};
use tam_gen::{Job, Map, Preset, generate};

use super::case::{Case, Hardened, Limit, Literal, Side, StabilityError};
use super::stand::{SHOWN, both, preset, side_by_side};
use crate::params::Form;

const TONE: &str = "greatest error of tone at the coarsest level";
const WHOLE_STROKES: &str = "Whole strokes are added until the tone is reached. At 8 px one stroke is more than a tone: the \
                             last one overshoots.";

pub(super) const CASES: [Case; 3] = [
    Case {
        name: "coarsest level of 8 px",
        method: "placement: praun",
        failure: WHOLE_STROKES,
        figure: TONE,
        literal: Literal::Fails(Limit::Above(0.01)),
        hardened: Hardened::Holds,
        holds: Limit::Below(5e-4),
        reason: "A level of 64 texels in 255 steps of ink is known to 6·10⁻⁵; the generator promises 5·10⁻⁴ there.",
        run: |_| placed(|_| (), |map| worst(map).1),
    },
    Case {
        name: "tones too dense for the coarsest level",
        method: "placement: praun",
        failure: "A stroke is worth several tones: columns that should differ are the same at the coarsest level.",
        figure: "greatest error of tone at the coarsest level, over the step between two tones",
        literal: Literal::Fails(Limit::Above(1.0)),
        hardened: Hardened::Holds,
        holds: Limit::Below(0.5),
        reason: "At 1 a column has the tone of the next one; below ½ it is nearer to its own than to any other. Of 64 tones \
                 each is worth one texel of this level; what is missed of it is reported as a deficit of the map.",
        run: |_| placed(|preset| preset.map.tones = Tones::Count(64), |map| worst(map).1 * 64.0),
    },
    Case {
        name: "strokes nearly as wide as the coarsest level",
        method: "placement: praun",
        failure: "One stroke fills most of the level.",
        figure: TONE,
        literal: Literal::Fails(Limit::Above(0.1)),
        hardened: Hardened::Holds,
        holds: Limit::Below(5e-4),
        reason: "Strokes wider than the level are refused when the preset is read; these are 6 of 8 px.",
        run: |_| {
            let wide = |preset: &mut Preset| {
                preset.stroke.width_px = 6.0;
                preset.stroke.width_jitter = 0.0;
            };
            placed(wide, |map| worst(map).1)
        },
    },
];

/// Maps of a fine pen down to 8 px, by Praun's search and progressive, with their figure and the coarsest level.
fn placed(change: impl Fn(&mut Preset), figure: impl Fn(&Map) -> f64) -> Result<[Side; 2], StabilityError> {
    both(|form| {
        let mut preset = preset("fine-pen")?;
        preset.map.size = 64;
        preset.map.coarsest = 8;
        if form == Form::Literal {
            preset.placement.method = PlacementMethod::Praun;
            preset.placement.candidates_first = 50;
            preset.placement.candidates_last = 10;
        }
        change(&mut preset);
        let map = generate(&preset, &Job::default())?;
        Ok(Side { figure: figure(&map), picture: pictured(&map) })
    })
}

/// The column of the coarsest level that is furthest from its tone, and how far.
fn worst(map: &Map) -> (usize, f64) {
    let Some(level) = map.grid.drawn().last() else { return (0, f64::NAN) };
    let error = |(cell, tone): (&Vec<u8>, &f64)| {
        let ink: u32 = cell.iter().map(|texel| u32::from(*texel)).sum();
        (f64::from(ink) / (255.0 * cell.len() as f64) - tone).abs()
    };
    let errors = level.cells.iter().zip(&map.grid.tones).map(error).enumerate();
    errors.fold((0, 0.0), |worst, next| if next.1 > worst.1 || next.1.is_nan() { next } else { worst })
}

/// The finest and the coarsest level at the second and at the middle column.
fn pictured(map: &Map) -> RgbImage {
    let columns = map.grid.columns();
    let frames = [columns / 6, columns / 2].map(|column| {
        let mut frame = RgbImage::from_pixel(SHOWN, SHOWN, Rgb([255; 3]));
        for (level, top) in map.grid.drawn().first().into_iter().chain(map.grid.drawn().last()).zip([0, SHOWN / 2]) {
            let cell = RgbImage::from_fn(level.size, level.size, |x, y| {
                Rgb([255 - level.cells[column][(y * level.size + x) as usize]; 3])
            });
            let half = imageops::resize(&cell, SHOWN / 2, SHOWN / 2, imageops::FilterType::Nearest);
            imageops::replace(&mut frame, &half, 0, i64::from(top));
            imageops::replace(&mut frame, &half, i64::from(SHOWN / 2), i64::from(top));
        }
        frame
    });
    side_by_side(&frames)
}
