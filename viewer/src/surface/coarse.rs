//! A surface in fewer nodes, for meshes that are finer than what strokes follow: its nodes are clusters of those of the
//! finer graph, about as far apart everywhere. Directions and patches are found on it and carried back to all nodes.
//!
//! ```text
//! graph ─► clusters ─► coarse graph ─► curvature, field, patches ─► nodes of the graph, by the clusters around them
//! ```

use std::borrow::Cow;
use std::cmp::Reverse;
use std::collections::BinaryHeap;

use faer::c64;
use glam::DQuat;
use rayon::prelude::*;

use super::curvature::{self, Curvature};
use super::field::Field;
use super::graph::Graph;
use super::patches::{Ordered, PatchOptions};
use crate::stage::Held;

/// Distance over which a cluster is felt, in radii of clusters: those around a node, and no others.
const FELT: f64 = 1.6;

/// How many nodes a cluster has at least in the mean, or it is not worth it.
const WORTH: usize = 6;

/// No cluster yet.
const NONE: u32 = u32::MAX;

/// What patches are laid out on: all nodes of a surface, or those of its clusters.
pub(crate) struct Ground<'a> {
    pub(crate) graph: &'a Graph,
    pub(crate) curvatures: Cow<'a, [Curvature]>,
    pub(crate) field: &'a Field,
    /// Where they are clusters.
    pub(crate) coarse: Option<&'a Coarse>,
}

/// Clusters of a finer graph.
#[derive(Clone, Debug)]
pub(crate) struct Coarse {
    /// How far nodes are from the first of their cluster, in mesh units.
    pub(crate) radius: f64,
    /// A node for each cluster: it stands where the cluster's first node does, with the mean normal.
    pub(crate) graph: Graph,
    /// Per cluster, that first node.
    pub(crate) centres: Vec<u32>,
    /// Per cluster: times a direction in its frame, it gives the same direction in its first node's.
    pub(crate) to_centres: Vec<c64>,
    /// Per node of the finer graph, its cluster.
    pub(crate) clusters: Vec<u32>,
    members: Lists<u32>,
    around: Lists<Near>,
}

/// A cluster near a node.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Near {
    pub(crate) cluster: u32,
    /// All of a node add up to 1.
    pub(crate) weight: f32,
}

/// Lists of different lengths in one array.
#[derive(Clone, Debug)]
struct Lists<T> {
    starts: Vec<u32>,
    items: Vec<T>,
}

impl<T> Lists<T> {
    fn of(&self, index: usize) -> &[T] {
        &self.items[self.starts[index] as usize..self.starts[index + 1] as usize]
    }
}

impl Coarse {
    /// Clusters of nodes up to `radius` from their first, in mesh units; `None` where the mesh is hardly finer than that.
    ///
    /// The same for any number of threads.
    pub(crate) fn new(fine: &Graph, radius: f64) -> Option<Self> {
        // Two links are no distance: most clusters would have few nodes.
        if fine.is_empty() || radius.is_nan() || radius < 2.0 * fine.mean_link() {
            return None;
        }
        let (centres, clusters) = clusters(fine, radius);
        if WORTH * centres.len() > fine.len() {
            return None;
        }
        let members = members(&clusters, centres.len());
        let graph = graph(fine, &centres, &clusters, &members);
        let to_centres = centres.iter().enumerate().map(|(i, centre)| carried(&graph, i, fine, *centre as usize));
        let to_centres = to_centres.collect();
        let around = around(fine, &graph, &clusters, FELT * radius);
        Some(Self { radius, graph, centres, to_centres, clusters, members, around })
    }

    /// Whether such patches may be laid out on it. Clusters that touch are one and a half radii apart in the mean; what is
    /// flat is flat for each node.
    pub(crate) fn serves(&self, options: &PatchOptions) -> bool {
        !options.planar && options.longest_edge() > 1.5 * self.radius
    }

    /// Nodes of a cluster.
    pub(crate) fn members(&self, cluster: u32) -> &[u32] {
        self.members.of(cluster as usize)
    }

    /// Clusters near a node; one at least.
    pub(crate) fn around(&self, node: u32) -> &[Near] {
        self.around.of(node as usize)
    }

    /// At all nodes of the finer graph the mean of what is known of the clusters around.
    pub(crate) fn spread(&self, of_clusters: &[f64]) -> Vec<f64> {
        let mean = |node| -> f64 {
            let near = self.around(node as u32).iter();
            near.map(|near| f64::from(near.weight) * of_clusters[near.cluster as usize]).sum()
        };
        (0..self.clusters.len()).into_par_iter().map(mean).collect()
    }

