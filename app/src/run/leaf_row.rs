// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Columns of a leaf in tables of comma-separated values: those of tracks and of exports.

use std::io::Write;

use windfall_core::leaf::LeafState;

use crate::files::CsvFile;

/// Names of the columns.
const LEAF_COLUMNS: [&str; 15] = [
    "leaf",
    "id",
    "state",
    "primitive",
    "species",
    "x_m",
    "y_m",
    "z_m",
    "vx_m_s",
    "vy_m_s",
    "vz_m_s",
    "qx",
    "qy",
    "qz",
    "qw",
];
/// Number of those that a dormant leaf has, too.
const OF_DORMANT: usize = 3;

/// Header of a table with the columns of a leaf between others.
pub(crate) fn header(before: &[&'static str], after: &[&'static str]) -> Vec<&'static str> {
    [before, &LEAF_COLUMNS, after].concat()
}

/// Leaf as tables have it.
#[derive(Clone, Copy, Debug)]
pub(crate) struct LeafRow<'a> {
    pub(crate) slot: u32,
    pub(crate) id: u32,
    pub(crate) state: LeafState,
    /// Code of its primitive motion, empty if it has none.
    pub(crate) motion: &'a str,
    /// Name of its species.
    pub(crate) species: &'a str,
    pub(crate) position_m: [f32; 3],
    pub(crate) velocity_m_s: [f32; 3],
    /// Unit quaternion x, y, z, w.
    pub(crate) attitude: [f32; 4],
}

impl LeafRow<'_> {
    /// Adds the fields of the leaf to a row; behind the state of a dormant leaf they are empty.
    pub(crate) fn write<W: Write>(&self, table: &mut CsvFile<W>) {
        table.field(self.slot).field(self.id).field(self.state.name());
        if self.state == LeafState::Dormant {
            table.empty(LEAF_COLUMNS.len() - OF_DORMANT);
            return;
        }
        table.field(self.motion).field(self.species);
        for number in self.position_m.iter().chain(&self.velocity_m_s).chain(&self.attitude) {
            table.field(number);
        }
    }
}
