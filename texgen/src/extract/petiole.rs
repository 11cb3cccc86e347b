// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Separates the petiole from the blade.
//!
//! Opening the leaf with a disc removes all that is thinner than the disc. Of what was removed, the longest thin
//! piece is the petiole, unless it tapers to a point: then it is a drip tip.

use glam::Vec2;

use super::labels::{Pieces, side_neighbours};
use crate::Mask;
use crate::distance::nearest_seed;
use crate::field::quantile;

/// Radius of the opening, in √A.
const OPENING: f32 = 0.035;
/// Least length of a petiole (its box's diagonal), in √A.
const LENGTH: f32 = 0.15;
/// Least length of the stub that is left of a torn petiole, in √A.
const STUB: f32 = 0.04;
/// Greatest mean width of a petiole, in √A.
const WIDTH: f32 = 0.07;
/// A piece whose far third is thinner than this share of its near third is a tip that tapers.
const TAPER: f32 = 0.6;

/// A leaf's stalk.
#[derive(Clone, Debug)]
pub(crate) struct Petiole {
    /// Junction with the blade.
    pub(crate) junction: Vec2,
    /// Its far end.
    pub(crate) end: Vec2,
    /// Diagonal of its box.
    pub(crate) length: f32,
    /// Its pixels.
    pub(crate) pixels: Vec<usize>,
    /// Confidence that it is one, 0 to 1.
    pub(crate) confidence: f32,
}

impl Petiole {
    /// Returns true if it is long enough to be no other residue without more evidence; `side` is √A.
    pub(crate) fn is_long(&self, side: f32) -> bool {
        self.length > LENGTH * side
    }
}

/// Thin pieces of a connected mask that may be its petiole, the best first.
pub(crate) fn candidates(mask: &Mask) -> Vec<Petiole> {
    let (width, height) = (mask.width as usize, mask.height as usize);
    let side = (mask.area() as f32).sqrt();
    let depth = depth(mask);
    let (to_core, _) = nearest_seed(width, height, |i| depth[i] > OPENING * side);
    let opened = |i: usize| to_core.data[i] <= OPENING * side;
    let pieces = Pieces::find(width, height, |i| mask.inside[i] && !opened(i));
    let mut members = vec![Vec::new(); pieces.size.len()];
    for (i, label) in pieces.label.iter().enumerate().filter(|(_, label)| **label > 0) {
        members[*label as usize].push(i);
    }
    let measured =
        members.into_iter().filter_map(|pixels| measure(pixels, &depth, (width, height), side, opened));
    let mut found: Vec<Petiole> = measured.collect();
    found.sort_by(|a, b| (b.length * b.confidence).total_cmp(&(a.length * a.confidence)));
    found
}

/// Distance of each pixel's centre to the outside, the picture's surroundings included.
pub(crate) fn depth(mask: &Mask) -> Vec<f32> {
    let (width, height) = (mask.width as usize, mask.height as usize);
    let (padded, _) = nearest_seed(width + 2, height + 2, |i| {
        let (x, y) = (i % (width + 2), i / (width + 2));
        x == 0 || y == 0 || x > width || y > height || !mask.inside[(y - 1) * width + x - 1]
    });
    (0..width * height).map(|i| padded.data[(i / width + 1) * (width + 2) + i % width + 1]).collect()
}

/// Shape of a residue of the opening, if it could be a petiole.
fn measure(
    pixels: Vec<usize>,
    depth: &[f32],
    (width, height): (usize, usize),
    side: f32,
    opened: impl Fn(usize) -> bool,
) -> Option<Petiole> {
    let place = |i: usize| Vec2::new((i % width) as f32 + 0.5, (i / width) as f32 + 0.5);
    let first = place(*pixels.first()?);
    let (low, high) =
        pixels.iter().fold((first, first), |(low, high), i| (low.min(place(*i)), high.max(place(*i))));
    let length = low.distance(high) + 1.0;
    if length <= STUB * side || pixels.len() as f32 / length >= WIDTH * side {
        return None;
    }
    let contact: Vec<Vec2> = pixels
        .iter()
        .filter(|i| side_neighbours(**i, width, height).any(&opened))
        .map(|i| place(*i))
        .collect();
    if contact.is_empty() {
        return None;
    }
    let junction = contact.iter().sum::<Vec2>() / contact.len() as f32;
    let reach = |i: &usize| place(*i).distance(junction);
    let end = pixels.iter().max_by(|a, b| reach(a).total_cmp(&reach(b))).map(|i| place(*i))?;
    let span = end.distance(junction).max(1.0);
    let thickness = |from: f32, to: f32| {
        let third = pixels.iter().filter(|i| (from..to).contains(&(reach(i) / span)));
        // The ridge of the distance map: the deepest pixels stand for the half width.
        quantile(&mut third.map(|i| depth[*i]).collect::<Vec<f32>>(), 0.9)
    };
    let taper = thickness(0.6, 0.9) / thickness(0.15, 0.45).max(0.5);
    let confidence = 0.9 * ((taper - TAPER) / 0.25 + 0.6).clamp(0.0, 1.0);
    (confidence > 0.2).then_some(Petiole { junction, end, length, pixels, confidence })
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A disc of radius 40 with a bar (or a spike) of half width 2 below it.
    fn leaf(spike: bool) -> Mask {
        let mut mask = Mask::empty(120, 160);
        for (i, inside) in mask.inside.iter_mut().enumerate() {
            let p = Vec2::new((i % 120) as f32 + 0.5 - 60.0, (i / 120) as f32 + 0.5 - 60.0);
            let half = if spike { 2.5 * (100.0 - p.y) / 60.0 } else { 2.5 };
            *inside = p.length() < 40.0 || (p.x.abs() < half && (0.0..97.0).contains(&p.y));
        }
        mask
    }

    #[test]
    fn a_stalk_is_found_where_it_meets_the_blade() {
        let petiole = candidates(&leaf(false)).swap_remove(0);
        assert!(petiole.junction.distance(Vec2::new(60.0, 100.0)) < 4.0, "junction {}", petiole.junction);
        assert!(petiole.end.distance(Vec2::new(60.0, 157.0)) < 4.0, "end {}", petiole.end);
        assert!(petiole.confidence > 0.8, "{}", petiole.confidence);
    }

    #[test]
    fn a_drip_tip_is_no_stalk() {
        assert!(candidates(&leaf(true)).iter().all(|petiole| petiole.confidence < 0.6), "it tapers");
        assert!(candidates(&Mask::empty(4, 4)).is_empty(), "nothing has no stalk");
    }
}
