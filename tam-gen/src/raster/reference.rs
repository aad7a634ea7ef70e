//! tiny-skia draws the same strokes as filled outlines: the independent reference for coverage.

use tiny_skia::{FillRule, Mask, Path, PathBuilder, Transform};

use super::{Footprint, Grain, Nib, over};
use crate::map::Family;
use crate::preset::StrokeOptions;
use crate::sequence::Draw;
use crate::stroke::{Axis, Stroke};

const SIZE: u32 = 128;

fn nib(stroke: StrokeOptions) -> Nib {
    Nib::new(&Family { name: "h".into(), angle_deg: 0.0, stroke }).expect("a valid tip or none")
}

/// The outline of a stroke in texels: its two edges, offset across the scan axis.
fn outline(nib: &Nib, stroke: &Stroke) -> Option<Path> {
    const PARTS: u16 = 400;
    let side = SIZE as f32;
    let point = |t: f32, sign: f32| {
        let slope = stroke.slope_at(t);
        let half = 0.5 * stroke.width_px * nib.taper.pressure(t) * (1.0 + slope * slope).sqrt();
        let along = (stroke.start_uv + t * stroke.along_uv) * side;
        let across = stroke.across_at(t) * side + sign * half;
        if stroke.axis == Axis::X { (along, across) } else { (across, along) }
    };
    let mut path = PathBuilder::new();
    for (i, (part, sign)) in (0..=PARTS).map(|p| (p, 1.0)).chain((0..=PARTS).rev().map(|p| (p, -1.0))).enumerate() {
        let (x, y) = point(f32::from(part) / f32::from(PARTS), sign);
        if i == 0 { path.move_to(x, y) } else { path.line_to(x, y) }
    }
    path.close();
    path.finish()
}

/// Coverage by tiny-skia at eight times the resolution, averaged: its own anti-aliasing has only 16 steps.
fn reference(path: &Path) -> Vec<f32> {
    const FINER: u32 = 8;
    let mut mask = Mask::new(SIZE * FINER, SIZE * FINER).expect("a valid size");
    mask.fill_path(path, FillRule::Winding, true, Transform::from_scale(FINER as f32, FINER as f32));
    let mut coverage = vec![0.0; (SIZE * SIZE) as usize];
    for (i, above) in mask.data().iter().enumerate() {
        let (x, y) = (i as u32 % (SIZE * FINER) / FINER, i as u32 / (SIZE * FINER) / FINER);
        coverage[(y * SIZE + x) as usize] += f32::from(*above) / (255.0 * (FINER * FINER) as f32);
    }
    coverage
}

fn own(nib: &Nib, stroke: &Stroke) -> Vec<f32> {
    let mut footprint = Footprint::default();
    nib.footprint(stroke, SIZE, &Grain::default(), &mut footprint);
    let mut ink = vec![0_u8; (SIZE * SIZE) as usize];
    for (texel, above) in footprint.iter() {
        ink[texel] = over(ink[texel], above);
    }
    ink.iter().map(|ink| f32::from(*ink) / 255.0).collect()
}

/// A stroke well inside the tile, of any character.
fn stroke_inside(draw: &mut Draw) -> Stroke {
    let mut at = |low: f64, high: f64| (low + (high - low) * draw.unit()) as f32;
    let along_uv = at(0.1, 0.5);
    Stroke {
        family: 0,
        axis: if at(0.0, 1.0) < 0.5 { Axis::X } else { Axis::Y },
        start_uv: at(0.2, 0.3),
        along_uv,
        across_uv: [at(0.4, 0.6), at(-0.9, 0.9) * along_uv * 0.4, at(-0.1, 0.1) * along_uv, at(-0.1, 0.1) * along_uv],
        width_px: at(0.5, 6.0),
    }
}

/// Worst difference of a texel and of a stroke's ink over many strokes with the given tapers.
fn worst_differences(taper_in: f64, taper_out: f64) -> (f32, f32) {
    let nib = nib(StrokeOptions { taper_in, taper_out, ..StrokeOptions::default() });
    let mut draw = Draw::new(11, "reference");
    let (mut worst_texel, mut worst_ink) = (0.0_f32, 0.0_f32);
    for index in 0..150 {
        draw.seek(index);
        let stroke = stroke_inside(&mut draw);
        let (ours, theirs) = (own(&nib, &stroke), reference(&outline(&nib, &stroke).expect("an outline")));
        for (ours, theirs) in ours.iter().zip(&theirs) {
            worst_texel = worst_texel.max((ours - theirs).abs());
        }
        let (ours, theirs): (f32, f32) = (ours.iter().sum(), theirs.iter().sum());
        worst_ink = worst_ink.max((ours / theirs - 1.0).abs());
    }
    (worst_texel, worst_ink)
}

