// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Older ways of doing it, which the engine is measured against.

mod structs;
mod trajectories;

pub(super) use structs::ArrayOfStructs;
pub(super) use trajectories::Trajectories;
