//! Guides: strokes that a person draws on the surface to say which way hatching runs.
//!
//! A file is JSON: `{"version": 1, "guides": [{"points": [[x, y, z], …]}, …]}`, in mesh space, where a mesh is
//! centred and 2 units long.

use std::collections::BTreeMap;
use std::path::Path;

use glam::DVec3;

use super::graph::Graph;

/// One stroke on the surface.
#[derive(Clone, Debug, PartialEq, serde::Serialize, serde::Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Guide {
    /// Its points in mesh space, at least two.
    pub points: Vec<DVec3>,
}

/// A node where a guide passes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Anchor {
    pub node: usize,
    /// In mesh space, any length above 0.
    pub direction: DVec3,
    pub weight: f64,
}

/// Why a file of guides cannot be used.
#[derive(Debug, thiserror::Error)]
pub enum GuideError {
    /// The file cannot be read.
    #[error("{0}")]
    Read(#[from] std::io::Error),
    /// It is no JSON, or not of this shape.
    #[error("{0}")]
    Shape(#[from] serde_json::Error),
    /// It is of another version.
    #[error("guides of version {0}; this program reads version {VERSION}")]
    Version(u32),
    /// A guide has too few points, or some that are no numbers.
    #[error("guide {index} {what}")]
    Guide {
        /// Which, from 1.
        index: usize,
        /// What is wrong.
        what: &'static str,
    },
    /// There are too many points.
    #[error("{points} points; at most {MAX_POINTS} are taken")]
    TooMany {
        /// How many.
        points: usize,
    },
}

/// Version of the files.
const VERSION: u32 = 1;

/// Points of all guides of a file together.
pub const MAX_POINTS: usize = 1_000_000;

/// Places of all guides together that are looked up on the surface, about: a segment has one at least.
const MAX_SAMPLES: f64 = 1e5;

/// Largest file that is read, in bytes.
const MAX_BYTES: u64 = 64 << 20;

#[derive(serde::Serialize, serde::Deserialize)]
#[serde(deny_unknown_fields)]
struct GuideFile {
    version: u32,
    guides: Vec<Guide>,
}

/// The guides of a JSON text.
///
/// # Errors
/// [`GuideError`] if it has another shape or version, or guides that are none.
pub fn parse(text: &str) -> Result<Vec<Guide>, GuideError> {
    let file: GuideFile = serde_json::from_str(text)?;
    if file.version != VERSION {
        return Err(GuideError::Version(file.version));
    }
    let points = file.guides.iter().map(|guide| guide.points.len()).sum();
    if points > MAX_POINTS {
        return Err(GuideError::TooMany { points });
    }
    for (index, guide) in file.guides.iter().enumerate() {
        let index = index + 1;
        if guide.points.len() < 2 {
            return Err(GuideError::Guide { index, what: "has less than two points" });
        }
        if !guide.points.iter().all(|point| point.is_finite() && point.abs().max_element() < 1e6) {
            return Err(GuideError::Guide { index, what: "has a point beyond a million units" });
        }
        if guide.points.windows(2).all(|pair| pair[0] == pair[1]) {
            return Err(GuideError::Guide { index, what: "has no length" });
        }
    }
    Ok(file.guides)
}

/// The guides of a file.
///
/// # Errors
/// [`GuideError`], as [`parse`], or if the file cannot be read.
pub fn read(path: &Path) -> Result<Vec<Guide>, GuideError> {
    if std::fs::metadata(path)?.len() > MAX_BYTES {
        return Err(std::io::Error::other(format!("the file is larger than {} MiB", MAX_BYTES >> 20)).into());
    }
    parse(&std::fs::read_to_string(path)?)
}

/// The text of a file of guides.
pub fn to_text(guides: &[Guide]) -> String {
    let file = GuideFile { version: VERSION, guides: guides.to_vec() };
    serde_json::to_string_pretty(&file).unwrap_or_default()
}

/// The nodes nearest to the guides, each once, with the mean direction there.
pub(crate) fn anchors(graph: &Graph, guides: &[Guide]) -> Vec<Anchor> {
    if graph.is_empty() || guides.is_empty() {
        return Vec::new();
    }
    let pairs = || guides.iter().flat_map(|guide| guide.points.windows(2));
    let length: f64 = pairs().map(|pair| pair[0].distance(pair[1])).sum();
    // Twice in a link; guides that go on for thousands of meshes less often.
    let step = (0.5 * graph.mean_link()).max(length / MAX_SAMPLES).max(1e-9);
    let mut directions: BTreeMap<usize, DVec3> = BTreeMap::new();
    let nearest = Nearest::new(graph, 2.0 * graph.mean_link().max(1e-9));
    for pair in pairs() {
        let along = pair[1] - pair[0];
        let samples = (along.length() / step).ceil().max(1.0) as usize;
        for i in 0..samples {
            let place = pair[0] + along * ((i as f64 + 0.5) / samples as f64);
            let node = nearest.node(graph, place);
            let sum = directions.entry(node).or_default();
            // Guides have no sign.
            *sum += if sum.dot(along) < 0.0 { -along } else { along } / samples as f64;
        }
    }
    let anchor = |(node, direction)| Anchor { node, direction, weight: 1.0 };
    directions.into_iter().filter(|(_, direction)| direction.length_squared() > 0.0).map(anchor).collect()
}

/// Nodes by the cells of a grid.
struct Nearest {
    cell: f64,
    nodes: BTreeMap<[i64; 3], Vec<usize>>,
}

impl Nearest {
    fn new(graph: &Graph, cell: f64) -> Self {
        let mut nodes: BTreeMap<[i64; 3], Vec<usize>> = BTreeMap::new();
        for (node, place) in graph.positions.iter().enumerate() {
            nodes.entry(Self::key(*place, cell)).or_default().push(node);
        }
        Self { cell, nodes }
    }

    fn key(place: DVec3, cell: f64) -> [i64; 3] {
        (place / cell).floor().to_array().map(|x| x as i64)
    }

    fn node(&self, graph: &Graph, place: DVec3) -> usize {
        let [x, y, z] = Self::key(place, self.cell);
        let distance = |node: &usize| graph.positions[*node].distance_squared(place);
        let close = (-1..=1)
            .flat_map(|i| (-1..=1).flat_map(move |j| (-1..=1).map(move |k| [x + i, y + j, z + k])))
            .filter_map(|key| self.nodes.get(&key))
            .flatten()
            .copied();
        let best = |nodes: &mut dyn Iterator<Item = usize>| nodes.min_by(|a, b| distance(a).total_cmp(&distance(b)));
        // Beside the surface: look everywhere.
        best(&mut close.into_iter()).or_else(|| best(&mut (0..graph.len()))).unwrap_or(0)
    }
}
