//! What is checked, and whether its parts fit together.

use super::CheckOptions;
use crate::map::{Grid, Level, StrokeList, StrokeMap};
use crate::measure;

/// A map under examination.
pub(super) struct Subject<'a> {
    pub(super) grid: &'a Grid,
    pub(super) stroke_map: Option<&'a StrokeMap>,
    pub(super) strokes: Option<&'a StrokeList>,
    pub(super) options: &'a CheckOptions,
}

impl Subject<'_> {
    /// Why nothing can be judged, if the images do not form a grid.
    pub(super) fn defect(&self) -> Option<String> {
        let grid = self.grid;
        if grid.hand_built == 0 || grid.hand_built > grid.levels.len() || grid.columns() == 0 {
            return Some("the map has no images".into());
        }
        for (i, level) in grid.levels.iter().enumerate() {
            let texels = level.size as usize * level.size as usize;
            if texels == 0 || level.cells.len() != grid.columns() || level.cells.iter().any(|ink| ink.len() != texels) {
                return Some(format!("level {i} does not hold {} images of {} px", grid.columns(), level.size));
            }
            if i > 0 && level.size * 2 != grid.levels[i - 1].size {
                return Some(format!("level {i} is not half the size of level {}", i - 1));
            }
        }
        None
    }

    /// The hand-built levels, finest first.
    pub(super) fn drawn(&self) -> &[Level] {
        self.grid.drawn()
    }

    /// A cell in words: `level 1 (128 px), column 3`. Columns are counted as everywhere, from 0, the lightest.
    pub(super) fn place(&self, level: usize, column: usize) -> String {
        format!("level {level} ({} px), column {column}", self.grid.levels[level].size)
    }

    /// Half the ink of a fully covered texel of a level, taken in its lightest column; 128 for solid ink, at least 1.
    pub(super) fn half_ink(&self, level: usize) -> u8 {
        measure::full_ink(&self.grid.levels[level].cells[0]).div_ceil(2).max(1)
    }

    /// The stroke list, or why it cannot be used.
    pub(super) fn strokes(&self) -> Result<&StrokeList, String> {
        let strokes = self.strokes.ok_or("there is no stroke list")?;
        let (levels, columns, count) = (self.grid.hand_built, self.grid.columns(), strokes.strokes.len());
        let fits = strokes.first_column.len() == levels
            && strokes.first_column.iter().all(|first| first.len() == count)
            && strokes.closing.len() == levels
            && strokes.closing.iter().all(|level| level.len() == columns)
            && strokes.closing.iter().flatten().flatten().all(|closing| (closing.stroke as usize) < count)
            && strokes.strokes.iter().all(|stroke| usize::from(stroke.family) < strokes.families.len());
        if fits { Ok(strokes) } else { Err("the stroke list belongs to another map".into()) }
    }

    /// The stroke map, or why it cannot be used.
    pub(super) fn stroke_map(&self) -> Result<&StrokeMap, String> {
        let map = self.stroke_map.ok_or("there is no stroke map")?;
        let fits = map.levels.len() == self.grid.hand_built
            && map.levels.iter().zip(self.drawn()).all(|(thresholds, level)| {
                thresholds.size == level.size && thresholds.threshold.len() == level.cells[0].len()
            });
        if fits { Ok(map) } else { Err("the stroke map's levels are not those of the map".into()) }
    }
}
