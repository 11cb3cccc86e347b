// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! The strong veins as few straight edges.

use std::collections::BTreeMap;

use glam::Vec2;

use crate::VeinGraph;
use crate::extract::outline::segments_meet;
use crate::math::segment_distance;

/// Thresholds for the veins to keep; lengths in pixels.
#[derive(Clone, Copy, Debug)]
pub(super) struct Thinning {
    /// Lowest rank that is kept.
    pub(super) lowest_order: u8,
    /// Greatest distance of a vein from its edges.
    pub(super) tolerance: f32,
    /// Least distance of a vein from the margin, except at the root.
    pub(super) clearance: f32,
    /// Least distance between two junctions on one vein.
    pub(super) spacing: f32,
}

/// Straight edges along the strong veins, all hanging together with the root.
pub(super) struct Framework {
    /// Ends of the edges; the first is the root.
    pub(super) points: Vec<Vec2>,
    /// Edges with the rank of their vein.
    pub(super) edges: Vec<(usize, usize, u8)>,
}

impl Framework {
    /// Thins veins to edges inside a margin; `root` is the margin's corner where they start.
    pub(super) fn new(veins: &VeinGraph, margin: &[Vec2], root: Vec2, how: Thinning) -> Self {
        let kept = kept_nodes(veins, margin, how);
        let mut children: BTreeMap<Option<usize>, Vec<usize>> = BTreeMap::new();
        for (index, parent) in &kept {
            children.entry(*parent).or_default().push(*index);
        }
        let mut frame = Self { points: vec![root], edges: Vec::new() };
        // Veins to follow: first node, and the point of the frame where they start.
        let starts = children.get(&None).cloned().unwrap_or_default();
        let mut open: Vec<(usize, usize)> = starts.into_iter().rev().map(|node| (node, 0)).collect();
        while let Some((first, from)) = open.pop() {
            frame.follow(veins, &children, margin, (first, from), how, &mut open);
        }
        frame
    }

    /// Adds one vein from a first node and a point of the frame up to its end; its branches are left in `open`.
    fn follow(
        &mut self,
        veins: &VeinGraph,
        children: &BTreeMap<Option<usize>, Vec<usize>>,
        margin: &[Vec2],
        (first, from): (usize, usize),
        how: Thinning,
        open: &mut Vec<(usize, usize)>,
    ) {
        let order = veins.nodes[first].order;
        let mut path = vec![self.points[from]];
        let mut branches: Vec<(usize, Vec<usize>)> = Vec::new();
        let mut at = Some(first);
        while let Some(node) = at {
            path.push(veins.nodes[node].position);
            let next = children.get(&Some(node)).map_or(&[][..], Vec::as_slice);
            // The vein goes on in the branch of its own rank, or the first.
            let heir = next.iter().copied().min_by_key(|&c| (veins.nodes[c].order, c));
            let others: Vec<usize> = next.iter().copied().filter(|c| Some(*c) != heir).collect();
            if !others.is_empty() {
                branches.push((path.len() - 1, others));
            }
            at = heir;
        }
        if crate::math::path_length(&path) < how.spacing {
            return;
        }
        // Junctions too close to the last corner move there.
        let last = path.len() - 1;
        let mut corners = vec![0];
        let mut junctions: Vec<(usize, Vec<usize>)> = Vec::new();
        for (index, nodes) in branches {
            let before = corners[corners.len() - 1];
            let near_end = path[index].distance(path[last]) < how.spacing;
            let moved = if path[index].distance(path[before]) < how.spacing {
                before
            } else if near_end {
                last
            } else {
                corners.push(index);
                index
            };
            junctions.push((moved, nodes));
        }
        if corners[corners.len() - 1] != last {
            corners.push(last);
        }
        let mut place: BTreeMap<usize, usize> = BTreeMap::from([(0, from)]);
        let mut before = from;
        for pair in corners.windows(2) {
            for index in bends(&path, pair[0], pair[1], how.tolerance) {
                if self.bars(margin, before, path[index]) {
                    self.branch_off(junctions, &place, from, open);
                    return;
                }
                self.points.push(path[index]);
                let id = self.points.len() - 1;
                self.edges.push((before, id, order));
                place.insert(index, id);
                before = id;
            }
        }
        self.branch_off(junctions, &place, from, open);
    }

