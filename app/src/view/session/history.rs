// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Kept moments of the past, so that any step of it can be reached again to the bit.
//!
//! Some moments are kept whole, and every change of wind and speeds with its step. A step in between is reached from the
//! moment before it, by taking the same steps under the same changes. What is kept thins out with its distance from the
//! present: the gap between two moments grows with how far away they are.

use std::collections::BTreeMap;

use windfall_core::{CompiledScene, World};

/// Memory that kept moments may take, in bytes.
const BUDGET_BYTES: usize = 256 << 20;
/// Most moments, however small.
const MOST: usize = 512;
/// Least time between two kept moments in simulated seconds.
const APART_S: f64 = 0.5;

/// The past of a world.
#[derive(Debug)]
pub(crate) struct History {
    moments: BTreeMap<u32, World>,
    /// The compiled scene from each step on.
    changes: BTreeMap<u32, CompiledScene>,
    most: usize,
    apart: u32,
    /// The latest step that was reached.
    end: u32,
}

impl History {
    /// A past that begins with `world`.
    pub(crate) fn new(world: &World) -> Self {
        let most = (BUDGET_BYTES / world.state_bytes().max(1)).min(MOST);
        #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "at most a few hundred")]
        let apart = (APART_S / f64::from(world.clock.dt_s())).ceil().max(1.0) as u32;
        let step = world.clock.step();
        let mut history = Self {
            moments: BTreeMap::new(),
            changes: BTreeMap::from([(step, world.compiled.clone())]),
            most,
            apart,
            end: step,
        };
        // Of a world too large nothing is kept.
        if most >= 2 {
            history.moments.insert(step, world.clone());
        }
        history
    }

    /// First and latest step that can be reached.
    pub(crate) fn range(&self) -> (u32, u32) {
        (self.moments.first_key_value().map_or(self.end, |(step, _)| *step), self.end)
    }

    /// Steps of the moments that are kept, in order.
    pub(crate) fn kept(&self) -> impl Iterator<Item = u32> {
        self.moments.keys().copied()
    }

    /// The present has come to `step`; true if this moment ought to be kept.
    pub(crate) fn reach(&mut self, step: u32) -> bool {
        self.end = self.end.max(step);
        let near = step.saturating_sub(self.apart - 1)..step.saturating_add(self.apart);
        self.most >= 2 && self.moments.range(near).next().is_none()
    }

    /// Keeps a moment.
    pub(crate) fn keep(&mut self, world: World) {
        let now = world.clock.step();
        self.moments.insert(now, world);
        let steps: Vec<u32> = self.kept().collect();
        for step in superfluous(&steps, self.most, now) {
            self.moments.remove(&step);
        }
    }

    /// From `step` on another scene holds: what came after has not happened.
    pub(crate) fn change(&mut self, step: u32, compiled: CompiledScene) {
        self.changes.split_off(&step);
        self.changes.insert(step, compiled);
        // A moment at this very step is of the past: only the steps after it are other ones.
        self.moments.split_off(&step.saturating_add(1));
        self.end = step;
    }

    /// The last kept moment at or before `step`, under what holds there.
    pub(crate) fn before(&self, step: u32) -> Option<World> {
        let (at, world) = self.moments.range(..=step).next_back()?;
        let compiled = self.compiled(*at).unwrap_or(&world.compiled).clone();
        Some(World { compiled, ..world.clone() })
    }

    /// Heights of the litter at the last kept moment at or before `step`; none if no moment is kept.
    pub(crate) fn litter_before(&self, step: u32) -> &[u32] {
        self.moments.range(..=step).next_back().map_or(&[], |(_, world)| &world.bed.words)
    }

    /// Step of the last kept moment at or before `step`.
    pub(crate) fn step_before(&self, step: u32) -> Option<u32> {
        self.moments.range(..=step).next_back().map(|(at, _)| *at)
    }

    /// CompiledScene at `step`.
    pub(crate) fn compiled(&self, step: u32) -> Option<&CompiledScene> {
        self.changes.range(..=step).next_back().map(|(_, compiled)| compiled)
    }

    /// Returns true if something changes at this very step.
    pub(crate) fn changes_at(&self, step: u32) -> bool {
        self.changes.contains_key(&step)
    }

    /// The next step after `step` at which something changes.
    pub(crate) fn next_change(&self, step: u32) -> Option<u32> {
        self.changes.range(step.saturating_add(1)..).next().map(|(step, _)| *step)
    }
}

/// Chooses those of `steps`, in ascending order, to give up so that `most` remain. The first and the one nearest to `now` stay; of the
/// others those go whose absence leaves the smallest gap for their distance from `now`.
fn superfluous(steps: &[u32], most: usize, now: u32) -> Vec<u32> {
    let mut left = steps.to_vec();
    let mut gone = Vec::new();
    while left.len() > most.max(1) {
        let cost = |index: usize| {
            let distance = f64::from(now.abs_diff(left[index]));
            let after = left.get(index + 1).copied().unwrap_or(left[index]);
            f64::from(after - left[index - 1]) / distance.max(0.5)
        };
        let Some(index) = (1..left.len()).min_by(|a, b| cost(*a).total_cmp(&cost(*b))) else { break };
        gone.push(left.remove(index));
    }
    gone
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Keeps a moment every 30 steps up to `end`, at most `most`.
    fn kept(end: u32, most: usize) -> Vec<u32> {
        let mut steps = Vec::new();
        for now in (0..=end).step_by(30) {
            steps.push(now);
            let gone = superfluous(&steps, most, now);
            steps.retain(|step| !gone.contains(step));
        }
        steps
    }

    #[test]
    fn moments_thin_out_with_age_and_never_exceed_their_number() {
        let steps = kept(36_000, 40);
        assert_eq!(steps.len(), 40, "as many as allowed: {steps:?}");
        assert_eq!((steps[0], steps[39]), (0, 36_000), "the beginning and the present");
        for pair in steps.windows(2) {
            let age = f64::from(36_000 - pair[0]);
            let gap = f64::from(pair[1] - pair[0]);
            assert!(gap <= 30.0_f64.max(0.5 * age), "a gap of {gap} steps {age} steps ago");
        }
        let recent = steps.iter().filter(|step| **step > 35_700).count();
        assert!(recent >= 8, "{recent} of the last ten: {steps:?}");
    }

    #[test]
    fn moments_gather_where_the_present_is() {
        let steps: Vec<u32> = (0..=100).map(|index| index * 30).collect();
        let gone = superfluous(&steps, 20, 900);
        assert_eq!(gone.len(), 81, "twenty are left");
        for near in [840, 870, 900, 930, 960] {
            assert!(!gone.contains(&near), "{near} is near the present");
        }
    }

    #[test]
    fn one_moment_is_enough() {
        assert_eq!(superfluous(&[0, 30, 60], 1, 60), [30, 60], "only the beginning stays");
        assert!(superfluous(&[0], 0, 0).is_empty(), "which always does");
    }
}
