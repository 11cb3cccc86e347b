// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Regions between veins: a watershed from markers (Meyer 1991) over the distance to the veins.

use std::collections::{BTreeMap, VecDeque};

use crate::plane::Plane;

/// Label of pixels outside the blade.
pub(crate) const OUTSIDE: u32 = u32::MAX;
/// Veins are widened by this share of √A before what lies between them is taken apart.
const WIDENED: f32 = 0.01;
/// Markers are shrunk by this share of √A.
const SHRUNK: f32 = 0.006;
/// Smaller regions, as shares of A, join a neighbour.
const SMALLEST: f32 = 0.004;
/// Steps of height in one √A.
const HEIGHT_STEPS: f32 = 1024.0;

/// Splits a blade at its veins. `vein` holds the distance to the nearest vein and `margin` that to the margin, both in
/// pixels; `unit` is √A. Returns a label for each pixel and the number of labels, at least one for any blade.
pub(crate) fn regions(inside: &Plane<bool>, vein: &[f32], margin: &[f32], unit: f32) -> (Plane<u32>, usize) {
    let between = |i: usize| inside.data[i] && vein[i] > (WIDENED * unit).max(0.8);
    let parts = components(inside, between);
    let mut label: Plane<u32> = Plane::filled(inside.width, inside.height, OUTSIDE);
    let deep = |i: usize| vein[i].min(margin[i]) > (WIDENED + SHRUNK) * unit;
    for (i, &part) in parts.data.iter().enumerate() {
        if part != OUTSIDE && deep(i) {
            label.data[i] = part;
        }
    }
    let next = parts.data.iter().filter(|&&part| part != OUTSIDE).max().map_or(0, |&part| part + 1);
    if label.data.iter().all(|&label| label == OUTSIDE) {
        // Nothing is left between the veins: the blade is one region.
        if let Some(seed) = inside.data.iter().position(|&inside| inside) {
            label.data[seed] = next;
        }
    }
    flood(inside, vein, unit, &mut label);
    // Parts of a mask that no marker reaches.
    let stray = components(inside, |i| inside.data[i] && label.data[i] == OUTSIDE);
    for (slot, &part) in label.data.iter_mut().zip(&stray.data) {
        if part != OUTSIDE {
            *slot = next + 1 + part;
        }
    }
    merge_small(inside, &mut label);
    let count = renumber(&mut label);
    (label, count)
}

/// Numbers the 4-connected parts of the pixels that `is_part` accepts.
pub(crate) fn components(grid: &Plane<bool>, is_part: impl Fn(usize) -> bool) -> Plane<u32> {
    let mut label = Plane::filled(grid.width, grid.height, OUTSIDE);
    let mut count = 0;
    let mut stack = Vec::new();
    for start in 0..label.data.len() {
        if label.data[start] != OUTSIDE || !is_part(start) {
            continue;
        }
        label.data[start] = count;
        stack.push(start);
        while let Some(at) = stack.pop() {
            for next in grid.neighbours4(at) {
                if label.data[next] == OUTSIDE && is_part(next) {
                    label.data[next] = count;
                    stack.push(next);
                }
            }
        }
        count += 1;
    }
    label
}

/// Meyer's flooding: pixels are labelled in the order of (height, time of discovery), and no pixel rises above its
/// own height or that of its discoverer. A queue for each height keeps that order in linear time.
fn flood(inside: &Plane<bool>, vein: &[f32], unit: f32, label: &mut Plane<u32>) {
    let highest = vein.iter().zip(&inside.data).filter(|(_, inside)| **inside).map(|(d, _)| *d);
    let highest = highest.filter(|d| d.is_finite()).fold(0.0, f32::max);
    let height = |i: usize| {
        let steps = ((highest - vein[i].min(highest)) / unit * HEIGHT_STEPS).round();
        usize::try_from(crate::math::floor_i32(steps)).unwrap_or(0)
    };
    let levels = usize::try_from(crate::math::floor_i32(highest / unit * HEIGHT_STEPS)).unwrap_or(0) + 2;
    let mut queues: Vec<VecDeque<usize>> = vec![VecDeque::new(); levels];
    let mut queued: Vec<bool> = label.data.iter().map(|&label| label != OUTSIDE).collect();
    for at in 0..label.data.len() {
        if label.data[at] != OUTSIDE {
            for next in inside.neighbours4(at) {
                if inside.data[next] && !queued[next] {
                    queued[next] = true;
                    queues[height(next)].push_back(next);
                }
            }
        }
    }
    for level in 0..levels {
        while let Some(at) = queues[level].pop_front() {
            let lowest = inside.neighbours4(at).map(|next| label.data[next]).min();
            label.data[at] = lowest.unwrap_or(OUTSIDE);
            for next in inside.neighbours4(at) {
                if inside.data[next] && !queued[next] {
                    queued[next] = true;
                    queues[height(next).max(level)].push_back(next);
                }
            }
        }
    }
}

