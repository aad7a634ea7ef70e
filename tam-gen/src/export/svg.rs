//! The strokes as vector paths, for plotters, laser cutters and illustration programs.

use std::fmt::Write;

use crate::map::{Map, StrokeList};
use crate::stroke::{Axis, Stroke, Taper};

/// The finest level of the darkest column as SVG, one unit per texel.
///
/// Each family is a group, and in it each column is a group of the strokes that appear in it first, so hiding the last
/// groups shows the lighter tones. The strokes that the darkest column draws in part come last. The path of an even stroke
/// is its centre line, exactly (a cubic in uv is a cubic Bézier curve), with the stroke's width; a tapering stroke is its
/// outline, filled, as wide as its pressure, lightening ends included. Grain and tips are properties of texels and are not
/// drawn. `paper` and `ink` are colours that SVG understands.
pub fn strokes_svg(map: &Map, paper: &str, ink: &str) -> String {
    let (grid, strokes) = (&map.grid, &map.strokes);
    let size = grid.levels.first().map_or(0, |level| level.size);
    let columns = grid.columns();
    let mut svg = format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{size}\" height=\"{size}\" viewBox=\"0 0 {size} {size}\">\n\
         <clipPath id=\"tile\"><rect width=\"{size}\" height=\"{size}\"/></clipPath>\n\
         <rect width=\"{size}\" height=\"{size}\" fill=\"{paper}\"/>\n\
         <g clip-path=\"url(#tile)\" fill=\"none\" stroke=\"{ink}\" stroke-linecap=\"butt\">\n"
    );
    let Some(first_column) = strokes.first_column.first() else { return svg + "</g>\n</svg>\n" };
    let closing = strokes.closing.first().and_then(|columns| columns.last()).map_or(&[][..], Vec::as_slice);

    for (family, options) in strokes.families.iter().enumerate() {
        let opacity = options.stroke.opacity as f32;
        let pen = Pen { taper: options.taper(), opacity, size, ink };
        let id = escaped(&options.name);
        let opacity = number(opacity);
        let _ = writeln!(svg, "<g id=\"{id}\" stroke-opacity=\"{opacity}\" fill-opacity=\"{opacity}\">");
        let of_family = |stroke: &Stroke| usize::from(stroke.family) == family;
        for column in 0..columns {
            let appear = strokes.strokes.iter().zip(first_column).filter(|(stroke, first)| {
                **first != StrokeList::NEVER && usize::from(**first) == column && of_family(stroke)
            });
            let paths: String = appear.map(|(stroke, _)| pen.copies(stroke, 1.0)).collect();
            group(&mut svg, &format!("{}-tone{column}", escaped(&options.name)), &paths);
        }
        let parts = closing.iter().filter_map(|part| Some((strokes.strokes.get(part.stroke as usize)?, part.fraction)));
        let paths: String = parts
            .filter(|(stroke, _)| of_family(stroke))
            .map(|(stroke, fraction)| pen.copies(stroke, fraction))
            .collect();
        group(&mut svg, &format!("{}-closing", escaped(&options.name)), &paths);
        svg += "</g>\n";
    }
    svg + "</g>\n</svg>\n"
}

fn group(svg: &mut String, id: &str, paths: &str) {
    if !paths.is_empty() {
        let _ = write!(svg, "<g id=\"{id}\">\n{paths}</g>\n");
    }
}

/// What the strokes of a family share.
struct Pen<'a> {
    taper: Taper,
    opacity: f32,
    size: u32,
    ink: &'a str,
}

