//! Labelled sheets: rendered pictures beside each other, each with a title and figures below it.

use image::{Rgb, RgbImage, RgbaImage};
use tam_gen::export::sheet::lettering::{BODY, FIGURE, FOOT, LABEL, Style, TITLE};
use tam_gen::export::sheet::{GROUND, frame};

const MARGIN: u32 = 44;
const GAP: u32 = 26;
/// Space between a picture and its label.
const LABEL_GAP: u32 = 8;
/// Space below the head.
const HEAD_GAP: u32 = 22;
/// Least width for title, description and foot.
const LEAST_WIDTH: u32 = 400;

/// What a sheet says beside its pictures.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct SheetText {
    /// Large, at the top.
    pub title: String,
    /// Below the title; as many lines as it needs.
    pub description: String,
    /// Remarks at the foot; as many lines as they need.
    pub foot: String,
}

/// A picture with what stands below it.
#[derive(Clone, Debug)]
pub struct Labelled {
    /// The picture.
    pub picture: RgbaImage,
    /// In the first lines, broken where it is wider than the picture.
    pub title: String,
    /// Below the title, each a paragraph.
    pub remarks: Vec<String>,
}

/// Rows of pictures below each other; all pictures get the space of the largest.
///
/// Nothing is cut: lines are broken to the width of a picture, words that are wider still to parts.
pub fn labelled_sheet(text: &SheetText, rows: &[Vec<Labelled>]) -> RgbImage {
    let side = |side: fn(&RgbaImage) -> u32| {
        rows.iter().flatten().map(|cell| side(&cell.picture)).max().unwrap_or(LEAST_WIDTH)
    };
    let (cell_width, cell_height) = (side(RgbaImage::width), side(RgbaImage::height));
    let columns = rows.iter().map(Vec::len).max().unwrap_or(1).max(1) as u32;
    let width = (columns * (cell_width + GAP) - GAP).max(LEAST_WIDTH);
    let labels = |row: &Vec<Labelled>| row.iter().map(|cell| label(cell, cell_width)).collect::<Vec<_>>();
    let labels: Vec<Vec<Vec<(Style, String)>>> = rows.iter().map(labels).collect();
    let label_heights: Vec<u32> =
        labels.iter().map(|row| row.iter().map(|label| height(label)).max().unwrap_or(0)).collect();
    let head = lines(&[(TITLE, &text.title), (BODY, &text.description)], width);
    let foot = lines(&[(FOOT, &text.foot)], width);
    let head_height = height(&head) + if head.is_empty() { 0 } else { HEAD_GAP };
    let rows_height: u32 = label_heights.iter().map(|label| cell_height + LABEL_GAP + label + GAP).sum();

    let sheet_height = 2 * MARGIN + head_height + rows_height + height(&foot);
    let mut sheet = RgbImage::from_pixel(2 * MARGIN + width, sheet_height, GROUND);
    draw(&mut sheet, &head, MARGIN, MARGIN);
    let mut top = MARGIN + head_height;
    for ((row, labels), label_height) in rows.iter().zip(&labels).zip(label_heights) {
        for ((cell, label), column) in row.iter().zip(labels).zip(0..) {
            let left = MARGIN + column * (cell_width + GAP);
            let inset = (cell_width - cell.picture.width()) / 2;
            paste(&mut sheet, &cell.picture, left + inset, top);
            draw(&mut sheet, label, left, top + cell_height + LABEL_GAP);
        }
        top += cell_height + LABEL_GAP + label_height + GAP;
    }
    draw(&mut sheet, &foot, MARGIN, top);
    sheet
}

fn label(cell: &Labelled, width: u32) -> Vec<(Style, String)> {
    let remarks = cell.remarks.iter().map(|remark| (FIGURE, remark.as_str()));
    lines(&std::iter::once((LABEL, cell.title.as_str())).chain(remarks).collect::<Vec<_>>(), width)
}

/// Paragraphs in lines that are no wider than `width`.
fn lines(paragraphs: &[(Style, &str)], width: u32) -> Vec<(Style, String)> {
    let broken = |(style, text): &(Style, &str)| {
        let style = *style;
        let parts = style.wrapped(text, width).into_iter().flat_map(move |line| parts(style, &line, width));
        parts.map(move |line| (style, line)).collect::<Vec<_>>()
    };
    paragraphs.iter().flat_map(broken).collect()
}

/// A line that holds one word wider than `width`, in parts that are not; any other line as it is.
fn parts(style: Style, line: &str, width: u32) -> Vec<String> {
    let mut parts = vec![String::new()];
    for letter in line.chars() {
        let last = parts.last_mut().expect("there is a part from the beginning");
        last.push(letter);
        if style.width_px(last) > width && last.chars().count() > 1 {
            last.pop();
            parts.push(letter.into());
        }
    }
    parts
}

fn height(lines: &[(Style, String)]) -> u32 {
    lines.iter().map(|(style, _)| style.line_px()).sum()
}

/// Draws lines below each other.
fn draw(sheet: &mut RgbImage, lines: &[(Style, String)], left: u32, mut top: u32) {
    for (style, line) in lines {
        style.draw(sheet, left as f32, top as f32, line);
        top += style.line_px();
    }
}

/// A picture and a line around it; where it is transparent the ground shows through.
fn paste(sheet: &mut RgbImage, picture: &RgbaImage, left: u32, top: u32) {
    frame(sheet, left, top, picture.width(), picture.height());
    for (x, y, pixel) in picture.enumerate_pixels() {
        let [r, g, b, alpha] = pixel.0;
        let below = sheet.get_pixel(left + x, top + y).0;
        let over = |above: u8, below: u8| {
            ((u32::from(above) * u32::from(alpha) + u32::from(below) * (255 - u32::from(alpha)) + 127) / 255) as u8
        };
        sheet.put_pixel(left + x, top + y, Rgb([over(r, below[0]), over(g, below[1]), over(b, below[2])]));
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn cell(width: u32, height: u32, title: &str) -> Labelled {
        let picture = RgbaImage::from_pixel(width, height, image::Rgba([200, 10, 10, 255]));
        Labelled { picture, title: title.into(), remarks: vec!["1.00x".into()] }
    }

    #[test]
    fn no_label_is_wider_than_its_picture() {
        let text = "a-name-that-is-far-wider-than-any-picture-of-this-size and more";
        for (_, line) in lines(&[(LABEL, text), (TITLE, text)], 90) {
            assert!(LABEL.width_px(&line) <= 90, "{line}");
        }
        let broken = lines(&[(LABEL, text)], 90);
        let joined: String = broken.into_iter().map(|(_, line)| line).collect();
        assert_eq!(joined.replace(' ', ""), text.replace(' ', ""), "no letter is lost");
    }

    #[test]
    fn every_picture_is_on_the_sheet_whole() {
        let cells: Vec<_> = (0..5).map(|k| cell(260, 40, &format!("cell {k}"))).collect();
        let rows: Vec<_> = cells.chunks(2).map(<[_]>::to_vec).collect();
        let sheet = labelled_sheet(&SheetText::default(), &rows);
        let red = sheet.pixels().filter(|pixel| pixel.0 == [200, 10, 10]).count();
        assert_eq!(red, 5 * 260 * 40);
        assert_eq!(sheet.width(), 2 * MARGIN + 2 * 260 + GAP);
    }

    #[test]
    fn a_sheet_without_pictures_has_its_text() {
        let text = SheetText { title: "Nothing".into(), ..SheetText::default() };
        let sheet = labelled_sheet(&text, &[]);
        assert!(sheet.pixels().any(|pixel| *pixel != GROUND));
    }
}