/// Gives every region that is too small to the neighbour with the longest common border.
fn merge_small(inside: &Plane<bool>, label: &mut Plane<u32>) {
    let area = inside.data.iter().filter(|inside| **inside).count();
    let smallest = SMALLEST * area as f32;
    loop {
        let mut sizes: BTreeMap<u32, usize> = BTreeMap::new();
        let mut borders: BTreeMap<u32, BTreeMap<u32, usize>> = BTreeMap::new();
        for (at, &own) in label.data.iter().enumerate().filter(|(_, label)| **label != OUTSIDE) {
            *sizes.entry(own).or_default() += 1;
            for next in inside.neighbours4(at) {
                let other = label.data[next];
                if other != OUTSIDE && other != own {
                    *borders.entry(own).or_default().entry(other).or_default() += 1;
                }
            }
        }
        let small = sizes
            .iter()
            .filter(|(label, size)| (**size as f32) < smallest && borders.contains_key(label))
            .min_by_key(|(label, size)| (**size, **label));
        let Some((&small, _)) = small else { break };
        let longest = borders[&small].iter().max_by_key(|(label, length)| (**length, u32::MAX - **label));
        let Some((&neighbour, _)) = longest else { break };
        for slot in label.data.iter_mut().filter(|slot| **slot == small) {
            *slot = neighbour;
        }
    }
}

/// Renumbers labels from zero in the order of their first pixels.
pub(crate) fn renumber(label: &mut Plane<u32>) -> usize {
    let labels = || label.data.iter().copied().filter(|label| *label != OUTSIDE);
    let mut names = vec![OUTSIDE; labels().max().map_or(0, |largest| largest as usize + 1)];
    let mut count = 0;
    for slot in label.data.iter_mut().filter(|slot| **slot != OUTSIDE) {
        let name = &mut names[*slot as usize];
        if *name == OUTSIDE {
            *name = count;
            count += 1;
        }
        *slot = *name;
    }
    count as usize
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::distance::nearest_seed;
    use proptest::prelude::{any, prop_assert, prop_assert_eq, proptest};

    #[test]
    fn a_cross_makes_four() {
        let inside = Plane::filled(61, 61, true);
        let (vein, _) = nearest_seed(61, 61, |i| i % 61 == 30 || i / 61 == 30);
        let margin = vec![100.0; 61 * 61];
        let (label, count) = regions(&inside, &vein.data, &margin, 61.0);
        assert_eq!(count, 4, "four quarters");
        let at = |x: usize, y: usize| label.data[y * 61 + x];
        let corners = [at(2, 2), at(58, 2), at(2, 58), at(58, 58)];
        assert!(corners.iter().enumerate().all(|(i, a)| !corners[..i].contains(a)), "{corners:?}");
        assert!(label.data.iter().all(|&label| label != OUTSIDE), "veins belong to a side too");
    }

    proptest! {
        #[test]
        fn every_pixel_of_any_mask_gets_a_region(
            width in 1_usize..20,
            height in 1_usize..20,
            bits in proptest::collection::vec(any::<u8>(), 400),
        ) {
            let count = width * height;
            let inside = Plane { width, height, data: (0..count).map(|i| bits[i] & 7 != 0).collect() };
            let (vein, _) = nearest_seed(width, height, |i| bits[i] > 230);
            let (margin, _) = nearest_seed(width, height, |i| !inside.data[i]);
            let area = inside.data.iter().filter(|inside| **inside).count();
            let (label, regions) = regions(&inside, &vein.data, &margin.data, (area.max(1) as f32).sqrt());
            for (label, inside) in label.data.iter().zip(&inside.data) {
                prop_assert_eq!(*label != OUTSIDE, *inside);
                prop_assert!(*label == OUTSIDE || (*label as usize) < regions);
            }
        }
    }
}
