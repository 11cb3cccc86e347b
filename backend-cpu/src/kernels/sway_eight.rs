// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Both passes over a block of eight segments at once, side by side in SIMD registers, with the same bits as one by one.
//!
//! Where a block has fewer than eight rows, spare lanes compute something that nobody reads.

use bytemuck::must_cast_ref;
use fearless_simd::{Simd, SimdBase, f32x8, u32x8};
use windfall_core::Context;
use windfall_core::kernel::eight::{gather_records, load_records, scatter_records, store_records};
use windfall_core::kernel::lane::{LANES, Real, Word};
use windfall_core::kernel::{Mat3, Quat, Sym3, Vec3};
use windfall_core::tree::record::Work;
use windfall_core::tree::sway::fold::{articulated_add, articulated_shift, joint_answer, joint_spring};
use windfall_core::tree::sway::load::{segment_axis, segment_body};
use windfall_core::tree::sway::row::Rows;
use windfall_core::tree::sway::unfold::{Motion, joint_motion, joint_step, segment_place};
use windfall_core::tree::sway::{Articulated, Body, Joint};

use super::timber_eight::{AnswerEight, TimberEight, keep_answer, kept_answer};

type Record = [f32; 4];

/// A vector, and what stands behind it.
type Four<R> = (Vec3<R>, R);

/// Four columns as a vector and what stands behind it.
#[inline(always)]
fn four<S: Simd>([x, y, z, w]: [f32x8<S>; 4]) -> Four<f32x8<S>> {
    (Vec3::new(x, y, z), w)
}

/// Four columns as quaternions.
#[inline(always)]
fn quaternions<S: Simd>([x, y, z, w]: [f32x8<S>; 4]) -> Quat<f32x8<S>> {
    Quat::new(x, y, z, w)
}

/// The last elements of a column, the very last filling up what is missing to eight.
#[cold]
fn end_of<T: Copy>(column: &[T], row: usize) -> [T; LANES] {
    let left = &column[row..];
    core::array::from_fn(|lane| left[lane.min(left.len() - 1)])
}

/// Eight records of a column from `row` on.
#[inline(always)]
fn load_eight<S: Simd>(simd: S, column: &[Record], row: usize) -> [f32x8<S>; 4] {
    let [x, y, z, w] = match column[row..].first_chunk::<LANES>() {
        Some(all) => load_records(simd, must_cast_ref(all)),
        None => load_records(simd, must_cast_ref(&end_of(column, row))),
    };
    [Real::from_bits(x), Real::from_bits(y), Real::from_bits(z), Real::from_bits(w)]
}

/// Leaves on eight segments from `row` on.
#[inline(always)]
fn bearing_at<S: Simd>(simd: S, bearing: &[u32], row: usize) -> f32x8<S> {
    let count = match bearing[row..].first_chunk::<LANES>() {
        Some(all) => u32x8::load_array_ref(simd, all),
        None => u32x8::load_array(simd, end_of(bearing, row)),
    };
    count.to_real()
}

/// Writes the records of a block's rows.
#[inline(always)]
fn store_eight<S: Simd>(column: &mut [Record], block: &TimberEight, v: Vec3<f32x8<S>>, w: f32x8<S>) {
    let columns = [Real::to_bits(v.x), Real::to_bits(v.y), Real::to_bits(v.z), Real::to_bits(w)];
    let out: &mut [[u32; 4]] = bytemuck::must_cast_slice_mut(&mut column[block.row..block.row + block.count]);
    if let Some(all) = out.first_chunk_mut() {
        store_records(all, columns);
    } else {
        let mut spare = [[0; 4]; LANES];
        store_records(&mut spare, columns);
        out.copy_from_slice(&spare[..out.len()]);
    }
}

/// Writes one of the records of the work of a block's rows.
#[inline(always)]
fn store_part<S: Simd>(work: &mut [Work], part: usize, v: Vec3<f32x8<S>>, w: f32x8<S>) {
    let columns = [v.x, v.y, v.z, w];
    if let Some([a, b, c, d, e, f, g, h]) = work.first_chunk_mut() {
        let records = [
            &mut a[part],
            &mut b[part],
            &mut c[part],
            &mut d[part],
            &mut e[part],
            &mut f[part],
            &mut g[part],
            &mut h[part],
        ];
        scatter_records(records, columns);
    } else {
        let mut spare = [[0.0; 4]; LANES];
        scatter_records(spare.each_mut(), columns);
        for (work, record) in work.iter_mut().zip(spare) {
            work[part] = record;
        }
    }
}

/// The work of eight rows, wherever they are.
#[inline(always)]
fn works_of<'a>(work: &'a [Work], rows: &[u32; LANES]) -> [&'a Work; LANES] {
    let [a, b, c, d, e, f, g, h] = *rows;
    [
        &work[a as usize],
        &work[b as usize],
        &work[c as usize],
        &work[d as usize],
        &work[e as usize],
        &work[f as usize],
        &work[g as usize],
        &work[h as usize],
    ]
}

/// One of the records of the work of eight rows.
#[inline(always)]
fn work_part<S: Simd>(simd: S, works: [&Work; LANES], part: usize) -> Four<f32x8<S>> {
    let [a, b, c, d, e, f, g, h] = works;
    four(gather_records(
        simd,
        [&a[part], &b[part], &c[part], &d[part], &e[part], &f[part], &g[part], &h[part]],
    ))
}

