// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Extent of sway of all trees at one moment: largest displacement and speed.

use glam::{DQuat, DVec3, Quat, Vec3};

use super::forest::Forest;
use super::store::Branches;

/// The extremes over all segments at one moment, or over several moments.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct SwayExtent {
    /// Largest angle in rad by which a joint is turned away from rest.
    pub joint_angle_rad: f64,
    /// Largest speed in m/s of an upper end of a segment.
    pub tip_speed_m_s: f64,
}

impl SwayExtent {
    /// The extremes over the segments of a forest in that state; zero if there are none.
    pub fn of(forest: &Forest, branches: &Branches) -> Self {
        let rows = forest.segments().iter().enumerate();
        rows.fold(Self::default(), |extent, (row, segment)| {
            let [x, y, z, w] = branches.turn[row].map(f64::from);
            let sine = libm::sqrt(x * x + y * y + z * z);
            let pose: DQuat = Quat::from_array(branches.pose[row]).as_dquat();
            let arm = pose * (DVec3::Y * f64::from(segment.length));
            let spin = Vec3::from_slice(&branches.spin[row]).as_dvec3();
            let tip = Vec3::from_slice(&branches.velocity[row]).as_dvec3() + spin.cross(arm);
            extent.or(Self {
                joint_angle_rad: 2.0 * libm::atan2(sine, w.abs()),
                tip_speed_m_s: libm::sqrt(tip.length_squared()),
            })
        })
    }

    /// The extremes over both.
    #[must_use]
    pub fn or(self, other: Self) -> Self {
        Self {
            joint_angle_rad: self.joint_angle_rad.max(other.joint_angle_rad),
            tip_speed_m_s: self.tip_speed_m_s.max(other.tip_speed_m_s),
        }
    }
}
