// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! twin: backend-wgpu/src/shaders/tree/sway/row.wgsl
//!
//! A row of the forest in each of the two passes of a step.

use super::fold::{articulated_add, articulated_shift, joint_answer, joint_spring};
use super::load::{segment_axis, segment_body};
use super::unfold::{Motion, joint_motion, joint_step, segment_place};
use super::{Answer, Articulated, Body, Constants, Joint};
use crate::context::Context;
use crate::kernel::{Mat3, Sym3, Vec3};
use crate::tree::forest::first_three;
use crate::tree::record::{NO_SEGMENT, Timber, WORK_ANSWER, Work};
use crate::tree::store::BranchesMut;

/// The rows of a stand.
#[derive(Debug)]
pub struct Rows<'a> {
    /// Number of the first row.
    pub first: u32,
    /// Constants.
    pub timber: &'a [Timber],
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
        match self.timber[row].parent {
            NO_SEGMENT => Body::GROUND,
            parent => self.body((parent - self.first) as usize),
        }
    }
}

/// A vector and a fourth number.
#[inline(always)]
fn four(v: Vec3, w: f32) -> [f32; 4] {
    [v.x, v.y, v.z, w]
}

/// What a segment hands to its parent, into its work.
#[inline(always)]
pub fn store_articulated(work: &mut Work, body: &Articulated) {
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
pub fn load_articulated(work: &Work) -> Articulated {
    Articulated {
        rotation: Sym3 { diagonal: first_three(work[0]), off: first_three(work[1]) },
        coupling: Mat3 { x: first_three(work[2]), y: first_three(work[3]), z: first_three(work[4]) },
        mass: Sym3 { diagonal: first_three(work[5]), off: first_three(work[6]) },
        moment: Vec3::new(work[0][3], work[1][3], work[2][3]),
        force: Vec3::new(work[3][3], work[4][3], work[5][3]),
    }
}

/// How a joint answers, into the work of its segment.
#[inline(always)]
pub fn store_answer(work: &mut Work, answer: &Answer) {
    let rows = &mut work[WORK_ANSWER as usize..];
    rows[0] = four(answer.free, answer.turning.x);
    rows[1] = four(answer.spring.x, answer.turning.y);
    rows[2] = four(answer.spring.y, answer.turning.z);
    rows[3] = four(answer.spring.z, answer.centripetal.x);
    rows[4] = four(answer.lever.x, answer.centripetal.y);
    rows[5] = four(answer.lever.y, answer.centripetal.z);
    rows[6] = four(answer.lever.z, 0.0);
    rows[7] = four(answer.arm, 0.0);
}

/// The same, out of it.
#[inline(always)]
pub fn load_answer(work: &Work) -> Answer {
    let rows = &work[WORK_ANSWER as usize..];
    Answer {
        free: first_three(rows[0]),
        spring: Mat3 { x: first_three(rows[1]), y: first_three(rows[2]), z: first_three(rows[3]) },
        lever: Mat3 { x: first_three(rows[4]), y: first_three(rows[5]), z: first_three(rows[6]) },
        arm: first_three(rows[7]),
        turning: Vec3::new(rows[0][3], rows[1][3], rows[2][3]),
        centripetal: Vec3::new(rows[3][3], rows[4][3], rows[5][3]),
    }
}

/// The pass towards the foot, at one row whose children are done.
#[inline(always)]
pub fn row_fold(cx: &Context<'_>, rows: &mut Rows<'_>, row: usize) {
    let constants = Constants::from(&rows.timber[row]);
    let body = rows.body(row);
    let joint = rows.joint(row);
    let parent = rows.parent_body(row);
    let axis = segment_axis(&body);
    let bearing = rows.branches.bearing[row] as f32;
    let mut whole = segment_body(cx, &constants, &body, axis, bearing);
    let first = rows.timber[row].first_child.wrapping_sub(rows.first) as usize;
    for child in first..first + rows.timber[row].child_count as usize {
        whole = articulated_add(&whole, &load_articulated(&rows.work[child]));
    }
    let (torque, spring) = joint_spring(cx, &constants, &joint, &body, axis, whole.rotation);
    let (answer, left) = joint_answer(torque, spring, &whole, &body, &parent);
    store_articulated(&mut rows.work[row], &articulated_shift(&left, answer.arm));
    store_answer(&mut rows.work[row], &answer);
}

/// The pass towards the tips, at one row whose parent is done.
#[inline(always)]
pub fn row_unfold(cx: &Context<'_>, rows: &mut Rows<'_>, row: usize) {
    let constants = Constants::from(&rows.timber[row]);
    let answer = load_answer(&rows.work[row]);
    let mut above = Motion { angular: Vec3::ZERO, linear: Vec3::ZERO };
    if rows.timber[row].parent != NO_SEGMENT {
        let parent = &rows.work[(rows.timber[row].parent - rows.first) as usize];
        above = Motion { angular: first_three(parent[0]), linear: first_three(parent[1]) };
    }
    let (motion, own) = joint_motion(&answer, &above);
    rows.work[row][0] = four(motion.angular, 0.0);
    rows.work[row][1] = four(motion.linear, 0.0);
    let joint = joint_step(cx, &rows.joint(row), &rows.body(row), own);
    let body = segment_place(&constants, &joint, &rows.parent_body(row));
    rows.branches.turn[row] = joint.turn.to_array();
    rows.branches.rate[row] = four(joint.rate, 0.0);
    rows.branches.base[row] = four(body.base, 0.0);
    rows.branches.pose[row] = body.pose.to_array();
    rows.branches.velocity[row] = four(body.velocity, 0.0);
    rows.branches.spin[row] = four(body.spin, 0.0);
}