    /// Leaves the branches of a vein to be followed; those of a part that was cut off start where the vein does.
    fn branch_off(
        &self,
        junctions: Vec<(usize, Vec<usize>)>,
        place: &BTreeMap<usize, usize>,
        from: usize,
        open: &mut Vec<(usize, usize)>,
    ) {
        for (index, nodes) in junctions.into_iter().rev() {
            let Some(start) = place.get(&index).copied().or((index == 0).then_some(from)) else { continue };
            open.extend(nodes.into_iter().rev().map(|node| (node, start)));
        }
    }

    /// Returns true if an edge from a point of the frame would meet the margin or another edge: thinning may bring that about.
    fn bars(&self, margin: &[Vec2], from: usize, to: Vec2) -> bool {
        let start = self.points[from];
        let next = margin.iter().cycle().skip(1);
        let at_margin = margin
            .iter()
            .zip(next)
            .filter(|(a, b)| **a != start && **b != start)
            .any(|(a, b)| segments_meet((start, to), (*a, *b)));
        at_margin
            || self.edges.iter().any(|&(a, b, _)| {
                let (p, q) = (self.points[a], self.points[b]);
                if a == from || b == from {
                    let other = if a == from { q } else { p };
                    segment_distance(other, start, to).0 < 1e-3 || segment_distance(to, start, other).0 < 1e-3
                } else {
                    segments_meet((start, to), (p, q))
                }
            })
    }
}

/// Nodes to keep, each with the nearest kept one towards the root (`None` for the root itself).
fn kept_nodes(veins: &VeinGraph, margin: &[Vec2], how: Thinning) -> BTreeMap<usize, Option<usize>> {
    let mut kept = BTreeMap::new();
    // Per node: whether the vein is still before its first kept node, has one, or has ended.
    let mut last: Vec<Option<Option<usize>>> = vec![None; veins.nodes.len()];
    for (index, node) in veins.nodes.iter().enumerate() {
        let Some(parent) = node.parent else {
            last[index] = Some(None);
            continue;
        };
        let Some(before) = last[parent as usize] else { continue };
        if node.order > how.lowest_order {
            continue;
        }
        let clear = inside(margin, node.position) && distance(margin, node.position) > how.clearance;
        if clear {
            kept.insert(index, before);
            last[index] = Some(Some(index));
        } else if before.is_none() {
            last[index] = Some(None);
        }
    }
    kept
}

/// Indices after `from` up to `to` that a path needs to stay within a tolerance (Ramer 1972, Douglas and Peucker 1973).
fn bends(path: &[Vec2], from: usize, to: usize, tolerance: f32) -> Vec<usize> {
    let far = |i: usize| segment_distance(path[i], path[from], path[to]).0;
    let worst = (from + 1..to).max_by(|&a, &b| far(a).total_cmp(&far(b)));
    match worst.filter(|&i| far(i) > tolerance) {
        Some(split) => {
            let mut out = bends(path, from, split, tolerance);
            out.extend(bends(path, split, to, tolerance));
            out
        }
        None => vec![to],
    }
}

/// Returns true if a point lies inside a polygon (even-odd).
fn inside(polygon: &[Vec2], p: Vec2) -> bool {
    let next = polygon.iter().cycle().skip(1);
    polygon.iter().zip(next).fold(false, |odd, (a, b)| {
        let spans = (a.y > p.y) != (b.y > p.y);
        odd ^ (spans && p.x < a.x + (b.x - a.x) * (p.y - a.y) / (b.y - a.y))
    })
}

/// Distance from a point to a polygon's edges.
fn distance(polygon: &[Vec2], p: Vec2) -> f32 {
    let next = polygon.iter().cycle().skip(1);
    polygon.iter().zip(next).map(|(a, b)| segment_distance(p, *a, *b).0).fold(f32::MAX, f32::min)
}
