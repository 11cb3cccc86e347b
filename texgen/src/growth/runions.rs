// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Veins that grow towards scattered sources of auxin (Runions et al. 2005).
//!
//! Sources are thrown at random, each some way from all others and from every vein. In each step a source draws the
//! vein nodes it is associated with, and each drawn node grows a step towards the mean direction of its sources.
//! *Open*: a source draws its nearest node and dies when one comes near, so veins never meet. *Closed*: a source
//! draws its whole relative neighbourhood, that is every node v for which no other node is nearer to both v and the
//! source than these are to each other, and dies when all have come; their tips then join into loops.
//!
//! The blade keeps its final size. Its uniform growth is equal to spacings that shrink from step to step, which is
//! how they are ranked here: the first sources stand far apart, the last ones close.

use glam::Vec2;

use super::draft::{Draft, Refusal};
use super::flow::{WidthLaw, finish, rank};
use super::ground::Ground;
use super::{STEP, no_vein};
use crate::rng::Rng;
use crate::{Blade, TexgenError, VeinGraph, VeinGrower};

/// Most rounds of growth.
const MOST_ROUNDS: u32 = 600;
/// Rounds a source waits for latecomers after the first vein has come near.
const PATIENCE: u32 = 24;

/// Grows veins towards auxin. Lengths are shares of √A.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Runions {
    /// True if veins join into loops.
    pub closed: bool,
    /// Spacing of the first sources, 0.05 to 0.5.
    pub first_spacing: f32,
    /// Spacing of the last sources, 0.02 to 0.5: about the width of an areole.
    pub last_spacing: f32,
    /// Half the width of the vein at the root.
    pub root_radius: f32,
}

impl Runions {
    /// Veins that never meet.
    pub fn open() -> Self {
        Self { closed: false, ..Self::closed() }
    }

    /// Veins that join into loops.
    pub fn closed() -> Self {
        Self { closed: true, first_spacing: 0.16, last_spacing: 6.0 * STEP, root_radius: 0.01 }
    }
}

/// A source of auxin.
#[derive(Clone, Debug)]
struct Source {
    at: Vec2,
    /// Nodes that it draws.
    draws: Vec<u32>,
    /// Round in which the first vein came near.
    touched: Option<u32>,
    /// Spacing when it was thrown, in pixels.
    spacing: f32,
    /// Nearest node, its distance, and how many nodes have been looked at.
    nearest: u32,
    far: f32,
    seen: usize,
}

impl VeinGrower for Runions {
    fn grow(&self, blade: &Blade, seed: u64) -> Result<VeinGraph, TexgenError> {
        let ground = Ground::survey(blade)?;
        let mut draft = Draft::new(&ground, STEP * ground.unit);
        self.fill(&mut draft, &Rng::new(seed).fork(1));
        if draft.nodes.len() < 2 {
            return no_vein();
        }
        rank(&mut draft, 5);
        Ok(finish(draft, self.root_radius, WidthLaw::Murray))
    }
}

impl Runions {
    /// Grows veins from all that a draft holds until no source is left.
    pub(super) fn fill(&self, draft: &mut Draft<'_>, rng: &Rng) {
        let unit = draft.ground.unit;
        let last = self.last_spacing.clamp(0.02, 0.5) * unit;
        let mut spacing = self.first_spacing.clamp(0.02, 0.5).max(self.last_spacing) * unit;
        let mut darts = rng.fork(1);
        let mut sources: Vec<Source> = Vec::new();
        let mut spent: Vec<bool> = vec![false; draft.nodes.len()];
        let mut settled_rounds = 0;
        for round in 0..MOST_ROUNDS {
            let thrown = throw(draft, &mut sources, spacing, &mut darts);
            let before = draft.nodes.len();
            self.associate(draft, &mut sources);
            self.advance(draft, &sources, &mut spent);
            self.retire(draft, &mut sources, round);
            spent.resize(draft.nodes.len(), false);
            let idle = draft.nodes.len() == before;
            if idle && spacing <= last {
                settled_rounds += 1;
                if sources.is_empty() && thrown == 0 || settled_rounds > PATIENCE {
                    break;
                }
            }
            spacing = (spacing * if idle { 0.9 } else { 0.988 }).max(last);
        }
    }

