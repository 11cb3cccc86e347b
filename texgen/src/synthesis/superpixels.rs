// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Superpixels inside a mask: SLIC (Achanta et al. 2012) that neither seeds nor measures outside the blade.

use std::collections::BTreeMap;
use std::ops::Range;

use glam::Vec2;

use super::regions::{OUTSIDE, renumber};
use crate::math::floor_i32;
use crate::plane::Plane;

/// Weight of nearness in the picture against likeness of features.
const COMPACTNESS: f32 = 10.0;
/// Rounds of assignment.
const ROUNDS: usize = 10;

/// Features of a pixel by which superpixels gather; scaled so that about 10 is a clear difference.
pub(crate) type Feature = [f32; 2];

/// A partition of a blade.
#[derive(Clone, Debug)]
pub(crate) struct Superpixels {
    /// Superpixel of each pixel, [`OUTSIDE`] off the blade.
    pub(crate) label: Plane<u32>,
    /// Number of superpixels.
    pub(crate) count: usize,
}

#[derive(Clone, Copy)]
struct Centre {
    at: Vec2,
    feature: Feature,
}

/// Splits the blade into about `wanted` superpixels.
pub(crate) fn superpixels(inside: &Plane<bool>, feature: &[Feature], wanted: usize) -> Superpixels {
    let area = inside.data.iter().filter(|inside| **inside).count();
    let step = (area as f32 / wanted.max(1) as f32).sqrt().max(1.0);
    let mut centres = seeds(inside, feature, step);
    let mut label: Plane<u32> = Plane::filled(inside.width, inside.height, OUTSIDE);
    let features = [0, 1].map(|i| feature.iter().map(|feature| feature[i]).collect::<Vec<_>>());
    let middles: Vec<f32> = (0..inside.width).map(|x| x as f32 + 0.5).collect();
    // Nothing is nearer to a pixel off the blade.
    let unreached: Vec<f32> =
        inside.data.iter().map(|&inside| if inside { f32::INFINITY } else { f32::NEG_INFINITY }).collect();
    let mut best = unreached.clone();
    let spread = (COMPACTNESS / step) * (COMPACTNESS / step);
    for _ in 0..ROUNDS {
        best.copy_from_slice(&unreached);
        for (number, centre) in (0_u32..).zip(&centres) {
            let (columns, rows) = window(inside, centre.at, step);
            for y in rows {
                let dy = y as f32 + 0.5 - centre.at.y;
                let row = y * inside.width + columns.start..y * inside.width + columns.end;
                let pixels = best[row.clone()].iter_mut().zip(&mut label.data[row.clone()]);
                let features = features[0][row.clone()].iter().zip(&features[1][row]);
                for (((best, label), (a, b)), middle) in pixels.zip(features).zip(&middles[columns.clone()]) {
                    let (dx, a, b) = (middle - centre.at.x, a - centre.feature[0], b - centre.feature[1]);
                    let distance = a * a + b * b + (dx * dx + dy * dy) * spread;
                    // Chosen by masks, which compilers do for several pixels at once.
                    let nearer = u32::from(distance < *best).wrapping_neg();
                    *best = f32::from_bits(distance.to_bits() & nearer | best.to_bits() & !nearer);
                    *label = number & nearer | *label & !nearer;
                }
            }
        }
        let nothing = (Vec2::ZERO, [0.0_f32; 2], 0.0_f32);
        let mut sums = vec![nothing; centres.len()];
        // The sum of the superpixel at hand stays in registers.
        let mut gathered = (OUTSIDE, nothing);
        let keep = |sums: &mut Vec<_>, (number, sum)| {
            if let Some(slot) = sums.get_mut(number as usize) {
                *slot = sum;
            }
        };
        for (y, row) in label.data.chunks_exact(inside.width).enumerate() {
            for (x, &number) in row.iter().enumerate().filter(|(_, number)| **number != OUTSIDE) {
                if number != gathered.0 {
                    keep(&mut sums, gathered);
                    gathered = (number, sums[number as usize]);
                }
                let (_, sum) = &mut gathered;
                let feature = feature[y * inside.width + x];
                sum.0 += Vec2::new(x as f32 + 0.5, y as f32 + 0.5);
                sum.1 = [sum.1[0] + feature[0], sum.1[1] + feature[1]];
                sum.2 += 1.0;
            }
        }
        keep(&mut sums, gathered);
        for (centre, (at, feature, count)) in centres.iter_mut().zip(sums) {
            if count > 0.0 {
                *centre = Centre { at: at / count, feature: feature.map(|f| f / count) };
            }
        }
    }
    absorb_fragments(inside, &mut label, step * step / 4.0);
    let count = renumber(&mut label);
    Superpixels { label, count }
}

