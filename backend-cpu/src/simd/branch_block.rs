// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! State of the segments of a block: in the columns of the store, or in a copy that is filled up to sixteen rows.

use std::ops::Range;

use windfall_core::arith::lane::Word;
use windfall_core::arith::pack::{BLOCK, Pack, ROWS_OF_LANES, load_block, row_of_lane, store_block};
use windfall_core::arith::{Quat, Vec3};
use windfall_core::device::tree::sway::row::Rows;
use windfall_core::device::tree::sway::{Body, Joint};
use windfall_core::tree::BranchesMut;

/// One record of all rows of a block.
pub(crate) type Column = [[f32; 4]; BLOCK];

/// Columns of a block, as the fields of [`BranchesMut`].
#[derive(Clone, Copy, Debug)]
pub(crate) struct BranchBlock<C> {
    pub(crate) turn: C,
    pub(crate) rate: C,
    pub(crate) base: C,
    pub(crate) pose: C,
    pub(crate) velocity: C,
    pub(crate) spin: C,
    pub(crate) air: C,
}

/// State of a block and the leaves on its segments, to be read.
#[derive(Clone, Copy)]
pub(crate) struct BlockState<'a> {
    columns: BranchBlock<&'a Column>,
    leaf_counts: &'a [u32; BLOCK],
}

impl BlockState<'_> {
    /// Pose and velocity of the segments.
    #[inline(always)]
    pub(crate) fn bodies<P: Pack>(&self, simd: P::Simd, part: usize) -> Body<P> {
        let BranchBlock { base, pose, velocity, spin, .. } = self.columns;
        bodies_in(simd, [base, pose, velocity, spin], part)
    }

    /// Joints of the segments.
    #[inline(always)]
    pub(crate) fn joints<P: Pack>(&self, simd: P::Simd, part: usize) -> Joint<P> {
        joints_of(simd, self.columns.turn, self.columns.rate, part)
    }

    /// Air that was sampled at the ends of the limbs.
    #[inline(always)]
    pub(crate) fn airs<P: Pack>(&self, simd: P::Simd, part: usize) -> Vec3<P> {
        vector_and_fourth(load_block(simd, self.columns.air, part)).0
    }

    /// Numbers of leaves on the segments.
    #[inline(always)]
    pub(crate) fn leaf_counts<P: Pack>(&self, simd: P::Simd, part: usize) -> P {
        let counts: [u32; BLOCK] = core::array::from_fn(|lane| self.leaf_counts[row_of_lane(lane)]);
        P::load_words(simd, &counts[part * P::LANES..]).to_real()
    }
}

impl BranchBlock<&mut Column> {
    /// Poses and velocities of the segments.
    #[inline(always)]
    pub(crate) fn bodies<P: Pack>(&self, simd: P::Simd, part: usize) -> Body<P> {
        bodies_in(simd, [&*self.base, &*self.pose, &*self.velocity, &*self.spin], part)
    }

    /// Orientations of the segments.
    #[inline(always)]
    pub(crate) fn poses<P: Pack>(&self, simd: P::Simd, part: usize) -> Quat<P> {
        load_block(simd, self.pose, part).into()
    }

    /// Joints of the segments.
    #[inline(always)]
    pub(crate) fn joints<P: Pack>(&self, simd: P::Simd, part: usize) -> Joint<P> {
        joints_of(simd, self.turn, self.rate, part)
    }

    /// Replaces joints, poses and velocities.
    #[inline(always)]
    pub(crate) fn store<P: Pack>(&mut self, simd: P::Simd, part: usize, joint: &Joint<P>, body: &Body<P>) {
        let zero = P::fill(simd, 0.0);
        store_block(self.turn, part, joint.turn.to_array());
        store_vector(self.rate, part, joint.rate, zero);
        store_vector(self.base, part, body.base, zero);
        store_block(self.pose, part, body.pose.to_array());
        store_vector(self.velocity, part, body.velocity, zero);
        store_vector(self.spin, part, body.spin, zero);
    }

    /// Replaces the air.
    #[inline(always)]
    pub(crate) fn store_airs<P: Pack>(&mut self, simd: P::Simd, part: usize, air: Vec3<P>) {
        store_vector(self.air, part, air, P::fill(simd, 0.0));
    }
}

