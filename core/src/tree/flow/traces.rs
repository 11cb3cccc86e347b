// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Traces that lead to a root, and the shoots that they become.
//!
//! A trace begins with a pipe, and pipes add up where traces join: the wood's area is that of the traces in it. What no trace leads
//! through is no wood. Traces are smoothed; of their places some are kept, the farther apart the thicker the wood, and branches begin
//! at those.

use glam::DVec3;

use crate::convert::len32;
use crate::tree::turtle::Shoot;

/// Rounds of smoothing; in each a place moves half way to the middle of its neighbours.
const SMOOTHING: u32 = 12;
/// Distance of places that are kept, in radii of the wood there, and in steps at least and at most.
const KEPT: (f64, f64, f64) = (4.0, 2.0, 9.0);
/// Cosine of a bend at which a place is kept sooner.
const BENT: f64 = 0.94;
/// Shortest shoot in steps.
const SHORTEST: f64 = 0.05;
/// Way from a trace's beginning along which it bears leaves, in steps.
const LEAFY_STEPS: f64 = 7.0;

/// Places with the next one on the way to the root. The first place is the root.
#[derive(Clone, Debug, Default)]
pub(super) struct Traces {
    pub(super) places: Vec<DVec3>,
    next: Vec<Option<u32>>,
    pipes: Vec<u32>,
}

/// Traces seen from the root.
struct Outward {
    /// Places that lead to each.
    feeders: Vec<Vec<u32>>,
    /// All that lead to the root, each after the one it leads to.
    order: Vec<u32>,
    /// Pipes through each.
    sizes: Vec<u32>,
}

impl Traces {
    /// A trunk by itself, from the foot on.
    pub(super) fn from_trunk(places: &[DVec3]) -> Self {
        let next = (0..len32(places.len())).map(|node| node.checked_sub(1)).collect();
        Self { places: places.to_vec(), next, pipes: vec![0; places.len()] }
    }

    /// Adds a place that leads nowhere yet.
    pub(super) fn put(&mut self, place: DVec3) -> u32 {
        self.places.push(place);
        self.next.push(None);
        self.pipes.push(0);
        len32(self.places.len() - 1)
    }

    /// Begins a pipe at a place.
    pub(super) fn begin(&mut self, node: u32) {
        self.pipes[node as usize] += 1;
    }

    /// Leads a place to another.
    pub(super) fn lead(&mut self, from: u32, to: u32) {
        self.next[from as usize] = Some(to);
    }

    /// Direction in which a trace goes on from a place.
    pub(super) fn toward_root(&self, node: u32) -> Option<DVec3> {
        let next = self.next[node as usize]?;
        (self.places[next as usize] - self.places[node as usize]).try_normalize()
    }

    /// Begins a pipe at every place that none leads to.
    pub(super) fn begin_at_tips(&mut self) {
        let mut is_tip = vec![true; self.places.len()];
        self.next.iter().flatten().for_each(|&next| is_tip[next as usize] = false);
        for (pipes, is_tip) in self.pipes.iter_mut().zip(is_tip) {
            *pipes = u32::from(is_tip);
        }
    }

    fn outward(&self) -> Outward {
        let mut feeders: Vec<Vec<u32>> = vec![Vec::new(); self.places.len()];
        for (node, next) in (0u32..).zip(&self.next) {
            if let Some(next) = next {
                feeders[*next as usize].push(node);
            }
        }
        let mut order = vec![0];
        let mut at = 0;
        while at < order.len() {
            order.extend(&feeders[order[at] as usize]);
            at += 1;
        }
        let mut sizes = self.pipes.clone();
        for &node in order.iter().rev() {
            if let Some(next) = self.next[node as usize] {
                sizes[next as usize] += sizes[node as usize];
            }
        }
        Outward { feeders, order, sizes }
    }

    /// Rounds off corners, but for the root and the beginnings.
    fn smooth(&mut self, outward: &Outward) {
        let main = |node: u32| thickest(&outward.feeders[node as usize], &outward.sizes);
        let moved: Vec<(u32, u32, u32)> = outward
            .order
            .iter()
            .filter_map(|&node| Some((self.next[node as usize]?, node, main(node)?)))
            .collect();
        for _ in 0..SMOOTHING {
            let before = self.places.clone();
            for &(next, node, feeder) in &moved {
                let middle = 0.5 * (before[next as usize] + before[feeder as usize]);
                self.places[node as usize] = 0.5 * (before[node as usize] + middle);
            }
        }
    }

