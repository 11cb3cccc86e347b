// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! twin: backend-wgpu/src/shaders/kernels/sway_inward.wgsl
//!
//! Inward pass over a batch of trees: responses of joints, and the inertias that segments pass on to their parents.

use std::ops::Range;

use windfall_core::Context;
use windfall_core::arith::matrix::sym3_trace;
use windfall_core::arith::pack::{BLOCK, Pack, row_of_lane};
use windfall_core::arith::vector::vec3_select;
use windfall_core::arith::{Mat3, Sym3, Vec3};
use windfall_core::device::tree::branch_snow::branch_snow_kg;
use windfall_core::device::tree::sway::inward::{
    articulated_add, articulated_shift, joint_response, joint_spring, velocity_products,
};
use windfall_core::device::tree::sway::load::{
    load_trace, segment_air, segment_air_is_sampled, segment_axis, segment_body, segment_load,
};
use windfall_core::device::tree::sway::row::{Rows, row_inward};
use windfall_core::device::tree::sway::twig::twig_response;
use windfall_core::device::tree::sway::{ArticulatedInertia, Body, TwigResponse};
use windfall_core::tree::BranchesMut;

use crate::simd::batch_blocks::{AHEAD, BatchBlocks, BatchStep, ConstantsOf, SegmentBlock};
use crate::simd::branch_block::{
    BlockState, Spare, bodies_of, change_state, ground, lanes_with_rows, state_of, word,
};
use crate::simd::lanes::Lanes;
use crate::simd::sway_scratch::{BlockScratch, InertiaBlock};
use crate::simd::{Simd, in_packs};

/// Steps a batch from the twigs to the trunks.
pub(crate) fn sway_inward(
    cx: &Context<'_>,
    rows: &mut Rows<'_>,
    blocks: &BatchBlocks,
    scratch: &mut BlockScratch,
    simd: Simd,
) {
    match simd {
        Simd::Scalar => (0..rows.segments.len()).rev().for_each(|row| row_inward(cx, rows, row)),
        Simd::Lanes(level) => {
            let step = BatchStep { cx, rows, blocks };
            in_packs!(level, inward_lanes(step, scratch));
        }
    }
}

/// Steps block after block in lanes, with the same bits as row by row.
#[inline(always)]
fn inward_lanes<P: Pack>(simd: P::Simd, mut step: BatchStep<'_, '_>, scratch: &mut BlockScratch) {
    for number in 0..step.blocks.limbs.len() {
        step.prefetch_limbs(number + AHEAD, &ConstantsOf::INWARD);
        step.prefetch_airs(number + AHEAD);
        for part in 0..BLOCK / P::LANES {
            step.inward::<P>(simd, number, part, scratch);
        }
    }
}

impl BatchStep<'_, '_> {
    /// Steps part of a block of limbs and its twigs.
    #[inline(always)]
    fn inward<P: Pack>(&mut self, simd: P::Simd, number: usize, part: usize, scratch: &mut BlockScratch) {
        let block = &self.blocks.limbs[number];
        let BlockScratch { limbs: responses, twigs: twig_responses, inertias, spare, spare_twigs, .. } =
            scratch;
        let constants = block.segments.constants::<P>(simd, part);
        if segment_air_is_sampled(self.cx) {
            sample_air::<P>(self.cx, simd, &mut self.rows.branches, &block.segments, part, spare);
        }
        let state = state_of(&self.rows.branches, &block.segments.rows, spare);
        let body = state.bodies(simd, part);
        let parent = match &block.parents {
            Some(parents) => bodies_of(self.rows, P::load_words(simd, &parents.rows[part * P::LANES..])),
            None => ground(simd),
        };
        let products = velocity_products(&body, &parent);
        let axis = segment_axis(&body);
        let air = state.airs(simd, part);
        let leaf_count = state.leaf_counts(simd, part);
        let snow_kg = self.snow_kg::<P>(simd, &block.segments.rows, part);
        let load = segment_load(self.cx, &constants, &body, axis, air, leaf_count, snow_kg);
        let mut whole = segment_body(&load, axis);
        let twig_responses = &mut twig_responses[block.twigs.clone()];
        for (number, responses) in block.twigs.clone().zip(twig_responses) {
            self.prefetch_twigs(number + AHEAD, &ConstantsOf::INWARD);
            let twigs = &self.blocks.twigs[number];
            let state = state_of(&self.rows.branches, &twigs.rows, spare_twigs);
            let sum = articulated_add(
                &whole,
                &self.inward_twigs(simd, twigs, &state, part, responses, (air, &body)),
            );
            whole = if twigs.rows.len() == BLOCK {
                sum
            } else {
                articulated_select::<P>(lanes_with_rows::<P>(simd, twigs.rows.len(), part), &sum, &whole)
            };
        }
        for children in self.blocks.children(block) {
            let from = P::load_words(simd, &children[part * P::LANES..]);
            whole = articulated_add(&whole, &InertiaBlock::load_at(simd, from, inertias));
        }
        let joint = state.joints(simd, part);
        let spring = joint_spring(self.cx, &constants, &joint, &body, sym3_trace(whole.rotation));
        let (response, apparent) = joint_response(&spring, &whole, axis, &products);
        responses[number].zip_mut(
            &response,
            #[inline(always)]
            |lanes, numbers| lanes.store(part, *numbers),
        );
        inertias[number].store(simd, part, &articulated_shift(&apparent, products.arm));
    }

