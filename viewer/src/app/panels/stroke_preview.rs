//! Three strokes of the preset, enlarged: its shortest, a middle one and its longest.

use std::hash::{DefaultHasher, Hash, Hasher};

use egui::{Color32, ColorImage, CornerRadius, Rect, Sense, Ui};
use tam_gen::raster::{Footprint, Grain, Nib, over};
use tam_gen::{Axis, Family, Preset, Stroke};

use super::Panel;

/// Side of the level that the strokes are drawn on, in texels.
const LEVEL_PX: u32 = 512;

/// Rows of it that are shown.
const ROWS: u32 = 132;

/// How much wider strokes are drawn than in the map.
const ENLARGED: f64 = 3.0;

pub(super) fn show(panel: &mut Panel<'_>, ui: &mut Ui, preset: &Preset) {
    let width = ui.available_width().min(560.0);
    let size = egui::vec2(width, width * ROWS as f32 / LEVEL_PX as f32);
    let (rect, response) = ui.allocate_exact_size(size, Sense::hover());
    response.widget_info(|| egui::WidgetInfo::labeled(egui::Role::Image, true, "Three strokes, enlarged"));
    let mut hasher = DefaultHasher::new();
    format!("{:?} {:?} {:?}", preset.stroke, preset.colours, preset.seed).hash(&mut hasher);
    let version = hasher.finish() as usize;
    let texture = panel.textures.sharp(ui.ctx(), "stroke preview", version, || drawn(preset));
    let uv = Rect::from_min_max(egui::Pos2::ZERO, egui::pos2(1.0, 1.0));
    let image = egui::Image::from_texture((texture.id(), size)).uv(uv).corner_radius(CornerRadius::same(4));
    image.paint_at(ui, rect);
    response.on_hover_text(format!("The shortest, a middle and the longest stroke, {ENLARGED:.0} times as wide"));
}

fn drawn(preset: &Preset) -> ColorImage {
    let stroke = &preset.stroke;
    let family = Family { name: String::new(), angle_deg: 0.0, stroke: stroke.clone() };
    let mut ink = vec![0_u8; (LEVEL_PX * LEVEL_PX) as usize];
    // A tip that cannot be read leaves the paper empty; the map says what is wrong with it.
    if let Ok(nib) = Nib::new(&family) {
        let grain = Grain::new(stroke.grain as f32, LEVEL_PX, preset.seed);
        let mut footprint = Footprint::default();
        for (row, part) in [0.0, 0.5, 1.0].into_iter().enumerate() {
            nib.footprint(&sample(preset, row, part), LEVEL_PX, &grain, &mut footprint);
            for (texel, laid) in footprint.iter() {
                ink[texel] = over(ink[texel], laid);
            }
        }
    }
    let (paper, dark) = preset.colours.srgb().unwrap_or(([255; 3], [0; 3]));
    let shown = &ink[..(LEVEL_PX * ROWS) as usize];
    let pixels = shown.iter().map(|ink| blended(paper, dark, *ink)).collect();
    ColorImage::new([LEVEL_PX as usize, ROWS as usize], pixels)
}

/// A stroke of the length at `part` between the shortest and the longest, bowed one way and the other.
fn sample(preset: &Preset, row: usize, part: f64) -> Stroke {
    let stroke = &preset.stroke;
    let length = stroke.length_min + (stroke.length_max - stroke.length_min) * part;
    let along = (length * 0.9) as f32;
    let sign = if row.is_multiple_of(2) { 1.0 } else { -1.0 };
    let (bow, s_curve) = ((stroke.bow * length * sign) as f32, (stroke.s_curve * length * sign) as f32);
    let middle = (row as f32 + 0.5) * ROWS as f32 / 3.0 / LEVEL_PX as f32;
    // A parabola that leaves its chord by the bow, and a cubic that leaves it by the s-curve at the quarters.
    let (c2, c3) = (-4.0 * bow - 32.0 * s_curve, 64.0 / 3.0 * s_curve);
    let across_uv = [middle, 4.0 * bow + 32.0 / 3.0 * s_curve, c2, c3];
    let width_px = (stroke.width_px * ENLARGED) as f32;
    Stroke { family: 0, axis: Axis::X, start_uv: 0.05, along_uv: along, across_uv, width_px }
}

/// A texel of ink on paper, blended in linear light.
pub(super) fn blended(paper: [u8; 3], dark: [u8; 3], ink: u8) -> Color32 {
    let share = f32::from(ink) / 255.0;
    let paper = egui::Rgba::from(Color32::from_rgb(paper[0], paper[1], paper[2]));
    let dark = egui::Rgba::from(Color32::from_rgb(dark[0], dark[1], dark[2]));
    Color32::from(paper * (1.0 - share) + dark * share)
}
