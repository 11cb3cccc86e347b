// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! twin: backend-wgpu/src/shaders/kernels/stack_litter.wgsl
//!
//! Makes the changes of the litter that leaves wait for, after all of them have gone through a step.

use std::sync::{Mutex, PoisonError};

use windfall_core::Context;
use windfall_core::device::leaf::stack::leaf_stack;
use windfall_core::leaf::LeavesMut;
use windfall_core::litter::Bed;

use crate::exposed::ExposedLeaves;
use crate::quiet::QuietUnits;
use crate::simd::branch_block::word;

/// Slots whose leaves wait for the litter to change, in any order.
#[derive(Debug, Default)]
pub(crate) struct LitterChanges(Mutex<Vec<u32>>);

impl LitterChanges {
    /// Lists leaves of a chunk that begins with slot `first`.
    pub(crate) fn list(&self, changing: &[usize], first: usize) {
        if !changing.is_empty() {
            let slots = changing.iter().map(|slot| word(first + slot));
            self.0.lock().unwrap_or_else(PoisonError::into_inner).extend(slots);
        }
    }
}

/// Makes the changes. `cx` is a view without litter.
pub(crate) fn stack_litter(
    cx: &Context<'_>,
    leaves: &mut LeavesMut<'_>,
    bed: &mut Bed,
    quiet: &QuietUnits,
    exposed: &ExposedLeaves,
    changes: &LitterChanges,
) {
    for slot in changes.0.lock().unwrap_or_else(PoisonError::into_inner).drain(..) {
        let change = leaf_stack(cx, &mut leaves.row_mut(slot as usize));
        bed.apply(&cx.scene.litter, &change);
        if change.lies {
            exposed.add(slot as usize);
        } else {
            quiet.wake(slot);
        }
    }
}
