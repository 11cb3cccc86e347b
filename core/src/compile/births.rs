// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Works out how many particles of each population are born in a step.

use super::cycle::Cycle;
use super::snow::{flake_water, flakes_per_mm};
use crate::arith::rng::philox;
use crate::blocks::BirthBlock;
use crate::convert::len32;
use crate::scene::{MAX_POPULATIONS, ParticleRelease, Particles, Scene, Weather};

/// Random words of the numbers that are born, by step; in the place of a particle's number, whose populations count from one.
const STREAM_BIRTHS: u32 = 0x8000_0000;
/// Largest mean of the numbers that one random word decides.
const LARGEST_MEAN: f64 = 500.0;

/// Numbers of particles that are born, step by step.
#[derive(Clone, Debug)]
pub(crate) struct Births {
    populations: Vec<PopulationBirths>,
    seed: [u32; 2],
    dt_s: f64,
}

/// Snow that falls as particles, by the weather.
#[derive(Clone, Debug)]
struct Snowfall {
    weather: Weather,
    flakes_per_mm: f64,
}

impl Snowfall {
    /// Flakes that have fallen before a step, since the first of `lead` steps before time zero.
    fn born_by(&self, step: i64, lead: i64, dt_s: f64) -> u64 {
        let fallen_mm = |step: i64| self.weather.fallen_mm(step as f64 * dt_s);
        whole_number((fallen_mm(step) - fallen_mm(-lead)) * self.flakes_per_mm)
    }
}

/// The same of one population.
#[derive(Clone, Debug)]
struct PopulationBirths {
    /// `None` of those that are born of others.
    release: Option<ParticleRelease>,
    count: u32,
    /// Steps before time zero in which the first is born of those that live then.
    lead: i64,
    /// Number of random words of a step, and shares of them, as words, up to which so many are born by each.
    draws: u32,
    thresholds: Vec<u32>,
    /// Snow that falls as its particles.
    snowfall: Option<Snowfall>,
    /// Number born in a cycle and steps of one, in a world that repeats.
    rhythm: Option<(u32, u32)>,
}

impl Births {
    /// Births of a scene, which may repeat.
    pub(super) fn of(scene: &Scene, seed: [u32; 2], cycle: Option<&Cycle>) -> Self {
        let dt_s = f64::from(scene.dt_s);
        let births = |(particles, reach_s)| PopulationBirths::of(scene, particles, reach_s, dt_s);
        let mut populations: Vec<_> = scene.particles.iter().zip(reaches_s(scene)).map(births).collect();
        if let Some((births, steps)) = cycle.map(Cycle::births) {
            for (population, &each) in populations.iter_mut().zip(births) {
                population.rhythm = (each != 0).then_some((each, steps));
            }
        }
        Self { populations, seed, dt_s }
    }

    /// Steps before time zero in which particles are born that live then.
    pub(crate) fn lead(&self) -> u32 {
        let lead = self.populations.iter().map(|population| population.lead).max().unwrap_or(0);
        u32::try_from(lead).unwrap_or(0)
    }

    /// Numbers born before a step, of those that do not depend on what was drawn.
    pub(crate) fn before(&self, step: i64) -> [u64; MAX_POPULATIONS] {
        let mut born = [0; MAX_POPULATIONS];
        for (born, population) in born.iter_mut().zip(&self.populations) {
            if let Some(ParticleRelease::Rate { per_s, from_s }) = population.release {
                *born = born_by(per_s, from_s, step, self.dt_s);
            }
            if let Some(snowfall) = &population.snowfall {
                *born = snowfall.born_by(step, population.lead, self.dt_s);
            }
        }
        born
    }

    /// Numbers that are born in a step, two's complement.
    pub(super) fn in_step(&self, step: u32) -> [u32; MAX_POPULATIONS] {
        let mut births = [0; MAX_POPULATIONS];
        for (number, (births, population)) in (0..).zip(births.iter_mut().zip(&self.populations)) {
            *births = population.in_step(self.seed, number, step, self.dt_s).min(population.count);
        }
        births
    }

    /// Blocks of a step before which so many are born.
    pub(super) fn blocks(&self, step: u32, born: &[u64; MAX_POPULATIONS]) -> [BirthBlock; MAX_POPULATIONS] {
        let mut blocks = [<BirthBlock as bytemuck::Zeroable>::zeroed(); MAX_POPULATIONS];
        let counts = self.in_step(step);
        for (number, population) in self.populations.iter().enumerate() {
            let first = population.rhythm.map_or(born[number], |(each, _)| born[number] % u64::from(each));
            #[expect(clippy::cast_possible_truncation, reason = "numbers wrap around after four billion")]
            let (first_id, first_place) = (first as u32, (born[number] % u64::from(population.count)) as u32);
            let is_burst = u32::from(matches!(population.release, Some(ParticleRelease::Burst { .. })));
            blocks[number] = BirthBlock { first_id, count: counts[number], first_place, is_burst };
        }
        blocks
    }
}

