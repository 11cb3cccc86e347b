// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Both passes over eight segments of a level at once, side by side in SIMD registers, with the same bits as one by one.

use bytemuck::{must_cast_mut, must_cast_ref};
use fearless_simd::{Simd, SimdBase, f32x8, u32x8};
use windfall_core::Context;
use windfall_core::kernel::eight::{load_records, store_records};
use windfall_core::kernel::lane::{LANES, Real, Word};
use windfall_core::kernel::{Mat3, Quat, Sym3, Vec3};
use windfall_core::tree::Timber;
use windfall_core::tree::record::{TIMBER_ROWS, WORK_ANSWER, Work};
use windfall_core::tree::sway::fold::{articulated_add, articulated_shift, joint_answer, joint_spring};
use windfall_core::tree::sway::load::{segment_axis, segment_body};
use windfall_core::tree::sway::row::Rows;
use windfall_core::tree::sway::unfold::{Motion, joint_motion, joint_step, segment_place};
use windfall_core::tree::sway::{Answer, Articulated, Body, Constants, Joint};

type Record = [f32; 4];

/// A vector, and what stands behind it.
type Four<R> = (Vec3<R>, R);

/// Eight records as columns.
#[inline(always)]
fn columns<S: Simd>(simd: S, records: &[Record; LANES]) -> Four<f32x8<S>> {
    let [x, y, z, w] = load_records(simd, must_cast_ref(records));
    (Vec3::new(Real::from_bits(x), Real::from_bits(y), Real::from_bits(z)), Real::from_bits(w))
}

/// The same as a quaternion.
#[inline(always)]
fn quaternions<S: Simd>(simd: S, records: &[Record; LANES]) -> Quat<f32x8<S>> {
    let (v, w) = columns(simd, records);
    Quat::new(v.x, v.y, v.z, w)
}

/// Columns as eight records.
#[inline(always)]
fn records<S: Simd>(v: Vec3<f32x8<S>>, w: f32x8<S>) -> [Record; LANES] {
    let mut out = [[0.0; 4]; LANES];
    let columns = [Real::to_bits(v.x), Real::to_bits(v.y), Real::to_bits(v.z), Real::to_bits(w)];
    store_records(must_cast_mut(&mut out), columns);
    out
}

/// Eight records of a column, one after another.
#[inline(always)]
fn eight_of<T>(column: &[T], row: usize) -> &[T; LANES] {
    column[row..].first_chunk().expect("eight rows of a level")
}

/// The records of a column that the rows name.
#[inline(always)]
fn gather(column: &[Record], rows: &[usize; LANES]) -> [Record; LANES] {
    let mut out = [[0.0; 4]; LANES];
    for (record, &row) in out.iter_mut().zip(rows) {
        *record = column[row];
    }
    out
}

/// One of the records of each of eight segments' work.
#[inline(always)]
fn work_part<S: Simd>(simd: S, work: &[Work], rows: &[usize; LANES], part: usize) -> Four<f32x8<S>> {
    let mut out = [[0.0; 4]; LANES];
    for (record, &row) in out.iter_mut().zip(rows) {
        *record = work[row][part];
    }
    columns(simd, &out)
}

/// Writes one of the records of each of eight segments' work.
#[inline(always)]
fn store_part<S: Simd>(work: &mut [Work; LANES], part: usize, v: Vec3<f32x8<S>>, w: f32x8<S>) {
    let parts = records(v, w);
    for (work, record) in work.iter_mut().zip(parts) {
        work[part] = record;
    }
}

/// Constants of eight segments.
#[inline(always)]
fn constants_of<S: Simd>(simd: S, timber: &[Timber; LANES]) -> Constants<f32x8<S>> {
    let rows: &[[Record; TIMBER_ROWS as usize]; LANES] = must_cast_ref(timber);
    let part = |number: usize| {
        let mut out = [[0.0; 4]; LANES];
        for (record, row) in out.iter_mut().zip(rows) {
            *record = row[number];
        }
        out
    };
    let rest = quaternions(simd, &part(0));
    let (offset, length) = columns(simd, &part(1));
    let (wood, inertia_along) = columns(simd, &part(2));
    let (air, leaf_yield) = columns(simd, &part(3));
    let (preload, damping) = columns(simd, &part(4));
    let (spring, twisting_inertia) = columns(simd, &part(5));
    Constants {
        rest,
        offset,
        length,
        mass: wood.x,
        first_moment: wood.y,
        inertia_across: wood.z,
        inertia_along,
        leaf_mass: air.x,
        wood_drag: air.y,
        leaf_drag: air.z,
        leaf_yield,
        preload,
        damping,
        bending: spring.x,
        twisting: spring.y,
        bending_inertia: spring.z,
        twisting_inertia,
    }
}