    /// A field of the clusters at all nodes of the finer graph.
    pub(crate) fn field(&self, fine: &Graph, field: &Field) -> Field {
        let of_clusters: Vec<c64> = field.doubled().iter().zip(&field.strengths).map(|(z, s)| z * s).collect();
        let at = |node: usize| {
            let near = self.around(node as u32).iter();
            let carried = near.map(|near| {
                let turn = carried(&self.graph, near.cluster as usize, fine, node);
                of_clusters[near.cluster as usize] * turn * turn * f64::from(near.weight)
            });
            let z: c64 = carried.sum();
            (z.arg() / 2.0, z.norm().min(1.0))
        };
        let (angles_rad, strengths) = (0..fine.len()).into_par_iter().map(at).unzip();
        Field { angles_rad, strengths }
    }
}

/// Times a direction in the frame of one graph's node, it gives the same direction in that of another's, carried over by
/// the least rotation that turns the one normal into the other.
fn carried(from: &Graph, a: usize, to: &Graph, b: usize) -> c64 {
    to.flat(b, DQuat::from_rotation_arc(from.normals[a], to.normals[b]) * from.tangents[a])
}

/// First nodes of the clusters, and of each node the cluster: the nearest along the surface.
fn clusters(graph: &Graph, radius: f64) -> (Vec<u32>, Vec<u32>) {
    let mut centres = Vec::new();
    let mut clusters = vec![NONE; graph.len()];
    let mut distance = vec![f64::INFINITY; graph.len()];
    let mut heap: BinaryHeap<Reverse<(Ordered, u32)>> = BinaryHeap::new();
    for first in 0..graph.len() as u32 {
        if clusters[first as usize] != NONE {
            continue;
        }
        let cluster = centres.len() as u32;
        centres.push(first);
        clusters[first as usize] = cluster;
        distance[first as usize] = 0.0;
        heap.push(Reverse((Ordered(0.0), first)));
        while let Some(Reverse((Ordered(reached), node))) = heap.pop() {
            if reached > distance[node as usize] {
                continue;
            }
            for end in graph.ends(node as usize) {
                let link = graph.positions[node as usize].distance(graph.positions[end.node as usize]);
                let next = reached + link;
                if next <= radius && next < distance[end.node as usize] {
                    distance[end.node as usize] = next;
                    clusters[end.node as usize] = cluster;
                    heap.push(Reverse((Ordered(next), end.node)));
                }
            }
        }
    }
    (centres, clusters)
}

fn members(clusters: &[u32], count: usize) -> Lists<u32> {
    let mut starts = vec![0; count + 1];
    clusters.iter().for_each(|cluster| starts[*cluster as usize + 1] += 1);
    for cluster in 0..count {
        starts[cluster + 1] += starts[cluster];
    }
    let mut next = starts.clone();
    let mut items = vec![0; clusters.len()];
    for (node, cluster) in clusters.iter().enumerate() {
        let at = &mut next[*cluster as usize];
        items[*at as usize] = node as u32;
        *at += 1;
    }
    Lists { starts, items }
}

/// Clusters that touch are linked; where three meet is a triangle.
fn graph(fine: &Graph, centres: &[u32], clusters: &[u32], members: &Lists<u32>) -> Graph {
    let of_corners = |triangle: &[u32; 3]| triangle.map(|node| clusters[node as usize]);
    let triangles = fine.triangles.par_iter().map(of_corners);
    let triangles = triangles.filter(|[a, b, c]| a != b && b != c && c != a).collect();
    let touching = fine.links.par_iter().map(|link| [link.a, link.b].map(|node| clusters[node as usize]));
    let touching: Vec<[u32; 2]> = touching.filter(|[a, b]| a != b).collect();
    let sums = |cluster: usize| {
        let members = || members.of(cluster).iter().map(|node| *node as usize);
        let normal = members().map(|node| fine.normals[node] * fine.areas[node].max(1e-14)).sum::<glam::DVec3>();
        let normal = normal.try_normalize().unwrap_or(fine.normals[centres[cluster] as usize]);
        (normal, members().map(|node| fine.areas[node]).sum::<f64>())
    };
    let (normals, areas) = (0..centres.len()).into_par_iter().map(sums).unzip();
    let positions = centres.iter().map(|centre| fine.positions[*centre as usize]).collect();
    let node_of_vertex = fine.node_of_vertex.par_iter().map(|node| clusters[*node as usize]).collect();
    Graph::of_nodes(positions, normals, areas, triangles, &touching, node_of_vertex)
}

