// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! The gait of somebody who walks: each foot stands for three fifths of a stride and swings for the rest; legs and body follow.

use std::f64::consts::{FRAC_PI_2, PI, TAU};

use glam::{DQuat, DVec2, DVec3, Vec3};

use super::part::SolidPose;
use crate::scene::{ObjectShape, WALKER_LIMBS, Walker};

/// Way of the body in two steps in m.
const STRIDE_M: f64 = 1.45;
/// Share of a stride for which a foot stands, as the gait cycle is usually divided.
const STANCE: f64 = 0.6;
/// Height in m to which a swinging foot rises.
const LIFT_M: f64 = 0.09;
/// Half of the distance between the feet in m.
const HALF_WIDTH_M: f64 = 0.09;
/// Height of the hips in m while both feet stand.
const HIPS_M: f64 = 0.915;
/// Height in m by which the body rises above a single leg that stands, assumed.
const RISE_M: f64 = 0.045;
/// Height in m of the middle of the trunk above the hips, of the shoulders and of the head.
const TRUNK_M: f64 = 0.265;
const SHOULDERS_M: f64 = 0.465;
const HEAD_M: f64 = 0.735;
/// Length of a shank, and of a thigh, in m.
const HALF_LEG_M: f64 = 0.44;
/// Share of a stride after which a standing foot lifts its heel, and the angle in radians that it has when its toes leave the ground.
const HEEL_OFF: f64 = 0.35;
const TOE_OFF_RAD: f64 = 0.5;
/// Share of the swing within which it is level again.
const LEVEL_AGAIN: f64 = 0.7;
/// Distance in m of the ankle behind the middle of the foot.
const ANKLE_BEHIND_M: f64 = 0.07;
/// Radius of a boot in m.
const BOOT_RADIUS_M: f32 = 0.05;
/// Length of its straight part in m.
const BOOT_LENGTH_M: f32 = 0.19;

/// A limb of a walker.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Limb {
    /// A foot in its boot; its own y points to the toes.
    Boot(Side),
    /// A leg below the knee.
    Shank(Side),
    /// A leg above it.
    Thigh(Side),
    /// An arm with its hand, at the lower end of its own y.
    Arm(Side),
    /// Chest and hips.
    Trunk,
    /// The head.
    Head,
}

/// A side of the body.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Side {
    /// Left of the way.
    Left,
    /// Right of it.
    Right,
}

impl Side {
    /// +1 to the left, -1 to the right of the way.
    fn sign(self) -> f64 {
        if self == Self::Left { 1.0 } else { -1.0 }
    }

    /// Share of a stride by which this side is ahead.
    fn lead(self) -> f64 {
        if self == Self::Left { 0.0 } else { 0.5 }
    }

    fn other(self) -> Self {
        if self == Self::Left { Self::Right } else { Self::Left }
    }
}

/// All limbs of a walker.
pub const LIMBS: [Limb; WALKER_LIMBS] = [
    Limb::Boot(Side::Left),
    Limb::Boot(Side::Right),
    Limb::Shank(Side::Left),
    Limb::Shank(Side::Right),
    Limb::Thigh(Side::Left),
    Limb::Thigh(Side::Right),
    Limb::Arm(Side::Left),
    Limb::Arm(Side::Right),
    Limb::Trunk,
    Limb::Head,
];

impl Limb {
    /// Number among the limbs of a walker.
    pub fn number(self) -> usize {
        LIMBS.iter().position(|&limb| limb == self).unwrap_or(0)
    }

    /// Returns true if two limbs share a joint, or are the same one.
    pub fn joins(self, other: Self) -> bool {
        let is_jointed = |pair| match pair {
            (Self::Boot(one), Self::Shank(two)) | (Self::Shank(one), Self::Thigh(two)) => one == two,
            (Self::Thigh(_) | Self::Arm(_) | Self::Head, Self::Trunk) => true,
            _ => false,
        };
        self == other || is_jointed((self, other)) || is_jointed((other, self))
    }

    /// Shape of a limb.
    pub(super) fn shape(self) -> ObjectShape {
        let (radius_m, length_m) = match self {
            Self::Boot(_) => (BOOT_RADIUS_M, BOOT_LENGTH_M),
            Self::Shank(_) => (0.055, 0.36),
            Self::Thigh(_) => (0.08, 0.36),
            Self::Arm(_) => (0.047, 0.5),
            Self::Trunk => (0.16, 0.4),
            Self::Head => (0.092, 0.06),
        };
        ObjectShape::Capsule { radius_m, length_m }
    }

