// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Main and lateral veins of a photographed blade, as cheapest ways along its ridges.
//!
//! A threshold on the ridges would leave fragments. Ways from the tips of the lobes to the root, and from the
//! margin to what was found so far, make one connected tree by construction.

use glam::Vec2;

use super::close_up::CloseUp;
use super::geodesic::Ways;
use super::vein_tree::VeinTree;
use crate::field::quantile;
use crate::math::floor_i32;
use crate::{Blade, VeinGraph};

/// Price of a pixel without any ridge, against 1 / (this + 1) on a strong one.
const FLAT: f32 = 0.05;
/// Main veins keep this far off the margin where they can, in √A.
const MAIN_RIM: f32 = 0.06;
/// Least rise of a lobe's tip over the bays beside it, as distances from the root, in √A.
const LOBE: f32 = 0.07;
/// A lobe's way that joins the tree within this share of its length from the root is a main vein.
const MAIN: f32 = 0.2;
/// Least length of a lateral vein in √A.
const SHORTEST: f32 = 0.1;
/// Least distance between laterals in √A.
const APART: f32 = 0.045;
/// Share of a lateral that may run nearer than that to another.
const TOGETHER: f32 = 0.3;
/// A lateral must cost less than this share of what flat tissue costs.
const WORTH: f32 = 0.5;
/// Most laterals.
const LATERALS: usize = 60;

/// Follows the veins of a blade from its root.
pub(crate) fn trace(close_up: &CloseUp, blade: &Blade) -> VeinGraph {
    let (root, tip) = (close_up.enter(blade.root), close_up.enter(blade.tip));
    let outline: Vec<Vec2> = blade.outline.iter().map(|p| close_up.enter(*p)).collect();
    let width = close_up.mask.width as usize;
    let price = prices(close_up, MAIN_RIM);
    let nearest = |p: Vec2| nearest_inside(close_up, p);
    let Some(root_pixel) = nearest(root) else { return VeinGraph::default() };

    let mut tree = VeinTree::new(root_pixel, width, close_up.mask.inside.len());
    let from_root = Ways::from(&[root_pixel], width, &price);
    let mut tips: Vec<Vec2> = vec![tip];
    tips.extend(
        lobe_tips(&outline, root, close_up.side)
            .into_iter()
            .filter(|p| p.distance(tip) > 0.12 * close_up.side),
    );
    for tip in tips {
        let Some(start) = nearest(tip) else { continue };
        let way = from_root.trace(start);
        let new = way.iter().take_while(|i| !tree.has(**i)).count();
        let Some(joined) = way.get(new) else { continue };
        let is_first = tree.is_bare();
        if !is_first && from_root.length[start] - from_root.length[*joined] < SHORTEST * close_up.side {
            continue;
        }
        let is_main = is_first || from_root.length[*joined] <= MAIN * from_root.length[start];
        tree.add(&way[..=new], if is_main { 1 } else { 2 });
    }
    add_laterals(close_up, &outline, &prices(close_up, 0.01), &mut tree);
    tree.into_graph(close_up)
}

/// Price of passing each pixel, higher within `rim` (in √A) of the margin; infinite outside.
fn prices(close_up: &CloseUp, rim: f32) -> Vec<f32> {
    let strength = &close_up.ridges.strength.values;
    let inside = || (0..strength.len()).filter(|i| close_up.mask.inside[*i]);
    let strong = quantile(&mut inside().map(|i| strength[i]).collect::<Vec<f32>>(), 0.97).max(1e-3);
    let mut price = vec![f32::INFINITY; strength.len()];
    for i in inside() {
        let near_margin = (1.0 - close_up.depth[i] / (rim * close_up.side)).max(0.0);
        let toll = 1.0 + 3.0 * near_margin * near_margin;
        price[i] = toll / (FLAT + (strength[i] / strong).clamp(0.0, 1.0));
    }
    price
}

/// The blade's pixel nearest to a point.
fn nearest_inside(close_up: &CloseUp, p: Vec2) -> Option<usize> {
    let mask = &close_up.mask;
    let (x, y) = (floor_i32(p.x), floor_i32(p.y));
    let width = mask.width as usize;
    if mask.contains(x, y) {
        return Some(y.unsigned_abs() as usize * width + x.unsigned_abs() as usize);
    }
    let distance =
        |i: &usize| Vec2::new((i % width) as f32 + 0.5, (i / width) as f32 + 0.5).distance_squared(p);
    let inside = (0..mask.inside.len()).filter(|i| mask.inside[*i]);
    inside.min_by(|a, b| distance(a).total_cmp(&distance(b)))
}

