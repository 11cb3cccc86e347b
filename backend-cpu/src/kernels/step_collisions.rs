// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Lets leaves that fly as bodies collide with each other, as they are at the start of a step: all of them are added to the cells of the air
//! before the first of them collides.

use rayon::join;
use windfall_core::Context;
use windfall_core::leaf::{Leaves, LeavesMut};

use super::CHUNK;
use super::clear_collisions::clear_collisions;
use super::collide::collide;
use super::gather_collisions::gather_collisions;
use crate::cell_sums::CollisionCells;
use crate::quiet::{QuietUnit, UNIT};

/// Lets leaves collide. There is a word for each unit of slots.
pub(crate) fn step_collisions(
    cx: &Context<'_>,
    leaves: &mut Leaves,
    quiet: &[QuietUnit],
    cells: &CollisionCells,
) {
    each_chunk(leaves.as_mut(), quiet, &|chunk, quiet| gather_collisions(cx, chunk, quiet, cells));
    each_chunk(leaves.as_mut(), quiet, &|chunk, quiet| collide(cx, chunk, quiet, cells));
    clear_collisions(cells);
}

/// Goes through leaves chunk by chunk, in any order.
fn each_chunk(
    mut leaves: LeavesMut<'_>,
    quiet: &[QuietUnit],
    work: &(impl Fn(&mut LeavesMut<'_>, &[QuietUnit]) + Sync),
) {
    if leaves.len() <= CHUNK {
        work(&mut leaves, quiet);
        return;
    }
    let middle = (leaves.len() / 2).next_multiple_of(CHUNK);
    let (front, back) = leaves.split_at(middle);
    let (front_quiet, back_quiet) = quiet.split_at(middle / UNIT);
    join(|| each_chunk(front, front_quiet, work), || each_chunk(back, back_quiet, work));
}