    /// Reflectance of a limb of somebody in a jacket of some reflectance: boots, trousers, jacket and skin.
    pub(super) fn color(self, jacket: Vec3) -> Vec3 {
        match self {
            Self::Boot(_) => Vec3::new(0.09, 0.05, 0.03),
            Self::Shank(_) | Self::Thigh(_) => Vec3::new(0.05, 0.07, 0.12),
            Self::Arm(_) | Self::Trunk => jacket,
            Self::Head => Vec3::new(0.45, 0.27, 0.18),
        }
    }
}

/// A walk along a way.
#[derive(Clone, Debug)]
pub(super) struct Gait {
    corners: Vec<DVec2>,
    speed_m_s: f64,
    start_s: f64,
}

/// A foot at a time.
struct Foot {
    /// Place of its middle on the ground, and the direction of the way there.
    at: DVec2,
    ahead: DVec2,
    /// Height in m above its place on the ground.
    lift_m: f64,
    /// Angle in radians by which its toes point down.
    pitch: f64,
}

impl Foot {
    /// Place of its ankle, over ground of a height at x, z.
    fn ankle(&self, ground_m: impl Fn(f64, f64) -> f64) -> DVec3 {
        let (sin, cos) = (libm::sin(self.pitch), libm::cos(self.pitch));
        let radius = f64::from(BOOT_RADIUS_M);
        let ahead = radius * sin - ANKLE_BEHIND_M * cos;
        let up = radius * cos + ANKLE_BEHIND_M * sin;
        let height = ground_m(self.at.x, self.at.y) + radius + self.lift_m + up;
        DVec3::new(self.at.x + self.ahead.x * ahead, height, self.at.y + self.ahead.y * ahead)
    }
}

impl Gait {
    /// The gait of a walker.
    pub(super) fn of(walker: &Walker) -> Self {
        Self {
            corners: walker.way_m.iter().map(|corner| corner.as_dvec2()).collect(),
            speed_m_s: walker.speed_m_s.into(),
            start_s: walker.start_s.into(),
        }
    }

    /// Length of the way in m.
    fn length_m(&self) -> f64 {
        self.corners.windows(2).map(|ends| ends[0].distance(ends[1])).sum()
    }

    /// Place so many metres along the way, and its direction there. Before its first corner and behind its last it goes straight on.
    fn along(&self, mut way_m: f64) -> (DVec2, DVec2) {
        let last = self.corners.len().saturating_sub(2);
        for (index, ends) in self.corners.windows(2).enumerate() {
            let length = ends[0].distance(ends[1]);
            let ahead = (ends[1] - ends[0]) / length;
            if way_m <= length || index == last {
                return (ends[0] + ahead * way_m, ahead);
            }
            way_m -= length;
        }
        (DVec2::ZERO, DVec2::X)
    }

    /// Way in m that the body has come at a time.
    fn walked_m(&self, time_s: f64) -> f64 {
        ((time_s - self.start_s) * self.speed_m_s).clamp(0.0, self.length_m())
    }

    /// A foot when the body has come so far.
    fn foot(&self, side: Side, walked_m: f64) -> Foot {
        let strides = walked_m / STRIDE_M + side.lead();
        let (number, phase) = (strides.floor(), strides - strides.floor());
        let swing = ((phase - STANCE) / (1.0 - STANCE)).max(0.0);
        let way_m = STRIDE_M * (number - side.lead() + 0.5 * STANCE + eased(swing));
        // The heel rises about the toes, the foot swings on level again, and its toes rise before it lands.
        let heel_up = TOE_OFF_RAD
            * eased(((phase - HEEL_OFF) / (STANCE - HEEL_OFF)).clamp(0.0, 1.0))
            * (1.0 - eased((swing / LEVEL_AGAIN).min(1.0)));
        let toes_up = 0.3 * libm::sin(PI * (2.0 * swing - 1.0).max(0.0));
        let to_toes_m = 0.5 * f64::from(BOOT_LENGTH_M);
        let way_m = way_m + to_toes_m * (1.0 - libm::cos(heel_up));
        let (middle, ahead) = self.along(way_m);
        let left = DVec2::new(ahead.y, -ahead.x);
        let raised = libm::sin(PI * swing);
        Foot {
            at: middle + left * (side.sign() * HALF_WIDTH_M),
            ahead,
            lift_m: LIFT_M * raised * raised + to_toes_m * libm::sin(heel_up),
            pitch: heel_up - toes_up,
        }
    }

