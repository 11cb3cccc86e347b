// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Worlds stepped by either backend, and the devices that must give the same bits.

use windfall_core::{Contract, Simulator, World};
use windfall_cpu::{CpuOptions, CpuSimulator};
use windfall_tests::adapter;
use windfall_wgpu::{Gpu, WgpuOptions, WgpuSimulator};

/// The world after so many steps of the oracle.
pub(crate) fn on_cpu(world: &World, options: CpuOptions, steps: u32) -> World {
    let mut result = world.clone();
    let mut simulator = CpuSimulator::new(world, options).expect("threads start");
    simulator.step(steps).expect("the CPU steps");
    simulator.read_state(&mut result).expect("same size");
    result
}

/// The world after these portions of steps on a device.
pub(crate) fn on_gpu(gpu: &Gpu, world: &World, options: &WgpuOptions, portions: &[u32]) -> World {
    let mut result = world.clone();
    let mut simulator = WgpuSimulator::new(gpu, world, options).expect("the device takes the world");
    for &steps in portions {
        simulator.step(steps).expect("it steps");
    }
    simulator.read_state(&mut result).expect("same size");
    assert_eq!(simulator.stats().expect("counts"), result.stats(), "counts of the device");
    result
}

/// The exact contract, with pages of so many leaves if so.
pub(crate) fn exact(page_leaves: Option<u32>) -> WgpuOptions {
    WgpuOptions { contract: Some(Contract::Exact), page_leaves, ..WgpuOptions::default() }
}

/// A device on every adapter that keeps the exact contract. Metal and DX12 cannot; on Linux there must be one.
pub(crate) fn exact_adapters() -> Vec<Gpu> {
    let mut gpus = adapter::all();
    gpus.retain(|gpu| gpu.contract() == Contract::Exact);
    assert!(!gpus.is_empty() || cfg!(not(target_os = "linux")), "no adapter keeps the exact contract");
    gpus
}
