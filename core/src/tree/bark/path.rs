// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! The course of a limb: where its middle runs, how thick it is, and which segments move it.

use std::f32::consts::TAU;

use glam::Vec3;

use super::limb::Limb;
use crate::tree::Skeleton;

/// Share by which a branch is thicker where it leaves its parent.
const COLLAR: f32 = 0.3;
/// Way over which that share falls to 1/e, in radii.
const COLLAR_REACH: f32 = 0.9;
/// Share by which the foot of a big trunk is wider than the trunk.
const FLARE: f32 = 0.55;
/// Radii of a trunk without and with the whole flare, in metres.
const FLARE_RADII_M: [f32; 2] = [0.01, 0.1];
/// Depth of the foot below the ground, in radii.
const SUNK: f32 = 0.3;
/// Cosine of the weakest bend that is rounded.
const ROUNDED_BEND: f32 = 0.99;
/// Distance before and after a joint over which its bend is rounded, in radii. The middle of the limb leaves the joint by less than
/// a radius then, so leaves still touch the bark.
const ROUNDING: f32 = 4.0;

/// A straight piece of the course.
#[derive(Clone, Copy, Debug)]
pub(super) struct Piece {
    segment: u32,
    from_m: Vec3,
    pub(super) direction: Vec3,
    /// Distance along the limb at which it begins.
    pub(super) begin_m: f32,
    length_m: f32,
}

/// The course of a limb by length from its base.
#[derive(Clone, Debug)]
pub(super) struct Path {
    pub(super) pieces: Vec<Piece>,
    /// Radius at the begin of every piece and at the end of the last.
    radii_m: Vec<f32>,
    /// Half the length over which the bend at the begin of every piece is rounded.
    pub(super) rounding_m: Vec<f32>,
    pub(super) root: Root,
}

/// Base that a limb grows from.
#[derive(Clone, Copy, Debug)]
pub(super) enum Root {
    /// The ground: height of the ground along the course, share of the flare.
    Ground { sunk_m: f32, flare: f32 },
    /// Another limb: its segment, how thick the branch may be inside it, where along the course it comes out, which way
    /// the other limb goes.
    Limb { segment: u32, room_m: f32, out_m: f32, axis: Vec3 },
}

impl Path {
    /// The course of a limb that grows from another one's, or from the ground.
    pub(super) fn along(skeleton: &Skeleton, limb: &Limb, parent: Option<&Self>) -> Self {
        let of = |index: u32| &skeleton.segments[index as usize];
        let first = of(limb.segments[0]);
        let mut points: Vec<(Vec3, u32)> = limb.segments.iter().map(|&s| (of(s).start_m, s)).collect();
        let mut radii_m = vec![first.start_radius_m];
        for pair in limb.segments.windows(2) {
            radii_m.push(0.5 * (of(pair[0]).end_radius_m + of(pair[1]).start_radius_m));
        }
        let last = of(limb.segments[limb.segments.len() - 1]);
        radii_m.push(last.end_radius_m);
        let root = match limb.parent.zip(parent) {
            None => {
                let [none, whole] = FLARE_RADII_M;
                let share = ((first.start_radius_m - none) / (whole - none)).clamp(0.0, 1.0);
                let sunk_m = SUNK * first.start_radius_m;
                points.insert(0, (first.start_m - first.direction() * sunk_m, limb.segments[0]));
                radii_m.insert(0, first.start_radius_m);
                Root::Ground { sunk_m, flare: FLARE * share }
            }
            Some((segment, parent)) => {
                let at_m = parent.nearest_m(segment, first.start_m);
                let (anchor, axis, radius_m) =
                    (parent.center_m(at_m), parent.direction(at_m), parent.radius_m(at_m));
                // Straight back into the parent, as far as that leads towards its middle.
                let aside = first.start_m - anchor;
                let mut back_m = aside.dot(first.direction());
                if back_m > 0.1 * first.start_radius_m {
                    points.insert(0, (first.start_m - first.direction() * back_m, segment));
                    radii_m.insert(0, first.start_radius_m);
                } else {
                    back_m = 0.0;
                }
                let across = first.direction().reject_from(axis).length().max(0.35);
                let hidden_m = (radius_m - aside.length()).max(0.0) / across;
                let out_m = back_m + hidden_m.min(0.5 * first.length_m());
                let missed_m = (aside - first.direction() * back_m).length();
                let room_m = (0.9 * radius_m - missed_m).max(0.3 * first.start_radius_m);
                Root::Limb { segment, room_m, out_m, axis }
            }
        };
        let mut pieces: Vec<Piece> = Vec::with_capacity(points.len());
        let mut begin_m = 0.0;
        for (index, &(from_m, segment)) in points.iter().enumerate() {
            let way = points.get(index + 1).map_or(last.end_m, |next| next.0) - from_m;
            let length_m = way.length();
            let direction = way.normalize_or(of(segment).direction());
            pieces.push(Piece { segment, from_m, direction, begin_m, length_m });
            begin_m += length_m;
        }
        let rounding_m = (0..pieces.len())
            .map(|at| match at.checked_sub(1).map(|before| (&pieces[before], &pieces[at])) {
                Some((a, b)) if a.direction.dot(b.direction) < ROUNDED_BEND => {
                    (ROUNDING * radii_m[at]).min(0.4 * a.length_m).min(0.4 * b.length_m)
                }
                _ => 0.0,
            })
            .collect();
        Self { pieces, radii_m, rounding_m, root }
    }

