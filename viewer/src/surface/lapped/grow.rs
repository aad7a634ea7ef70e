//! A patch grown over neighbouring triangles while they meet its outline, and laid flat again as it grows.
//!
//! It stays a topological disc, so that each node has one place in it: where a patch comes round a finger and would meet
//! itself, it ends. It also ends where the field turns too much to be followed, and does not reach round such places: what
//! lies behind a singularity is left to other patches.

use std::cmp::Reverse;
use std::collections::BinaryHeap;

use glam::DVec2;

use super::faces::{Face, NONE};
use super::flatten::{Member, flatten};
use super::outline::{Outline, nearest};
use crate::surface::graph::Graph;
use crate::surface::solve::SolveError;

/// Greatest angle between the direction on a triangle and the patch that it joins.
const GREATEST_TURN_COSINE: f64 = 0.707;

/// How many times longer than the straight line in the tile the way to a node through the patch may be.
const GREATEST_DETOUR: f64 = 1.2;

/// A patch is laid flat first at this many triangles, then whenever they have doubled.
const FIRST_FLATTENED: usize = 16;

/// Times that a patch is laid flat at most.
const ROUNDS: usize = 24;

/// A round that adds less than this share of the triangles is the last one.
const LEAST_GROWTH: f64 = 0.02;

/// Part of a surface, laid flat.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct Patch {
    /// Nodes of the graph.
    pub(super) nodes: Vec<u32>,
    /// Per node its place in tiles; the middle of the seed is the origin.
    pub(super) places: Vec<DVec2>,
    /// Per node the length of the way through the patch to the middle of the seed, in tiles.
    pub(super) ways: Vec<f64>,
    /// Triangles; the seed is the first.
    pub(super) members: Vec<Member>,
    /// Edges, as indices of nodes, beyond which there are triangles that did not join.
    pub(super) rim: Vec<[u32; 2]>,
}

/// Grows one patch after the other with the same memory.
pub(super) struct Grower<'a> {
    graph: &'a Graph,
    faces: &'a [Face],
    tiles_per_unit: f64,
    /// Per node of the graph its index in the patch, or [`NONE`].
    local: Vec<u32>,
    /// Per triangle whether it is in the patch.
    joined: Vec<bool>,
    /// Triangles that may join: the nearest to the centre first. The bits of numbers from 0 on sort as they do.
    next: BinaryHeap<Reverse<(u64, u32)>>,
    patch: Patch,
}

impl<'a> Grower<'a> {
    pub(super) fn new(graph: &'a Graph, faces: &'a [Face], tiles_per_unit: f64) -> Self {
        Self {
            graph,
            faces,
            tiles_per_unit,
            local: vec![NONE; graph.len()],
            joined: vec![false; faces.len()],
            next: BinaryHeap::new(),
            patch: Patch::default(),
        }
    }

    /// The patch around a triangle.
    pub(super) fn grow(&mut self, seed: u32, outline: &Outline) -> Result<Patch, SolveError> {
        self.start(seed);
        // A triangle without a plane of its own says nothing about where others lie.
        if !self.faces[seed as usize].is_sliver() {
            self.fill(outline)?;
        }
        self.patch.rim = self.rim();
        Ok(self.finish())
    }

    /// The seed alone, as it lies in its plane.
    pub(super) fn alone(&mut self, seed: u32) -> Patch {
        self.start(seed);
        self.finish()
    }

    fn finish(&mut self) -> Patch {
        self.patch.nodes.iter().for_each(|node| self.local[*node as usize] = NONE);
        self.patch.members.iter().for_each(|member| self.joined[member.face as usize] = false);
        std::mem::take(&mut self.patch)
    }

    fn start(&mut self, seed: u32) {
        let corners = self.faces[seed as usize].corners;
        let middle = (corners[0] + corners[1] + corners[2]) / 3.0;
        let nodes = self.graph.triangles[seed as usize];
        for (node, corner) in nodes.into_iter().zip(corners) {
            let place = (corner - middle) * self.tiles_per_unit;
            self.place(node, place, place.length());
        }
        self.join(seed, 1.0);
    }

    fn place(&mut self, node: u32, place: DVec2, way: f64) {
        self.local[node as usize] = self.patch.nodes.len() as u32;
        self.patch.nodes.push(node);
        self.patch.places.push(place);
        self.patch.ways.push(way);
    }

    fn join(&mut self, face: u32, sign: f64) {
        let nodes = self.graph.triangles[face as usize].map(|node| self.local[node as usize]);
        self.joined[face as usize] = true;
        self.patch.members.push(Member { face, nodes, sign });
    }

    /// Grows and flattens in turns until nothing joins any more.
    fn fill(&mut self, outline: &Outline) -> Result<(), SolveError> {
        let mut flattened = 1;
        for _ in 0..ROUNDS {
            self.next.clear();
            for member in 0..self.patch.members.len() {
                self.push_neighbours(self.patch.members[member], outline);
            }
            let enough = (2 * flattened).max(FIRST_FLATTENED);
            while self.patch.members.len() < enough {
                let Some(Reverse((_, face))) = self.next.pop() else { break };
                let Some(sign) = self.fits(face) else { continue };
                if self.add(face, sign)
                    && let Some(member) = self.patch.members.last()
                {
                    self.push_neighbours(*member, outline);
                }
            }
            let count = self.patch.members.len();
            if count == flattened {
                break;
            }
            flatten(self.faces, &self.patch.members, self.tiles_per_unit, &mut self.patch.places)?;
            self.centre();
            if count < enough && ((count - flattened) as f64) < LEAST_GROWTH * count as f64 {
                break;
            }
            flattened = count;
        }
        Ok(())
    }

