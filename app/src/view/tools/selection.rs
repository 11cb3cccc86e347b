// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! The leaf or particle that is followed, and the way it has come.

use glam::Vec3;
use windfall_core::leaf::LeafRecords;

use crate::view::tools::pick::{Picked, is_there};
use crate::view::tools::probe::{At, ParticleRecords};
use crate::view::tools::waking::Waking;

/// Most places of a track; of a longer one every other is dropped.
const MOST_PLACES: usize = 2048;

/// Track of a leaf or particle, step by step.
#[derive(Clone, Debug, Default)]
pub(crate) struct Track {
    places: Vec<(u32, Vec3)>,
    /// Steps between two places at least.
    apart: u32,
}

impl Track {
    /// Notes a place. Going back in time forgets what has not happened yet.
    fn note(&mut self, step: u32, place: Vec3) {
        while self.places.last().is_some_and(|(last, _)| *last >= step) {
            self.places.pop();
        }
        if self.places.last().is_some_and(|(last, _)| step - last < self.apart) {
            return;
        }
        self.places.push((step, place));
        if self.places.len() > MOST_PLACES {
            let mut index = 0;
            self.places.retain(|_| {
                index += 1;
                index % 2 == 1
            });
            self.apart = (2 * self.apart).max(2);
        }
    }

    /// The places, oldest first.
    pub(crate) fn places(&self) -> impl Iterator<Item = Vec3> {
        self.places.iter().map(|(_, place)| *place)
    }
}

/// A leaf that is followed.
#[derive(Clone, Debug)]
pub(crate) struct Selection {
    pub(crate) slot: u32,
    pub(crate) latest: At<LeafRecords>,
    pub(crate) track: Track,
    /// Reason why it has left the litter last, and the step at which that was seen.
    pub(crate) woken: Option<(u32, Waking)>,
}

impl Selection {
    /// Follows the leaf in `slot` from now on.
    pub(crate) fn new(slot: u32, latest: At<LeafRecords>) -> Self {
        let mut track = Track::default();
        track.note(latest.step, Vec3::from(latest.records.place.position));
        Self { slot, latest, track, woken: None }
    }

    /// Takes note of what has become of it, and of why it has just left the litter if it has. A slot that holds another leaf now
    /// begins another track.
    pub(crate) fn note(&mut self, latest: At<LeafRecords>, waking: Option<Waking>) {
        if latest.records.identity.id != self.latest.records.identity.id {
            self.track = Track::default();
            self.woken = None;
        }
        let is_known = |woken: &(u32, Waking)| woken.0 <= latest.step;
        self.woken = waking.map(|waking| (latest.step, waking)).or(self.woken.filter(is_known));
        self.track.note(latest.step, Vec3::from(latest.records.place.position));
        self.latest = latest;
    }
}

/// A particle that is followed.
#[derive(Clone, Debug)]
pub(crate) struct ParticleSelection {
    pub(crate) slot: u32,
    pub(crate) latest: At<ParticleRecords>,
    pub(crate) track: Track,
}

impl ParticleSelection {
    /// Follows the particle in `slot` from now on.
    pub(crate) fn new(slot: u32, latest: At<ParticleRecords>) -> Self {
        let mut track = Track::default();
        track.note(latest.step, Vec3::from(latest.records.place.position));
        Self { slot, latest, track }
    }

    /// Takes note of what has become of it. A slot that holds another particle now begins another track, and a dead one goes nowhere.
    pub(crate) fn note(&mut self, latest: At<ParticleRecords>) {
        let life = |at: &At<ParticleRecords>| (at.records.traits.id, at.records.motion.birth);
        if life(&latest) != life(&self.latest) {
            self.track = Track::default();
        }
        if is_there(latest.records.place.bits) {
            self.track.note(latest.step, Vec3::from(latest.records.place.position));
        }
        self.latest = latest;
    }
}

/// Leaf or particle that is followed.
#[derive(Clone, Debug)]
pub(crate) enum Followed {
    Leaf(Selection),
    Particle(ParticleSelection),
}

impl Followed {
    pub(crate) fn picked(&self) -> Picked {
        match self {
            Self::Leaf(leaf) => Picked::Leaf(leaf.slot),
            Self::Particle(particle) => Picked::Particle(particle.slot),
        }
    }

