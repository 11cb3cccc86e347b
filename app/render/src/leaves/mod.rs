// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Leaves: from a simulator's columns to records of those that a view shows, and from these to pictures of blades.

pub(crate) mod cull;
pub(crate) mod leaf_pass;
pub(crate) mod meshes;
pub(crate) mod motion_pass;
pub(crate) mod previous;
pub(crate) mod record;
pub(crate) mod species_table;
mod strip;
pub(crate) mod visible;
