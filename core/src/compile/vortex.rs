// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Compiles vortices: where they are at a time, and the points of curved axes.

use glam::DVec3;

use crate::blocks::{VortexBlock, VortexNode};
use crate::convert::single;
use crate::device::wind::vortex::{SWIRL_COMPACT, SWIRL_KAUFMANN};
use crate::scene::{SPLINE_SEGMENTS, Vortex, VortexProfile};

/// A vortex so many seconds after time zero.
pub(super) fn vortex_block(vortex: &Vortex, seconds: f64) -> VortexBlock {
    let drift = vortex.drift_m_s.as_dvec3() * seconds;
    let axis = vortex.axis.as_dvec3().normalize();
    let core_squared = f64::from(vortex.core_m) * f64::from(vortex.core_m);
    let (profile, widening) = match vortex.profile {
        VortexProfile::Kaufmann => (SWIRL_KAUFMANN, 0.0),
        VortexProfile::Power { alpha } => (alpha, 0.0),
        VortexProfile::Compact { d } => (SWIRL_COMPACT, d),
    };
    VortexBlock {
        center_m: (vortex.center_m.as_dvec3() + drift).to_array().map(single),
        core_m2: single(core_squared),
        axis: axis.to_array().map(single),
        swirl_m2_s: single(f64::from(vortex.circulation_m2_s) / std::f64::consts::TAU),
        axial_m3_s: single(f64::from(vortex.axial_m_s) * core_squared),
        profile,
        widening,
        is_curved: u32::from(!vortex.spline_m.is_empty()),
        nodes: nodes(&vortex.spline_m.iter().map(|point| point.as_dvec3() + drift).collect::<Vec<_>>()),
    }
}

/// Points of a uniform cubic B-spline at equal steps of its parameter, and the inverse squared distance of each to the next.
fn nodes(control: &[DVec3]) -> [VortexNode; SPLINE_SEGMENTS as usize + 1] {
    let mut nodes = [<VortexNode as bytemuck::Zeroable>::zeroed(); SPLINE_SEGMENTS as usize + 1];
    if control.is_empty() {
        return nodes;
    }
    let pieces = (control.len() - 3) as f64;
    let at = |number: usize| point(control, number as f64 / f64::from(SPLINE_SEGMENTS) * pieces);
    for (number, node) in nodes.iter_mut().enumerate() {
        let (here, next) = (at(number), at((number + 1).min(SPLINE_SEGMENTS.into())));
        let squared = here.distance_squared(next);
        let inverse = if squared > 0.0 { 1.0 / squared } else { 0.0 };
        *node = VortexNode { place_m: here.to_array().map(single), inv_squared: single(inverse) };
    }
    nodes
}

/// Point of the spline at a parameter from zero to the number of its pieces.
fn point(control: &[DVec3], at: f64) -> DVec3 {
    let last = control.len() - 4;
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "within the list")]
    let piece = (libm::floor(at) as usize).min(last);
    let t = at - piece as f64;
    let (t2, t3) = (t * t, t * t * t);
    let weights = [
        (1.0 - 3.0 * t + 3.0 * t2 - t3) / 6.0,
        (4.0 - 6.0 * t2 + 3.0 * t3) / 6.0,
        (1.0 + 3.0 * t + 3.0 * t2 - 3.0 * t3) / 6.0,
        t3 / 6.0,
    ];
    weights.iter().zip(&control[piece..]).map(|(weight, point)| *point * *weight).sum()
}
