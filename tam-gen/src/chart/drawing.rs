//! One chart: points of cost against error, with the front marked and named.

use std::io::Cursor;
use std::sync::Arc;

use image::ImageFormat;
use image::imageops::thumbnail;
use kuva::backend::raster::RasterBackend;
use kuva::backend::svg::SvgBackend;
use kuva::plot::LinePlot;
use kuva::plot::annotations::ReferenceLine;
use kuva::plot::legend::{LegendEntry, LegendPosition, LegendShape};
use kuva::plot::scatter::{MarkerShape, ScatterPlot};
use kuva::render::color::Color;
use kuva::render::layout::{ComputedLayout, Layout, TickFormat};
use kuva::render::plots::Plot;
use kuva::render::render::{Primitive, Scene, TextAnchor, render_multiple};

use super::ChartError;
use super::axis::{Axis, tick};
use super::colours::GROUP_COLOURS;
use super::labels::{Label, along, place_labels};
use super::pareto::pareto_front;

/// A way of doing the work.
#[derive(Clone, Debug, PartialEq)]
pub struct ChartPoint {
    /// What it is called where it is on the front.
    pub label: String,
    /// Of the chart's groups; it gives the colour.
    pub group: usize,
    /// Drawn as a triangle: a baseline, as its paper prints it.
    pub baseline: bool,
    /// Cost.
    pub x: f64,
    /// Error.
    pub y: f64,
}

/// Ways of doing the work, by cost and error.
#[derive(Clone, Debug, PartialEq)]
pub struct Chart {
    /// Name of its files, without an ending.
    pub name: String,
    /// What the chart says.
    pub title: String,
    /// With what it was measured.
    pub subtitle: String,
    /// Cost.
    pub x: Axis,
    /// Error.
    pub y: Axis,
    /// Names of the groups, in the order of the legend.
    pub groups: Vec<String>,
    /// All that were measured; those without finite numbers are left out.
    pub points: Vec<ChartPoint>,
}

impl Chart {
    /// Indices of the points that are worth their cost, by growing cost.
    pub fn front(&self) -> Vec<usize> {
        pareto_front(&self.points.iter().map(|point| [point.x, point.y]).collect::<Vec<_>>())
    }

    /// The point of least error; of several, the cheapest.
    pub fn best(&self) -> Option<&ChartPoint> {
        self.front().last().map(|i| &self.points[*i])
    }
}

/// A chart as files.
#[derive(Clone, Debug, PartialEq)]
pub struct Drawn {
    /// As text.
    pub svg: String,
    /// As pixels, half as many again as the units of the SVG.
    pub png: Vec<u8>,
}

/// How much of its colour a point keeps that is not on the front.
const PALE: f64 = 0.45;
const SIZE: [f64; 2] = [960.0, 560.0];
const PNG_SCALE: f32 = 1.5;
/// Pixels are drawn so many times finer and averaged: the backend leaves turned text jagged.
const OVERSAMPLED: u32 = 2;
const LABEL_PX: u32 = 12;
/// Width of a letter of the labels, at most on average, and height of their lines.
const LETTER_PX: f64 = 7.0;
const LINE_PX: f64 = 15.0;
/// Labels further than this from their points are tied to them by a line.
const TIED_PX: f64 = 14.0;
/// Letters in a line of the title.
const TITLE_LETTERS: usize = 84;

