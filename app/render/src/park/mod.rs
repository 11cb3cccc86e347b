// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! The park around the leaves: far trees and litter, painted and planted once on the CPU, with no effect on the simulation.

pub(crate) mod far_trees;
pub(crate) mod layout;
pub(crate) mod litter;
pub(crate) mod park_trees;
mod tree_canvas;
mod tree_sprite;
