// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! How others have done it: what the engine is measured against. Used by benches only.

mod structs;
mod trajectories;

pub(super) use structs::ArrayOfStructs;
pub(super) use trajectories::Trajectories;
