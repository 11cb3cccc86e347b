// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Antialiased polygon coverage on a texel grid.

use glam::Vec2;

use crate::math::floor_i32;

/// Scan lines in a row of texels; along the row coverage is exact.
const SUBROWS: u16 = 8;

/// Maps leaf coordinates (y up) to texels (y down, texel centres at halves).
#[derive(Clone, Copy, Debug)]
pub(crate) struct Frame {
    /// Texels in one leaf unit.
    pub(crate) scale: f32,
    /// Texel position of the leaf's origin.
    pub(crate) origin: Vec2,
    /// Width and height of the grid in texels.
    pub(crate) size: usize,
}

impl Frame {
    /// Square frame of `size` texels around the points with a margin in texels.
    pub(crate) fn around(points: impl Iterator<Item = Vec2>, size: usize, margin: f32) -> Self {
        let (low, high) = points.fold((Vec2::MAX, Vec2::MIN), |(low, high), p| (low.min(p), high.max(p)));
        let scale = (size as f32 - 2.0 * margin) / (high - low).max_element();
        let middle = (low + high) / 2.0;
        let half = Vec2::splat(size as f32 / 2.0);
        Self { scale, origin: half - Vec2::new(middle.x, -middle.y) * scale, size }
    }

    /// Leaf point to texels.
    pub(crate) fn to_texel(self, p: Vec2) -> Vec2 {
        self.origin + Vec2::new(p.x, -p.y) * self.scale
    }

    /// Texels to a leaf point.
    pub(crate) fn to_leaf(self, texel: Vec2) -> Vec2 {
        let p = (texel - self.origin) / self.scale;
        Vec2::new(p.x, -p.y)
    }

    /// Leaf point at the centre of a texel.
    pub(crate) fn texel_centre(self, x: usize, y: usize) -> Vec2 {
        self.to_leaf(Vec2::new(x as f32 + 0.5, y as f32 + 0.5))
    }
}

/// Index of the first texel that starts at or after `x`, within the grid.
fn clamped_index(x: f32, size: usize) -> usize {
    usize::try_from(floor_i32(x)).unwrap_or(0).min(size)
}

/// Share of each texel that the union of counter-clockwise polygons covers (non-zero winding), row by row.
pub(crate) fn coverage(polygons: &[&[Vec2]], frame: Frame) -> Vec<f32> {
    let size = frame.size;
    let edges: Vec<(Vec2, Vec2)> = polygons
        .iter()
        .flat_map(|polygon| {
            let next = polygon.iter().cycle().skip(1);
            polygon.iter().zip(next).map(|(a, b)| (frame.to_texel(*a), frame.to_texel(*b)))
        })
        .filter(|(a, b)| a.y != b.y)
        .collect();
    let subrows = size * usize::from(SUBROWS);
    let line_of = |y: f32| y * f32::from(SUBROWS) - 0.5;
    let mut crossings: Vec<Vec<(f32, i32)>> = vec![Vec::new(); subrows];
    for (a, b) in edges {
        let winding = if a.y < b.y { 1 } else { -1 };
        let (top, bottom) = if a.y < b.y { (a, b) } else { (b, a) };
        let first = clamped_index(line_of(top.y).ceil(), subrows);
        let end = clamped_index(line_of(bottom.y).ceil(), subrows);
        for (line, row) in crossings.iter_mut().enumerate().take(end).skip(first) {
            let y = (line as f32 + 0.5) / f32::from(SUBROWS);
            row.push((top.x + (bottom.x - top.x) * (y - top.y) / (bottom.y - top.y), winding));
        }
    }
    let mut out = vec![0.0; size * size];
    for (line, row) in crossings.iter_mut().enumerate() {
        row.sort_by(|a, b| a.0.total_cmp(&b.0));
        let start = line / usize::from(SUBROWS) * size;
        let texels = &mut out[start..start + size];
        let mut winding = 0;
        for pair in row.windows(2) {
            winding += pair[0].1;
            if winding != 0 {
                add_span(texels, pair[0].0, pair[1].0, 1.0 / f32::from(SUBROWS));
            }
        }
    }
    for value in &mut out {
        *value = value.min(1.0);
    }
    out
}

/// Adds a span of a scan line to the texels it touches.
fn add_span(texels: &mut [f32], from: f32, to: f32, weight: f32) {
    let size = texels.len();
    let (from, to) = (from.clamp(0.0, size as f32), to.clamp(0.0, size as f32));
    let (first, last) = (clamped_index(from, size), clamped_index(to.ceil(), size));
    for (x, texel) in texels.iter_mut().enumerate().take(last).skip(first) {
        let overlap = to.min(x as f32 + 1.0) - from.max(x as f32);
        *texel += overlap.max(0.0) * weight;
    }
}

/// Polygon around a path with a radius at each point, counter-clockwise in leaf coordinates.
pub(crate) fn stroke(path: &[(Vec2, f32)]) -> Vec<Vec2> {
    let normal = |i: usize| {
        let (before, after) = (path[i.saturating_sub(1)].0, path[(i + 1).min(path.len() - 1)].0);
        (after - before).normalize_or(Vec2::Y).perp()
    };
    let right = path.iter().enumerate().map(|(i, &(p, radius))| p - normal(i) * radius);
    let left = path.iter().enumerate().map(|(i, &(p, radius))| p + normal(i) * radius);
    right.chain(left.rev()).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn coverage_sums_to_the_area() {
        let triangle = [Vec2::new(-0.9, -0.8), Vec2::new(0.8, -0.7), Vec2::new(0.1, 0.9)];
        let frame = Frame::around(triangle.iter().copied(), 64, 3.0);
        let area = (triangle[1] - triangle[0]).perp_dot(triangle[2] - triangle[0]) / 2.0;
        let sum: f32 = coverage(&[&triangle], frame).iter().sum();
        let expected = area * frame.scale * frame.scale;
        assert!((sum - expected).abs() < expected * 0.003, "covered {sum} texels, area is {expected}");
    }

    #[test]
    fn overlap_counts_once() {
        let square = [Vec2::ZERO, Vec2::X, Vec2::ONE, Vec2::Y];
        let frame = Frame::around(square.iter().copied(), 16, 0.0);
        let covered = coverage(&[&square, &square], frame);
        assert!(covered.iter().all(|c| (c - 1.0).abs() < 1e-5), "two equal squares cover every texel once");
    }

    #[test]
    fn strokes_wind_like_blades() {
        let polygon = stroke(&[(Vec2::ZERO, 0.1), (Vec2::Y, 0.1)]);
        let next = polygon.iter().cycle().skip(1);
        let area: f32 = polygon.iter().zip(next).map(|(a, b)| a.perp_dot(*b)).sum::<f32>() / 2.0;
        assert!((area - 0.2).abs() < 1e-5, "a stroke of width 0.2 and length 1, got {area}");
    }
}
