// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Sixteen leaves on their twigs, side by side in SIMD registers, with the same bits as one by one.
//!
//! Few of them grow back or break in a step: those are done one by one.

use bytemuck::{cast_slice, must_cast_mut, must_cast_ref};
use windfall_core::Context;
use windfall_core::arith::Quat;
use windfall_core::arith::lane::{Mask, Word};
use windfall_core::arith::pack::{BLOCK, Pack, ROWS_OF_LANES, load_block, store_block};
use windfall_core::arith::vector::vec3_select;
use windfall_core::device::leaf::carry::{
    CarriedLeaf, PetioleLanes, leaf_follow, leaf_hangs, leaf_next_sample, leaf_sample_air, leaf_twig_pose,
};
use windfall_core::device::leaf::petiole::{PETIOLE_ROWS, SHED_INTERVAL, petiole_of};
use windfall_core::device::leaf::record::{smoothed_air_speed, smoothed_air_speed_word};
use windfall_core::device::tree::sway::row::Rows;
use windfall_core::leaf::{Attitude, Drift, LeavesMut, Place, Schedule};

use super::branch_block::{Column, bodies_of, store_vector, vector_and_fourth, word};
use crate::quiet::QuietUnits;

/// Slots that follow one another.
pub(crate) struct LeafBlock<'a> {
    /// The first of them.
    pub(crate) first: u32,
    pub(crate) place: &'a mut [Place; BLOCK],
    pub(crate) drift: &'a mut [Drift; BLOCK],
    pub(crate) attitude: &'a mut [Attitude; BLOCK],
    pub(crate) schedule: &'a mut [Schedule; BLOCK],
}

/// Petioles of slots, and the rows of their segments, counted from the batch's first.
#[inline(always)]
fn petioles_of<P: Pack>(
    simd: P::Simd,
    cx: &Context<'_>,
    slots: P::Word,
    first: u32,
) -> (PetioleLanes<P::Word>, P::Word) {
    let from = slots.all(cx.scene.first_petiole_row).plus(slots.times(slots.all(PETIOLE_ROWS)));
    let spans = P::spans::<{ PETIOLE_ROWS as usize }>(from, cast_slice(cx.tables));
    let (base, segment) = vector_and_fourth(P::column(simd, &spans, 0));
    let rest = Quat::from(P::column(simd, &spans, 1));
    let (_, bits) = vector_and_fourth(P::column(simd, &spans, 2));
    (PetioleLanes { base, rest, bits: bits.to_bits() }, segment.to_bits().minus(slots.all(first)))
}

/// `yes` where true, `no` elsewhere.
#[inline(always)]
pub(crate) fn select_four<P: Pack>(mask: P::Mask, yes: [P; 4], no: [P; 4]) -> [P; 4] {
    core::array::from_fn(
        #[inline(always)]
        |number| mask.select_real(yes[number], no[number]),
    )
}

/// Smoothed air speeds of leaves that hang. The counts of others in that word would be subnormal floats, on which
/// processors are slow.
#[inline(always)]
fn air_speed_of<P: Pack>(simd: P::Simd, hangs: P::Mask, phase: P::Word) -> P {
    hangs.select_real(smoothed_air_speed(phase), P::fill(simd, 0.0))
}

/// Samples the wind at petioles of a group, of slots as far apart as those that do so in the same step: part of as many as
/// a block has lanes.
#[inline(always)]
pub(crate) fn sample_air<P: Pack>(
    simd: P::Simd,
    cx: &Context<'_>,
    rows: &mut Rows<'_>,
    leaves: &mut LeavesMut<'_>,
    quiet: &QuietUnits,
    first: u32,
    part: usize,
) {
    let order = &ROWS_OF_LANES[part * P::LANES..][..P::LANES];
    let next = leaf_next_sample(cx, first);
    let places = P::load_words(simd, order);
    let all = places.times(places.all(SHED_INTERVAL)).plus(places.all(next));
    let exists = all.less_than(all.all(word(leaves.len())));
    let number = exists.select(all, all.all(0));
    let [_, _, _, bits] = number.look_up(cast_slice(leaves.place));
    let [event, ..] = number.look_up(cast_slice(leaves.schedule));
    let hangs = leaf_hangs(cx, bits.to_bits(), event.to_bits());
    if !hangs.any() {
        return;
    }
    let [_, _, _, before] = number.look_up(cast_slice(leaves.drift));
    let slots = number.plus(number.all(first));
    let (petiole, row) = petioles_of::<P>(simd, cx, slots, rows.first);
    let segment = bodies_of(rows, hangs.select(row, row.all(0)));
    let (air_speed, breaks) =
        leaf_sample_air(cx, air_speed_of(simd, hangs, before.to_bits()), slots, &petiole, &segment);
    let zero = P::fill(simd, 0.0);
    let air_speeds = floats(hangs.select_real(air_speed, before));
    let breaks = floats((hangs & breaks).select_real(P::fill(simd, 1.0), zero));
    for (lane, place) in order.iter().enumerate() {
        let number = (next + place * SHED_INTERVAL) as usize;
        if number >= leaves.len() {
            continue;
        }
        leaves.drift[number].phase = smoothed_air_speed_word(air_speeds[lane]);
        if breaks[lane] > 0.0 {
            leaves.schedule[number].event = cx.step.index + 1;
            quiet.wake(first + word(number));
            let segment = petiole_of(cx, first + word(number)).segment;
            let leaf_count = &mut rows.branches.leaf_count[(segment - rows.first) as usize];
            *leaf_count = leaf_count.wrapping_sub(1);
        }
    }
}