    /// The shoots, each after its parent, of lengths in metres; `foot_radius_m` is about that of the trunk.
    pub(super) fn shoots(mut self, step_m: f64, foot_radius_m: f64) -> Vec<Shoot> {
        let outward = self.outward();
        self.smooth(&outward);
        let longest_m = self.longest_m(&outward).max(step_m);
        let total = f64::from(outward.sizes[0].max(1));
        let spacing_m = |size: u32| {
            let radius_m = foot_radius_m * libm::sqrt(f64::from(size) / total);
            (KEPT.0 * radius_m).clamp(KEPT.1 * step_m, KEPT.2 * step_m)
        };
        let mut shoots: Vec<Shoot> = Vec::new();
        // Limbs to come: the place they leave, the shoot that ends there, the order, the way to the root.
        let mut waiting = vec![Limb { from: 0, first: None, parent: None, order: 0, way_m: 0.0 }];
        while let Some(limb) = waiting.pop() {
            let mut course = vec![limb.from];
            course.extend(limb.first);
            while let Some(node) =
                thickest(&outward.feeders[course[course.len() - 1] as usize], &outward.sizes)
            {
                course.push(node);
            }
            let kept = self.kept(&course, |node| spacing_m(outward.sizes[node as usize]));
            // The shoot that ends at each kept place, and the way to the root.
            let mut ends = vec![(limb.parent, limb.way_m)];
            for pair in kept.windows(2) {
                let (parent, way_m) = ends[ends.len() - 1];
                let way = self.places[course[pair[1]] as usize] - self.places[course[pair[0]] as usize];
                let length = way.length();
                let pipes = course[pair[0] + 1..=pair[1]]
                    .iter()
                    .map(|&node| f64::from(self.pipes[node as usize]))
                    .sum();
                if let Some(parent) = parent.filter(|_| length < SHORTEST * step_m) {
                    // No room for a shoot: what begins there begins below.
                    shoots[parent].pipes += pipes;
                    ends.push((Some(parent), way_m));
                    continue;
                }
                let is_twig = outward.sizes[course[pair[1]] as usize] == 1;
                let is_leafy = is_twig && self.way_m(&course[pair[1]..]) <= LEAFY_STEPS * step_m;
                shoots.push(Shoot {
                    parent,
                    direction: way / length,
                    length,
                    pipes,
                    born: (way_m / longest_m).min(1.0),
                    order: limb.order,
                    leaves: f64::from(u8::from(is_leafy)),
                    fruit: 0.0,
                });
                ends.push((Some(shoots.len() - 1), way_m + length));
            }
            // Side branches begin at the nearest place that is kept; the place that a limb leaves is its parent's.
            let begin = usize::from(limb.first.is_some());
            for at in (begin..course.len()).rev() {
                let onward = course.get(at + 1);
                for &side in outward.feeders[course[at] as usize].iter().rev() {
                    if Some(&side) == onward || outward.sizes[side as usize] == 0 {
                        continue;
                    }
                    let nearest = nearest_kept(&kept, at);
                    let (parent, way_m) = ends[nearest];
                    let from = course[kept[nearest]];
                    waiting.push(Limb { from, first: Some(side), parent, order: limb.order + 1, way_m });
                }
            }
        }
        shoots
    }

    /// Length in m of a course.
    fn way_m(&self, course: &[u32]) -> f64 {
        let place = |node: u32| self.places[node as usize];
        course.windows(2).map(|pair| place(pair[0]).distance(place(pair[1]))).sum()
    }

    /// Length in m of the longest way to the root.
    fn longest_m(&self, outward: &Outward) -> f64 {
        let mut ways_m = vec![0.0; self.places.len()];
        let mut longest_m = 0.0;
        for &node in &outward.order {
            if let Some(next) = self.next[node as usize] {
                ways_m[node as usize] =
                    ways_m[next as usize] + self.places[node as usize].distance(self.places[next as usize]);
                longest_m = f64::max(longest_m, ways_m[node as usize]);
            }
        }
        longest_m
    }

    /// Numbers of the places of a course that are kept: the first, the last, and between them those a spacing apart, or half of that at a bend.
    fn kept(&self, course: &[u32], spacing_m: impl Fn(u32) -> f64) -> Vec<usize> {
        let place = |at: usize| self.places[course[at] as usize];
        let last = course.len() - 1;
        let mut kept = vec![0];
        let mut since_m = 0.0;
        for (at, &node) in course.iter().enumerate().take(last).skip(1) {
            since_m += place(at - 1).distance(place(at));
            let spacing_m = spacing_m(node);
            let (before, after) = (place(at) - place(kept[kept.len() - 1]), place(at + 1) - place(at));
            let is_bent = before.dot(after) < BENT * before.length() * after.length();
            if since_m >= spacing_m || (is_bent && since_m >= 0.5 * spacing_m) {
                kept.push(at);
                since_m = 0.0;
            }
        }
        if last > 0 {
            since_m += place(last - 1).distance(place(last));
            // A stub at the end would be one joint too many.
            if kept.len() > 1 && since_m < 0.4 * spacing_m(course[last]) {
                kept.pop();
            }
            kept.push(last);
        }
        kept
    }
}

/// The one of the most pipes, of equal ones the first; `None` if none has any.
fn thickest(feeders: &[u32], sizes: &[u32]) -> Option<u32> {
    let mut best: Option<u32> = None;
    for &node in feeders.iter().filter(|&&node| sizes[node as usize] > 0) {
        if best.is_none_or(|best| sizes[node as usize] > sizes[best as usize]) {
            best = Some(node);
        }
    }
    best
}

/// Index of the kept place nearest along the course.
fn nearest_kept(kept: &[usize], at: usize) -> usize {
    let after = kept.partition_point(|&place| place < at).min(kept.len() - 1);
    let before = after.saturating_sub(1);
    if at.abs_diff(kept[before]) < at.abs_diff(kept[after]) { before } else { after }
}

/// A limb that has no shoots yet.
struct Limb {
    from: u32,
    first: Option<u32>,
    parent: Option<usize>,
    order: u32,
    way_m: f64,
}