/// Draws a chart.
///
/// # Errors
/// The pixels cannot be encoded.
pub fn draw(chart: &Chart) -> Result<Drawn, ChartError> {
    let at = |point: &ChartPoint| {
        let raised = |axis: &Axis, value: f64| axis.log_from.map_or(value, |least| value.max(least));
        (raised(&chart.x, point.x), raised(&chart.y, point.y))
    };
    let shown: Vec<usize> =
        (0..chart.points.len()).filter(|i| chart.points[*i].x.is_finite() && chart.points[*i].y.is_finite()).collect();
    let front = chart.front();
    let mut plots: Vec<Plot> = Vec::new();
    if front.len() > 1 {
        let line = LinePlot::new().with_data(front.iter().map(|i| at(&chart.points[*i])));
        plots.push(line.with_color("#333333").with_stroke_width(1.4).into());
    }
    for (group, colour) in (0..chart.groups.len()).zip(GROUP_COLOURS.iter().cycle()) {
        for (baseline, best) in [(false, false), (true, false), (false, true), (true, true)] {
            let wanted = |i: &&usize| {
                let point = &chart.points[**i];
                point.group == group && point.baseline == baseline && front.contains(*i) == best
            };
            let places: Vec<(f64, f64)> = shown.iter().filter(wanted).map(|i| at(&chart.points[*i])).collect();
            if places.is_empty() {
                continue;
            }
            let marker = if baseline { MarkerShape::Triangle } else { MarkerShape::Circle };
            let (size, strength) = if best { (5.5, 1.0) } else { (4.0, PALE) };
            let dots = ScatterPlot::new()
                .with_data(places)
                .with_color(hex(*colour, strength))
                .with_marker(marker)
                .with_size(size);
            plots.push(dots.into());
        }
    }
    let layout = layout(chart, &plots);
    let computed = ComputedLayout::from_layout(&layout);
    let mut scene = render_multiple(plots, layout);
    let place = |i: &usize| {
        let (x, y) = at(&chart.points[*i]);
        [computed.map_x(x), computed.map_y(y)]
    };
    let mut taken: Vec<[f64; 2]> = shown.iter().map(place).collect();
    taken.extend(along(&front.iter().map(place).collect::<Vec<_>>()));
    name_front(&mut scene, chart, &front, &front.iter().map(place).collect::<Vec<_>>(), &taken, &computed);
    // With a box of its own, so that it scales where it is shown.
    let sized = format!("<svg viewBox=\"0 0 {} {}\" ", scene.width, scene.height);
    let svg = SvgBackend.render_scene(&scene).replacen("<svg ", &sized, 1);
    let fine =
        RasterBackend::new().with_scale(PNG_SCALE * OVERSAMPLED as f32).render_scene(&scene).map_err(ChartError)?;
    let png = averaged(&fine).map_err(|error| ChartError(error.to_string()))?;
    Ok(Drawn { svg, png })
}

/// The picture with means of so many pixels each way, as PNG.
fn averaged(png: &[u8]) -> Result<Vec<u8>, image::ImageError> {
    let fine = image::load_from_memory_with_format(png, ImageFormat::Png)?.into_rgb8();
    let mean = thumbnail(&fine, fine.width() / OVERSAMPLED, fine.height() / OVERSAMPLED);
    let mut png = Vec::new();
    mean.write_to(&mut Cursor::new(&mut png), ImageFormat::Png)?;
    Ok(png)
}

fn layout(chart: &Chart, plots: &[Plot]) -> Layout {
    let legend = |(name, colour): (&String, &[u8; 3])| LegendEntry {
        label: name.clone(),
        color: hex(*colour, 1.0),
        shape: LegendShape::Circle,
        dasharray: None,
    };
    let mut legend: Vec<LegendEntry> = chart.groups.iter().zip(GROUP_COLOURS.iter().cycle()).map(legend).collect();
    let entry = |label: &str, shape| LegendEntry {
        label: label.to_owned(),
        color: "#333333".to_owned(),
        shape,
        dasharray: None,
    };
    if chart.points.iter().any(|point| point.baseline) {
        legend.push(entry("as printed", LegendShape::Marker(MarkerShape::Triangle)));
    }
    legend.push(entry("Pareto front", LegendShape::Line));
    let (x, y) = (
        chart.x.range(chart.points.iter().map(|point| point.x)),
        chart.y.range(chart.points.iter().map(|point| point.y)),
    );
    let plain = || TickFormat::Custom(Arc::new(tick));
    // Without points there is nothing to find ranges by.
    let empty = || Layout::new((x[0], x[1]), (y[0], y[1]));
    let layout = if plots.is_empty() { empty() } else { Layout::auto_from_plots(plots) };
    let mut layout = layout
        .with_width(SIZE[0])
        .with_height(SIZE[1])
        .with_title(chart.title.clone())
        .with_title_size(16)
        .with_title_wrap(TITLE_LETTERS)
        .with_subtitle(chart.subtitle.clone())
        .with_subtitle_size(12)
        .with_x_label(chart.x.label.clone())
        .with_y_label(chart.y.label.clone())
        .with_legend_entries(legend)
        .with_legend_position(LegendPosition::OutsideRightTop)
        .with_legend_box(false)
        .with_x_axis_min(x[0])
        .with_x_axis_max(x[1])
        .with_y_axis_min(y[0])
        .with_y_axis_max(y[1])
        .with_x_tick_format(plain())
        .with_y_tick_format(plain());
    for (axis, line) in [(&chart.x, ReferenceLine::vertical as fn(f64) -> _), (&chart.y, ReferenceLine::horizontal)] {
        if let Some((at, name)) = &axis.mark {
            layout = layout.with_reference_line(line(*at).with_label(name.clone()).with_color("#888888"));
        }
    }
    if chart.x.log_from.is_some() {
        layout = layout.with_log_x();
    }
    if chart.y.log_from.is_some() {
        layout = layout.with_log_y();
    }
    layout
}

