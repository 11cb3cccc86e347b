// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! How far apart two states may be.

use windfall_core::World;
use windfall_core::leaf::LeafState;
use windfall_core::leaf::record::{AERODYNAMIC, PRIMITIVE_MASK, PRIMITIVE_SHIFT};
use windfall_core::tree::Branches;

/// Largest difference of positions after a thousand smooth steps under the tolerant contract, in metres.
pub const LONG_POSITION_M: f32 = 1e-4;
/// Largest difference of quaternion components after a thousand smooth steps under the tolerant contract.
pub const LONG_QUATERNION: f32 = 1e-5;
/// Units in the last place of the largest operand that one step may differ by under the tolerant contract.
pub const STEP_ULPS: f32 = 4.0;
/// Largest difference of a segment's place in metres, and of the components of its orientation, after one step under the
/// tolerant contract. On hills the height above the ground that the wind grows with has its own rounding: 1.05e-5 was seen.
pub const STEP_SEGMENT: f32 = 2e-5;

/// What two worlds differ in.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Difference {
    /// Leaves with any integer that differs.
    pub integer_leaves: usize,
    /// Leaves with any bit that differs.
    pub bit_leaves: usize,
    /// Largest difference of a position component in metres.
    pub position_m: f32,
    /// Largest difference of a drift component in m/s.
    pub drift_m_s: f32,
    /// Largest difference of a quaternion component.
    pub quaternion: f32,
    /// Segments with any bit that differs, or another number of leaves.
    pub bit_segments: usize,
    /// Largest difference of a component of a segment's place in metres.
    pub base_m: f32,
    /// Largest difference of a component of a segment's orientation.
    pub pose: f32,
}

/// Compares all leaves of two worlds, slot by slot.
pub fn difference(a: &World, b: &World) -> Difference {
    let mut found = Difference::default();
    compare_branches(&mut found, &a.branches, &b.branches);
    let (a, b) = (&a.leaves, &b.leaves);
    for slot in 0..a.len().max(b.len()) {
        let integers = |leaves: &windfall_core::leaf::Leaves| {
            let bits = leaves.place[slot].bits;
            let (mut phase, mut course) = (leaves.drift[slot].phase, leaves.course[slot]);
            // A leaf on its twig and a body keep floats there.
            let is_body = (bits >> PRIMITIVE_SHIFT) & PRIMITIVE_MASK == AERODYNAMIC;
            if is_body || leaves.place[slot].state() == LeafState::Attached {
                (course.rate, course.heading) = (0, 0);
                if leaves.place[slot].state() != LeafState::Resting {
                    phase = 0;
                }
            }
            (bits, phase, course, leaves.identity[slot])
        };
        let same_integers = integers(a) == integers(b);
        let floats = |leaves: &windfall_core::leaf::Leaves| {
            let mut all = [0f32; 10];
            all[..3].copy_from_slice(&leaves.place[slot].position);
            all[3..6].copy_from_slice(&leaves.drift[slot].velocity);
            all[6..].copy_from_slice(&leaves.attitude[slot].quaternion);
            all
        };
        let (fa, fb) = (floats(a), floats(b));
        let same_phase = a.drift[slot].phase == b.drift[slot].phase && a.course[slot] == b.course[slot];
        let same_bits = fa.map(f32::to_bits) == fb.map(f32::to_bits) && same_phase;
        found.integer_leaves += usize::from(!same_integers);
        found.bit_leaves += usize::from(!(same_integers && same_bits));
        let worst = |range: std::ops::Range<usize>| {
            range.map(|index| (fa[index] - fb[index]).abs()).fold(0.0, f32::max)
        };
        found.position_m = found.position_m.max(worst(0..3));
        found.drift_m_s = found.drift_m_s.max(worst(3..6));
        found.quaternion = found.quaternion.max(worst(6..10));
    }
    found
}

fn compare_branches(found: &mut Difference, a: &Branches, b: &Branches) {
    assert_eq!(a.len(), b.len(), "the same forest");
    for row in 0..a.len() {
        let bits = |branches: &Branches| branches.columns().map(|column| column[row].map(f32::to_bits));
        found.bit_segments += usize::from(bits(a) != bits(b) || a.bearing[row] != b.bearing[row]);
        let worst =
            |x: [f32; 4], y: [f32; 4]| x.iter().zip(y).map(|(x, y)| (x - y).abs()).fold(0.0, f32::max);
        found.base_m = found.base_m.max(worst(a.base[row], b.base[row]));
        found.pose = found.pose.max(worst(a.pose[row], b.pose[row]));
    }
}

/// Size of a unit in the last place of `x`.
pub fn ulp(x: f32) -> f32 {
    let a = x.abs().max(f32::MIN_POSITIVE);
    f32::from_bits(a.to_bits() + 1) - a
}
