// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Nests: particles that are born of other particles.

use serde::{Deserialize, Serialize};

/// Event of a particle at which others are born of it.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub enum ParticleEvent {
    /// Its birth.
    Birth,
    /// Its death, by age, region or hit. A life that is cut short since its slot is needed has none.
    Death,
    /// A hit; several within one step are as many events.
    Hit,
    /// Again and again as long as it lives, for the first time so long after its birth.
    Every {
        /// Steps from one to the next, 1 to 65535.
        steps: u32,
    },
}

/// Frame in which particles move that are born of others.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub enum Space {
    /// That of the world.
    #[default]
    World,
    /// That of their parent as long as it lives: they go along with it, and turn with its way. They feel the wind, forces and what is in the
    /// way where they are in the world, but not the parent's own motion. When it dies they go on as they are.
    Local,
}

/// Births of particles by those of another population.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Nest {
    /// Name of the parents' population, one of those before this one.
    pub of: String,
    /// Event of a parent at which they are born: of a death or a hit where it ends the step, of others at some time within it.
    pub on: ParticleEvent,
    /// Number born at each event, 1 to 64.
    pub fan: u32,
    /// Share of the parent's velocity that they set off with besides their own, -1 to 1; does not count with `Local`.
    pub inherit: f32,
    /// Radius in metres of the ball around the parent that they start in, 0 to 4096.
    pub radius_m: f32,
    /// Frame in which they move.
    pub space: Space,
}

impl Default for Nest {
    fn default() -> Self {
        Self {
            of: String::new(),
            on: ParticleEvent::Death,
            fan: 1,
            inherit: 0.0,
            radius_m: 0.0,
            space: Space::World,
        }
    }
}
