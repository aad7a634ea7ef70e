//! Where the panels are.

use egui_tiles::{Container, Linear, LinearDir, Tile, TileId, Tiles, Tree};
use serde::{Deserialize, Serialize};

/// A panel.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Pane {
    /// The mesh in its material.
    View,
    /// The gallery.
    Presets,
    /// All numbers of a preset.
    Strokes,
    /// Method and mapping.
    Shading,
    /// Mesh, lights, colours, objects.
    Scene,
    /// The map's images.
    Map,
    /// The constraints.
    Checks,
    /// What every way to draw costs, and how far it errs.
    Chart,
    /// Files for engines.
    Export,
}

impl Pane {
    /// All of them.
    pub const ALL: [Self; 9] = [
        Self::View,
        Self::Presets,
        Self::Strokes,
        Self::Shading,
        Self::Scene,
        Self::Map,
        Self::Checks,
        Self::Chart,
        Self::Export,
    ];

    /// What its tab says.
    pub fn title(self) -> &'static str {
        match self {
            Self::View => "View",
            Self::Presets => "Presets",
            Self::Strokes => "Strokes",
            Self::Shading => "Shading",
            Self::Scene => "Scene",
            Self::Map => "Map",
            Self::Checks => "Checks",
            Self::Chart => "Chart",
            Self::Export => "Export",
        }
    }
}

/// The panels as they are at first: gallery and scene on the left, the picture over the map, numbers on the right.
pub(crate) fn default_layout() -> Tree<Pane> {
    let mut tiles = Tiles::default();
    let tabs = |tiles: &mut Tiles<Pane>, panes: &[Pane]| {
        let children = panes.iter().map(|pane| tiles.insert_pane(*pane)).collect();
        tiles.insert_tab_tile(children)
    };
    let left = tabs(&mut tiles, &[Pane::Presets, Pane::Scene]);
    let view = tabs(&mut tiles, &[Pane::View]);
    let map = tabs(&mut tiles, &[Pane::Map, Pane::Checks, Pane::Chart]);
    let right = tabs(&mut tiles, &[Pane::Strokes, Pane::Shading, Pane::Export]);
    let middle = split(&mut tiles, LinearDir::Vertical, &[(view, 0.68), (map, 0.32)]);
    let root = split(&mut tiles, LinearDir::Horizontal, &[(left, 0.17), (middle, 0.57), (right, 0.26)]);
    Tree::new(egui::Id::unique("panels"), root, tiles)
}

fn split(tiles: &mut Tiles<Pane>, dir: LinearDir, children: &[(TileId, f32)]) -> TileId {
    let mut linear = Linear::new(dir, children.iter().map(|(child, _)| *child).collect());
    for (child, share) in children {
        linear.shares.set_share(*child, *share);
    }
    tiles.insert_container(Container::Linear(linear))
}

/// Whether every panel is there exactly once; a file may say anything.
pub(crate) fn is_whole(tree: &Tree<Pane>) -> bool {
    let panes =
        |wanted: Pane| tree.tiles.tiles().filter(|tile| matches!(tile, Tile::Pane(pane) if *pane == wanted)).count();
    tree.root().is_some() && Pane::ALL.into_iter().all(|pane| panes(pane) == 1)
}