/// Corners of the outline that stand out as seen from the root, the farthest first.
fn lobe_tips(outline: &[Vec2], root: Vec2, side: f32) -> Vec<Vec2> {
    let count = outline.len();
    let reach: Vec<f32> = outline.iter().map(|p| p.distance(root)).collect();
    let rise = |i: usize| {
        // How far one must come down on either side before it goes up higher.
        let descent = |direction: usize| {
            let mut lowest = reach[i];
            for k in 1..count {
                let there = reach[(i + k * direction) % count];
                if there > reach[i] {
                    break;
                }
                lowest = lowest.min(there);
            }
            reach[i] - lowest
        };
        descent(1).min(descent(count - 1))
    };
    let mut tips: Vec<usize> = (0..count).filter(|i| rise(*i) > LOBE * side).collect();
    tips.sort_by(|a, b| reach[*b].total_cmp(&reach[*a]));
    tips.into_iter().map(|i| outline[i]).collect()
}

/// Adds the cheapest ways from the margin to the tree that keep apart from each other.
fn add_laterals(close_up: &CloseUp, outline: &[Vec2], price: &[f32], tree: &mut VeinTree) {
    let width = close_up.mask.width as usize;
    let side = close_up.side;
    let ways = Ways::from(&tree.sources(price), width, price);
    let flat = 1.0 / FLAT;
    let mut candidates: Vec<(f32, usize)> = margin_points(outline, 0.01 * side)
        .into_iter()
        .filter_map(|p| nearest_inside(close_up, p))
        .filter(|i| ways.length[*i] >= SHORTEST * side)
        .map(|i| (ways.cost[i] / ways.length[i], i))
        .filter(|(mean, _)| *mean < WORTH * flat)
        .collect();
    candidates.sort_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
    candidates.dedup_by_key(|(_, i)| *i);

    let mut taken = vec![false; price.len()];
    let mut count = 0;
    for (_, start) in candidates {
        if count == LATERALS {
            break;
        }
        let way = ways.trace(start);
        let beside = way.iter().filter(|i| taken[**i]).count();
        if beside as f32 > TOGETHER * way.len() as f32 {
            continue;
        }
        let new = way.iter().take_while(|i| !tree.has(**i)).count();
        if (new as f32) < 0.7 * SHORTEST * side || new == way.len() {
            continue;
        }
        tree.add(&way[..=new], 2);
        count += 1;
        block(&mut taken, &way[..new], width, APART * side);
    }
}

/// Marks everything near a way.
fn block(taken: &mut [bool], way: &[usize], width: usize, radius: f32) {
    let reach = usize::try_from(floor_i32(radius)).unwrap_or(0);
    let height = taken.len() / width;
    for &i in way.iter().step_by((reach / 3).max(1)) {
        let (x, y) = (i % width, i / width);
        for v in y.saturating_sub(reach)..=(y + reach).min(height - 1) {
            for u in x.saturating_sub(reach)..=(x + reach).min(width - 1) {
                let (dx, dy) = (u as f32 - x as f32, v as f32 - y as f32);
                taken[v * width + u] |= dx * dx + dy * dy <= radius * radius;
            }
        }
    }
}

/// Points along a closed polygon, about `step` apart.
fn margin_points(outline: &[Vec2], step: f32) -> Vec<Vec2> {
    let mut points = Vec::new();
    for (a, b) in outline.iter().zip(outline.iter().cycle().skip(1)) {
        let pieces = floor_i32(a.distance(*b) / step.max(0.5)).clamp(0, 10_000) + 1;
        points.extend((0..pieces).map(|k| a.lerp(*b, k as f32 / pieces as f32)));
    }
    points
}

/// Returns true if no two veins cross except where they meet.
pub(crate) fn is_planar(graph: &VeinGraph) -> bool {
    let edges: Vec<(u32, u32)> = (0u32..)
        .zip(&graph.nodes)
        .filter_map(|(i, node)| node.parent.map(|parent| (i, parent)))
        .chain(graph.joins.iter().copied())
        .collect();
    let at = |i: u32| graph.nodes[i as usize].position;
    let shares = |a: (u32, u32), b: (u32, u32)| a.0 == b.0 || a.0 == b.1 || a.1 == b.0 || a.1 == b.1;
    edges.iter().enumerate().all(|(k, &first)| {
        edges[k + 1..].iter().all(|&second| {
            let (a, b) = ((at(first.0), at(first.1)), (at(second.0), at(second.1)));
            let apart = a.0.max(a.1).cmplt(b.0.min(b.1)).any() || b.0.max(b.1).cmplt(a.0.min(a.1)).any();
            apart || shares(first, second) || !super::outline::segments_meet(a, b)
        })
    })
}
