// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Radii by the pipe model: pipes lead from the foot to every leaf, so what leaves a joint upwards is what comes from
//! below, `r_p^n = Σ r_c^n`.
//!
//! Pipes also begin along a segment, for the leaves that it has or had itself: it tapers by them. A tip ends with
//! `TIP_TAPER` of the radius at its base. The factor from the number of pipes to metres is chosen so that the
//! full-grown trunk has the grammar's girth.
//!
//! # Source
//! K. Shinozaki et al., "A quantitative analysis of plant form: the pipe model theory" (1964); the exponent lies
//! between 2, Leonardo's rule, and 2.3 in trees (R. Minamino and M. Tateno, 2014).

use super::turtle::Shoot;

/// Radius at the end of a tip per radius at its base.
const TIP_TAPER: f64 = 0.4;
/// Smallest radius in metres.
const THINNEST_M: f64 = 0.0002;
/// Height in metres at which the diameter of a trunk is measured, and the largest part of the plant's height that it
/// may be.
const BREAST_HEIGHT: (f64, f64) = (1.3, 0.1);

/// Radii of a segment, without a unit.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Radii {
    pub(crate) start: f64,
    pub(crate) end: f64,
}

/// Radii of the shoots that are `present`, from the pipes that begin in each.
pub(crate) fn radii(
    shoots: &[Shoot],
    pipes: impl Fn(&Shoot) -> f64,
    exponent: f64,
    present: impl Fn(usize) -> bool,
) -> Vec<Radii> {
    let mut above = vec![0.0; shoots.len()];
    let mut radii = vec![Radii::default(); shoots.len()];
    for (index, shoot) in shoots.iter().enumerate().rev().filter(|&(index, _)| present(index)) {
        let all = above[index] + pipes(shoot);
        let start = libm::pow(all, 1.0 / exponent);
        let tip = start * TIP_TAPER;
        radii[index] = Radii { start, end: libm::pow(above[index], 1.0 / exponent).max(tip) };
        if let Some(parent) = shoot.parent {
            above[parent] += all;
        }
    }
    radii
}

/// Metres per unit of the full-grown tree's radii: such that the thickest way up has the girth at breast height.
/// `scale` is in metres per unit of length. 0 if there are no pipes at all.
pub(crate) fn metres_per_unit(shoots: &[Shoot], radii: &[Radii], girth: f64, scale: f64) -> f64 {
    let height_m = super::growth::full_height(shoots) * scale;
    let breast_m = BREAST_HEIGHT.0.min(BREAST_HEIGHT.1 * height_m);
    let mut thickest = vec![0; shoots.len()];
    for (index, shoot) in shoots.iter().enumerate().skip(1) {
        let Some(parent) = shoot.parent else { continue };
        let best = thickest[parent];
        if best == 0 || radii[index].start > radii[best].start {
            thickest[parent] = index;
        }
    }
    let (mut index, mut bottom_m) = (0, 0.0);
    loop {
        let length_m = shoots[index].length * scale;
        let rise_m = shoots[index].direction.y * length_m;
        let next = thickest[index];
        if bottom_m + rise_m >= breast_m || next == 0 {
            let share = if rise_m > 0.0 { ((breast_m - bottom_m) / rise_m).clamp(0.0, 1.0) } else { 0.0 };
            let Radii { start, end } = radii[index];
            let radius = start + (end - start) * share;
            return if radius > 0.0 { girth * height_m / 2.0 / radius } else { 0.0 };
        }
        bottom_m += rise_m;
        index = next;
    }
}

/// A radius in metres, or the smallest that wood can have.
pub(crate) fn at_least_thin(radius_m: f64) -> f64 {
    radius_m.max(THINNEST_M)
}
