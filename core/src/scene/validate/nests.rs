// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Checks births of particles by others: that parents are there and have such events, and that there are slots for all that live at once.

use super::check::Check;
use super::particles::ROOM_DEVIATIONS;
use crate::SceneError;
use crate::scene::{Meets, Nest, ParticleEvent, ParticleRelease, Particles, Scene, limits};

/// Most events of a parent for whose children the slots that are needed are looked for.
const MOST_ROUNDS: u32 = 65_536;

impl Scene {
    /// Checks the parents of a population, if it has any. Those before it are checked already, but for their sum.
    pub(super) fn check_nest(&self, index: usize, at: &Check<'_>) -> Result<(), SceneError> {
        let particles = &self.particles[index];
        let Some(nest) = &particles.nest else { return Ok(()) };
        let inside = at.inside("nest");
        let earlier = &self.particles[..index];
        let Some(parents) = earlier.iter().find(|parents| parents.name == nest.of) else {
            let names: Vec<_> = earlier.iter().map(|parents| parents.name.as_str()).collect();
            let allowed = format!("one of the populations before it {names:?}");
            return Err(inside.error("of", format!("{:?}", nest.of), allowed));
        };
        inside.numbers([("fan", nest.fan.into(), limits::FAN)])?;
        inside.numbers([
            ("inherit", nest.inherit.into(), limits::INHERIT),
            ("radius_m", nest.radius_m.into(), limits::RADIUS_M),
        ])?;
        nest.check_event(parents, &inside, self.dt_s)?;
        let events = parents.count.saturating_mul(nest.fan);
        at.holds(particles.count.is_multiple_of(events), "count", || {
            let allowed =
                format!("a multiple of {events}: {} parents times a fan of {}", parents.count, nest.fan);
            (particles.count.to_string(), allowed)
        })?;
        self.check_rounds(index, parents, nest, at)
    }

    /// Checks that the children of one event are dead by the time of the next for which they have the same slots.
    fn check_rounds(
        &self,
        index: usize,
        parents: &Particles,
        nest: &Nest,
        at: &Check<'_>,
    ) -> Result<(), SceneError> {
        let particles = &self.particles[index];
        let events = parents.count * nest.fan;
        let rounds = particles.count / events;
        let is_once = nest.is_once(parents);
        at.holds(rounds == 1 || !is_once || parents.nest.is_none(), "count", || {
            let reason = "whose parents are born of others: nobody counts the lives of their slots";
            (particles.count.to_string(), format!("{events}, {reason}"))
        })?;
        let Some(interval) = self.interval_steps(particles, rounds) else {
            return at.holds(particles.life_s.is_some(), "life_s", || {
                ("None".into(), "a time, where a parent may have several events".into())
            });
        };
        let Some(life_s) = particles.life_s else {
            return at.holds(interval == f64::INFINITY, "life_s", || {
                ("None".into(), "a time, where particles are born again and again".into())
            });
        };
        let longest = life_steps(life_s.highest(), self.dt_s);
        let is_enough =
            |rounds: u32| self.interval_steps(particles, rounds).is_some_and(|steps| steps > longest);
        at.holds(interval > longest, "count", || {
            let found = particles.count.to_string();
            let lives =
                format!("children live up to {longest} steps and their slots are needed after {interval}");
            let most = if is_once && parents.nest.is_some() { 1 } else { MOST_ROUNDS };
            let needed = (rounds + 1..=most).find(|&rounds| is_enough(rounds));
            let allowed = match needed {
                Some(rounds) => format!("at least {}: {lives}", u64::from(events) * u64::from(rounds)),
                None => format!("more with more of {:?}: {lives}", nest.of),
            };
            (found, allowed)
        })
    }

