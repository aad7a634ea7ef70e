//! Where everything on a contact sheet goes.

use super::SheetOptions;
use super::lettering::{BODY, FIGURE, FOOT, LABEL, Style, TITLE};
use crate::map::Grid;

const MARGIN: u32 = 44;
const GUTTER_GAP: u32 = 28;
const ROW_GAP: u32 = 22;
/// Space between a cell and its label.
const LABEL_GAP: u32 = 5;
/// Least space between labels of neighbouring columns.
const LABEL_SPACE: u32 = 6;
/// Least width for title and description.
const TEXT_WIDTH: u32 = 400;
/// Beside cells lower than this, a level's size and remarks share one line.
const LOW: u32 = 40;

/// The places of all cells and texts.
pub(super) struct Layout {
    pub(super) width: u32,
    pub(super) height: u32,
    /// Middle of each column.
    pub(super) middles: Vec<u32>,
    /// One row per level.
    pub(super) rows: Vec<Row>,
    pub(super) texts: Vec<Text>,
}

/// The cells of one level.
pub(super) struct Row {
    pub(super) top: u32,
    /// Side at which the level is shown, in pixels.
    pub(super) shown: u32,
}

/// A line of text.
pub(super) struct Text {
    pub(super) style: Style,
    /// Left end, or the middle where it is centred.
    pub(super) x: u32,
    pub(super) top: u32,
    pub(super) centred: bool,
    pub(super) text: String,
}

impl Layout {
    pub(super) fn new(grid: &Grid, options: &SheetOptions) -> Self {
        let columns = grid.columns() as u32;
        let finest = grid.levels.first().map_or(1, |level| level.size);
        let mut shown = finest.max(1);
        // The gutter is as wide as the labels it will hold, and these say whether a level is reduced.
        let gutter = loop {
            let labels = (0..grid.levels.len()).flat_map(|level| level_label(grid, level, shown));
            let gutter = labels.map(|(style, text)| style.width_px(&text)).max().unwrap_or(0) + GUTTER_GAP;
            if shown <= 8 || 2 * MARGIN + gutter + columns * pitch(shown) <= options.max_width_px {
                break gutter;
            }
            shown /= 2;
        };
        let pitch = pitch(shown);
        let cells_width = gutter + columns * pitch;
        let text_width = cells_width.max(TEXT_WIDTH);
        let mut layout = Self {
            width: 2 * MARGIN + text_width,
            height: 0,
            middles: (0..columns).map(|column| MARGIN + gutter + column * pitch + pitch / 2).collect(),
            rows: Vec::new(),
            texts: Vec::new(),
        };
        let mut top = MARGIN;
        layout.paragraph(TITLE, &options.title, text_width, &mut top);
        layout.paragraph(BODY, &options.description, text_width, &mut top);
        top += if top > MARGIN { ROW_GAP } else { 0 };

        layout.column_labels(LABEL, top, pitch, &[&|k| format!("tone {k}"), &|k| k.to_string()]);
        top += LABEL.line_px();
        layout.column_labels(FIGURE, top, pitch, &figures("target", &grid.tones).each_ref().map(|f| f as _));
        top += FIGURE.line_px() + LABEL_GAP;

        for (index, level) in grid.levels.iter().enumerate() {
            let shown = level.size.min(shown);
            let labels = level_label(grid, index, shown);
            let labels_height: u32 = labels.iter().map(|(style, _)| style.line_px()).sum();
            let cell_top = top + labels_height.saturating_sub(shown) / 2;
            let mut label_top = top + shown.saturating_sub(labels_height).min(LOW) / 2;
            for (style, text) in labels {
                layout.texts.push(Text { style, x: MARGIN, top: label_top, centred: false, text });
                label_top += style.line_px();
            }
            layout.rows.push(Row { top: cell_top, shown });
            let measured: Vec<f64> = level.cells.iter().map(|ink| options.measure.tone(ink)).collect();
            let below = cell_top + shown + LABEL_GAP;
            layout.column_labels(FIGURE, below, pitch, &figures("measured", &measured).each_ref().map(|f| f as _));
            top = below + FIGURE.line_px() + ROW_GAP;
        }
        let mut foot = String::from(
            "Tone is darkness: 0 is paper, 1 is solid ink. Target above the column, measured below each cell.",
        );
        if shown < finest {
            foot += &format!(" Levels finer than {shown} px are shown reduced, by a box filter in linear light.");
        }
        layout.paragraph(FOOT, &foot, text_width, &mut top);
        layout.height = top + MARGIN;
        layout
    }

    fn paragraph(&mut self, style: Style, text: &str, width: u32, top: &mut u32) {
        for text in style.wrapped(text, width) {
            self.texts.push(Text { style, x: MARGIN, top: *top, centred: false, text });
            *top += style.line_px();
        }
    }

    /// Labels every column by the first wording that fits them all, else every second or third column by the last.
    fn column_labels(&mut self, style: Style, top: u32, pitch: u32, wordings: &[&dyn Fn(usize) -> String]) {
        let space = pitch.saturating_sub(LABEL_SPACE).max(1);
        let columns = self.middles.len();
        let widest =
            |wording: &dyn Fn(usize) -> String| (0..columns).map(|k| style.width_px(&wording(k))).max().unwrap_or(0);
        let Some(wording) = wordings.iter().find(|wording| widest(wording) <= space).or(wordings.last()) else {
            return;
        };
        let step = widest(wording).div_ceil(space).max(1) as usize;
        for (column, &x) in self.middles.iter().enumerate().step_by(step) {
            self.texts.push(Text { style, x, top, centred: true, text: wording(column) });
        }
    }
}

/// Distance of columns for cells shown at a side, in pixels.
fn pitch(shown: u32) -> u32 {
    shown + (shown / 10).clamp(10, 22)
}

/// The ways to write a tone, longest first.
fn figures<'a>(word: &'a str, tones: &'a [f64]) -> [Box<dyn Fn(usize) -> String + 'a>; 4] {
    [
        Box::new(move |k| format!("{word} {:.4}", tones[k])),
        Box::new(move |k| format!("{:.4}", tones[k])),
        Box::new(move |k| format!("{:.3}", tones[k])),
        Box::new(move |k| format!("{:.2}", tones[k]).replacen("0.", ".", 1)),
    ]
}

/// What stands at the left of a level, line by line; low cells leave room for two lines.
fn level_label(grid: &Grid, level: usize, shown: u32) -> Vec<(Style, String)> {
    let size = grid.levels[level].size;
    let mut remarks = vec![format!("{size} px")];
    if level >= grid.hand_built {
        remarks.push("filtered".into());
    }
    if shown < size {
        remarks.push(format!("shown at 1/{}", size / shown));
    }
    if size.min(shown) < LOW {
        remarks = vec![remarks.join(", ")];
    }
    let remarks = remarks.into_iter().map(|remark| (FIGURE, remark));
    [(LABEL, format!("level {level}"))].into_iter().chain(remarks).collect()
}