    /// The length at which a segment of the limb is nearest to a place.
    fn nearest_m(&self, segment: u32, place: Vec3) -> f32 {
        // The last piece of the segment: what is sunk before it belongs to the same one.
        let piece = self.pieces.iter().rfind(|piece| piece.segment == segment).unwrap_or(&self.pieces[0]);
        piece.begin_m + (place - piece.from_m).dot(piece.direction).clamp(0.0, piece.length_m)
    }

    /// Length from the base to the tip.
    pub(super) fn length_m(&self) -> f32 {
        let last = self.pieces[self.pieces.len() - 1];
        last.begin_m + last.length_m
    }

    /// Radius at the base, without flare or collar.
    pub(super) fn base_radius_m(&self) -> f32 {
        self.radii_m[0]
    }

    /// Radius at the tip.
    pub(super) fn tip_radius_m(&self) -> f32 {
        self.radii_m[self.radii_m.len() - 1]
    }

    /// A direction that is not along the limb at its base, to begin the frames with.
    pub(super) fn aside(&self) -> Vec3 {
        match self.root {
            Root::Ground { .. } => Vec3::X,
            Root::Limb { axis, .. } => axis,
        }
    }

    /// The piece at a length, and the length within it.
    fn piece(&self, at_m: f32) -> (usize, f32) {
        let index = self.pieces.partition_point(|piece| piece.begin_m <= at_m).saturating_sub(1);
        (index, at_m - self.pieces[index].begin_m)
    }

    /// The bend whose rounding a length lies in: its piece, and where in it from 0 to 1.
    fn bend(&self, at_m: f32) -> Option<(usize, f32)> {
        let (index, _) = self.piece(at_m);
        [index, index + 1].into_iter().find_map(|bend| {
            let (piece, half_m) = (self.pieces.get(bend)?, self.rounding_m[bend]);
            let share = (at_m - piece.begin_m + half_m) / (2.0 * half_m);
            (half_m > 0.0 && (0.0..=1.0).contains(&share)).then_some((bend, share))
        })
    }

    /// The middle of the limb.
    pub(super) fn center_m(&self, at_m: f32) -> Vec3 {
        if let Some((bend, share)) = self.bend(at_m) {
            let (before, after) = (&self.pieces[bend - 1], &self.pieces[bend]);
            let half_m = self.rounding_m[bend];
            let back = before.direction * (half_m * (1.0 - share) * (1.0 - share));
            return after.from_m - back + after.direction * (half_m * share * share);
        }
        let (index, within_m) = self.piece(at_m);
        self.pieces[index].from_m + self.pieces[index].direction * within_m
    }

    /// Unit vector along the limb towards its tip; at a joint that is not rounded, half-way between both sides.
    pub(super) fn direction(&self, at_m: f32) -> Vec3 {
        let (index, within_m) = self.piece(at_m);
        let here = self.pieces[index].direction;
        let turned = match self.bend(at_m) {
            Some((bend, share)) => self.pieces[bend - 1].direction.lerp(self.pieces[bend].direction, share),
            None if within_m == 0.0 && index > 0 => self.pieces[index - 1].direction + here,
            None => here,
        };
        turned.normalize_or(here)
    }

