// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Pixels inside a polygon.

use glam::Vec2;

use crate::Mask;
use crate::math::floor_i32;

/// Pixels whose centres lie inside a closed polygon (even-odd rule).
pub(crate) fn fill(polygon: &[Vec2], width: u32, height: u32) -> Mask {
    let mut mask = Mask::empty(width, height);
    let mut crossings = Vec::new();
    for (y, row) in mask.inside.chunks_exact_mut((width as usize).max(1)).enumerate() {
        let level = y as f32 + 0.5;
        crossings.clear();
        for (a, b) in polygon.iter().zip(polygon.iter().cycle().skip(1)) {
            if (a.y <= level) != (b.y <= level) {
                crossings.push(a.x + (b.x - a.x) * ((level - a.y) / (b.y - a.y)));
            }
        }
        crossings.sort_by(f32::total_cmp);
        for pair in crossings.chunks_exact(2) {
            let column = |x: f32| usize::try_from(floor_i32(x + 0.5)).unwrap_or(0).min(row.len());
            let (from, to) = (column(pair[0]), column(pair[1]));
            row[from..to.max(from)].fill(true);
        }
    }
    mask
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn pixel_centres_decide() {
        let square = [Vec2::new(0.6, 0.6), Vec2::new(3.4, 0.6), Vec2::new(3.4, 2.4), Vec2::new(0.6, 2.4)];
        let mask = fill(&square, 5, 4);
        let found: Vec<usize> = (0..20).filter(|i| mask.inside[*i]).collect();
        assert_eq!(found, [6, 7], "columns 1 and 2 of row 1");
        assert_eq!(fill(&[], 3, 3).area(), 0, "nothing");
    }
}