/// Poses and velocities in the columns of base, pose, velocity and spin.
#[inline(always)]
fn bodies_in<P: Pack>(simd: P::Simd, [base, pose, velocity, spin]: [&Column; 4], part: usize) -> Body<P> {
    Body {
        base: vector_and_fourth(load_block(simd, base, part)).0,
        pose: load_block(simd, pose, part).into(),
        velocity: vector_and_fourth(load_block(simd, velocity, part)).0,
        spin: vector_and_fourth(load_block(simd, spin, part)).0,
    }
}

#[inline(always)]
fn joints_of<P: Pack>(simd: P::Simd, turn: &Column, rate: &Column, part: usize) -> Joint<P> {
    Joint {
        turn: load_block(simd, turn, part).into(),
        rate: vector_and_fourth(load_block(simd, rate, part)).0,
    }
}

/// Copy of a block that has fewer rows than lanes.
#[derive(Debug)]
pub(crate) struct Spare {
    columns: BranchBlock<Column>,
    leaf_counts: [u32; BLOCK],
}

impl Spare {
    pub(crate) fn new() -> Self {
        let [turn, rate, base, pose, velocity, spin, air] = [[[0.0; 4]; BLOCK]; 7];
        Self { columns: BranchBlock { turn, rate, base, pose, velocity, spin, air }, leaf_counts: [0; BLOCK] }
    }

    /// Copies fewer rows than a block has, the last one once more for each that is missing.
    #[cold]
    fn fill(&mut self, branches: &BranchesMut<'_>, rows: Range<usize>) {
        fill_up(&mut self.columns.turn, &branches.turn[rows.clone()]);
        fill_up(&mut self.columns.rate, &branches.rate[rows.clone()]);
        fill_up(&mut self.columns.base, &branches.base[rows.clone()]);
        fill_up(&mut self.columns.pose, &branches.pose[rows.clone()]);
        fill_up(&mut self.columns.velocity, &branches.velocity[rows.clone()]);
        fill_up(&mut self.columns.spin, &branches.spin[rows.clone()]);
        fill_up(&mut self.columns.air, &branches.air[rows.clone()]);
        fill_up(&mut self.leaf_counts, &branches.leaf_count[rows]);
    }

    /// Copies the rows back.
    #[cold]
    fn write(&self, branches: &mut BranchesMut<'_>, rows: Range<usize>) {
        let count = rows.len();
        branches.turn[rows.clone()].copy_from_slice(&self.columns.turn[..count]);
        branches.rate[rows.clone()].copy_from_slice(&self.columns.rate[..count]);
        branches.base[rows.clone()].copy_from_slice(&self.columns.base[..count]);
        branches.pose[rows.clone()].copy_from_slice(&self.columns.pose[..count]);
        branches.velocity[rows.clone()].copy_from_slice(&self.columns.velocity[..count]);
        branches.spin[rows.clone()].copy_from_slice(&self.columns.spin[..count]);
        branches.air[rows].copy_from_slice(&self.columns.air[..count]);
    }
}

fn fill_up<T: Copy>(all: &mut [T; BLOCK], some: &[T]) {
    for (number, one) in all.iter_mut().enumerate() {
        *one = some[number.min(some.len() - 1)];
    }
}

/// State of rows, to be read; behind the last row of the block lies the state of whatever rows come next.
#[inline(always)]
pub(crate) fn state_of<'a>(
    branches: &'a BranchesMut<'_>,
    rows: &Range<usize>,
    spare: &'a mut Spare,
) -> BlockState<'a> {
    if branches.turn.len() < rows.start + BLOCK {
        spare.fill(branches, rows.clone());
        let BranchBlock { turn, rate, base, pose, velocity, spin, air } = &spare.columns;
        let columns = BranchBlock { turn, rate, base, pose, velocity, spin, air };
        return BlockState { columns, leaf_counts: &spare.leaf_counts };
    }
    BlockState {
        columns: BranchBlock {
            turn: block(&*branches.turn, rows),
            rate: block(&*branches.rate, rows),
            base: block(&*branches.base, rows),
            pose: block(&*branches.pose, rows),
            velocity: block(&*branches.velocity, rows),
            spin: block(&*branches.spin, rows),
            air: block(&*branches.air, rows),
        },
        leaf_counts: block(&*branches.leaf_count, rows),
    }
}

