// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Contenders: the backends, and the older ways of doing it.

use windfall_core::leaf::{LEAF_BYTES, Leaves};
use windfall_core::{Contract, SimError, Simulator, World};
use windfall_wgpu::{Gpu, LeafColumns, StoreBuffers, WorldColumns};

use crate::commands::bench::baseline::{ArrayOfStructs, Trajectories};
use crate::run::backend::{Backend, Device};

/// A way to move leaves, by name.
#[derive(Clone, Debug)]
pub(super) enum Approach {
    /// A trajectory for every leaf, played back.
    Trajectories,
    /// An array of structs in a loop.
    Structs,
    /// One of the backends. The CPU is asked for one step at a time, as a window asks.
    Device(Device),
    /// The CPU, asked for many steps at a time: it moves a chunk of leaves through several while they are in the cache.
    Fused(Device),
}

/// A world in the hands of one of them.
pub(super) enum Contender {
    Trajectories(Box<Trajectories>),
    Structs { leaves: Box<ArrayOfStructs>, columns: Box<Leaves> },
    Backend { backend: Backend, is_fused: bool },
}

impl Approach {
    /// Bytes that one leaf takes.
    pub(super) fn leaf_bytes(&self, dt_s: f32) -> usize {
        match self {
            Self::Trajectories => Trajectories::leaf_bytes(dt_s),
            Self::Structs => ArrayOfStructs::LEAF_BYTES,
            Self::Device(_) | Self::Fused(_) => LEAF_BYTES,
        }
    }

    /// Takes on a world.
    pub(super) fn take(&self, world: &World) -> Result<Contender, SimError> {
        Ok(match self {
            Self::Trajectories => Contender::Trajectories(Box::new(Trajectories::record(world)?)),
            Self::Structs => Contender::Structs {
                leaves: Box::new(ArrayOfStructs::new(world)),
                columns: Box::new(world.leaves.clone()),
            },
            Self::Device(device) => {
                let is_fused = matches!(device, Device::Wgpu(_));
                Contender::Backend { backend: device.simulator(world)?, is_fused }
            }
            Self::Fused(device) => Contender::Backend { backend: device.simulator(world)?, is_fused: true },
        })
    }
}

impl Contender {
    /// Name and machine, for the table.
    pub(super) fn names(&self) -> (&'static str, String) {
        match self {
            Self::Trajectories(_) => ("trajectory", "1 thread".into()),
            Self::Structs { .. } => ("structs", "1 thread".into()),
            Self::Backend { backend, is_fused } => {
                let info = backend.info();
                let name = if *is_fused && info.backend == "cpu" { "cpu-fused" } else { info.backend };
                (name, info.adapter)
            }
        }
    }

    /// Moves all leaves through `count` steps and waits until that is done.
    pub(super) fn step(&mut self, count: u32) -> Result<(), SimError> {
        match self {
            Self::Trajectories(trajectories) => trajectories.step(count),
            Self::Structs { leaves, .. } => leaves.step(count),
            Self::Backend { backend, is_fused } => {
                let portion = if *is_fused { count.max(1) } else { 1 };
                for _ in 0..count / portion {
                    backend.step(portion)?;
                }
                backend.sync()?;
            }
        }
        Ok(())
    }

    /// A fingerprint of the state, if it has to be the same to the bit as everybody else's.
    pub(super) fn exact_hash(&mut self, world: &World) -> Result<Option<u64>, SimError> {
        let mut state = world.clone();
        match self {
            Self::Trajectories(_) => return Ok(None),
            Self::Structs { leaves, .. } => leaves.read(&mut state.leaves),
            Self::Backend { backend, .. } if backend.info().contract == Contract::Exact => {
                backend.read_state(&mut state)?;
                state.clock = world.clock;
            }
            Self::Backend { .. } => return Ok(None),
        }
        Ok(Some(state.state_hash()))
    }

    /// Returns true if the leaves are where they can be after some steps: none lost, none broken.
    pub(super) fn is_sound(&mut self, world: &World) -> Result<bool, SimError> {
        let stats = match self {
            Self::Trajectories(trajectories) => {
                let leaves = trajectories.leaves().clone();
                World { leaves, ..world.clone() }.stats()
            }
            Self::Structs { leaves, .. } => {
                let mut state = world.clone();
                leaves.read(&mut state.leaves);
                state.stats()
            }
            Self::Backend { backend, .. } => backend.stats()?,
        };
        let count = world.compiled.scene().leaf_count();
        Ok(stats.leaves.broken == 0 && stats.leaves.total() + stats.leaves.dormant == count)
    }

    /// The columns to draw from, on the device that draws.
    pub(super) fn columns<'a>(
        &'a mut self,
        gpu: &Gpu,
        buffers: &'a StoreBuffers,
    ) -> Result<WorldColumns<'a>, SimError> {
        match self {
            Self::Trajectories(trajectories) => buffers.write(gpu, trajectories.leaves())?,
            Self::Structs { leaves, columns } => {
                leaves.read(columns);
                buffers.write(gpu, columns.as_ref())?;
            }
            Self::Backend { backend, .. } => return backend.columns(gpu),
        }
        Ok(WorldColumns {
            leaves: LeafColumns::of(buffers),
            branches: None,
            particles: None,
            burns: None,
            bed: None,
        })
    }
}