/// Columns and rows of the pixels within one step of a centre.
fn window(inside: &Plane<bool>, centre: Vec2, step: f32) -> (Range<usize>, Range<usize>) {
    let clamp = |x: f32, size: usize| usize::try_from(floor_i32(x)).unwrap_or(0).min(size);
    let columns = clamp(centre.x - step, inside.width)..clamp(centre.x + step + 1.0, inside.width);
    let rows = clamp(centre.y - step, inside.height)..clamp(centre.y + step + 1.0, inside.height);
    (columns, rows)
}

/// Seeds on a grid, each at the flattest pixel of its 3 by 3 neighbourhood; cells that the blade only grazes are
/// seeded at their deepest covered pixel.
fn seeds(inside: &Plane<bool>, feature: &[Feature], step: f32) -> Vec<Centre> {
    let cells = |size: usize| usize::try_from(floor_i32(size as f32 / step)).unwrap_or(0) + 1;
    let (columns, rows) = (cells(inside.width), cells(inside.height));
    let cell_of = |at: usize| {
        let cell = |i: usize, cells: usize| {
            usize::try_from(floor_i32((i as f32 + 0.5) / step)).unwrap_or(0).min(cells - 1)
        };
        cell(at / inside.width, rows) * columns + cell(at % inside.width, columns)
    };
    let mut cover = vec![(0_usize, Vec2::ZERO); rows * columns];
    let grid: Plane<u8> = Plane { width: inside.width, height: inside.height, data: Vec::new() };
    for at in (0..inside.data.len()).filter(|&at| inside.data[at]) {
        let cell = &mut cover[cell_of(at)];
        *cell = (cell.0 + 1, cell.1 + grid.centre(at));
    }
    // The covered pixel nearest to the middle of what a cell covers.
    let mut nearest: Vec<Option<(f32, usize)>> = vec![None; cover.len()];
    for at in (0..inside.data.len()).filter(|&at| inside.data[at]) {
        let cell = cell_of(at);
        let middle = cover[cell].1 / cover[cell].0 as f32;
        let distance = grid.centre(at).distance_squared(middle);
        if nearest[cell].is_none_or(|(best, _)| distance < best) {
            nearest[cell] = Some((distance, at));
        }
    }
    let gradient = |at: usize| -> f32 {
        let other = |next: usize| if inside.data[next] { feature[next] } else { feature[at] };
        let change = |next: usize| (0..2).map(|i| (other(next)[i] - feature[at][i]).abs()).sum::<f32>();
        grid.neighbours4(at).map(change).sum()
    };
    let seeds = nearest.iter().zip(&cover).filter(|(_, (count, _))| *count as f32 >= step * step * 0.15);
    let mut centres: Vec<Centre> = seeds
        .filter_map(|(nearest, _)| *nearest)
        .map(|(_, at)| {
            let (x, y) = (at % inside.width, at / inside.width);
            let around = (y.saturating_sub(1)..=(y + 1).min(inside.height - 1)).flat_map(|ny| {
                (x.saturating_sub(1)..=(x + 1).min(inside.width - 1)).map(move |nx| ny * inside.width + nx)
            });
            let flattest = around
                .filter(|&next| inside.data[next])
                .min_by(|&a, &b| gradient(a).total_cmp(&gradient(b)))
                .unwrap_or(at);
            Centre { at: grid.centre(flattest), feature: feature[flattest] }
        })
        .collect();
    if centres.is_empty()
        && let Some(at) = inside.data.iter().position(|&inside| inside)
    {
        centres.push(Centre { at: grid.centre(at), feature: feature[at] });
    }
    centres
}

/// Keeps what is connected and large enough; the rest joins the neighbour with the longest common border. Pixels that
/// no window reached form superpixels of their own.
fn absorb_fragments(inside: &Plane<bool>, label: &mut Plane<u32>, smallest: f32) {
    let (mut part, mut sizes) = connected(inside, label);
    let is_small = |size: usize| (size as f32) < smallest;
    let mut members: Vec<Vec<usize>> = vec![Vec::new(); sizes.len()];
    for (at, &number) in part.data.iter().enumerate().filter(|(_, number)| **number != OUTSIDE) {
        if is_small(sizes[number as usize]) {
            members[number as usize].push(at);
        }
    }
    let mut order: Vec<usize> = (0..sizes.len()).filter(|&number| is_small(sizes[number])).collect();
    order.sort_by_key(|&number| (sizes[number], number));
    for number in order {
        if !is_small(sizes[number]) {
            continue;
        }
        let mut borders: BTreeMap<u32, usize> = BTreeMap::new();
        let own = part.data[members[number][0]];
        for &at in &members[number] {
            for next in inside.neighbours4(at).filter(|&next| inside.data[next] && part.data[next] != own) {
                *borders.entry(part.data[next]).or_default() += 1;
            }
        }
        let longest = borders.iter().max_by_key(|(label, length)| (**length, OUTSIDE - **label));
        if let Some((&neighbour, _)) = longest {
            let moved = std::mem::take(&mut members[number]);
            for &at in &moved {
                part.data[at] = neighbour;
            }
            sizes[neighbour as usize] += moved.len();
            members[neighbour as usize].extend(moved);
        }
    }
    *label = part;
}