    /// Triangles beyond those edges of a member that meet the outline.
    fn push_neighbours(&mut self, member: Member, outline: &Outline) {
        for (k, other) in self.faces[member.face as usize].neighbours.into_iter().enumerate() {
            if other == NONE || self.joined[other as usize] {
                continue;
            }
            let [from, to] = [k, (k + 1) % 3].map(|k| self.patch.places[member.nodes[k] as usize]);
            if outline.meets(from, to) {
                self.next.push(Reverse((nearest(DVec2::ZERO, from, to).length().to_bits(), other)));
            }
        }
    }

    /// Whether a triangle may join, and then its sign.
    fn fits(&self, face: u32) -> Option<f64> {
        if self.joined[face as usize] {
            return None;
        }
        let Face { corners, neighbours } = self.faces[face as usize];
        let known = self.graph.triangles[face as usize].map(|node| self.local[node as usize]);
        let shared = neighbours.map(|other| other != NONE && self.joined[other as usize]);
        // What it shares with the patch must be one unbroken line: an edge, or two; else it would not stay a disc.
        let edges = shared.into_iter().filter(|shared| *shared).count();
        let disc = match edges {
            1 => known.into_iter().filter(|known| *known != NONE).count() == 2,
            edges => edges == 2,
        };
        if !disc {
            return None;
        }
        // Its edges as its own plane has them, against their places in the patch.
        let products = [0, 1, 2].map(|k| {
            if !shared[k] {
                return (0.0, 0.0);
            }
            let [from, to] = [known[k], known[(k + 1) % 3]].map(|node| self.patch.places[node as usize]);
            let own = corners[(k + 1) % 3] - corners[k];
            (own.dot(to - from), own.length() * (to - from).length())
        });
        let sign = if products.iter().map(|product| product.0).sum::<f64>() < 0.0 { -1.0 } else { 1.0 };
        let agrees = |(product, whole): (f64, f64)| sign * product >= GREATEST_TURN_COSINE * whole;
        products.into_iter().all(agrees).then_some(sign)
    }

    /// Adds a triangle that fits, its new node where the field has it, unless the way there is a detour.
    fn add(&mut self, face: u32, sign: f64) -> bool {
        let nodes = self.graph.triangles[face as usize];
        let corners = self.faces[face as usize].corners;
        if let Some(apex) = (0..3).find(|k| self.local[nodes[*k] as usize] == NONE) {
            let known = [(apex + 1) % 3, (apex + 2) % 3];
            let from = known.map(|k| self.local[nodes[k] as usize] as usize);
            let steps = known.map(|k| (corners[apex] - corners[k]) * (sign * self.tiles_per_unit));
            let [first, second] = [0, 1].map(|i| self.patch.places[from[i]] + steps[i]);
            let place = first.midpoint(second);
            let way = onward(steps, from.map(|node| self.patch.ways[node]));
            let slack = self.faces[face as usize].longest_edge() * self.tiles_per_unit;
            if way > GREATEST_DETOUR * place.length() + slack {
                return false;
            }
            self.place(nodes[apex], place, way);
        }
        self.join(face, sign);
        true
    }

    /// Moves the middle of the seed to the origin.
    fn centre(&mut self) {
        let Patch { places, members, .. } = &mut self.patch;
        let middle = members[0].nodes.iter().map(|node| places[*node as usize]).sum::<DVec2>() / 3.0;
        places.iter_mut().for_each(|place| *place -= middle);
    }

    fn rim(&self) -> Vec<[u32; 2]> {
        let members = self.patch.members.iter();
        members
            .flat_map(|member| {
                let neighbours = self.faces[member.face as usize].neighbours.into_iter().enumerate();
                neighbours
                    .filter(|(_, other)| *other != NONE && !self.joined[*other as usize])
                    .map(|(k, _)| [member.nodes[k], member.nodes[(k + 1) % 3]])
            })
            .collect()
    }
}

/// The way to the third corner of a triangle, from those to the other two; `steps` lead from these to it.
///
/// Straight on in the triangle's plane from where the ways seem to come from, as Kimmel and Sethian, "Computing geodesic
/// paths on manifolds", 1998, have it; round one of the two corners where that would pass beside their edge.
fn onward(steps: [DVec2; 2], ways: [f64; 2]) -> f64 {
    let round = (ways[0] + steps[0].length()).min(ways[1] + steps[1].length());
    let edge = steps[0] - steps[1];
    let length = edge.length();
    let axis = edge.try_normalize().unwrap_or(DVec2::ZERO);
    // The source, along the edge and off it, on the other side than the third corner.
    let along = (ways[0] * ways[0] - ways[1] * ways[1] + length * length) / (2.0 * length.max(1e-300));
    let off = (ways[0] * ways[0] - along * along).max(0.0).sqrt();
    let corner = DVec2::new(steps[0].dot(axis), steps[0].perp_dot(axis).abs());
    let crossing = along + (corner.x - along) * off / (off + corner.y).max(1e-300);
    if (0.0..=length).contains(&crossing) { corner.distance(DVec2::new(along, -off)).min(round) } else { round }
}