/// The numbers of a pack's lanes.
#[inline(always)]
fn floats<P: Pack>(pack: P) -> [f32; BLOCK] {
    let mut floats = [0.0; BLOCK];
    pack.store(&mut floats);
    floats
}

impl LeafBlock<'_> {
    /// Moves those that hang.
    #[inline(always)]
    pub(crate) fn follow<P: Pack>(&mut self, simd: P::Simd, cx: &Context<'_>, rows: &Rows<'_>) {
        let mut some_break = false;
        for part in 0..BLOCK / P::LANES {
            some_break |= self.follow_part::<P>(simd, cx, rows, part);
        }
        if some_break {
            self.break_off(cx, rows);
        }
    }

    /// Moves part of them; whether any petiole has broken.
    #[inline(always)]
    fn follow_part<P: Pack>(
        &mut self,
        simd: P::Simd,
        cx: &Context<'_>,
        rows: &Rows<'_>,
        part: usize,
    ) -> bool {
        let (position, bits) = vector_and_fourth::<P>(load_block(simd, must_cast_ref(self.place), part));
        let [event, ..]: [P; 4] = load_block(simd, must_cast_ref(self.schedule), part);
        let event = event.to_bits();
        let hangs = leaf_hangs(cx, bits.to_bits(), event);
        if !hangs.any() {
            return false;
        }
        let (velocity, phase) = vector_and_fourth::<P>(load_block(simd, must_cast_ref(self.drift), part));
        let slots = P::load_words(simd, &ROWS_OF_LANES[part * P::LANES..]);
        let slots = slots.plus(slots.all(self.first));
        let (petiole, row) = petioles_of::<P>(simd, cx, slots, rows.first);
        let segment = bodies_of(rows, hangs.select(row, row.all(0)));
        let mut pose =
            leaf_twig_pose(cx, air_speed_of(simd, hangs, phase.to_bits()), slots, &petiole, &segment);
        let attitude: &mut Column = must_cast_mut(self.attitude);
        if (!hangs).any() {
            pose.position = vec3_select(hangs, pose.position, position);
            pose.velocity = vec3_select(hangs, pose.velocity, velocity);
            let before = load_block(simd, attitude, part);
            pose.attitude = select_four(hangs, pose.attitude.to_array(), before).into();
        }
        store_vector(must_cast_mut(self.place), part, pose.position, bits);
        store_vector(must_cast_mut(self.drift), part, pose.velocity, phase);
        store_block(attitude, part, pose.attitude.to_array());
        (hangs & event.equals(cx.step.index + 1)).any()
    }

    /// Leaves whose petioles have broken go once more, with all that they take along.
    #[cold]
    fn break_off(&mut self, cx: &Context<'_>, rows: &Rows<'_>) {
        let now = cx.step.index;
        for number in 0..BLOCK {
            let is_off = self.schedule[number].event == now + 1;
            if is_off && leaf_hangs(cx, self.place[number].bits, self.schedule[number].event) {
                let slot = self.first + word(number);
                let petiole = petiole_of(cx, slot);
                let segment = rows.body((petiole.segment - rows.first) as usize);
                let mut leaf = CarriedLeaf {
                    place: &mut self.place[number],
                    drift: &mut self.drift[number],
                    attitude: &mut self.attitude[number],
                    schedule: &mut self.schedule[number],
                };
                leaf_follow(cx, &mut leaf, slot, &PetioleLanes::from(&petiole), &segment);
            }
        }
    }
}