    /// Finds the nodes that each source draws; only what has grown since the last time is looked at.
    fn associate(&self, draft: &Draft<'_>, sources: &mut [Source]) {
        for source in sources {
            let reach = source.far.max(1.6 * source.spacing);
            let mut changed = false;
            for (sprout, id) in draft.nodes.iter().zip(0_u32..).skip(source.seen) {
                let far = sprout.position.distance(source.at);
                changed |= far <= reach;
                if far < source.far {
                    (source.far, source.nearest) = (far, id);
                }
            }
            source.seen = draft.nodes.len();
            if !changed {
                continue;
            }
            source.draws.clear();
            // Too far off to matter yet: the vein that comes first decides who the neighbours are.
            if !self.closed || source.far > 3.0 * source.spacing {
                source.draws.push(source.nearest);
                continue;
            }
            let reach = source.far.max(1.6 * source.spacing);
            let mut near: Vec<(f32, u32)> =
                draft.near(source.at, reach).map(|id| (draft.at(id).distance(source.at), id)).collect();
            near.sort_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
            for (index, &(far, v)) in near.iter().enumerate() {
                let shields = |u: u32| draft.at(u).distance(draft.at(v)) < far;
                // Those already drawn are the likeliest to shield.
                let free = !source.draws.iter().any(|&u| shields(u))
                    && !near[..index].iter().any(|&(_, u)| shields(u));
                if free {
                    source.draws.push(v);
                }
            }
        }
    }

    /// Every drawn node grows one step.
    fn advance(&self, draft: &mut Draft<'_>, sources: &[Source], spent: &mut Vec<bool>) {
        let near = if self.closed { 1.1 } else { 2.0 } * draft.step;
        let mut pull: Vec<Vec2> = vec![Vec2::ZERO; draft.nodes.len()];
        let mut drawn: Vec<u32> = Vec::new();
        for source in sources {
            for &node in &source.draws {
                let offset = source.at - draft.at(node);
                if offset.length() > near
                    && !spent[node as usize]
                    && draft.ground.sees(draft.at(node), source.at)
                {
                    if pull[node as usize] == Vec2::ZERO {
                        drawn.push(node);
                    }
                    pull[node as usize] += offset.normalize_or_zero();
                }
            }
        }
        drawn.sort_unstable();
        drawn.dedup();
        for node in drawn {
            let heading = pull[node as usize].normalize_or_zero();
            let sprout = draft.nodes[node as usize];
            let to = sprout.position + heading * draft.step;
            let order = child_order(draft, node);
            if heading == Vec2::ZERO {
                spent[node as usize] = true;
                continue;
            }
            match draft.grow(node, to, order, 0.45) {
                Ok(_) => spent.push(false),
                Err(Refusal::Blocked(a, b)) => {
                    spent[node as usize] = true;
                    if self.closed && draft.nodes[node as usize].order > 2 {
                        let other = if draft.at(a).distance(to) <= draft.at(b).distance(to) { a } else { b };
                        if !related(draft, node, other) {
                            // A refused loop stays open.
                            let _ = draft.join(node, other);
                        }
                    }
                }
                Err(_) => spent[node as usize] = true,
            }
        }
    }

    /// Drops sources that have been reached.
    fn retire(&self, draft: &mut Draft<'_>, sources: &mut Vec<Source>, round: u32) {
        let near = if self.closed { 1.4 } else { 2.0 } * draft.step;
        let mut left = Vec::with_capacity(sources.len());
        for mut source in sources.drain(..) {
            let reached = draft.near(source.at, near).collect::<Vec<u32>>();
            if reached.is_empty() {
                left.push(source);
                continue;
            }
            if !self.closed {
                continue;
            }
            let since = *source.touched.get_or_insert(round);
            let all_here = source.draws.iter().all(|&v| draft.at(v).distance(source.at) <= near);
            if all_here || round >= since + PATIENCE {
                meet(draft, &source, &reached);
            } else {
                left.push(source);
            }
        }
        *sources = left;
    }
}