    /// Mass in kg of the snow on the segments of a block.
    #[inline(always)]
    fn snow_kg<P: Pack>(&self, simd: P::Simd, rows: &Range<usize>, part: usize) -> P {
        if self.cx.scene.snow.branches == 0 {
            return P::fill(simd, 0.0);
        }
        let kg = snow_kg_of(self.cx, self.rows.first + word(rows.start), rows.len());
        P::from_bits(P::load_words(simd, &kg[part * P::LANES..]))
    }

    /// Steps twigs whose parents move like `parent` in air of velocity `air`, and returns what they pass on.
    #[inline(always)]
    fn inward_twigs<P: Pack>(
        &self,
        simd: P::Simd,
        twigs: &SegmentBlock,
        state: &BlockState<'_>,
        part: usize,
        responses: &mut TwigResponse<Lanes>,
        (air, parent): (Vec3<P>, &Body<P>),
    ) -> ArticulatedInertia<P> {
        let constants = twigs.constants(simd, part);
        let body = state.bodies(simd, part);
        let axis = segment_axis(&body);
        let snow_kg = self.snow_kg::<P>(simd, &twigs.rows, part);
        let leaf_count = state.leaf_counts(simd, part);
        let load = segment_load(self.cx, &constants, &body, axis, air, leaf_count, snow_kg);
        let joint = state.joints(simd, part);
        let spring = joint_spring(self.cx, &constants, &joint, &body, load_trace(&load));
        let products = velocity_products(&body, parent);
        let (response, apparent) = twig_response(&spring, &load, axis, &products);
        responses.zip_mut(
            &response,
            #[inline(always)]
            |lanes, numbers| lanes.store(part, *numbers),
        );
        articulated_shift(&apparent, products.arm)
    }
}

/// Bits of the mass in kg of the snow on so many segments from a row of the forest on, in the order of lanes; one copy for all instruction sets.
#[inline(never)]
fn snow_kg_of(cx: &Context<'_>, first: u32, count: usize) -> [u32; BLOCK] {
    std::array::from_fn(|lane| {
        let row = first + word(row_of_lane(lane).min(count - 1));
        branch_snow_kg(cx, row).to_bits()
    })
}

/// Samples the air at the ends of the limbs in part of a block.
#[inline(always)]
fn sample_air<P: Pack>(
    cx: &Context<'_>,
    simd: P::Simd,
    branches: &mut BranchesMut<'_>,
    limbs: &SegmentBlock,
    part: usize,
    spare: &mut Spare,
) {
    let length = limbs.constants::<P>(simd, part).length;
    change_state(
        branches,
        &limbs.rows,
        spare,
        #[inline(always)]
        |mut state| {
            let body = state.bodies(simd, part);
            let air = segment_air(cx, &body, segment_axis(&body), length);
            state.store_airs(simd, part, air);
        },
    );
}

/// `yes` where true, `no` elsewhere.
#[inline(always)]
fn sym3_select<P: Pack>(mask: P::Mask, yes: Sym3<P>, no: Sym3<P>) -> Sym3<P> {
    Sym3 { diagonal: vec3_select(mask, yes.diagonal, no.diagonal), off: vec3_select(mask, yes.off, no.off) }
}

/// `yes` where true, `no` elsewhere.
#[inline(always)]
fn articulated_select<P: Pack>(
    mask: P::Mask,
    yes: &ArticulatedInertia<P>,
    no: &ArticulatedInertia<P>,
) -> ArticulatedInertia<P> {
    ArticulatedInertia {
        rotation: sym3_select::<P>(mask, yes.rotation, no.rotation),
        coupling: Mat3 {
            x: vec3_select(mask, yes.coupling.x, no.coupling.x),
            y: vec3_select(mask, yes.coupling.y, no.coupling.y),
            z: vec3_select(mask, yes.coupling.z, no.coupling.z),
        },
        mass: sym3_select::<P>(mask, yes.mass, no.mass),
        moment: vec3_select(mask, yes.moment, no.moment),
        force: vec3_select(mask, yes.force, no.force),
    }
}
