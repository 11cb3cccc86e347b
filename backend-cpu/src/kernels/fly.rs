// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! twin: backend-wgpu/src/shaders/kernels/fly.wgsl
//!
//! Moves the leaves of a chunk that fly as bodies through one step.

use windfall_core::Context;
use windfall_core::arith::pack::{BLOCK, Pack};
use windfall_core::device::leaf::fly::leaf_fly;
use windfall_core::device::leaf::record::flies;
use windfall_core::leaf::{Attitude, Drift, Identity, LeavesMut, Place, Schedule};

use super::CHUNK;
use super::resolve_events::EventList;
use crate::quiet::places_of;
use crate::simd::flying_block::FlyingBlock;
use crate::simd::{Simd, in_packs};

/// Steps the bodies of one chunk, among the leaves that `advance` has found on their way.
pub(crate) fn fly(cx: &Context<'_>, leaves: &mut LeavesMut<'_>, events: &EventList, simd: Simd) {
    match simd {
        Simd::Scalar => {
            for (block, stirring) in events.stirring_blocks() {
                fly_each(cx, leaves, block * BLOCK, stirring);
            }
        }
        Simd::Lanes(level) => in_packs!(level, fly_lanes(cx, leaves, events)),
    }
}

/// Steps those leaves of a block with a bit that are bodies. Few need it: one copy of it is enough.
#[inline(never)]
fn fly_each(cx: &Context<'_>, leaves: &mut LeavesMut<'_>, first: usize, bits: u32) {
    places_of(bits.into()).for_each(|place| leaf_fly(cx, &mut leaves.row_mut(first + place)));
}

/// Leaves of a block from which on it is worked on where it lies. Blocks with fewer share registers: where a few leaves of the litter are
/// awake among many that lie, most lanes would be idle.
pub(super) const DENSE: u32 = 8;

/// Blocks of a chunk whose leaves share registers with those of others: bits of these leaves.
pub(super) type FewOfBlocks = [u32; CHUNK / BLOCK];

/// Takes the next of these slots, at most as many as a block has.
#[inline(always)]
pub(super) fn next_few(slots: &mut impl Iterator<Item = usize>) -> ([usize; BLOCK], usize) {
    let (mut next, mut count) = ([0; BLOCK], 0);
    for (to, slot) in next.iter_mut().zip(slots) {
        *to = slot;
        count += 1;
    }
    (next, count)
}

/// Slots of these leaves.
#[inline(always)]
pub(super) fn slots_of(few: FewOfBlocks) -> impl Iterator<Item = usize> {
    let blocks = few.into_iter().enumerate().filter(|&(_, bits)| bits != 0);
    blocks.flat_map(|(block, bits)| places_of(bits.into()).map(move |place| block * BLOCK + place))
}

/// Bodies that are stepped together: those of a block where they lie, or few from here and there.
enum Together {
    Block(usize),
    Few([usize; BLOCK], usize),
}

/// Steps the bodies of blocks side by side; those that land, and the last few slots, one by one. The flight is called in one place, since
/// every call of it is another copy of long code, which takes long to compile.
#[inline(always)]
fn fly_lanes<P: Pack>(simd: P::Simd, cx: &Context<'_>, leaves: &mut LeavesMut<'_>, events: &EventList) {
    let mut few: FewOfBlocks = [0; CHUNK / BLOCK];
    let mut blocks = events.stirring_blocks();
    let mut slots = None;
    let mut gathered = Gathered::default();
    loop {
        let together = if let Some((block, stirring)) = blocks.next() {
            let first = block * BLOCK;
            if leaves.len() < first + BLOCK {
                fly_each(cx, leaves, first, stirring);
                continue;
            }
            let awake = bodies_in(leaves, first);
            if awake.count_ones() < DENSE {
                few[block] = awake;
                continue;
            }
            Together::Block(first)
        } else {
            let (next, count) = next_few(slots.get_or_insert_with(|| slots_of(few)));
            if count == 0 {
                break;
            }
            gathered.load(leaves, &next[..count]);
            Together::Few(next, count)
        };
        let landing = match together {
            Together::Block(first) => block_of(leaves, first),
            Together::Few(..) => gathered.block(),
        }
        .fly::<P>(simd, cx);
        match together {
            Together::Block(first) => fly_each(cx, leaves, first, landing),
            Together::Few(slots, count) => {
                gathered.store(leaves, &slots[..count]);
                places_of(landing.into()).for_each(|at| fly_each(cx, leaves, slots[at], 1));
            }
        }
    }
}

/// A bit for each leaf of a block that flies as a body.
#[inline(always)]
fn bodies_in(leaves: &LeavesMut<'_>, first: usize) -> u32 {
    let places = leaves.place[first..].iter().take(BLOCK);
    (0..).zip(places).fold(0, |bits, (place, of)| bits | (u32::from(flies(of.bits)) << place))
}

/// Bodies from here and there, at most as many as a block has. Those behind the last of them do not fly.
#[derive(Default)]
struct Gathered {
    place: [Place; BLOCK],
    drift: [Drift; BLOCK],
    attitude: [Attitude; BLOCK],
    schedule: [Schedule; BLOCK],
    identity: [Identity; BLOCK],
}

impl Gathered {
    /// Takes the leaves of these slots.
    #[inline(always)]
    fn load(&mut self, leaves: &LeavesMut<'_>, slots: &[usize]) {
        self.place = [Place::default(); BLOCK];
        for (at, &slot) in slots.iter().enumerate() {
            self.place[at] = leaves.place[slot];
            self.drift[at] = leaves.drift[slot];
            self.attitude[at] = leaves.attitude[slot];
            self.schedule[at] = leaves.schedule[slot];
            self.identity[at] = leaves.identity[slot];
        }
    }

    /// Puts the leaves back.
    #[inline(always)]
    fn store(&self, leaves: &mut LeavesMut<'_>, slots: &[usize]) {
        for (at, &slot) in slots.iter().enumerate() {
            leaves.place[slot] = self.place[at];
            leaves.drift[slot] = self.drift[at];
            leaves.attitude[slot] = self.attitude[at];
            leaves.schedule[slot] = self.schedule[at];
            leaves.identity[slot] = self.identity[at];
        }
    }

    /// The leaves as a block.
    #[inline(always)]
    fn block(&mut self) -> FlyingBlock<'_> {
        FlyingBlock {
            place: &mut self.place,
            drift: &mut self.drift,
            attitude: &mut self.attitude,
            schedule: &mut self.schedule,
            identity: &mut self.identity,
        }
    }
}

/// The block of slots from one on.
#[inline(always)]
fn block_of<'a>(leaves: &'a mut LeavesMut<'_>, first: usize) -> FlyingBlock<'a> {
    FlyingBlock {
        place: block_in(leaves.place, first),
        drift: block_in(leaves.drift, first),
        attitude: block_in(leaves.attitude, first),
        schedule: block_in(leaves.schedule, first),
        identity: block_in(leaves.identity, first),
    }
}

/// Records of a column from a slot on.
#[inline(always)]
fn block_in<T>(column: &mut [T], first: usize) -> &mut [T; BLOCK] {
    column[first..].first_chunk_mut().expect("as many slots are left")
}
