// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Parts of mutation tests, which change a line of WGSL and must see the comparison with the oracle fail. Nearly all that they take is the
//! driver's work on the kernels that have been changed.

use std::sync::{Mutex, PoisonError};

use windfall_core::{Contract, Simulator, World};
use windfall_cpu::{CpuOptions, CpuSimulator};
use windfall_wgpu::{Gpu, KernelId, Shaders, WgpuOptions, WgpuSimulator};

use crate::adapter;
use crate::compare::{Difference, difference};

/// Runs `work` on all items, two at a time: one on this device of [`adapter::all`], one on its other, each of which keeps what it has compiled.
///
/// # Panics
/// If `work` does.
pub fn two_at_a_time<T>(gpu: &Gpu, items: impl Iterator<Item = T> + Send, work: impl Fn(&Gpu, T) + Sync) {
    let items = Mutex::new(items);
    // A worker that panics does so in `work`, behind the lock.
    let next = || items.lock().unwrap_or_else(PoisonError::into_inner).next();
    let worker = |gpu: Gpu| {
        while let Some(item) = next() {
            work(&gpu, item);
        }
    };
    std::thread::scope(|scope| {
        for worker in [gpu.clone(), adapter::other(gpu)].map(|gpu| scope.spawn(|| worker(gpu))) {
            worker.join().unwrap_or_else(|panic| std::panic::resume_unwind(panic));
        }
    });
}

/// A line of a module, changed in one of the kernels of a world after another, the shortest first: nobody has to compile all kernels that import
/// a module before one of them shows what has changed.
///
/// # Panics
/// If the line is not in the module, or no kernel of the world imports it.
pub fn edited_kernels(world: &World, module: &str, old: &str, new: &str) -> Vec<Shaders> {
    let shaders = Shaders::default();
    let mut kernels = KernelId::needed(&world.compiled);
    kernels.sort_by_key(|&kernel| shaders.kernel(kernel).map_or(usize::MAX, |text| text.len()));
    let edited = |kernel| shaders.clone().edited_in(kernel, module, old, new);
    let edited: Vec<_> = kernels.into_iter().filter_map(edited).collect();
    assert!(!edited.is_empty(), "no kernel of this world sees '{old}' in {module}");
    edited
}

/// States of the oracle on the way from one world.
#[derive(Debug)]
pub struct Course {
    start: World,
    states: Vec<World>,
}

impl Course {
    /// Steps the oracle from `start`, and keeps its state after each of so many steps, which ascend.
    ///
    /// # Panics
    /// If it cannot step.
    pub fn new(start: World, after: &[u32]) -> Self {
        let mut oracle = CpuSimulator::new(&start, CpuOptions::default()).expect("threads start");
        let mut done = 0;
        let states = after.iter().map(|&steps| {
            oracle.step(steps - done).expect("the CPU steps");
            done = steps;
            let mut state = start.clone();
            oracle.read_state(&mut state).expect("same size");
            state
        });
        let states = states.collect();
        Self { start, states }
    }

    /// Returns true if a device's states differ from these with a line of a module changed in some kernel.
    ///
    /// # Panics
    /// If the line is not there; if the device cannot step the world.
    pub fn notices(&self, gpu: &Gpu, module: &str, old: &str, new: &str) -> bool {
        edited_kernels(&self.start, module, old, new).into_iter().any(|shaders| {
            let contract = Some(Contract::Exact);
            let options = WgpuOptions { contract, shaders: Some(shaders), ..WgpuOptions::default() };
            self.first_difference(gpu, &options).is_some()
        })
    }

    /// The first difference of a device's states from these; `None` if they are equal to the bit.
    ///
    /// # Panics
    /// If the device cannot step the world.
    pub fn first_difference(&self, gpu: &Gpu, options: &WgpuOptions) -> Option<Difference> {
        let mut candidate =
            WgpuSimulator::new(gpu, &self.start, options).expect("the device takes the world");
        let mut found = self.start.clone();
        self.states.iter().find_map(|expected| {
            let steps = expected.clock.step() - candidate.clock().step();
            candidate.step(steps).expect("it steps");
            candidate.read_state(&mut found).expect("same size");
            Some(difference(expected, &found)).filter(|apart| !apart.is_none())
        })
    }
}
