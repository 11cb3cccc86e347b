// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! From a mask to a polygon: pixel contour, line filter, Ramer-Douglas-Peucker.

use glam::Vec2;

use crate::Mask;
use crate::math::segment_distance;

/// Greatest distance that the polygon may keep from the filtered contour, in √A.
const TOLERANCE: f32 = 0.004;

/// Outline of a connected mask without its holes: a simple closed polygon, counter-clockwise with y up. Empty for
/// an empty mask.
pub(crate) fn outline(mask: &Mask) -> Vec<Vec2> {
    let contour = contour(mask);
    let filtered = straighten(&straighten(&contour));
    let mut tolerance = TOLERANCE * (mask.area() as f32).sqrt();
    for _ in 0..4 {
        let polygon = simplify_closed(&filtered, tolerance);
        if polygon.len() >= 3 && !crosses_itself(&polygon) {
            return counter_clockwise(polygon);
        }
        tolerance *= 0.5;
    }
    // The contour itself never crosses: it passes through the middles of different pixel sides.
    counter_clockwise(contour)
}

/// Middles of the pixel sides between inside and outside, in order around the piece that holds the first pixel.
pub(crate) fn contour(mask: &Mask) -> Vec<Vec2> {
    let Some(first) = mask.inside.iter().position(|inside| *inside) else { return Vec::new() };
    // East, south, west, north: a step, and the pixels ahead to its right and left as seen from a pixel corner.
    const STEP: [(i32, i32); 4] = [(1, 0), (0, 1), (-1, 0), (0, -1)];
    const RIGHT: [(i32, i32); 4] = [(0, 0), (-1, 0), (-1, -1), (0, -1)];
    const LEFT: [(i32, i32); 4] = [(0, -1), (0, 0), (-1, 0), (-1, -1)];
    let width = mask.width as usize;
    let grid = |value: usize| i32::try_from(value).unwrap_or(i32::MAX);
    let start = (grid(first % width), grid(first / width));
    let ((mut x, mut y), mut heading) = (start, 0);
    let mut middles = Vec::new();
    loop {
        let (dx, dy) = STEP[heading];
        middles.push(Vec2::new(x as f32 + 0.5 * dx as f32, y as f32 + 0.5 * dy as f32));
        (x, y) = (x + dx, y + dy);
        let ahead = |side: [(i32, i32); 4]| mask.contains(x + side[heading].0, y + side[heading].1);
        // Turning right first keeps pixels apart that touch at a corner only.
        if !ahead(RIGHT) {
            heading = (heading + 1) % 4;
        } else if ahead(LEFT) {
            heading = (heading + 3) % 4;
        }
        if (x, y) == start && heading == 0 {
            return middles;
        }
    }
}

/// Line filter: every point moves half way to the middle of its neighbours, which turns stairs into lines.
fn straighten(points: &[Vec2]) -> Vec<Vec2> {
    let count = points.len();
    let at = |i: usize| points[i % count];
    (0..count).map(|i| (at(i + count - 1) + at(i) * 2.0 + at(i + 1)) / 4.0).collect()
}

/// Ramer-Douglas-Peucker on a closed polygon, split at two points far apart.
pub(crate) fn simplify_closed(points: &[Vec2], tolerance: f32) -> Vec<Vec2> {
    if points.len() < 4 {
        return points.to_vec();
    }
    let farthest = |from: Vec2| {
        let distance = |i: &usize| points[*i].distance_squared(from);
        (0..points.len()).max_by(|a, b| distance(a).total_cmp(&distance(b))).unwrap_or(0)
    };
    let a = farthest(points[0]);
    let b = farthest(points[a]);
    let (a, b) = (a.min(b), a.max(b));
    let mut ring = points.to_vec();
    ring.rotate_left(a);
    ring.push(ring[0]);
    let middle = b - a;
    let mut keep = vec![false; ring.len()];
    keep[0] = true;
    keep[middle] = true;
    let mut open = vec![(0, middle), (middle, ring.len() - 1)];
    while let Some((from, to)) = open.pop() {
        let distance = |i: usize| segment_distance(ring[i], ring[from], ring[to]).0;
        let Some(split) = (from + 1..to).max_by(|a, b| distance(*a).total_cmp(&distance(*b))) else {
            continue;
        };
        if distance(split) > tolerance {
            keep[split] = true;
            open.extend([(from, split), (split, to)]);
        }
    }
    ring.into_iter().zip(keep).filter_map(|(point, keep)| keep.then_some(point)).collect()
}

