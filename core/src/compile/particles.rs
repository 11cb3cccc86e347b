// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Compiles populations of particles, the forces that they feel, and the numbers that are born in a step.

use glam::{DVec3, Vec3};

use super::nest::nest_block;
use crate::arith::rng::philox;
use crate::blocks::{BirthBlock, PopulationBlock, SpreadBlock};
use crate::convert::{len32, single};
use crate::device::particle::air::{AIR_LINEAR, AIR_MASSLESS, AIR_QUADRATIC, AIR_STOKES, AIR_VACUUM};
use crate::device::particle::birth::{
    PARTICLE_BALL, PARTICLE_BOX, PARTICLE_CONE, PARTICLE_DISC, PARTICLE_LINE, PARTICLE_RING, PARTICLE_SHELL,
};
use crate::device::particle::force::{FORCE_ATTRACT, FORCE_NOISE, FORCE_ROWS, FORCE_SWIRL, FORCE_TURN};
use crate::device::particle::record::{
    DIRECTION_AROUND, DIRECTION_CAP, DIRECTION_OUTWARD, MEETS_BOUNCE, MEETS_DIE, MEETS_NOTHING, MEETS_STICK,
    POPULATION_LOSS, POPULATION_MUTUAL, POPULATION_PULLED, POPULATION_SWIRLED, POPULATION_TURNED,
};
use crate::device::wind::vortex::SWIRL_COMPACT;
use crate::layout::Uint4;
use crate::motion::AIR_DENSITY;
use crate::scene::{
    Air, Bounds, Direction, Force, ForceKind, MAX_POPULATIONS, Meets, ObjectFriction, ParticleRelease,
    ParticleShape, Particles, Scene, Spread, SwirlProfile, VISCOSITY_PA_S,
};

/// Coordinate in m beyond which particles die: tables are looked up in units that a float counts exactly.
const BOUNDLESS_M: f32 = 1e5;
/// Random words of the numbers that are born, by step; in the place of a particle's number, whose populations count from one.
const STREAM_BIRTHS: u32 = 0x8000_0000;
/// Largest mean of the numbers that one random word decides.
const LARGEST_MEAN: f64 = 500.0;

/// Populations of a scene from a row of the tables on, and the rows of the forces that they feel. The first steps come `lead` steps before
/// time zero.
pub(super) fn populations_of(
    scene: &Scene,
    first_row: u32,
    lead: u32,
) -> ([PopulationBlock; MAX_POPULATIONS], Vec<Uint4>) {
    let mut blocks = [<PopulationBlock as bytemuck::Zeroable>::zeroed(); MAX_POPULATIONS];
    let mut rows = Vec::new();
    let mut first_slot = 0;
    let mut slots = Vec::new();
    for (particles, block) in scene.particles.iter().zip(&mut blocks) {
        *block = population_block(scene, particles);
        if let Some(nest) = nest_block(particles, &scene.particles[..slots.len()], &slots, lead) {
            block.nest = nest;
        }
        block.first_slot = first_slot;
        slots.push(first_slot);
        first_slot += particles.count;
        block.first_force_row = first_row + len32(rows.len());
        for force in felt(scene, particles) {
            block.flags |= flag_of(force);
            if let ForceKind::Mutual { gm_m3_s2, softening_m } = force.of {
                block.mutual_gm_m3_s2 = gm_m3_s2;
                block.mutual_softening_m2 = softening_m * softening_m;
                continue;
            }
            block.force_count += 1;
            rows.extend(force_rows(scene, particles, force));
        }
    }
    (blocks, rows)
}

/// Forces that a population feels, in its order.
fn felt<'a>(scene: &'a Scene, particles: &'a Particles) -> impl Iterator<Item = &'a Force> {
    particles.feels.iter().filter_map(|name| scene.forces.iter().find(|force| force.name == *name))
}

fn flag_of(force: &Force) -> u32 {
    match force.of {
        ForceKind::Attract { .. } | ForceKind::Noise { .. } => POPULATION_PULLED,
        ForceKind::Lorentz { .. } => POPULATION_PULLED | POPULATION_TURNED,
        ForceKind::Mutual { .. } => POPULATION_MUTUAL,
        ForceKind::Spiral { .. } => POPULATION_TURNED,
        ForceKind::Swirl { .. } => POPULATION_SWIRLED,
    }
}

