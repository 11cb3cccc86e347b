// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Random numbers of a growing tree: pure functions of seed, tree number, step, place and number of the draw.

use crate::arith::rng::{philox, seed_words};

/// Last counter word of a tree's draws, which no other draw has: it counts up from here.
const TREE_STREAM: u32 = 0x8000_0000;

/// The draws of one module at one step.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Draws {
    key: [u32; 2],
    counter: [u32; 4],
}

impl Draws {
    /// The draws of module `index` at `step` of tree `number`.
    pub(crate) fn new(seed: u64, number: u32, step: u32, index: u32) -> Self {
        Self { key: seed_words(seed), counter: [index, step, number, TREE_STREAM] }
    }

    /// For expressions that draw nothing.
    pub(super) fn none() -> Self {
        Self::new(0, 0, 0, 0)
    }

    /// The next number in [0, 1).
    pub(crate) fn unit(&mut self) -> f64 {
        let [word, ..] = philox(self.key, self.counter);
        self.counter[3] = self.counter[3].wrapping_add(1);
        f64::from(word) / 4_294_967_296.0
    }
}