impl Pen<'_> {
    /// The first `fraction` of a stroke, and its copies that reach into the tile across its edges.
    fn copies(&self, stroke: &Stroke, fraction: f32) -> String {
        let side = self.size as f32;
        let points = bezier_points(stroke, fraction).map(|[x, y]| [x * side, y * side]);
        let half_width = stroke.width_px / 2.0;
        // The control points' hull holds the curve.
        let shifts = |axis: usize| {
            let low = points.iter().map(|point| point[axis]).fold(f32::INFINITY, f32::min) - half_width;
            let high = points.iter().map(|point| point[axis]).fold(f32::NEG_INFINITY, f32::max) + half_width;
            let tiles = |offset: f32| (offset / side).clamp(-64.0, 64.0);
            let (first, last) = (tiles(-high).floor() as i32 + 1, tiles(side - low).ceil() as i32 - 1);
            (first..=last).map(|tile| tile as f32 * side)
        };
        let tapers = self.taper != Taper::NONE;
        let outline = if tapers { self.outline(stroke, fraction) } else { Vec::new() };
        let mut svg = String::new();
        for (dx, dy) in shifts(0).flat_map(|dx| shifts(1).map(move |dy| (dx, dy))) {
            let shifted = |[x, y]: [f32; 2]| format!("{} {}", number(x + dx), number(y + dy));
            let ink = self.ink;
            let _ = if stroke.along_uv == 0.0 {
                let (x, y) = (number(points[0][0] + dx), number(points[0][1] + dy));
                let (radius, opacity) = (number(half_width), number(self.opacity * fraction));
                writeln!(
                    svg,
                    "<circle cx=\"{x}\" cy=\"{y}\" r=\"{radius}\" fill=\"{ink}\" fill-opacity=\"{opacity}\" stroke=\"none\"/>"
                )
            } else if tapers {
                let path: Vec<String> = outline.iter().map(|point| shifted(*point)).collect();
                writeln!(svg, "<path d=\"M{}Z\" fill=\"{ink}\" stroke=\"none\"/>", path.join("L"))
            } else {
                let [a, b, c, d] = points.map(shifted);
                writeln!(svg, "<path d=\"M{a}C{b} {c} {d}\" stroke-width=\"{}\"/>", number(stroke.width_px))
            };
        }
        svg
    }

    /// The outline of the first `fraction` of a stroke in texels: along one side and back along the other.
    fn outline(&self, stroke: &Stroke, fraction: f32) -> Vec<[f32; 2]> {
        const PARTS: u8 = 16;
        let side = self.size as f32;
        let point = |part: u8, sign: f32| {
            let t = fraction * f32::from(part) / f32::from(PARTS);
            let slope = stroke.slope_at(t);
            let half = sign * 0.5 * stroke.width_px * self.taper.pressure(t) / (1.0 + slope * slope).sqrt();
            // Half the width to the side of the curve, whose direction is (1, slope).
            let (along, across) =
                ((stroke.start_uv + t * stroke.along_uv) * side - half * slope, stroke.across_at(t) * side + half);
            if stroke.axis == Axis::X { [along, across] } else { [across, along] }
        };
        (0..=PARTS).map(|part| point(part, 1.0)).chain((0..=PARTS).rev().map(|part| point(part, -1.0))).collect()
    }
}

/// Control points in uv, not wrapped, of the part `0 ..= fraction` of a stroke.
fn bezier_points(stroke: &Stroke, fraction: f32) -> [[f32; 2]; 4] {
    let bezier_from_power = |c: [f32; 4]| {
        let (c1, c2, c3) = (c[1] * fraction, c[2] * fraction * fraction, c[3] * fraction * fraction * fraction);
        [c[0], c[0] + c1 / 3.0, c[0] + (2.0 * c1 + c2) / 3.0, c[0] + c1 + c2 + c3]
    };
    let along = bezier_from_power([stroke.start_uv, stroke.along_uv, 0.0, 0.0]);
    let across = bezier_from_power(stroke.across_uv);
    std::array::from_fn(|i| match stroke.axis {
        Axis::X => [along[i], across[i]],
        Axis::Y => [across[i], along[i]],
    })
}

/// A number with three decimals at most.
fn number(x: f32) -> String {
    let text = format!("{x:.3}");
    let short = text.trim_end_matches('0').trim_end_matches('.');
    if short == "-0" { "0".into() } else { short.into() }
}

fn escaped(text: &str) -> String {
    text.chars().map(|c| if c.is_alphanumeric() || c == '_' || c == '-' { c } else { '_' }).collect()
}
