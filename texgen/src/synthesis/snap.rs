// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Moves the veins of an example sideways onto the lines that its picture shows: veins drawn a pixel beside the real
//! ones would smear their profile and leave the real ones in the tissue.

use glam::Vec2;

use crate::lab::Lab;
use crate::plane::Plane;
use crate::{VeinGraph, VeinNode};

/// Farthest move as a share of √A.
const REACH: f32 = 0.016;
/// Distance at which a line is compared with what lies beside it, as a share of √A.
const BESIDE: f32 = 0.013;
/// Half the length over which a line is followed, as a share of √A.
const ALONG: f32 = 0.03;
/// Moves from one side to the other.
const MOVES: usize = 13;
/// Loss for a move to the farthest place, in steps of lightness.
const RELUCTANCE: f32 = 0.5;
/// Rounds in which neighbouring nodes agree on their moves.
const ROUNDS: usize = 4;

/// Responses of one node to all moves.
type Responses = [f32; MOVES];

/// Moves the nodes of main and lateral veins; the root stays.
pub(super) fn snap(veins: &mut VeinGraph, colour: &Plane<Lab>, inside: &[bool], unit: f32) {
    let normals: Vec<Vec2> = (0..veins.nodes.len()).map(|i| direction(veins, i).perp()).collect();
    for order in [1_u8, 2] {
        let members: Vec<usize> = (0..veins.nodes.len())
            .filter(|&i| veins.nodes[i].order.clamp(1, 2) == order && veins.nodes[i].parent.is_some())
            .filter(|&i| veins.nodes[i].order <= 2)
            .collect();
        let responses: Vec<Responses> =
            members.iter().map(|&i| respond(&veins.nodes[i], normals[i], colour, inside, unit)).collect();
        // Veins of one rank are all lighter or all darker than the tissue.
        let strength = |sign: f32| -> f32 {
            let best = |response: &Responses| response.iter().map(|r| r * sign).fold(0.0, f32::max);
            responses.iter().map(best).sum()
        };
        let sign = if strength(1.0) >= strength(-1.0) { 1.0 } else { -1.0 };
        let mut place = vec![usize::MAX; veins.nodes.len()];
        for (slot, &node) in members.iter().enumerate() {
            place[node] = slot;
        }
        let near: Vec<Vec<usize>> = neighbours(veins, &members, &place);
        let mut table: Vec<Responses> = responses.iter().map(|r| r.map(|r| r * sign)).collect();
        for _ in 0..ROUNDS {
            table = (0..table.len())
                .map(|slot| {
                    let own = 1.0 / (1.0 + near[slot].len() as f32);
                    std::array::from_fn(|m| {
                        let others: f32 = near[slot].iter().map(|&other| table[other][m]).sum();
                        (table[slot][m] + others) * own
                    })
                })
                .collect();
        }
        let middle = (MOVES / 2) as f32;
        let mut moves: Vec<f32> = table
            .iter()
            .map(|responses| {
                let worth = |m: usize| responses[m] - RELUCTANCE * ((m as f32 - middle) / middle).abs();
                let best = (0..MOVES).max_by(|&a, &b| worth(a).total_cmp(&worth(b))).unwrap_or(MOVES / 2);
                (best as f32 - middle) / middle * REACH * unit
            })
            .collect();
        for _ in 0..2 {
            moves = (0..moves.len())
                .map(|slot| {
                    let others: f32 = near[slot].iter().map(|&other| moves[other]).sum();
                    (moves[slot] + others) / (1.0 + near[slot].len() as f32)
                })
                .collect();
        }
        for (&node, distance) in members.iter().zip(moves) {
            veins.nodes[node].position += normals[node] * distance;
        }
    }
}

/// Direction of the vein at a node.
fn direction(veins: &VeinGraph, index: usize) -> Vec2 {
    let mut from = veins.nodes[index];
    for _ in 0..4 {
        let Some(parent) = from.parent.and_then(|parent| veins.nodes.get(parent as usize)) else { break };
        from = *parent;
    }
    (veins.nodes[index].position - from.position).normalize_or(Vec2::NEG_Y)
}

/// Slots of the nodes before and after each node on veins of the same rank.
fn neighbours(veins: &VeinGraph, members: &[usize], place: &[usize]) -> Vec<Vec<usize>> {
    let mut near = vec![Vec::new(); members.len()];
    for (slot, &node) in members.iter().enumerate() {
        if let Some(parent) = veins.nodes[node].parent
            && let Some(&other) = place.get(parent as usize).filter(|&&other| other != usize::MAX)
        {
            near[slot].push(other);
            near[other].push(slot);
        }
    }
    near
}

/// Lightness of the line through a node above that of both sides, for every move.
fn respond(node: &VeinNode, normal: Vec2, colour: &Plane<Lab>, inside: &[bool], unit: f32) -> Responses {
    const SAMPLES: i32 = 4;
    let along = normal.perp();
    let light = |p: Vec2| colour.index_of(p).filter(|&at| inside[at]).map(|at| colour.data[at][0]);
    std::array::from_fn(|m| {
        let shift = (m as f32 / (MOVES / 2) as f32 - 1.0) * REACH * unit;
        let (mut sum, mut count) = (0.0, 0.0);
        for sample in -SAMPLES..=SAMPLES {
            let p = node.position + normal * shift + along * (sample as f32 / SAMPLES as f32 * ALONG * unit);
            let side = normal * (BESIDE * unit).max(2.0);
            if let (Some(on), Some(left), Some(right)) = (light(p), light(p - side), light(p + side)) {
                sum += on - 0.5 * (left + right);
                count += 1.0;
            }
        }
        sum / f32::max(count, 1.0)
    })
}