impl PopulationBirths {
    /// Births of a population that is alive, or has descendants, for `reach_s` after each.
    fn of(scene: &Scene, particles: &Particles, reach_s: f64, dt_s: f64) -> Self {
        let release = particles.nest.is_none().then_some(particles.release);
        let (mean, from_s) = match release {
            None
            | Some(
                ParticleRelease::Burst { .. } | ParticleRelease::BurningLeaves | ParticleRelease::BranchSnow,
            ) => (0.0, 0.0),
            Some(ParticleRelease::Rate { from_s, .. }) => (0.0, f64::from(from_s)),
            // The air is full of flakes at time zero.
            Some(ParticleRelease::Snowfall) => (0.0, -reach_s),
            Some(ParticleRelease::Poisson { per_s, from_s }) => (f64::from(per_s) * dt_s, f64::from(from_s)),
        };
        #[expect(clippy::cast_possible_truncation, reason = "validated to be few")]
        let lead = libm::ceil((-from_s).min(reach_s).max(0.0) / dt_s) as i64;
        #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "validated to be few")]
        let draws = libm::ceil(mean / LARGEST_MEAN) as u32;
        let thresholds = if draws == 0 { Vec::new() } else { poisson_thresholds(mean / f64::from(draws)) };
        let snowfall = scene.weather.as_ref().filter(|_| particles.is_snow()).map(|weather| Snowfall {
            weather: weather.clone(),
            flakes_per_mm: flakes_per_mm(scene, flake_water(scene)),
        });
        Self { release, count: particles.count, lead, draws, thresholds, snowfall, rhythm: None }
    }

    fn in_step(&self, seed: [u32; 2], number: u32, step: u32, dt_s: f64) -> u32 {
        let at = i64::from(step.cast_signed());
        let Some(release) = self.release else { return 0 };
        if let Some((each, steps)) = self.rhythm {
            let by = |steps_passed: u32| u64::from(steps_passed) * u64::from(each) / u64::from(steps);
            let within = step % steps;
            return u32::try_from(by(within + 1) - by(within)).unwrap_or(u32::MAX);
        }
        match release {
            ParticleRelease::BurningLeaves | ParticleRelease::BranchSnow => 0,
            ParticleRelease::Snowfall => self.snowfall.as_ref().map_or(0, |snowfall| {
                let [before, after] = [at, at + 1].map(|step| snowfall.born_by(step, self.lead, dt_s));
                u32::try_from(after - before).unwrap_or(u32::MAX)
            }),
            ParticleRelease::Burst { at_s } => {
                let is_now = step_of(at_s, dt_s) == at;
                if is_now { self.count } else { 0 }
            }
            ParticleRelease::Rate { per_s, from_s } => {
                let born = born_by(per_s, from_s, at + 1, dt_s) - born_by(per_s, from_s, at, dt_s);
                u32::try_from(born).unwrap_or(u32::MAX)
            }
            ParticleRelease::Poisson { from_s, .. } if step_of(from_s, dt_s) <= at => (0..self.draws)
                .map(|draw| {
                    let [word, ..] = philox(seed, [step, STREAM_BIRTHS, number + 1, draw]);
                    len32(self.thresholds.partition_point(|&threshold| threshold <= word))
                })
                .sum(),
            ParticleRelease::Poisson { .. } => 0,
        }
    }
}

/// Longest times in seconds from a birth in each population to the death of the last that descends from it.
pub(super) fn reaches_s(scene: &Scene) -> Vec<f64> {
    let mut reaches_s = vec![0.0; scene.particles.len()];
    for (index, particles) in scene.particles.iter().enumerate().rev() {
        let is_child = |other: &Particles| other.nest.as_ref().is_some_and(|nest| nest.of == particles.name);
        let later = scene.particles.iter().zip(&reaches_s).skip(index + 1);
        let children_s = later.filter(|(other, _)| is_child(other)).map(|(_, reach_s)| *reach_s);
        let longest_s =
            particles.life_s.map_or(0.0, |life_s| f64::from(life_s.highest()) + f64::from(scene.dt_s));
        reaches_s[index] = longest_s + children_s.fold(0.0, f64::max);
    }
    reaches_s
}

/// Step that is nearest to a time.
#[expect(clippy::cast_possible_truncation, reason = "validated to fit")]
fn step_of(at_s: f32, dt_s: f64) -> i64 {
    libm::floor(f64::from(at_s) / dt_s + 0.5) as i64
}

/// Number of particles born one after another before a step.
fn born_by(per_s: f32, from_s: f32, step: i64, dt_s: f64) -> u64 {
    whole_number((step as f64 * dt_s - f64::from(from_s)) * f64::from(per_s))
}

/// Least whole number that is not below one.
#[expect(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "not negative, and far below 2^63"
)]
fn whole_number(number: f64) -> u64 {
    libm::ceil(number).max(0.0) as u64
}

/// Shares of the random words up to which no more than 0, 1, 2 ... are born, for a Poisson distribution of that mean.
fn poisson_thresholds(mean: f64) -> Vec<u32> {
    let mut thresholds = Vec::new();
    let mut chance = libm::exp(-mean);
    let mut total = chance;
    let mut number = 0.0;
    loop {
        let share = total * 4_294_967_296.0;
        if share >= 4_294_967_295.5 || number > mean + 12.0 * libm::sqrt(mean) + 20.0 {
            return thresholds;
        }
        #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "below 2^32")]
        thresholds.push(libm::floor(share + 0.5) as u32);
        number += 1.0;
        chance *= mean / number;
        total += chance;
    }
}
