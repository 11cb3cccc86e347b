// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! At which angle laterals leave their main vein.

use glam::Vec2;

use crate::VeinGraph;

/// Part of a lateral that its direction is taken from. Cheapest ways meet a main vein squarely, whatever the
/// lateral's angle, and follow the margin at their end.
const STRETCH: (f32, f32) = (0.2, 0.7);
/// Shorter laterals, as a share of the longest, say little.
const LEAST_LENGTH: f32 = 0.25;
/// Nodes of the main vein over which its direction is taken.
const BEFORE: usize = 6;

/// Angles between laterals and their main veins in degrees, 0 to 180.
pub(crate) fn divergences(veins: &VeinGraph) -> Vec<f32> {
    let nodes = &veins.nodes;
    let parent = |i: usize| nodes[i].parent.map(|parent| parent as usize);
    // For each first node of a lateral the longest way outward from where it leaves the main vein.
    let mut longest: Vec<Option<(f32, Vec<Vec2>)>> = vec![None; nodes.len()];
    for end in (0..nodes.len()).filter(|i| nodes[*i].order == 2) {
        let (mut at, mut way, mut length) = (end, vec![nodes[end].position], 0.0);
        while let Some(next) = parent(at).filter(|_| nodes[at].order > 1) {
            way.push(nodes[next].position);
            length += nodes[at].position.distance(nodes[next].position);
            if nodes[next].order <= 1 {
                break;
            }
            at = next;
        }
        if longest[at].as_ref().is_none_or(|(best, _)| length > *best) {
            longest[at] = Some((length, way));
        }
    }
    let most = longest.iter().flatten().map(|(length, _)| *length).fold(0.0, f32::max);
    let angle = |(first, lateral): (usize, Option<(f32, Vec<Vec2>)>)| {
        let (length, way) = lateral.filter(|(length, _)| *length > LEAST_LENGTH * most)?;
        let junction = parent(first)?;
        let before = (0..BEFORE).try_fold(junction, |at, _| parent(at))?;
        let along = nodes[junction].position - nodes[before].position;
        let outward = point(&way, (1.0 - STRETCH.1) * length) - point(&way, (1.0 - STRETCH.0) * length);
        let turn = libm::atan2f(along.perp_dot(outward).abs(), along.dot(outward)).to_degrees();
        (along != Vec2::ZERO && outward != Vec2::ZERO).then_some(turn)
    };
    longest.into_iter().enumerate().filter_map(angle).collect()
}

/// Point at a length along a path.
fn point(path: &[Vec2], mut length: f32) -> Vec2 {
    for pair in path.windows(2) {
        let step = pair[0].distance(pair[1]);
        if length <= step {
            return pair[0].lerp(pair[1], length / step.max(1e-6));
        }
        length -= step;
    }
    path.last().copied().unwrap_or_default()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::VeinNode;

    #[test]
    fn the_angle_is_taken_beyond_a_square_start() {
        let node = |x: f32, y: f32, parent: Option<u32>, order: u8| VeinNode {
            position: Vec2::new(x, y),
            parent,
            order,
            radius: 1.0,
        };
        let mut nodes: Vec<VeinNode> =
            (0..10u8).map(|k| node(0.0, -f32::from(k), k.checked_sub(1).map(u32::from), 1)).collect();
        // A lateral that starts squarely at the eighth node and then climbs at 40 degrees.
        nodes.push(node(0.5, -8.0, Some(8), 2));
        let (sin, cos) = 40.0_f32.to_radians().sin_cos();
        for k in 1..10u8 {
            let last = u32::try_from(nodes.len() - 1).expect("few");
            nodes.push(node(0.5 + f32::from(k) * sin, -8.0 - f32::from(k) * cos, Some(last), 2));
        }
        let found = divergences(&VeinGraph { nodes, joins: Vec::new() });
        assert_eq!(found.len(), 1, "one lateral");
        assert!((found[0] - 40.0).abs() < 1.0, "{found:?}");
        assert!(divergences(&VeinGraph::default()).is_empty(), "no veins");
    }
}
