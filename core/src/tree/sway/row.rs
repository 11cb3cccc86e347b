// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! twin: backend-wgpu/src/shaders/tree/sway/row.wgsl
//!
//! A row of the forest in each of the two passes of a step.

use super::composite::{Composite, composite_add, composite_shift, segment_composite};
use super::inward::{articulated_add, articulated_shift, joint_response, joint_spring, velocity_products};
use super::load::{load_trace, segment_air, segment_axis, segment_body, segment_load};
use super::oliapuram_kumar::oliapuram_kumar_step;
use super::outward::{Acceleration, joint_acceleration, joint_held, joint_step, segment_place};
use super::quigley::quigley_step;
use super::twig::{twig_acceleration, twig_response};
use super::{
    ArticulatedInertia, Body, Constants, Joint, JointResponse, SCHEME_QUIGLEY, TwigResponse, VelocityProducts,
};
use crate::context::Context;
use crate::kernel::matrix::sym3_trace;
use crate::kernel::{Mat3, Sym3, Vec3};
use crate::tree::forest::first_three;
use crate::tree::record::{NO_SEGMENT, SegmentConstants, WORK_RESPONSE, Work, children_of};
use crate::tree::store::BranchesMut;

/// The rows of a batch.
#[derive(Debug)]
pub struct Rows<'a> {
    /// Number of the first row.
    pub first: u32,
    /// Constants.
    pub segments: &'a [SegmentConstants],
    /// State.
    pub branches: BranchesMut<'a>,
    /// Intermediate results.
    pub work: &'a mut [Work],
}

impl Rows<'_> {
    /// Where a segment is and how it moves.
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

    /// The segment that `row` grows from, or the ground.
    #[inline(always)]
    fn parent_body(&self, row: usize) -> Body {
        match self.segments[row].parent {
            NO_SEGMENT => Body::GROUND,
            parent => self.body((parent - self.first) as usize),
        }
    }
}

impl Rows<'_> {
    /// The children of a row: twigs, then limbs.
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

/// A vector and a fourth number.
#[inline(always)]
fn four(v: Vec3, w: f32) -> [f32; 4] {
    [v.x, v.y, v.z, w]
}

/// What a segment hands to its parent, into its work.
#[inline(always)]
pub fn store_articulated(work: &mut Work, body: &ArticulatedInertia) {
    work[0] = four(body.rotation.diagonal, body.moment.x);
    work[1] = four(body.rotation.off, body.moment.y);
    work[2] = four(body.coupling.x, body.moment.z);
    work[3] = four(body.coupling.y, body.force.x);
    work[4] = four(body.coupling.z, body.force.y);
    work[5] = four(body.mass.diagonal, body.force.z);
    work[6] = four(body.mass.off, 0.0);
}

/// The same, out of it.
#[inline(always)]
pub fn load_articulated(work: &Work) -> ArticulatedInertia {
    ArticulatedInertia {
        rotation: Sym3 { diagonal: first_three(work[0]), off: first_three(work[1]) },
        coupling: Mat3 { x: first_three(work[2]), y: first_three(work[3]), z: first_three(work[4]) },
        mass: Sym3 { diagonal: first_three(work[5]), off: first_three(work[6]) },
        moment: Vec3::new(work[0][3], work[1][3], work[2][3]),
        force: Vec3::new(work[3][3], work[4][3], work[5][3]),
    }
}

/// How a joint answers, into the work of its segment.
#[inline(always)]
pub fn store_response(work: &mut Work, response: &JointResponse) {
    let rows = &mut work[WORK_RESPONSE as usize..];
    let VelocityProducts { arm, angular, centripetal } = response.products;
    rows[0] = four(response.free, angular.x);
    rows[1] = four(response.spring.x, angular.y);
    rows[2] = four(response.spring.y, angular.z);
    rows[3] = four(response.spring.z, centripetal.x);
    rows[4] = four(response.lever.x, centripetal.y);
    rows[5] = four(response.lever.y, centripetal.z);
    rows[6] = four(response.lever.z, 0.0);
    rows[7] = four(arm, 0.0);
}

/// The same, out of it.
#[inline(always)]
pub fn load_response(work: &Work) -> JointResponse {
    let rows = &work[WORK_RESPONSE as usize..];
    JointResponse {
        free: first_three(rows[0]),
        spring: Mat3 { x: first_three(rows[1]), y: first_three(rows[2]), z: first_three(rows[3]) },
        lever: Mat3 { x: first_three(rows[4]), y: first_three(rows[5]), z: first_three(rows[6]) },
        products: VelocityProducts {
            arm: first_three(rows[7]),
            angular: Vec3::new(rows[0][3], rows[1][3], rows[2][3]),
            centripetal: Vec3::new(rows[3][3], rows[4][3], rows[5][3]),
        },
    }
}

/// How the joint of a twig answers, into the work of its segment.
#[inline(always)]
pub fn store_twig_response(work: &mut Work, response: &TwigResponse) {
    let rows = &mut work[WORK_RESPONSE as usize..];
    rows[0] = four(response.free, response.spring_along);
    rows[1] = four(response.products.arm, response.spring_across);
    rows[2] = four(response.products.angular, response.lever);
    rows[3] = four(response.products.centripetal, 0.0);
}

