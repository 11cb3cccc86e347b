// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! The Markov chain that joins primitive motions.

use serde::{Deserialize, Serialize};

use super::primitive::{JOINED_COUNT, Primitive};

/// Counts of observed changes from one primitive motion (row) to the next (column), in the order of [`Primitive::JOINED`]. Rows are integers, so every row
/// sums exactly and no draw can fall off its end.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct TransitionTable(pub [[u32; JOINED_COUNT]; JOINED_COUNT]);

impl Default for TransitionTable {
    /// The counts behind the four-digit probabilities that Li et al. (2015, table 1) print.
    fn default() -> Self {
        Self([
            [4, 9, 1, 1, 8, 3],
            [0, 15, 1, 4, 14, 12],
            [0, 0, 16, 3, 9, 8],
            [0, 0, 0, 16, 2, 5],
            [0, 0, 0, 0, 12, 1],
            [0, 0, 0, 0, 0, 1],
        ])
    }
}

impl TransitionTable {
    /// A table that never leaves the motion it starts with.
    pub fn stay() -> Self {
        let mut rows = [[0; JOINED_COUNT]; JOINED_COUNT];
        for (index, row) in rows.iter_mut().enumerate() {
            row[index] = 1;
        }
        Self(rows)
    }

    /// Sum of one row.
    pub fn row_total(&self, from: Primitive) -> u32 {
        self.0[from as usize].iter().sum()
    }
}
