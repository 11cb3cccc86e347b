// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! twin: backend-wgpu/src/shaders/tree/sway/row.wgsl
//!
//! One segment in each pass of a step.

use super::coast::segment_coast;
use super::composite::{composite_add, composite_shift, segment_composite};
use super::inward::{articulated_add, articulated_shift, joint_response, joint_spring, velocity_products};
use super::load::{
    load_trace, segment_air, segment_air_is_sampled, segment_axis, segment_body, segment_load,
};
use super::oliapuram_kumar::oliapuram_kumar_step;
use super::outward::{Acceleration, joint_acceleration, joint_held, joint_step, segment_place};
use super::quigley::quigley_step;
use super::twig::{twig_acceleration, twig_response};
use super::work::{
    four, load_acceleration, load_articulated, load_composite, load_response, load_twig_response,
    store_acceleration, store_articulated, store_composite, store_response, store_twig_response,
};
use super::{Body, Constants, Joint, SCHEME_QUIGLEY};
use crate::arith::Vec3;
use crate::arith::matrix::sym3_trace;
use crate::context::Context;
use crate::device::tree::branch_snow::branch_snow_kg;
use crate::tree::BranchesMut;
use crate::tree::forest::first_three;
use crate::tree::record::{NO_SEGMENT, SegmentConstants, Work, children_of};

/// Rows of a batch.
#[derive(Debug)]
pub struct Rows<'a> {
    /// Number of the first row in the forest.
    pub first: u32,
    /// Constants.
    pub segments: &'a [SegmentConstants],
    /// State.
    pub branches: BranchesMut<'a>,
    /// Results of the inward pass.
    pub work: &'a mut [Work],
}

impl Rows<'_> {
    /// Pose and velocity of a segment.
    #[inline(always)]
    pub fn body(&self, row: usize) -> Body {
        Body {
            base: first_three(self.branches.base[row]),
            pose: self.branches.pose[row].into(),
            velocity: first_three(self.branches.velocity[row]),
            spin: first_three(self.branches.spin[row]),
        }
    }

    #[inline(always)]
    fn joint(&self, row: usize) -> Joint {
        Joint { turn: self.branches.turn[row].into(), rate: first_three(self.branches.rate[row]) }
    }

    /// Number of a row in the forest.
    #[expect(clippy::cast_possible_truncation, reason = "segments are counted in words")]
    #[inline(always)]
    fn number(&self, row: usize) -> u32 {
        self.first + row as u32
    }

    /// Pose and velocity of the segment that `row` grows from, or of the ground.
    #[inline(always)]
    fn parent_body(&self, row: usize) -> Body {
        match self.segments[row].parent {
            NO_SEGMENT => Body::GROUND,
            parent => self.body((parent - self.first) as usize),
        }
    }

    /// Children of a row: twigs, then limbs.
    #[inline(always)]
    fn children(&self, row: usize) -> impl Iterator<Item = usize> + use<'_> {
        children_of(self.segments, self.first, row)
    }

    #[inline(always)]
    fn move_to(&mut self, row: usize, joint: &Joint, body: &Body) {
        self.branches.turn[row] = joint.turn.to_array();
        self.branches.rate[row] = four(joint.rate, 0.0);
        self.branches.base[row] = four(body.base, 0.0);
        self.branches.pose[row] = body.pose.to_array();
        self.branches.velocity[row] = four(body.velocity, 0.0);
        self.branches.spin[row] = four(body.spin, 0.0);
    }
}

/// Velocity of the air at a row: at the end of a twig's parent, or of any other segment itself, which keeps it.
#[inline(always)]
fn row_air(cx: &Context<'_>, rows: &mut Rows<'_>, row: usize) -> Vec3 {
    let segment = &rows.segments[row];
    let is_twig = segment.is_twig();
    let felt = if is_twig { (segment.parent - rows.first) as usize } else { row };
    if !segment_air_is_sampled(cx) {
        return first_three(rows.branches.air[felt]);
    }
    let body = rows.body(felt);
    let air = segment_air(cx, &body, segment_axis(&body), rows.segments[felt].length);
    if !is_twig {
        rows.branches.air[row] = four(air, 0.0);
    }
    air
}

