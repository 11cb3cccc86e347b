// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! twin: backend-wgpu/src/shaders/motion/feature.wgsl
//!
//! The trajectory feature D = {L, T, P} x 5 of a leaf: which primitive motions, for what share of the fall, from
//! which phase. Nothing of it is stored: every number follows from (seed, id).
//!
//! # Source
//! Li et al., "GPU based real-time simulation of massive falling leaves" (2015), section 4.2.

use crate::arith::rng::{below, mul_q16, random};
use crate::blocks::SpeciesBlock;
use crate::motion::Primitive;

crate::shared_constants! {
    /// Stages of a fall.
    pub const STAGE_COUNT: u32 = 5;
    /// Streams of random words of one leaf: tries for its place (16 of them from here).
    pub const STREAM_PLACE: u32 = 0;
    /// Traits of a leaf: species, size, speed, spin and appearance.
    pub const STREAM_TRAITS: u32 = 16;
    /// Shares of the stages.
    pub const STREAM_TIMES: u32 = 17;
    /// Motion, phase and heading of the stages (5 of them from here).
    pub const STREAM_STAGE: u32 = 18;
}

/// Weight of each of four stages in 13 bits, packed two to a word as the draws come; the fifth is in the third word.
#[inline(always)]
fn stage_weight(words: [u32; 4], stage: u32) -> u32 {
    let word = if stage < 2 {
        words[0]
    } else if stage < 4 {
        words[1]
    } else {
        words[2]
    };
    ((word >> ((stage & 1) * 16)) & 0x1fff) + 1
}

/// Time from release to the end of `stage` (0 to 3) in 2^-16 steps, for a fall of `fall_q16`.
#[inline(always)]
pub fn stage_end(seed: [u32; 2], id: u32, fall_q16: u32, stage: u32) -> u32 {
    let words = random(seed, id, STREAM_TIMES);
    let mut ending = 0;
    let mut total = 0;
    for index in 0..STAGE_COUNT {
        let weight = stage_weight(words, index);
        ending += if index <= stage { weight } else { 0 };
        total += weight;
    }
    mul_q16(fall_q16, (ending << 16) / total)
}

/// Count of changes from one primitive motion to another.
#[inline(always)]
pub fn transition_count(species: &SpeciesBlock, origin: u32, next: u32) -> u32 {
    let index = (origin * 6 + next) as usize;
    species.transitions[index >> 2].0[index & 3]
}

/// The primitive motion that follows `origin`, chosen by a random word.
#[inline(always)]
pub fn transition_next(species: &SpeciesBlock, origin: u32, word: u32) -> u32 {
    let mut total = 0;
    for candidate in 0..6 {
        total += transition_count(species, origin, candidate);
    }
    let draw = below(word, total);
    let mut passed = 0;
    let mut next = 0;
    for candidate in 0..6 {
        passed += transition_count(species, origin, candidate);
        next += if draw >= passed { 1 } else { 0 };
    }
    next
}

/// Random words of one stage: choice of motion, phase, heading, spare.
#[inline(always)]
pub fn stage_words(seed: [u32; 2], id: u32, stage: u32) -> [u32; 4] {
    random(seed, id, STREAM_STAGE + stage)
}

/// One stage of a trajectory feature, for reports and tests.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Stage {
    /// L: index of the primitive motion.
    pub primitive: u32,
    /// T: share of the fall.
    pub share: f64,
    /// P: phase at the start, 0 to 1.
    pub phase: f64,
}

/// The whole trajectory feature of one leaf, from the same draws as the kernels.
#[expect(clippy::cast_possible_truncation, reason = "at most five stages")]
pub fn feature(species: &SpeciesBlock, seed: [u32; 2], id: u32) -> [Stage; STAGE_COUNT as usize] {
    let times = random(seed, id, STREAM_TIMES);
    let total: u32 = (0..STAGE_COUNT).map(|stage| stage_weight(times, stage)).sum();
    let mut primitive = species.first_motion;
    core::array::from_fn(|index| {
        let stage = index as u32;
        let words = stage_words(seed, id, stage);
        // A cone spiral lasts until the ground.
        if stage > 0 && primitive != Primitive::ConeSpiral as u32 {
            primitive = transition_next(species, primitive, words[0]);
        }
        Stage {
            primitive,
            share: f64::from(stage_weight(times, stage)) / f64::from(total),
            phase: f64::from(words[1]) / 4_294_967_296.0,
        }
    })
}
