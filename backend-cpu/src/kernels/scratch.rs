// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! What the pass towards the foot leaves for the pass towards the tips: how joints answer, and what limbs hand down.
//!
//! Answers are for the same segments in both passes, so they stay in lanes.

use bytemuck::{Pod, Zeroable};
use windfall_core::arith::pack::{BLOCK, Pack};
use windfall_core::arith::{Mat3, Vec3};
use windfall_core::device::tree::sway::{JointResponse, TwigResponse, VelocityProducts};
use windfall_core::tree::record::Work;

use super::branch_block::{Column, Spare};
use super::segment_block::{HANDED, Lanes, MOTIONS};

/// Numbers of an [`JointResponse`].
const RESPONSES: usize = 30;
/// Numbers of a [`TwigResponse`].
const TWIG_RESPONSES: usize = 15;

/// Numbers that are kept lane by lane from one pass to the next.
#[derive(Clone, Debug)]
pub(crate) struct Kept<const N: usize>([Lanes; N]);

impl<const N: usize> Kept<N> {
    #[inline(always)]
    fn keep<P: Pack>(&mut self, at: usize, part: usize, number: P) {
        self.0[at].store(part, number);
    }

    #[inline(always)]
    fn keep_vector<P: Pack>(&mut self, at: usize, part: usize, v: Vec3<P>) {
        self.keep(at, part, v.x);
        self.keep(at + 1, part, v.y);
        self.keep(at + 2, part, v.z);
    }

    #[inline(always)]
    fn keep_products<P: Pack>(&mut self, at: usize, part: usize, products: &VelocityProducts<P>) {
        self.keep_vector(at, part, products.arm);
        self.keep_vector(at + 3, part, products.angular);
        self.keep_vector(at + 6, part, products.centripetal);
    }

    #[inline(always)]
    fn kept<P: Pack>(&self, simd: P::Simd, at: usize, part: usize) -> P {
        self.0[at].load(simd, part)
    }

    #[inline(always)]
    fn kept_vector<P: Pack>(&self, simd: P::Simd, at: usize, part: usize) -> Vec3<P> {
        Vec3::new(self.kept(simd, at, part), self.kept(simd, at + 1, part), self.kept(simd, at + 2, part))
    }

    #[inline(always)]
    fn kept_matrix<P: Pack>(&self, simd: P::Simd, at: usize, part: usize) -> Mat3<P> {
        Mat3 {
            x: self.kept_vector(simd, at, part),
            y: self.kept_vector(simd, at + 3, part),
            z: self.kept_vector(simd, at + 6, part),
        }
    }

    #[inline(always)]
    fn kept_products<P: Pack>(&self, simd: P::Simd, at: usize, part: usize) -> VelocityProducts<P> {
        VelocityProducts {
            arm: self.kept_vector(simd, at, part),
            angular: self.kept_vector(simd, at + 3, part),
            centripetal: self.kept_vector(simd, at + 6, part),
        }
    }
}

/// How the joints of a block's limbs answer.
pub(crate) type LimbResponses = Kept<RESPONSES>;
/// How the joints of twigs answer.
pub(crate) type TwigResponses = Kept<TWIG_RESPONSES>;

impl LimbResponses {
    #[inline(always)]
    pub(crate) fn keep_response<P: Pack>(&mut self, part: usize, response: &JointResponse<P>) {
        self.keep_vector(0, part, response.free);
        self.keep_vector(3, part, response.spring.x);
        self.keep_vector(6, part, response.spring.y);
        self.keep_vector(9, part, response.spring.z);
        self.keep_vector(12, part, response.lever.x);
        self.keep_vector(15, part, response.lever.y);
        self.keep_vector(18, part, response.lever.z);
        self.keep_products(21, part, &response.products);
    }

    #[inline(always)]
    pub(crate) fn response<P: Pack>(&self, simd: P::Simd, part: usize) -> JointResponse<P> {
        JointResponse {
            free: self.kept_vector(simd, 0, part),
            spring: self.kept_matrix(simd, 3, part),
            lever: self.kept_matrix(simd, 12, part),
            products: self.kept_products(simd, 21, part),
        }
    }
}

impl TwigResponses {
    #[inline(always)]
    pub(crate) fn keep_response<P: Pack>(&mut self, part: usize, response: &TwigResponse<P>) {
        self.keep_vector(0, part, response.free);
        self.keep(3, part, response.spring_along);
        self.keep(4, part, response.spring_across);
        self.keep(5, part, response.lever);
        self.keep_products(6, part, &response.products);
    }

    #[inline(always)]
    pub(crate) fn response<P: Pack>(&self, simd: P::Simd, part: usize) -> TwigResponse<P> {
        TwigResponse {
            free: self.kept_vector(simd, 0, part),
            spring_along: self.kept(simd, 3, part),
            spring_across: self.kept(simd, 4, part),
            lever: self.kept(simd, 5, part),
            products: self.kept_products(simd, 6, part),
        }
    }
}

/// What the limbs of a block hand down.
#[derive(Clone, Copy, Debug, Pod, Zeroable)]
#[repr(C, align(64))]
pub(crate) struct Handed(pub(super) [Column; HANDED]);

/// How the limbs of a block accelerate.
#[derive(Clone, Copy, Debug, Pod, Zeroable)]
#[repr(C, align(64))]
pub(crate) struct Motions(pub(super) [Column; MOTIONS]);

/// Results of the pass towards the foot for the largest batch, used by one thread for one batch after another, so that
/// they stay in its cache.
#[derive(Debug)]
pub(crate) struct Scratch {
    /// For one segment after another.
    pub(crate) work: Vec<Work>,
    /// For one block after another.
    pub(crate) blocks: BlockScratch,
}

/// The same for one block after another.
#[derive(Debug)]
pub(crate) struct BlockScratch {
    /// What limbs hand down, block by block; the last block is nothing, which no limb ever writes.
    pub(crate) handed: Vec<Handed>,
    /// How limbs accelerate, block by block.
    pub(crate) motions: Vec<Motions>,
    /// One for each block.
    pub(crate) limbs: Vec<LimbResponses>,
    /// One for each block of twigs.
    pub(crate) twigs: Vec<TwigResponses>,
    /// For a block that is not full.
    pub(crate) spare: Spare,
    /// For one of twigs beside it.
    pub(crate) spare_twigs: Spare,
}

impl Scratch {
    /// Room for batches of up to so many rows, blocks, and blocks of twigs.
    pub(crate) fn new(rows: usize, blocks: usize, twigs: usize) -> Self {
        let mut handed = vec![Handed::zeroed(); blocks + 1];
        // Minus zero leaves every sum as it is.
        handed[blocks] = Handed([[[-0.0; 4]; BLOCK]; HANDED]);
        let blocks = BlockScratch {
            handed,
            motions: vec![Motions::zeroed(); blocks],
            limbs: vec![Kept([Lanes::ZERO; RESPONSES]); blocks],
            twigs: vec![Kept([Lanes::ZERO; TWIG_RESPONSES]); twigs],
            spare: Spare::new(),
            spare_twigs: Spare::new(),
        };
        Self { work: vec![Work::default(); rows], blocks }
    }
}
