// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Distance of each pixel from the root when veins are fast roads (after Qian et al. 2019): Dijkstra's shortest ways
//! with a step into or within tissue dearer than one within a vein.

use crate::plane::Plane;

/// Length of a straight and of a diagonal step; 17/12 is √2 within 0.2 %.
const STEP: [u32; 2] = [12, 17];
/// Cost of a step from vein to vein, from vein to tissue, and from tissue to either.
const VEIN_TO_VEIN: u32 = 1;
const VEIN_TO_TISSUE: u32 = 4;
const FROM_TISSUE: u32 = 6;
/// More than the dearest step: distances wait in as many lists, used in turn (Dial 1969), so the work is linear.
const LISTS: usize = 128;

/// Structural distance from the root's pixel to every pixel of the blade, divided by the largest; 1 where no way
/// leads, 0 outside.
pub(crate) fn structural_distance(inside: &Plane<bool>, is_vein: &[bool], root: usize) -> Plane<f32> {
    const UNKNOWN: u32 = u32::MAX;
    let mut cost = vec![UNKNOWN; inside.data.len()];
    let mut lists: Vec<Vec<usize>> = vec![Vec::new(); LISTS];
    let mut waiting = 0_usize;
    if inside.data.get(root) == Some(&true) {
        cost[root] = 0;
        lists[0].push(root);
        waiting = 1;
    }
    let mut now = 0_u32;
    let mut farthest = 1;
    while waiting > 0 {
        let list = std::mem::take(&mut lists[now as usize % LISTS]);
        waiting -= list.len();
        for at in list {
            if cost[at] != now {
                continue;
            }
            farthest = farthest.max(now);
            for (next, diagonal) in neighbours8(inside, at) {
                let class = match (is_vein[at], is_vein[next]) {
                    (true, true) => VEIN_TO_VEIN,
                    (true, false) => VEIN_TO_TISSUE,
                    (false, _) => FROM_TISSUE,
                };
                let total = now + class * STEP[usize::from(diagonal)];
                if total < cost[next] {
                    cost[next] = total;
                    lists[total as usize % LISTS].push(next);
                    waiting += 1;
                }
            }
        }
        now += 1;
    }
    let value = |(&cost, &inside): (&u32, &bool)| match (inside, cost) {
        (false, _) => 0.0,
        (true, UNKNOWN) => 1.0,
        (true, cost) => cost as f32 / farthest as f32,
    };
    Plane {
        width: inside.width,
        height: inside.height,
        data: cost.iter().zip(&inside.data).map(value).collect(),
    }
}

/// Neighbours of a pixel that lie inside, with whether the step is diagonal.
fn neighbours8(inside: &Plane<bool>, at: usize) -> impl Iterator<Item = (usize, bool)> {
    let (x, y) = (at % inside.width, at / inside.width);
    let rows = y.saturating_sub(1)..=(y + 1).min(inside.height - 1);
    rows.flat_map(move |ny| {
        let columns = x.saturating_sub(1)..=(x + 1).min(inside.width - 1);
        columns.map(move |nx| (ny * inside.width + nx, nx != x && ny != y))
    })
    .filter(move |&(next, _)| next != at && inside.data[next])
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::{any, prop_assert, proptest};

    #[test]
    fn veins_are_fast_roads() {
        let inside = Plane::filled(21, 5, true);
        let is_vein: Vec<bool> = (0..105).map(|i| i / 21 == 2).collect();
        let distance = structural_distance(&inside, &is_vein, 42);
        let at = |x: usize, y: usize| distance.data[y * 21 + x];
        assert!(at(20, 2) < at(12, 0), "the far end of the vein is nearer than tissue beside its middle");
        assert!(at(10, 0) > at(10, 1) && at(10, 1) > at(10, 2), "tissue rises away from the vein");
        assert!((distance.data.iter().copied().fold(0.0, f32::max) - 1.0).abs() < 1e-6, "the largest is 1");
    }

    #[test]
    fn tissue_to_vein_costs_as_much_as_tissue_to_tissue() {
        let inside = Plane::filled(3, 1, true);
        let distance = structural_distance(&inside, &[false, true, false], 0);
        assert!((distance.data[1] - 0.6).abs() < 1e-6, "6 of 6 + 4: {}", distance.data[1]);
    }

    proptest! {
        #[test]
        fn any_mask_gets_numbers(
            width in 1_usize..16,
            height in 1_usize..16,
            bits in proptest::collection::vec(any::<u8>(), 256),
            root in 0_usize..256,
        ) {
            let count = width * height;
            let inside = Plane { width, height, data: (0..count).map(|i| bits[i] & 3 != 0).collect() };
            let veins: Vec<bool> = (0..count).map(|i| bits[i] > 200).collect();
            let distance = structural_distance(&inside, &veins, root);
            for (d, inside) in distance.data.iter().zip(&inside.data) {
                prop_assert!((0.0..=1.0).contains(d) && (*inside || *d == 0.0), "{d}");
            }
        }
    }
}