    /// Pose of a limb at a time, over ground of a height at x, z.
    pub(super) fn pose(&self, limb: Limb, time_s: f64, ground_m: impl Fn(f64, f64) -> f64) -> SolidPose {
        let walked_m = self.walked_m(time_s);
        let (middle, ahead) = self.along(walked_m);
        let left = DVec2::new(ahead.y, -ahead.x);
        let above = |at: DVec2, height_m: f64| DVec3::new(at.x, ground_m(at.x, at.y) + height_m, at.y);
        let hips_m = hips_m(walked_m);
        match limb {
            Limb::Boot(side) => {
                let foot = self.foot(side, walked_m);
                let turn = facing(foot.ahead) * DQuat::from_rotation_x(FRAC_PI_2 + foot.pitch);
                SolidPose { center_m: above(foot.at, f64::from(BOOT_RADIUS_M) + foot.lift_m), turn }
            }
            Limb::Shank(side) | Limb::Thigh(side) => {
                let foot = self.foot(side, walked_m);
                let ankle = foot.ankle(&ground_m);
                let hip = above(middle + left * (side.sign() * HALF_WIDTH_M), hips_m);
                let knee = knee_between(ankle, hip, DVec3::new(ahead.x, 0.0, ahead.y));
                if matches!(limb, Limb::Shank(_)) { rod(ankle, knee) } else { rod(knee, hip) }
            }
            Limb::Arm(side) => {
                // An arm swings with the leg of the other side.
                let foot = self.foot(side.other(), walked_m);
                let reach = (foot.at - middle).dot(ahead);
                let shoulder = above(middle + left * (side.sign() * 0.2), hips_m + SHOULDERS_M);
                let hand = shoulder + DVec3::new(ahead.x * 0.5 * reach, -0.55, ahead.y * 0.5 * reach);
                rod(hand, shoulder)
            }
            Limb::Trunk => SolidPose { center_m: above(middle, hips_m + TRUNK_M), turn: facing(ahead) },
            Limb::Head => SolidPose { center_m: above(middle, hips_m + HEAD_M), turn: facing(ahead) },
        }
    }
}

/// Height of the hips in m: over each leg that stands alone they go as over a pendulum upside down.
fn hips_m(walked_m: f64) -> f64 {
    let strides = walked_m / STRIDE_M - 0.5 * STANCE;
    HIPS_M + 0.5 * RISE_M * (1.0 + libm::cos(2.0 * TAU * strides))
}

/// Smooth step from 0 to 1.
fn eased(part: f64) -> f64 {
    part * part * (3.0 - 2.0 * part)
}

/// Turn of a part that faces a direction: its own z points ahead.
fn facing(ahead: DVec2) -> DQuat {
    DQuat::from_rotation_y(libm::atan2(ahead.x, ahead.y))
}

/// Pose of a rod between two places: its own y points from one to the other.
fn rod(from: DVec3, to: DVec3) -> SolidPose {
    let way = (to - from).normalize_or(DVec3::Y);
    SolidPose { center_m: (from + to) * 0.5, turn: DQuat::from_rotation_arc(DVec3::Y, way) }
}