/// The clusters near each node: its own and those that touch it, by their distances.
fn around(fine: &Graph, coarse: &Graph, clusters: &[u32], reach: f64) -> Lists<Near> {
    let near = |node: usize| {
        let own = clusters[node];
        let ends = coarse.ends(own as usize).iter().map(|end| end.node);
        let weighed = std::iter::once(own).chain(ends).filter_map(|cluster| {
            let at = cluster as usize;
            let away = fine.positions[node].distance_squared(coarse.positions[at]) / (reach * reach);
            let same_side = coarse.normals[at].dot(fine.normals[node]) > 0.0;
            let weight = if same_side { (1.0 - away).max(0.0).powi(2) } else { 0.0 };
            // Something must be near every node.
            let weight = if cluster == own { weight.max(1e-3) } else { weight };
            (weight > 0.0).then_some((cluster, weight))
        });
        let weighed: Vec<(u32, f64)> = weighed.collect();
        let total: f64 = weighed.iter().map(|(_, weight)| weight).sum();
        weighed.into_iter().map(move |(cluster, weight)| Near { cluster, weight: (weight / total) as f32 })
    };
    // In blocks, each with an array of its own.
    const BLOCK: usize = 1 << 12;
    let block = |block: usize| {
        let nodes = block * BLOCK..((block + 1) * BLOCK).min(fine.len());
        let mut lists = (Vec::with_capacity(nodes.len()), Vec::with_capacity(5 * nodes.len()));
        for node in nodes {
            lists.1.extend(near(node));
            lists.0.push(lists.1.len() as u32);
        }
        lists
    };
    let blocks: Vec<(Vec<u32>, Vec<Near>)> = (0..fine.len().div_ceil(BLOCK)).into_par_iter().map(block).collect();
    let mut lists = Lists { starts: vec![0], items: Vec::new() };
    for (ends, items) in blocks {
        let before = lists.items.len() as u32;
        lists.starts.extend(ends.into_iter().map(|end| before + end));
        lists.items.extend(items);
    }
    lists
}

impl Held for Option<Coarse> {
    fn held(&self) -> usize {
        self.as_ref().map_or(0, |coarse| {
            let lists = coarse.members.starts.held() + coarse.members.items.held();
            let around = coarse.around.starts.held() + coarse.around.items.held();
            coarse.graph.held()
                + coarse.centres.held()
                + coarse.to_centres.held()
                + coarse.clusters.held()
                + lists
                + around
        })
    }
}

/// Radius of clusters on which curvature and field lose nothing: a part of the neighbourhood over which the one is
/// averaged.
pub(crate) fn radius_of_fields(graph: &Graph) -> f64 {
    curvature::RADIUS * graph.diagonal() / 3.0
}

#[cfg(test)]
mod tests {
    use super::super::curvature::{curvatures, curvatures_on};
    use super::super::field::{FieldOptions, field};
    use super::super::patches::{Patches, patches, patches_on};
    use super::*;
    use crate::mesh::sample::Sample;
    use crate::mesh::{Mesh, prepare};

    /// A mesh, its graph and clusters of about twenty nodes.
    fn clustered(sample: Sample) -> (Mesh, Graph, Coarse) {
        let mesh = prepare(sample.build(60_000)).expect("a sample").mesh;
        let graph = Graph::new(&mesh);
        let coarse = Coarse::new(&graph, 2.5 * graph.mean_link()).expect("clusters");
        (mesh, graph, coarse)
    }

    #[test]
    fn clusters_hold_all_nodes_and_are_about_as_far_apart_everywhere() {
        for sample in [Sample::Hand, Sample::Teapot] {
            let (_, graph, coarse) = clustered(sample);
            let count = coarse.centres.len();
            assert!((6 * count..60 * count).contains(&graph.len()), "{count} clusters of {} nodes", graph.len());
            for cluster in 0..count as u32 {
                let centre = coarse.centres[cluster as usize];
                assert!(coarse.members(cluster).contains(&centre));
                for node in coarse.members(cluster) {
                    let away = graph.positions[*node as usize].distance(graph.positions[centre as usize]);
                    assert!(coarse.clusters[*node as usize] == cluster && away <= coarse.radius);
                }
            }
            let members: usize = (0..count as u32).map(|cluster| coarse.members(cluster).len()).sum();
            assert_eq!(members, graph.len());
            let area = |graph: &Graph| graph.areas.iter().sum::<f64>();
            assert!((area(&coarse.graph) / area(&graph) - 1.0).abs() < 1e-9);
            // What is the same everywhere stays so.
            assert!(coarse.spread(&vec![3.0; count]).iter().all(|mean| (mean - 3.0).abs() < 1e-5));
            assert!((0..count).all(|cluster| !coarse.graph.ends(cluster).is_empty()), "none stands alone");
        }
    }

