// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! The interface of every backend.

use super::stats::Stats;
use super::world::World;
use crate::clock::Clock;
use crate::compile::CompiledScene;
use crate::error::SimError;
use crate::store::StoreSize;

/// Closeness to which a backend's state agrees with the CPU oracle's.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Contract {
    /// Every bit of the state is the same.
    Exact,
    /// Integers are the same; floats drift apart by rounding only.
    Tolerant,
}

impl std::fmt::Display for Contract {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(match self {
            Self::Exact => "exact",
            Self::Tolerant => "tolerant",
        })
    }
}

/// Name and size of a simulator.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct SimulatorInfo {
    /// Name of the backend.
    pub backend: &'static str,
    /// Adapter and driver, or threads.
    pub adapter: String,
    /// Agreement with the oracle.
    pub contract: Contract,
    /// Number of rows of each store.
    pub sizes: Vec<StoreSize>,
}

/// A backend: owns the stores of a world, a clock and a compiled scene, and moves them on.
///
/// Constructors stay outside, because every backend needs something else to run on.
pub trait Simulator {
    /// Name and size.
    fn info(&self) -> SimulatorInfo;

    /// The present.
    fn clock(&self) -> Clock;

    /// Replaces the whole state: leaves, trees, clock and scene.
    ///
    /// # Errors
    /// [`SimError::Size`] if a store of the world is of another size.
    fn write_state(&mut self, world: &World) -> Result<(), SimError>;

    /// Copies leaves, trees and clock into the caller's world. Waits for all steps; slow on a GPU.
    ///
    /// # Errors
    /// [`SimError::Size`] if a store of the world is of another size; a lost device.
    fn read_state(&mut self, world: &mut World) -> Result<(), SimError>;

    /// Replaces wind, season, ground and speeds from the next step on. Leaves and trees stay as they are.
    ///
    /// # Errors
    /// [`SimError::Size`] if it is that of a world of another size; a lost device.
    fn set_scene(&mut self, compiled: &CompiledScene) -> Result<(), SimError>;

    /// Submits `count` steps and does not wait for them.
    ///
    /// # Errors
    /// A lost device.
    fn step(&mut self, count: u32) -> Result<(), SimError>;

    /// Waits until all submitted steps are done.
    ///
    /// # Errors
    /// A lost device.
    fn sync(&mut self) -> Result<(), SimError>;

    /// Counts over all leaves after all submitted steps.
    ///
    /// # Errors
    /// A lost device.
    fn stats(&mut self) -> Result<Stats, SimError>;
}
