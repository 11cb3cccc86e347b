// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! One step of sixteen leaves that fly as bodies, side by side in SIMD registers.

use bytemuck::{must_cast_mut, must_cast_ref};
use windfall_core::Context;
use windfall_core::arith::Quat;
use windfall_core::arith::lane::{Mask, Word};
use windfall_core::arith::pack::{BLOCK, Pack, load_block, rows_of_bits, store_block};
use windfall_core::device::flight::contact::OverGround;
use windfall_core::device::leaf::fly::{
    Flight, Flown, count_calm_steps, flight_advance, flight_ends, longest_way_squared, update_regime,
};
use windfall_core::device::leaf::record::{body_spin, body_spin_words, flies, regime_state};
use windfall_core::device::solid::near::may_meet_solids;
use windfall_core::device::wind::sample::wind_at;
use windfall_core::leaf::{Attitude, Drift, Identity, Place, Schedule};

use super::branch_block::{Column, vector_and_fourth};
use super::leaf_block::select_four;

/// Slots that follow one another.
pub(crate) struct FlyingBlock<'a> {
    pub(crate) place: &'a mut [Place; BLOCK],
    pub(crate) drift: &'a mut [Drift; BLOCK],
    pub(crate) attitude: &'a mut [Attitude; BLOCK],
    pub(crate) schedule: &'a mut [Schedule; BLOCK],
    pub(crate) identity: &'a mut [Identity; BLOCK],
}

/// Words of leaves that fly. What others count in their place would be subnormal floats, on which processors are slow.
#[inline(always)]
fn flying<W: Word>(on: W::Mask, words: W) -> W {
    on.select(words, words.all(0))
}

impl FlyingBlock<'_> {
    /// Steps those that fly as bodies, do not land and are near no solid part. A bit for each other body, the first in the lowest place.
    #[inline(always)]
    pub(crate) fn fly<P: Pack>(&mut self, simd: P::Simd, cx: &Context<'_>) -> u32 {
        let mut landing = 0;
        for part in 0..BLOCK / P::LANES {
            landing |= self.fly_part::<P>(simd, cx, part) << (part * P::LANES);
        }
        rows_of_bits(landing)
    }

    /// Steps part of them. Bits are those of its lanes.
    #[inline(always)]
    fn fly_part<P: Pack>(&mut self, simd: P::Simd, cx: &Context<'_>, part: usize) -> u32 {
        let place: &mut Column = must_cast_mut(self.place);
        let places: [P; 4] = load_block(simd, place, part);
        let (position, bits) = vector_and_fourth(places);
        let bits = bits.to_bits();
        let mut on = flies(bits);
        if !on.any() {
            return 0;
        }
        let drifts: [P; 4] = load_block(simd, must_cast_ref(self.drift), part);
        let (velocity, phase) = vector_and_fourth(drifts);
        let wind = wind_at(cx, position);
        let mut left = 0;
        if cx.scene.has_solids() {
            let near = may_meet_solids(cx, position, longest_way_squared(cx, velocity, wind));
            left = P::bits_of(on & near);
            on = on & !near;
            if !on.any() {
                return left;
            }
        }
        let attitudes: [P; 4] = load_block(simd, must_cast_ref(self.attitude), part);
        let schedules: [P; 4] = load_block(simd, must_cast_ref(self.schedule), part);
        let identities: [P; 4] = load_block(simd, must_cast_ref(self.identity), part);
        let [event, rate, size, heading] = schedules;
        let [id, release, fall_time, appearance] = identities;
        let spins = [phase, rate, heading].map(|word| flying(on, word.to_bits()));
        let [phase, rate, heading] = spins;
        let start =
            Flight { position, velocity, pose: Quat::from(attitudes), spin: body_spin(phase, rate, heading) };
        let Flown { flight, is_calm, is_wet } =
            flight_advance::<P, OverGround>(cx, start, bits, size.to_bits(), wind);
        let before = regime_state(fall_time.to_bits());
        let regime = update_regime(cx, &flight, wind, before, bits, size.to_bits());
        let bits = count_calm_steps(cx, regime.bits, is_calm, is_wet);
        let lands = flight_ends(cx, bits, flight.position);
        let moved = on & !lands;
        let Flight { position, velocity, pose, spin } = flight;
        let [x, y, z] = body_spin_words(spin);
        let [x, y, z] = [P::from_bits(x), P::from_bits(y), P::from_bits(z)];
        let bits = P::from_bits(bits);
        let new_places = [position.x, position.y, position.z, bits];
        let new_drifts = [velocity.x, velocity.y, velocity.z, x];
        let new_identities = [id, release, P::from_bits(regime.state), appearance];
        store_block(place, part, select_four(moved, new_places, places));
        store_block(must_cast_mut(self.drift), part, select_four(moved, new_drifts, drifts));
        let new_attitudes = select_four(moved, pose.to_array(), attitudes);
        store_block(must_cast_mut(self.attitude), part, new_attitudes);
        store_block(must_cast_mut(self.schedule), part, select_four(moved, [event, y, size, z], schedules));
        store_block(must_cast_mut(self.identity), part, select_four(moved, new_identities, identities));
        left | P::bits_of(on & lands)
    }
}
