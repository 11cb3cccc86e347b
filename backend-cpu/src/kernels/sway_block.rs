// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Both passes over a block of limbs and their twigs, side by side in SIMD registers, with the same bits as one by one.
//!
//! A block has sixteen lanes: one pack of sixteen, or two of eight, parts 0 and 1. What a lane without a row computes
//! nobody reads.

use bytemuck::must_cast_slice;
use windfall_core::Context;
use windfall_core::arith::lane::Word;
use windfall_core::arith::matrix::sym3_trace;
use windfall_core::arith::pack::{BLOCK, Pack, ROWS_OF_LANES, load_block, row_of_lane, store_block};
use windfall_core::arith::vector::vec3_select;
use windfall_core::arith::{Mat3, Quat, Sym3, Vec3};
use windfall_core::device::tree::sway::inward::{
    articulated_add, articulated_shift, joint_response, joint_spring, velocity_products,
};
use windfall_core::device::tree::sway::load::{
    load_trace, segment_air, segment_axis, segment_body, segment_load,
};
use windfall_core::device::tree::sway::outward::{
    Acceleration, joint_acceleration, joint_step, segment_place,
};
use windfall_core::device::tree::sway::row::Rows;
use windfall_core::device::tree::sway::twig::{twig_acceleration, twig_response};
use windfall_core::device::tree::sway::{ArticulatedInertia, Body, Joint};

use super::branch_block::{Column, Spare, State, change_state, state_of};
use super::scratch::{BlockScratch, Handed, TwigResponses};
use super::segment_block::{BatchBlocks, HANDED, SegmentBlock, word};

type Record = [f32; 4];

/// A batch that is being stepped.
pub(super) struct Step<'a, 'b> {
    pub(super) cx: &'a Context<'a>,
    pub(super) rows: &'a mut Rows<'b>,
    pub(super) blocks: &'a BatchBlocks,
}

/// Writes vectors and what stands behind them.
#[inline(always)]
pub(super) fn store_vector<P: Pack>(column: &mut Column, part: usize, v: Vec3<P>, w: P) {
    store_block(column, part, [v.x, v.y, v.z, w]);
}

/// Four columns as a vector and what stands behind it.
#[inline(always)]
pub(super) fn four<P: Pack>([x, y, z, w]: [P; 4]) -> (Vec3<P>, P) {
    (Vec3::new(x, y, z), w)
}

/// Leaves on segments that follow one another.
#[inline(always)]
fn bearing_at<P: Pack>(simd: P::Simd, counts: &[u32; BLOCK], part: usize) -> P {
    let counts: [u32; BLOCK] = core::array::from_fn(|lane| counts[row_of_lane(lane)]);
    P::load_words(simd, &counts[part * P::LANES..]).to_real()
}

/// In which lanes a block has rows.
#[inline(always)]
fn lanes_with_rows<P: Pack>(simd: P::Simd, count: usize, part: usize) -> P::Mask {
    let rows = P::load_words(simd, &ROWS_OF_LANES[part * P::LANES..]);
    rows.less_than(rows.all(word(count)))
}

/// Segments that follow one another.
#[inline(always)]
fn bodies_at<P: Pack>(simd: P::Simd, state: State<'_>, part: usize) -> Body<P> {
    let [_, _, base, pose, velocity, spin] = state;
    Body {
        base: four(load_block(simd, base, part)).0,
        pose: load_block(simd, pose, part).into(),
        velocity: four(load_block(simd, velocity, part)).0,
        spin: four(load_block(simd, spin, part)).0,
    }
}

/// Joints of segments that follow one another.
#[inline(always)]
fn joints_at<P: Pack>(simd: P::Simd, turn: &Column, rate: &Column, part: usize) -> Joint<P> {
    Joint { turn: load_block(simd, turn, part).into(), rate: four(load_block(simd, rate, part)).0 }
}

/// Segments wherever they are.
#[inline(always)]
pub(super) fn bodies_of<P: Pack>(rows: &Rows<'_>, of: P::Word) -> Body<P> {
    let branches = &rows.branches;
    Body {
        base: four(of.look_up(branches.base)).0,
        pose: of.look_up(branches.pose).into(),
        velocity: four(of.look_up(branches.velocity)).0,
        spin: four(of.look_up(branches.spin)).0,
    }
}

