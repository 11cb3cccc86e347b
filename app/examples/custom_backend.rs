// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! A backend of one's own: any type that implements `Simulator`, here leaf by leaf on one thread, without trees. The parity
//! suite compares it with the oracle. `cargo run --release --example custom_backend`

use std::error::Error;

use windfall_core::{
    Clock, CompiledScene, Contract, SimError, Simulator, SimulatorInfo, Stats, World, oracle,
};
use windfall_tests::suite;

fn main() -> Result<(), Box<dyn Error>> {
    run(1000)
}

/// Runs the backend through all worlds of the suite that it takes.
pub(crate) fn run(leaves: u32) -> Result<(), Box<dyn Error>> {
    for case in suite::worlds(leaves).iter().filter(|case| !case.has_trees()) {
        suite::check(case, Plain::new)?;
        println!("{}: equal to the oracle", case.name);
    }
    Ok(())
}

/// One leaf after another.
pub(crate) struct Plain {
    world: World,
}

impl Plain {
    /// A simulator of a world without trees.
    pub(crate) fn new(world: &World) -> Result<Self, SimError> {
        if !world.compiled.forest().is_empty() {
            return Err(SimError::Device { reason: "trees are not simulated here".into() });
        }
        Ok(Self { world: world.clone() })
    }
}

impl Simulator for Plain {
    fn info(&self) -> SimulatorInfo {
        SimulatorInfo {
            backend: "plain",
            adapter: "one thread".into(),
            // It calls the oracle's own functions, in their order; another one would write twins of them.
            contract: Contract::Exact,
            sizes: self.world.sizes(),
        }
    }

    fn clock(&self) -> Clock {
        self.world.clock
    }

    fn step(&mut self, count: u32) -> Result<(), SimError> {
        oracle::step(&mut self.world, count);
        Ok(())
    }

    fn write_state(&mut self, world: &World) -> Result<(), SimError> {
        world.fits(&self.world.sizes())?;
        self.world = world.clone();
        Ok(())
    }

    fn read_state(&mut self, world: &mut World) -> Result<(), SimError> {
        world.fits(&self.world.sizes())?;
        world.copy_state(&self.world)
    }

    fn set_scene(&mut self, compiled: &CompiledScene) -> Result<(), SimError> {
        compiled.fits(&self.world.sizes())?;
        self.world.compiled = compiled.clone();
        Ok(())
    }

    fn sync(&mut self) -> Result<(), SimError> {
        Ok(())
    }

    fn stats(&mut self) -> Result<Stats, SimError> {
        Ok(self.world.stats())
    }
}
