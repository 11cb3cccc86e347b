// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! The other backend, in lockstep: the same leaves, step by step, and how far they are apart.

use std::time::{Duration, Instant};

use windfall_core::leaf::{LeafState, Place};
use windfall_core::{SimError, Simulator, World};

use super::Session;
use crate::run::backend::{Backend, BackendKind};

/// Time between two readings of the difference: it waits for both backends.
const LOOK_EVERY: Duration = Duration::from_millis(400);

/// Difference of two backends at a step.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Difference {
    pub(crate) step: u32,
    /// True if every bit of the state is the same.
    pub(crate) is_equal: bool,
    /// Largest distance in metres between two leaves of the same slot.
    pub(crate) farthest_m: f32,
    /// The slot of these leaves.
    pub(crate) slot: usize,
    /// Slots in which one leaf is in another state than the other.
    pub(crate) other_states: usize,
}

/// The other backend, and what was last found.
#[derive(Debug)]
pub(super) struct Twin {
    pub(super) backend: Backend,
    difference: Option<Difference>,
    looked: Option<Instant>,
}

impl Session {
    /// Runs the other backend beside this one from now on, or no longer.
    ///
    /// # Errors
    /// A device that is lost or cannot hold the leaves twice.
    pub(crate) fn set_comparing(&mut self, compares: bool) -> Result<(), SimError> {
        if !compares {
            self.twin = None;
        } else if self.twin.is_none() {
            let other = match self.kind() {
                BackendKind::Cpu => BackendKind::Wgpu,
                BackendKind::Wgpu => BackendKind::Cpu,
            };
            let world = self.world()?;
            let backend = self.device(other).simulator(&world)?;
            self.twin = Some(Twin { backend, difference: None, looked: None });
        }
        Ok(())
    }

    /// Returns true if both backends run.
    pub(crate) fn is_comparing(&self) -> bool {
        self.twin.is_some()
    }

    /// Makes the scene hold from the next step on.
    pub(super) fn impose(&mut self) -> Result<(), SimError> {
        let twin = self.twin.as_mut().map(|twin| &mut twin.backend);
        std::iter::once(&mut self.backend)
            .chain(twin)
            .try_for_each(|backend| backend.set_scene(&self.compiled))
    }

    /// Makes `world` the present.
    pub(super) fn put_back(&mut self, world: &World) -> Result<(), SimError> {
        let twin = self.twin.as_mut().map(|twin| &mut twin.backend);
        std::iter::once(&mut self.backend).chain(twin).try_for_each(|backend| backend.write_state(world))
    }

    /// The largest difference between the backends, at most a few tenths of a second old.
    ///
    /// # Errors
    /// A lost device.
    pub(crate) fn difference(&mut self) -> Result<Option<Difference>, SimError> {
        let now = self.backend.clock().step();
        let is_old = self.twin.as_ref().is_some_and(|twin| {
            let is_other = twin.difference.is_none_or(|found| found.step != now);
            is_other && twin.looked.is_none_or(|looked| looked.elapsed() >= LOOK_EVERY)
        });
        if is_old {
            let mine = self.world()?;
            let mut other = mine.clone();
            if let Some(twin) = &mut self.twin {
                twin.backend.read_state(&mut other)?;
                twin.difference = Some(difference(&mine, &other));
                twin.looked = Some(Instant::now());
            }
        }
        Ok(self.twin.as_ref().and_then(|twin| twin.difference))
    }
}

/// Compares two worlds of as many leaves.
fn difference(mine: &World, other: &World) -> Difference {
    let pairs = || mine.leaves.place.iter().zip(&other.leaves.place);
    // Leaves that wait are nowhere.
    let apart = |(a, b): (&Place, &Place)| {
        let is_there = a.state() != LeafState::Dormant || b.state() != LeafState::Dormant;
        let squared: f32 = a.position.iter().zip(b.position).map(|(a, b)| (a - b) * (a - b)).sum();
        if is_there { squared.sqrt() } else { 0.0 }
    };
    let farthest = pairs().map(apart).enumerate().max_by(|a, b| a.1.total_cmp(&b.1));
    let (slot, farthest_m) = farthest.unwrap_or((0, 0.0));
    Difference {
        step: mine.clock.step(),
        is_equal: mine.state_hash() == other.state_hash(),
        farthest_m,
        slot,
        other_states: pairs().filter(|(a, b)| a.state() != b.state()).count(),
    }
}

#[cfg(test)]
mod tests {
    use windfall_core::Scene;

    use super::*;

    #[test]
    fn a_difference_is_found_where_it_is() {
        let mine = World::build(&Scene::preset("six-motions").expect("a preset")).expect("valid");
        let same = difference(&mine, &mine);
        assert!(same.is_equal && same.farthest_m == 0.0 && same.other_states == 0, "{same:?}");
        let mut other = mine.clone();
        other.leaves.place[3].position[1] += 0.25;
        other.leaves.place[1].position[0] += 0.125;
        other.leaves.place[5].bits ^= 1;
        let found = difference(&mine, &other);
        assert_eq!((found.slot, found.is_equal, found.other_states), (3, false, 1), "{found:?}");
        assert!((found.farthest_m - 0.25).abs() < 1.0e-5, "{found:?}");
    }
}