/// The ground that trunks grow from.
#[inline(always)]
fn ground<P: Pack>(simd: P::Simd) -> Body<P> {
    let zero = P::fill(simd, 0.0);
    let still = Vec3::new(zero, zero, zero);
    Body { base: still, pose: Quat::new(zero, zero, zero, P::fill(simd, 1.0)), velocity: still, spin: still }
}

/// What limbs hand down, wherever they are.
#[inline(always)]
fn handed_by<P: Pack>(simd: P::Simd, from: P::Word, handed: &[Handed]) -> ArticulatedInertia<P> {
    let spans = P::spans::<{ BLOCK * (HANDED - 1) + 1 }>(from, must_cast_slice(handed));
    let a = four(P::column(simd, &spans, 0));
    let b = four(P::column(simd, &spans, BLOCK));
    let c = four(P::column(simd, &spans, 2 * BLOCK));
    let d = four(P::column(simd, &spans, 3 * BLOCK));
    let e = four(P::column(simd, &spans, 4 * BLOCK));
    let f = four(P::column(simd, &spans, 5 * BLOCK));
    let g = four(P::column(simd, &spans, 6 * BLOCK));
    ArticulatedInertia {
        rotation: Sym3 { diagonal: a.0, off: b.0 },
        coupling: Mat3 { x: c.0, y: d.0, z: e.0 },
        mass: Sym3 { diagonal: f.0, off: g.0 },
        moment: Vec3::new(a.1, b.1, c.1),
        force: Vec3::new(d.1, e.1, f.1),
    }
}

