// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! The bed: heights of litter at the nodes of its grid, and how many leaves the wind has taken from it.

use crate::blocks::{LitterBlock, SceneBlock};
use crate::convert::len32;
use crate::device::leaf::burn::FIRE_WORDS;
use crate::device::leaf::stack::LitterChange;
use crate::scene::MAX_PLUMES;

/// Words in a row of the tables, behind which devices keep the bed.
const ROW_WORDS: usize = 4;

crate::columns! {
    /// Litter of a world. The nodes of its grid, line by line, then [`Bed::woken`], then the fires that leaves feed, then the snow, on the ground and on branches; no row without litter and snow.
    pub struct Bed("litter") {
        /// Heights in units of [`LITTER_UNIT_M`](crate::device::terrain::litter::LITTER_UNIT_M).
        pub words: u32,
    }
    /// The words of one row.
    row BedWord;
    /// A run of rows.
    run BedMut;
}

impl Bed {
    /// Number of rows for a scene, whole rows of tables.
    pub(crate) fn rows_of(scene: &SceneBlock) -> usize {
        let snow = Self::snow_words(&scene.snow) + Self::branch_snow_words(&scene.snow);
        let words = Self::first_snow(scene) as usize + snow;
        words.next_multiple_of(ROW_WORDS)
    }

    /// Place of the snow, a whole number of rows from the start.
    pub(crate) fn first_snow(scene: &SceneBlock) -> u32 {
        let fires = if scene.first_fire == 0 { 0 } else { len32(MAX_PLUMES) * FIRE_WORDS };
        if scene.litter.columns == 0 { 0 } else { Self::first_fire(&scene.litter) + fires }
    }

    /// Place of the first fire that leaves feed, a whole number of rows from the start.
    pub(crate) fn first_fire(litter: &LitterBlock) -> u32 {
        len32((nodes(litter) + 1).next_multiple_of(ROW_WORDS))
    }

    /// The fires that leaves feed; empty where there are none.
    pub fn fires_mut(&mut self, scene: &SceneBlock) -> &mut [[u32; FIRE_WORDS as usize]] {
        let first = if scene.first_fire == 0 { self.words.len() } else { scene.first_fire as usize };
        let fires = (self.words.len() - first).min(MAX_PLUMES * FIRE_WORDS as usize);
        self.words[first..first + fires].as_chunks_mut().0
    }

    /// Heights of the nodes.
    pub fn heights(&self, litter: &LitterBlock) -> &[u32] {
        &self.words[..nodes(litter).min(self.words.len())]
    }

    /// Number of leaves that the wind has taken so far.
    pub fn woken(&self, litter: &LitterBlock) -> u32 {
        self.words.get(nodes(litter)).copied().unwrap_or(0)
    }

    /// Makes the change of a leaf. Changes of integers, they may come in any order.
    pub fn apply(&mut self, litter: &LitterBlock, change: &LitterChange) {
        let nodes_from = |node: u32| {
            let far = node + litter.columns + 1;
            [node, node + 1, far, far + 1].map(|node| node as usize)
        };
        for (node, height) in nodes_from(change.taken.node).into_iter().zip(change.taken.heights) {
            self.words[node] = self.words[node].wrapping_sub(height);
        }
        for (node, height) in nodes_from(change.added.node).into_iter().zip(change.added.heights) {
            self.words[node] = self.words[node].wrapping_add(height);
        }
        self.words[nodes(litter)] += u32::from(change.is_woken);
    }
}

/// Number of nodes of the grid.
fn nodes(litter: &LitterBlock) -> usize {
    if litter.columns == 0 {
        return 0;
    }
    (litter.columns as usize + 1) * (litter.lines as usize + 1)
}
