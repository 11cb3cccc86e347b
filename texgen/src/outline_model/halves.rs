// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Outlines cut along the midrib, so that the halves of different leaves can be joined.

use glam::Vec2;

use crate::Blade;
use crate::extract::outline::twice_area;
use crate::math::segment_distance;

/// Longest side of an outline's polygon, as a share of the midrib.
const PIECE: f32 = 0.012;

/// The two sides of an outline. Coordinates: root at (0, 0), tip at (0, 1), y toward the tip.
#[derive(Clone, Debug)]
pub(super) struct Halves {
    /// Points from root to tip on the side of positive x, both ends included.
    pub(super) right: Vec<Vec2>,
    /// Points from root to tip on the other side.
    pub(super) left: Vec<Vec2>,
}

impl Halves {
    /// Cuts a blade's outline; `None` if root and tip coincide or one side is missing.
    pub(super) fn of(blade: &Blade) -> Option<Self> {
        let axis = blade.tip - blade.root;
        let length = axis.length_squared();
        let is_apart = length > 1e-6;
        if !is_apart || blade.outline.len() < 3 {
            return None;
        }
        // Turned so that the midrib points along y, and mirrored from y down to y up.
        let place = |p: Vec2| {
            let from = p - blade.root;
            Vec2::new(axis.perp_dot(from), axis.dot(from)) / length
        };
        let mut ring: Vec<Vec2> = blade.outline.iter().map(|p| place(*p)).collect();
        insert(&mut ring, Vec2::ZERO);
        insert(&mut ring, Vec2::Y);
        let root = ring.iter().position(|p| *p == Vec2::ZERO)?;
        ring.rotate_left(root);
        let tip = ring.iter().position(|p| *p == Vec2::Y)?;
        let mut back = ring.split_off(tip);
        ring.push(Vec2::Y);
        back.push(Vec2::ZERO);
        back.reverse();
        let lean = |half: &[Vec2]| half.iter().map(|p| p.x).sum::<f32>() / half.len() as f32;
        let (right, left) = if lean(&ring) >= lean(&back) { (ring, back) } else { (back, ring) };
        (right.len() > 2 && left.len() > 2).then(|| Self { right: refined(&right), left: refined(&left) })
    }

    /// Left and right exchanged.
    pub(super) fn mirrored(&self) -> Self {
        let flip = |half: &[Vec2]| half.iter().map(|p| Vec2::new(-p.x, p.y)).collect();
        Self { right: flip(&self.left), left: flip(&self.right) }
    }

    /// The closed outline, and which of its points is the tip; the first one is the root.
    pub(super) fn joined(&self) -> (Vec<Vec2>, usize) {
        let mut ring = self.right.clone();
        let tip = ring.len() - 1;
        ring.extend(self.left.iter().rev().skip(1));
        ring.pop();
        (ring, tip)
    }

    /// Area between a side and the midrib.
    pub(super) fn side_area(half: &[Vec2]) -> f32 {
        twice_area(half).abs() / 2.0
    }
}

/// Makes a point that lies on (or near) a closed polygon one of its corners.
fn insert(ring: &mut Vec<Vec2>, p: Vec2) {
    if ring.contains(&p) {
        return;
    }
    let distance = |i: &usize| segment_distance(p, ring[*i], ring[(*i + 1) % ring.len()]).0;
    let Some(side) = (0..ring.len()).min_by(|a, b| distance(a).total_cmp(&distance(b))) else { return };
    let next = (side + 1) % ring.len();
    for corner in [side, next] {
        if ring[corner].distance(p) < 0.01 && ring[corner] != Vec2::ZERO {
            ring[corner] = p;
            return;
        }
    }
    ring.insert(side + 1, p);
}

/// The same path with no piece longer than [`PIECE`].
fn refined(path: &[Vec2]) -> Vec<Vec2> {
    let mut points = Vec::with_capacity(path.len() * 4);
    for pair in path.windows(2) {
        let pieces = (pair[0].distance(pair[1]) / PIECE).ceil().clamp(1.0, 200.0);
        let mut k = 0.0;
        while k < pieces {
            points.push(pair[0].lerp(pair[1], k / pieces));
            k += 1.0;
        }
    }
    points.extend(path.last());
    points
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Mask;

    #[test]
    fn halves_join_to_the_outline_they_were_cut_from() {
        // A kite whose tip points left; counter-clockwise with y up.
        let outline =
            vec![Vec2::new(100.0, 50.0), Vec2::new(40.0, 20.0), Vec2::new(20.0, 50.0), Vec2::new(40.0, 90.0)];
        let blade =
            Blade { mask: Mask::empty(1, 1), root: outline[0], tip: outline[2], outline, confidence: 1.0 };
        let halves = Halves::of(&blade).expect("a kite has two halves");
        let areas = [&halves.right, &halves.left].map(|half| Halves::side_area(half) * 80.0 * 80.0);
        assert!(
            (areas[0] - 1200.0).abs() < 1.0,
            "up on the picture lies to the right of a tip to the left: {areas:?}"
        );
        assert!((areas[1] - 1600.0).abs() < 1.0, "{areas:?}");
        let (ring, tip) = halves.joined();
        assert_eq!((ring[0], ring[tip]), (Vec2::ZERO, Vec2::Y), "root first");
        assert!((twice_area(&ring).abs() / 2.0 * 6400.0 - 2800.0).abs() < 1.0, "nothing is lost");
    }
}
