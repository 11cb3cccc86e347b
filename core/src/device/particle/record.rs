// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! twin: backend-wgpu/src/shaders/particle/record.wgsl
//!
//! The three records of 16 bytes that make a particle, and the accessors of every word that packs several values. Colour, opacity and
//! drawn size follow from age and life: they are no state.

use crate::arith::lane::{Mask, Word};

crate::shared_constants! {
    /// Mask of a particle's state in [`ParticlePlace::bits`].
    pub const PARTICLE_STATE_MASK: u32 = 3;
    /// Not born yet; not drawn.
    pub const PARTICLE_DORMANT: u32 = 0;
    /// Moving.
    pub const PARTICLE_ALIVE: u32 = 1;
    /// Alive, and at rest on something.
    pub const PARTICLE_RESTING: u32 = 2;
    /// Dead; not drawn.
    pub const PARTICLE_DEAD: u32 = 3;
    /// Mark of a particle that was born in the step before.
    pub const PARTICLE_BORN: u32 = 4;
    /// Mark of a particle that died in the step before.
    pub const PARTICLE_DIED: u32 = 8;
    /// Mark of a particle that struck something in the step before.
    pub const PARTICLE_HIT: u32 = 16;
    /// Mark of a particle that rests on the ground, not on a solid part.
    pub const PARTICLE_GROUNDED: u32 = 32;
    /// Place of the number of these hits less one, up to [`STRUCK_MASK`].
    pub const STRUCK_SHIFT: u32 = 6;
    /// Mask of that number.
    pub const STRUCK_MASK: u32 = 3;
    /// All marks of the step before.
    pub const PARTICLE_MARKS: u32 = 220;
    /// Place of the population.
    pub const POPULATION_SHIFT: u32 = 8;
    /// Mask of the population.
    pub const POPULATION_MASK: u32 = 15;
    /// Place of the number of hits within this life, up to [`HITS_MASK`].
    pub const HITS_SHIFT: u32 = 12;
    /// Mask of the number of hits.
    pub const HITS_MASK: u32 = 0xfffff;
    /// Mask of the life in steps, and of the size, in [`ParticleTraits::life_size`].
    pub const TRAIT_MASK: u32 = 0xffff;
    /// Place of the size in 2^-14 of the mean size of the population.
    pub const PARTICLE_SIZE_SHIFT: u32 = 16;
    /// The mean size, as particles keep it.
    pub const PARTICLE_SIZE_ONE: u32 = 16384;
    /// Flag of a population: friction takes a share of the speed along a surface.
    pub const POPULATION_LOSS: u32 = 1;
    /// Flag of a population: some of its forces accelerate.
    pub const POPULATION_PULLED: u32 = 2;
    /// Flag of a population: some of its forces turn velocities.
    pub const POPULATION_TURNED: u32 = 4;
    /// Flag of a population: some of its forces move places.
    pub const POPULATION_SWIRLED: u32 = 8;
    /// Flag of a population: its particles attract one another.
    pub const POPULATION_MUTUAL: u32 = 16;
    /// Flag of a population: its particles go along with their parents.
    pub const POPULATION_LOCAL: u32 = 32;
    /// Flag of a population: each particle is a leaf that burns.
    pub const POPULATION_ON_LEAVES: u32 = 128;
    /// Flag of a population: others go along with its particles.
    pub const POPULATION_FOLLOWED: u32 = 64;
    /// Flag of a population: flakes of snow.
    pub const POPULATION_SNOW: u32 = 256;
    /// Flag of a population: snow that falls from branches.
    pub const POPULATION_BRANCH_SNOW: u32 = 1024;
    /// Flag of a population: its particles sample the air as leaves do, once for an interval of steps.
    pub const POPULATION_COASTS: u32 = 2048;
    /// Flag of a population: what leaves its region through a side comes in through the opposite one.
    pub const POPULATION_THROUGH: u32 = 512;
    /// Particles set off within a cap of directions.
    pub const DIRECTION_CAP: u32 = 0;
    /// They set off away from the middle of their shape.
    pub const DIRECTION_OUTWARD: u32 = 1;
    /// They set off around an axis through it.
    pub const DIRECTION_AROUND: u32 = 2;
    /// Particles pass through what is in the way.
    pub const MEETS_NOTHING: u32 = 0;
    /// They die there.
    pub const MEETS_DIE: u32 = 1;
    /// They stay there.
    pub const MEETS_STICK: u32 = 2;
    /// They bounce.
    pub const MEETS_BOUNCE: u32 = 3;
    /// Counts of each population.
    pub const TALLY_WORDS: u32 = 8;
    /// Place of the count of births.
    pub const TALLY_BORN: u32 = 0;
    /// Place of the count of deaths, by age, region or hit.
    pub const TALLY_DIED: u32 = 1;
    /// Place of the count of hits; particles that slide or rest do not hit.
    pub const TALLY_HITS: u32 = 2;
    /// Place of the count of steps in which a particle was stopped by its fourth hit.
    pub const TALLY_STOPPED: u32 = 3;
    /// Place of the count of lives that ended since the slot was needed for the next.
    pub const TALLY_CUT_SHORT: u32 = 4;
}

