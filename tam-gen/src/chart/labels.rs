//! Places for the labels of points, beside each other and beside the points.

use std::f64::consts::TAU;

/// A label and the point that it names, in pixels from the top left.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Label {
    /// Middle of the point.
    pub point: [f64; 2],
    /// Width and height of the text.
    pub size: [f64; 2],
}

/// Directions that are tried around a point, the one to the upper right first.
const DIRECTIONS: usize = 16;
/// Distances that are tried, in steps from the nearest.
const RINGS: usize = 14;
/// From the point's middle to the nearest label.
const NEAREST_PX: f64 = 9.0;
/// Between two distances.
const STEP_PX: f64 = 9.0;
/// Between texts.
const GAP_PX: f64 = 3.0;
/// Radius kept free around points.
const POINT_PX: f64 = 6.0;
/// Between samples of a line that labels keep away from.
const LINE_STEP_PX: f64 = 8.0;
/// Between samples of lines.
const TIE_STEP_PX: f64 = 5.0;
/// What it costs a label to lie on another, in pixels of distance from its point.
const ON_LABEL: f64 = 800.0;
/// What it costs to lie on a point, or on a sample of a line.
const ON_POINT: f64 = 150.0;
/// What it costs its tie to run over a point or another label, for each sample.
const ON_TIE: f64 = 25.0;

/// Upper left corners of the labels, one after another where it costs least: outside no other label, on no point, and
/// near their own; lines that tie labels to points further away cross no label either. `bounds`: left, top, right, bottom
/// of where they may be; `points` are all that are drawn, named or not, and samples of lines that are.
///
/// Greedy, after Christensen, Marks and Shieber (1995), section 3.1: labels that find no free place overlap.
pub fn place_labels(labels: &[Label], points: &[[f64; 2]], bounds: [f64; 4]) -> Vec<[f64; 2]> {
    let mut placed: Vec<[f64; 4]> = Vec::with_capacity(labels.len());
    let mut taken = points.to_vec();
    for label in labels {
        let candidates = (0..RINGS).flat_map(|ring| (0..DIRECTIONS).map(move |turn| (ring, turn)));
        let boxed = candidates.map(|(ring, turn)| {
            let distance = NEAREST_PX + STEP_PX * ring as f64;
            let angle = -TAU * (turn as f64 / DIRECTIONS as f64 + 0.125);
            within(beside(label, distance, angle), bounds)
        });
        let cost = |area: &[f64; 4]| {
            let on_labels = placed.iter().filter(|other| overlap(grown(*area, GAP_PX), **other) > 0.0).count();
            let on_points = taken.iter().filter(|point| holds(grown(*area, POINT_PX), **point)).count();
            let over = |at: &[f64; 2]| {
                let on_label = placed.iter().any(|other| holds(*other, *at));
                on_label || points.iter().any(|point| hidden(*point, *at, label.point))
            };
            let crossed = tie(*area, label.point).filter(over).count();
            ON_LABEL * on_labels as f64
                + ON_POINT * on_points as f64
                + ON_TIE * crossed as f64
                + distance_to(*area, label.point)
        };
        let best = boxed.map(|area| (cost(&area), area)).min_by(|a, b| a.0.total_cmp(&b.0));
        let area = best.map_or([label.point[0], label.point[1], label.point[0], label.point[1]], |(_, area)| area);
        placed.push(area);
        taken.extend(tie(area, label.point));
    }
    placed.into_iter().map(|[left, top, ..]| [left, top]).collect()
}

/// The label's box, whose nearest point lies about so far from its point in this direction.
fn beside(label: &Label, distance: f64, angle: f64) -> [f64; 4] {
    let (sin, cos) = (libm::sin(angle), libm::cos(angle));
    let [width, height] = label.size;
    let middle = [
        label.point[0] + cos * (distance + 0.5 * width * cos.abs()) + 0.5 * width * cos * (1.0 - cos.abs()),
        label.point[1] + sin * (distance + 0.5 * height),
    ];
    let (left, top) = (middle[0] - 0.5 * width, middle[1] - 0.5 * height);
    [left, top, left + width, top + height]
}

/// A box moved so that it is inside.
fn within(area: [f64; 4], bounds: [f64; 4]) -> [f64; 4] {
    let inside = |low: f64, high: f64, from: f64, to: f64| {
        let size = high - low;
        let low = low.min(to - size).max(from);
        (low, low + size)
    };
    let (left, right) = inside(area[0], area[2], bounds[0], bounds[2]);
    let (top, bottom) = inside(area[1], area[3], bounds[1], bounds[3]);
    [left, top, right, bottom]
}

