// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! One patch of the quilt: where its pixels come from, how well they fit, and how they are laid down.

use glam::Vec2;

use super::seam::{columns_cut, rows_cut};
use crate::lab::{self, Lab};
use crate::plane::Plane;

/// Pixels over which one patch fades into the next.
const FEATHER: f32 = 2.0;
/// Misfit of a pixel that has no source.
const NOTHING: f32 = 60.0;

/// Carries points of the target over to the example: origin, direction along and across the nearest vein.
#[derive(Clone, Copy, Debug)]
pub(super) struct Frame {
    pub(super) target: (Vec2, Vec2, Vec2),
    pub(super) source: (Vec2, Vec2, Vec2),
    /// Pixels of the example for a pixel of the target.
    pub(super) scale: f32,
}

impl Frame {
    /// The example's point for a point of the target.
    fn source(&self, p: Vec2) -> Vec2 {
        let (origin, along, across) = self.target;
        let offset = (p - origin) * self.scale;
        self.source.0 + self.source.1 * offset.dot(along) + self.source.2 * offset.dot(across)
    }
}

/// A square of the quilt.
#[derive(Clone, Copy, Debug)]
pub(super) struct Patch {
    pub(super) left: i32,
    pub(super) top: i32,
    pub(super) side: i32,
    pub(super) overlap: i32,
}

impl Patch {
    /// Pixels of the patch that lie on a plane: place within the patch and index.
    fn pixels(
        &self,
        width: usize,
        height: usize,
        step: i32,
    ) -> impl Iterator<Item = ((i32, i32), usize)> + use<> {
        let Self { left, top, side, .. } = *self;
        let count = usize::try_from(step).unwrap_or(1).max(1);
        (0..side).step_by(count).flat_map(move |y| (0..side).step_by(count).map(move |x| (x, y))).filter_map(
            move |(x, y)| {
                let column = usize::try_from(left + x).ok().filter(|&column| column < width)?;
                let row = usize::try_from(top + y).ok().filter(|&row| row < height)?;
                Some(((x, y), row * width + column))
            },
        )
    }

    /// The middle of what the patch covers of the blade, and what `find` knows of the pixel nearest to it.
    pub(super) fn anchor(
        &self,
        width: usize,
        height: usize,
        find: impl Fn(Vec2) -> Option<usize>,
    ) -> Option<(Vec2, usize)> {
        let point = |(x, y): (i32, i32)| Vec2::new((self.left + x) as f32 + 0.5, (self.top + y) as f32 + 0.5);
        let covered: Vec<(Vec2, usize)> = self
            .pixels(width, height, 2)
            .filter_map(|(place, _)| Some((point(place), find(point(place))?)))
            .collect();
        let middle = covered.iter().map(|(p, _)| *p).sum::<Vec2>() / covered.len().max(1) as f32;
        covered
            .into_iter()
            .min_by(|a, b| a.0.distance_squared(middle).total_cmp(&b.0.distance_squared(middle)))
    }

    /// Mean squared difference to what is there already.
    pub(super) fn misfit(&self, out: &Plane<Lab>, filled: &[bool], layer: &Plane<Lab>, frame: &Frame) -> f32 {
        let (mut sum, mut count) = (0.0, 0.0);
        for (place, at) in self.pixels(out.width, out.height, 2) {
            if filled[at] && (place.0 < self.overlap || place.1 < self.overlap) {
                let colour = match layer.index_of(frame.source(out.centre(at))) {
                    Some(source) => layer.data[source],
                    None => [0.0; 3],
                };
                sum += lab::distance_squared(colour, out.data[at]);
                count += 1.0;
            }
        }
        sum / f32::max(count, 1.0)
    }

    /// Mean of `gap` over a coarse grid of points and their sources; where it has no answer the worst is assumed.
    pub(super) fn displacement(&self, frame: &Frame, gap: impl Fn(Vec2, Vec2) -> Option<f32>) -> f32 {
        let (mut sum, mut count) = (0.0, 0.0);
        let step = (self.side / 4).max(1);
        for y in 0..4 {
            for x in 0..4 {
                let p = Vec2::new(
                    (self.left + x * step + step / 2) as f32,
                    (self.top + y * step + step / 2) as f32,
                );
                sum += gap(p, frame.source(p)).unwrap_or(NOTHING * 1e-5);
                count += 1.0;
            }
        }
        sum / count
    }

    /// Lays the patch down: old pixels stay beyond the seams.
    pub(super) fn lay(
        &self,
        out: &mut Plane<Lab>,
        filled: &mut [bool],
        layer: &Plane<Lab>,
        frame: &Frame,
        inside: &Plane<bool>,
    ) {
        let side = usize::try_from(self.side).unwrap_or(0);
        let overlap = usize::try_from(self.overlap).unwrap_or(0);
        let mut fresh: Vec<Option<Lab>> = vec![None; side * side];
        let mut gap = vec![0.0_f32; side * side];
        let place_of =
            |(x, y): (i32, i32)| usize::try_from(y).unwrap_or(0) * side + usize::try_from(x).unwrap_or(0);
        for (place, at) in self.pixels(out.width, out.height, 1) {
            let p = frame.source(out.centre(at));
            if layer.index_of(p).is_some_and(|source| inside.data[source]) {
                let colour = layer.sample_cubic(p);
                fresh[place_of(place)] = Some(colour);
                if filled[at] {
                    gap[place_of(place)] = lab::distance_squared(colour, out.data[at]);
                }
            }
        }
        let columns = columns_cut(&gap, side, overlap);
        let rows = rows_cut(&gap, side, overlap);
        for (place, at) in self.pixels(out.width, out.height, 1) {
            let Some(colour) = fresh[place_of(place)] else { continue };
            if !filled[at] {
                out.data[at] = colour;
                filled[at] = true;
                continue;
            }
            let (x, y) = (place.0 as f32, place.1 as f32);
            let beyond = |place: f32, cut: usize| ((place - cut as f32) / FEATHER + 0.5).clamp(0.0, 1.0);
            let row = usize::try_from(place.1).unwrap_or(0);
            let column = usize::try_from(place.0).unwrap_or(0);
            let share = beyond(x, columns[row]).min(beyond(y, rows[column]));
            // Two layers without relation lose contrast when they are mixed; this gives it back.
            let norm = 1.0 / (share * share + (1.0 - share) * (1.0 - share)).sqrt();
            let old = out.data[at];
            out.data[at] = std::array::from_fn(|i| (colour[i] * share + old[i] * (1.0 - share)) * norm);
        }
    }
}
