//! What several tests of the window use.

use std::path::{Path, PathBuf};
use std::sync::Arc;

use egui_kittest::kittest::NodeT;
use tam_tests::app::Window;

/// The pixels of the view.
pub(crate) fn picture(window: &Window) -> Vec<u8> {
    let shown = window.app().results().picture.as_ref().expect("a picture");
    shown.canvas.read().expect("a device").into_raw()
}

/// Share of pixels that differ.
pub(crate) fn difference(a: &[u8], b: &[u8]) -> f64 {
    assert_eq!(a.len(), b.len());
    let pixels = a.chunks_exact(4).zip(b.chunks_exact(4));
    pixels.filter(|(a, b)| a != b).count() as f64 / (a.len() / 4) as f64
}

/// A file that is dropped onto the window.
#[derive(Debug)]
pub(crate) struct Dropped(PathBuf);

impl egui::DroppedFile for Dropped {
    fn path(&self) -> &Path {
        &self.0
    }

    fn bytes(&self) -> Result<Vec<u8>, String> {
        std::fs::read(&self.0).map_err(|error| error.to_string())
    }
}

pub(crate) fn drop_file(window: &mut Window, path: &Path) {
    window.harness.input_mut().dropped_files.push(Arc::new(Dropped(path.to_owned())));
    window.harness.step();
    window.settle();
}

/// Names of all widgets of a role that can be used now.
pub(crate) fn names_of(window: &Window, wanted: egui::accesskit::Role) -> Vec<String> {
    let nodes = window.harness.root().children_recursive();
    let used = nodes.filter(|node| node.accesskit_node().role() == wanted && !node.accesskit_node().is_disabled());
    used.filter_map(|node| node.accesskit_node().label()).collect()
}

/// Part of the window as a small picture, compared with the one that is kept.
pub(crate) fn compare_with_kept(window: &mut Window, area: egui::Rect, name: &str) {
    let picture = window.harness.render().expect("a picture of the window");
    let side = |from: f32, to: f32| (from.max(0.0) as u32, (to - from.max(0.0)) as u32);
    let ((x, width), (y, height)) = (side(area.left(), area.right()), side(area.top(), area.bottom()));
    let part = image::imageops::crop_imm(&picture, x, y, width, height).to_image();
    // Letters are drawn by the processor and put together by the adapter, whose rounding differs by CPU class.
    let options = egui_kittest::SnapshotOptions::new().threshold(2.0).max_failed_pixels(40);
    egui_kittest::image_snapshot_options(&part, name, &options);
}
