// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Nearest veins of every pixel.

use glam::Vec2;

use crate::distance::{NO_SEED, nearest_seed};
use crate::math::{floor_i32, segment_distance};
use crate::plane::Plane;
use crate::{Blade, VeinGraph, VeinNode};

/// Length, as a share of √A, over which the direction of a vein is measured.
const DIRECTION_REACH: f32 = 0.03;

/// A pixel's relation to the nearest of the veins considered.
#[derive(Clone, Copy, Debug)]
pub(crate) struct VeinSpot {
    /// Distance to the vein's middle line in pixels.
    pub(crate) distance: f32,
    /// The same with a sign: positive on the side that faces the leaf's tip.
    pub(crate) signed: f32,
    /// Unit direction of the vein there, away from the root.
    pub(crate) direction: Vec2,
    /// Unit direction across the vein, to the side that faces the leaf's tip.
    pub(crate) normal: Vec2,
    /// Half the vein's width there in pixels.
    pub(crate) radius: f32,
    /// Way from the root along the veins, 0 to 1 for the farthest end.
    pub(crate) along: f32,
    /// Rank of the vein.
    pub(crate) order: u8,
}

/// Veins laid over a pixel grid.
pub(crate) struct VeinField<'a> {
    graph: &'a VeinGraph,
    /// Node at the outer end of the nearest vein segment, by pixel.
    segment: Plane<u32>,
    /// Direction of the segment that ends in a node.
    direction: Vec<Vec2>,
    /// Way from the root to each node, in pixels.
    path: Vec<f32>,
    longest: f32,
    axis: Vec2,
}

impl<'a> VeinField<'a> {
    /// Finds the nearest vein whose rank is `orders` for every pixel; [`None`] if there is no such vein on the grid.
    pub(crate) fn new(
        blade: &Blade,
        graph: &'a VeinGraph,
        orders: std::ops::RangeInclusive<u8>,
        unit: f32,
    ) -> Option<Self> {
        let (width, height) = (blade.mask.width as usize, blade.mask.height as usize);
        let mut owner: Plane<u32> = Plane::filled(width, height, NO_SEED);
        let ends = |index: usize| parent_of(graph, index).map(|parent| (parent.position, graph.nodes[index]));
        for (index, number) in (0..graph.nodes.len()).zip(0_u32..) {
            let Some((from, node)) = ends(index) else { continue };
            if !orders.contains(&node.order) {
                continue;
            }
            let steps = 1 + floor_i32(from.distance(node.position) * 2.0).clamp(0, 8192);
            for step in 0..=steps {
                let p = from.lerp(node.position, step as f32 / steps as f32);
                if let Some(at) = owner.index_of(p) {
                    let slot = &mut owner.data[at];
                    // Where veins share a pixel the main one has it.
                    if *slot == NO_SEED || graph.nodes[*slot as usize].order > node.order {
                        *slot = number;
                    }
                }
            }
        }
        if owner.data.iter().all(|&segment| segment == NO_SEED) {
            return None;
        }
        let (_, seed) = nearest_seed(width, height, |i| owner.data[i] != NO_SEED);
        let segment =
            Plane { width, height, data: seed.data.iter().map(|&seed| owner.data[seed as usize]).collect() };
        let mut path = vec![0.0_f32; graph.nodes.len()];
        for (index, node) in graph.nodes.iter().enumerate() {
            if let Some(parent) = node.parent.filter(|&parent| (parent as usize) < index) {
                path[index] =
                    path[parent as usize] + node.position.distance(graph.nodes[parent as usize].position);
            }
        }
        let direction =
            (0..graph.nodes.len()).map(|i| direction_at(graph, i, DIRECTION_REACH * unit)).collect();
        let longest = path.iter().copied().fold(1e-3, f32::max);
        let axis = (blade.tip - blade.root).normalize_or(Vec2::NEG_Y);
        Some(Self { graph, segment, direction, path, longest, axis })
    }

    /// The nearest vein at a pixel.
    pub(crate) fn spot(&self, index: usize) -> VeinSpot {
        let number = self.segment.data[index] as usize;
        let node = self.graph.nodes[number];
        let parent = parent_of(self.graph, number).unwrap_or(node);
        let centre = self.segment.centre(index);
        let (distance, t) = segment_distance(centre, parent.position, node.position);
        let direction = self.direction[number];
        let mut normal = direction.perp();
        // The side towards the tip; along the midrib itself always the same side.
        let toward = normal.dot(self.axis);
        if toward < -0.15 || (toward.abs() <= 0.15 && normal.dot(self.axis.perp()) < 0.0) {
            normal = -normal;
        }
        let nearest = parent.position.lerp(node.position, t);
        let side = if (centre - nearest).dot(normal) < 0.0 { -1.0 } else { 1.0 };
        let from = self.path[number] - parent.position.distance(node.position) * (1.0 - t);
        VeinSpot {
            distance,
            signed: side * distance,
            direction,
            normal,
            radius: parent.radius + (node.radius - parent.radius) * t,
            along: (from / self.longest).clamp(0.0, 1.0),
            order: node.order,
        }
    }
}

/// The node before a node.
fn parent_of(graph: &VeinGraph, index: usize) -> Option<VeinNode> {
    graph.nodes.get(index)?.parent.and_then(|parent| graph.nodes.get(parent as usize)).copied()
}

/// Direction of the vein that ends in a node, measured over some length towards the root.
fn direction_at(graph: &VeinGraph, index: usize, reach: f32) -> Vec2 {
    let node = graph.nodes[index];
    let mut back = node;
    while back.position.distance(node.position) < reach {
        let Some(parent) = back.parent.and_then(|parent| graph.nodes.get(parent as usize)) else { break };
        // A lateral does not go on in the vein that it leaves.
        if parent.order != node.order && back.position != node.position {
            break;
        }
        back = *parent;
    }
    (node.position - back.position).normalize_or(Vec2::NEG_Y)
}

/// The veins, or a straight midrib where there are none.
pub(crate) fn with_midrib(blade: &Blade, graph: &VeinGraph, unit: f32) -> VeinGraph {
    if graph.nodes.len() > 1 {
        return graph.clone();
    }
    const STEPS: u16 = 24;
    let nodes = (0..=STEPS).map(|i| VeinNode {
        position: blade.root.lerp(blade.tip, f32::from(i) / f32::from(STEPS)),
        parent: u32::from(i).checked_sub(1),
        order: 1,
        radius: 0.008 * unit,
    });
    VeinGraph { nodes: nodes.collect(), joins: Vec::new() }
}
