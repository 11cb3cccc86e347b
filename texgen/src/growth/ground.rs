// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! A blade as growers use it: membership, distance to the margin, lines of sight.

use glam::{IVec2, Vec2};

use crate::math::floor_i32;
use crate::{Blade, TexgenError, distance};

/// Fewest pixels that can hold a vein.
const LEAST_AREA: usize = 24;

/// The connected part of a blade that holds its root.
pub(crate) struct Ground {
    size: usize,
    /// Distance from each pixel of a square grid to the nearest pixel outside; zero outside.
    room: Vec<f32>,
    /// Root, moved to the nearest pixel inside.
    pub(crate) root: Vec2,
    /// Tip, moved to the nearest pixel inside.
    pub(crate) tip: Vec2,
    /// √A in pixels, the unit of every length.
    pub(crate) unit: f32,
}

impl Ground {
    /// Surveys a blade.
    ///
    /// # Errors
    /// [`TexgenError::NoRoom`] when the part around the root is too small or the margin is no polygon.
    pub(crate) fn survey(blade: &Blade) -> Result<Self, TexgenError> {
        let refuse = |reason: String| Err(TexgenError::NoRoom { reason });
        if blade.outline.len() < 3 || !blade.outline.iter().all(|p| p.is_finite()) {
            return refuse(format!("outline has {} points, at least 3 finite ones", blade.outline.len()));
        }
        if !blade.root.is_finite() || !blade.tip.is_finite() {
            return refuse(format!("root {} and tip {} must be finite", blade.root, blade.tip));
        }
        let mask = &blade.mask;
        let (width, height) = (mask.width as usize, mask.height as usize);
        if mask.inside.len() != width * height {
            return refuse(format!("mask holds {} pixels, not {width} × {height}", mask.inside.len()));
        }
        let Some(start) = nearest_inside(&mask.inside, width, blade.root) else {
            return refuse("mask has no pixel inside".into());
        };
        let part = connected(&mask.inside, width, start);
        let area = part.iter().filter(|inside| **inside).count();
        if area < LEAST_AREA {
            return refuse(format!("blade has {area} pixels around its root, at least {LEAST_AREA}"));
        }
        // A frame of outside pixels makes the picture's border a margin too.
        let size = width.max(height) + 2;
        let outside = |i: usize| {
            let (x, y) = (i % size, i / size);
            x == 0 || y == 0 || x > width || y > height || !part[(y - 1) * width + x - 1]
        };
        let room = distance::to_seeds(size, outside);
        let centre = |i: usize| Vec2::new((i % width) as f32 + 0.5, (i / width) as f32 + 0.5);
        let tip = nearest_inside(&part, width, blade.tip).map_or(blade.tip, centre);
        #[expect(clippy::cast_precision_loss, reason = "areas of pictures lose nothing that matters")]
        let unit = (area as f32).sqrt();
        let mut ground = Self { size, room, root: centre(start), tip, unit };
        for (end, wanted) in [(true, blade.root), (false, blade.tip)] {
            if ground.contains(wanted) {
                if end { ground.root = wanted } else { ground.tip = wanted }
            }
        }
        ground.free_root();
        Ok(ground)
    }

    /// Moves a root that is hemmed in by outside pixels a little way in: drawn bases may be narrower than a pixel.
    fn free_root(&mut self) {
        const ROOMY: f32 = 1.5;
        let farthest = floor_i32((0.03 * self.unit).max(3.0));
        if self.room(self.root) > ROOMY {
            return;
        }
        let mut nearest: Option<(f32, Vec2)> = None;
        for y in -farthest..=farthest {
            for x in -farthest..=farthest {
                let cell =
                    Vec2::new(self.root.x.floor() + x as f32 + 0.5, self.root.y.floor() + y as f32 + 0.5);
                let far = cell.distance_squared(self.root);
                if self.room(cell) > ROOMY && nearest.is_none_or(|(least, _)| far < least) {
                    nearest = Some((far, cell));
                }
            }
        }
        if let Some((_, cell)) = nearest {
            self.root = cell;
        }
    }

    /// Distance in pixels from a point's pixel to the nearest one outside; zero outside.
    pub(crate) fn room(&self, p: Vec2) -> f32 {
        let cell = IVec2::new(floor_i32(p.x) + 1, floor_i32(p.y) + 1);
        match (usize::try_from(cell.x), usize::try_from(cell.y)) {
            (Ok(x), Ok(y)) if x < self.size && y < self.size => self.room[y * self.size + x],
            _ => 0.0,
        }
    }

    /// Returns true if a point lies inside.
    pub(crate) fn contains(&self, p: Vec2) -> bool {
        self.room(p) > 0.0
    }