/// Twice the area of a polygon, positive if it runs clockwise on the screen (y down).
pub(crate) fn twice_area(polygon: &[Vec2]) -> f32 {
    let next = polygon.iter().cycle().skip(1);
    polygon.iter().zip(next).map(|(a, b)| a.perp_dot(*b)).sum()
}

/// Turns a polygon round if it runs clockwise as seen with y up.
pub(crate) fn counter_clockwise(mut polygon: Vec<Vec2>) -> Vec<Vec2> {
    if twice_area(&polygon) > 0.0 {
        polygon.reverse();
    }
    polygon
}

/// Returns true if two sides of a closed polygon that are not neighbours meet.
pub(crate) fn crosses_itself(polygon: &[Vec2]) -> bool {
    let count = polygon.len();
    let side = |i: usize| (polygon[i], polygon[(i + 1) % count]);
    let mut order: Vec<usize> = (0..count).collect();
    let left = |i: usize| side(i).0.x.min(side(i).1.x);
    let right = |i: usize| side(i).0.x.max(side(i).1.x);
    order.sort_by(|a, b| left(*a).total_cmp(&left(*b)));
    order.iter().enumerate().any(|(rank, &i)| {
        let near = order[rank + 1..].iter().take_while(|j| left(**j) <= right(i));
        let neighbours = |j: usize| (i + 1) % count == j || (j + 1) % count == i;
        near.into_iter().any(|&j| !neighbours(j) && segments_meet(side(i), side(j)))
    })
}

/// Returns true if two closed segments share a point.
pub(crate) fn segments_meet(first: (Vec2, Vec2), second: (Vec2, Vec2)) -> bool {
    let side = |(a, b): (Vec2, Vec2), p: Vec2| {
        let value = (b - a).as_dvec2().perp_dot((p - a).as_dvec2());
        if value == 0.0 { 0 } else { if value > 0.0 { 1 } else { -1 } }
    };
    let on = |(a, b): (Vec2, Vec2), p: Vec2| {
        side((a, b), p) == 0 && p.cmpge(a.min(b)).all() && p.cmple(a.max(b)).all()
    };
    let split = |a, b: (Vec2, Vec2)| side(a, b.0) * side(a, b.1) < 0;
    (split(first, second) && split(second, first))
        || on(first, second.0)
        || on(first, second.1)
        || on(second, first.0)
        || on(second, first.1)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn disc(radius: f32) -> Mask {
        let mut mask = Mask::empty(101, 101);
        for (i, inside) in mask.inside.iter_mut().enumerate() {
            let p = Vec2::new((i % 101) as f32 + 0.5, (i / 101) as f32 + 0.5);
            *inside = p.distance(Vec2::splat(50.5)) <= radius;
        }
        mask
    }

    #[test]
    fn outline_of_a_disc_is_round_simple_and_counter_clockwise() {
        let mask = disc(40.0);
        let polygon = outline(&mask);
        assert!((12..=80).contains(&polygon.len()), "{} corners for a circle", polygon.len());
        assert!(
            polygon.iter().all(|p| (p.distance(Vec2::splat(50.5)) - 40.0).abs() < 1.0),
            "near the circle"
        );
        assert!(!crosses_itself(&polygon), "a circle does not cross itself");
        let area = -twice_area(&polygon) / 2.0;
        assert!((area - mask.area() as f32).abs() < 0.02 * area, "{area} against {} pixels", mask.area());
    }

    #[test]
    fn one_pixel_has_a_diamond_around_it() {
        let mut mask = Mask::empty(3, 3);
        mask.inside[4] = true;
        assert_eq!(outline(&mask).len(), 4, "four sides");
        assert!(outline(&Mask::empty(3, 3)).is_empty(), "nothing to surround");
    }

    #[test]
    fn simplification_keeps_corners_and_its_distance() {
        let square: Vec<Vec2> = (0..40)
            .map(|i| {
                let along = (i % 10) as f32;
                match i / 10 {
                    0 => Vec2::new(along, 0.0),
                    1 => Vec2::new(10.0, along),
                    2 => Vec2::new(10.0 - along, 10.0),
                    _ => Vec2::new(0.0, 10.0 - along),
                }
            })
            .collect();
        assert_eq!(simplify_closed(&square, 0.1).len(), 4, "the corners of a square");
    }

    #[test]
    fn bow_ties_cross_and_squares_do_not() {
        let square = [Vec2::ZERO, Vec2::X, Vec2::ONE, Vec2::Y];
        assert!(!crosses_itself(&square), "square");
        assert!(crosses_itself(&[square[0], square[2], square[1], square[3]]), "bow tie");
    }
}