/// Eight segments that follow one another.
#[inline(always)]
fn bodies_at<S: Simd>(simd: S, rows: &Rows<'_>, row: usize) -> Body<f32x8<S>> {
    let branches = &rows.branches;
    Body {
        base: columns(simd, eight_of(branches.base, row)).0,
        pose: quaternions(simd, eight_of(branches.pose, row)),
        velocity: columns(simd, eight_of(branches.velocity, row)).0,
        spin: columns(simd, eight_of(branches.spin, row)).0,
    }
}

/// Eight segments wherever they are.
#[inline(always)]
fn bodies_of<S: Simd>(simd: S, rows: &Rows<'_>, of: &[usize; LANES]) -> Body<f32x8<S>> {
    let branches = &rows.branches;
    Body {
        base: columns(simd, &gather(branches.base, of)).0,
        pose: quaternions(simd, &gather(branches.pose, of)),
        velocity: columns(simd, &gather(branches.velocity, of)).0,
        spin: columns(simd, &gather(branches.spin, of)).0,
    }
}

/// Joints of eight segments that follow one another.
#[inline(always)]
fn joints_at<S: Simd>(simd: S, rows: &Rows<'_>, row: usize) -> Joint<f32x8<S>> {
    Joint {
        turn: quaternions(simd, eight_of(rows.branches.turn, row)),
        rate: columns(simd, eight_of(rows.branches.rate, row)).0,
    }
}

/// Rows of the parents of eight segments, none of them a trunk.
#[inline(always)]
fn parents_of(rows: &Rows<'_>, row: usize) -> [usize; LANES] {
    let mut parents = [0; LANES];
    for (parent, timber) in parents.iter_mut().zip(eight_of(rows.timber, row)) {
        *parent = (timber.parent - rows.first) as usize;
    }
    parents
}

/// What the children of that number hand to eight segments; nothing, that is minus zero, which leaves every sum as it
/// is, to segments that have fewer.
#[inline(always)]
fn handed_by<S: Simd>(simd: S, rows: &Rows<'_>, row: usize, number: u32) -> Articulated<f32x8<S>> {
    let mut parts = [[[-0.0; 4]; LANES]; WORK_ANSWER as usize];
    for lane in 0..LANES {
        let timber = &rows.timber[row + lane];
        if number < timber.child_count {
            let work = &rows.work[(timber.first_child - rows.first + number) as usize];
            for (part, record) in parts.iter_mut().zip(work) {
                part[lane] = *record;
            }
        }
    }
    let (diagonal, mx) = columns(simd, &parts[0]);
    let (off, my) = columns(simd, &parts[1]);
    let (x, mz) = columns(simd, &parts[2]);
    let (y, fx) = columns(simd, &parts[3]);
    let (z, fy) = columns(simd, &parts[4]);
    let (mass, fz) = columns(simd, &parts[5]);
    let (mass_off, _) = columns(simd, &parts[6]);
    Articulated {
        rotation: Sym3 { diagonal, off },
        coupling: Mat3 { x, y, z },
        mass: Sym3 { diagonal: mass, off: mass_off },
        moment: Vec3::new(mx, my, mz),
        force: Vec3::new(fx, fy, fz),
    }
}