/// The same, out of it.
#[inline(always)]
pub fn load_twig_response(work: &Work) -> TwigResponse {
    let rows = &work[WORK_RESPONSE as usize..];
    TwigResponse {
        free: first_three(rows[0]),
        spring_along: rows[0][3],
        spring_across: rows[1][3],
        lever: rows[2][3],
        products: VelocityProducts {
            arm: first_three(rows[1]),
            angular: first_three(rows[2]),
            centripetal: first_three(rows[3]),
        },
    }
}

/// Velocity of the air that a row feels: a twig that of its parent.
#[inline(always)]
fn row_air(cx: &Context<'_>, rows: &Rows<'_>, row: usize) -> Vec3 {
    let segment = &rows.segments[row];
    let feels = if segment.is_twig() { (segment.parent - rows.first) as usize } else { row };
    let body = rows.body(feels);
    segment_air(cx, &body, segment_axis(&body), rows.segments[feels].length)
}

/// The pass towards the foot, at one row whose children are done.
#[inline(always)]
pub fn row_inward(cx: &Context<'_>, rows: &mut Rows<'_>, row: usize) {
    let constants = Constants::from(&rows.segments[row]);
    let body = rows.body(row);
    let joint = rows.joint(row);
    let axis = segment_axis(&body);
    let products = velocity_products(&body, &rows.parent_body(row));
    let bearing = rows.branches.bearing[row] as f32;
    let load = segment_load(cx, &constants, &body, axis, row_air(cx, rows, row), bearing);
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

/// The pass towards the tips, at one row whose parent is done.
#[inline(always)]
pub fn row_outward(cx: &Context<'_>, rows: &mut Rows<'_>, row: usize) {
    let constants = Constants::from(&rows.segments[row]);
    let body = rows.body(row);
    let mut above = Acceleration { angular: Vec3::ZERO, linear: Vec3::ZERO };
    if rows.segments[row].parent != NO_SEGMENT {
        let parent = &rows.work[(rows.segments[row].parent - rows.first) as usize];
        above = Acceleration { angular: first_three(parent[0]), linear: first_three(parent[1]) };
    }
    let own = if rows.segments[row].is_twig() {
        twig_acceleration(&load_twig_response(&rows.work[row]), segment_axis(&body), &above)
    } else {
        let (acceleration, own) = joint_acceleration(&load_response(&rows.work[row]), &above);
        rows.work[row][0] = four(acceleration.angular, 0.0);
        rows.work[row][1] = four(acceleration.linear, 0.0);
        own
    };
    let joint = joint_step(cx, &rows.joint(row), &body, own);
    let body = segment_place(&constants, &joint, &rows.parent_body(row));
    rows.move_to(row, &joint, &body);
}

/// What a segment carries, into its work.
#[inline(always)]
pub fn store_composite(work: &mut Work, whole: &Composite) {
    work[0] = four(whole.inertia.diagonal, whole.mass);
    work[1] = four(whole.inertia.off, whole.drag);
    work[2] = four(whole.moment, whole.drag_inertia);
    work[3] = four(whole.torque, 0.0);
    work[4] = four(whole.force, 0.0);
    work[5] = four(whole.drag_moment, 0.0);
}

/// The same, out of it.
#[inline(always)]
pub fn load_composite(work: &Work) -> Composite {
    Composite {
        inertia: Sym3 { diagonal: first_three(work[0]), off: first_three(work[1]) },
        moment: first_three(work[2]),
        mass: work[0][3],
        torque: first_three(work[3]),
        force: first_three(work[4]),
        drag: work[1][3],
        drag_moment: first_three(work[5]),
        drag_inertia: work[2][3],
    }
}

/// The pass towards the foot of the schemes that move joints one by one, at one row whose children are done.
#[inline(always)]
pub fn row_gather(cx: &Context<'_>, rows: &mut Rows<'_>, row: usize) {
    let constants = Constants::from(&rows.segments[row]);
    let body = rows.body(row);
    let bearing = rows.branches.bearing[row] as f32;
    let air = row_air(cx, rows, row);
    let mut whole = segment_composite(&constants, &body, segment_axis(&body), air, bearing);
    for child in rows.children(row) {
        let arm = rows.body(child).base - body.base;
        whole = composite_add(&whole, &composite_shift(&load_composite(&rows.work[child]), arm));
    }
    store_composite(&mut rows.work[row], &whole);
}

/// The pass towards the tips of the schemes that move joints one by one, at one row whose parent is done.
#[inline(always)]
pub fn row_follow(cx: &Context<'_>, rows: &mut Rows<'_>, row: usize) {
    let constants = Constants::from(&rows.segments[row]);
    let body = rows.body(row);
    let joint = rows.joint(row);
    let whole = load_composite(&rows.work[row]);
    let moved = if cx.environment.sway_scheme == SCHEME_QUIGLEY {
        quigley_step(cx, &constants, &joint, &body, segment_axis(&body), &whole)
    } else {
        oliapuram_kumar_step(cx, &constants, &joint, &body, &whole)
    };
    let joint = joint_held(cx, moved.0, moved.1);
    let body = segment_place(&constants, &joint, &rows.parent_body(row));
    rows.move_to(row, &joint, &body);
}
