// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Turns a draft into a graph: what each vein carries decides its width.

use super::draft::Draft;
use crate::{VeinGraph, VeinNode};

/// Sum of widths at the junctions of veins.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum WidthLaw {
    /// r³ = Σ r³, the law of least work (Murray 1926).
    Murray,
    /// r² = Σ r²: cross sections add (the pipe model; Rodkaew et al. 2002).
    Pipe,
}

impl WidthLaw {
    /// Radius that carries a share of the root's flow, as a share of the root's radius.
    fn radius(self, share: f32) -> f32 {
        match self {
            Self::Murray => libm::cbrtf(share),
            Self::Pipe => share.sqrt(),
        }
    }
}

/// Widths of a draft. Every segment feeds the tissue along it, so flow falls along a vein as well as where it
/// branches, and no radius grows outward. `root_radius` is a share of √A.
pub(crate) fn finish(draft: Draft<'_>, root_radius: f32, law: WidthLaw) -> VeinGraph {
    let flow = flows(&draft);
    let total = flow.first().copied().unwrap_or(0.0).max(f32::MIN_POSITIVE);
    let root = root_radius * draft.ground.unit;
    let nodes = draft
        .nodes
        .iter()
        .zip(&flow)
        .map(|(sprout, flow)| VeinNode {
            position: sprout.position,
            parent: sprout.parent,
            order: sprout.order,
            radius: root * law.radius(flow / total),
        })
        .collect();
    VeinGraph { nodes, joins: draft.joins }
}

/// Flow through each node: the length of its own segment and of all that it feeds.
fn flows(draft: &Draft<'_>) -> Vec<f32> {
    let mut flow = vec![0.0_f32; draft.nodes.len()];
    for index in (0..draft.nodes.len()).rev() {
        let sprout = draft.nodes[index];
        if let Some(parent) = sprout.parent {
            flow[index] += draft.at(parent).distance(sprout.position);
            flow[parent as usize] += flow[index];
        }
    }
    flow
}

/// Ranks veins by what they carry: the strongest branch goes on in its parent's order, the others rank one lower.
pub(crate) fn rank(draft: &mut Draft<'_>, lowest: u8) {
    let flow = flows(draft);
    let mut heir: Vec<Option<usize>> = vec![None; draft.nodes.len()];
    for (index, sprout) in draft.nodes.iter().enumerate() {
        let Some(parent) = sprout.parent.map(|p| p as usize) else { continue };
        if heir[parent].is_none_or(|other| flow[index] > flow[other]) {
            heir[parent] = Some(index);
        }
    }
    for index in 1..draft.nodes.len() {
        let Some(parent) = draft.nodes[index].parent.map(|p| p as usize) else { continue };
        let own = draft.nodes[parent].order;
        draft.nodes[index].order = if heir[parent] == Some(index) { own } else { (own + 1).min(lowest) };
    }
}
