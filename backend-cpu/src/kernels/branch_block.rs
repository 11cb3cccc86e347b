// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! State of the rows of a block: where they lie, or in a copy that is filled up to sixteen.

use std::ops::Range;

use windfall_core::arith::pack::BLOCK;
use windfall_core::tree::BranchesMut;

/// One record of all rows of a block.
pub(super) type Column = [[f32; 4]; BLOCK];

/// Rotation and rate of joints, place, orientation, velocity and spin of segments.
pub(super) type State<'a> = [&'a Column; 6];

/// Room for a block that is not full.
#[derive(Debug)]
pub(crate) struct Spare {
    columns: [Column; 6],
    bearing: [u32; BLOCK],
}

impl Spare {
    pub(crate) fn new() -> Self {
        Self { columns: [[[0.0; 4]; BLOCK]; 6], bearing: [0; BLOCK] }
    }

    /// Copies fewer rows than a block has, the last one once more for all that are missing.
    #[cold]
    fn fill(&mut self, branches: &BranchesMut<'_>, rows: Range<usize>) {
        let BranchesMut { turn, rate, base, pose, velocity, spin, bearing } = branches;
        for (spare, column) in self.columns.iter_mut().zip([turn, rate, base, pose, velocity, spin]) {
            fill_up(spare, &column[rows.clone()]);
        }
        fill_up(&mut self.bearing, &bearing[rows]);
    }

    /// Copies them back.
    #[cold]
    fn write(&self, branches: &mut BranchesMut<'_>, rows: Range<usize>) {
        let BranchesMut { turn, rate, base, pose, velocity, spin, .. } = branches;
        for (spare, column) in self.columns.iter().zip([turn, rate, base, pose, velocity, spin]) {
            column[rows.clone()].copy_from_slice(&spare[..rows.len()]);
        }
    }
}

fn fill_up<T: Copy>(all: &mut [T; BLOCK], some: &[T]) {
    for (number, one) in all.iter_mut().enumerate() {
        *one = some[number.min(some.len() - 1)];
    }
}

/// State of rows and the leaves on them, to be read; behind the last row of the block stands whatever comes next.
#[inline(always)]
pub(super) fn state_of<'a>(
    branches: &'a BranchesMut<'_>,
    rows: &Range<usize>,
    spare: &'a mut Spare,
) -> (State<'a>, &'a [u32; BLOCK]) {
    if branches.turn.len() < rows.start + BLOCK {
        spare.fill(branches, rows.clone());
        return (spare.columns.each_ref(), &spare.bearing);
    }
    let columns = [
        block(&*branches.turn, rows),
        block(&*branches.rate, rows),
        block(&*branches.base, rows),
        block(&*branches.pose, rows),
        block(&*branches.velocity, rows),
        block(&*branches.spin, rows),
    ];
    (columns, block(&*branches.bearing, rows))
}

/// Changes the state of rows.
#[inline(always)]
pub(super) fn change_state<T>(
    branches: &mut BranchesMut<'_>,
    rows: &Range<usize>,
    spare: &mut Spare,
    change: impl FnOnce([&mut Column; 6]) -> T,
) -> T {
    let is_full = rows.len() == BLOCK;
    if !is_full {
        spare.fill(branches, rows.clone());
    }
    let columns = if is_full {
        [
            block_mut(branches.turn, rows),
            block_mut(branches.rate, rows),
            block_mut(branches.base, rows),
            block_mut(branches.pose, rows),
            block_mut(branches.velocity, rows),
            block_mut(branches.spin, rows),
        ]
    } else {
        spare.columns.each_mut()
    };
    let result = change(columns);
    if !is_full {
        spare.write(branches, rows.clone());
    }
    result
}

#[inline(always)]
fn block<'a, T>(column: &'a [T], rows: &Range<usize>) -> &'a [T; BLOCK] {
    column[rows.start..].first_chunk().expect("a full block")
}

#[inline(always)]
fn block_mut<'a, T>(column: &'a mut [T], rows: &Range<usize>) -> &'a mut [T; BLOCK] {
    column[rows.start..].first_chunk_mut().expect("a full block")
}
