// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Cheapest ways across a grid (Dijkstra 1959).

use std::cmp::Reverse;
use std::collections::BinaryHeap;

/// Marks a pixel without predecessor.
pub(crate) const NONE: u32 = u32::MAX;

/// Cheapest ways from every pixel back to the sources.
pub(crate) struct Ways {
    /// Cost of the way; infinite where there is none.
    pub(crate) cost: Vec<f32>,
    /// Length of the way in pixels.
    pub(crate) length: Vec<f32>,
    /// Next pixel on the way to the source, [`NONE`] at sources and where there is no way.
    pub(crate) previous: Vec<u32>,
}

impl Ways {
    /// Finds the ways over pixels of finite cost; a step costs its length times the mean cost of its two pixels.
    pub(crate) fn from(sources: &[usize], width: usize, price: &[f32]) -> Self {
        let count = price.len();
        let mut ways =
            Self { cost: vec![f32::INFINITY; count], length: vec![0.0; count], previous: vec![NONE; count] };
        let mut open = BinaryHeap::new();
        for &source in sources {
            ways.cost[source] = 0.0;
            open.push(Reverse((0, source)));
        }
        // Bits of positive floats order like the floats; equal costs go by index, so the result is unique.
        while let Some(Reverse((bits, i))) = open.pop() {
            let cost = f32::from_bits(bits);
            if cost > ways.cost[i] {
                continue;
            }
            for (next, step) in neighbours(i, width, count / width.max(1)) {
                let passed = cost + step * (price[i] + price[next]) / 2.0;
                if passed < ways.cost[next] {
                    ways.cost[next] = passed;
                    ways.length[next] = ways.length[i] + step;
                    ways.previous[next] = u32::try_from(i).unwrap_or(NONE);
                    open.push(Reverse((passed.to_bits(), next)));
                }
            }
        }
        ways
    }

    /// Pixels from `start` to its source, both included.
    pub(crate) fn trace(&self, start: usize) -> Vec<usize> {
        let mut way = vec![start];
        let mut at = start;
        while self.previous[at] != NONE {
            at = self.previous[at] as usize;
            way.push(at);
        }
        way
    }
}

/// The up to eight pixels around pixel `i`, with the length of the step.
fn neighbours(i: usize, width: usize, height: usize) -> impl Iterator<Item = (usize, f32)> {
    let (x, y) = (i % width, i / width);
    let rows = y.saturating_sub(1)..=(y + 1).min(height - 1);
    rows.flat_map(move |v| (x.saturating_sub(1)..=(x + 1).min(width - 1)).map(move |u| (u, v)))
        .filter(move |(u, v)| (*u, *v) != (x, y))
        .map(move |(u, v)| {
            let diagonal = u != x && v != y;
            (v * width + u, if diagonal { std::f32::consts::SQRT_2 } else { 1.0 })
        })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ways_go_round_walls() {
        // Five by three with a wall in the middle column that leaves the bottom row open.
        let mut price = vec![1.0; 15];
        price[2] = f32::INFINITY;
        price[7] = f32::INFINITY;
        let ways = Ways::from(&[0], 5, &price);
        let way = ways.trace(4);
        assert_eq!((way[0], way[way.len() - 1]), (4, 0), "from the asked pixel to the source");
        assert!(way.contains(&12), "through the gap: {way:?}");
        assert!((ways.length[4] - 4.0 * std::f32::consts::SQRT_2).abs() < 1e-5, "four diagonal steps");
        assert!(ways.cost[7].is_infinite(), "walls are not entered");
    }
}