/// A colour in the words of CSS, mixed with paper.
fn hex(colour: [u8; 3], strength: f64) -> String {
    let [r, g, b] = colour.map(|channel| (255.0 - strength * (255.0 - f64::from(channel))).round() as u8);
    format!("#{r:02x}{g:02x}{b:02x}")
}

/// Writes the names of the points of the front where there is room.
fn name_front(
    scene: &mut Scene,
    chart: &Chart,
    front: &[usize],
    named: &[[f64; 2]],
    taken: &[[f64; 2]],
    computed: &ComputedLayout,
) {
    let text = |i: &usize| chart.points[*i].label.as_str();
    let label = |(i, point): (&usize, &[f64; 2])| Label {
        point: *point,
        size: [LETTER_PX * text(i).chars().count() as f64, LINE_PX],
    };
    let labels: Vec<Label> = front.iter().zip(named).map(label).collect();
    let bounds = [
        computed.margin_left + 4.0,
        computed.margin_top + 2.0,
        computed.width - computed.margin_right - 2.0,
        computed.height - computed.margin_bottom - 4.0,
    ];
    for ((i, label), [left, top]) in front.iter().zip(&labels).zip(place_labels(&labels, taken, bounds)) {
        let [width, height] = label.size;
        let nearest = [label.point[0].clamp(left, left + width), label.point[1].clamp(top, top + height)];
        let away = (nearest[0] - label.point[0]).hypot(nearest[1] - label.point[1]);
        if away > TIED_PX {
            scene.add(Primitive::Line {
                x1: label.point[0],
                y1: label.point[1],
                x2: nearest[0],
                y2: nearest[1],
                stroke: Color::Rgb(150, 150, 150),
                stroke_width: 0.8,
                stroke_dasharray: None,
            });
        }
        // Letters next to their point lie against it: the box is wider than most texts.
        let (x, anchor) = match label.point[0] {
            x if x < left => (left, TextAnchor::Start),
            x if x > left + width => (left + width, TextAnchor::End),
            _ => (left + 0.5 * width, TextAnchor::Middle),
        };
        scene.add(Primitive::Text {
            x,
            y: top + 0.78 * height,
            content: text(i).to_owned(),
            size: LABEL_PX,
            anchor,
            rotate: None,
            bold: false,
            color: Some(Color::Rgb(20, 20, 20)),
        });
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn chart() -> Chart {
        let point = |i: u32| ChartPoint {
            label: format!("way {i}"),
            group: i as usize % 2,
            baseline: i.is_multiple_of(3),
            x: 1.0 + 0.3 * f64::from(i),
            y: 10.0 / f64::from(i + 1),
        };
        let axis = |label: &str| Axis { label: label.into(), log_from: Some(1e-3), mark: None };
        Chart {
            name: "test".into(),
            title: "What it says".into(),
            subtitle: "how <it> was measured".into(),
            x: Axis { mark: Some((0.9, "yardstick".into())), ..axis("cost (ms)") },
            y: axis("error (%)"),
            groups: vec!["ours".into(), "theirs".into()],
            points: (0..5)
                .map(point)
                .chain([ChartPoint { x: 2.0, y: 9.5, label: "worse".into(), ..point(1) }])
                .collect(),
        }
    }

    #[test]
    fn titles_axes_groups_and_the_front_are_named_and_nothing_else_is() {
        let svg = draw(&chart()).expect("a chart").svg;
        for text in
            ["What it says", "cost (ms)", "error (%)", "ours", "theirs", "way 0", "way 4", "as printed", "yardstick"]
        {
            assert!(svg.contains(text), "{text} is not in {svg}");
        }
        assert!(!svg.contains("worse") && !svg.contains("<it>"), "{svg}");
    }

    #[test]
    fn pixels_show_the_points() {
        let drawn = draw(&chart()).expect("a chart");
        let picture = image::load_from_memory(&drawn.png).expect("a PNG").into_rgb8();
        assert_eq!(picture.dimensions(), (1440, 840));
        // Left of the legend, which shows the colours too.
        let shown = picture.enumerate_pixels().filter(|(x, _, _)| *x < 1100);
        let blue = shown.filter(|(_, _, pixel)| pixel.0 == [0x00, 0x72, 0xb2]).count();
        assert!(blue > 100, "{blue} pixels of the first group");
    }

    #[test]
    fn a_chart_without_points_is_drawn_empty() {
        let empty = Chart { points: Vec::new(), ..chart() };
        assert!(draw(&empty).expect("a chart").svg.contains("What it says"));
    }
}
