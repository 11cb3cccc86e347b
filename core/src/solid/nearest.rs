// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Signed distance of a place from a closed surface: that of the nearest point, below zero inside.
//!
//! # Source
//! The sign by the normal of the face, edge or corner that is nearest, of which those of corners are weighted by angles: Bærentzen and
//! Aanæs, "Signed distance computation using the angle weighted pseudonormal", IEEE TVCG 11 (2005). Nearest points of triangles: Ericson,
//! "Real-Time Collision Detection" (2005), section 5.1.5.

use std::collections::HashMap;

use glam::DVec3;

use crate::surface::Surface;

/// Most triangles in a box that is not parted any more.
const FEW: usize = 4;

/// A surface with what it takes to find its nearest point.
pub(super) struct Nearest<'a> {
    surface: &'a Surface,
    faces: Vec<DVec3>,
    edges: HashMap<[u32; 2], DVec3>,
    corners: Vec<DVec3>,
    /// Triangles in the order of the boxes.
    order: Vec<u32>,
    boxes: Vec<Node>,
}

/// A box around some triangles.
struct Node {
    low_m: DVec3,
    high_m: DVec3,
    /// First of its triangles in the order, or of its two halves among the boxes.
    first: usize,
    /// Number of its triangles; 0 if it has halves.
    count: usize,
}

/// The part of a triangle that is nearest.
enum Feature {
    Face,
    Edge(usize, usize),
    Corner(usize),
}

impl<'a> Nearest<'a> {
    pub(super) fn of(surface: &'a Surface) -> Self {
        let unit = |[a, b, c]: [DVec3; 3]| (b - a).cross(c - a).normalize_or_zero();
        let faces: Vec<DVec3> = surface.faces().map(unit).collect();
        let mut edges: HashMap<[u32; 2], DVec3> = HashMap::new();
        let mut corners = vec![DVec3::ZERO; surface.corners_m().len()];
        for ((numbers, places), normal) in surface.triangles().iter().zip(surface.faces()).zip(&faces) {
            for at in 0..3 {
                let (next, last) = ((at + 1) % 3, (at + 2) % 3);
                *edges.entry(sorted(numbers[at], numbers[next])).or_default() += *normal;
                let [along, back] = [places[next] - places[at], places[last] - places[at]];
                let angle = libm::atan2(along.cross(back).length(), along.dot(back));
                corners[numbers[at] as usize] += angle * *normal;
            }
        }
        let mut order: Vec<u32> = (0..).take(faces.len()).collect();
        let middles: Vec<DVec3> = surface.faces().map(|[a, b, c]| (a + b + c) / 3.0).collect();
        let mut boxes = vec![Node { low_m: DVec3::ZERO, high_m: DVec3::ZERO, first: 0, count: faces.len() }];
        let mut next = 0;
        while next < boxes.len() {
            let (first, count) = (boxes[next].first, boxes[next].count);
            let own = &mut order[first..first + count];
            let triangle = |&number: &u32| surface.triangles()[number as usize];
            let places = || own.iter().flat_map(triangle).map(|at| surface.corners_m()[at as usize]);
            boxes[next].low_m = places().fold(DVec3::INFINITY, DVec3::min);
            boxes[next].high_m = places().fold(DVec3::NEG_INFINITY, DVec3::max);
            if count > FEW {
                let size = boxes[next].high_m - boxes[next].low_m;
                let axis = (0..3).fold(0, |most, axis| if size[axis] > size[most] { axis } else { most });
                own.sort_by(|&a, &b| middles[a as usize][axis].total_cmp(&middles[b as usize][axis]));
                let halves = boxes.len();
                for (first, count) in [(first, count / 2), (first + count / 2, count - count / 2)] {
                    boxes.push(Node { low_m: DVec3::ZERO, high_m: DVec3::ZERO, first, count });
                }
                (boxes[next].first, boxes[next].count) = (halves, 0);
            }
            next += 1;
        }
        Self { surface, faces, edges, corners, order, boxes }
    }

    /// Signed distance of a place in m. The surface must be within `reach_m` of it, infinity if that is not known.
    pub(super) fn distance_m(&self, place: DVec3, reach_m: f64) -> f64 {
        // A little more, so that rounding does not hide what is exactly as far.
        let mut least_m2 = reach_m * reach_m * (1.0 + 1e-9);
        let mut side = 0.0;
        let mut waiting = vec![0];
        while let Some(number) = waiting.pop() {
            let node = &self.boxes[number];
            if node.away_m2(place) > least_m2 {
                continue;
            }
            if node.count == 0 {
                let [near, far] = [node.first, node.first + 1];
                let is_swapped = self.boxes[far].away_m2(place) < self.boxes[near].away_m2(place);
                waiting.extend(if is_swapped { [near, far] } else { [far, near] });
                continue;
            }
            for &triangle in &self.order[node.first..node.first + node.count] {
                let numbers = self.surface.triangles()[triangle as usize];
                let places = numbers.map(|at| self.surface.corners_m()[at as usize]);
                let (point, feature) = nearest_of(places, place);
                let away = place - point;
                if away.length_squared() < least_m2 {
                    least_m2 = away.length_squared();
                    side = away.dot(match feature {
                        Feature::Face => self.faces[triangle as usize],
                        Feature::Edge(a, b) => self.edges[&sorted(numbers[a], numbers[b])],
                        Feature::Corner(at) => self.corners[numbers[at] as usize],
                    });
                }
            }
        }
        libm::copysign(libm::sqrt(least_m2), side)
    }
}