/// Changes the state of rows.
#[inline(always)]
pub(crate) fn change_state<T>(
    branches: &mut BranchesMut<'_>,
    rows: &Range<usize>,
    spare: &mut Spare,
    change: impl FnOnce(BranchBlock<&mut Column>) -> T,
) -> T {
    let is_full = rows.len() == BLOCK;
    if !is_full {
        spare.fill(branches, rows.clone());
    }
    let columns = if is_full {
        BranchBlock {
            turn: block_mut(branches.turn, rows),
            rate: block_mut(branches.rate, rows),
            base: block_mut(branches.base, rows),
            pose: block_mut(branches.pose, rows),
            velocity: block_mut(branches.velocity, rows),
            spin: block_mut(branches.spin, rows),
            air: block_mut(branches.air, rows),
        }
    } else {
        let BranchBlock { turn, rate, base, pose, velocity, spin, air } = &mut spare.columns;
        BranchBlock { turn, rate, base, pose, velocity, spin, air }
    };
    let result = change(columns);
    if !is_full {
        spare.write(branches, rows.clone());
    }
    result
}

/// Changes position and orientation of the rows of a full block by what they and the velocities are.
#[inline(always)]
pub(crate) fn change_places<P: Pack>(
    simd: P::Simd,
    branches: &mut BranchesMut<'_>,
    (first, part): (usize, usize),
    change: impl FnOnce(&Body<P>) -> Body<P>,
) {
    let rows = first..first + BLOCK;
    let (base, pose) = (block_mut(branches.base, &rows), block_mut(branches.pose, &rows));
    let (velocity, spin) = (block(&*branches.velocity, &rows), block(&*branches.spin, &rows));
    let body = change(&bodies_in(simd, [&*base, &*pose, velocity, spin], part));
    store_vector(base, part, body.base, P::fill(simd, 0.0));
    store_block(pose, part, body.pose.to_array());
}

#[inline(always)]
fn block<'a, T>(column: &'a [T], rows: &Range<usize>) -> &'a [T; BLOCK] {
    column[rows.start..].first_chunk().expect("a full block")
}

#[inline(always)]
fn block_mut<'a, T>(column: &'a mut [T], rows: &Range<usize>) -> &'a mut [T; BLOCK] {
    column[rows.start..].first_chunk_mut().expect("a full block")
}

/// Lanes of a block that have rows.
#[inline(always)]
pub(crate) fn lanes_with_rows<P: Pack>(simd: P::Simd, count: usize, part: usize) -> P::Mask {
    let rows = P::load_words(simd, &ROWS_OF_LANES[part * P::LANES..]);
    rows.less_than(rows.all(word(count)))
}

/// Pose and velocity of segments in any rows.
#[inline(always)]
pub(crate) fn bodies_of<P: Pack>(rows: &Rows<'_>, of: P::Word) -> Body<P> {
    let branches = &rows.branches;
    Body {
        base: vector_and_fourth(of.look_up(branches.base)).0,
        pose: of.look_up(branches.pose).into(),
        velocity: vector_and_fourth(of.look_up(branches.velocity)).0,
        spin: vector_and_fourth(of.look_up(branches.spin)).0,
    }
}

/// Ground that trunks grow from.
#[inline(always)]
pub(crate) fn ground<P: Pack>(simd: P::Simd) -> Body<P> {
    let zero = P::fill(simd, 0.0);
    let still = Vec3::new(zero, zero, zero);
    Body { base: still, pose: Quat::new(zero, zero, zero, P::fill(simd, 1.0)), velocity: still, spin: still }
}

/// Writes vectors with a fourth number each.
#[inline(always)]
pub(crate) fn store_vector<P: Pack>(column: &mut Column, part: usize, v: Vec3<P>, fourth: P) {
    store_block(column, part, [v.x, v.y, v.z, fourth]);
}

/// Splits records of four into a vector and the fourth number.
#[inline(always)]
pub(crate) fn vector_and_fourth<P: Pack>([x, y, z, fourth]: [P; 4]) -> (Vec3<P>, P) {
    (Vec3::new(x, y, z), fourth)
}

/// Number of segments, slots or lanes as a word.
#[expect(clippy::cast_possible_truncation, reason = "they are counted in words")]
pub(crate) const fn word(number: usize) -> u32 {
    number as u32
}