/// Inward pass at one row, after its children.
#[inline(always)]
pub fn row_inward(cx: &Context<'_>, rows: &mut Rows<'_>, row: usize) {
    let constants = Constants::from(&rows.segments[row]);
    let body = rows.body(row);
    let joint = rows.joint(row);
    let axis = segment_axis(&body);
    let products = velocity_products(&body, &rows.parent_body(row));
    let leaf_count = rows.branches.leaf_count[row] as f32;
    let air = row_air(cx, rows, row);
    let snow_kg = branch_snow_kg(cx, rows.number(row));
    let load = segment_load(cx, &constants, &body, axis, air, leaf_count, snow_kg);
    let apparent = if rows.segments[row].is_twig() {
        let spring = joint_spring(cx, &constants, &joint, &body, load_trace(&load));
        let (response, apparent) = twig_response(&spring, &load, axis, &products);
        store_twig_response(&mut rows.work[row], &response);
        apparent
    } else {
        let mut whole = segment_body(&load, axis);
        for child in rows.children(row) {
            whole = articulated_add(&whole, &load_articulated(&rows.work[child]));
        }
        let spring = joint_spring(cx, &constants, &joint, &body, sym3_trace(whole.rotation));
        let (response, apparent) = joint_response(&spring, &whole, axis, &products);
        store_response(&mut rows.work[row], &response);
        apparent
    };
    store_articulated(&mut rows.work[row], &articulated_shift(&apparent, products.arm));
}

/// Outward pass at one row, after its parent.
#[inline(always)]
pub fn row_outward(cx: &Context<'_>, rows: &mut Rows<'_>, row: usize) {
    let constants = Constants::from(&rows.segments[row]);
    let body = rows.body(row);
    let mut above = Acceleration { angular: Vec3::ZERO, linear: Vec3::ZERO };
    if rows.segments[row].parent != NO_SEGMENT {
        above = load_acceleration(&rows.work[(rows.segments[row].parent - rows.first) as usize]);
    }
    let own = if rows.segments[row].is_twig() {
        twig_acceleration(&load_twig_response(&rows.work[row]), segment_axis(&body), &above)
    } else {
        let (acceleration, own) = joint_acceleration(&load_response(&rows.work[row]), &above);
        store_acceleration(&mut rows.work[row], &acceleration);
        own
    };
    let joint = joint_step(cx, &rows.joint(row), &body, own);
    let body = segment_place(&constants, &joint, &rows.parent_body(row));
    rows.move_to(row, &joint, &body);
}

/// Inward pass of the schemes that step joints one by one, at one row, after its children.
#[inline(always)]
pub fn row_gather(cx: &Context<'_>, rows: &mut Rows<'_>, row: usize) {
    let constants = Constants::from(&rows.segments[row]);
    let body = rows.body(row);
    let leaf_count = rows.branches.leaf_count[row] as f32;
    let air = row_air(cx, rows, row);
    let snow_kg = branch_snow_kg(cx, rows.number(row));
    let mut whole = segment_composite(cx, &constants, &body, segment_axis(&body), air, leaf_count, snow_kg);
    for child in rows.children(row) {
        let arm = rows.body(child).base - body.base;
        whole = composite_add(&whole, &composite_shift(&load_composite(&rows.work[child]), arm));
    }
    store_composite(&mut rows.work[row], &whole);
}

/// Outward pass of the schemes that step joints one by one, at one row, after its parent.
#[inline(always)]
pub fn row_follow(cx: &Context<'_>, rows: &mut Rows<'_>, row: usize) {
    let constants = Constants::from(&rows.segments[row]);
    let body = rows.body(row);
    let joint = rows.joint(row);
    let whole = load_composite(&rows.work[row]);
    let moved = if cx.scene.sway_scheme == SCHEME_QUIGLEY {
        quigley_step(cx, &constants, &joint, &body, segment_axis(&body), &whole)
    } else {
        oliapuram_kumar_step(cx, &constants, &joint, &body, &whole)
    };
    let joint = joint_held(cx, moved.turn, moved.rate);
    let body = segment_place(&constants, &joint, &rows.parent_body(row));
    rows.move_to(row, &joint, &body);
}

/// Step of one row between two solutions of its joint.
#[inline(always)]
pub fn row_coast(cx: &Context<'_>, rows: &mut Rows<'_>, row: usize) {
    let body = segment_coast(cx, &rows.body(row));
    rows.branches.base[row] = four(body.base, 0.0);
    rows.branches.pose[row] = body.pose.to_array();
}