/// Eight segments that follow one another.
#[inline(always)]
fn bodies_at<S: Simd>(simd: S, rows: &Rows<'_>, row: usize) -> Body<f32x8<S>> {
    let branches = &rows.branches;
    Body {
        base: four(load_eight(simd, branches.base, row)).0,
        pose: quaternions(load_eight(simd, branches.pose, row)),
        velocity: four(load_eight(simd, branches.velocity, row)).0,
        spin: four(load_eight(simd, branches.spin, row)).0,
    }
}

/// Eight segments wherever they are.
#[inline(always)]
fn bodies_of<S: Simd>(rows: &Rows<'_>, of: u32x8<S>) -> Body<f32x8<S>> {
    let branches = &rows.branches;
    Body {
        base: four(of.look_up(branches.base)).0,
        pose: quaternions(of.look_up(branches.pose)),
        velocity: four(of.look_up(branches.velocity)).0,
        spin: four(of.look_up(branches.spin)).0,
    }
}

/// Joints of eight segments that follow one another.
#[inline(always)]
fn joints_at<S: Simd>(simd: S, rows: &Rows<'_>, row: usize) -> Joint<f32x8<S>> {
    Joint {
        turn: quaternions(load_eight(simd, rows.branches.turn, row)),
        rate: four(load_eight(simd, rows.branches.rate, row)).0,
    }
}

/// What eight segments hand down.
#[inline(always)]
fn handed_by<S: Simd>(simd: S, works: [&Work; LANES]) -> Articulated<f32x8<S>> {
    let (diagonal, mx) = work_part(simd, works, 0);
    let (off, my) = work_part(simd, works, 1);
    let (x, mz) = work_part(simd, works, 2);
    let (y, fx) = work_part(simd, works, 3);
    let (z, fy) = work_part(simd, works, 4);
    let (mass, fz) = work_part(simd, works, 5);
    let (mass_off, _) = work_part(simd, works, 6);
    Articulated {
        rotation: Sym3 { diagonal, off },
        coupling: Mat3 { x, y, z },
        mass: Sym3 { diagonal: mass, off: mass_off },
        moment: Vec3::new(mx, my, mz),
        force: Vec3::new(fx, fy, fz),
    }
}

/// The pass towards the foot at a block, whose children are these.
#[inline(always)]
pub(super) fn fold_eight<S: Simd>(
    simd: S,
    cx: &Context<'_>,
    rows: &mut Rows<'_>,
    block: &TimberEight,
    children: &[[u32; LANES]],
    kept: &mut AnswerEight,
) {
    let constants = block.constants(simd);
    let body = bodies_at(simd, rows, block.row);
    let axis = segment_axis(&body);
    let bearing = bearing_at(simd, rows.branches.bearing, block.row);
    let mut whole = segment_body(cx, &constants, &body, axis, bearing);
    for children in children {
        whole = articulated_add(&whole, &handed_by(simd, works_of(rows.work, children)));
    }
    let joint = joints_at(simd, rows, block.row);
    let (torque, spring) = joint_spring(cx, &constants, &joint, &body, axis, whole.rotation);
    let parent = bodies_of(rows, block.parents(simd));
    let (answer, left) = joint_answer(torque, spring, &whole, &body, &parent);
    keep_answer(kept, &answer);
    let handed = articulated_shift(&left, answer.arm);
    let zero = f32x8::splat(simd, 0.0);
    let work = &mut rows.work[block.row..block.row + block.count];
    store_part(work, 0, handed.rotation.diagonal, handed.moment.x);
    store_part(work, 1, handed.rotation.off, handed.moment.y);
    store_part(work, 2, handed.coupling.x, handed.moment.z);
    store_part(work, 3, handed.coupling.y, handed.force.x);
    store_part(work, 4, handed.coupling.z, handed.force.y);
    store_part(work, 5, handed.mass.diagonal, handed.force.z);
    store_part(work, 6, handed.mass.off, zero);
}

/// The pass towards the tips at a block.
#[inline(always)]
pub(super) fn unfold_eight<S: Simd>(
    simd: S,
    cx: &Context<'_>,
    rows: &mut Rows<'_>,
    block: &TimberEight,
    kept: &AnswerEight,
) {
    let above = works_of(rows.work, block.parent_rows());
    let (angular, _) = work_part(simd, above, 0);
    let (linear, _) = work_part(simd, above, 1);
    let (motion, own) = joint_motion(&kept_answer(simd, kept), &Motion { angular, linear });
    let zero = f32x8::splat(simd, 0.0);
    let work = &mut rows.work[block.row..block.row + block.count];
    store_part(work, 0, motion.angular, zero);
    store_part(work, 1, motion.linear, zero);
    let joint = joints_at(simd, rows, block.row);
    let joint = joint_step(cx, &joint, &bodies_at(simd, rows, block.row), own);
    let body = segment_place(&block.constants(simd), &joint, &bodies_of(rows, block.parents(simd)));
    let branches = &mut rows.branches;
    store_eight(branches.turn, block, Vec3::new(joint.turn.x, joint.turn.y, joint.turn.z), joint.turn.w);
    store_eight(branches.rate, block, joint.rate, zero);
    store_eight(branches.base, block, body.base, zero);
    store_eight(branches.pose, block, Vec3::new(body.pose.x, body.pose.y, body.pose.z), body.pose.w);
    store_eight(branches.velocity, block, body.velocity, zero);
    store_eight(branches.spin, block, body.spin, zero);
}
