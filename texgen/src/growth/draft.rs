// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Veins while they grow: nothing is added that would cross what is already there.

use glam::Vec2;

use super::ground::Ground;
use crate::math::{floor_i32, segment_distance};

/// A node of a draft.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Sprout {
    pub(crate) position: Vec2,
    pub(crate) parent: Option<u32>,
    pub(crate) order: u8,
}

/// Reason for which a segment was not added.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Refusal {
    /// It would leave the blade.
    Outside,
    /// It would come too close to the segment between two nodes.
    Blocked(u32, u32),
    /// It is longer than a draft's segments may be.
    TooLong,
}

/// A vein graph under construction.
pub(crate) struct Draft<'a> {
    pub(crate) ground: &'a Ground,
    /// Usual distance between neighbouring nodes in pixels.
    pub(crate) step: f32,
    pub(crate) nodes: Vec<Sprout>,
    pub(crate) joins: Vec<(u32, u32)>,
    segments: Vec<(u32, u32)>,
    /// Segments at each node.
    incident: Vec<Vec<u32>>,
    node_cells: Cells,
    segment_cells: Cells,
}

/// Longest segment in steps.
const LONGEST: f32 = 3.0;

/// Indices by the square cell in which they lie.
struct Cells {
    side: f32,
    across: usize,
    members: Vec<Vec<u32>>,
}

impl Cells {
    fn new(side: f32, extent: f32) -> Self {
        let across = usize::try_from(floor_i32(extent / side)).unwrap_or(0) + 1;
        Self { side, across, members: vec![Vec::new(); across * across] }
    }

    fn column(&self, x: f32) -> usize {
        usize::try_from(floor_i32(x / self.side)).unwrap_or(0).min(self.across - 1)
    }

    fn put(&mut self, p: Vec2, index: u32) {
        let cell = self.column(p.y) * self.across + self.column(p.x);
        self.members[cell].push(index);
    }

    /// Members of every cell that a disc touches.
    fn around(&self, p: Vec2, radius: f32) -> impl Iterator<Item = u32> + '_ {
        let (left, right) = (self.column(p.x - radius), self.column(p.x + radius));
        let (top, bottom) = (self.column(p.y - radius), self.column(p.y + radius));
        (top..=bottom)
            .flat_map(move |row| &self.members[row * self.across + left..=row * self.across + right])
            .flatten()
            .copied()
    }
}

impl<'a> Draft<'a> {
    /// A root and nothing else; `step` in pixels.
    pub(crate) fn new(ground: &'a Ground, step: f32) -> Self {
        let mut draft = Self {
            ground,
            step,
            nodes: Vec::new(),
            joins: Vec::new(),
            segments: Vec::new(),
            incident: Vec::new(),
            node_cells: Cells::new(2.0 * step, ground.extent()),
            segment_cells: Cells::new(LONGEST * step, ground.extent()),
        };
        draft.put(Sprout { position: ground.root, parent: None, order: 1 });
        draft
    }

    fn put(&mut self, sprout: Sprout) -> u32 {
        let id = u32::try_from(self.nodes.len()).unwrap_or(u32::MAX);
        self.node_cells.put(sprout.position, id);
        self.nodes.push(sprout);
        self.incident.push(Vec::new());
        id
    }

    fn put_segment(&mut self, a: u32, b: u32) {
        let id = u32::try_from(self.segments.len()).unwrap_or(u32::MAX);
        self.segment_cells.put((self.at(a) + self.at(b)) / 2.0, id);
        self.segments.push((a, b));
        self.incident[a as usize].push(id);
        self.incident[b as usize].push(id);
    }

    /// Position of a node.
    pub(crate) fn at(&self, node: u32) -> Vec2 {
        self.nodes[node as usize].position
    }

    /// Nodes within a distance of a point, in no particular but a fixed order.
    pub(crate) fn near(&self, p: Vec2, radius: f32) -> impl Iterator<Item = u32> + '_ {
        self.node_cells.around(p, radius).filter(move |&id| self.at(id).distance(p) <= radius)
    }

    /// Returns true if nodes are linked by a segment.
    pub(crate) fn linked(&self, a: u32, b: u32) -> bool {
        self.incident[a as usize].iter().any(|&s| {
            let (from, to) = self.segments[s as usize];
            from == b || to == b
        })
    }

    /// Returns true if nothing has grown on from a node yet.
    pub(crate) fn is_end(&self, node: u32) -> bool {
        self.incident[node as usize].len() < 2
    }

    /// Grows a segment from a node; `clearance` in steps is how far it must stay from other segments.
    pub(crate) fn grow(&mut self, from: u32, to: Vec2, order: u8, clearance: f32) -> Result<u32, Refusal> {
        self.check(from, None, to, clearance)?;
        let id = self.put(Sprout { position: to, parent: Some(from), order });
        self.put_segment(from, id);
        Ok(id)
    }

    /// Closes a loop between two nodes.
    pub(crate) fn join(&mut self, a: u32, b: u32) -> Result<(), Refusal> {
        if a == b || self.linked(a, b) {
            return Err(Refusal::Blocked(a, b));
        }
        self.check(a, Some(b), self.at(b), 0.02)?;
        self.joins.push((a.min(b), a.max(b)));
        self.put_segment(a, b);
        Ok(())
    }

    /// Checks that a segment may be added.
    fn check(&self, from: u32, to_node: Option<u32>, to: Vec2, clearance: f32) -> Result<(), Refusal> {
        let start = self.at(from);
        let length = start.distance(to);
        if length > LONGEST * self.step {
            return Err(Refusal::TooLong);
        }
        if !self.ground.sees(start, to) {
            return Err(Refusal::Outside);
        }
        let gap = clearance * self.step;
        for id in self.segment_cells.around((start + to) / 2.0, LONGEST * self.step) {
            let (u, v) = self.segments[id as usize];
            let (c, d) = (self.at(u), self.at(v));
            let too_close = if u == from || v == from {
                let other = if u == from { v } else { u };
                Some(other) == to_node
                    || folds(
                        start,
                        to,
                        self.at(other),
                        if to_node.is_some() { 0.02 * self.step } else { gap },
                    )
            } else if Some(u) == to_node || Some(v) == to_node {
                let other = if Some(u) == to_node { v } else { u };
                folds(to, start, self.at(other), 0.02 * self.step)
            } else {
                segments_distance(start, to, c, d) <= gap
            };
            if too_close {
                return Err(Refusal::Blocked(u, v));
            }
        }
        Ok(())
    }
}

/// Returns true if two segments from one corner lie on top of each other.
fn folds(corner: Vec2, a: Vec2, b: Vec2, gap: f32) -> bool {
    segment_distance(a, corner, b).0 <= gap || segment_distance(b, corner, a).0 <= gap
}

/// Distance between two segments, zero where they cross.
pub(crate) fn segments_distance(a: Vec2, b: Vec2, c: Vec2, d: Vec2) -> f32 {
    let side = |p: Vec2, q: Vec2, r: Vec2| (q - p).perp_dot(r - p);
    let crosses = side(a, b, c) * side(a, b, d) < 0.0 && side(c, d, a) * side(c, d, b) < 0.0;
    if crosses {
        return 0.0;
    }
    let ends = [(a, c, d), (b, c, d), (c, a, b), (d, a, b)];
    ends.into_iter().map(|(p, q, r)| segment_distance(p, q, r).0).fold(f32::MAX, f32::min)
}