fn grown([left, top, right, bottom]: [f64; 4], by: f64) -> [f64; 4] {
    [left - by, top - by, right + by, bottom + by]
}

fn holds([left, top, right, bottom]: [f64; 4], [x, y]: [f64; 2]) -> bool {
    (left..right).contains(&x) && (top..bottom).contains(&y)
}

/// Common area of two boxes.
fn overlap(a: [f64; 4], b: [f64; 4]) -> f64 {
    (a[2].min(b[2]) - a[0].max(b[0])).max(0.0) * (a[3].min(b[3]) - a[1].max(b[1])).max(0.0)
}

/// Samples of the line between a point and its label.
fn tie(area: [f64; 4], point: [f64; 2]) -> impl Iterator<Item = [f64; 2]> {
    let end = [point[0].clamp(area[0], area[2]), point[1].clamp(area[1], area[3])];
    let steps = (distance_to(area, point) / TIE_STEP_PX).floor() as u32;
    (1..steps).map(move |step| {
        let share = f64::from(step) / f64::from(steps);
        [0, 1].map(|side| point[side] + (end[side] - point[side]) * share)
    })
}

/// Whether a line to `own` passes over another point at `at`.
fn hidden(point: [f64; 2], at: [f64; 2], own: [f64; 2]) -> bool {
    let apart = |a: [f64; 2], b: [f64; 2]| (a[0] - b[0]).hypot(a[1] - b[1]);
    apart(point, at) < POINT_PX && apart(point, own) > POINT_PX
}

fn distance_to([left, top, right, bottom]: [f64; 4], [x, y]: [f64; 2]) -> f64 {
    let off = |at: f64, low: f64, high: f64| (low - at).max(at - high).max(0.0);
    off(x, left, right).hypot(off(y, top, bottom))
}

/// Samples of a line through points, in pixels, which labels keep away from.
pub fn along(points: &[[f64; 2]]) -> Vec<[f64; 2]> {
    let between = |ends: &[[f64; 2]]| {
        let [from, to] = [ends[0], ends[1]];
        let steps = ((to[0] - from[0]).hypot(to[1] - from[1]) / LINE_STEP_PX).ceil().max(1.0) as u32;
        let at = move |step: u32| {
            [0, 1].map(|side| from[side] + (to[side] - from[side]) * f64::from(step) / f64::from(steps))
        };
        (1..steps).map(at).collect::<Vec<_>>()
    };
    points.windows(2).flat_map(between).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    const BOUNDS: [f64; 4] = [0.0, 0.0, 600.0, 400.0];

    fn boxes(labels: &[Label], corners: &[[f64; 2]]) -> Vec<[f64; 4]> {
        let area = |(label, [x, y]): (&Label, &[f64; 2])| [*x, *y, x + label.size[0], y + label.size[1]];
        labels.iter().zip(corners).map(area).collect()
    }

    #[test]
    fn labels_of_a_crowd_lie_apart_on_no_point_and_inside() {
        let label =
            |i: u32| Label { point: [560.0 - 9.0 * f64::from(i), 30.0 + 5.0 * f64::from(i)], size: [120.0, 14.0] };
        let labels: Vec<Label> = (0..8).map(label).collect();
        let points: Vec<[f64; 2]> = labels.iter().map(|label| label.point).collect();
        let areas = boxes(&labels, &place_labels(&labels, &points, BOUNDS));
        for (i, area) in areas.iter().enumerate() {
            assert!(area[0] >= 0.0 && area[1] >= 0.0 && area[2] <= 600.0 && area[3] <= 400.0, "{area:?}");
            assert!(points.iter().all(|point| !holds(*area, *point)), "{area:?} hides a point");
            assert!(areas[..i].iter().all(|other| overlap(*area, *other) == 0.0), "{area:?} on another");
        }
    }

    #[test]
    fn a_lone_label_is_right_beside_its_point() {
        let label = Label { point: [300.0, 200.0], size: [80.0, 14.0] };
        let areas = boxes(&[label], &place_labels(&[label], &[label.point], BOUNDS));
        let away = distance_to(areas[0], label.point);
        assert!((POINT_PX..20.0).contains(&away), "{away} px, {areas:?}");
    }
}