/// The rows of a force on a population.
fn force_rows(scene: &Scene, particles: &Particles, force: &Force) -> [Uint4; FORCE_ROWS as usize] {
    let dt = f64::from(scene.dt_s);
    let row = |numbers: [f64; 4]| Uint4(numbers.map(|number| single(number).to_bits()));
    let vector = |of: DVec3| row([of.x, of.y, of.z, 0.0]);
    let kind = |kind: u32, profile: u32| Uint4([kind, profile, 0, 0]);
    let turned = |pull: DVec3, half: DVec3| {
        let back = half * (2.0 / (1.0 + half.length_squared()));
        [kind(FORCE_TURN, 0), vector(pull), vector(half), vector(back)]
    };
    match force.of {
        ForceKind::Attract { at_m, gm_m3_s2, softening_m } => {
            let softening = f64::from(softening_m);
            let numbers = row([gm_m3_s2.into(), softening * softening, 0.0, 0.0]);
            [kind(FORCE_ATTRACT, 0), numbers, vector(at_m.as_dvec3()), Uint4::default()]
        }
        ForceKind::Mutual { .. } => [Uint4::default(); FORCE_ROWS as usize],
        ForceKind::Noise { m_s2, cell_m } => {
            let numbers = row([m_s2.into(), 1.0 / f64::from(cell_m), 0.0, 0.0]);
            [kind(FORCE_NOISE, 0), numbers, Uint4::default(), Uint4::default()]
        }
        ForceKind::Lorentz { b_t, e_v_m } => {
            let charge = f64::from(particles.charge_c_kg);
            turned(e_v_m.as_dvec3() * charge, b_t.as_dvec3() * (0.5 * charge * dt))
        }
        ForceKind::Spiral { rad_s, axis } => {
            let half = libm::tan(0.5 * f64::from(rad_s) * dt);
            turned(DVec3::ZERO, axis.as_dvec3().normalize() * -half)
        }
        ForceKind::Swirl { at_m, axis, rate_rad_s, swirl_radius_m, profile } => {
            let (number, d) = match profile {
                SwirlProfile::Power { alpha } => (alpha, 0.0),
                SwirlProfile::Compact { d } => (SWIRL_COMPACT, f64::from(d)),
            };
            let numbers = row([f64::from(rate_rad_s) * dt, 1.0 / f64::from(swirl_radius_m), d, 0.0]);
            let axis = axis.as_dvec3().normalize();
            [kind(FORCE_SWIRL, number), numbers, vector(at_m.as_dvec3()), vector(axis)]
        }
    }
}

/// A population, but for its slots and forces.
fn population_block(scene: &Scene, particles: &Particles) -> PopulationBlock {
    let mut block: PopulationBlock = bytemuck::Zeroable::zeroed();
    block.count = particles.count;
    let around = particles.nest.as_ref().map(|nest| ParticleShape::Sphere {
        center_m: Vec3::ZERO,
        radius_m: nest.radius_m,
        hollow: false,
    });
    set_shape(&around.unwrap_or(particles.from), &mut block);
    let (axis, half_angle_deg) = match particles.direction {
        Direction::Cone { axis, half_angle_deg } => (axis, half_angle_deg),
        Direction::Outward => (Vec3::Y, 0.0),
        Direction::Around { axis } => (axis, 0.0),
    };
    let [axis, side, front] = frame(axis);
    (block.axis, block.side, block.front) = (vector(axis), vector(side), vector(front));
    // 1 - cos h, precise for narrow caps as well.
    let sine = libm::sin(0.5 * f64::from(half_angle_deg).to_radians());
    block.cap = single(2.0 * sine * sine);
    block.direction = match particles.direction {
        Direction::Cone { .. } => DIRECTION_CAP,
        Direction::Outward => DIRECTION_OUTWARD,
        Direction::Around { .. } => DIRECTION_AROUND,
    };
    let friction = |friction: ObjectFriction| match friction {
        ObjectFriction::Coulomb(coefficient) => (coefficient, 0),
        ObjectFriction::Loss(share) => (share, POPULATION_LOSS),
    };
    block.meets = match particles.meets {
        Meets::Nothing => MEETS_NOTHING,
        Meets::Die => MEETS_DIE,
        Meets::Stick => MEETS_STICK,
        Meets::Bounce { restitution, friction: of } => {
            block.restitution = restitution;
            (block.friction, block.flags) = friction(of);
            MEETS_BOUNCE
        }
    };
    (block.low_m, block.high_m) = ([-BOUNDLESS_M; 3], [BOUNDLESS_M; 3]);
    match particles.dies {
        None => {}
        Some(Bounds::Below(height_m)) => block.low_m[1] = height_m,
        Some(Bounds::Outside { center_m, half_extent_m }) => {
            block.low_m = (center_m - half_extent_m).to_array();
            block.high_m = (center_m + half_extent_m).to_array();
        }
    }
    let dt = f64::from(scene.dt_s);
    block.speed_m_s = spread_block(particles.speed_m_s, 1.0);
    if let Some(life_s) = particles.life_s {
        block.life_steps = spread_block(life_s, 1.0 / dt);
    }
    block.size = spread_block(particles.size_m, 16384.0 / f64::from(particles.size_m.mean()));
    set_air(scene, particles, &mut block);
    block
}