/// The pass towards the foot at eight rows of a level above the trunks.
#[inline(always)]
pub(super) fn fold_eight<S: Simd>(simd: S, cx: &Context<'_>, rows: &mut Rows<'_>, row: usize) {
    let constants = constants_of(simd, eight_of(rows.timber, row));
    let body = bodies_at(simd, rows, row);
    let joint = joints_at(simd, rows, row);
    let parents = parents_of(rows, row);
    let parent = bodies_of(simd, rows, &parents);
    let axis = segment_axis(&body);
    let bearing = u32x8::from_slice(simd, &rows.branches.bearing[row..row + LANES]).to_real();
    let mut whole = segment_body(cx, &constants, &body, axis, bearing);
    let mut most = 0;
    for timber in eight_of(rows.timber, row) {
        most = most.max(timber.child_count);
    }
    for number in 0..most {
        whole = articulated_add(&whole, &handed_by(simd, rows, row, number));
    }
    let (torque, spring) = joint_spring(cx, &constants, &joint, &body, axis, whole.rotation);
    let (answer, left) = joint_answer(torque, spring, &whole, &body, &parent);
    let handed = articulated_shift(&left, answer.arm);
    let zero = f32x8::splat(simd, 0.0);
    let work: &mut [Work; LANES] = rows.work[row..].first_chunk_mut().expect("eight rows of a level");
    store_part(work, 0, handed.rotation.diagonal, handed.moment.x);
    store_part(work, 1, handed.rotation.off, handed.moment.y);
    store_part(work, 2, handed.coupling.x, handed.moment.z);
    store_part(work, 3, handed.coupling.y, handed.force.x);
    store_part(work, 4, handed.coupling.z, handed.force.y);
    store_part(work, 5, handed.mass.diagonal, handed.force.z);
    store_part(work, 6, handed.mass.off, zero);
    let at = WORK_ANSWER as usize;
    store_part(work, at, answer.free, answer.turning.x);
    store_part(work, at + 1, answer.spring.x, answer.turning.y);
    store_part(work, at + 2, answer.spring.y, answer.turning.z);
    store_part(work, at + 3, answer.spring.z, answer.centripetal.x);
    store_part(work, at + 4, answer.lever.x, answer.centripetal.y);
    store_part(work, at + 5, answer.lever.y, answer.centripetal.z);
    store_part(work, at + 6, answer.lever.z, zero);
    store_part(work, at + 7, answer.arm, zero);
}

/// The answers of eight segments that follow one another.
#[inline(always)]
fn answers_at<S: Simd>(simd: S, work: &[Work], rows: &[usize; LANES]) -> Answer<f32x8<S>> {
    let at = WORK_ANSWER as usize;
    let (free, tx) = work_part(simd, work, rows, at);
    let (sx, ty) = work_part(simd, work, rows, at + 1);
    let (sy, tz) = work_part(simd, work, rows, at + 2);
    let (sz, cx) = work_part(simd, work, rows, at + 3);
    let (lx, cy) = work_part(simd, work, rows, at + 4);
    let (ly, cz) = work_part(simd, work, rows, at + 5);
    let (lz, _) = work_part(simd, work, rows, at + 6);
    let (arm, _) = work_part(simd, work, rows, at + 7);
    Answer {
        free,
        spring: Mat3 { x: sx, y: sy, z: sz },
        lever: Mat3 { x: lx, y: ly, z: lz },
        arm,
        turning: Vec3::new(tx, ty, tz),
        centripetal: Vec3::new(cx, cy, cz),
    }
}

/// Writes eight records of a column.
#[inline(always)]
fn store_eight<S: Simd>(column: &mut [Record], row: usize, v: Vec3<f32x8<S>>, w: f32x8<S>) {
    let out: &mut [Record; LANES] = column[row..].first_chunk_mut().expect("eight rows of a level");
    *out = records(v, w);
}

/// The pass towards the tips at eight rows of a level above the trunks.
#[inline(always)]
pub(super) fn unfold_eight<S: Simd>(simd: S, cx: &Context<'_>, rows: &mut Rows<'_>, row: usize) {
    let rows_here: [usize; LANES] = [0, 1, 2, 3, 4, 5, 6, 7].map(|lane: usize| row + lane);
    let parents = parents_of(rows, row);
    let answer = answers_at(simd, rows.work, &rows_here);
    let angular = work_part(simd, rows.work, &parents, 0).0;
    let linear = work_part(simd, rows.work, &parents, 1).0;
    let (motion, own) = joint_motion(&answer, &Motion { angular, linear });
    let zero = f32x8::splat(simd, 0.0);
    let work: &mut [Work; LANES] = rows.work[row..].first_chunk_mut().expect("eight rows of a level");
    store_part(work, 0, motion.angular, zero);
    store_part(work, 1, motion.linear, zero);
    let constants = constants_of(simd, eight_of(rows.timber, row));
    let joint = joint_step(cx, &joints_at(simd, rows, row), &bodies_at(simd, rows, row), own);
    let body = segment_place(&constants, &joint, &bodies_of(simd, rows, &parents));
    let branches = &mut rows.branches;
    store_eight(branches.turn, row, Vec3::new(joint.turn.x, joint.turn.y, joint.turn.z), joint.turn.w);
    store_eight(branches.rate, row, joint.rate, zero);
    store_eight(branches.base, row, body.base, zero);
    store_eight(branches.pose, row, Vec3::new(body.pose.x, body.pose.y, body.pose.z), body.pose.w);
    store_eight(branches.velocity, row, body.velocity, zero);
    store_eight(branches.spin, row, body.spin, zero);
}