/// Place of a knee between ankle and hip: both halves of the leg are as long, and it bends forward.
fn knee_between(ankle: DVec3, hip: DVec3, ahead: DVec3) -> DVec3 {
    let half = (hip - ankle) * 0.5;
    let bend = (HALF_LEG_M * HALF_LEG_M - half.length_squared()).max(0.0).sqrt();
    let across = (ahead - half * (ahead.dot(half) / half.length_squared())).normalize_or(ahead);
    ankle + half + across * bend
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::Vec2;

    fn gait() -> Gait {
        Gait::of(&Walker {
            way_m: vec![Vec2::new(0.0, 0.0), Vec2::new(10.0, 0.0), Vec2::new(10.0, 8.0)],
            speed_m_s: 1.4,
            start_s: 2.0,
            ..Walker::default()
        })
    }

    /// Place of the middle of the toes.
    fn toes(side: Side, time_s: f64) -> DVec3 {
        let pose = gait().pose(Limb::Boot(side), time_s, |_, _| 0.0);
        pose.center_m + pose.turn * DVec3::Y * (0.5 * f64::from(BOOT_LENGTH_M))
    }

    #[test]
    fn feet_stand_three_fifths_of_the_time_and_swing_at_three_to_four_metres_a_second_on_average() {
        let (mut standing, mut swung_m, mut swinging_s) = (0.0, 0.0, 0.0);
        let (count, step_s) = (4000, 1.0e-3);
        for number in 0..count {
            let time_s = 2.5 + f64::from(number) * step_s;
            let way_m = toes(Side::Left, time_s).distance(toes(Side::Left, time_s + step_s));
            if way_m < 1.0e-9 {
                standing += 1.0;
            } else {
                swung_m += way_m;
                swinging_s += step_s;
            }
        }
        let share = standing / f64::from(count);
        assert!((share - 0.6).abs() < 0.06, "a foot stands {share} of the time");
        let speed = swung_m / swinging_s;
        assert!((3.0..4.0).contains(&speed), "a foot swings at {speed} m/s");
    }

    #[test]
    fn legs_hold_together_and_nothing_is_below_the_ground() {
        let gait = gait();
        for number in 0..1500 {
            let time_s = 0.01 * f64::from(number);
            for limb in LIMBS {
                let pose = gait.pose(limb, time_s, |_, _| 3.0);
                assert!(pose.turn.is_normalized(), "{limb:?} at {time_s} s");
                let ObjectShape::Capsule { radius_m, length_m } = limb.shape() else {
                    unreachable!("capsules")
                };
                let half = pose.turn * DVec3::Y * f64::from(0.5 * length_m);
                let lowest = pose.center_m.y - half.y.abs() - f64::from(radius_m);
                assert!(lowest > 3.0 - 0.04, "{limb:?} reaches down to {lowest} m at {time_s} s");
            }
            for side in [Side::Left, Side::Right] {
                let shank = gait.pose(Limb::Shank(side), time_s, |_, _| 3.0).center_m;
                let thigh = gait.pose(Limb::Thigh(side), time_s, |_, _| 3.0).center_m;
                assert!(shank.distance(thigh) < HALF_LEG_M + 0.02, "a knee comes apart at {time_s} s");
            }
        }
    }

    #[test]
    fn a_walk_begins_and_ends_at_rest() {
        assert_eq!(toes(Side::Left, 0.0), toes(Side::Left, 2.0), "before its start");
        assert_eq!(toes(Side::Right, 40.0), toes(Side::Right, 60.0), "after its end");
        let end = gait().pose(Limb::Trunk, 60.0, |_, _| 0.0).center_m;
        assert!(
            end.with_y(0.0).distance(DVec3::new(10.0, 0.0, 8.0)) < 1.0e-9,
            "at the end of the way: {end}"
        );
    }

    #[test]
    fn a_body_rises_over_a_leg_that_stands_alone_and_legs_are_almost_straight_then() {
        let gait = gait();
        let hips = |strides: f64| hips_m(STRIDE_M * strides);
        assert!((hips(0.3) - hips(0.05) - RISE_M).abs() < 1.0e-12, "highest in the middle of a stance");
        assert!((hips(0.8) - hips(0.55) - RISE_M).abs() < 1.0e-12, "of either foot");
        for stride in 2..6 {
            for (side, phase) in [(Side::Left, 0.3), (Side::Right, 0.8)] {
                let time_s = 2.0 + STRIDE_M * (f64::from(stride) + phase) / 1.4;
                let bent = leg_m(&gait, side, time_s) / (2.0 * HALF_LEG_M);
                assert!((0.95..0.99).contains(&bent), "{side:?} in stride {stride}: {bent}");
            }
        }
        for number in 0..1200 {
            let time_s = 2.0 + 0.01 * f64::from(number);
            let longest = leg_m(&gait, Side::Left, time_s).max(leg_m(&gait, Side::Right, time_s));
            assert!(longest < 2.0 * HALF_LEG_M + 0.05, "a leg of {longest} m at {time_s} s");
        }
    }

    /// Distance in m from hip to ankle.
    fn leg_m(gait: &Gait, side: Side, time_s: f64) -> f64 {
        let end = |limb, up: f64| {
            let pose = gait.pose(limb, time_s, |_, _| 0.0);
            (pose.center_m, pose.turn * DVec3::Y * up)
        };
        let ((shank, down), (thigh, up)) = (end(Limb::Shank(side), -1.0), end(Limb::Thigh(side), 1.0));
        let half = 0.5 * HALF_LEG_M;
        (thigh + up * half).distance(shank + down * half)
    }
}