/// Sets weight and drag.
fn set_air(scene: &Scene, particles: &Particles, block: &mut PopulationBlock) {
    let (gravity, density) = (f64::from(scene.gravity_m_s2), f64::from(particles.density_kg_m3));
    let size_m = f64::from(particles.size_m.mean());
    let same = |number: f64| SpreadBlock { mean: single(number), ..bytemuck::Zeroable::zeroed() };
    let buoyant = gravity * (1.0 - AIR_DENSITY / density);
    let (kind, pull, drag) = match particles.air {
        Air::Vacuum => (AIR_VACUUM, gravity, same(0.0)),
        Air::Linear { time_s } => (AIR_LINEAR, buoyant, spread_block(time_s, 1.0)),
        Air::Settling { m_s } => (AIR_LINEAR, gravity, spread_block(m_s, 1.0 / gravity)),
        Air::Stokes => {
            (AIR_STOKES, buoyant, same(density * size_m * size_m / (18.0 * f64::from(VISCOSITY_PA_S))))
        }
        Air::Quadratic { drag } => {
            let per_m = 0.75 * f64::from(drag) * AIR_DENSITY / (size_m * density);
            (AIR_QUADRATIC, buoyant, same(per_m * f64::from(scene.dt_s)))
        }
        Air::Massless => (AIR_MASSLESS, 0.0, same(0.0)),
    };
    (block.air, block.gravity_m_s2, block.drag) = (kind, single(pull * f64::from(particles.gravity)), drag);
}

/// Sets the points that particles start from.
fn set_shape(shape: &ParticleShape, block: &mut PopulationBlock) {
    let (kind, center, spans) = match *shape {
        ParticleShape::Box { center_m, half_extent_m: half } => {
            let spans =
                [DVec3::X * f64::from(half.x), DVec3::Y * f64::from(half.y), DVec3::Z * f64::from(half.z)];
            (PARTICLE_BOX, center_m.as_dvec3(), spans)
        }
        ParticleShape::Disc { center_m, radius_m, axis } => {
            (PARTICLE_DISC, center_m.as_dvec3(), across(axis, radius_m))
        }
        ParticleShape::Ring { center_m, radius_m, axis } => {
            (PARTICLE_RING, center_m.as_dvec3(), across(axis, radius_m))
        }
        ParticleShape::Sphere { center_m, radius_m, hollow } => {
            let kind = if hollow { PARTICLE_SHELL } else { PARTICLE_BALL };
            let spans = [DVec3::X, DVec3::Y, DVec3::Z].map(|axis| axis * f64::from(radius_m));
            (kind, center_m.as_dvec3(), spans)
        }
        ParticleShape::Cone { tip_m, base_m, radius_m } => {
            let along = base_m.as_dvec3() - tip_m.as_dvec3();
            let [side, _, front] = across(base_m - tip_m, radius_m);
            (PARTICLE_CONE, tip_m.as_dvec3(), [side, along, front])
        }
        ParticleShape::Line { from_m, to_m } => {
            let (from, to) = (from_m.as_dvec3(), to_m.as_dvec3());
            (PARTICLE_LINE, 0.5 * (from + to), [DVec3::ZERO, 0.5 * (to - from), DVec3::ZERO])
        }
    };
    block.shape = kind;
    block.center_m = vector(center);
    [block.span_x_m, block.span_y_m, block.span_z_m] = spans.map(vector);
}

