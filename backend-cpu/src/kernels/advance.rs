// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! twin: backend-wgpu/src/shaders/kernels/advance.wgsl
//!
//! Moves every leaf through one step to which nothing happens in it, and leaves the others to `attend`.

use fearless_simd::dispatch;
use rayon::join;
use windfall_core::Context;
use windfall_core::kernel::lane::LANES;
use windfall_core::leaf::LeavesMut;
use windfall_core::leaf::advance::leaf_advance_plain;

use super::CHUNK;
use super::attend::{Attend, attend};
use super::eight::advance_eight;
use super::fly::fly;
use crate::simd::Simd;

/// Steps all leaves, halving the columns until a piece is one chunk.
pub(crate) fn advance(cx: &Context<'_>, mut leaves: LeavesMut<'_>, simd: Simd) {
    if leaves.len() <= CHUNK {
        advance_chunk(cx, &mut leaves, simd);
        return;
    }
    let middle = (leaves.len() / 2).next_multiple_of(CHUNK);
    let (front, back) = leaves.split_at(middle);
    join(|| advance(cx, front, simd), || advance(cx, back, simd));
}

/// Steps the leaves of one chunk.
fn advance_chunk(cx: &Context<'_>, leaves: &mut LeavesMut<'_>, simd: Simd) {
    let mut due = Attend::default();
    match simd {
        Simd::Scalar => {
            for (slot, mut leaf) in leaves.iter_mut().enumerate() {
                let attend = !leaf_advance_plain(cx, &mut leaf);
                due.lanes[slot / LANES] |= u8::from(attend) << (slot % LANES);
            }
        }
        Simd::Lanes(level) => dispatch!(level, simd => advance_lanes(simd, cx, leaves, &mut due)),
    }
    attend(cx, leaves, &due);
    if cx.environment.has_bodies() {
        fly(cx, leaves, simd);
    }
}

/// Steps a chunk eight leaves at a time; the last few, if they are fewer than eight, are all left to `attend`.
#[inline(always)]
fn advance_lanes<S: fearless_simd::Simd>(
    simd: S,
    cx: &Context<'_>,
    leaves: &mut LeavesMut<'_>,
    due: &mut Attend,
) {
    let count = leaves.len();
    let (place, _) = leaves.place.as_chunks_mut::<LANES>();
    let (drift, _) = leaves.drift.as_chunks_mut::<LANES>();
    let (attitude, _) = leaves.attitude.as_chunks_mut::<LANES>();
    let (course, _) = leaves.course.as_chunks::<LANES>();
    let hot = place.iter_mut().zip(drift).zip(attitude).zip(course);
    for (group, (((place, drift), attitude), course)) in hot.enumerate() {
        due.lanes[group] = advance_eight(simd, cx, place, drift, attitude, course);
    }
    let rest = count % LANES;
    if rest != 0 {
        due.lanes[count / LANES] = (1 << rest) - 1;
    }
}
