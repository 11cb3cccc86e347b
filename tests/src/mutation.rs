// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Parts of mutation tests, which change a line of WGSL and must see the comparison with the oracle fail. Nearly all that they take is the
//! driver's work on shaders, kernel by kernel and simulator by simulator.

use std::sync::{Mutex, PoisonError};

use windfall_core::{Simulator, World};
use windfall_cpu::{CpuOptions, CpuSimulator};
use windfall_wgpu::{Gpu, KernelId, Shaders, WgpuOptions, WgpuSimulator};

use crate::compare::{Difference, difference};

/// Runs `work` on all items, two at a time: drivers compile shaders on the caller's thread.
///
/// # Panics
/// If `work` does.
pub fn two_at_a_time<T>(items: impl Iterator<Item = T> + Send, work: impl Fn(T) + Sync) {
    let items = Mutex::new(items);
    // A worker that panics does so in `work`, behind the lock.
    let next = || items.lock().unwrap_or_else(PoisonError::into_inner).next();
    let worker = || {
        while let Some(item) = next() {
            work(item);
        }
    };
    std::thread::scope(|scope| {
        for worker in [scope.spawn(worker), scope.spawn(worker)] {
            worker.join().unwrap_or_else(|panic| std::panic::resume_unwind(panic));
        }
    });
}

/// The same shaders, but these kernels do nothing, and are compiled in no time. For worlds in which they have nothing to do, which is
/// for the test to show.
///
/// # Panics
/// If a kernel is not among the shaders.
#[must_use]
pub fn with_idle(mut shaders: Shaders, kernels: impl IntoIterator<Item = KernelId>) -> Shaders {
    for kernel in kernels {
        let module = format!("kernels/{}", kernel.name());
        let text = shaders.text(&module).expect("a kernel has a module of its name").to_owned();
        let idle = format!(
            "#import prelude\n@compute @workgroup_size(WORKGROUP_SIZE)\nfn {}() {{}}\n",
            kernel.name()
        );
        shaders = shaders.edited(&module, &text, &idle).expect("its own text is there");
    }
    shaders
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