/// Two radii across an axis, and nothing along it.
fn across(axis: Vec3, radius_m: f32) -> [DVec3; 3] {
    let [_, side, front] = frame(axis);
    [side * f64::from(radius_m), DVec3::ZERO, front * f64::from(radius_m)]
}

/// Unit vectors along an axis and across it.
fn frame(axis: Vec3) -> [DVec3; 3] {
    let axis = axis.as_dvec3().normalize();
    let (side, front) = axis.any_orthonormal_pair();
    [axis, side, front]
}

fn vector(of: DVec3) -> [f32; 3] {
    of.to_array().map(single)
}

/// A spread in another unit.
fn spread_block(spread: Spread, units: f64) -> SpreadBlock {
    let scaled = |number: f32| single(f64::from(number) * units);
    SpreadBlock {
        mean: scaled(spread.mean()),
        half_width: scaled(spread.half_width()),
        deviation: scaled(spread.deviation()),
        ..bytemuck::Zeroable::zeroed()
    }
}

/// Numbers of particles that are born, step by step.
#[derive(Clone, Debug)]
pub(crate) struct Births {
    populations: Vec<PopulationBirths>,
    seed: [u32; 2],
    dt_s: f64,
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
}

impl Births {
    /// Births of a scene.
    pub(super) fn of(scene: &Scene, seed: [u32; 2]) -> Self {
        let dt_s = f64::from(scene.dt_s);
        let births = |(particles, reach_s)| PopulationBirths::of(particles, reach_s, dt_s);
        let populations = scene.particles.iter().zip(reaches_s(scene)).map(births).collect();
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
            #[expect(clippy::cast_possible_truncation, reason = "numbers wrap around after four billion")]
            let (first_id, first_place) =
                (born[number] as u32, (born[number] % u64::from(population.count)) as u32);
            let is_burst = u32::from(matches!(population.release, Some(ParticleRelease::Burst { .. })));
            blocks[number] = BirthBlock { first_id, count: counts[number], first_place, is_burst };
        }
        blocks
    }
}

impl PopulationBirths {
    /// Births of a population that is alive, or has descendants, for `reach_s` after each.
    fn of(particles: &Particles, reach_s: f64, dt_s: f64) -> Self {
        let release = particles.nest.is_none().then_some(particles.release);
        let (mean, from_s) = match release {
            None | Some(ParticleRelease::Burst { .. }) => (0.0, 0.0),
            Some(ParticleRelease::Rate { from_s, .. }) => (0.0, f64::from(from_s)),
            Some(ParticleRelease::Poisson { per_s, from_s }) => (f64::from(per_s) * dt_s, f64::from(from_s)),
        };
        #[expect(clippy::cast_possible_truncation, reason = "validated to be few")]
        let lead = libm::ceil((-from_s).min(reach_s).max(0.0) / dt_s) as i64;
        #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "validated to be few")]
        let draws = libm::ceil(mean / LARGEST_MEAN) as u32;
        let thresholds = if draws == 0 { Vec::new() } else { poisson_thresholds(mean / f64::from(draws)) };
        Self { release, count: particles.count, lead, draws, thresholds }
    }

    fn in_step(&self, seed: [u32; 2], number: u32, step: u32, dt_s: f64) -> u32 {
        let at = i64::from(step.cast_signed());
        let Some(release) = self.release else { return 0 };
        match release {
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
fn reaches_s(scene: &Scene) -> Vec<f64> {
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
#[expect(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "not negative, and far below 2^63"
)]
fn born_by(per_s: f32, from_s: f32, step: i64, dt_s: f64) -> u64 {
    libm::ceil((step as f64 * dt_s - f64::from(from_s)) * f64::from(per_s)).max(0.0) as u64
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