    pub(crate) fn track(&self) -> &Track {
        match self {
            Self::Leaf(leaf) => &leaf.track,
            Self::Particle(particle) => &particle.track,
        }
    }
}

#[cfg(test)]
mod tests {
    use windfall_core::device::particle::record::{PARTICLE_ALIVE, PARTICLE_DEAD, particle_bits};
    use windfall_core::leaf::Identity;
    use windfall_core::particle::{ParticleMotion, ParticlePlace, ParticleTraits};

    use super::*;

    fn at(step: u32, id: u32) -> At<LeafRecords> {
        let identity = Identity { id, ..Identity::default() };
        At { step, records: LeafRecords { identity, ..LeafRecords::default() } }
    }

    fn steps(selection: &Selection) -> Vec<u32> {
        selection.track.places.iter().map(|(step, _)| *step).collect()
    }

    #[test]
    fn a_track_goes_back_with_time() {
        let mut selection = Selection::new(3, at(10, 7));
        for step in [11, 12, 12, 13] {
            selection.note(at(step, 7), None);
        }
        assert_eq!(steps(&selection), [10, 11, 12, 13], "each step once");
        selection.note(at(12, 7), None);
        assert_eq!(steps(&selection), [10, 11, 12], "13 has not happened yet");
        selection.note(at(4, 7), None);
        assert_eq!(steps(&selection), [4], "before the click nothing is known");
    }

    #[test]
    fn another_leaf_in_the_slot_has_a_track_of_its_own() {
        let mut selection = Selection::new(3, at(10, 7));
        selection.note(at(11, 507), None);
        assert_eq!(steps(&selection), [11], "the old leaf is gone");
    }

    #[test]
    fn what_woke_a_leaf_is_known_until_time_goes_back_before_it() {
        let mut selection = Selection::new(3, at(10, 7));
        selection.note(at(12, 7), Some(Waking::Struck));
        selection.note(at(40, 7), None);
        assert_eq!(selection.woken, Some((12, Waking::Struck)), "long after");
        selection.note(at(12, 7), None);
        assert_eq!(selection.woken, Some((12, Waking::Struck)), "back then");
        selection.note(at(11, 7), None);
        assert_eq!(selection.woken, None, "it has not happened yet");
        selection.note(at(12, 7), Some(Waking::Loose));
        selection.note(at(13, 8), None);
        assert_eq!(selection.woken, None, "another leaf");
    }

    #[test]
    fn the_track_of_a_particle_ends_with_its_life() {
        let at = |step: u32, state, id, birth| {
            let place = ParticlePlace { position: [0.0; 3], bits: particle_bits(state, 0) };
            let motion = ParticleMotion { velocity: [0.0; 3], birth };
            let traits = ParticleTraits { id, ..ParticleTraits::default() };
            At { step, records: ParticleRecords { place, motion, traits } }
        };
        let mut selection = ParticleSelection::new(3, at(10, PARTICLE_ALIVE, 7, 4));
        let steps = |selection: &ParticleSelection| {
            selection.track.places.iter().map(|(step, _)| *step).collect::<Vec<_>>()
        };
        selection.note(at(11, PARTICLE_ALIVE, 7, 4));
        selection.note(at(12, PARTICLE_DEAD, 7, 4));
        assert_eq!(steps(&selection), [10, 11], "where it died");
        selection.note(at(20, PARTICLE_ALIVE, 9, 20));
        assert_eq!(steps(&selection), [20], "another particle in the slot");
        selection.note(at(30, PARTICLE_ALIVE, 9, 30));
        assert_eq!(steps(&selection), [30], "and another of the same number");
        assert_eq!(Followed::Particle(selection).picked(), Picked::Particle(3), "the slot");
    }

    #[test]
    fn long_tracks_keep_their_ends() {
        let mut selection = Selection::new(0, at(0, 7));
        for step in 1..20_000 {
            selection.note(at(step, 7), None);
        }
        let steps = steps(&selection);
        assert!(steps.len() <= MOST_PLACES && steps.len() > MOST_PLACES / 4, "{} places", steps.len());
        assert_eq!(steps[0], 0, "from the beginning");
        assert!(20_000 - steps[steps.len() - 1] < 40, "up to now: {:?}", steps.last());
    }
}