    /// Least number of steps from the birth of a particle to that of another in the same slot: so many lives later, or of one that is born
    /// of others with slots for so many events. `None` where it is not known.
    fn interval_steps(&self, particles: &Particles, rounds: u32) -> Option<f64> {
        let dt_s = f64::from(self.dt_s);
        let Some(nest) = &particles.nest else {
            let births = f64::from(particles.count) * f64::from(rounds);
            return Some(match particles.release {
                ParticleRelease::Burst { .. }
                | ParticleRelease::BurningLeaves
                | ParticleRelease::BranchSnow
                | ParticleRelease::Snowfall => f64::INFINITY,
                ParticleRelease::Rate { per_s, .. } => libm::floor(births / (f64::from(per_s) * dt_s)),
                ParticleRelease::Poisson { per_s, .. } => {
                    // The mean with six standard deviations and one more gives so many.
                    let root = libm::sqrt((births - 1.0) + 0.25 * ROOM_DEVIATIONS * ROOM_DEVIATIONS);
                    let mean = (root - 0.5 * ROOM_DEVIATIONS).max(0.0);
                    libm::floor(mean * mean / (f64::from(per_s) * dt_s))
                }
            });
        };
        let parents = self.parents(nest)?;
        let lives = match &parents.nest {
            Some(of) => parents.count / (self.parents(of)?.count * of.fan),
            None => rounds,
        };
        let spread = parents.life_s.map_or(0.0, |life_s| {
            life_steps(life_s.highest(), self.dt_s) - life_steps(life_s.lowest(), self.dt_s)
        });
        match nest.on {
            ParticleEvent::Every { steps } if rounds == 1 => Some(steps.into()),
            // Another parent may have its events at any time between those of the one before it.
            ParticleEvent::Every { steps } => Some(f64::from(steps) * f64::from(rounds - 1) + 1.0),
            ParticleEvent::Birth => self.interval_steps(parents, lives),
            ParticleEvent::Hit if !nest.is_once(parents) => None,
            // How early other ends of lives come is not known.
            ParticleEvent::Death | ParticleEvent::Hit => {
                self.interval_steps(parents, lives).map(|steps| steps - spread)
            }
        }
    }

    /// The parents of a nest.
    fn parents(&self, nest: &Nest) -> Option<&Particles> {
        self.particles.iter().find(|parents| parents.name == nest.of)
    }

    /// The population that a population descends from, which has no parents.
    pub(super) fn ancestor<'a>(&'a self, particles: &'a Particles) -> &'a Particles {
        let mut oldest = particles;
        while let Some(parents) = oldest.nest.as_ref().and_then(|nest| self.parents(nest)) {
            oldest = parents;
        }
        oldest
    }
}

impl Nest {
    /// Returns true if a parent has one such event at most.
    fn is_once(&self, parents: &Particles) -> bool {
        match self.on {
            ParticleEvent::Birth | ParticleEvent::Death => true,
            ParticleEvent::Hit => parents.meets == Meets::Die,
            ParticleEvent::Every { .. } => false,
        }
    }

    /// Checks that parents have such events.
    fn check_event(&self, parents: &Particles, at: &Check<'_>, dt_s: f32) -> Result<(), SceneError> {
        match self.on {
            ParticleEvent::Birth => Ok(()),
            ParticleEvent::Death => {
                let ends = parents.life_s.is_some() || parents.dies.is_some() || parents.meets == Meets::Die;
                at.holds(ends, "on", || {
                    (format!("Death of {:?}, which never die", self.of), "an event that they have".into())
                })
            }
            ParticleEvent::Hit => at.holds(parents.meets != Meets::Nothing, "on", || {
                (format!("Hit of {:?}, which meet nothing", self.of), "an event that they have".into())
            }),
            ParticleEvent::Every { steps } => {
                at.inside("on").numbers([("steps", steps.into(), limits::NEST_STEPS)])?;
                let Some(life_s) = parents.life_s else { return Ok(()) };
                let longest = life_steps(life_s.highest(), dt_s);
                at.inside("on").holds(f64::from(steps) < longest, "steps", || {
                    let allowed = format!("less than the {longest} that {:?} live at most", self.of);
                    (steps.to_string(), allowed)
                })
            }
        }
    }
}

/// Whole number of steps of a life, as births round it.
fn life_steps(life_s: f32, dt_s: f32) -> f64 {
    libm::floor(f64::from(life_s) / f64::from(dt_s) + 0.5).max(1.0)
}