/// Joins the tips that have come to a source.
fn meet(draft: &mut Draft<'_>, source: &Source, reached: &[u32]) {
    let mut tips: Vec<u32> = source.draws.iter().copied().filter(|v| reached.contains(v)).collect();
    let far = |draft: &Draft<'_>, id: u32| draft.at(id).distance_squared(source.at);
    tips.sort_by(|&a, &b| far(draft, a).total_cmp(&far(draft, b)).then(a.cmp(&b)));
    let Some((&first, others)) = tips.split_first() else { return };
    for &other in others {
        if !related(draft, first, other) {
            // Where another vein lies between, the loop stays open.
            let _ = draft.join(first, other);
        }
    }
}

/// Returns true if two nodes hang closely together already.
fn related(draft: &Draft<'_>, a: u32, b: u32) -> bool {
    let climbs_to = |from: u32, to: u32| {
        let mut at = from;
        for _ in 0..6 {
            if at == to {
                return true;
            }
            match draft.nodes[at as usize].parent {
                Some(parent) => at = parent,
                None => return false,
            }
        }
        false
    };
    climbs_to(a, b) || climbs_to(b, a)
}

/// Rank of the next node: a vein's end goes on in its rank, a branch ranks one lower; never above 3 or below 5.
fn child_order(draft: &Draft<'_>, node: u32) -> u8 {
    let own = draft.nodes[node as usize].order;
    let is_end = draft.is_end(node);
    if own < 3 {
        3
    } else if is_end {
        own
    } else {
        (own + 1).min(5)
    }
}

/// Throws darts; those that land free become sources. Returns how many did.
fn throw(draft: &Draft<'_>, sources: &mut Vec<Source>, spacing: f32, rng: &mut Rng) -> usize {
    let ground = draft.ground;
    let cells = ground.unit / spacing;
    let count = crate::math::floor_i32(cells * cells * 0.35).clamp(24, 600);
    let before = sources.len();
    let side = ground.extent();
    for _ in 0..count {
        let p = Vec2::new(rng.range(0.0, side), rng.range(0.0, side));
        let free = ground.room(p) > 0.25 * spacing.min(0.08 * ground.unit)
            && draft.near(p, spacing * 0.9).next().is_none()
            && sources.iter().all(|other| other.at.distance_squared(p) >= spacing * spacing);
        if free {
            sources.push(Source {
                at: p,
                draws: Vec::new(),
                touched: None,
                spacing,
                nearest: 0,
                far: f32::MAX,
                seen: 0,
            });
        }
    }
    sources.len() - before
}

#[cfg(test)]
mod tests {
    use super::super::tests::disc;
    use super::*;

    #[test]
    fn open_veins_never_meet_and_closed_ones_do() {
        let blade = disc(90.0);
        let open = Runions::open().grow(&blade, 3).expect("a disc has room");
        let closed = Runions::closed().grow(&blade, 3).expect("a disc has room");
        assert!(open.joins.is_empty(), "open venation has {} loops", open.joins.len());
        assert!(closed.joins.len() > 40, "closed venation has {} loops only", closed.joins.len());
    }

    #[test]
    fn no_part_of_the_blade_is_left_bare() {
        let blade = disc(90.0);
        let unit = (blade.mask.area() as f32).sqrt();
        for grower in [Runions::open(), Runions::closed()] {
            let graph = grower.grow(&blade, 5).expect("a disc has room");
            for y in (10..180).step_by(7) {
                for x in (10..180).step_by(7) {
                    let p = Vec2::new(x as f32, y as f32);
                    if p.distance(Vec2::splat(95.0)) < 80.0 {
                        let near =
                            graph.nodes.iter().map(|n| n.position.distance(p)).fold(f32::MAX, f32::min);
                        assert!(near < 0.09 * unit, "{grower:?}: no vein within {near} px of {p}");
                    }
                }
            }
        }
    }
}