#[test]
fn coverage_of_a_stroke_agrees_with_tiny_skia() {
    let (texel, ink) = worst_differences(0.0, 0.0);
    // The slope is taken once per scan column and the reference is made of 64 samples: a twentieth of a texel.
    assert!(texel < 0.05, "a texel differs by {texel}");
    assert!(ink < 0.004, "a stroke's ink differs by {ink}");
}

#[test]
fn coverage_of_a_tapered_stroke_agrees_with_tiny_skia() {
    let (texel, ink) = worst_differences(0.3, 0.4);
    // The width is taken once per scan column, and at a tip it changes by up to three texels within one.
    assert!(texel < 0.16, "a texel differs by {texel}");
    assert!(ink < 0.01, "a stroke's ink differs by {ink}");
}

#[test]
fn dots_agree_with_tiny_skia() {
    let nib = nib(StrokeOptions::default());
    let mut draw = Draw::new(5, "dots");
    for _ in 0..100 {
        let mut at = |low: f64, high: f64| (low + (high - low) * draw.unit()) as f32;
        let dot = Stroke {
            family: 0,
            axis: Axis::X,
            start_uv: at(0.3, 0.6),
            along_uv: 0.0,
            across_uv: [at(0.3, 0.6), 0.0, 0.0, 0.0],
            width_px: at(1.0, 8.0),
        };
        let side = SIZE as f32;
        let circle = PathBuilder::from_circle(dot.start_uv * side, dot.across_uv[0] * side, 0.5 * dot.width_px);
        let (ours, theirs) = (own(&nib, &dot), reference(&circle.expect("a circle")));
        let diameter = dot.width_px;
        for (ours, theirs) in ours.iter().zip(&theirs) {
            // A sliver of the disc can lie before the middle of the first sub-column.
            assert!((ours - theirs).abs() < 0.1, "{ours} against {theirs} at {diameter} px");
        }
        let (ours, theirs): (f32, f32) = (ours.iter().sum(), theirs.iter().sum());
        assert!((ours / theirs - 1.0).abs() < 0.05, "{ours} against {theirs} at {diameter} px");
    }
}

#[test]
fn a_stroke_across_the_edge_is_the_same_stroke_rolled() {
    let nib = nib(StrokeOptions { taper_in: 0.2, ..StrokeOptions::default() });
    let mut draw = Draw::new(2, "roll");
    for index in 0..50 {
        draw.seek(index);
        let inside = stroke_inside(&mut draw);
        // Half a tile along and a quarter across: whole texels, so coverage must be the same to the byte.
        let mut rolled = inside;
        rolled.start_uv = (inside.start_uv + 0.5).fract();
        rolled.across_uv[0] = inside.across_uv[0] + 0.5;
        let (a, b) = (own(&nib, &inside), own(&nib, &rolled));
        for y in 0..SIZE {
            for x in 0..SIZE {
                let (from, to) = (y * SIZE + x, (y + SIZE / 2) % SIZE * SIZE + (x + SIZE / 2) % SIZE);
                assert!((a[from as usize] - b[to as usize]).abs() <= 1.5 / 255.0);
            }
        }
    }
}

#[test]
fn a_square_tip_stamped_densely_is_a_plain_line() {
    let options = |tip| StrokeOptions { width_px: 5.0, tip, ..StrokeOptions::default() };
    let square = crate::preset::TipOptions { path: Some("M0 0H4V4H0Z".into()), spacing: 0.05, ..Default::default() };
    let plain = nib(options(None));
    let stamped = nib(options(Some(square)));
    let stroke = Stroke {
        family: 0,
        axis: Axis::X,
        start_uv: 0.3,
        along_uv: 0.4,
        across_uv: [0.5, 0.1, 0.0, 0.0],
        width_px: 5.0,
    };
    let ink = |nib: &Nib| own(nib, &stroke).iter().sum::<f32>();
    // The tip reaches half its length beyond both ends.
    let longer = (0.4 * SIZE as f32 + 5.0) / (0.4 * SIZE as f32);
    let ratio = ink(&stamped) / ink(&plain) / longer;
    assert!((0.93..1.07).contains(&ratio), "{ratio}");
}
