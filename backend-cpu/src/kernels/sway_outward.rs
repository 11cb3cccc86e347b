// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! twin: backend-wgpu/src/shaders/kernels/sway_outward.wgsl
//!
//! Outward pass over a batch of trees: accelerations of segments, and the integration of their joints.

use windfall_core::Context;
use windfall_core::arith::Vec3;
use windfall_core::arith::pack::{BLOCK, Pack};
use windfall_core::device::tree::sway::Body;
use windfall_core::device::tree::sway::load::segment_axis;
use windfall_core::device::tree::sway::outward::{
    Acceleration, joint_acceleration, joint_step, segment_place,
};
use windfall_core::device::tree::sway::row::{Rows, row_outward};
use windfall_core::device::tree::sway::twig::twig_acceleration;

use crate::simd::batch_blocks::{AHEAD, BatchBlocks, BatchStep, ConstantsOf, SegmentBlock};
use crate::simd::branch_block::{Spare, bodies_of, change_state, ground};
use crate::simd::sway_scratch::{AccelerationBlock, BlockScratch};
use crate::simd::{Simd, in_packs};

/// Steps a batch from the trunks to the twigs.
pub(crate) fn sway_outward(
    cx: &Context<'_>,
    rows: &mut Rows<'_>,
    blocks: &BatchBlocks,
    scratch: &mut BlockScratch,
    simd: Simd,
) {
    match simd {
        Simd::Scalar => (0..rows.segments.len()).for_each(|row| row_outward(cx, rows, row)),
        Simd::Lanes(level) => {
            let step = BatchStep { cx, rows, blocks };
            in_packs!(level, outward_lanes(step, scratch));
        }
    }
}

/// Steps block after block in lanes, with the same bits as row by row.
#[inline(always)]
fn outward_lanes<P: Pack>(simd: P::Simd, mut step: BatchStep<'_, '_>, scratch: &mut BlockScratch) {
    for number in (0..step.blocks.limbs.len()).rev() {
        if let Some(ahead) = number.checked_sub(AHEAD) {
            step.prefetch_limbs(ahead, &ConstantsOf::OUTWARD);
        }
        for part in 0..BLOCK / P::LANES {
            step.outward::<P>(simd, number, part, scratch);
        }
    }
}

impl BatchStep<'_, '_> {
    /// Steps part of a block of limbs and its twigs.
    #[inline(always)]
    fn outward<P: Pack>(&mut self, simd: P::Simd, number: usize, part: usize, scratch: &mut BlockScratch) {
        let block = &self.blocks.limbs[number];
        let (parent, above) = match &block.parents {
            Some(parents) => {
                let from = P::load_words(simd, &parents.accelerations[part * P::LANES..]);
                let above = AccelerationBlock::load_at::<P>(simd, from, &scratch.accelerations);
                (bodies_of(self.rows, P::load_words(simd, &parents.rows[part * P::LANES..])), above)
            }
            None => {
                let still = ground(simd);
                (still, Acceleration { angular: still.spin, linear: still.velocity })
            }
        };
        let response = scratch.limbs[number].map(
            #[inline(always)]
            |lanes| lanes.load(simd, part),
        );
        let (acceleration, own) = joint_acceleration(&response, &above);
        scratch.accelerations[number].store(simd, part, &acceleration);
        let own = |_| own;
        let body = self.integrate(simd, &block.segments, part, own, &parent, &mut scratch.spare);
        for number in block.twigs.clone() {
            self.prefetch_twigs(number.wrapping_sub(AHEAD), &ConstantsOf::OUTWARD);
            let response = scratch.twigs[number].map(
                #[inline(always)]
                |lanes| lanes.load(simd, part),
            );
            let own = |axis| twig_acceleration(&response, axis, &acceleration);
            self.integrate(simd, &self.blocks.twigs[number], part, own, &body, &mut scratch.spare);
        }
    }

    /// Integrates segments that follow one another with the angular accelerations `own` of their joints in world axes, a
    /// function of the segments' axes, and returns their new state.
    #[inline(always)]
    fn integrate<P: Pack>(
        &mut self,
        simd: P::Simd,
        segments: &SegmentBlock,
        part: usize,
        own: impl FnOnce(Vec3<P>) -> Vec3<P>,
        parent: &Body<P>,
        spare: &mut Spare,
    ) -> Body<P> {
        let cx = self.cx;
        change_state(
            &mut self.rows.branches,
            &segments.rows,
            spare,
            #[inline(always)]
            |mut state| {
                let before = Body { pose: state.poses(simd, part), ..*parent };
                let own = own(segment_axis(&before));
                let joint = joint_step(cx, &state.joints(simd, part), &before, own);
                let body = segment_place(&segments.constants(simd, part), &joint, parent);
                state.store(simd, part, &joint, &body);
                body
            },
        )
    }
}