impl Node {
    /// Square of the distance of a place from the box in m².
    fn away_m2(&self, place: DVec3) -> f64 {
        (place - place.clamp(self.low_m, self.high_m)).length_squared()
    }
}

fn sorted(a: u32, b: u32) -> [u32; 2] {
    [a.min(b), a.max(b)]
}

/// Nearest point of a triangle.
fn nearest_of([a, b, c]: [DVec3; 3], place: DVec3) -> (DVec3, Feature) {
    let (ab, ac) = (b - a, c - a);
    let [from_a, from_b, from_c] = [place - a, place - b, place - c];
    let (ab_a, ac_a) = (ab.dot(from_a), ac.dot(from_a));
    if ab_a <= 0.0 && ac_a <= 0.0 {
        return (a, Feature::Corner(0));
    }
    let (ab_b, ac_b) = (ab.dot(from_b), ac.dot(from_b));
    if ab_b >= 0.0 && ac_b <= ab_b {
        return (b, Feature::Corner(1));
    }
    let of_c = ab_a * ac_b - ab_b * ac_a;
    if of_c <= 0.0 && ab_a >= 0.0 && ab_b <= 0.0 {
        return (a + ab * (ab_a / (ab_a - ab_b)), Feature::Edge(0, 1));
    }
    let (ab_c, ac_c) = (ab.dot(from_c), ac.dot(from_c));
    if ac_c >= 0.0 && ab_c <= ac_c {
        return (c, Feature::Corner(2));
    }
    let of_b = ab_c * ac_a - ab_a * ac_c;
    if of_b <= 0.0 && ac_a >= 0.0 && ac_c <= 0.0 {
        return (a + ac * (ac_a / (ac_a - ac_c)), Feature::Edge(0, 2));
    }
    let of_a = ab_b * ac_c - ab_c * ac_b;
    let (toward_c, toward_b) = (ac_b - ab_b, ab_c - ac_c);
    if of_a <= 0.0 && toward_c >= 0.0 && toward_b >= 0.0 {
        return (b + (c - b) * (toward_c / (toward_c + toward_b)), Feature::Edge(1, 2));
    }
    let sum = of_a + of_b + of_c;
    (a + ab * (of_b / sum) + ac * (of_c / sum), Feature::Face)
}

#[cfg(test)]
mod tests {
    use glam::Vec3;

    use super::*;
    use crate::hull::Hull;

    fn around(corners_m: &[Vec3]) -> Surface {
        let hull = Hull::around(corners_m).expect("corners of a polyhedron");
        let corners_m: Vec<[f32; 3]> = corners_m.iter().map(Vec3::to_array).collect();
        Surface::new(&corners_m, &hull.triangles).expect("closed")
    }

    /// Distance from a box about the origin with these half edges.
    fn box_m(half_m: DVec3, place: DVec3) -> f64 {
        let beyond = place.abs() - half_m;
        beyond.max(DVec3::ZERO).length() + beyond.max_element().min(0.0)
    }

    #[test]
    fn a_box_has_its_distances() {
        let half = Vec3::new(0.5, 0.2, 0.3);
        let sign = |number: u8, bit: u8| if number & bit == 0 { -1.0 } else { 1.0 };
        let corners: Vec<Vec3> =
            (0..8).map(|at| half * Vec3::new(sign(at, 1), sign(at, 2), sign(at, 4))).collect();
        let surface = around(&corners);
        let nearest = Nearest::of(&surface);
        for number in 0..4096 {
            let digits = [number % 16, number / 16 % 16, number / 256].map(f64::from);
            let place = (DVec3::from(digits) - 7.3) * DVec3::new(0.11, 0.05, 0.07);
            let wanted = box_m(half.as_dvec3(), place);
            for reach_m in [f64::INFINITY, wanted.abs()] {
                let found = nearest.distance_m(place, reach_m);
                assert!((found - wanted).abs() < 1e-7, "{found} m of {wanted} m at {place}");
            }
        }
    }

    #[test]
    fn a_sharp_edge_has_one_inside() {
        // Beyond a corner sharper than a right angle, planes of faces far from the nearest would give the other side.
        let corners = [[0.0, 0.0, 0.0], [4.0, 0.2, 0.0], [4.0, -0.2, 0.1], [4.0, -0.2, -0.1]];
        let surface = around(&corners.map(Vec3::from));
        let nearest = Nearest::of(&surface);
        assert!(nearest.distance_m(DVec3::new(-0.1, 0.0, 0.0), f64::INFINITY) > 0.0, "before its tip");
        assert!(nearest.distance_m(DVec3::new(-0.1, 0.3, 0.0), f64::INFINITY) > 0.0, "above its tip");
        assert!(nearest.distance_m(DVec3::new(2.0, 0.0, 0.0), f64::INFINITY) < 0.0, "in it");
    }
}
