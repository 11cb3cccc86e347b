// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! A tree of veins while it is found: ways over pixels, later thinned out to nodes.

use glam::Vec2;

use super::close_up::CloseUp;
use super::geodesic::NONE;
use super::labels::side_neighbours;
use super::veins::is_planar;
use crate::math::floor_i32;
use crate::{VeinGraph, VeinNode};

/// Half width of the midrib at the root, in √A.
const ROOT_RADIUS: f32 = 0.0065;
/// Half width of the thinnest vein's end, in √A.
const LEAST_RADIUS: f32 = 0.001;
/// Distance between nodes, in √A.
const SPACING: f32 = 0.0125;
/// Pixels on either side over which a way is smoothed.
const SMOOTHING: usize = 5;

/// Veins on a grid of pixels.
pub(super) struct VeinTree {
    width: usize,
    root: usize,
    /// True if a pixel belongs to a vein.
    on: Vec<bool>,
    /// Ways from where they join the tree to their end, and their order.
    ways: Vec<(Vec<usize>, u8)>,
}

impl VeinTree {
    /// A tree of a root only, on a grid of `count` pixels.
    pub(super) fn new(root: usize, width: usize, count: usize) -> Self {
        let mut on = vec![false; count];
        on[root] = true;
        Self { width, root, on, ways: Vec::new() }
    }

    /// Returns true if a pixel belongs to the tree.
    pub(super) fn has(&self, i: usize) -> bool {
        self.on[i]
    }

    /// Returns true if there is no vein yet.
    pub(super) fn is_bare(&self) -> bool {
        self.ways.is_empty()
    }

    /// Adds a way that leads from its end to a pixel of the tree.
    pub(super) fn add(&mut self, way: &[usize], order: u8) {
        if way.len() < 2 {
            return;
        }
        way.iter().for_each(|i| self.on[*i] = true);
        self.ways.push((way.iter().rev().copied().collect(), order));
    }

    /// Pixels from which further ways may start. Those that share a side with the tree and can be passed belong to
    /// it, so that no way slips through a diagonal step of another.
    pub(super) fn sources(&self, price: &[f32]) -> Vec<usize> {
        (0..self.on.len()).filter(|i| self.on[*i] && price[*i].is_finite()).collect()
    }

    /// The tree as nodes in the photo's pixels. Veins that cross once they are smoothed and thinned out are taken as they
    /// are, and the finest that still cross are left out: a few pixels of a mask may be all there is between two ways.
    pub(super) fn into_graph(mut self, close_up: &CloseUp) -> VeinGraph {
        let spacing = usize::try_from(floor_i32(SPACING * close_up.side)).unwrap_or(0).max(2);
        for (smoothing, spacing) in [(SMOOTHING, spacing), (0, spacing), (0, 1)] {
            let graph = self.graph(close_up, smoothing, spacing);
            if is_planar(&graph) {
                return graph;
            }
        }
        loop {
            self.ways.pop();
            let graph = self.graph(close_up, 0, 1);
            if self.ways.is_empty() || is_planar(&graph) {
                return graph;
            }
        }
    }

    /// Nodes every `spacing` pixels along ways that are smoothed over `smoothing` pixels on either side.
    fn graph(&self, close_up: &CloseUp, smoothing: usize, spacing: usize) -> VeinGraph {
        let centre = |i: usize| Vec2::new((i % self.width) as f32 + 0.5, (i / self.width) as f32 + 0.5);
        let first = VeinNode { position: centre(self.root), parent: None, order: 1, radius: 0.0 };
        let mut nodes = vec![first];
        // The node that stands for each pixel of the tree.
        let mut node_of = vec![NONE; self.on.len()];
        node_of[self.root] = 0;
        for (way, order) in &self.ways {
            let mut node = self.node_near(&node_of, way[0]);
            let last = way.len() - 1;
            for (k, &pixel) in way.iter().enumerate().skip(1) {
                if k % spacing == 0 || k == last {
                    let reach = smoothing.min(k).min(last - k);
                    let window = &way[k - reach..=k + reach];
                    let mean = window.iter().map(|i| centre(*i)).sum::<Vec2>() / window.len() as f32;
                    let inside = close_up.mask.contains(floor_i32(mean.x), floor_i32(mean.y));
                    let position = if inside { mean } else { centre(pixel) };
                    nodes.push(VeinNode { position, parent: Some(node), order: *order, radius: 0.0 });
                    node = u32::try_from(nodes.len() - 1).unwrap_or(NONE);
                }
                node_of[pixel] = node;
            }
        }
        widen(&mut nodes, close_up.side);
        for node in &mut nodes {
            node.position = close_up.leave(node.position);
            node.radius = close_up.leave_length(node.radius);
        }
        VeinGraph { nodes, joins: Vec::new() }
    }

    /// Node of a pixel, or of one beside it.
    fn node_near(&self, node_of: &[u32], pixel: usize) -> u32 {
        if node_of[pixel] != NONE {
            return node_of[pixel];
        }
        let height = self.on.len() / self.width.max(1);
        let beside = side_neighbours(pixel, self.width, height).map(|i| node_of[i]);
        beside.filter(|node| *node != NONE).min().unwrap_or(0)
    }
}

/// Gives every node a radius whose cube is its share of the whole tree's length.
///
/// Murray's law (1926) asks that cubes of radii add up at a fork; letting the cube grow with the length that a vein
/// feeds keeps the law at forks and tapers veins between them.
fn widen(nodes: &mut [VeinNode], side: f32) {
    let mut fed = vec![0.0_f32; nodes.len()];
    for i in (1..nodes.len()).rev() {
        let Some(parent) = nodes[i].parent else { continue };
        let parent = parent as usize;
        fed[parent] += fed[i] + nodes[i].position.distance(nodes[parent].position);
    }
    let whole = fed[0].max(1e-6);
    for (node, fed) in nodes.iter_mut().zip(fed) {
        node.radius = side * (ROOT_RADIUS * libm::cbrtf(fed / whole)).max(LEAST_RADIUS);
    }
}