    #[test]
    fn meshes_that_are_no_finer_have_no_clusters() {
        let graph = Graph::new(&prepare(Sample::Hand.build(20_000)).expect("a hand").mesh);
        assert!(Coarse::new(&graph, radius_of_fields(&graph)).is_none());
        assert!(Coarse::new(&graph, f64::NAN).is_none());
        assert!(Coarse::new(&Graph::default(), 1.0).is_none());
    }

    /// Mean angle in degrees between two fields, weighed by area and by how clear both are.
    fn apart_deg(graph: &Graph, a: &Field, b: &Field) -> f64 {
        let (mut sum, mut total) = (0.0, 0.0);
        for node in 0..graph.len() {
            let weight = graph.areas[node] * a.strengths[node] * b.strengths[node];
            let cos = a.direction(graph, node).dot(b.direction(graph, node)).abs().min(1.0);
            sum += weight * cos.acos().to_degrees();
            total += weight;
        }
        sum / total
    }

    #[test]
    fn directions_and_patches_found_on_clusters_are_those_of_all_nodes() {
        for (sample, most_deg) in [(Sample::Torus, 0.5), (Sample::Hand, 4.0), (Sample::Head, 4.0)] {
            let (mesh, graph, coarse) = clustered(sample);
            let options = FieldOptions::default();
            let of_nodes = curvatures(&graph);
            let alone = field(&graph, &mesh, &of_nodes, &options).expect("a field");
            let curvatures = curvatures_on(&graph, &coarse.graph, |node| coarse.clusters[node as usize]);
            let of_clusters = field(&coarse.graph, &mesh, &curvatures, &options).expect("a field");
            let carried = coarse.field(&graph, &of_clusters);
            let apart = apart_deg(&graph, &alone, &carried);
            assert!(apart < most_deg, "{}: {apart} degrees", sample.name());

            // As large as they are where clusters of this size are used.
            let options = PatchOptions { tiles_per_unit: 0.7, ..PatchOptions::default() };
            assert!(coarse.serves(&options), "{}", sample.name());
            let direct = patches(&graph, &of_nodes, &alone, &options);
            let ground = Ground {
                graph: &coarse.graph,
                curvatures: curvatures.into(),
                field: &of_clusters,
                coarse: Some(&coarse),
            };
            let made = patches_on(&ground, &graph, &carried, &options);
            if sample == Sample::Hand {
                // The same for any number of threads.
                let pool = rayon::ThreadPoolBuilder::new().num_threads(1).build().expect("a pool");
                let (field, patches) = pool.install(|| {
                    let coarse = Coarse::new(&graph, coarse.radius).expect("clusters");
                    let field = coarse.field(&graph, &of_clusters);
                    let ground = Ground { coarse: Some(&coarse), curvatures: ground.curvatures.clone(), ..ground };
                    (field, patches_on(&ground, &graph, &carried, &options))
                });
                assert!(field == carried && patches == made);
            }
            let [seeds, expected] = [&made, &direct].map(|patches| patches.seeds.len() as f64);
            assert!((seeds / expected - 1.0).abs() < 0.15, "{}: {seeds} patches for {expected}", sample.name());
            let alone = |patches: &Patches| patches.entries.iter().filter(|entry| entry.seed == u32::MAX).count();
            assert!(
                alone(&made) <= alone(&direct) + mesh.triangles.len() / 2_000,
                "{}: {}",
                sample.name(),
                alone(&made)
            );
            let [stretch, expected] = [&made, &direct].map(|patches| stretch(&graph, patches, &options));
            assert!(stretch < 1.15 * expected + 0.003, "{}: {stretch} for {expected}", sample.name());
        }
    }

    /// By how much places change lengths, where patches weigh: the mean of the amounts of ln(found / true).
    fn stretch(graph: &Graph, patches: &Patches, options: &PatchOptions) -> f64 {
        let (mut sum, mut total) = (0.0, 0.0);
        for (face, nodes) in graph.triangles.iter().enumerate() {
            for entry in patches.of(face).iter().filter(|entry| entry.behind.iter().all(|behind| *behind < 1.0)) {
                for k in 0..3 {
                    let [a, b] = [k, (k + 1) % 3];
                    let found = f64::from(entry.uv[a].distance(entry.uv[b])) / options.tiles_per_unit;
                    let length = graph.positions[nodes[a] as usize].distance(graph.positions[nodes[b] as usize]);
                    sum += length * (found / length).max(1e-3).ln().abs();
                    total += length;
                }
            }
        }
        sum / total
    }
}
