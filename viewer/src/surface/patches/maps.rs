//! What each patch reaches, and where it lies on its tile.

use std::sync::{Mutex, PoisonError};

use faer::c64;
use glam::{DVec2, Vec2};
use rayon::prelude::*;

use super::bend::Bend;
use super::exp_map::{Explorer, Visit};
use super::{PatchOptions, Seed, seeds};
use crate::params::Follow;
use crate::stage::Held;
use crate::surface::coarse::{Coarse, Ground};
use crate::surface::graph::Graph;

/// How far a patch reaches, in spacings: its own cell, the feather, and the corners of triangles beyond.
const REACH: f64 = 1.9;

/// One patch before triangles know it.
pub(super) struct Map {
    pub(super) seed: Seed,
    pub(super) reached: Vec<Reached>,
}

impl Held for Vec<Map> {
    fn held(&self) -> usize {
        self.iter().map(|map| map.reached.held()).sum()
    }
}

/// A node in a patch.
#[derive(Clone, Copy)]
pub(super) struct Reached {
    pub(super) node: u32,
    /// Place in the patch along the field, in mesh units: the seed is the origin.
    pub(super) place: Vec2,
    /// Distance to the seed in the metric, in mesh units.
    pub(super) distance: f32,
}

/// The patches around `seeds`, nodes of the ground; what they reach are nodes of `graph`.
pub(super) fn maps(
    ground: &Ground<'_>,
    graph: &Graph,
    density: &[f64],
    seeds: &[u32],
    options: &PatchOptions,
) -> Vec<Map> {
    let spacing = options.spacing_tiles / options.tiles_per_unit;
    let doubled = ground.field.doubled();
    let finer = ground.coarse.map(|coarse| Finer { coarse, graph, density: coarse.spread(density) });
    // As many as there are threads, however the work is shared out.
    let idle: Mutex<Vec<Explorer>> = Mutex::default();
    let map = |(index, &node): (usize, &u32)| {
        let taken = idle.lock().unwrap_or_else(PoisonError::into_inner).pop();
        let mut explorer = taken.unwrap_or_else(|| Explorer::new(ground.graph.len(), options.planar));
        let (seed, axis) = match ground.coarse {
            Some(coarse) => (coarse.centres[node as usize], coarse.to_centres[node as usize]),
            None => (node, c64::new(1.0, 0.0)),
        };
        let visits = explorer.explore(ground.graph, density, node, axis, REACH * spacing);
        let dense = density[node as usize];
        let bend = Bend::fit(ground.graph, ground.field, &doubled, &visits, spacing / dense, options);
        let reached = |node: u32, place: DVec2, radius: f64, density: f64| Reached {
            node,
            place: bend.place(place).as_vec2(),
            distance: (radius * 0.5 * (dense + density)) as f32,
        };
        let reached = match &finer {
            Some(finer) => {
                finer.places(&explorer, &visits, |node, place, density| reached(node, place, place.length(), density))
            }
            None => {
                let of = |visit: &Visit| reached(visit.node, visit.place, visit.radius, density[visit.node as usize]);
                visits.iter().map(of).collect()
            }
        };
        idle.lock().unwrap_or_else(PoisonError::into_inner).push(explorer);
        let follows = options.follow == Follow::Light;
        let offset_uv = if follows { [0.0; 2] } else { seeds::offset(index, 0) };
        Map { seed: Seed { node: seed, angle_rad: bend.angle_rad, offset_uv }, reached }
    };
    seeds.par_iter().enumerate().map(map).collect()
}

/// Nodes between those on which patches are laid out.
struct Finer<'a> {
    coarse: &'a Coarse,
    graph: &'a Graph,
    /// Per node.
    density: Vec<f64>,
}

impl Finer<'_> {
    /// The nodes of all clusters that were visited, each predicted from those around that were.
    fn places(
        &self,
        explorer: &Explorer,
        visits: &[Visit],
        reached: impl Fn(u32, DVec2, f64) -> Reached,
    ) -> Vec<Reached> {
        let place = |node: u32| {
            let (mut sum, mut total) = (DVec2::ZERO, 0.0);
            for near in self.coarse.around(node) {
                let Some(visit) = visits.get(explorer.visited(near.cluster)) else { continue };
                let cluster = near.cluster as usize;
                let step = self.graph.positions[node as usize] - self.coarse.graph.positions[cluster];
                let along = self.coarse.graph.flat(cluster, step) * visit.turn * step.length();
                let weight = f64::from(near.weight);
                sum += weight * (visit.place + DVec2::new(along.re, along.im));
                total += weight;
            }
            reached(node, sum / total, self.density[node as usize])
        };
        visits.iter().flat_map(|visit| self.coarse.members(visit.node)).map(|node| place(*node)).collect()
    }
}
