// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Three-dimensional orientation along a primitive path.
//!
//! A plate's force acts along its normal, so the normal follows the specific force `a + g` that the path implies, as
//! in a coordinated turn: a spiral banks inwards, a swing tilts up to some sixty degrees at its turning points. The
//! axes in the plane of the leaf are carried along without twisting (parallel transport). Motions that turn over
//! state their rotation themselves, because there the rule would flip.

use std::f64::consts::{PI, TAU};

use glam::{DQuat, DVec3};

use super::path::{Moment, Path};

/// Steps of the transport between two rows of a table.
const TRANSPORT_STEPS: usize = 8;
/// Below this share of gravity the specific force says too little; the normal stays.
const WEAK_FORCE: f64 = 0.15;

/// Orientations at `rows + 1` equally spaced times over one period. The last one equals the first as a rotation, so
/// that periods join; as quaternions they may differ in sign.
pub(super) fn orientations(path: &impl Path, rows: usize, gravity_m_s2: f64) -> Vec<DQuat> {
    let time = |step: usize| path.period_s() * step as f64 / (rows * TRANSPORT_STEPS) as f64;
    if path.at(0.0).turn.is_some() {
        return (0..=rows).map(|row| explicit(&path.at(time(row * TRANSPORT_STEPS)))).collect();
    }
    let mut normal = DVec3::Y;
    normal = follow(normal, &path.at(0.0), gravity_m_s2);
    let mut frame = DQuat::from_rotation_arc(DVec3::Y, normal);
    let mut carried = vec![frame];
    for step in 1..=rows * TRANSPORT_STEPS {
        let next = follow(normal, &path.at(time(step)), gravity_m_s2);
        frame = (DQuat::from_rotation_arc(normal, next) * frame).normalize();
        normal = next;
        if step % TRANSPORT_STEPS == 0 {
            carried.push(frame);
        }
    }
    // What transport around the loop leaves as a turn about the normal is taken back evenly over the period.
    let left = carried[0].inverse() * carried[rows];
    let mut residue = 2.0 * libm::atan2(left.y, left.w);
    residue -= TAU * libm::floor((residue + PI) / TAU);
    let closing = TAU * path.own_turns() - residue;
    carried
        .into_iter()
        .enumerate()
        .map(|(row, frame)| frame * about_y(closing * row as f64 / rows as f64))
        .collect()
}

/// The normal that the specific force of this moment asks for, on the side of the previous one.
fn follow(previous: DVec3, moment: &Moment, gravity_m_s2: f64) -> DVec3 {
    let force = moment.acceleration + DVec3::Y * gravity_m_s2;
    if force.length() < WEAK_FORCE * gravity_m_s2 {
        return previous;
    }
    let normal = force.normalize();
    if normal.dot(previous) < 0.0 { -normal } else { normal }
}

/// Orientation of a motion that states its rotation about +z.
fn explicit(moment: &Moment) -> DQuat {
    about_z(moment.turn.unwrap_or(0.0))
}

fn about_y(angle: f64) -> DQuat {
    let (sin, cos) = libm::sincos(0.5 * angle);
    DQuat::from_xyzw(0.0, sin, 0.0, cos)
}

/// A turn about +z, the axis across the plane of planar motions.
pub(super) fn about_z(angle: f64) -> DQuat {
    let (sin, cos) = libm::sincos(0.5 * angle);
    DQuat::from_xyzw(0.0, 0.0, sin, cos)
}
