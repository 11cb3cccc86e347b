// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Worlds, and everything that steps, counts, saves and compares them.

pub mod checkpoint;
mod lead;
mod lying_snow;
pub mod oracle;
mod simulator;
pub mod stats;
mod world;

pub use self::simulator::{Contract, Simulator, SimulatorInfo};
pub use self::stats::{LeafStats, Stats};
pub use self::world::World;