/// Hands a block's bodies down.
#[inline(always)]
fn hand_down<P: Pack>(
    handed: &mut [[Record; BLOCK]; HANDED],
    part: usize,
    body: &ArticulatedInertia<P>,
    zero: P,
) {
    let [a, b, c, d, e, f, g] = handed;
    store_vector(a, part, body.rotation.diagonal, body.moment.x);
    store_vector(b, part, body.rotation.off, body.moment.y);
    store_vector(c, part, body.coupling.x, body.moment.z);
    store_vector(d, part, body.coupling.y, body.force.x);
    store_vector(e, part, body.coupling.z, body.force.y);
    store_vector(f, part, body.mass.diagonal, body.force.z);
    store_vector(g, part, body.mass.off, zero);
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

impl Step<'_, '_> {
    /// The pass towards the foot at part of a block.
    #[inline(always)]
    pub(super) fn inward<P: Pack>(
        &self,
        simd: P::Simd,
        number: usize,
        part: usize,
        scratch: &mut BlockScratch,
    ) {
        let block = &self.blocks.limbs[number];
        let BlockScratch { limbs: responses, twigs: kept, handed, spare, spare_twigs, .. } = scratch;
        let constants = block.segments.constants::<P>(simd, part);
        let (state, bearing) = state_of(&self.rows.branches, &block.segments.rows, spare);
        let body = bodies_at(simd, state, part);
        let parent = match &block.parents {
            Some(parents) => bodies_of(self.rows, P::load_words(simd, &parents.rows[part * P::LANES..])),
            None => ground(simd),
        };
        let products = velocity_products(&body, &parent);
        let axis = segment_axis(&body);
        let air = segment_air(self.cx, &body, axis, constants.length);
        let bearing = bearing_at(simd, bearing, part);
        let mut whole = segment_body(&segment_load(self.cx, &constants, &body, axis, air, bearing), axis);
        let kept = &mut kept[block.twigs.clone()];
        for (twigs, kept) in self.blocks.twigs[block.twigs.clone()].iter().zip(kept) {
            let state = state_of(&self.rows.branches, &twigs.rows, spare_twigs);
            let sum =
                articulated_add(&whole, &self.inward_twigs(simd, twigs, state, part, kept, (air, &body)));
            whole = if twigs.rows.len() == BLOCK {
                sum
            } else {
                articulated_select::<P>(lanes_with_rows::<P>(simd, twigs.rows.len(), part), &sum, &whole)
            };
        }
        for children in self.blocks.children(block) {
            let from = P::load_words(simd, &children[part * P::LANES..]);
            whole = articulated_add(&whole, &handed_by(simd, from, handed));
        }
        let joint = joints_at(simd, state[0], state[1], part);
        let spring = joint_spring(self.cx, &constants, &joint, &body, sym3_trace(whole.rotation));
        let (response, apparent) = joint_response(&spring, &whole, axis, &products);
        responses[number].keep_response(part, &response);
        let shifted = articulated_shift(&apparent, products.arm);
        hand_down(&mut handed[number].0, part, &shifted, P::fill(simd, 0.0));
    }

    /// The pass towards the foot at twigs whose parents feel this air and move like this: what they hand down.
    #[inline(always)]
    fn inward_twigs<P: Pack>(
        &self,
        simd: P::Simd,
        twigs: &SegmentBlock,
        (state, bearing): (State<'_>, &[u32; BLOCK]),
        part: usize,
        kept: &mut TwigResponses,
        (air, parent): (Vec3<P>, &Body<P>),
    ) -> ArticulatedInertia<P> {
        let constants = twigs.constants(simd, part);
        let body = bodies_at(simd, state, part);
        let axis = segment_axis(&body);
        let bearing = bearing_at(simd, bearing, part);
        let load = segment_load(self.cx, &constants, &body, axis, air, bearing);
        let joint = joints_at(simd, state[0], state[1], part);
        let spring = joint_spring(self.cx, &constants, &joint, &body, load_trace(&load));
        let products = velocity_products(&body, parent);
        let (response, apparent) = twig_response(&spring, &load, axis, &products);
        kept.keep_response(part, &response);
        articulated_shift(&apparent, products.arm)
    }

    /// The pass towards the tips at part of a block.
    #[inline(always)]
    pub(super) fn outward<P: Pack>(
        &mut self,
        simd: P::Simd,
        number: usize,
        part: usize,
        scratch: &mut BlockScratch,
    ) {
        let block = &self.blocks.limbs[number];
        let (parent, above) = match &block.parents {
            Some(parents) => {
                let motions: &[Record] = must_cast_slice(&scratch.motions);
                let at = P::load_words(simd, &parents.motions[part * P::LANES..]);
                let spans = P::spans::<{ BLOCK + 1 }>(at, motions);
                let (angular, linear) = (P::column(simd, &spans, 0), P::column(simd, &spans, BLOCK));
                let rows = P::load_words(simd, &parents.rows[part * P::LANES..]);
                (
                    bodies_of(self.rows, rows),
                    Acceleration { angular: four(angular).0, linear: four(linear).0 },
                )
            }
            None => {
                let still = ground(simd);
                (still, Acceleration { angular: still.spin, linear: still.velocity })
            }
        };
        let (acceleration, own) = joint_acceleration(&scratch.limbs[number].response(simd, part), &above);
        let zero = P::fill(simd, 0.0);
        let [angular, linear] = &mut scratch.motions[number].0;
        store_vector(angular, part, acceleration.angular, zero);
        store_vector(linear, part, acceleration.linear, zero);
        let own = |_| own;
        let body = self.move_on(simd, &block.segments, part, own, &parent, &mut scratch.spare);
        for number in block.twigs.clone() {
            let segments = &self.blocks.twigs[number];
            let response = scratch.twigs[number].response(simd, part);
            let own = |axis| twig_acceleration(&response, axis, &acceleration);
            self.move_on(simd, segments, part, own, &body, &mut scratch.spare);
        }
    }

    /// Segments that follow one another move on, accelerated by `own`, of their axes, in world axes.
    #[inline(always)]
    fn move_on<P: Pack>(
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
            |[turn, rate, base, pose, velocity, spin]| {
                let before = Body { pose: load_block(simd, pose, part).into(), ..*parent };
                let own = own(segment_axis(&before));
                let joint = joint_step(cx, &joints_at(simd, turn, rate, part), &before, own);
                let body = segment_place(&segments.constants(simd, part), &joint, parent);
                let zero = P::fill(simd, 0.0);
                store_block(turn, part, joint.turn.to_array());
                store_vector(rate, part, joint.rate, zero);
                store_vector(base, part, body.base, zero);
                store_block(pose, part, body.pose.to_array());
                store_vector(velocity, part, body.velocity, zero);
                store_vector(spin, part, body.spin, zero);
                body
            },
        )
    }
}
