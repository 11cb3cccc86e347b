// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! One step of sixteen leaves, side by side in SIMD registers.

use bytemuck::{must_cast_mut, must_cast_ref};
use windfall_core::Context;
use windfall_core::arith::Quat;
use windfall_core::arith::lane::{Mask, Real, Word};
use windfall_core::arith::pack::{BLOCK, Pack, load_block, load_pairs, rows_of_bits, store_block};
use windfall_core::arith::vector::vec3_dot;
use windfall_core::device::leaf::fall::{Glide, attitude_after, glide_step, response_of, spin_advance};
use windfall_core::device::leaf::own::MotionParams;
use windfall_core::device::leaf::record::{STATE_FALLING, STATE_RESTING, flies, ground_steps, leaf_state};
use windfall_core::device::solid::near::may_meet_solids;
use windfall_core::device::terrain::ground::ground_met;
use windfall_core::device::wind::packed::wind_unpack;
use windfall_core::leaf::{Attitude, Drift, Place, Schedule};

use super::branch_block::{Column, vector_and_fourth};
use super::leaf_block::select_four;

/// Slots that follow one another.
pub(crate) struct FallingBlock<'a> {
    pub(crate) place: &'a mut [Place; BLOCK],
    pub(crate) drift: &'a mut [Drift; BLOCK],
    pub(crate) attitude: &'a mut [Attitude; BLOCK],
    pub(crate) schedule: &'a [Schedule; BLOCK],
    pub(crate) air: &'a [[u32; 2]; BLOCK],
}

/// Result of a step of a block.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Outcome {
    /// A bit for each leaf that needs a step of its own, the first in the lowest place.
    pub(crate) left: u32,
    /// A bit for each leaf to which something happens in this step.
    pub(crate) stirring: u32,
}

impl FallingBlock<'_> {
    /// Steps those that fall without an event, do not land and are near no solid part.
    #[inline(always)]
    pub(crate) fn advance<P: Pack>(&mut self, simd: P::Simd, cx: &Context<'_>) -> Outcome {
        let mut block = Outcome { left: 0, stirring: 0 };
        for part in 0..BLOCK / P::LANES {
            let outcome = self.advance_part::<P>(simd, cx, part);
            block.left |= outcome.left << (part * P::LANES);
            block.stirring |= outcome.stirring << (part * P::LANES);
        }
        Outcome { left: rows_of_bits(block.left), stirring: rows_of_bits(block.stirring) }
    }

    /// Steps part of them. Bits are those of its lanes.
    #[inline(always)]
    fn advance_part<P: Pack>(&mut self, simd: P::Simd, cx: &Context<'_>, part: usize) -> Outcome {
        let place: &mut Column = must_cast_mut(self.place);
        let drift: &mut Column = must_cast_mut(self.drift);
        let attitude: &mut Column = must_cast_mut(self.attitude);
        let places: [P; 4] = load_block(simd, place, part);
        let drifts: [P; 4] = load_block(simd, drift, part);
        let schedules: [P; 4] = load_block(simd, must_cast_ref(self.schedule), part);
        let (position, bits) = vector_and_fourth(places);
        let (velocity, phase) = vector_and_fourth(drifts);
        let (bits, phase) = (bits.to_bits(), phase.to_bits());
        let [event, rate, size, heading] = schedules.map(Real::to_bits);
        let state = leaf_state(bits);
        let waits = bits.all(cx.step.index).less_than(event);
        let is_falling = state.equals(STATE_FALLING);
        let falls = is_falling & waits & !flies(bits);
        let slides = !((velocity.x.to_bits() | velocity.z.to_bits()) << 1).equals(0);
        let is_settling = slides | ground_steps(phase).less_than(bits.all(cx.scene.settle_steps));
        let is_left = !waits | (state.equals(STATE_RESTING) & is_settling);
        let stirring = P::bits_of(is_left | is_falling);
        if !falls.any() {
            return Outcome { left: P::bits_of(is_left), stirring };
        }
        let start = Glide { position, drift: velocity, phase };
        let response = response_of(cx, bits);
        let wind = wind_unpack(load_pairs::<P>(simd, self.air, part));
        let glide = glide_step(cx, start, bits, MotionParams { rate, size, heading }, response, wind);
        let spun = spin_advance(bits, heading, response.fastest_spin);
        let before = || Quat::from(load_block::<P>(simd, attitude, part));
        let (bits, turned) = attitude_after(cx, spun, glide.phase, heading, before);

        let mut lands = ground_met(cx, glide.position);
        if cx.scene.has_solids() {
            let way = glide.position - position;
            lands = lands | may_meet_solids(cx, position, vec3_dot(way, way));
        }
        let moved = falls & !lands;
        let Glide { position, drift: velocity, phase } = glide;
        let mut new_places = [position.x, position.y, position.z, P::from_bits(bits)];
        let mut new_drifts = [velocity.x, velocity.y, velocity.z, P::from_bits(phase)];
        let mut new_attitudes = turned.to_array();
        // Without a branch for each leaf: where leaves fall and lie side by side, it would be guessed wrong half the time.
        if (!moved).any() {
            new_places = select_four(moved, new_places, places);
            new_drifts = select_four(moved, new_drifts, drifts);
            new_attitudes = select_four(moved, new_attitudes, load_block(simd, attitude, part));
        }
        store_block(place, part, new_places);
        store_block(drift, part, new_drifts);
        store_block(attitude, part, new_attitudes);
        Outcome { left: P::bits_of(is_left | (falls & lands)), stirring }
    }
}
