// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Results of the inward pass over a batch of trees that the outward pass needs, and what segments pass on to one another
//! within a pass.

use bytemuck::{Pod, Zeroable, must_cast_slice};
use windfall_core::arith::pack::{BLOCK, Pack};
use windfall_core::arith::{Mat3, Sym3, Vec3};
use windfall_core::device::tree::sway::outward::Acceleration;
use windfall_core::device::tree::sway::{ArticulatedInertia, JointResponse, TwigResponse};
use windfall_core::tree::record::Work;

use super::branch_block::{Column, Spare, store_vector, vector_and_fourth};
use super::lanes::Lanes;

/// Records of four that an [`ArticulatedInertia`] takes.
pub(super) const INERTIA_RECORDS: usize = 7;
/// Records of four that an [`Acceleration`] takes.
pub(super) const ACCELERATION_RECORDS: usize = 2;

/// Scratch of one thread, used for one batch after another so that it stays in the cache: room for the largest batch.
#[derive(Debug)]
pub(crate) struct Scratch {
    /// For segments stepped one by one.
    pub(crate) work: Vec<Work>,
    /// For segments stepped in blocks.
    pub(crate) blocks: BlockScratch,
}

/// Scratch for one block after another.
#[derive(Debug)]
pub(crate) struct BlockScratch {
    /// Inertias that limbs pass on to their parents, block by block; the last block stands for missing children, and no limb
    /// writes to it.
    pub(crate) inertias: Vec<InertiaBlock>,
    /// Accelerations of limbs, block by block.
    pub(crate) accelerations: Vec<AccelerationBlock>,
    /// Responses of the joints of limbs, block by block.
    pub(crate) limbs: Vec<JointResponse<Lanes>>,
    /// Responses of the joints of twigs, block by block.
    pub(crate) twigs: Vec<TwigResponse<Lanes>>,
    /// For a block that is not full.
    pub(crate) spare: Spare,
    /// For a block of twigs beside it.
    pub(crate) spare_twigs: Spare,
}

impl Scratch {
    /// Room for batches of up to so many rows, blocks, and blocks of twigs.
    pub(crate) fn new(rows: usize, blocks: usize, twigs: usize) -> Self {
        let mut inertias = vec![InertiaBlock::zeroed(); blocks + 1];
        // Minus zero leaves every sum as it is.
        inertias[blocks] = InertiaBlock([[[-0.0; 4]; BLOCK]; INERTIA_RECORDS]);
        let blocks = BlockScratch {
            inertias,
            accelerations: vec![AccelerationBlock::zeroed(); blocks],
            limbs: vec![JointResponse::default(); blocks],
            twigs: vec![TwigResponse::default(); twigs],
            spare: Spare::new(),
            spare_twigs: Spare::new(),
        };
        Self { work: vec![Work::default(); rows], blocks }
    }
}

/// Articulated inertias of the limbs of a block, about the joints of their parents.
#[derive(Clone, Copy, Debug, Pod, Zeroable)]
#[repr(C, align(64))]
pub(crate) struct InertiaBlock([Column; INERTIA_RECORDS]);

impl InertiaBlock {
    /// Writes part of a block.
    #[inline(always)]
    pub(crate) fn store<P: Pack>(&mut self, simd: P::Simd, part: usize, body: &ArticulatedInertia<P>) {
        let [a, b, c, d, e, f, g] = &mut self.0;
        store_vector(a, part, body.rotation.diagonal, body.moment.x);
        store_vector(b, part, body.rotation.off, body.moment.y);
        store_vector(c, part, body.coupling.x, body.moment.z);
        store_vector(d, part, body.coupling.y, body.force.x);
        store_vector(e, part, body.coupling.z, body.force.y);
        store_vector(f, part, body.mass.diagonal, body.force.z);
        store_vector(g, part, body.mass.off, P::fill(simd, 0.0));
    }

    /// Reads the inertias of limbs in any blocks, by the indices of their first records.
    #[inline(always)]
    pub(crate) fn load_at<P: Pack>(simd: P::Simd, from: P::Word, blocks: &[Self]) -> ArticulatedInertia<P> {
        let spans = P::spans::<{ BLOCK * (INERTIA_RECORDS - 1) + 1 }>(from, must_cast_slice(blocks));
        let a = vector_and_fourth(P::column(simd, &spans, 0));
        let b = vector_and_fourth(P::column(simd, &spans, BLOCK));
        let c = vector_and_fourth(P::column(simd, &spans, 2 * BLOCK));
        let d = vector_and_fourth(P::column(simd, &spans, 3 * BLOCK));
        let e = vector_and_fourth(P::column(simd, &spans, 4 * BLOCK));
        let f = vector_and_fourth(P::column(simd, &spans, 5 * BLOCK));
        let g = vector_and_fourth(P::column(simd, &spans, 6 * BLOCK));
        ArticulatedInertia {
            rotation: Sym3 { diagonal: a.0, off: b.0 },
            coupling: Mat3 { x: c.0, y: d.0, z: e.0 },
            mass: Sym3 { diagonal: f.0, off: g.0 },
            moment: Vec3::new(a.1, b.1, c.1),
            force: Vec3::new(d.1, e.1, f.1),
        }
    }
}

/// Accelerations of the limbs of a block.
#[derive(Clone, Copy, Debug, Pod, Zeroable)]
#[repr(C, align(64))]
pub(crate) struct AccelerationBlock([Column; ACCELERATION_RECORDS]);

impl AccelerationBlock {
    /// Writes part of a block.
    #[inline(always)]
    pub(crate) fn store<P: Pack>(&mut self, simd: P::Simd, part: usize, acceleration: &Acceleration<P>) {
        let zero = P::fill(simd, 0.0);
        let [angular, linear] = &mut self.0;
        store_vector(angular, part, acceleration.angular, zero);
        store_vector(linear, part, acceleration.linear, zero);
    }

    /// Reads the accelerations of limbs in any blocks, by the indices of their first records.
    #[inline(always)]
    pub(crate) fn load_at<P: Pack>(simd: P::Simd, from: P::Word, blocks: &[Self]) -> Acceleration<P> {
        let spans = P::spans::<{ BLOCK * (ACCELERATION_RECORDS - 1) + 1 }>(from, must_cast_slice(blocks));
        let (angular, _) = vector_and_fourth(P::column(simd, &spans, 0));
        let (linear, _) = vector_and_fourth(P::column(simd, &spans, BLOCK));
        Acceleration { angular, linear }
    }
}