/// 4-connected parts of one label each, numbered in the order of their first pixels, and their sizes.
fn connected(inside: &Plane<bool>, label: &Plane<u32>) -> (Plane<u32>, Vec<usize>) {
    fn root(parent: &mut [u32], mut part: u32) -> u32 {
        while parent[part as usize] != part {
            let above = parent[parent[part as usize] as usize];
            parent[part as usize] = above;
            part = above;
        }
        part
    }
    let width = inside.width;
    let mut part: Plane<u32> = Plane::filled(width, inside.height, OUTSIDE);
    // Each run of pixels joins those that it touches above; a part goes by the lowest number of its runs.
    let mut parent: Vec<u32> = Vec::new();
    for y in 0..inside.height {
        for x in 0..width {
            let at = y * width + x;
            if !inside.data[at] {
                continue;
            }
            let same = |next: usize| inside.data[next] && label.data[next] == label.data[at];
            let left = (x > 0 && same(at - 1)).then(|| part.data[at - 1]);
            let above = (y > 0 && same(at - width)).then(|| part.data[at - width]);
            part.data[at] = match (left, above) {
                (Some(left), Some(above)) if left != above => {
                    let (left, above) = (root(&mut parent, left), root(&mut parent, above));
                    let lowest = left.min(above);
                    parent[left.max(above) as usize] = lowest;
                    lowest
                }
                (Some(one), _) | (None, Some(one)) => one,
                (None, None) => {
                    let new = u32::try_from(parent.len()).unwrap_or(OUTSIDE - 1);
                    parent.push(new);
                    new
                }
            };
        }
    }
    let mut sizes = Vec::new();
    let mut names = vec![OUTSIDE; parent.len()];
    for part in part.data.iter_mut().filter(|part| **part != OUTSIDE) {
        let name = &mut names[root(&mut parent, *part) as usize];
        if *name == OUTSIDE {
            *name = u32::try_from(sizes.len()).unwrap_or(OUTSIDE - 1);
            sizes.push(0);
        }
        *part = *name;
        sizes[*name as usize] += 1;
    }
    (part, sizes)
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::{any, prop_assert, prop_assert_eq, proptest};

    #[test]
    fn a_square_gets_about_as_many_as_wanted() {
        let inside = Plane::filled(60, 60, true);
        let feature = vec![[0.0; 2]; 3600];
        let found = superpixels(&inside, &feature, 36);
        assert!((30..=42).contains(&found.count), "{} superpixels", found.count);
    }

    #[test]
    fn features_draw_the_borders() {
        let inside = Plane::filled(40, 40, true);
        let feature: Vec<Feature> = (0..1600).map(|i| [if i % 40 < 17 { 0.0 } else { 60.0 }, 0.0]).collect();
        let found = superpixels(&inside, &feature, 16);
        let crossing = (0..1600).filter(|i| i % 40 == 16 && found.label.data[*i] == found.label.data[i + 1]);
        assert_eq!(crossing.count(), 0, "no superpixel crosses the step");
    }

    proptest! {
        #[test]
        fn any_mask_is_covered(
            width in 1_usize..20,
            height in 1_usize..20,
            bits in proptest::collection::vec(any::<u8>(), 400),
            wanted in 0_usize..50,
        ) {
            let count = width * height;
            let inside = Plane { width, height, data: (0..count).map(|i| bits[i] & 3 != 0).collect() };
            let feature: Vec<Feature> = (0..count).map(|i| [f32::from(bits[i]), 0.0]).collect();
            let found = superpixels(&inside, &feature, wanted);
            for (label, inside) in found.label.data.iter().zip(&inside.data) {
                prop_assert_eq!(*label != OUTSIDE, *inside);
                prop_assert!(*label == OUTSIDE || (*label as usize) < found.count);
            }
        }
    }
}