    /// Returns true if the straight line between two points stays inside; the same either way round.
    pub(crate) fn sees(&self, one: Vec2, other: Vec2) -> bool {
        let ordered = (one.x, one.y) <= (other.x, other.y);
        let (from, to) = if ordered { (one, other) } else { (other, one) };
        let length = from.distance(to);
        let direction = (to - from).normalize_or_zero();
        let mut at = 0.0;
        while at < length {
            let room = self.room(from + direction * at);
            if room <= 0.0 {
                return false;
            }
            // A pixel's room counts from its centre, and the point may lie in its corner.
            at += (room - 1.5).max(0.5);
        }
        self.contains(to)
    }

    /// Last point inside on the way from one point towards another, `None` when the first is outside.
    pub(crate) fn reach(&self, from: Vec2, direction: Vec2, longest: f32) -> Option<Vec2> {
        let mut last = None;
        let mut at = 0.0;
        while at <= longest {
            let p = from + direction * at;
            let room = self.room(p);
            if room <= 0.0 {
                break;
            }
            last = Some(p);
            at += (room - 1.5).max(0.5);
        }
        last
    }

    /// The same point if it is inside, otherwise the first one inside on the way towards `anchor`.
    pub(crate) fn pull_in(&self, p: Vec2, anchor: Vec2, farthest: f32) -> Option<Vec2> {
        let direction = (anchor - p).normalize_or_zero();
        let mut at = 0.0;
        while at <= farthest {
            let moved = p + direction * at;
            if self.contains(moved) {
                return Some(moved);
            }
            at += 0.5;
        }
        None
    }

    /// Width of the square of pixels that holds the blade.
    pub(crate) fn extent(&self) -> f32 {
        self.size as f32
    }
}

/// Index of the inside pixel nearest to a point; the first one in reading order on a tie.
fn nearest_inside(inside: &[bool], width: usize, p: Vec2) -> Option<usize> {
    let far = |i: usize| p.distance_squared(Vec2::new((i % width) as f32 + 0.5, (i / width) as f32 + 0.5));
    (0..inside.len()).filter(|&i| inside[i]).min_by(|&a, &b| far(a).total_cmp(&far(b)))
}

/// Pixels that hang together with one by their edges.
fn connected(inside: &[bool], width: usize, start: usize) -> Vec<bool> {
    let mut part = vec![false; inside.len()];
    part[start] = true;
    let mut stack = vec![start];
    while let Some(i) = stack.pop() {
        let x = i % width;
        let sides = [
            (x > 0).then(|| i - 1),
            (x + 1 < width).then_some(i + 1),
            i.checked_sub(width),
            Some(i + width).filter(|&below| below < inside.len()),
        ];
        for next in sides.into_iter().flatten() {
            if inside[next] && !part[next] {
                part[next] = true;
                stack.push(next);
            }
        }
    }
    part
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Mask;

    fn blade(rows: &[&str]) -> Blade {
        let width = rows[0].len();
        let inside = rows.iter().flat_map(|row| row.bytes().map(|b| b == b'#')).collect();
        let side = |x: usize| u32::try_from(x).expect("a small mask");
        let mask = Mask { width: side(width), height: side(rows.len()), inside };
        let outline = vec![Vec2::ZERO, Vec2::X, Vec2::Y];
        Blade { mask, outline, root: Vec2::new(1.5, 1.5), tip: Vec2::new(8.0, 1.0), confidence: 1.0 }
    }

    #[test]
    fn only_the_part_around_the_root_counts() {
        let row = "########.####";
        let ground = Ground::survey(&blade(&[row; 6])).expect("48 pixels hang together");
        assert!(ground.contains(Vec2::new(7.5, 3.5)), "part of the root");
        assert!(!ground.contains(Vec2::new(10.5, 3.5)), "an island is left out");
        assert!((ground.unit - 48.0_f32.sqrt()).abs() < 1e-3, "unit is the part's, got {}", ground.unit);
    }

    #[test]
    fn walls_hide() {
        let ground = Ground::survey(&blade(&["####.######", "####.######", "####.######", "###########"]))
            .expect("one part");
        assert!(!ground.sees(Vec2::new(1.5, 0.5), Vec2::new(8.5, 0.5)), "a wall stands between");
        assert!(ground.sees(Vec2::new(1.5, 3.5), Vec2::new(8.5, 3.5)), "the gap below is open");
    }

    #[test]
    fn tiny_blades_are_refused() {
        let refused = Ground::survey(&blade(&["###", "###"]));
        assert!(matches!(refused, Err(TexgenError::NoRoom { .. })), "six pixels are too few");
    }
}