crate::shared_record! {
    /// Place and flags of a particle. Hot: read and written every step.
    pub struct ParticlePlace {
        /// Position in m.
        pub position: [f32; 3],
        /// State, marks of the step before, population and number of hits.
        pub bits: u32,
    }
}

crate::shared_record! {
    /// Motion of a particle. Hot: read every step, and all but the step of its birth written.
    pub struct ParticleMotion {
        /// Velocity in m/s.
        pub velocity: [f32; 3],
        /// Step of its birth, two's complement: some are born before time zero.
        pub birth: u32,
    }
}

crate::shared_record! {
    /// Numbers that a particle is born with. Hot: read every step.
    pub struct ParticleTraits {
        /// Number among all particles of its population that are ever born.
        pub id: u32,
        /// Life in steps, 0 if age does not end it, and size in 2^-14 of the mean of its population.
        pub life_size: u32,
        /// Share of its speed through the air lost in a step and time constant in s, where drag is linear; drag per m times the step
        /// in s and nothing, where it is quadratic.
        pub air: [f32; 2],
    }
}

crate::shared_struct! {
    /// Flight of a particle before a step, for those that go along with it. No state: it is written anew in every step.
    pub struct ParticleStart {
        /// Position in m.
        pub position: [f32; 3],
        /// Zero.
        pub unused: f32,
        /// Velocity in m/s.
        pub velocity: [f32; 3],
        /// Zero.
        pub unused_too: f32,
    }
}

crate::shared_struct! {
    /// Run of particles of one population within a page, which one dispatch steps.
    pub struct ParticleRun {
        /// First of them within the page.
        pub first: u32,
        /// Number of them.
        pub count: u32,
        /// Slot of the first particle of the page.
        pub page_slot: u32,
        /// Zero.
        pub unused: u32,
    }
}

/// State of a particle.
#[inline(always)]
pub fn particle_state<W: Word>(bits: W) -> W {
    bits & PARTICLE_STATE_MASK
}

/// Population of a particle.
#[inline(always)]
pub fn particle_population<W: Word>(bits: W) -> W {
    (bits >> POPULATION_SHIFT) & POPULATION_MASK
}

/// Number of hits within a particle's life.
#[inline(always)]
pub fn particle_hits<W: Word>(bits: W) -> W {
    (bits >> HITS_SHIFT) & HITS_MASK
}

/// Number of hits of a particle in the step before.
#[inline(always)]
pub fn particle_struck(bits: u32) -> u32 {
    if (bits & PARTICLE_HIT) != 0 { ((bits >> STRUCK_SHIFT) & STRUCK_MASK) + 1 } else { 0 }
}

/// Life of a particle in steps; 0 if age does not end it.
#[inline(always)]
pub fn particle_life<W: Word>(life_size: W) -> W {
    life_size & TRAIT_MASK
}

/// Size of a particle in 2^-14 of the mean of its population.
#[inline(always)]
pub fn particle_size<W: Word>(life_size: W) -> W {
    life_size >> PARTICLE_SIZE_SHIFT
}

/// Bits of a particle in a state, with nothing else to its name.
#[inline(always)]
pub fn particle_bits(state: u32, population: u32) -> u32 {
    state | (population << POPULATION_SHIFT)
}

/// The bits of a particle in another state.
#[inline(always)]
pub fn with_particle_state<W: Word>(bits: W, state: W) -> W {
    (bits & !PARTICLE_STATE_MASK) | state
}

/// The bits of a particle after one to four more hits.
#[inline(always)]
pub fn with_more_hits<W: Word>(bits: W, hits: W) -> W {
    let most = bits.all(HITS_MASK);
    let sum = particle_hits(bits).plus(hits);
    let sum = sum.less_than(most).select(sum, most);
    let kept = bits & !((HITS_MASK << HITS_SHIFT) | (STRUCK_MASK << STRUCK_SHIFT));
    (kept | (sum << HITS_SHIFT)) | ((hits.minus(hits.all(1)) << STRUCK_SHIFT) | PARTICLE_HIT)
}

/// Word of a life in steps and a size in 2^-14 of the mean.
#[inline(always)]
pub fn life_size_word(life: u32, size: u32) -> u32 {
    life | (size << PARTICLE_SIZE_SHIFT)
}