    /// Radius of the limb, flare aside.
    pub(super) fn radius_m(&self, at_m: f32) -> f32 {
        let (index, within_m) = self.piece(at_m);
        let share = (within_m / self.pieces[index].length_m.max(f32::MIN_POSITIVE)).clamp(0.0, 1.0);
        let plain = self.radii_m[index] + (self.radii_m[index + 1] - self.radii_m[index]) * share;
        match self.root {
            Root::Ground { .. } => plain,
            Root::Limb { room_m, out_m, .. } => {
                let beyond = (at_m - out_m).max(0.0) / (COLLAR_REACH * self.base_radius_m());
                let thicker = plain * (1.0 + COLLAR * libm::expf(-beyond));
                // What is inside the parent stays inside.
                if at_m < 0.5 * out_m { thicker.min(room_m) } else { thicker }
            }
        }
    }

    /// Factor of the radius at an angle around the limb: the roots' beginnings.
    pub(super) fn flare(&self, at_m: f32, angle_rad: f32) -> f32 {
        let Root::Ground { sunk_m, flare } = self.root else { return 1.0 };
        let above = (at_m - sunk_m).max(0.0) / (1.1 * self.base_radius_m());
        let lobes = libm::cosf(3.0 * angle_rad + 0.9) + 0.8 * libm::cosf(5.0 * angle_rad + 2.3);
        1.0 + flare * libm::expf(-above) * (1.0 + 0.35 * lobes)
    }

    /// Number of repeats of the texture around the limb.
    pub(super) fn repeats(&self) -> f32 {
        libm::roundf(TAU * self.base_radius_m() / super::BARK_TILE_M).max(1.0)
    }

    /// The segments that move the limb here, and their shares: smooth over half of both segments at a joint, and from
    /// the parent to the branch where it comes out.
    pub(super) fn weights(&self, at_m: f32) -> ([u16; 4], [f32; 4]) {
        let mut shares: Vec<(u32, f32)> = Vec::with_capacity(4);
        let mut add = |segment: u32, share: f32| match shares.iter_mut().find(|(known, _)| *known == segment)
        {
            Some((_, sum)) => *sum += share,
            None if share > 0.0 => shares.push((segment, share)),
            None => {}
        };
        let own = match self.root {
            Root::Ground { .. } => 1.0,
            Root::Limb { segment, out_m, .. } => {
                let reach_m = 2.0 * out_m + self.base_radius_m();
                let own = smooth(at_m / reach_m.min(self.length_m()));
                add(segment, 1.0 - own);
                own
            }
        };
        let (index, _) = self.piece(at_m);
        let (mut before, mut after) = (0.0, 0.0);
        if index > 0 {
            before = 1.0 - self.crossed(index, at_m);
            add(self.pieces[index - 1].segment, own * before);
        }
        if index + 1 < self.pieces.len() {
            after = self.crossed(index + 1, at_m);
            add(self.pieces[index + 1].segment, own * after);
        }
        add(self.pieces[index].segment, own * (1.0 - before - after));
        let sum: f32 = shares.iter().map(|(_, share)| share).sum();
        let (mut joints, mut weights) = ([0; 4], [0.0; 4]);
        for (slot, (segment, share)) in shares.into_iter().enumerate() {
            // A skeleton has no more than 65536 segments.
            joints[slot] = u16::try_from(segment).unwrap_or(u16::MAX);
            weights[slot] = share / sum;
        }
        (joints, weights)
    }

    /// Progress from 0 to 1 of a length across the joint at the beginning of a piece.
    fn crossed(&self, joint: usize, at_m: f32) -> f32 {
        let half_m = 0.5 * self.pieces[joint - 1].length_m.min(self.pieces[joint].length_m);
        smooth(0.5 + 0.5 * (at_m - self.pieces[joint].begin_m) / half_m.max(f32::MIN_POSITIVE))
    }
}

/// From 0 to 1 with level ends.
fn smooth(share: f32) -> f32 {
    let share = share.clamp(0.0, 1.0);
    share * share * (3.0 - 2.0 * share)
}
